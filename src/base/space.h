// Coordinates of one's own, in which a thing lies about the origin and is about as large as 1: floats lose
// nothing there, and squares and products of lengths neither overflow nor vanish.
#pragma once

#include <math.h>

#include "base/math.h"

/// Farthest that a scene reaches, and that an eye stands, along an axis of the world: sums of squares of such
/// numbers are still floats.
#define VT_MOST_COORDINATE 2e18f
#define VT_FARTHEST_EYE 1e19f

/// A point p of the outer space is (p - origin) * unit here; the unit is a power of two.
typedef struct vtSpace {
    vtVec3 origin;
    float unit;
} vtSpace;

/// The outer space itself.
static inline vtSpace vtOuterSpace(void)
{
    return (vtSpace){{0.0f, 0.0f, 0.0f}, 1.0f};
}

/// About the middle of a box. What is no smaller and no larger than a factor of 4096 keeps its unit.
static inline vtSpace vtSpaceOfBox(vtVec3 low, vtVec3 high)
{
    const vtVec3 middle = vtAdd(vtScale(low, 0.5f), vtScale(high, 0.5f));
    const vtVec3 up = vtSub(high, middle), down = vtSub(middle, low); // one may be 0: the middle is rounded
    const float largest = fmaxf(fmaxf(fmaxf(up.x, down.x), fmaxf(up.y, down.y)), fmaxf(up.z, down.z));
    const bool usual = !(largest > 0.0f) || (largest >= 0x1p-13f && largest <= 0x1p11f);
    const int exponent = usual ? 0 : -1 - ilogbf(largest);
    return (vtSpace){middle, ldexpf(1.0f, exponent < -126 ? -126 : exponent > 126 ? 126 : exponent)};
}

static inline vtVec3 vtSpace_Enter(const vtSpace* space, vtVec3 p)
{
    return vtScale(vtSub(p, space->origin), space->unit);
}

static inline vtVec3 vtSpace_Leave(const vtSpace* space, vtVec3 p)
{
    return vtMulAdd(space->origin, 1.0f / space->unit, p);
}
