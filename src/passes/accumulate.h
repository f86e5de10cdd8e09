#pragma once

#include "passes/display.h"

/// Several samples a pixel: their sum in linear light, and its mean as a picture. Floats are kept as bits in
/// integers because ES 3.0 draws to no others.
typedef struct vtAccumulatePass {
    const vtProgram *addProgram, *showProgram;
    vtDisplay display; ///< of showProgram
    GLuint framebuffers[2];
    vtTexture sums[2]; ///< RGBA32UI, in turns: WebGL forbids drawing to what is read
    int latest;        ///< which of them is the sum
    int weight;        ///< of all of them
    int count;         ///< samples in it; 0: whatever the textures hold, it is none
} vtAccumulatePass;

void vtAccumulatePass_Start(vtAccumulatePass* pass, const vtGL* gl, vtDisplay display,
                            vtProgramList* programs);
vtResult vtAccumulatePass_Resize(vtAccumulatePass* pass, const vtGL* gl, int width, int height,
                                 vtError* error);
/// Adds the light of one sample, as often as the uniform block says, which is `weight`.
void vtAccumulatePass_Add(vtAccumulatePass* pass, const vtGL* gl, const vtTexture* radiance, int weight);
void vtAccumulatePass_Show(const vtAccumulatePass* pass, const vtGL* gl, const vtBehind* behind,
                           GLuint framebuffer, int x, int y);
void vtAccumulatePass_Destroy(vtAccumulatePass* pass, const vtGL* gl);
size_t vtAccumulatePass_Bytes(const vtAccumulatePass* pass);
