// From paths to light: what lies at their ends, what the first surface reflects, and what left them on the way.
uniform usampler2D u_paths;
uniform usampler2D u_ends;
uniform usampler2D u_lights;
uniform usampler2D u_asides;

layout(location = 0) out uvec4 o_radiance; // bits of floats: linear light after exposure, share of the pixel it covers

#ifdef WITH_OPAQUE
vec3 opaqueLight(OpaqueHit opaque, vec3 origin, vec3 direction)
{
    float pixel = (u_pictureFrustum.w - u_pictureFrustum.y) / float(u_size.y);
    vec3 position = origin + opaque.hit.distance * direction;
    return shadeOpaque(opaque.object, opaqueSurface(opaque.object, opaque.hit), direction, pixel * mix(length(position - u_eye.xyz), 1.0, u_clip.w));
}
#endif

// Where light comes from, and how much of it counts.
struct Ray {
    vec3 origin, direction, weight;
};

float strongest(vec3 light)
{
    return max(light.r, max(light.g, light.b));
}

// What the surface that the eye sees first reflects to it; `surface` as surface.frag has written it.
Ray firstReflection(uvec4 surface, vec2 tangent, vec3 direction)
{
    float depth = uintBitsToFloat(surface.z);
    vec3 position = pointAtDepth(tangent, depth);
    vec3 N = unpackNormal(surface.x), G = unpackNormal(surface.y);
    float eta = 1.0 / objectNumbers(int(surface.w) - 1, VT_OBJECT_GLASS).x;
    bool isWithin = dot(G, direction) >= 0.0; // the eye is
    N = dot(N, direction) < 0.0 ? N : G;
    vec3 R = reflect(direction, N);
    R = dot(R, G) > 0.0 ? R : reflect(direction, G);
    return Ray(position, R, vec3(isWithin ? 0.0 : fresnel(-dot(N, direction), eta)));
}

// The angle that a pixel covers at the end of its path, from its neighbours' ends. (Techniques without a shade pass carry
// it along: common/footprint.glsl.) A neighbour with other events is of another part of the glass and does not count.
float endWidth(vec3 direction, uint state)
{
    float events = float(state % (2u * uint(VT_PATH_TIR)));
    vec3 x = dFdx(direction), y = dFdy(direction);
    float right = dFdx(events) == 0.0 ? length(x) : 0.0, up = dFdy(events) == 0.0 ? length(y) : 0.0;
    float width = min(right, up) > 0.0 ? sqrt(length(cross(x, y))) : max(right, up);
    return width * inversesqrt(max(u_optics.w, 1.0)); // of one of several samples
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 tangent = pictureTangent(gl_FragCoord.xy);
    vec3 view = cameraDirection(tangent);
    uvec4 path = readTexel(u_paths, pixel, u_size.xy);
    int status = int(path.w) & 255;
    bool isBackground = status == VT_PATH_BACKGROUND;
    float width = endWidth(isBackground ? view : uintBitsToFloat(path.xyz), path.w);
    vec3 light = vec3(0.0);
    // Up to three rays to light: the path's end, what went aside, what the first surface reflects. They are looked at in
    // a loop because software renderers compute both sides of every branch.
    int count = 1;
    vec3 eye = eyePosition(tangent);
    Ray end = Ray(eye, view, vec3(1.0)), aside = Ray(eye, view, vec3(0.0)), first = aside;
#ifdef WITH_OPAQUE
    OpaqueHit known = NOTHING_OPAQUE; // where the first of them ends
    bool isSearched = isBackground || (status == VT_PATH_EXITED && u_scene.w == 0);
#endif
    if (!isBackground) {
        uvec4 endBits = readTexel(u_ends, pixel, u_size.xy), bits = readTexel(u_lights, pixel, u_size.xy);
        vec2 middle = unpackHalf2x16(bits.y);
        vec3 more = vec3(middle.y, unpackHalf2x16(bits.z));
        end = Ray(uintBitsToFloat(endBits.xyz), uintBitsToFloat(path.xyz), vec3(unpackHalf2x16(bits.x), middle.x));
#ifdef WITH_OPAQUE
        if (status == VT_PATH_OPAQUE) {
            known = opaqueAt(endBits.w, int(bits.w) - 1, end.origin, end.direction);
        }
#endif
#ifdef WITH_SURFACE
        if (strongest(more) > 0.0) {
            uvec4 asideBits = readTexel(u_asides, pixel, u_size.xy);
            aside = Ray(uintBitsToFloat(asideBits.xyz), unpackNormal(asideBits.w), more);
            count = 3;
        }
        if (u_scene.z != 0) {
            first = firstReflection(readTexel(u_surface, pixel, u_size.xy), tangent, view);
            count = max(count, 2);
        }
#else
        light = more; // that the surfaces add by themselves
#endif
    }
    bool isCovered = !isBackground;
    for (int i = 0; i < count; ++i) {
        Ray ray = end;
        ray.origin = i == 1 ? first.origin : i == 2 ? aside.origin : ray.origin;
        ray.direction = i == 1 ? first.direction : i == 2 ? aside.direction : ray.direction;
        ray.weight = i == 1 ? first.weight : i == 2 ? aside.weight : ray.weight;
        vec3 seen = surroundings(ray.origin, ray.direction, i == 0 ? width : 0.0, vec3(0.0)); // a lost path sees it, too
#ifdef WITH_OPAQUE
        OpaqueHit opaque = known;
        if (i > 0 || isSearched) {
            opaque = searchOpaque(ray.origin, ray.direction, NOWHERE);
        }
        if (opaque.hit.triangle != VT_NO_TRIANGLE) {
            seen = opaqueLight(opaque, ray.origin, ray.direction);
            isCovered = true;
        }
#endif
        light += ray.weight * seen;
    }
    float share = isCovered || u_output.w == 0 ? 1.0 : 0.0; // else the page shows behind the glass
    o_radiance = floatBitsToUint(vec4(light * u_optics.z * share, share));
}
