// This work is based on: Morten S. Mikkelsen. Simulation of Wrinkled Surfaces Revisited. 2008: a vertex's
// tangent is the mean of those of its triangles, each laid into the vertex's tangent plane and weighted by
// the angle at the vertex. Departure: a vertex is the file's own; a seam of mirrored texture coordinates that
// shares its vertices is not split, and the side of most of its angle counts.
#include <math.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "mesh/mesh_triangle.h"

/// Along rising u over a triangle, unit; zero where texture coordinates do not say. *side: 1 where the
/// picture is seen the right way round from outside: glTF's v runs down, so that u and v then turn against
/// the surface; -1 where it is mirrored.
static vtVec3 triangleTangent(const vtVec3 p[3], const float* const at[3], float* side)
{
    const vtVec3 e = vtSub(p[1], p[0]), f = vtSub(p[2], p[0]);
    const float u1 = at[1][0] - at[0][0], v1 = at[1][1] - at[0][1];
    const float u2 = at[2][0] - at[0][0], v2 = at[2][1] - at[0][1];
    const float area = u1 * v2 - u2 * v1;
    *side = area > 0.0f ? -1.0f : 1.0f;
    const vtVec3 t = vtScale(vtSub(vtScale(e, v2), vtScale(f, v1)), -*side);
    const float length = vtLength(t);
    return area != 0.0f && length > 0.0f ? vtScale(t, 1.0f / length) : (vtVec3){0.0f, 0.0f, 0.0f};
}

/// The part of v across the unit vector n, unit; zero where there is none.
static vtVec3 across(vtVec3 v, vtVec3 n)
{
    const vtVec3 part = vtMulAdd(v, -vtDot(v, n), n);
    const float length = vtLength(part);
    return length > 1e-12f ? vtScale(part, 1.0f / length) : (vtVec3){0.0f, 0.0f, 0.0f};
}

static void addTriangle(vtMesh* mesh, const float* texcoords, uint32_t triangle)
{
    const uint32_t* corners = mesh->indices + 3 * (size_t)triangle;
    vtVec3 p[3], normals[3];
    float side;
    vtMesh_Corners(mesh, triangle, p);
    vtMesh_Normals(mesh, triangle, normals);
    const float* const at[3] = {texcoords + 2 * (size_t)corners[0], texcoords + 2 * (size_t)corners[1],
                                texcoords + 2 * (size_t)corners[2]};
    const vtVec3 tangent = triangleTangent(p, at, &side);
    for (int i = 0; i < 3; ++i) {
        const vtVec3 n = normals[i], t = across(tangent, n);
        const vtVec3 a = across(vtSub(p[(i + 1) % 3], p[i]), n), b = across(vtSub(p[(i + 2) % 3], p[i]), n);
        const float angle = acosf(vtClamp(vtDot(a, b), -1.0f, 1.0f));
        float* sum = mesh->tangents + 4 * (size_t)corners[i];
        sum[0] += angle * t.x;
        sum[1] += angle * t.y;
        sum[2] += angle * t.z;
        sum[3] += angle * side;
    }
}

vtResult vtComputeTangents(vtMesh* mesh, int texcoords, vtError* error)
{
    if (mesh == NULL) {
        return vtFailMissing(error, "vtComputeTangents", "mesh");
    }
    const float* at = texcoords == 0 ? mesh->texcoords : texcoords == 1 ? mesh->texcoords1 : NULL;
    if (mesh->tangents != NULL || at == NULL) {
        return vtSucceed(error);
    }
    mesh->tangents = vtAllocateZeroed(mesh->vertexCount, 4 * sizeof(float));
    if (mesh->tangents == NULL) {
        return vtFail(error, vt_errorMemory, "mesh: out of memory for the tangents of %u vertices",
                      mesh->vertexCount);
    }
    for (uint32_t i = 0; i < mesh->indexCount / 3; ++i) {
        addTriangle(mesh, at, i);
    }
    for (size_t i = 0; i < mesh->vertexCount; ++i) {
        float* t = mesh->tangents + 4 * i;
        const vtVec3 n = vtMakeVec3(mesh->normals + 3 * i);
        vtVec3 unit = across(vtMakeVec3(t), n);
        if (vtDot(unit, unit) == 0.0f) { // any
            unit = across(fabsf(n.x) < 0.9f ? (vtVec3){1.0f, 0.0f, 0.0f} : (vtVec3){0.0f, 1.0f, 0.0f}, n);
        }
        t[0] = unit.x;
        t[1] = unit.y;
        t[2] = unit.z;
        t[3] = t[3] < 0.0f ? -1.0f : 1.0f;
    }
    return vtSucceed(error);
}
