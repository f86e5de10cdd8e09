// Which layers each object of a frame has, and the table that the shaders read of the objects.
#pragma once

#include "gl/scene_buffer.h"
#include "passes/cube.h"

typedef struct vtLayout {
    vtCubeSlot* slots; ///< one a mesh (and kind of material), or with layers from the eye one an object
    int slotCount;
    uint32_t* words; ///< of the table: VT_OBJECT_...
} vtLayout;

/// Works a resolved frame's layout out. Fails with vt_errorMemory; then *layout is zeroed.
vtResult vtCreateLayout(const vtSceneBuffer* scene, const vtFrame* frame, vtLayout* layout, vtError* error);
/// Are the layers of the one those of the other?
bool vtLayout_SameSlots(const vtLayout* a, const vtLayout* b);
void vtDestroyLayout(vtLayout* layout);
