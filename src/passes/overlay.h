#pragma once

#include "gl/host_picture.h"
#include "passes/display.h"

/// The last pass in place of present or accumulate's showing where a frame is drawn over the host's picture:
/// blended, with its depth, hidden by what the host has before it.
typedef struct vtOverlayPass {
    const vtProgram* program; ///< of the frame
} vtOverlayPass;

typedef struct vtOverlayInputs {
    const vtTexture* light;  ///< RGBA32UI: of one sample, or the sum of several
    const vtTexture* depths; ///< R32UI of the trace pass, or RGBA32UI of the surface pass
    const vtHostPicture* host;
    bool nearIsGreater; ///< the host's depth buffer runs the other way round
} vtOverlayInputs;

#if VT_WITH_HOST
void vtOverlayPass_Start(vtOverlayPass* pass, const vtGL* gl, bool surface, vtToneMapping toneMapping,
                         vtProgramList* programs);
void vtOverlayPass_Draw(const vtOverlayPass* pass, const vtGL* gl, const vtOverlayInputs* inputs,
                        GLuint framebuffer, int x, int y);
#else
static inline void vtOverlayPass_Start(vtOverlayPass* pass, const vtGL* gl, bool surface,
                                       vtToneMapping toneMapping, vtProgramList* programs)
{
    (void)pass, (void)gl, (void)surface, (void)toneMapping, (void)programs;
}
static inline void vtOverlayPass_Draw(const vtOverlayPass* pass, const vtGL* gl,
                                      const vtOverlayInputs* inputs, GLuint framebuffer, int x, int y)
{
    (void)pass, (void)gl, (void)inputs, (void)framebuffer, (void)x, (void)y;
}
#endif
