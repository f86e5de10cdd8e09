// This work is based on:
//   Tomas Moller, Ben Trumbore. Fast, Minimum Storage Ray/Triangle Intersection. 1997.
// Halved at the middle triangle along the longest axis: no surface area heuristic, since few rays are traced.
// A relief's pyramid of heights is such a hierarchy already, over triangles that need not be there.
#include "scene/bvh.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/math.h"
#include "scene/height_field.h"

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

typedef struct Ray {
    vtVec3 origin, direction, inverse;
    float start;
    bool leaving;
} Ray;

static bool meetsBox(vtVec3 low, vtVec3 high, const Ray* ray, float nearest)
{
    const vtVec3 origin = ray->origin, inverse = ray->inverse;
    float x0 = (low.x - origin.x) * inverse.x, x1 = (high.x - origin.x) * inverse.x;
    float y0 = (low.y - origin.y) * inverse.y, y1 = (high.y - origin.y) * inverse.y;
    float z0 = (low.z - origin.z) * inverse.z, z1 = (high.z - origin.z) * inverse.z;
    float enter = fmaxf(fmaxf(fminf(x0, x1), fminf(y0, y1)), fmaxf(fminf(z0, z1), 0.0f));
    float leave = fminf(fminf(fmaxf(x0, x1), fmaxf(y0, y1)), fminf(fmaxf(z0, z1), nearest));
    return enter <= leave * 1.000001f;
}

/// True where the ray meets the triangle from the wanted side, nearer than *hit and beyond its start.
static bool meetsTriangle(vtVec3 a, vtVec3 b, vtVec3 c, uint32_t triangle, const Ray* ray, vtBvhHit* hit)
{
    vtVec3 e1 = vtSub(b, a), e2 = vtSub(c, a);
    float facing = vtDot(vtCross(e1, e2), ray->direction);
    if (ray->leaving ? facing <= 0.0f : facing >= 0.0f) {
        return false;
    }
    vtVec3 p = vtCross(ray->direction, e2), s = vtSub(ray->origin, a), q = vtCross(s, e1);
    float determinant = vtDot(e1, p);
    float u = vtDot(s, p) / determinant, v = vtDot(ray->direction, q) / determinant,
          t = vtDot(e2, q) / determinant;
    bool inside = u >= -1e-5f && v >= -1e-5f && u + v <= 1.00001f;
    if (!inside || !(t > ray->start) || t >= hit->distance) {
        return false;
    }
    *hit = (vtBvhHit){t, triangle, u, v};
    return true;
}

static bool meetsRelief(const vtHeightField* field, uint32_t number, const Ray* ray, vtBvhHit* hit)
{
    const vtReliefTriangle triangle = vtHeightField_Triangle(field, number);
    return meetsTriangle(triangle.corners[0], triangle.corners[1], triangle.corners[2], number, ray, hit);
}

static bool traceTile(const vtHeightField* field, int level, int column, int row, const Ray* ray,
                      vtBvhHit* hit)
{
    const int cells = 1 << level, columns = field->width - 1, rows = field->height - 1;
    const int left = column * cells, bottom = row * cells;
    if (left >= columns || bottom >= rows) {
        return false;
    }
    if (level == 0) {
        const uint32_t number = 2 * ((uint32_t)row * (uint32_t)columns + (uint32_t)column);
        const bool below = meetsRelief(field, number, ray, hit);
        return meetsRelief(field, number + 1, ray, hit) || below;
    }
    const vtHeightRange range = vtHeightField_Tile(field, level, column, row);
    const vtVec3 low = {field->left + (float)left * field->cell, field->bottom + (float)bottom * field->cell,
                        range.low};
    const vtVec3 high = {low.x + (float)cells * field->cell, low.y + (float)cells * field->cell, range.high};
    bool found = false;
    for (int i = 0; i < 4 && (i > 0 || meetsBox(low, high, ray, hit->distance)); ++i) {
        found |= traceTile(field, level - 1, 2 * column + (i & 1), 2 * row + (i >> 1), ray, hit);
    }
    return found;
}

/// The wall at the side's `place`-th segment and those beside it, should rounding have taken the wrong one.
static bool traceWall(const vtHeightField* field, int side, float place, const Ray* ray, vtBvhHit* hit)
{
    const int across = field->width - 1, up = field->height - 1, length = side % 2 == 0 ? across : up;
    const int first[4] = {0, across, across + up, 2 * across + up};
    bool found = false;
    for (int i = -1; i <= 1 && place > -2.0f && place < (float)length + 2.0f; ++i) {
        const int segment = (int)floorf(place) + i;
        if (segment >= 0 && segment < length) {
            // Counter-clockwise: two of the sides run backwards.
            const int number = first[side] + (side < 2 ? segment : length - 1 - segment);
            const uint32_t triangle = vtHeightField_FirstWall(field) + 2 * (uint32_t)number;
            found |= meetsRelief(field, triangle, ray, hit);
            found |= meetsRelief(field, triangle + 1, ray, hit);
        }
    }
    return found;
}

static bool traceRelief(const vtMesh* mesh, const Ray* ray, vtBvhHit* hit)
{
    const vtHeightField* field = mesh->heights;
    bool found = traceTile(field, field->levelCount, 0, 0, ray, hit);
    for (int side = 0; side < 4; ++side) {
        const vtVec3 corner = side == 1 || side == 2 ? mesh->boundsMax : mesh->boundsMin;
        const bool isAlongX = side % 2 == 0;
        const float t = isAlongX ? (corner.y - ray->origin.y) * ray->inverse.y
                                 : (corner.x - ray->origin.x) * ray->inverse.x;
        const float place = isAlongX ? ray->origin.x + t * ray->direction.x - field->left
                                     : ray->origin.y + t * ray->direction.y - field->bottom;
        found |= traceWall(field, side, place / field->cell, ray, hit);
    }
    for (uint32_t i = 0; i < 2; ++i) {
        found |= meetsRelief(field, vtHeightField_FirstBack(field) + i, ray, hit);
    }
    return found;
}

bool vtBvh_Trace(const vtBvh* bvh, vtVec3 origin, vtVec3 direction, float start, bool leaving, vtBvhHit* hit)
{
    const Ray ray = {
        origin, direction, {1.0f / direction.x, 1.0f / direction.y, 1.0f / direction.z}, start, leaving};
    const vtMesh* mesh = bvh->mesh;
    hit->distance = FLT_MAX;
    if (mesh->heights != NULL) {
        return traceRelief(mesh, &ray, hit);
    }
    uint32_t stack[stackSize], depth = 0; // halving keeps the depth below 32
    bool found = false;
    stack[depth++] = 0;
    while (depth > 0) {
        uint32_t index = stack[--depth];
        const Node* node = &bvh->nodes[index];
        if (!meetsBox(node->low, node->high, &ray, hit->distance)) {
            continue;
        }
        if (node->count == 0) {
            stack[depth++] = node->first;
            stack[depth++] = index + 1;
        }
        for (uint32_t i = 0; i < node->count; ++i) {
            const uint32_t triangle = bvh->triangles[node->first + i];
            found |= meetsTriangle(corner(mesh, triangle, 0), corner(mesh, triangle, 1),
                                   corner(mesh, triangle, 2), triangle, &ray, hit);
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
    if (mesh->heights != NULL) {
        return bvh;
    }
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
