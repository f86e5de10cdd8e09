// Meshes that hierarchies of triangle pairs must cope with.
#pragma once

#include "cases.h"
#include "mesh/hierarchy.h"
#include "shapes/shapes.h"
#include "testing.h"

/// Triangles of no index list, 9 floats each.
static inline void makeSoup(const float* positions, uint32_t count, vtMesh* mesh)
{
    vtError error;
    const vtMeshDef def = {.positions = positions, .vertexCount = 3 * count, .indexCount = 3 * count};
    assert_ok(vtCreateMesh(&def, "soup", mesh, &error), error);
}

/// `count` of equal size, in random places of a cube of side 2.
static inline void makeRandom(uint32_t count, float size, vtMesh* mesh)
{
    float* positions = malloc(9 * (size_t)count * sizeof *positions);
    for (uint32_t i = 0; i < 9 * count; ++i) {
        positions[i] = 2.0f * unit(i / 9 * 3 + i % 3) - 1.0f + size * (2.0f * unit(i + 1000000u) - 1.0f);
    }
    makeSoup(positions, count, mesh);
    free(positions);
}

static const float oneTriangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

/// `count` triangles at one place.
static inline void makeCoincident(uint32_t count, vtMesh* mesh)
{
    float* positions = malloc(9 * (size_t)count * sizeof *positions);
    for (uint32_t i = 0; i < 9 * count; ++i) {
        positions[i] = oneTriangle[i % 9];
    }
    makeSoup(positions, count, mesh);
    free(positions);
}

/// Each is smaller by `ratio` than the one before, and nearer to a corner: the heuristic alone makes a list
/// of them. `copies` of each.
static inline void makeShrinking(uint32_t count, float ratio, uint32_t copies, vtMesh* mesh)
{
    float* positions = malloc(9 * (size_t)count * copies * sizeof *positions);
    float size = 1.0f;
    for (uint32_t i = 0; i < count; ++i, size *= ratio) {
        for (uint32_t k = 0; k < 9 * copies; ++k) {
            positions[9 * i * copies + k] = size * (oneTriangle[k % 9] + 1.0f + 0.1f * unit(k / 9));
        }
    }
    makeSoup(positions, count * copies, mesh);
    free(positions);
}

/// Long thin ones, in all directions through the middle.
static inline void makeSlivers(uint32_t count, vtMesh* mesh)
{
    float* positions = malloc(9 * (size_t)count * sizeof *positions);
    for (uint32_t i = 0; i < count; ++i) {
        const vtVec3 d = onSphere(i), side = vtScale(onSphere(i + 500000u), 1e-3f);
        const vtVec3 corners[3] = {d, vtScale(d, -1.0f), vtAdd(vtScale(d, 0.5f), side)};
        for (uint32_t k = 0; k < 3; ++k) {
            positions[9 * i + 3 * k] = corners[k].x;
            positions[9 * i + 3 * k + 1] = corners[k].y;
            positions[9 * i + 3 * k + 2] = corners[k].z;
        }
    }
    makeSoup(positions, count, mesh);
    free(positions);
}

/// The shape without an index list, and with triangles of no area.
static inline void makeUnindexed(const char* shape, vtMesh* mesh)
{
    vtMesh indexed;
    vtError error;
    assert_ok(vtCreateShape(shape, &indexed, &error), error);
    const uint32_t corners = indexed.indexCount, all = corners + 6;
    float* positions = calloc(3 * (size_t)all, sizeof *positions);
    float* normals = calloc(3 * (size_t)all, sizeof *normals);
    for (uint32_t i = 0; i < all; ++i) {
        const size_t from = indexed.indices[i < corners ? i : 0];
        memcpy(positions + 3 * (size_t)i, indexed.positions + 3 * from, 3 * sizeof(float));
        memcpy(normals + 3 * (size_t)i, indexed.normals + 3 * from, 3 * sizeof(float));
    }
    const vtMeshDef def = {.positions = positions, .normals = normals, .vertexCount = all, .indexCount = all};
    assert_ok(vtCreateMesh(&def, "unindexed", mesh, &error), error);
    assert_int_equal(mesh->degenerateCount, indexed.degenerateCount + 2);
    free(positions);
    free(normals);
    vtDestroyMesh(&indexed);
}

/// The shape, moved.
static inline void makeMoved(const char* shape, vtVec3 by, vtMesh* mesh)
{
    vtMesh source;
    vtError error;
    assert_ok(vtCreateShape(shape, &source, &error), error);
    for (uint32_t i = 0; i < source.vertexCount; ++i) {
        source.positions[3 * (size_t)i] += by.x;
        source.positions[3 * (size_t)i + 1] += by.y;
        source.positions[3 * (size_t)i + 2] += by.z;
    }
    const vtMeshDef def = {.positions = source.positions,
                           .normals = source.normals,
                           .indices = source.indices,
                           .vertexCount = source.vertexCount,
                           .indexCount = source.indexCount};
    assert_ok(vtCreateMesh(&def, "moved", mesh, &error), error);
    vtDestroyMesh(&source);
}

enum { hierarchyCaseCount = 17 };

/// By number; the name says what it is.
static inline const char* makeHierarchyCase(int number, vtMesh* mesh)
{
    static const char* const shapes[] = {"sphere", "knot", "goblet", "diamond", "cube", "plane"};
    static const float quad[18] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0};
    static const float nothing[9] = {1, 2, 3, 1, 2, 3, 1, 2, 3};
    vtError error;
    switch (number) {
    case 6:
        makeSoup(oneTriangle, 1, mesh);
        return "one triangle";
    case 7:
        makeSoup(quad, 2, mesh);
        return "flat quad";
    case 8:
        makeUnindexed("torus", mesh);
        return "unindexed torus";
    case 9:
        makeMoved("goblet", (vtVec3){1e5f, -1e5f, 1e5f}, mesh);
        return "far goblet";
    case 10:
        makeRandom(5000, 0.1f, mesh);
        return "random triangles";
    case 11:
        makeCoincident(100000, mesh);
        return "100000 triangles at one place";
    case 12:
        makeShrinking(60, 0.5f, 1, mesh);
        return "shrinking triangles";
    case 13:
        makeShrinking(40, 0.25f, 1000, mesh);
        return "shrinking heaps of triangles";
    case 14:
        makeSlivers(3000, mesh);
        return "slivers";
    case 15:
        makeSoup(nothing, 1, mesh);
        return "no area";
    case 16:
        assert_ok(vtCreateFineShape("knot", 150000, mesh, &error), error);
        return "fine knot";
    default:
        assert_ok(vtCreateShape(shapes[number], mesh, &error), error);
        return shapes[number];
    }
}
