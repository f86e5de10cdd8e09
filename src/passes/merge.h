#pragma once

#include "gl/program.h"
#include "gl/target.h"

/// Layer depths merged (Wang & Chi 2014, section 3.5.2) and gathered four to a texel, so that a search
/// reads four layers at once.
typedef struct vtMergePass {
    const vtProgram* program;
    GLuint framebuffer;
    int layers;       ///< of a set
    vtTexture depths; ///< RGBA16UI array, four layers a texel, set after set
} vtMergePass;

void vtMergePass_Start(vtMergePass* pass, const vtGL* gl, vtProgramList* programs);
vtResult vtMergePass_Resize(vtMergePass* pass, const vtGL* gl, int width, int height, int layers, int sets,
                            vtError* error);
/// layerDepths: as vtPeelPass has them.
void vtMergePass_Draw(const vtMergePass* pass, const vtGL* gl, const vtTexture* layerDepths);
void vtMergePass_Destroy(vtMergePass* pass, const vtGL* gl);
