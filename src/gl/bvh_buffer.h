#pragma once

#include "gl/target.h"

/// A hierarchy over a mesh's triangles on the GPU (scene/bvh_records.h).
typedef struct vtBvhBuffer {
    vtTexture nodes;     ///< RGBA32UI, two texels a node, VT_BVH_NODES_A_ROW nodes a row
    vtTexture triangles; ///< RGBA32UI, three texels a triangle, VT_BVH_TRIANGLES_A_ROW triangles a row
} vtBvhBuffer;

/// Builds it of the first `count` triangle records of the texture, which are read back: so nothing of the
/// mesh has to be kept for a technique that few use. About 3 us a triangle.
vtResult vtBvhBuffer_Create(vtBvhBuffer* buffer, const vtGL* gl, const vtTexture* triangles, uint32_t count,
                            vtVec3 boundsMin, vtVec3 boundsMax, vtError* error);
void vtBvhBuffer_Destroy(vtBvhBuffer* buffer, const vtGL* gl);
