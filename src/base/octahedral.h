// Unit vectors in 32 bits: the twin of shaders_es3/common/octahedral.glsl.
#pragma once

#include "base/math.h"

/// The unit vector of a point in that square, numbers of steps from -32767 to 32767.
static inline vtVec3 vtUnfoldNormal(float stepsX, float stepsY)
{
    float x = stepsX / 32767.0f, y = stepsY / 32767.0f;
    const float z = 1.0f - fabsf(x) - fabsf(y), fold = z < 0.0f ? -z : 0.0f;
    x += x >= 0.0f ? -fold : fold;
    y += y >= 0.0f ? -fold : fold;
    return vtNormalize((vtVec3){x, y, z});
}

// The search of four codes: Cigolle et al., A Survey of Efficient Representations for Independent Unit
// Vectors, 2014.

/// Folds the octahedron |x| + |y| + |z| = 1 into a square: x in the low 16 bits, y in the high ones.
/// `normal`: of any length but zero.
static inline uint32_t vtPackNormal(const float* normal)
{
    float size = fabsf(normal[0]) + fabsf(normal[1]) + fabsf(normal[2]);
    float x = normal[0] / size, y = normal[1] / size;
    if (normal[2] < 0.0f) {
        float folded = (1.0f - fabsf(y)) * (x >= 0.0f ? 1.0f : -1.0f);
        y = (1.0f - fabsf(x)) * (y >= 0.0f ? 1.0f : -1.0f);
        x = folded;
    }
    // Of the four codes around it the nearest: the map is not even, and rounding would not find it.
    const float left = vtClamp(floorf(x * 32767.0f), -32767.0f, 32766.0f);
    const float low = vtClamp(floorf(y * 32767.0f), -32767.0f, 32766.0f);
    const vtVec3 unit = vtNormalize(vtMakeVec3(normal));
    float least = 8.0f;
    uint32_t code = 0;
    for (int i = 0; i < 4; ++i) {
        const float a = left + (float)(i & 1), b = low + (float)(i >> 1);
        const vtVec3 apart = vtSub(vtUnfoldNormal(a, b), unit);
        const float square = vtDot(apart, apart);
        code = square < least ? ((uint32_t)(int32_t)a & 0xffffu) | (uint32_t)(int32_t)b << 16 : code;
        least = square < least ? square : least;
    }
    return code;
}
