#pragma once

#include "gl/program.h"
#include "gl/scene_buffer.h"
#include "passes/cube.h"
#include "passes/refract.h"

typedef struct vtShadeProgram {
    GLuint name;
    GLint branch, branches;
} vtShadeProgram;

/// Turns paths into light: the environment, opaque surfaces and reflections.
typedef struct vtShadePass {
    vtShadeProgram programs[2][2]; ///< by whether there is something opaque, and a first surface; compiled
                                   ///< when first used
    GLuint framebuffers[2];
    vtTexture environment;  ///< RGB16F equirectangular, linear; one texel where the environment is built in
    vtEnvironment light;    ///< the same for opaque surfaces, which are lit by it; small
    vtTexture lighting;     ///< RGBA16F, gl/lighting_texture.h; made when first used
    vtTexture radiances[2]; ///< RG32UI, four halves: linear light after exposure, share of the pixel it
                            ///< covers; in turns
} vtShadePass;

typedef struct vtShadeInputs {
    const vtPathTargets* paths;
    int branch;               ///< 0: the pixels' own; else their light is added to what there is
    int branches;             ///< that are still to come
    const vtTexture* surface; ///< NULL: the technique has no first surface
    const vtSceneBuffer* scene;
    const vtCubePass* cube; ///< what is opaque is searched in its layers
} vtShadeInputs;

vtResult vtShadePass_Create(vtShadePass* pass, const vtGL* gl, vtError* error);
vtResult vtShadePass_SetEnvironment(vtShadePass* pass, const vtGL* gl, const vtEnvironment* environment,
                                    vtError* error);
/// Sizes the target and compiles the program; does nothing where both are there.
vtResult vtShadePass_Prepare(vtShadePass* pass, const vtGL* gl, int width, int height, bool opaque,
                             bool surface, bool branches, vtError* error);
void vtShadePass_Draw(const vtShadePass* pass, const vtGL* gl, const vtShadeInputs* inputs);
/// The light after the drawing of that branch.
const vtTexture* vtShadePass_Light(const vtShadePass* pass, int branch);
void vtShadePass_Destroy(vtShadePass* pass, const vtGL* gl);
size_t vtShadePass_Bytes(const vtShadePass* pass);
