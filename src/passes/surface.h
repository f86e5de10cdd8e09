#pragma once

#include "gl/program.h"
#include "gl/scene_buffer.h"
#include "gl/target.h"

/// What is drawn beside depth and normals, or how.
typedef enum vtSurfaceKind {
    vt_surfacePlain = 0,
    vt_surfaceDistances, ///< the inner distance, too
    vt_surfaceHeights,   ///< the relief that has its heights in the scene's buffer by them
} vtSurfaceKind;

/// The surface each pixel sees first, at the picture's resolution: depth and normals, and for the technique
/// that asks for it the inner distance.
typedef struct vtSurfacePass {
    // By whether inner distances are drawn; those, and the one for heights, are compiled when first used.
    GLuint glassPrograms[2], opaquePrograms[2], heightsProgram;
    vtObjectUniforms glassUniforms[2], opaqueUniforms[2], heightsUniforms;
    GLuint framebuffers[2];
    vtTexture depth;      ///< DEPTH_COMPONENT32F, 1 where there is nothing
    vtTexture attributes; ///< RGBA32UI: surface.frag and surface_opaque.frag say what
    vtTexture distances;  ///< R16UI: inner distance, VT_DEPTH_SCALE is the diagonal of the object's box; only
                          ///< where asked for
} vtSurfacePass;

vtResult vtSurfacePass_Create(vtSurfacePass* pass, const vtGL* gl, vtError* error);
vtResult vtSurfacePass_Resize(vtSurfacePass* pass, const vtGL* gl, int width, int height, vtSurfaceKind kind,
                              vtError* error);
/// Of glass, objects first to last - 1 alone. `emptyVertexArray`: one without attributes.
void vtSurfacePass_Draw(const vtSurfacePass* pass, const vtGL* gl, const vtSceneBuffer* scene, uint32_t first,
                        uint32_t last, vtSurfaceKind kind, GLuint emptyVertexArray);
void vtSurfacePass_Destroy(vtSurfacePass* pass, const vtGL* gl);
size_t vtSurfacePass_Bytes(const vtSurfacePass* pass);
