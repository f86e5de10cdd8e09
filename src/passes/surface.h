#pragma once

#include "gl/program.h"
#include "gl/scene_buffer.h"
#include "gl/target.h"
#include "shaders_es3/common/constants.h"

/// The surface each pixel sees first, at the picture's resolution, for techniques that search layers: depth
/// and normals, and for the technique that asks for it the inner distance.
typedef struct vtSurfacePass {
    const vtProgram* program; ///< of the frame
    GLuint framebuffers[2];
    vtTexture depth;      ///< DEPTH_COMPONENT32F, 1 where there is nothing
    vtTexture attributes; ///< RGBA32UI: surface.frag says what
    vtTexture distances;  ///< R16UI: inner distance, VT_DEPTH_SCALE is the diagonal of the object's box; only
                          ///< where asked for
} vtSurfacePass;

void vtSurfacePass_Start(vtSurfacePass* pass, const vtGL* gl, bool distances, vtProgramList* programs);
vtResult vtSurfacePass_Resize(vtSurfacePass* pass, const vtGL* gl, int width, int height, bool distances,
                              vtError* error);
/// Draws objects first to last - 1, and what is opaque.
void vtSurfacePass_Draw(const vtSurfacePass* pass, const vtGL* gl, const vtSceneBuffer* scene, uint32_t first,
                        uint32_t last, bool distances);
void vtSurfacePass_Destroy(vtSurfacePass* pass, const vtGL* gl);
size_t vtSurfacePass_Bytes(const vtSurfacePass* pass);
