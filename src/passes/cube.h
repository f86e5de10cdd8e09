#pragma once

#include "gl/mesh_buffer.h"
#include "gl/program.h"
#include "gl/target.h"

/// The layered depth cube: layers of a mesh along three axes, made once a mesh, or along one, from the eye,
/// made anew for each view of a mesh that changes; and the interval pyramid over them, which a search walks.
/// The layers of several meshes lie in the same textures, a slot for each.
typedef struct vtCubePass {
    GLuint peelProgram, firstProgram, levelProgram;
    GLint peelAxis, peelLayers, peelFrom, peelFirstTriangle;
    GLint firstSide, firstOpaque, levelSide, levelBelow;
    GLuint startFramebuffer;
    GLuint peelFramebuffers[2]; ///< by depth buffer
    GLuint firstFramebuffer, levelFramebuffer;
    int layers, sides;
    vtTexture depthBuffers[2];
    vtTexture surfaces;   ///< RGBA16UI array, four layers a texel: VT_CUBE_... in constants.h
    vtTexture triangles;  ///< RGBA32UI array, those surfaces' triangles
    vtTexture intervals;  ///< RGBA16UI array, three slices a side: INNER, OUTER, NEAR; its levels: cube.glsl
    vtTexture columns;    ///< R16UI array: for each cell of a side, which column about it has a surface
    vtTexture scratch[4]; ///< RGBA16UI thrice, R16UI: a level of the pyramid while it is drawn
} vtCubePass;

/// What is peeled into a slot.
typedef struct vtCubeSlot {
    const vtMeshBuffer* mesh;
    float layers[4][4]; ///< rows: the mesh's coordinates to the layers', 0 to 1
    float eye[4];       ///< in the mesh's coordinates, 1; or 0, 0, 0, 0: along the axes
    bool opaque;
} vtCubeSlot;

vtResult vtCubePass_Create(vtCubePass* pass, const vtGL* gl, vtError* error);
/// sides: 3 for a cube, 1 for layers from the eye. size: texels, a power of two. True in *changed where
/// something was made anew.
vtResult vtCubePass_Resize(vtCubePass* pass, const vtGL* gl, int size, int layers, int sides, int slots,
                           bool* changed, vtError* error);
/// Peels a mesh and builds the pyramid. `triangles`: records of all meshes. Any vertex array without
/// attributes must be bound.
void vtCubePass_Draw(const vtCubePass* pass, const vtGL* gl, const vtTexture* triangles, int slot,
                     const vtCubeSlot* what);
void vtCubePass_Destroy(vtCubePass* pass, const vtGL* gl);
size_t vtCubePass_Bytes(const vtCubePass* pass);

/// The same before it is made.
size_t vtCubeBytes(int size, int layers, int sides);
