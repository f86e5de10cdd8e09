// From the mean light of a pixel to what is written of it. to_floats.glsl and background.glsl each take the place of a part.
#ifndef TO_FLOATS
layout(location = 0) out vec4 o_color;
#define SHOWN(color) (color)
#endif

vec3 shownLight(vec3 light)
{
#ifdef WITH_TONE
    light = toneMap(light);
#endif
    return min(light, 1.0);
}

#ifndef WITH_BACKGROUND
// `share`: of the pixel that the light covers. sRGB with straight alpha, or linear light as it is.
vec4 displayed(vec3 light, float share)
{
    return vec4(u_host.z != 0 ? light : linearToSrgb(shownLight(light)), share);
}
#endif
