// Light over the host's picture, where there is something of ours and nothing of the host's before it, with its depth.
uniform usampler2D u_radiance; // bits of floats: light of one sample, or the sum of several; share of the pixel
#ifdef WITH_SURFACE // what is seen first
#define SEEN u_surface
#else
uniform usampler2D u_depths;
#define SEEN u_depths
#endif

layout(location = 0) out vec4 o_color; // times its share, to be blended

float seenDepth(ivec2 pixel)
{
    uvec4 texel = texelFetch(SEEN, clamp(pixel, ivec2(0), u_size.xy - 1), 0);
#ifdef WITH_SURFACE
    return texel.w != 0u ? uintBitsToFloat(texel.z) : NOTHING_BEHIND;
#else
    return texel.x != 0u ? uintBitsToFloat(texel.x) : NOTHING_BEHIND;
#endif
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy) - u_host.xy;
    vec4 light = max(uintBitsToFloat(texelFetch(u_radiance, pixel, 0)), 0.0) / (u_optics.w + float(u_sample.w));
    float depth = seenDepth(pixel), around = NOTHING_BEHIND;
    for (int i = 0; i < 9; ++i) { // a pixel that only some samples cover has the depth of its neighbours
        around = min(around, seenDepth(pixel + ivec2(i % 3, i / 3) - 1));
    }
    depth = depth < NOTHING_BEHIND ? depth : around;
    if (light.a <= 0.0 || depth >= NOTHING_BEHIND || depth > 1.0001 * hostDepth(ivec2(gl_FragCoord.xy))) {
        discard;
    }
    vec3 shown = light.rgb / light.a;
    if (u_host.z == 0) {
#ifdef WITH_TONE
        shown = toneMap(shown);
#endif
        shown = linearToSrgb(shown);
    }
    o_color = vec4(shown * light.a, light.a);
    gl_FragDepth = windowDepth(depth);
}
