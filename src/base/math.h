// Three-component vectors, all that the core needs of linear algebra on the CPU.
#pragma once

#include <math.h>

#include "vitrine.h"

#define VT_PI 3.14159265358979323846f

static inline vtVec3 vtAdd(vtVec3 a, vtVec3 b)
{
    return (vtVec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline vtVec3 vtSub(vtVec3 a, vtVec3 b)
{
    return (vtVec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline vtVec3 vtScale(vtVec3 a, float s)
{
    return (vtVec3){a.x * s, a.y * s, a.z * s};
}

/// Component by component.
static inline vtVec3 vtMultiply(vtVec3 a, vtVec3 b)
{
    return (vtVec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

/// a + s * b
static inline vtVec3 vtMulAdd(vtVec3 a, float s, vtVec3 b)
{
    return (vtVec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

/// Share t of b, the rest of a.
static inline vtVec3 vtMix(vtVec3 a, vtVec3 b, float t)
{
    return vtMulAdd(vtScale(a, 1.0f - t), t, b);
}

static inline float vtDot(vtVec3 a, vtVec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vtVec3 vtCross(vtVec3 a, vtVec3 b)
{
    return (vtVec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline float vtLength(vtVec3 a)
{
    return sqrtf(vtDot(a, a));
}

/// The unit vector along a, or the zero vector where a has no length.
static inline vtVec3 vtNormalize(vtVec3 a)
{
    float length = vtLength(a);
    return length > 0.0f ? vtScale(a, 1.0f / length) : (vtVec3){0.0f, 0.0f, 0.0f};
}

/// As vtNormalize, but of any finite length: its square may be more or less than floats can be.
static inline vtVec3 vtNormalizeAny(vtVec3 a)
{
    int exponent;
    (void)frexpf(fmaxf(fabsf(a.x), fmaxf(fabsf(a.y), fabsf(a.z))), &exponent);
    return vtNormalize((vtVec3){ldexpf(a.x, -exponent), ldexpf(a.y, -exponent), ldexpf(a.z, -exponent)});
}

static inline float vtClamp(float x, float low, float high)
{
    return x < low ? low : x > high ? high : x;
}

/// Fractional part towards minus infinity, as GLSL's fract.
static inline float vtFract(float x)
{
    return x - floorf(x);
}

static inline vtVec3 vtMakeVec3(const float* p)
{
    return (vtVec3){p[0], p[1], p[2]};
}
