// What a technique says of a pixel's path: where it went, what became of it, and what light was lost and gained
// on the way. The shade pass (shade.frag) turns it into light.
layout(location = 0) out uvec4 o_path;  // last direction (bits of three floats), state
layout(location = 1) out uvec4 o_end;   // last position (bits of three floats), triangle where it ends on one
layout(location = 2) out uvec4 o_light; // seven halves: transmittance (3), light added (3), 0; object where it ends on one
layout(location = 3) out uvec4 o_aside; // of the light that left the path: direction, share (three halves), 0

struct Path {
    vec3 position, direction;
    vec3 transmittance;
    int events;
    bool reflected; // total internal reflection took part
    // Light that was reflected off the path, or passed where the path was reflected: where most of it went, and how
    // much it is together.
    vec3 asideDirection, aside;
    float mostAside;
};

Path startPath(vec3 position, vec3 direction)
{
    return Path(position, direction, vec3(1.0), 0, false, direction, vec3(0.0), 0.0);
}

void writePath(Path p, int status)
{
    int state = status + 256 * p.events + (p.reflected ? VT_PATH_TIR : 0);
    o_path = uvec4(floatBitsToUint(p.direction), uint(state));
    o_end = uvec4(floatBitsToUint(p.position), VT_NO_TRIANGLE);
    o_light = uvec4(packHalf2x16(p.transmittance.rg), packHalf2x16(vec2(p.transmittance.b, 0.0)), 0u, 0u);
    o_aside = uvec4(packNormal(p.asideDirection), packHalf2x16(p.aside.rg), packHalf2x16(vec2(p.aside.b, 0.0)), 0u);
}

// A path of the techniques that blend, from the eye: `transmittance` is left of what lies behind, `added` before it.
void writeBlended(vec3 direction, int events, float transmittance, vec3 added)
{
    Path p = startPath(u_eye.xyz, direction);
    p.events = events;
    p.transmittance = vec3(transmittance);
    writePath(p, events > 0 ? VT_PATH_EXITED : VT_PATH_BACKGROUND);
    o_light.yz = uvec2(packHalf2x16(vec2(transmittance, added.r)), packHalf2x16(added.gb));
}
