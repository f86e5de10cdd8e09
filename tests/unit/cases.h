// Numbers and directions that look random, the same in every run; test_gpu.c makes them in a shader.
#pragma once

#include "base/math.h"

static inline uint32_t hash(uint32_t x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

static inline float unit(uint32_t x)
{
    return (float)(hash(x) >> 8) / 16777216.0f;
}

static inline vtVec3 onSphere(uint32_t x)
{
    float z = 2.0f * unit(x) - 1.0f, a = 6.2831853f * unit(x + 77777u), r = sqrtf(1.0f - z * z);
    return (vtVec3){r * cosf(a), z, r * sinf(a)};
}

/// One path by a tracer of its own.
static inline vtResult tracePath(const vtScene* scene, const vtFrame* frame, float x, float y, vtPath* path,
                                 vtError* error)
{
    vtTracer* tracer;
    vtResult result = vtCreateTracer(scene, &tracer, error);
    if (result == vt_ok) {
        result = vtTracer_Path(tracer, frame, x, y, path, error);
        vtDestroyTracer(tracer);
    }
    return result;
}
