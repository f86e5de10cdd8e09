// The numbers of a frame: what gl/uniforms.h's block holds.
#pragma once

#include "gl/scene_buffer.h"
#include "gl/uniforms.h"
#include "scene/camera.h"

/// Those of a resolved frame, for the pixel's centre.
void vtMakeUniforms(const vtSceneBuffer* scene, const vtFrame* frame, const vtCamera* camera,
                    vtEnvironmentKind environment, vtFrameUniforms* uniforms);

/// Those of one of its samples, the picture's frustum moved to it, and where `movesLayers` that of the
/// layers; `count` samples are in the sum with it. `byChance`: chance chooses what all but the first follow.
vtFrameUniforms vtMoveUniforms(const vtFrameUniforms* frame, int sample, int count, bool movesLayers,
                               bool byChance);
