#pragma once

#include "gl/environment_buffer.h"
#include "gl/host_picture.h"
#include "gl/program.h"
#include "gl/scene_buffer.h"
#include "passes/refract.h"

/// Turns the paths of the techniques that search layers, or blend, into light: the environment, opaque
/// surfaces and reflections.
typedef struct vtShadePass {
    const vtProgram* program; ///< of the frame
    GLuint framebuffer;
    vtTexture
        radiance; ///< RGBA32UI, bits of floats: linear light after exposure, share of the pixel it covers
} vtShadePass;

typedef struct vtShadeInputs {
    const vtPathTargets* paths;
    const vtTexture* surface; ///< NULL: the technique has no first surface
    const vtSceneBuffer* scene;
    const vtEnvironmentBuffer* environment;
    const vtHostPicture* host; ///< without a colour: there is none behind
} vtShadeInputs;

void vtShadePass_Start(vtShadePass* pass, const vtGL* gl, bool opaque, bool surface, bool host,
                       vtProgramList* programs);
vtResult vtShadePass_Resize(vtShadePass* pass, const vtGL* gl, int width, int height, vtError* error);
void vtShadePass_Draw(const vtShadePass* pass, const vtGL* gl, const vtShadeInputs* inputs);
void vtShadePass_Destroy(vtShadePass* pass, const vtGL* gl);
