#pragma once

#include "gl/program.h"
#include "gl/scene_buffer.h"
#include "gl/target.h"

/// Depth peeling (Everitt 2001), front to back, one drawing of the mesh a layer, normals and depth through
/// multiple render targets. Front and back faces both count as layers.
typedef struct vtPeelPass {
    GLuint program, farthestProgram;
    vtObjectUniforms uniforms, farthestUniforms;
    GLuint startFramebuffer; ///< the depth that the first layer is compared with
    GLuint framebuffers[VT_MAX_LAYERS];
    // WebGL forbids reading one layer of an array while another is drawn to, so the depth buffers that are
    // compared are two textures of their own, used in turn. 32 bits of float come back as they were
    // written, so a surface never peels itself.
    vtTexture depthBuffers[2];
    vtTexture depths;  ///< R16UI array: 0 near to VT_DEPTH_SCALE far, linear; VT_DEPTH_NONE: no surface
    vtTexture normals; ///< RG32UI array: octahedral normals, interpolated and of the triangle
} vtPeelPass;

vtResult vtPeelPass_Create(vtPeelPass* pass, const vtGL* gl, vtError* error);
/// Compiles what vtPeelPass_DrawFarthest needs; does nothing the second time.
vtResult vtPeelPass_PrepareFarthest(vtPeelPass* pass, const vtGL* gl, vtError* error);
vtResult vtPeelPass_Resize(vtPeelPass* pass, const vtGL* gl, int width, int height, int layers,
                           vtError* error);
void vtPeelPass_Draw(const vtPeelPass* pass, const vtGL* gl, const vtSceneBuffer* scene);
/// Draws the farthest surface alone, into the second layer's place (Wyman 2005's choice of back side).
void vtPeelPass_DrawFarthest(const vtPeelPass* pass, const vtGL* gl, const vtSceneBuffer* scene);
void vtPeelPass_Destroy(vtPeelPass* pass, const vtGL* gl);
size_t vtPeelPass_Bytes(const vtPeelPass* pass);
