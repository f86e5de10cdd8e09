// Light that glass bends onto opaque things. The twin of src/light/caustics.c, which names the sources and gathers it.
uniform usampler2D u_caustics; // constants.h

uvec4 causticTexel(uint at)
{
    return readTexel(u_caustics, ivec2(at % uint(VT_CAUSTIC_COLUMNS), at / uint(VT_CAUSTIC_COLUMNS)), textureSize(u_caustics, 0));
}

// Irradiance at a place of a triangle, from the side that its normal points to or from behind.
vec3 causticLight(int object, uint triangle, vec2 at, bool behind)
{
    uint slots = causticTexel(0u).x;
    if (slots == 0u) {
        return vec3(0.0);
    }
    uint x = triangle * 0x9e3779b1u ^ uint(object) * 0x85ebca77u;
    x ^= x >> 15u;
    x *= 0x2c1b3c6du;
    uint slot = (x ^ (x >> 13u)) & (slots - 1u);
    uvec4 head = uvec4(0u);
    bool isFound = false;
    for (int i = 0; i < VT_CAUSTIC_PROBES; ++i) {
        head = causticTexel(1u + 2u * slot);
        isFound = head.x == uint(object) + 1u && head.y == triangle;
        if (isFound || head.x == 0u) {
            break;
        }
        slot = (slot + 1u) & (slots - 1u);
    }
    if (!isFound) {
        return vec3(0.0);
    }
    ivec4 window = ivec4(causticTexel(2u + 2u * slot));
    float n = float(head.z);
    vec2 place = clamp(at, vec2(0.0), vec2(1.0, max(1.0 - at.x, 0.0))) * n;
    ivec2 cell = ivec2(min(place, n - 1.0));
    vec2 part = place - vec2(cell);
    bool upper = part.x + part.y > 1.0 && cell.x + cell.y < int(head.z) - 1;
    vec3 weights = mix(vec3(max(1.0 - part.x - part.y, 0.0), part), vec3(part.x + part.y - 1.0, 1.0 - part.yx), bvec3(upper));
    vec3 light = vec3(0.0);
    for (int k = 0; k < 3; ++k) {
        ivec2 here = cell + ivec2(k == 1 || (k == 0 && upper), k == 2 || (k == 0 && upper));
        ivec2 inside = here - window.xy;
        bool isIn = head.z == 1u || (inside.x >= 0 && inside.y >= 0 && inside.x < window.z && inside.y < window.w);
        int shared = here.x == 1 ? window.y : here.y == 1 ? window.z : window.x;
        uint number = head.z == 1u ? uint(shared) : head.w + uint(inside.y * window.z + inside.x);
        vec3 sampled = uintBitsToFloat(causticTexel(1u + 2u * slots + 2u * number + uint(behind)).xyz);
        light += isIn ? weights[k] * sampled : vec3(0.0);
    }
    return light;
}
