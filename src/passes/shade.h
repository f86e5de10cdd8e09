#pragma once

#include "gl/program.h"
#include "gl/scene_buffer.h"
#include "passes/cube.h"
#include "passes/refract.h"

/// Turns paths into light: the environment, opaque surfaces and reflections.
typedef struct vtShadePass {
    GLuint programs[2][2]; ///< by whether there is something opaque, and a first surface; compiled when first
                           ///< used
    GLuint framebuffer;
    vtTexture environment; ///< RGB16F equirectangular, linear; one texel where the environment is built in
    vtEnvironment light;   ///< the same for opaque surfaces, which are lit by it; small
    vtTexture lighting;    ///< RGBA16F, gl/lighting_texture.h; made when first used
    vtTexture radiance;    ///< RG32UI, four halves: linear light after exposure, share of the pixel it covers
} vtShadePass;

typedef struct vtShadeInputs {
    const vtPathTargets* paths;
    const vtTexture* surface; ///< NULL: the technique has no first surface
    const vtSceneBuffer* scene;
    const vtCubePass* cube; ///< what is opaque is searched in its layers
} vtShadeInputs;

vtResult vtShadePass_Create(vtShadePass* pass, const vtGL* gl, vtError* error);
vtResult vtShadePass_SetEnvironment(vtShadePass* pass, const vtGL* gl, const vtEnvironment* environment,
                                    vtError* error);
/// Sizes the target and compiles the program; does nothing where both are there.
vtResult vtShadePass_Prepare(vtShadePass* pass, const vtGL* gl, int width, int height, bool opaque,
                             bool surface, vtError* error);
void vtShadePass_Draw(const vtShadePass* pass, const vtGL* gl, const vtShadeInputs* inputs);
void vtShadePass_Destroy(vtShadePass* pass, const vtGL* gl);
size_t vtShadePass_Bytes(const vtShadePass* pass);
