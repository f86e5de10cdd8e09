#pragma once

#include "gl/height_texture.h"
#include "gl/program.h"
#include "gl/target.h"
#include "technique.h"

/// What becomes of every pixel's path (path.glsl); RGBA32UI each.
typedef struct vtPathTargets {
    vtTexture paths; ///< the bits of the last direction (three floats), state (VT_PATH_...)
    vtTexture ends;  ///< the bits of the last position (three floats), triangle it ends on
    vtTexture
        lights; ///< halves: transmittance, light added on the way (red, green, blue each); object it ends on
    vtTexture asides; ///< light that left the path: direction, share (three halves)
} vtPathTargets;

#define VT_PATH_SETS 3

/// Follows every pixel's path through the glass with one technique of the ladder.
typedef struct vtRefractPass {
    GLuint programs[vt_techniqueCount][vt_variantCount]; ///< compiled when first used
    GLuint counters[vt_techniqueCount][vt_variantCount]; ///< the same, counting texture reads
    GLuint branchPrograms[vt_techniqueCount]
                         [vt_variantCount]; ///< the same, from where light left the paths of a set before
    GLuint framebuffers[VT_PATH_SETS];
    GLuint glassFramebuffers[VT_PATH_SETS]; ///< with the surface pass's depth: only pixels that see glass are
                                            ///< drawn
    /// The pixels' own paths; then, in turns, those of their branches. Objects in order read the paths so far
    /// from one of the first two and write the other, the last one the first.
    vtPathTargets targets[VT_PATH_SETS];
} vtRefractPass;

/// What a technique may read; those it needs (its row's samplers, by these names) must exist.
typedef struct vtRefractInputs {
    const vtTexture* surface;
    const vtTexture* innerDistances;
    const vtTexture* layerDepths;
    const vtTexture* layerNormals;
    const vtTexture* mergedDepths;
    const vtTexture* cubeSurfaces;
    const vtTexture* cubeTriangles;
    const vtTexture* intervals;
    const vtTexture* triangles;
    const vtTexture* cubeColumns;
    const vtTexture* objects;
    const vtHeightTexture* heights;
    bool countReads;
} vtRefractInputs;

vtResult vtRefractPass_Prepare(vtRefractPass* pass, const vtGL* gl, vtTechnique technique, vtVariant variant,
                               bool countReads, bool branches, vtError* error);
/// surfaceDepth: of the surface pass, of the same size; NULL for a technique that has no use of it.
/// sets: of targets, 1 to VT_PATH_SETS.
vtResult vtRefractPass_Resize(vtRefractPass* pass, const vtGL* gl, int width, int height, int sets,
                              const vtTexture* surfaceDepth, vtError* error);
/// Draws into a set of targets. `before`: NULL for the pixels' own paths; else those whose branches are
/// followed.
void vtRefractPass_Draw(const vtRefractPass* pass, const vtGL* gl, vtTechnique technique, vtVariant variant,
                        const vtRefractInputs* inputs, int set, const vtPathTargets* before);
/// One after the other: clears the paths that the first of so many objects goes on from, then each of them,
/// `left` more to come after it. Two sets of targets are needed.
void vtRefractPass_ClearOrdered(const vtRefractPass* pass, const vtGL* gl, uint32_t count);
void vtRefractPass_DrawOrdered(const vtRefractPass* pass, const vtGL* gl, vtTechnique technique,
                               vtVariant variant, const vtRefractInputs* inputs, uint32_t object,
                               uint32_t left);
void vtRefractPass_Destroy(vtRefractPass* pass, const vtGL* gl);
size_t vtRefractPass_Bytes(const vtRefractPass* pass);
