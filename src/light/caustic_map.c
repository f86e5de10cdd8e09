// Light that was gathered on triangles (caustics.c), read. The twin of shaders_es3/ground/caustics.glsl.
#include "light/caustic_map.h"

#include <string.h>

#include "base/memory.h"

uint32_t vtCausticHash(uint32_t object, uint32_t triangle)
{
    uint32_t x = triangle * 0x9e3779b1u ^ object * 0x85ebca77u;
    x ^= x >> 15;
    x *= 0x2c1b3c6du;
    return x ^ (x >> 13);
}

void vtCausticSamples(uint32_t sides, float u, float v, int32_t at[3][2], float weights[3])
{
    const float n = (float)sides, x = vtClamp(u, 0.0f, 1.0f) * n,
                y = vtClamp(v, 0.0f, fmaxf(1.0f - u, 0.0f)) * n;
    const int32_t i = (int32_t)fminf(x, n - 1.0f), j = (int32_t)fminf(y, n - 1.0f);
    const float a = x - (float)i, b = y - (float)j;
    const bool upper = a + b > 1.0f && i + j < (int32_t)sides - 1;
    const int32_t places[3][2] = {{upper ? i + 1 : i, upper ? j + 1 : j}, {i + 1, j}, {i, j + 1}};
    memcpy(at, places, sizeof places);
    weights[0] = upper ? a + b - 1.0f : fmaxf(1.0f - a - b, 0.0f);
    weights[1] = upper ? 1.0f - b : a;
    weights[2] = upper ? 1.0f - a : b;
}

void vtDestroyCausticMap(vtCausticMap* map)
{
    vtFree(map->words);
    *map = (vtCausticMap){0};
}

// --------------------------------------------------------------------------------------------------- read

static vtVec3 readSample(const vtCausticMap* map, uint32_t at, bool behind)
{
    const size_t texel = 1 + 2 * (size_t)map->words[0] + 2 * (size_t)at + behind;
    vtVec3 light;
    memcpy(&light, map->words + 4 * texel, sizeof light);
    return light;
}

vtVec3 vtCausticMap_Light(const vtCausticMap* map, uint32_t object, uint32_t triangle, float u, float v,
                          bool behind)
{
    vtVec3 light = {0.0f, 0.0f, 0.0f};
    if (map->words == NULL) {
        return light;
    }
    const uint32_t mask = map->words[0] - 1;
    uint32_t slot = vtCausticHash(object, triangle) & mask;
    const uint32_t* head = map->words + 4 * (1 + 2 * (size_t)slot);
    for (int i = 1; i < VT_CAUSTIC_PROBES && head[0] != 0 && (head[0] != object + 1 || head[1] != triangle);
         ++i) {
        slot = (slot + 1) & mask;
        head = map->words + 4 * (1 + 2 * (size_t)slot);
    }
    if (head[0] != object + 1 || head[1] != triangle) {
        return light;
    }
    int32_t at[3][2];
    float weights[3];
    vtCausticSamples(head[2], u, v, at, weights);
    const int32_t width = (int32_t)head[6], height = (int32_t)head[7];
    for (int k = 0; k < 3; ++k) {
        uint32_t sample = head[4 + (at[k][0] == 1 ? 1 : at[k][1] == 1 ? 2 : 0)];
        if (head[2] > 1) {
            const int32_t x = at[k][0] - (int32_t)head[4], y = at[k][1] - (int32_t)head[5];
            if (x < 0 || y < 0 || x >= width || y >= height) {
                continue;
            }
            sample = head[3] + (uint32_t)(y * width + x);
        }
        light = vtMulAdd(light, weights[k], readSample(map, sample, behind));
    }
    return light;
}
