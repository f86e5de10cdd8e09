// This work is based on:
//   Tomas Moller, Ben Trumbore. Fast, Minimum Storage Ray/Triangle Intersection. 1997.
// Halved at the middle triangle along the longest axis: no surface area heuristic, since few rays are traced.
#include "scene/bvh.h"

#include <float.h>
#include <stdlib.h>

#include "base/math.h"

enum { leafSize = 4, stackSize = 64 };

typedef struct Node {
    vtVec3 low, high;
    uint32_t first, count; // triangles of a leaf; count 0: children are the next node and `first`
} Node;

struct vtBvh {
    const vtMesh* mesh;
    Node* nodes;
    uint32_t nodeCount;
    uint32_t* triangles;
    vtVec3* centres; // of the triangles; only while building
};

static vtVec3 corner(const vtMesh* mesh, uint32_t triangle, int k)
{
    return vtMakeVec3(mesh->positions + 3 * (size_t)mesh->indices[3 * (size_t)triangle + (size_t)k]);
}

static float axisOf(vtVec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static void grow(vtVec3* low, vtVec3* high, vtVec3 p)
{
    *low = (vtVec3){fminf(low->x, p.x), fminf(low->y, p.y), fminf(low->z, p.z)};
    *high = (vtVec3){fmaxf(high->x, p.x), fmaxf(high->y, p.y), fmaxf(high->z, p.z)};
}

/// Hoare's selection: afterwards the `middle` lowest centres along the axis come first.
static void partition(const vtBvh* tree, uint32_t* items, uint32_t count, uint32_t middle, int axis)
{
    uint32_t left = 0, right = count - 1;
    while (left < right) {
        float pivot = axisOf(tree->centres[items[(left + right) / 2]], axis);
        uint32_t i = left, j = right;
        for (;;) {
            while (axisOf(tree->centres[items[i]], axis) < pivot) {
                ++i;
            }
            while (axisOf(tree->centres[items[j]], axis) > pivot) {
                --j;
            }
            if (i >= j) {
                break;
            }
            uint32_t swapped = items[i];
            items[i++] = items[j];
            items[j--] = swapped;
        }
        if (middle <= j) {
            right = j;
        } else {
            left = j + 1;
        }
    }
}

static uint32_t build(vtBvh* tree, uint32_t first, uint32_t count)
{
    uint32_t index = tree->nodeCount++;
    Node node = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}, first, count};
    vtVec3 low = node.low, high = node.high; // of the centres
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t triangle = tree->triangles[first + i];
        grow(&low, &high, tree->centres[triangle]);
        for (int k = 0; k < 3; ++k) {
            grow(&node.low, &node.high, corner(tree->mesh, triangle, k));
        }
    }
    if (count > leafSize) {
        vtVec3 extent = vtSub(high, low);
        int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        uint32_t half = count / 2;
        partition(tree, tree->triangles + first, count, half, axis);
        node.count = 0;
        build(tree, first, half);
        node.first = build(tree, first + half, count - half);
    }
    tree->nodes[index] = node;
    return index;
}

static bool meetsBox(const Node* node, vtVec3 origin, vtVec3 inverse, float nearest)
{
    float x0 = (node->low.x - origin.x) * inverse.x, x1 = (node->high.x - origin.x) * inverse.x;
    float y0 = (node->low.y - origin.y) * inverse.y, y1 = (node->high.y - origin.y) * inverse.y;
    float z0 = (node->low.z - origin.z) * inverse.z, z1 = (node->high.z - origin.z) * inverse.z;
    float enter = fmaxf(fmaxf(fminf(x0, x1), fminf(y0, y1)), fmaxf(fminf(z0, z1), 0.0f));
    float leave = fminf(fminf(fmaxf(x0, x1), fmaxf(y0, y1)), fminf(fmaxf(z0, z1), nearest));
    return enter <= leave * 1.000001f;
}

/// True where the ray meets the triangle from the wanted side, nearer than *hit and beyond `start`.
static bool meetsTriangle(const vtMesh* mesh, uint32_t triangle, vtVec3 origin, vtVec3 direction, float start,
                          bool leaving, vtBvhHit* hit)
{
    vtVec3 a = corner(mesh, triangle, 0);
    vtVec3 e1 = vtSub(corner(mesh, triangle, 1), a), e2 = vtSub(corner(mesh, triangle, 2), a);
    float facing = vtDot(vtCross(e1, e2), direction);
    if (leaving ? facing <= 0.0f : facing >= 0.0f) {
        return false;
    }
    vtVec3 p = vtCross(direction, e2), s = vtSub(origin, a), q = vtCross(s, e1);
    float determinant = vtDot(e1, p);
    float u = vtDot(s, p) / determinant, v = vtDot(direction, q) / determinant,
          t = vtDot(e2, q) / determinant;
    bool inside = u >= -1e-5f && v >= -1e-5f && u + v <= 1.00001f;
    if (!inside || !(t > start) || t >= hit->distance) {
        return false;
    }
    *hit = (vtBvhHit){t, triangle, u, v};
    return true;
}

bool vtBvh_Trace(const vtBvh* bvh, vtVec3 origin, vtVec3 direction, float start, bool leaving, vtBvhHit* hit)
{
    vtVec3 inverse = {1.0f / direction.x, 1.0f / direction.y, 1.0f / direction.z};
    uint32_t stack[stackSize], depth = 0; // halving keeps the depth below 32
    bool found = false;
    hit->distance = FLT_MAX;
    stack[depth++] = 0;
    while (depth > 0) {
        uint32_t index = stack[--depth];
        const Node* node = &bvh->nodes[index];
        if (!meetsBox(node, origin, inverse, hit->distance)) {
            continue;
        }
        if (node->count == 0) {
            stack[depth++] = node->first;
            stack[depth++] = index + 1;
        }
        for (uint32_t i = 0; i < node->count; ++i) {
            found |= meetsTriangle(bvh->mesh, bvh->triangles[node->first + i], origin, direction, start,
                                   leaving, hit);
        }
    }
    return found;
}

void vtDestroyBvh(vtBvh* bvh)
{
    if (bvh != NULL) {
        free(bvh->nodes);
        free(bvh->triangles);
        free(bvh->centres);
        free(bvh);
    }
}

vtBvh* vtCreateBvh(const vtMesh* mesh)
{
    uint32_t count = mesh->indexCount / 3;
    vtBvh* bvh = calloc(1, sizeof *bvh);
    if (bvh == NULL) {
        return NULL;
    }
    bvh->mesh = mesh;
    bvh->nodes = malloc(2 * (size_t)count * sizeof *bvh->nodes);
    bvh->triangles = malloc(count * sizeof *bvh->triangles);
    bvh->centres = malloc(count * sizeof *bvh->centres);
    if (bvh->nodes == NULL || bvh->triangles == NULL || bvh->centres == NULL) {
        vtDestroyBvh(bvh);
        return NULL;
    }
    for (uint32_t i = 0; i < count; ++i) {
        bvh->triangles[i] = i;
        vtVec3 sum = vtAdd(vtAdd(corner(mesh, i, 0), corner(mesh, i, 1)), corner(mesh, i, 2));
        bvh->centres[i] = vtScale(sum, 1.0f / 3.0f);
    }
    build(bvh, 0, count);
    free(bvh->centres);
    bvh->centres = NULL;
    return bvh;
}
