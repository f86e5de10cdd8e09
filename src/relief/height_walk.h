// A ray's way over the cells of a relief's front. For height_trace.c alone.
#pragma once

#include "relief/height_trace.h"

typedef struct vtHeightRay {
    float x, y, z; ///< origin; x and y counted in cells from column 0, row 0
    float dx, dy, dz;
    float inverseX, inverseY, inverseZ;  ///< of dx, dy and dz; where these are 0 a number that leads far away
    float inverseDiagonal;               ///< of dx - dy; 0 where that is
    int forwardX, forwardY;              ///< 1: towards greater columns, rows
    float slackX, slackY, slackDiagonal; ///< what rounding adds to distances of edges
    float margin;                        ///< more than rounding adds to heights
    float near, far;                     ///< surfaces count between these
    float boxFirst, boxLast;             ///< what of it lies in the box of the heights
    float first, last;                   ///< those of the front can only lie between these
    int sides;
} vtHeightRay;

/// Where on the ray.
typedef struct vtHeightWalk {
    float t;
    int column, row; ///< the cell
    bool crossedX;   ///< it was entered from a neighbouring column, not row
    bool atCell;     ///< after the walk: column and row are those of the last cell looked at
} vtHeightWalk;

static inline float vtHeightRay_X(const vtHeightRay* ray, float t)
{
    return ray->x + t * ray->dx;
}

static inline float vtHeightRay_Y(const vtHeightRay* ray, float t)
{
    return ray->y + t * ray->dy;
}

static inline float vtHeightRay_Z(const vtHeightRay* ray, float t)
{
    return ray->z + t * ray->dz;
}

/// One instruction each, which fminf and fmaxf are not; the second where one is NaN.
static inline float vtLesser(float a, float b)
{
    return a < b ? a : b;
}

static inline float vtGreater(float a, float b)
{
    return a > b ? a : b;
}

/// x, or the bound that it is beyond; NaN gives the lower one.
static inline float vtWithin(float x, float low, float high)
{
    return vtLesser(vtGreater(x, low), high);
}

/// Height of the edge between two samples; `at`: share of the way, which rounding may have carried beyond
/// either.
static inline float vtEdgeHeight(float from, float to, float at)
{
    return from + vtWithin(at, 0.0f, 1.0f) * (to - from);
}

/// Puts the walk into the cell that the ray is over at `t`, as if it had come to it from a neighbour.
vtHeightWalk vtEnterCell(const vtHeightField* field, const vtHeightRay* ray, float t);

/// Goes on to the first surface of the front. False where there is none before ray->last.
bool vtHeightWalk_Find(vtHeightWalk* walk, const vtHeightField* field, const vtHeightRay* ray,
                       unsigned separations, vtHeightHit* hit);

/// The same without the shadow: every cell there is.
bool vtFindAmongAllCells(const vtHeightField* field, const vtHeightRay* ray, unsigned separations,
                         vtHeightHit* hit);

/// The same for a ray along z.
bool vtFindAlongZ(const vtHeightField* field, const vtHeightRay* ray, vtHeightHit* hit);
