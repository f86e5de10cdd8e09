// A scene on the GPU: its meshes, one texture of all their triangles, and the table of its objects.
#pragma once

#include "gl/height_texture.h"
#include "gl/mesh_buffer.h"
#include "gl/target.h"
#include "scene/cube.h"
#include "scene/objects.h"

/// What a drawing of an object takes; the uniforms' places in one program.
typedef struct vtObjectUniforms {
    GLint toWorld, toObject, object, mirrored, firstTriangle;
} vtObjectUniforms;

/// One object as it is drawn.
typedef struct vtObjectBuffer {
    vtPlacedObject placed; ///< its pointers into the scene are not to be used any more
    vtMaterial material;
    uint32_t mesh;           ///< in vtSceneBuffer.meshes
    uint32_t firstAttribute; ///< record, or VT_NO_TRIANGLE
    vtVec3 ownMin, ownMax;   ///< the mesh's box in its own coordinates
} vtObjectBuffer;

typedef struct vtSceneBuffer {
    vtMeshBuffer* meshes;
    vtCubeFrame* cubeFrames; ///< of each mesh
    uint32_t meshCount;
    vtObjectBuffer* objects; ///< by rank: glass, then what is opaque
    uint32_t objectCount, glassCount;
    uint32_t* order;           ///< of the glass, from an eye: vtSceneBuffer_SortGlass
    vtVec3 glassMin, glassMax; ///< box of the glass, or of all where there is none; world
    vtVec3 low, high;          ///< of all
    vtTexture triangles;     ///< RGBA32UI, scene/triangles.h, of all meshes; neighbours by their number in it
    vtTexture attributes;    ///< RGBA32UI, constants.h; one texel where no opaque mesh has any
    vtHeightTexture heights; ///< of the one relief that can be drawn by them: the first of glass
    uint32_t heightsMesh;    ///< its mesh; meshCount: there is none
    vtTexture images;        ///< of opaque materials, gl/image_array.h
    vtTexture table;         ///< RGBA32UI: VT_OBJECT_...
    uint32_t* words;         ///< of the table, as it was uploaded last
    size_t meshBytes;
} vtSceneBuffer;

/// Uploads; *buffer need not be initialised. On failure it is zeroed.
vtResult vtSceneBuffer_Create(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, vtError* error);
void vtSceneBuffer_Destroy(vtSceneBuffer* buffer, const vtGL* gl);

/// Uploads the table where `words`, objectCount * VT_OBJECT_TEXELS * 4, differ from what it holds; true where
/// they do.
bool vtSceneBuffer_SetTable(vtSceneBuffer* buffer, const vtGL* gl, const uint32_t* words);

/// Objects of glass by the distance of the middle of their boxes, the nearest first.
void vtSceneBuffer_SortGlass(vtSceneBuffer* buffer, vtVec3 eye);

/// Whether the object is the relief that has its heights here.
static inline bool vtSceneBuffer_HasHeights(const vtSceneBuffer* buffer, uint32_t object)
{
    return object < buffer->glassCount && buffer->objects[object].mesh == buffer->heightsMesh;
}

/// Those that a program has.
vtObjectUniforms vtFindObjectUniforms(const vtGL* gl, GLuint program);

/// Draws objects first to last - 1, each from its vertices; the program in use has these uniforms. `heights`:
/// but for those that vtSceneBuffer_DrawHeights draws.
void vtSceneBuffer_Draw(const vtSceneBuffer* buffer, const vtGL* gl, const vtObjectUniforms* uniforms,
                        uint32_t first, uint32_t last, bool heights);
/// Of these objects the relief's that has its heights here, each by the 36 vertices of a box without
/// attributes.
void vtSceneBuffer_DrawHeights(const vtSceneBuffer* buffer, const vtGL* gl, const vtObjectUniforms* uniforms,
                               uint32_t first, uint32_t last);
/// The same without vertices: three for each triangle, which the vertex shader reads from the texture. A
/// vertex array without attributes must be bound.
void vtSceneBuffer_DrawTriangles(const vtSceneBuffer* buffer, const vtGL* gl,
                                 const vtObjectUniforms* uniforms, uint32_t first, uint32_t last);

size_t vtSceneBuffer_TextureBytes(const vtSceneBuffer* buffer);
