// What a technique says of a pixel's path: where it went, what became of it, and what light was lost and
// gained on the way.
layout(location = 0) out uvec4 o_path;  // last direction (bits of three floats), state
layout(location = 1) out uvec2 o_light; // four halves: transmittance, light added (red, green, blue)

void writePathLight(vec3 direction, int status, int events, bool reflected, float transmittance, vec3 added)
{
    int state = status + 256 * events + (reflected ? VT_PATH_TIR : 0);
    o_path = uvec4(floatBitsToUint(direction), uint(state));
    o_light = uvec2(packHalf2x16(vec2(transmittance, added.r)), packHalf2x16(added.gb));
}

void writePath(vec3 direction, int status, int events, bool reflected)
{
    writePathLight(direction, status, events, reflected, 1.0, vec3(0.0));
}

void writeBackground()
{
    writePath(vec3(0.0), VT_PATH_BACKGROUND, 0, false);
}
