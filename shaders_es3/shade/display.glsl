// From the mean light of a pixel to what is written of it.
#ifdef TO_FLOATS // whoever reads it back wants more than 8 bits: those of floats
layout(location = 0) out uvec4 o_color;
#define SHOWN(color) floatBitsToUint(color)
#else
layout(location = 0) out vec4 o_color;
#define SHOWN(color) (color)
#endif

// `share`: of the pixel that the light covers. sRGB with straight alpha, or linear light as it is. What lies behind is
// light that is shown as the rest, or a colour that is shown as it is.
vec4 displayed(vec3 light, float share)
{
    bool isLinear = (u_host.z & 1) != 0;
#ifdef WITH_BACKGROUND
    vec3 back = behind(gl_FragCoord.xy - vec2(u_host.xy));
    bool isLight = u_output.w == VT_BACKGROUND_BLURRED;
    light = isLight ? mix(back, light, share) : light;
#endif
    vec3 shown = light;
    if (!isLinear) {
#ifdef WITH_TONE
        shown = toneMap(shown);
#endif
        shown = min(shown, 1.0);
    }
#ifdef WITH_BACKGROUND
    shown = isLight ? shown : mix(back, shown, share);
    share = 1.0;
#endif
    return vec4(isLinear ? shown : linearToSrgb(shown), share);
}
