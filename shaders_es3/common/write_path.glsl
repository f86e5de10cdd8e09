// What a technique says of a pixel's path: where it went, what became of it, and what light was lost and gained
// on the way. The shade pass (shade.frag) turns it into light. Needs path.
layout(location = 0) out uvec4 o_path;  // last direction (bits of three floats), state
layout(location = 1) out uvec4 o_end;   // last position (bits of three floats), triangle where it ends on one
layout(location = 2) out uvec4 o_light; // halves: transmittance (3), share aside or light added (3); number plus one of
                                        // the object where it ends on one
layout(location = 3) out uvec4 o_aside; // light that left the path: where (bits of three floats), direction

// `added`: halves four to six of o_light.
void writeHalves(vec3 transmittance, vec3 added)
{
    o_light.xyz = uvec3(packHalf2x16(transmittance.rg), packHalf2x16(vec2(transmittance.b, added.r)), packHalf2x16(added.gb));
}

// A path that ends in the environment, or is lost.
void writePath(Path p, int status)
{
    o_path = uvec4(floatBitsToUint(p.direction), pathState(p, status));
    o_end = uvec4(floatBitsToUint(p.position), VT_NO_TRIANGLE);
    o_light.w = 0u;
    writeHalves(p.transmittance, p.aside);
    o_aside = uvec4(floatBitsToUint(p.asidePosition), packNormal(p.asideDirection));
}

// A path of the techniques that blend, from the eye: `transmittance` is left of what lies behind, `added` before it.
void writeBlended(vec3 direction, int events, float transmittance, vec3 added)
{
    Path p = startPath(u_eye.xyz, direction); // none of them is orthographic
    p.events = events;
    writePath(p, events > 0 ? VT_PATH_EXITED : VT_PATH_BACKGROUND);
    writeHalves(vec3(transmittance), added);
}
