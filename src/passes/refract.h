#pragma once

#include "gl/program.h"
#include "gl/target.h"
#include "technique.h"

/// Follows every pixel's path through the glass with one technique of the ladder.
typedef struct vtRefractPass {
    GLuint programs[vt_techniqueCount]; ///< compiled when first used
    GLuint counters[vt_techniqueCount]; ///< the same, counting texture reads
    GLuint framebuffer;
    vtTexture light; ///< RG32UI: four halves, transmittance and light added on the way (red, green, blue)
    vtTexture paths; ///< RGBA32UI: the bits of the last direction (three floats), state (VT_PATH_...)
} vtRefractPass;

/// What a technique may read; those it needs (its row's samplers, by these names) must exist.
typedef struct vtRefractInputs {
    const vtTexture* surfaceDepth;
    const vtTexture* surfaceNormals;
    const vtTexture* innerDistances;
    const vtTexture* layerDepths;
    const vtTexture* layerNormals;
    const vtTexture* mergedDepths;
    const vtTexture* cubeSurfaces;
    const vtTexture* cubeTriangles;
    const vtTexture* intervals;
    const vtTexture* triangles;
    bool countReads;
} vtRefractInputs;

vtResult vtRefractPass_Prepare(vtRefractPass* pass, const vtGL* gl, vtTechnique technique, bool countReads,
                               vtError* error);
vtResult vtRefractPass_Resize(vtRefractPass* pass, const vtGL* gl, int width, int height, vtError* error);
void vtRefractPass_Draw(const vtRefractPass* pass, const vtGL* gl, vtTechnique technique,
                        const vtRefractInputs* inputs);
void vtRefractPass_Destroy(vtRefractPass* pass, const vtGL* gl);
