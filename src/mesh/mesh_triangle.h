// The triangles of any mesh by their number: of its indices or, of a relief without them, of its heights.
#pragma once

#include "base/math.h"
#include "mesh/height_field.h"

/// Weighted sum of what three corners have; u and v: weights of the second and the third.
static inline vtVec3 vtBlend(const vtVec3 corners[3], float u, float v)
{
    return vtMulAdd(vtMulAdd(vtScale(corners[0], 1.0f - u - v), u, corners[1]), v, corners[2]);
}

/// Those of vtHeightField_Triangle, without the work that normals are.
static inline void vtHeightField_Corners(const vtHeightField* field, uint32_t triangle, vtVec3 corners[3])
{
    if (triangle < vtHeightField_FirstWall(field)) {
        const int cells = field->width - 1, above = (int)(triangle & 1);
        const int column = (int)(triangle / 2) % cells, row = (int)(triangle / 2) / cells;
        corners[0] = vtHeightField_Corner(field, column, row);
        corners[1] = vtHeightField_Corner(field, column + 1, row + above);
        corners[2] = vtHeightField_Corner(field, column + 1 - above, row + 1);
        return;
    }
    const vtReliefTriangle relief = vtHeightField_Triangle(field, triangle);
    for (size_t i = 0; i < 3; ++i) {
        corners[i] = relief.corners[i];
    }
}

static inline void vtHeightField_Normals(const vtHeightField* field, uint32_t triangle, vtVec3 normals[3])
{
    const vtReliefTriangle relief = vtHeightField_Triangle(field, triangle);
    for (size_t i = 0; i < 3; ++i) {
        normals[i] = relief.normals[i];
    }
}

static inline void vtMesh_Corners(const vtMesh* mesh, uint32_t triangle, vtVec3 corners[3])
{
    if (mesh->indexCount == 0) {
        vtHeightField_Corners(mesh->heights, triangle, corners);
        return;
    }
    for (size_t i = 0; i < 3; ++i) {
        corners[i] = vtMakeVec3(mesh->positions + 3 * (size_t)mesh->indices[3 * (size_t)triangle + i]);
    }
}

static inline void vtMesh_Normals(const vtMesh* mesh, uint32_t triangle, vtVec3 normals[3])
{
    if (mesh->indexCount == 0) {
        vtHeightField_Normals(mesh->heights, triangle, normals);
        return;
    }
    for (size_t i = 0; i < 3; ++i) {
        normals[i] = vtMakeVec3(mesh->normals + 3 * (size_t)mesh->indices[3 * (size_t)triangle + i]);
    }
}
