// Where world points lie in the layers.

// A ray as the layers see it: (column * depth, row * depth, depth) is linear in the ray's parameter.
struct LayerRay {
    vec3 origin;
    vec3 direction;
};

vec3 layerCoordinates(vec3 camera)
{
    vec2 scale = vec2(u_size.zw) / (u_layerFrustum.zw - u_layerFrustum.xy);
    return vec3((camera.xy - u_layerFrustum.xy * camera.z) * scale, camera.z);
}

LayerRay makeLayerRay(vec3 origin, vec3 direction)
{
    return LayerRay(layerCoordinates((u_worldToCamera * vec4(origin, 1.0)).xyz),
                    layerCoordinates(mat3(u_worldToCamera) * direction));
}

// (column, row, stored depth) of the ray's point at t.
vec3 layerPoint(LayerRay ray, float t)
{
    vec3 p = ray.origin + t * ray.direction;
    return vec3(p.xy / p.z, (p.z - u_layerDepth.x) * u_layerDepth.z * VT_DEPTH_SCALE);
}

ivec2 layerTexel(vec2 position)
{
    return clamp(ivec2(floor(position)), ivec2(0), u_size.zw - 1);
}

// The world point of a layer's texel centre at a stored depth.
vec3 layerWorldPoint(ivec2 texel, float stored)
{
    vec2 tangent = mix(u_layerFrustum.xy, u_layerFrustum.zw, (vec2(texel) + 0.5) / vec2(u_size.zw));
    float depth = u_layerDepth.x + stored / (VT_DEPTH_SCALE * u_layerDepth.z);
    return u_eye.xyz + vec3(tangent * depth, depth) * mat3(u_worldToCamera);
}
