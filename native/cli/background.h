// What is behind a traced scene, as background.glsl has it behind a drawn one.
#pragma once

#include "cli/load.h"
#include "scene/camera.h"

typedef struct vtTracedBackground {
    const vtFrame* frame;
    vtCamera camera;
    vtEnvironment blurred; ///< of vt_backgroundBlurred
    const vtImage* picture;
    float exposure; ///< factor on light
} vtTracedBackground;

/// Of a frame whose background is not the environment. Fails with vt_errorMemory.
vtResult vtMakeTracedBackground(const vtInput* input, const vtFrame* frame, vtTracedBackground* background,
                                vtError* error);
void vtDestroyTracedBackground(vtTracedBackground* background);

/// A pixel as it is shown, sRGB with straight alpha, or linear light by frame->linear: `light`, linear,
/// covers that share of it.
void vtTracedBackground_Show(const vtTracedBackground* background, int column, int row, vtVec3 light,
                             float share, float* rgba);
