// What a technique says of a pixel's path: where it went, what became of it, and what light was lost and gained
// on the way. The shade pass (shade.frag) turns it into light.
layout(location = 0) out uvec4 o_path;  // last direction (bits of three floats), state
layout(location = 1) out uvec4 o_end;   // last position (bits of three floats), triangle where it ends on one
layout(location = 2) out uvec4 o_light; // halves: transmittance (3), share aside or light added (3); objects
layout(location = 3) out uvec4 o_aside; // light that left the path: where (bits of three floats), direction

// Objects: where the path ends on one its number plus one, 11 bits; the two media of highest precedence of the
// light aside, 10 bits each.

struct Path {
    vec3 position, direction;
    vec3 transmittance;
    int events;
    bool reflected; // total internal reflection took part
    // Light that was reflected off the path, or passed where the path was reflected: all of its share, as if it went
    // the way of one part of it.
    vec3 aside, asidePosition, asideDirection;
    uvec4 asideMedia;
    float choice; // 0 to 1: decides which part; below 0: the strongest
};

Path startPath(vec3 position, vec3 direction)
{
    return Path(position, direction, vec3(1.0), 0, false, vec3(0.0), position, direction, uvec4(0u), u_eye.w);
}

float strongest(vec3 light)
{
    return max(light.r, max(light.g, light.b));
}

// Light that leaves the path in a direction, `share` of what is on it; it is then in `media`. Of several parts one is
// kept, with a chance as its share is (Chao 1982, weighted sampling in one pass), by a number that is the same for all
// pixels of a sample: pictures of several samples come to the mean of all parts, without noise.
void setAside(inout Path p, vec3 direction, float share, uvec4 media)
{
    vec3 light = share * p.transmittance;
    float before = strongest(p.aside), part = strongest(light);
    float chance = part / max(before + part, 1e-9);
    bool isKept = p.choice < 0.0 ? part > before : p.choice < chance;
    p.choice = p.choice < 0.0 ? p.choice : isKept ? p.choice / chance : (p.choice - chance) / (1.0 - chance);
    p.asidePosition = isKept ? p.position : p.asidePosition;
    p.asideDirection = isKept ? direction : p.asideDirection;
    p.asideMedia = isKept ? media : p.asideMedia;
    p.aside += light;
}

// `added`: halves four to six of o_light.
void writeHalves(vec3 transmittance, vec3 added)
{
    o_light.xyz = uvec3(packHalf2x16(transmittance.rg), packHalf2x16(vec2(transmittance.b, added.r)), packHalf2x16(added.gb));
}

// A path that ends in the environment, is lost, or ends on a triangle of object `end`; else that is -1.
void writePathEnd(Path p, int status, uint triangle, int end)
{
    int state = status + 256 * p.events + (p.reflected ? VT_PATH_TIR : 0);
    o_path = uvec4(floatBitsToUint(p.direction), uint(state));
    o_end = uvec4(floatBitsToUint(p.position), triangle);
    uvec4 ranks = p.asideMedia - 1u; // free places become the greatest number
    uint least = min(min(ranks.x, ranks.y), min(ranks.z, ranks.w));
    uvec4 rest = ranks | (uvec4(equal(ranks, uvec4(least))) * 0xffffffffu);
    uint first = least + 1u, second = min(min(rest.x, rest.y), min(rest.z, rest.w)) + 1u;
    o_light.w = uint(end + 1) | first << 11u | second << 21u;
    writeHalves(p.transmittance, p.aside);
    o_aside = uvec4(floatBitsToUint(p.asidePosition), packNormal(p.asideDirection));
}

void writePath(Path p, int status)
{
    writePathEnd(p, status, VT_NO_TRIANGLE, -1);
}

// A path of the techniques that blend, from the eye: `transmittance` is left of what lies behind, `added` before it.
void writeBlended(vec3 direction, int events, float transmittance, vec3 added)
{
    Path p = startPath(u_eye.xyz, direction);
    p.events = events;
    writePath(p, events > 0 ? VT_PATH_EXITED : VT_PATH_BACKGROUND);
    writeHalves(vec3(transmittance), added);
}
