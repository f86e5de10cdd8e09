// From paths to light: what lies at their ends, what the first surface reflects, and what left them on the way.
uniform usampler2D u_paths;
uniform usampler2D u_ends;
uniform usampler2D u_lights;
uniform usampler2D u_asides;
#ifndef WITH_OPAQUE // lighting.glsl has it
uniform sampler2D u_environment;
#endif

uniform usampler2D u_before; // light of the passes before
uniform int u_branch;        // number of the pass; 0: the pixels' own paths
uniform int u_branches;      // passes that follow

layout(location = 0) out uvec2 o_radiance; // four halves: linear light after exposure, share of the pixel it covers

#ifdef WITH_OPAQUE
vec3 opaqueLight(OpaqueHit hit, vec3 origin, vec3 direction)
{
    Transform t = readTransform(hit.object);
    vec3 w = cornerWeights(hit.triangle, toObject(t, vec4(origin, 1.0)), toObject(t, vec4(direction, 0.0)));
    float pixel = (u_pictureFrustum.w - u_pictureFrustum.y) / float(u_size.y);
    return shadeSurface(hit.object, hit.triangle, w, direction, pixel * length(origin + hit.distance * direction - u_eye.xyz));
}
#endif

// Where light comes from, and how much of it counts.
struct Ray {
    vec3 origin, direction, weight;
};

// What the surface that the eye sees first reflects to it; `surface` as surface.frag has written it.
Ray firstReflection(uvec4 surface, vec2 tangent, vec3 direction)
{
    float depth = uintBitsToFloat(surface.z);
    vec3 position = u_eye.xyz + vec3(tangent * depth, depth) * mat3(u_worldToCamera);
    vec3 N = unpackNormal(surface.x), G = unpackNormal(surface.y);
    float eta = 1.0 / objectNumbers(int(surface.w) - 1, VT_OBJECT_GLASS).x;
    bool isWithin = dot(G, direction) >= 0.0; // the eye is
    N = dot(N, direction) < 0.0 ? N : G;
    vec3 R = reflect(direction, N);
    R = dot(R, G) > 0.0 ? R : reflect(direction, G);
    return Ray(position, R, vec3(isWithin ? 0.0 : fresnel(-dot(N, direction), eta)));
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 tangent = pictureTangent(gl_FragCoord.xy);
    vec3 view = cameraDirection(tangent);
    uvec4 path = texelFetch(u_paths, pixel, 0);
    int status = int(path.w) & 255;
    bool isBackground = status == VT_PATH_BACKGROUND;
    vec3 light = vec3(0.0);
    // Up to three rays to light: the path's end, what went aside, what the first surface reflects. They are looked at in
    // a loop because software renderers compute both sides of every branch.
    int count = isBackground && u_branch > 0 ? 0 : 1;
    Ray end = Ray(u_eye.xyz, view, vec3(1.0)), aside = Ray(u_eye.xyz, view, vec3(0.0)), first = aside;
#ifdef WITH_OPAQUE
    OpaqueHit known = OpaqueHit(0.0, VT_NO_TRIANGLE, -1); // where the first of them ends
    bool isSearched = status == VT_PATH_EXITED && u_scene.w == 0;
#endif
#ifdef WITH_SURFACE
    uvec4 surface = texelFetch(u_surface, pixel, 0);
#ifdef WITH_OPAQUE
    if (int(surface.w) > u_scene.x) {
        known = OpaqueHit(uintBitsToFloat(surface.z) * length(vec3(tangent, 1.0)), surface.x, int(surface.w) - 1);
    }
#endif
#elif defined(WITH_OPAQUE)
    isSearched = isSearched || isBackground;
#endif
    if (!isBackground) {
        uvec4 endBits = texelFetch(u_ends, pixel, 0), bits = texelFetch(u_lights, pixel, 0);
        vec2 middle = unpackHalf2x16(bits.y);
        vec3 more = vec3(middle.y, unpackHalf2x16(bits.z));
        end = Ray(uintBitsToFloat(endBits.xyz), uintBitsToFloat(path.xyz), vec3(unpackHalf2x16(bits.x), middle.x));
#ifdef WITH_OPAQUE
        if (status == VT_PATH_OPAQUE) {
            known = OpaqueHit(0.0, endBits.w, int(bits.w & 2047u) - 1);
        }
#endif
#ifdef WITH_SURFACE
        float most = max(more.r, max(more.g, more.b));
        if (most > 0.0 && (u_branches == 0 || most < VT_LEAST_BRANCH)) { // else a branch follows it
            uvec4 asideBits = texelFetch(u_asides, pixel, 0);
            aside = Ray(uintBitsToFloat(asideBits.xyz), unpackNormal(asideBits.w), more);
            count = 3;
        }
        if (u_scene.z != 0 && u_branch == 0) {
            first = firstReflection(surface, tangent, view);
            count = max(count, 2);
        }
#else
        light = more; // that the surfaces add by themselves
#endif
    }
    for (int i = 0; i < count; ++i) {
        Ray ray = end;
        ray.origin = i == 1 ? first.origin : i == 2 ? aside.origin : ray.origin;
        ray.direction = i == 1 ? first.direction : i == 2 ? aside.direction : ray.direction;
        ray.weight = i == 1 ? first.weight : i == 2 ? aside.weight : ray.weight;
        vec3 seen = environmentRadiance(u_output.z, u_environment, ray.direction); // a lost path sees it, too
#ifdef WITH_OPAQUE
        OpaqueHit hit = known;
        if (i > 0 || isSearched) {
            hit = searchOpaque(ray.origin, ray.direction, NOWHERE);
        }
        if (hit.triangle != VT_NO_TRIANGLE) {
            seen = opaqueLight(hit, ray.origin, ray.direction);
        }
#endif
        light += ray.weight * seen;
    }
    float share = 1.0;
    if (isBackground && u_output.w != 0) { // the page shows behind the glass
        share = 0.0;
#ifdef WITH_OPAQUE
        share = known.triangle != VT_NO_TRIANGLE ? 1.0 : 0.0;
#endif
    }
    light *= u_optics.z * share;
    if (u_branch > 0) {
        uvec2 before = texelFetch(u_before, pixel, 0).rg;
        vec2 last = unpackHalf2x16(before.y);
        light += vec3(unpackHalf2x16(before.x), last.x);
        share = last.y;
    }
    light = min(light, 65504.0);
    o_radiance = uvec2(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, share)));
}
