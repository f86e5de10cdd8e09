// What is written into the records of a hierarchy: grid, boxes, cones, corners. Layout: scene/hierarchy.h.
#pragma once

#include <string.h>

#include "base/math.h"
#include "base/space.h"
#include "mesh/hierarchy.h"
#include "shaders_es3/common/constants.h"

/// Axis-parallel; empty where low > high.
typedef struct vtBox {
    float low[3], high[3];
} vtBox;

/// All unit normals n with n . axis >= cosine. Cosine at most 0: any direction.
typedef struct vtCone {
    float axis[3];
    float cosine;
} vtCone;

/// Where the steps of boxes lie, in the mesh's own space.
typedef struct vtGrid {
    vtSpace space;
    float low[3], scale[3];
} vtGrid;

/// A vertex in the grid's space.
static inline void vtGrid_Enter(const vtGrid* grid, const float* p, float* own)
{
    const vtVec3 o = grid->space.origin;
    const float unit = grid->space.unit;
    own[0] = (p[0] - o.x) * unit;
    own[1] = (p[1] - o.y) * unit;
    own[2] = (p[2] - o.z) * unit;
}

static inline float vtLesser(float a, float b)
{
    return a < b ? a : b;
}

static inline float vtGreater(float a, float b)
{
    return a > b ? a : b;
}

static inline void vtBox_Clear(vtBox* box)
{
    for (int k = 0; k < 3; ++k) {
        box->low[k] = HUGE_VALF;
        box->high[k] = -HUGE_VALF;
    }
}

static inline void vtBox_Grow(vtBox* box, const float* low, const float* high)
{
    for (int k = 0; k < 3; ++k) {
        box->low[k] = vtLesser(low[k], box->low[k]);
        box->high[k] = vtGreater(high[k], box->high[k]);
    }
}

/// Half the area of the surface; 0 for an empty box.
static inline float vtBox_HalfArea(const vtBox* box)
{
    const float x = box->high[0] - box->low[0], y = box->high[1] - box->low[1],
                z = box->high[2] - box->low[2];
    return x < 0.0f ? 0.0f : x * y + y * z + z * x;
}

/// Writes the unit normal of a counter-clockwise triangle; zeros and false where it has no area.
static inline bool vtUnitNormal(const float* a, const float* b, const float* c, float* normal)
{
    double u[3], v[3]; // in double, so that slivers keep a direction and small ones an area
    for (int k = 0; k < 3; ++k) {
        u[k] = (double)b[k] - (double)a[k];
        v[k] = (double)c[k] - (double)a[k];
    }
    const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    const double square = x * x + y * y + z * z;
    const double scale = square > 0.0 ? 1.0 / sqrt(square) : 0.0;
    normal[0] = (float)(x * scale);
    normal[1] = (float)(y * scale);
    normal[2] = (float)(z * scale);
    return square > 0.0;
}

/// The grid of a mesh whose box is given.
static inline vtGrid vtMakeGrid(const vtBox* box)
{
    vtGrid grid = {.space = vtSpaceOfBox(vtMakeVec3(box->low), vtMakeVec3(box->high))};
    float low[3], high[3], extent[3], square = 0.0f;
    vtGrid_Enter(&grid, box->low, low);
    vtGrid_Enter(&grid, box->high, high);
    for (int k = 0; k < 3; ++k) {
        extent[k] = high[k] - low[k];
        square += extent[k] * extent[k];
    }
    const float least = vtGreater(1e-4f * sqrtf(square), 1e-30f); // also where all lies at one point
    for (int k = 0; k < 3; ++k) {
        grid.scale[k] = 4094.0f / vtGreater(extent[k], least);
        grid.low[k] = low[k] - 1.0f / grid.scale[k];
    }
    return grid;
}

static inline void vtHierarchy_SetGrid(vtHierarchy* hierarchy, const vtGrid* grid)
{
    hierarchy->space = grid->space;
    hierarchy->gridLow = vtMakeVec3(grid->low);
    hierarchy->gridScale = vtMakeVec3(grid->scale);
}

/// Three signed bytes, 1/21 each, for one a word; see vtHierarchy.
void vtCone_Pack(const vtCone* cone, uint32_t bytes[3]);

static inline bool vtRecord_IsLeaf(const uint32_t* record)
{
    return record[15] != VT_NO_NORMAL;
}

/// The words x, y, z of a child. `box` is in the grid's space.
void vtWriteChild(const vtGrid* grid, const vtBox* box, const vtCone* cone, uint32_t* texel);
/// A whole leaf from its four vertices. `normals`: packed, by vertex.
void vtWriteLeaf(const vtGrid* grid, const float* positions, const uint32_t* normals,
                 const uint32_t corners[4], uint32_t* record);
