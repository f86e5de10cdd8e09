#pragma once

#include "gl/mesh_buffer.h"
#include "gl/program.h"
#include "gl/target.h"

/// The surface each pixel sees first, at the picture's resolution: depth and normals, and for the technique
/// that asks for it the inner distance.
typedef struct vtSurfacePass {
    GLuint program, distanceProgram;
    GLuint framebuffer, distanceFramebuffer;
    vtTexture depth;      ///< DEPTH_COMPONENT32F, 1 where there is nothing
    vtTexture attributes; ///< RG32UI: octahedral normals, interpolated and of the triangle
    vtTexture distances;  ///< R16UI: inner distance, VT_DEPTH_SCALE is the diagonal of the object's box; only
                          ///< where asked for
} vtSurfacePass;

vtResult vtSurfacePass_Create(vtSurfacePass* pass, const vtGL* gl, vtError* error);
vtResult vtSurfacePass_Resize(vtSurfacePass* pass, const vtGL* gl, int width, int height, bool distances,
                              vtError* error);
void vtSurfacePass_Draw(const vtSurfacePass* pass, const vtGL* gl, const vtMeshBuffer* mesh, bool distances);
void vtSurfacePass_Destroy(vtSurfacePass* pass, const vtGL* gl);
size_t vtSurfacePass_Bytes(const vtSurfacePass* pass);
