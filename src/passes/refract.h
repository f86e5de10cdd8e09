#pragma once

#include "gl/program.h"
#include "gl/scene_buffer.h"
#include "gl/target.h"
#include "technique/technique.h"

/// What becomes of every pixel's path (write_path.glsl); RGBA32UI each.
typedef struct vtPathTargets {
    vtTexture paths;  ///< the bits of the last direction (three floats), state (VT_PATH_...)
    vtTexture ends;   ///< the bits of the last position (three floats), triangle it ends on
    vtTexture lights; ///< halves: transmittance, share aside or light added (red, green, blue each); object
                      ///< it ends on
    vtTexture asides; ///< light that left the path: where (the bits of three floats), direction
} vtPathTargets;

/// Sets of targets: the pixels' own paths; a second one for objects in order, which read the paths so far
/// from one and write the other, the last object the first.
#define VT_PATH_SETS 2

/// Follows every pixel's path through layers with one technique of the ladder.
typedef struct vtRefractPass {
    const vtProgram* program; ///< of the frame
    GLuint framebuffers[VT_PATH_SETS];
    GLuint glassFramebuffer; ///< of the first, with the surface pass's depth: only pixels that see glass are
                             ///< drawn
    vtPathTargets targets[VT_PATH_SETS];
} vtRefractPass;

/// What a technique may read; those it needs must exist.
typedef struct vtRefractInputs {
    const vtTexture* surface;
    const vtTexture* innerDistances;
    const vtTexture* layerDepths;
    const vtTexture* layerNormals;
    const vtTexture* mergedDepths;
    const vtSceneBuffer* scene;
} vtRefractInputs;

void vtRefractPass_Start(vtRefractPass* pass, const vtGL* gl, vtTechnique technique, vtVariant variant,
                         bool countReads, vtProgramList* programs);
/// surfaceDepth: of the surface pass, of the same size; NULL for a technique that has no use of it.
/// sets: of targets, 1 to VT_PATH_SETS.
vtResult vtRefractPass_Resize(vtRefractPass* pass, const vtGL* gl, int width, int height, int sets,
                              const vtTexture* surfaceDepth, vtError* error);
void vtRefractPass_Draw(const vtRefractPass* pass, const vtGL* gl, vtTechnique technique,
                        const vtRefractInputs* inputs);
/// One after the other: clears the paths that the first of so many objects goes on from, then each of them,
/// `left` more to come after it. Two sets of targets are needed.
void vtRefractPass_ClearOrdered(const vtRefractPass* pass, const vtGL* gl, uint32_t count);
void vtRefractPass_DrawOrdered(const vtRefractPass* pass, const vtGL* gl, const vtRefractInputs* inputs,
                               uint32_t object, uint32_t left);
void vtRefractPass_Destroy(vtRefractPass* pass, const vtGL* gl);
size_t vtRefractPass_Bytes(const vtRefractPass* pass);
