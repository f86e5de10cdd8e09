#pragma once

#include "passes/display.h"

/// Turns light into the picture, or shows a layer or the analysis. The last pass, into the caller's
/// framebuffer.
typedef struct vtPresentPass {
    const vtProgram* program;
    vtDisplay display; ///< of the program
} vtPresentPass;

/// What the picture is made from.
typedef struct vtPresentInputs {
    const vtTexture* paths;
    const vtTexture* radiance;
    const vtTexture* layerDepths;
    const vtTexture* layerNormals;
    vtBehind behind;
} vtPresentInputs;

void vtPresentPass_Start(vtPresentPass* pass, const vtGL* gl, vtDisplay display, vtProgramList* programs);
void vtPresentPass_Draw(const vtPresentPass* pass, const vtGL* gl, const vtPresentInputs* inputs,
                        GLuint framebuffer, int x, int y, int width, int height);
