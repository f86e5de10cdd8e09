// This work is based on:
//   Tomas Moller, Ben Trumbore. Fast, Minimum Storage Ray/Triangle Intersection. 1997.
//   Timo Aila, Samuli Laine. Understanding the Efficiency of Ray Traversal on GPUs. 2009: the nearest child
//   first, the others wait on a stack.
// The walk of the shaders, on the CPU. Departures: siblings wait together, as the number of the first one and
// a bit each, and come in the order of the record; a stack entry is a node's children rather than a child.
#include <assert.h>
#include <float.h>

#include "mesh/hierarchy_record.h"
#include "shaders_es3/common/constants.h"

/// What a ray is while it walks. `steps`: in the steps of boxes.
typedef struct Walk {
    const vtHierarchy* hierarchy;
    vtVec3 origin, direction; ///< in the hierarchy's space
    float steps[3], inverse[3];
    float facing[3]; ///< unit, along the normals that are wanted; 0: all are
    float start;
    int sides;
} Walk;

static Walk makeWalk(const vtHierarchy* hierarchy, vtVec3 origin, vtVec3 direction, float start, int sides)
{
    Walk walk = {.hierarchy = hierarchy, .start = start, .sides = sides};
    direction = walk.direction = vtScale(direction, hierarchy->space.unit);
    walk.origin = vtSpace_Enter(&hierarchy->space, origin);
    const vtVec3 unit = vtNormalize(direction), low = hierarchy->gridLow, scale = hierarchy->gridScale;
    const float o[3] = {walk.origin.x, walk.origin.y, walk.origin.z},
                d[3] = {direction.x, direction.y, direction.z};
    const float l[3] = {low.x, low.y, low.z}, s[3] = {scale.x, scale.y, scale.z};
    const float n[3] = {unit.x, unit.y, unit.z};
    const float turn = sides == 2 ? 1.0f : sides == 1 ? -1.0f : 0.0f;
    for (int k = 0; k < 3; ++k) {
        const float along = d[k] * s[k];
        walk.steps[k] = (o[k] - l[k]) * s[k];
        // Finite, so that a ray along a face of a box is no number times 0.
        walk.inverse[k] = fabsf(along) > 1e-30f ? 1.0f / along : 1e30f;
        walk.facing[k] = n[k] * turn;
    }
    return walk;
}

/// Where the ray enters the child's box; FLT_MAX where it does not, not before `nearest`, or where nothing
/// below faces it.
static float enterChild(const Walk* walk, const uint32_t* texel, float nearest)
{
    float enter = walk->start, leave = nearest, along = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const float low = (float)(texel[k] & 0xfffu), high = (float)((texel[k] >> 12 & 0xfffu) + 1u);
        const float a = (low - walk->steps[k]) * walk->inverse[k];
        const float b = (high - walk->steps[k]) * walk->inverse[k];
        enter = vtGreater(vtLesser(a, b), enter);
        leave = vtLesser(vtGreater(a, b), leave);
        const int byte = (int)(texel[k] >> 24);
        along += (float)(byte < 128 ? byte : byte - 256) * walk->facing[k];
    }
    const bool isChild = (texel[0] & 0xfffu) <= (texel[0] >> 12 & 0xfffu);
    return isChild && enter <= leave && along > -21.0f ? enter : FLT_MAX;
}

static vtVec3 readCorner(const uint32_t* record, int corner)
{
    float p[3];
    memcpy(p, record + 4 * corner, sizeof p);
    return vtMakeVec3(p);
}

/// Updates *hit where one of the leaf's triangles is nearer.
static bool meetPair(const Walk* walk, uint32_t number, vtHierarchyHit* hit)
{
    const uint32_t* record = walk->hierarchy->records + VT_RECORD_WORDS * (size_t)number;
    const vtVec3 a = readCorner(record, 0), s = vtSub(walk->origin, a);
    bool found = false;
    for (int t = 0; t < 2; ++t) {
        const vtVec3 e1 = vtSub(readCorner(record, t + 1), a), e2 = vtSub(readCorner(record, t + 2), a);
        const vtVec3 p = vtCross(walk->direction, e2), q = vtCross(s, e1);
        const float determinant = vtDot(e1, p); // above 0: the ray goes in
        const float u = vtDot(s, p) / determinant, v = vtDot(walk->direction, q) / determinant,
                    distance = vtDot(e2, q) / determinant;
        const bool isWanted =
            (determinant > 0.0f && (walk->sides & 1) != 0) || (determinant < 0.0f && (walk->sides & 2) != 0);
        const bool isInside = u >= -1e-5f && v >= -1e-5f && u + v <= 1.00001f;
        if (isWanted && isInside && distance > walk->start && distance < hit->distance) {
            *hit = (vtHierarchyHit){.distance = distance, .u = u, .v = v, .record = number, .second = t == 1};
            found = true;
        }
    }
    return found;
}

/// The children that the ray enters, a bit each; *nearest is the one it enters first.
static uint32_t enterChildren(const Walk* walk, const uint32_t* record, float farthest, uint32_t* nearest)
{
    uint32_t mask = 0;
    float least = FLT_MAX;
    for (uint32_t k = 0; k < 4; ++k) {
        const float enter = enterChild(walk, record + 4 * k, farthest);
        if (enter < FLT_MAX) {
            mask |= 1u << k;
            if (mask == 1u << k || enter < least) {
                least = enter;
                *nearest = k;
            }
        }
    }
    return mask;
}

static uint32_t lowestBit(uint32_t mask)
{
    return (mask & 1u) != 0 ? 0 : (mask & 2u) != 0 ? 1 : (mask & 4u) != 0 ? 2 : 3;
}

bool vtHierarchy_Trace(const vtHierarchy* hierarchy, vtVec3 origin, vtVec3 direction, float start, int sides,
                       vtHierarchyHit* hit)
{
    const Walk walk = makeWalk(hierarchy, origin, direction, start, sides);
    // A group: number of the first sibling << 4 | those that wait.
    uint32_t stack[VT_HIERARCHY_STACK], depth = 0, group = 0, node = 0;
    bool found = false;
    *hit = (vtHierarchyHit){.distance = FLT_MAX};
    for (;;) {
        const uint32_t* record = hierarchy->records + VT_RECORD_WORDS * (size_t)node;
        uint32_t mask = 0, next = 0;
        if (vtRecord_IsLeaf(record)) {
            found |= meetPair(&walk, node, hit);
        } else {
            mask = enterChildren(&walk, record, hit->distance, &next);
        }
        if (mask != 0) {
            if ((group & 15u) != 0) {
                assert(depth < VT_HIERARCHY_STACK); // what the builder promises
                stack[depth++] = group;
            }
            group = record[3] << 4 | mask;
        } else if ((group & 15u) == 0) {
            if (depth == 0) {
                break;
            }
            group = stack[--depth];
        }
        next = mask != 0 ? next : lowestBit(group);
        node = (group >> 4) + next;
        group &= ~(1u << next);
    }
    if (found) {
        const uint32_t* corners = hierarchy->corners + 4 * (size_t)hit->record;
        const int second = hit->second ? 1 : 0;
        hit->vertices[0] = corners[0];
        hit->vertices[1] = corners[1 + second];
        hit->vertices[2] = corners[2 + second];
    }
    return found;
}

/// Surfaces of those sides on a ray.
static int countSurfaces(const vtHierarchy* hierarchy, vtVec3 origin, vtVec3 direction, float step, int sides)
{
    const int most = 64;
    int count = 0;
    float start = step;
    vtHierarchyHit hit;
    while (count < most && vtHierarchy_Trace(hierarchy, origin, direction, start, sides, &hit)) {
        start = hit.distance * 1.00001f + step;
        ++count;
    }
    return count;
}

static vtVec3 cornerOf(const uint32_t* record, int corner)
{
    float position[3];
    memcpy(position, record + 4 * corner, sizeof position);
    return vtMakeVec3(position);
}

/// A ray outwards from the middle of a leaf's first triangle leaves the mesh more often than it comes in.
static bool isWithin(const vtHierarchy* hierarchy, const uint32_t* record)
{
    const vtVec3 a = cornerOf(record, 0), b = cornerOf(record, 1), c = cornerOf(record, 2),
                 scale = hierarchy->gridScale;
    const vtVec3 middle = vtScale(vtAdd(a, vtAdd(b, c)), 1.0f / 3.0f);
    const vtVec3 normal = vtNormalize(vtCross(vtSub(b, a), vtSub(c, a)));
    const vtVec3 extent = {4094.0f / scale.x, 4094.0f / scale.y, 4094.0f / scale.z};
    // A little aslant: symmetric meshes have edges opposite.
    const vtVec3 direction = vtNormalize(vtAdd(normal, (vtVec3){0.0313f, -0.0171f, 0.0237f}));
    const vtVec3 origin = vtSpace_Leave(&hierarchy->space, middle);
    const float step = 1e-5f * vtLength(extent) / hierarchy->space.unit;
    return countSurfaces(hierarchy, origin, direction, step, 2) >
           countSurfaces(hierarchy, origin, direction, step, 1);
}

bool vtHierarchy_Overlaps(const vtHierarchy* hierarchy)
{
    const uint32_t samples = 256, least = 3; // a ray or two may pass through an edge and miscount
    uint32_t within = 0;
    for (uint32_t i = 0; i < samples; ++i) {
        uint32_t number = (uint32_t)((uint64_t)i * hierarchy->recordCount / samples);
        while (number < hierarchy->recordCount &&
               !vtRecord_IsLeaf(hierarchy->records + VT_RECORD_WORDS * (size_t)number)) {
            ++number;
        }
        within += number < hierarchy->recordCount &&
                  isWithin(hierarchy, hierarchy->records + VT_RECORD_WORDS * (size_t)number);
    }
    return within >= least;
}
