// A tree over a scene's objects for the shaders (shaders_es3/exact/object_tree.glsl): boxes in the world,
// depth first, each with the place of what follows when it is passed over.
#pragma once

#include "gl/object_buffer.h"
#include "gl/target.h"
#include "shaders_es3/common/constants.h"

/// Makes the RGBA32UI texture: two texels a node, VT_OBJECT_NODES_A_ROW nodes a row; low corner (bits of
/// three floats) and the node behind its subtree; high corner and the object's number plus one, 0 for an
/// inner node. 2 * count - 1 nodes. Replaces the texture there is. Fails with vt_errorMemory.
vtResult vtObjectTree_Upload(vtTexture* texture, const vtGL* gl, const vtObjectBuffer* objects,
                             uint32_t count, vtError* error);
