// This work is based on:
//   Ingo Wald, Solomon Boulos, Peter Shirley. Ray Tracing Deformable Scenes Using Dynamic Bounding Volume
//   Hierarchies. ACM Transactions on Graphics 26(1), 2007: boxes follow bottom up, the tree stays.
// Departure: cones of normals follow, too, merged from the children's: less tight than those of the builder,
// which looks at all normals below.

#include "base/error.h"
#include "base/octahedral.h"
#include "mesh/hierarchy_record.h"
#include "shaders_es3/common/constants.h"

/// What lies below a record.
typedef struct Bounds {
    vtBox box;    ///< in the grid's space
    vtCone cone;  ///< of the normals; cosine 2: there are none
    float sum[3]; ///< of the normals
} Bounds;

typedef struct Refit {
    vtHierarchy* hierarchy;
    const float* positions;
    vtGrid grid;
    Bounds* bounds;    // by record
    uint32_t* normals; // packed, by vertex
} Refit;

/// A cosine's rounding, to the safe side.
static const float rounding = 4e-7f;

static float dot(const float* a, const float* b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool isLeaf(const vtHierarchy* hierarchy, uint32_t record)
{
    return vtRecord_IsLeaf(hierarchy->records + VT_RECORD_WORDS * (size_t)record);
}

static vtGrid findGrid(const vtHierarchy* hierarchy, const vtMesh* mesh)
{
    vtBox box;
    vtBox_Clear(&box);
    for (uint32_t i = 0; i < hierarchy->recordCount; ++i) {
        const uint32_t* corners = hierarchy->corners + 4 * (size_t)i;
        for (int k = 0; corners[0] != VT_NO_TRIANGLE && k < 4; ++k) {
            const float* p = mesh->positions + 3 * (size_t)corners[k];
            vtBox_Grow(&box, p, p);
        }
    }
    if (box.low[0] > box.high[0]) { // no leaf
        memset(&box, 0, sizeof box);
    }
    return vtMakeGrid(&box);
}

/// The axis along the sum; no normals without a sum.
static void setAxis(Bounds* bounds)
{
    const float length = sqrtf(dot(bounds->sum, bounds->sum));
    bounds->cone.cosine = length > 0.0f ? 1.0f : 0.0f;
    for (int k = 0; k < 3; ++k) {
        bounds->cone.axis[k] = length > 0.0f ? bounds->sum[k] / length : 0.0f;
    }
}

static void refitLeaf(const Refit* refit, uint32_t number)
{
    const uint32_t* corners = refit->hierarchy->corners + 4 * (size_t)number;
    Bounds* here = &refit->bounds[number];
    float p[4][3], n[2][3];
    vtBox_Clear(&here->box);
    for (int i = 0; i < 4; ++i) {
        vtGrid_Enter(&refit->grid, refit->positions + 3 * (size_t)corners[i], p[i]);
        vtBox_Grow(&here->box, p[i], p[i]);
    }
    const bool first = vtUnitNormal(p[0], p[1], p[2], n[0]);
    const bool second = corners[2] != corners[3] && vtUnitNormal(p[0], p[2], p[3], n[1]);
    for (int k = 0; k < 3; ++k) {
        here->sum[k] = (first ? n[0][k] : 0.0f) + (second ? n[1][k] : 0.0f);
    }
    setAxis(here);
    if (first && second) {
        here->cone.cosine = vtLesser(dot(here->cone.axis, n[0]), dot(here->cone.axis, n[1])) - rounding;
    } else if (!first && !second) {
        here->cone.cosine = 2.0f;
    }
    vtWriteLeaf(&refit->grid, refit->positions, refit->normals, corners,
                refit->hierarchy->records + VT_RECORD_WORDS * (size_t)number);
}

/// Cosine of the angle between the axis and the cone's farthest normal.
static float farthestCosine(const float* axis, const vtCone* cone)
{
    const float* a = cone->axis;
    const float cosine = vtLesser(cone->cosine, 1.0f);
    const float x = axis[1] * a[2] - axis[2] * a[1], y = axis[2] * a[0] - axis[0] * a[2],
                z = axis[0] * a[1] - axis[1] * a[0];
    const float sines = (x * x + y * y + z * z) * (1.0f - cosine * cosine);
    return dot(axis, a) * cosine - sqrtf(sines) - rounding;
}

/// Bounds from the children's, whose texels are written.
static void refitNode(const Refit* refit, uint32_t number)
{
    uint32_t* record = refit->hierarchy->records + VT_RECORD_WORDS * (size_t)number;
    Bounds* here = &refit->bounds[number];
    const Bounds* children = refit->bounds + record[3];
    int count = 0;
    bool isEmpty = true, isAny = false;
    vtBox_Clear(&here->box);
    memset(here->sum, 0, sizeof here->sum);
    for (; count < 4 && (record[4 * count] & 0xffffffu) != 4095u; ++count) {
        const Bounds* child = &children[count];
        vtBox_Grow(&here->box, child->box.low, child->box.high);
        vtWriteChild(&refit->grid, &child->box, &child->cone, record + 4 * count);
        isEmpty &= child->cone.cosine > 1.0f;
        isAny |= child->cone.cosine <= 0.0f;
        for (int k = 0; k < 3; ++k) {
            here->sum[k] += child->sum[k];
        }
    }
    setAxis(here);
    if (isEmpty || isAny) {
        here->cone.cosine = isEmpty ? 2.0f : 0.0f;
        return;
    }
    for (int i = 0; i < count && here->cone.cosine > 0.0f; ++i) {
        if (children[i].cone.cosine <= 1.0f) {
            here->cone.cosine =
                vtLesser(farthestCosine(here->cone.axis, &children[i].cone), here->cone.cosine);
        }
    }
}

vtResult vtHierarchy_Refit(vtHierarchy* hierarchy, const vtMesh* mesh, vtError* error)
{
    Refit refit = {.hierarchy = hierarchy, .positions = mesh->positions};
    refit.bounds = vtAllocate(hierarchy->recordCount, sizeof *refit.bounds);
    refit.normals = vtAllocate(mesh->vertexCount, sizeof *refit.normals);
    if (refit.bounds == NULL || refit.normals == NULL) {
        vtFree(refit.bounds);
        vtFree(refit.normals);
        return vtFail(error, vt_errorMemory, "hierarchy: out of memory for %u triangles",
                      mesh->indexCount / 3);
    }
    for (uint32_t i = 0; i < mesh->vertexCount; ++i) {
        refit.normals[i] = vtPackNormal(mesh->normals + 3 * (size_t)i);
    }
    refit.grid = findGrid(hierarchy, mesh);
    double sum = 0.0;
    for (uint32_t i = hierarchy->recordCount; i-- > 0;) {
        if (isLeaf(hierarchy, i)) {
            refitLeaf(&refit, i);
        } else {
            refitNode(&refit, i);
        }
        sum += (double)vtBox_HalfArea(&refit.bounds[i].box);
    }
    const double area = (double)vtBox_HalfArea(&refit.bounds[0].box);
    hierarchy->refitCost = area > 0.0 ? (float)(sum / area) : hierarchy->cost;
    vtHierarchy_SetGrid(hierarchy, &refit.grid);
    vtFree(refit.bounds);
    vtFree(refit.normals);
    return vtSucceed(error);
}

bool vtHierarchy_IsWorn(const vtHierarchy* hierarchy)
{
    return hierarchy->refitCost > 1.5f * hierarchy->cost;
}
