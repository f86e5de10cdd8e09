// The table that the shaders read of a scene's objects.
#pragma once

#include "gl/scene_buffer.h"
#include "scene/camera.h"

/// Writes scene->fresh: VT_OBJECT_... for a resolved frame, whose view is in the buffer's world.
void vtWriteObjectTable(const vtSceneBuffer* scene, const vtFrame* frame, const vtCamera* camera);
