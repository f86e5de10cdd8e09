// Triangles in pairs over a common side, the first step of building a hierarchy.
//
// A triangle, in the order of the mesh, takes the neighbour that is still free over its longest side, since a
// compact pair has its diagonal there. In the first round neighbours share vertices by number; triangles left
// over that have an open side get a second round, in which vertices equal in all bits count as one.

#include "mesh/hierarchy_build.h"
#include "mesh/weld.h"
#include "shaders_es3/common/constants.h"

/// Sides looked at about one vertex: where more meet, pairs are found from the other end or not at all.
enum { mostSides = 64 };

static void readCorner(const vtHierarchyBuild* build, size_t corner, float* position)
{
    vtGrid_Enter(&build->grid, build->mesh->positions + 3 * (size_t)build->mesh->indices[corner], position);
}

static void readTriangle(const vtHierarchyBuild* build, uint32_t triangle, float p[3][3])
{
    for (size_t i = 0; i < 3; ++i) {
        readCorner(build, 3 * (size_t)triangle + i, p[i]);
    }
}

static uint32_t nextCorner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// The vertex at a corner, as this round sees it.
static uint32_t vertexAt(const vtHierarchyBuild* build, uint32_t corner)
{
    const uint32_t vertex = build->mesh->indices[corner];
    return build->welding ? build->welded[vertex] - 1 : vertex;
}

static uint32_t triangleCount(const vtHierarchyBuild* build)
{
    return build->welding ? build->leftCount : build->mesh->indexCount / 3;
}

static uint32_t triangleAt(const vtHierarchyBuild* build, uint32_t i)
{
    return build->welding ? build->left[i] : i;
}

// ---------------------------------------------------------------------------------------- faces, vertices

bool vtPhase_Faces(vtHierarchyBuild* build, int64_t* work)
{
    const uint32_t count = build->mesh->indexCount / 3;
    if (build->cursor == 0) {
        build->faces = vtHierarchyBuild_Allocate(build, count, 3 * sizeof *build->faces);
        build->mates = vtHierarchyBuild_Allocate(build, count, sizeof *build->mates);
        build->others = vtHierarchyBuild_Allocate(build, count, sizeof *build->others);
    }
    if (build->failure != vt_ok) {
        return true;
    }
    for (uint32_t i = vtAdvance(build, count, 1, work); i < build->cursor; ++i) {
        float p[3][3];
        readTriangle(build, i, p);
        const bool hasArea = vtUnitNormal(p[0], p[1], p[2], build->faces + 3 * (size_t)i);
        build->mates[i] = hasArea ? vtMateOpen : vtMateNoArea;
    }
    return build->cursor == count;
}

static uint64_t hashVertex(const vtMesh* mesh, uint32_t vertex)
{
    uint32_t bits[3];
    memcpy(bits, mesh->positions + 3 * (size_t)vertex, sizeof bits);
    return vtMixBits(vtMixBits(bits[0] | (uint64_t)bits[1] << 32) + bits[2]);
}

static bool sameNumbers(const float* numbers, size_t each, uint32_t a, uint32_t b)
{
    return numbers == NULL || memcmp(numbers + each * a, numbers + each * b, each * sizeof *numbers) == 0;
}

static bool sameVertex(const vtMesh* mesh, uint32_t a, uint32_t b)
{
    return sameNumbers(mesh->positions, 3, a, b) && sameNumbers(mesh->normals, 3, a, b) &&
           sameNumbers(mesh->texcoords, 2, a, b) && sameNumbers(mesh->colors, 3, a, b) &&
           sameNumbers(mesh->alphas, 1, a, b) && sameNumbers(mesh->texcoords1, 2, a, b) &&
           sameNumbers(mesh->tangents, 4, a, b);
}

static void weldVertex(vtHierarchyBuild* build, uint32_t vertex)
{
    if (build->welded[vertex] != 0) {
        return;
    }
    size_t slot = (size_t)hashVertex(build->mesh, vertex) & (build->slotCount - 1);
    // Of many different vertices at one place only some are compared.
    for (int tries = 0; build->slots[slot] != 0; slot = (slot + 1) & (build->slotCount - 1), ++tries) {
        if (tries < mostSides && sameVertex(build->mesh, build->slots[slot] - 1, vertex)) {
            build->welded[vertex] = build->slots[slot];
            return;
        }
        if (tries == mostSides) {
            build->welded[vertex] = vertex + 1;
            return;
        }
    }
    build->slots[slot] = build->welded[vertex] = vertex + 1;
}

/// Begins the second round.
bool vtPhase_Weld(vtHierarchyBuild* build, int64_t* work)
{
    if (build->cursor == 0 && build->leftCount > 0) {
        const uint64_t corners = 3 * (uint64_t)build->leftCount;
        const uint32_t vertices = build->mesh->vertexCount;
        build->slotCount = vtTableCapacity(corners < vertices ? (uint32_t)corners : vertices);
        build->slots = vtHierarchyBuild_AllocateZeros(build, build->slotCount, sizeof *build->slots);
        build->welded = vtHierarchyBuild_AllocateZeros(build, vertices, sizeof *build->welded);
    }
    build->welding = true;
    if (build->failure != vt_ok) {
        return true;
    }
    for (uint32_t i = vtAdvance(build, build->leftCount, 1, work); i < build->cursor; ++i) {
        for (size_t k = 0; k < 3; ++k) {
            weldVertex(build, build->mesh->indices[3 * (size_t)build->left[i] + k]);
        }
    }
    if (build->cursor == build->leftCount) {
        vtFree(build->slots);
        build->slots = NULL;
    }
    return build->cursor == build->leftCount;
}

// ------------------------------------------------------------------------------------- sides by vertices

/// Counts the sides that start at each vertex.
bool vtPhase_Count(vtHierarchyBuild* build, int64_t* work)
{
    const uint32_t count = triangleCount(build);
    if (build->cursor == 0) {
        vtFree(build->starts);
        vtFree(build->sides);
        build->starts = vtHierarchyBuild_AllocateZeros(build, (size_t)build->mesh->vertexCount + 1,
                                                       sizeof *build->starts);
        build->sides = vtHierarchyBuild_Allocate(build, count, 3 * sizeof *build->sides);
    }
    if (build->failure != vt_ok) {
        return true;
    }
    for (uint32_t i = vtAdvance(build, count, 2, work); i < build->cursor; ++i) {
        const uint32_t triangle = triangleAt(build, i);
        for (uint32_t k = 0; build->mates[triangle] == vtMateOpen && k < 3; ++k) {
            ++build->starts[vertexAt(build, 3 * triangle + k)];
        }
    }
    return build->cursor == count;
}

/// Each vertex's number becomes where its sides end.
bool vtPhase_Sum(vtHierarchyBuild* build, int64_t* work)
{
    const uint32_t count = build->mesh->vertexCount + 1;
    for (uint32_t i = vtAdvance(build, count, 8, work); i < build->cursor; ++i) {
        build->starts[i] += i > 0 ? build->starts[i - 1] : 0;
    }
    return build->cursor == count;
}

/// Lays the sides down, after which each vertex's number is where they start.
bool vtPhase_Fill(vtHierarchyBuild* build, int64_t* work)
{
    const uint32_t count = triangleCount(build);
    for (uint32_t i = vtAdvance(build, count, 1, work); i < build->cursor; ++i) {
        const uint32_t triangle = triangleAt(build, i);
        for (uint32_t k = 0; build->mates[triangle] == vtMateOpen && k < 3; ++k) {
            const uint32_t corner = 3 * triangle + k;
            const uint32_t at = --build->starts[vertexAt(build, corner)];
            build->sides[at] = (vtSide){vertexAt(build, nextCorner(corner)), corner};
        }
    }
    return build->cursor == count;
}

// ------------------------------------------------------------------------------------------------- mates

static float squareOf(const float* a, const float* b)
{
    float sum = 0.0f;
    for (int k = 0; k < 3; ++k) {
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    }
    return sum;
}

/// Whether one box about both is about as good as two: neither folded nor much larger.
static bool isGoodPair(const vtHierarchyBuild* build, uint32_t a, uint32_t b)
{
    const float *n = build->faces + 3 * (size_t)a, *m = build->faces + 3 * (size_t)b;
    if (n[0] * m[0] + n[1] * m[1] + n[2] * m[2] < 0.0f) {
        return false;
    }
    vtBox boxes[2], both;
    for (int t = 0; t < 2; ++t) {
        float p[3][3];
        readTriangle(build, t == 0 ? a : b, p);
        vtBox_Clear(&boxes[t]);
        for (int k = 0; k < 3; ++k) {
            vtBox_Grow(&boxes[t], p[k], p[k]);
        }
    }
    both = boxes[0];
    vtBox_Grow(&both, boxes[1].low, boxes[1].high);
    return vtBox_HalfArea(&both) <= 1.5f * (vtBox_HalfArea(&boxes[0]) + vtBox_HalfArea(&boxes[1]));
}

/// The corner where another, free triangle's side starts that runs against the one from `corner`; else
/// VT_NO_TRIANGLE, and *isOpen where there is no such side at all.
static uint32_t findFree(const vtHierarchyBuild* build, uint32_t corner, bool* isOpen)
{
    const uint32_t from = vertexAt(build, corner), to = vertexAt(build, nextCorner(corner));
    const uint32_t first = build->starts[to], end = build->starts[to + 1];
    bool met = from == to;
    for (uint32_t i = first; i < end; ++i) {
        if (i - first == mostSides) {
            return VT_NO_TRIANGLE;
        }
        const vtSide side = build->sides[i];
        if (side.end == from && side.corner / 3 != corner / 3) {
            met = true;
            if (build->mates[side.corner / 3] == vtMateOpen) {
                return side.corner;
            }
        }
    }
    *isOpen |= !met;
    return VT_NO_TRIANGLE;
}

/// The triangle's sides, the longest first.
static void sortSides(const vtHierarchyBuild* build, uint32_t triangle, uint32_t order[3])
{
    float p[3][3], lengths[3];
    readTriangle(build, triangle, p);
    for (uint32_t k = 0; k < 3; ++k) {
        lengths[k] = squareOf(p[k], p[(k + 1) % 3]);
        uint32_t at = k;
        for (; at > 0 && lengths[order[at - 1]] < lengths[k]; --at) {
            order[at] = order[at - 1];
        }
        order[at] = k;
    }
}

/// Finds the triangle's mate; without one it stays alone, or in the first round waits for the second.
static void mate(vtHierarchyBuild* build, uint32_t triangle)
{
    bool isOpen = false;
    uint32_t best = VT_NO_TRIANGLE, bestSide = 0, order[3];
    sortSides(build, triangle, order);
    for (uint32_t k = 0; best == VT_NO_TRIANGLE && k < 3; ++k) {
        const uint32_t other = findFree(build, 3 * triangle + order[k], &isOpen);
        if (other != VT_NO_TRIANGLE && isGoodPair(build, triangle, other / 3)) {
            best = other;
            bestSide = order[k];
        }
    }
    if (best != VT_NO_TRIANGLE) {
        build->mates[triangle] = (uint8_t)bestSide;
        build->others[triangle] = best;
        build->mates[best / 3] = vtMateSecond;
    } else if (isOpen && !build->welding) {
        build->left[build->leftCount++] = triangle;
        return;
    } else {
        build->mates[triangle] = vtMateSingle;
    }
    ++build->pairCount;
}

/// Fills mates and others. Of the first round what waits may have found a mate until the second.
bool vtPhase_Mate(vtHierarchyBuild* build, int64_t* work)
{
    const uint32_t count = triangleCount(build);
    if (build->cursor == 0 && !build->welding) {
        build->left = vtHierarchyBuild_Allocate(build, count, sizeof *build->left);
    }
    if (build->failure != vt_ok) {
        return true;
    }
    for (uint32_t i = vtAdvance(build, count, 1, work); i < build->cursor; ++i) {
        const uint32_t triangle = triangleAt(build, i);
        if (build->mates[triangle] == vtMateOpen) {
            mate(build, triangle);
        }
    }
    return build->cursor == count;
}

// ------------------------------------------------------------------------------------------------- pairs

static vtPair makePair(const vtHierarchyBuild* build, uint32_t triangle)
{
    const uint32_t* corners = build->mesh->indices + 3 * (size_t)triangle;
    const uint32_t way = build->mates[triangle];
    const uint32_t side = way == vtMateSingle ? 1 : way; // P2 is where it starts, P0 where it ends
    vtPair pair = {.corners = {corners[(side + 1) % 3], corners[(side + 2) % 3], corners[side]}};
    uint32_t second = triangle;
    pair.corners[3] = pair.corners[2];
    if (way != vtMateSingle) {
        const uint32_t other = build->others[triangle];
        second = other / 3;
        pair.corners[3] = build->mesh->indices[nextCorner(nextCorner(other))];
    }
    memcpy(pair.normals[0], build->faces + 3 * (size_t)triangle, sizeof pair.normals[0]);
    memcpy(pair.normals[1], build->faces + 3 * (size_t)second, sizeof pair.normals[1]);
    return pair;
}

static void freeMates(vtHierarchyBuild* build)
{
    void* all[] = {build->faces, build->mates, build->others, build->starts,
                   build->sides, build->left,  build->welded};
    for (size_t i = 0; i < sizeof all / sizeof *all; ++i) {
        vtFree(all[i]);
    }
    build->faces = NULL;
    build->mates = NULL;
    build->others = build->starts = build->left = build->welded = NULL;
    build->sides = NULL;
}

/// Writes pairs and items.
bool vtPhase_Pairs(vtHierarchyBuild* build, int64_t* work)
{
    const uint32_t count = build->mesh->indexCount / 3;
    if (build->cursor == 0) {
        build->pairs = vtHierarchyBuild_Allocate(build, build->pairCount, sizeof *build->pairs);
        build->items = vtHierarchyBuild_Allocate(build, build->pairCount, sizeof *build->items);
        build->pairCount = 0;
    }
    if (build->failure != vt_ok) {
        return true;
    }
    for (uint32_t i = vtAdvance(build, count, 1, work); i < build->cursor; ++i) {
        if (build->mates[i] > vtMateSingle) {
            continue;
        }
        const uint32_t number = build->pairCount++;
        vtItem* item = &build->items[number];
        build->pairs[number] = makePair(build, i);
        item->pair = number;
        vtBox_Clear(&item->box);
        for (int k = 0; k < 4; ++k) {
            float p[3];
            vtGrid_Enter(&build->grid, build->mesh->positions + 3 * (size_t)build->pairs[number].corners[k],
                         p);
            vtBox_Grow(&item->box, p, p);
        }
    }
    if (build->cursor == count) {
        freeMates(build);
    }
    return build->cursor == count;
}
