// A bounding volume hierarchy over triangle records, laid out for a shader: what the technique `bvh` walks.
#pragma once

#include "vitrine.h"

/// Texels of four words each.
typedef struct vtBvhRecords {
    /// Two texels an inner node, one a child: its box in 16-bit steps (VT_BVH_STEPS) as low x, y, z, high x,
    /// y, z, and what it is: the number of an inner node, or with the highest bit set a leaf,
    /// VT_BVH_COUNT_SHIFT parting the number of its triangles from that of its first one. Node 0 is the root.
    uint32_t* nodes;
    /// Three texels a triangle: a corner and the triangle's number in the mesh, then the two edges from there
    /// (the bits of floats) and nothing.
    uint32_t* triangles;
    uint32_t nodeCount, triangleCount;
} vtBvhRecords;

/// Builds the hierarchy of `count` triangle records (scene/triangles.h; at least one) that lie in the given
/// bounds. False where memory is out.
bool vtCreateBvhRecords(const uint32_t* triangles, uint32_t count, vtVec3 boundsMin, vtVec3 boundsMax,
                        vtBvhRecords* records);
void vtDestroyBvhRecords(vtBvhRecords* records);
