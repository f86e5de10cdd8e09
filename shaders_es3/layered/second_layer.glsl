// The back side as the two-interface techniques know it: the layers' second slot.
uniform usampler2DArray u_layerDepths;
uniform usampler2DArray u_layerNormals;

// VT_DEPTH_NONE outside the texture and where there is no back side.
uint backDepth(vec2 position)
{
    vec2 texel = floor(position);
    bool isBeside = any(lessThan(texel, vec2(0.0))) || any(greaterThanEqual(texel, vec2(u_size.zw)));
    uint depth = readLayer(u_layerDepths, texel, 1, u_size.zw).r;
    return isBeside ? VT_DEPTH_NONE : depth;
}

// Interpolated outward normal, bilinear over the texels that have one.
vec3 backNormal(vec2 position)
{
    vec2 corner = floor(position - 0.5);
    vec2 fraction = position - 0.5 - corner;
    vec3 normal = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 step = vec2(i & 1, i >> 1);
        uint bits = readLayer(u_layerNormals, layerTexel(corner + step), 1, u_size.zw).r;
        vec2 w = mix(1.0 - fraction, fraction, step);
        normal += bits != VT_NO_NORMAL ? (w.x * w.y + 1e-4) * unpackNormal(bits) : vec3(0.0);
    }
    return dot(normal, normal) > 0.0 ? normalize(normal) : vec3(0.0);
}

// Takes the path out through a back side of outward normal N, after `distance` in glass of that object. Beyond the
// critical angle it is clamped to it, as Wyman 2005 does: the ray leaves along the surface, with all of its light.
void leaveClamped(inout Path p, vec3 N, int object, float distance)
{
    absorb(p, uvec4(uint(object + 1), uvec3(0u)), distance);
    vec3 T = p.direction;
    float eta = glassOf(uint(object + 1)).x;
    float c = -dot(N, T);
    float k = 1.0 - eta * eta * (1.0 - c * c);
    p.direction = normalize(eta * T + (eta * c + sqrt(max(k, 0.0))) * N);
    p.position += distance * T;
    p.reflected = k < 0.0;
    ++p.events;
    if (u_scene.z != 0) {
        float F = p.reflected ? 0.0 : fresnel(abs(c), eta);
        setAside(p, reflect(T, N), F, uvec4(0u));
        p.transmittance *= 1.0 - F;
    }
    p.transmittance *= objectNumbers(object, VT_OBJECT_COLOR).rgb;
}
