#pragma once

#include "gl/environment_buffer.h"
#include "gl/program.h"
#include "gl/scene_buffer.h"

/// What a scene asks of the program; bits.
typedef enum vtTraceVariant {
    vt_traceOneObject = 1,   ///< there is one object, of closed glass
    vt_traceOpaque = 2,      ///< there is something opaque
    vt_traceHeights = 4,     ///< a relief is met by its heights
    vt_traceOnlyHeights = 8, ///< there is nothing else
    vt_traceStrict = 16,     ///< without Fresnel reflection
    vt_traceCounted = 32,    ///< texture reads are counted
    vt_traceVariantCount = 64,
} vtTraceVariant;

/// The techniques that need no image of the scene: from the eye to the light in one drawing (trace.frag).
typedef struct vtTracePass {
    vtProgram programs[vt_traceVariantCount];
    GLuint framebuffer;
    vtTexture paths; ///< RGBA32UI: bits of the last direction (three floats), state (VT_PATH_...)
    vtTexture
        radiance; ///< RGBA32UI, bits of floats: linear light after exposure, share of the pixel it covers
} vtTracePass;

/// The variant for a frame.
vtTraceVariant vtChooseTraceVariant(const vtSceneBuffer* scene, const vtFrame* frame);
void vtTracePass_Start(vtTracePass* pass, const vtGL* gl, vtTraceVariant variant, vtProgramList* programs);
vtResult vtTracePass_Resize(vtTracePass* pass, const vtGL* gl, int width, int height, vtError* error);
/// branches: 0 to VT_MAX_BRANCHES, times that light which left a path is followed.
void vtTracePass_Draw(const vtTracePass* pass, const vtGL* gl, vtTraceVariant variant,
                      const vtSceneBuffer* scene, const vtEnvironmentBuffer* environment, int branches);
void vtTracePass_Destroy(vtTracePass* pass, const vtGL* gl);
size_t vtTracePass_Bytes(const vtTracePass* pass);
