// One object of a scene on the GPU (scene_buffer.h).
#pragma once

#include "scene/objects.h"

/// One object as it is drawn.
typedef struct vtObjectBuffer {
    vtPlacedObject placed; ///< placed.mesh: counts, box and volume only
    vtMaterial material;
    uint32_t geometry;                  ///< in vtSceneBuffer.geometry.items
    vtVec3 ownMin, ownMax;              ///< the mesh's box in the object's own coordinates
    uint32_t firstAttribute, firstMore; ///< records of its attributes, or VT_NO_TRIANGLE
    uint32_t colorLayer, roughLayer;    ///< of the array of images: its first two maps; or VT_NO_TRIANGLE
    bool bothSides; ///< opaque but for vtMaterial.oneSided, or glass with open edges, parts that overlap or
                    ///< holes (alpha): rays meet its triangles from either side
} vtObjectBuffer;
