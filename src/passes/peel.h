#pragma once

#include "gl/program.h"
#include "gl/scene_buffer.h"
#include "gl/target.h"
#include "shaders_es3/common/constants.h"

/// Depth peeling (Everitt 2001), front to back, one drawing of the mesh a layer, normals and depth through
/// multiple render targets. Front and back faces both count as layers.
/// What is peeled.
typedef enum vtPeelKind {
    vt_peelAll = 0,    ///< all glass, one set of layers
    vt_peelEachObject, ///< a set of layers for each object of glass, in the frustum that the table gives it
    vt_peelFarthest,   ///< all glass, its farthest surface alone, into the second layer's place (Wyman 2005)
    vt_peelKindCount,
} vtPeelKind;

typedef struct vtPeelPass {
    const vtProgram* program; ///< of the frame
    GLuint startFramebuffer;  ///< the depth that the first layer is compared with
    GLuint framebuffers[2];   ///< by depth buffer
    int layers;               ///< of a set
    // WebGL forbids reading one layer of an array while another is drawn to, so the depth buffers that are
    // compared are two textures of their own, used in turn. 32 bits of float come back as they were
    // written, so a surface never peels itself.
    vtTexture depthBuffers[2];
    vtTexture depths; ///< R16UI array, set after set: 0 near to VT_DEPTH_SCALE far, linear; VT_DEPTH_NONE: no
                      ///< surface
    vtTexture normals; ///< RG32UI array: octahedral normals, interpolated and of the triangle
} vtPeelPass;

void vtPeelPass_Start(vtPeelPass* pass, const vtGL* gl, vtPeelKind kind, vtProgramList* programs);
/// sets: 1, or one for each object of glass.
vtResult vtPeelPass_Resize(vtPeelPass* pass, const vtGL* gl, int width, int height, int layers, int sets,
                           vtError* error);
void vtPeelPass_Draw(const vtPeelPass* pass, const vtGL* gl, const vtSceneBuffer* scene, vtPeelKind kind);
void vtPeelPass_Destroy(vtPeelPass* pass, const vtGL* gl);
size_t vtPeelPass_Bytes(const vtPeelPass* pass);
