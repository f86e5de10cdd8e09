#pragma once

#include "gl/program.h"
#include "gl/target.h"

/// Turns paths into the picture, or shows a layer or the analysis. The last pass, into the caller's
/// framebuffer.
typedef struct vtPresentPass {
    GLuint program;
    vtTexture environment; ///< RGB16F equirectangular, linear; one texel where the environment is built in
} vtPresentPass;

/// What the picture is made from.
typedef struct vtPresentInputs {
    const vtTexture* paths;
    const vtTexture* light;
    const vtTexture* layerDepths;
    const vtTexture* layerNormals;
} vtPresentInputs;

vtResult vtPresentPass_Create(vtPresentPass* pass, const vtGL* gl, vtError* error);
vtResult vtPresentPass_SetEnvironment(vtPresentPass* pass, const vtGL* gl, const vtEnvironment* environment,
                                      vtError* error);
void vtPresentPass_Draw(const vtPresentPass* pass, const vtGL* gl, const vtPresentInputs* inputs,
                        GLuint framebuffer, int width, int height);
void vtPresentPass_Destroy(vtPresentPass* pass, const vtGL* gl);
