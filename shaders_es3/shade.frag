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

// Light that comes to a point from a direction, glass left out.
vec3 lightFrom(vec3 origin, vec3 direction)
{
#ifdef WITH_OPAQUE
    OpaqueHit hit = searchOpaque(origin, direction, NOWHERE);
    if (hit.triangle != VT_NO_TRIANGLE) {
        return opaqueLight(hit, origin, direction);
    }
#endif
    return environmentRadiance(u_output.z, u_environment, direction);
}

// What the surface that the eye sees first reflects to it; `surface` as surface.frag has written it.
vec3 firstReflection(uvec4 surface, vec2 tangent, vec3 direction)
{
    float depth = uintBitsToFloat(surface.z);
    vec3 position = u_eye.xyz + vec3(tangent * depth, depth) * mat3(u_worldToCamera);
    vec3 N = unpackNormal(surface.x), G = unpackNormal(surface.y);
    if (dot(G, direction) >= 0.0) {
        return vec3(0.0); // the eye is within the glass
    }
    float eta = 1.0 / objectNumbers(int(surface.w) - 1, VT_OBJECT_GLASS).x;
    N = dot(N, direction) < 0.0 ? N : G;
    vec3 R = reflect(direction, N);
    R = dot(R, G) > 0.0 ? R : reflect(direction, G);
    return fresnel(-dot(N, direction), eta) * lightFrom(position, R);
}

// Light at the end of a pixel's path and off it.
vec3 pathLight(ivec2 pixel, uvec4 path, int status)
{
    uvec4 endBits = texelFetch(u_ends, pixel, 0), bits = texelFetch(u_lights, pixel, 0);
    vec3 position = uintBitsToFloat(endBits.xyz), direction = uintBitsToFloat(path.xyz);
    vec2 middle = unpackHalf2x16(bits.y);
    vec3 transmittance = vec3(unpackHalf2x16(bits.x), middle.x), more = vec3(middle.y, unpackHalf2x16(bits.z));
    vec3 end;
#ifdef WITH_OPAQUE
    if (status == VT_PATH_OPAQUE) {
        end = opaqueLight(OpaqueHit(0.0, endBits.w, int(bits.w & 2047u) - 1), position, direction);
    } else
#endif
    if (status == VT_PATH_EXITED && u_scene.w == 0) {
        end = lightFrom(position, direction);
    } else { // a lost path shows what lies in its last direction: glass goes on being bright there
        end = environmentRadiance(u_output.z, u_environment, direction);
    }
#ifdef WITH_SURFACE
    float most = max(more.r, max(more.g, more.b));
    bool isFollowed = u_branches > 0 && most >= VT_LEAST_BRANCH;
    if (isFollowed || most == 0.0) {
        more = vec3(0.0);
    } else {
        uvec4 aside = texelFetch(u_asides, pixel, 0);
        more *= lightFrom(uintBitsToFloat(aside.xyz), unpackNormal(aside.w));
    }
#endif
    return transmittance * end + more;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 tangent = pictureTangent(gl_FragCoord.xy);
    uvec4 path = texelFetch(u_paths, pixel, 0);
    int status = int(path.w) & 255;
    float share = 1.0;
    vec3 light = vec3(0.0);
    uvec4 surface = uvec4(0u);
    vec3 direction = cameraDirection(tangent);
#ifdef WITH_SURFACE
    surface = texelFetch(u_surface, pixel, 0);
#endif
    if (status != VT_PATH_BACKGROUND) {
        light = pathLight(pixel, path, status);
#ifdef WITH_SURFACE
        if (u_scene.z != 0 && u_branch == 0) {
            light += firstReflection(surface, tangent, direction);
        }
#endif
    } else if (u_branch == 0) {
#ifdef WITH_OPAQUE
        OpaqueHit seen = OpaqueHit(uintBitsToFloat(surface.z) * length(vec3(tangent, 1.0)), surface.x, int(surface.w) - 1);
#ifndef WITH_SURFACE
        seen = searchOpaque(u_eye.xyz, direction, NOWHERE);
#else
        seen.triangle = surface.w == 0u ? VT_NO_TRIANGLE : seen.triangle;
#endif
        if (seen.triangle != VT_NO_TRIANGLE) {
            light = opaqueLight(seen, u_eye.xyz, direction);
        } else
#endif
        {
            share = u_output.w != 0 ? 0.0 : 1.0;
            light = share * environmentRadiance(u_output.z, u_environment, direction);
        }
    }
    light *= u_optics.z;
    if (u_branch > 0) {
        uvec2 before = texelFetch(u_before, pixel, 0).rg;
        vec2 last = unpackHalf2x16(before.y);
        light += vec3(unpackHalf2x16(before.x), last.x);
        share = last.y;
    }
    light = min(light, 65504.0);
    o_radiance = uvec2(packHalf2x16(light.rg), packHalf2x16(vec2(light.b, share)));
}
