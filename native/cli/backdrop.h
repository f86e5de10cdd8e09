// What is behind a traced scene, as background.glsl has it behind a drawn one.
#pragma once

#include "cli/load.h"
#include "scene/camera.h"

typedef struct vtBackdrop {
    const vtFrame* frame;
    vtCamera camera;
    vtEnvironment blurred; ///< of vt_backgroundBlurred
    const vtImage* picture;
    float exposure; ///< factor on light
} vtBackdrop;

/// Of a frame whose background is not the environment. Fails with vt_errorMemory.
vtResult vtMakeBackdrop(const vtInput* input, const vtFrame* frame, vtBackdrop* backdrop, vtError* error);
void vtDestroyBackdrop(vtBackdrop* backdrop);

/// A pixel as it is shown, sRGB with straight alpha, or linear light by frame->linear: `light`, linear,
/// covers that share of it.
void vtBackdrop_Show(const vtBackdrop* backdrop, int column, int row, vtVec3 light, float share, float* rgba);
