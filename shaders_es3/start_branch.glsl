// The paths of light that left the paths of the pass before (path.glsl), each from where it did.
#define BRANCH
uniform usampler2D u_lightsBefore;
uniform usampler2D u_asidesBefore;

Path startBranch(out uvec4 media)
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uvec4 light = texelFetch(u_lightsBefore, pixel, 0), aside = texelFetch(u_asidesBefore, pixel, 0);
    vec3 share = vec3(unpackHalf2x16(light.y).y, unpackHalf2x16(light.z));
    if (strongest(share) < VT_LEAST_BRANCH) {
        discard;
    }
    Path p = startPath(uintBitsToFloat(aside.xyz), unpackNormal(aside.w));
    p.transmittance = share;
    // Another number for every sample, that does not hang together with the path's own: 43 steps of the golden ratio.
    p.choice = u_eye.w < 0.0 ? u_eye.w : fract(43.0 * u_eye.w);
    p.events = 1; // it met the surface that it left the path at
    media = uvec4((light.w >> 11u) & 1023u, light.w >> 21u, 0u, 0u);
    return p;
}
