#pragma once

#include "gl/program.h"
#include "gl/target.h"

/// Turns light into the picture, or shows a layer or the analysis. The last pass, into the caller's
/// framebuffer.
typedef struct vtPresentPass {
    vtProgram program;
} vtPresentPass;

/// What the picture is made from.
typedef struct vtPresentInputs {
    const vtTexture* paths;
    const vtTexture* radiance;
    const vtTexture* layerDepths;
    const vtTexture* layerNormals;
} vtPresentInputs;

void vtPresentPass_Start(vtPresentPass* pass, const vtGL* gl, vtProgramList* programs);
void vtPresentPass_Draw(const vtPresentPass* pass, const vtGL* gl, const vtPresentInputs* inputs,
                        GLuint framebuffer, int x, int y, int width, int height);
void vtPresentPass_Destroy(vtPresentPass* pass, const vtGL* gl);
