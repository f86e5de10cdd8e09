// A scene on the GPU: its meshes, one texture of the hierarchies over their triangles, and the table of its
// objects. World coordinates are from the middle of the scene, and an object's own from the middle of its
// mesh, so that nothing is lost to rounding far from the origin.
#pragma once

#include "gl/height_texture.h"
#include "gl/mesh_buffer.h"
#include "gl/program.h"
#include "gl/target.h"
#include "scene/objects.h"
#include "shaders_es3/common/constants.h"

/// The uniforms of a program that draws objects.
#define VT_OBJECT_UNIFORMS                                                                                   \
    {                                                                                                        \
        "u_toWorld", "u_toObject", "u_object", "u_mirrored"                                                  \
    }

/// Where a mesh's records are, and their grid (scene/hierarchy.h).
typedef struct vtMeshRecords {
    uint32_t first, count; ///< in vtSceneBuffer.records; 0 without triangles
    vtVec3 origin;         ///< of the objects' own coordinates, in the mesh's
    vtVec3 gridLow, gridScale;
} vtMeshRecords;

/// One object as it is drawn.
typedef struct vtObjectBuffer {
    vtPlacedObject placed; ///< its pointers into the scene are not to be used any more
    vtMaterial material;
    uint32_t mesh;           ///< in vtSceneBuffer.meshes
    uint32_t firstAttribute; ///< record, or VT_NO_TRIANGLE
    vtTransform source;      ///< the scene's: placed.toWorld before the coordinates were moved
    vtVec3 ownMin, ownMax;   ///< the mesh's box in the object's own coordinates
    bool bothSides; ///< opaque, or glass with open edges or parts that overlap: rays meet its triangles from
                    ///< either side
} vtObjectBuffer;

typedef struct vtSceneBuffer {
    vtMeshBuffer* meshes;
    vtMeshRecords* meshRecords; ///< of each mesh
    uint32_t meshCount;
    vtObjectBuffer* objects; ///< by rank: glass, then what is opaque
    uint32_t objectCount, glassCount;
    uint32_t* order;           ///< of the glass, from an eye: vtSceneBuffer_SortGlass
    vtVec3 origin;             ///< the middle of the scene, in the caller's world
    vtVec3 glassMin, glassMax; ///< box of the glass, or of all where there is none; world
    vtVec3 low, high;          ///< of all
    vtTexture records;         ///< RGBA32UI, VT_RECORDS_A_ROW a row, of all meshes
    vtTexture tree;            ///< RGBA32UI, object_tree.h
    vtTexture attributes;      ///< RGBA32UI, constants.h; one row where no opaque mesh has any
    vtHeightTexture heights;   ///< of the one relief that can be drawn by them: the first of glass
    uint32_t heightsMesh;      ///< its mesh; meshCount: there is none
    vtTexture images;          ///< of opaque materials, gl/image_array.h
    vtTexture table;           ///< RGBA32UI: VT_OBJECT_...
    uint32_t *words, *fresh;   ///< of the table: as it was uploaded last, and room for the next
    size_t meshBytes;
} vtSceneBuffer;

/// Uploads; *buffer need not be initialised. On failure it is zeroed.
vtResult vtSceneBuffer_Create(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, vtError* error);
void vtSceneBuffer_Destroy(vtSceneBuffer* buffer, const vtGL* gl);

/// Takes over a mesh whose vertices have moved, as vtMesh_Update left it. False where it does not fit in
/// place: then the scene has to be uploaded anew.
bool vtSceneBuffer_UpdateMesh(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, uint32_t mesh);

/// Uploads the table where buffer->fresh, objectCount * VT_OBJECT_TEXELS * 4, differs from what it holds;
/// true where it does.
bool vtSceneBuffer_SetTable(vtSceneBuffer* buffer, const vtGL* gl);

/// Objects of glass by the distance of the middle of their boxes, the nearest first.
void vtSceneBuffer_SortGlass(vtSceneBuffer* buffer, vtVec3 eye);

/// Whether the object is the relief that has its heights here.
static inline bool vtSceneBuffer_HasHeights(const vtSceneBuffer* buffer, uint32_t object)
{
    return object < buffer->glassCount && buffer->objects[object].mesh == buffer->heightsMesh;
}

/// Draws objects first to last - 1, each from its vertices; the program is in use and has VT_OBJECT_UNIFORMS.
void vtSceneBuffer_Draw(const vtSceneBuffer* buffer, const vtGL* gl, const vtProgram* program, uint32_t first,
                        uint32_t last);

size_t vtSceneBuffer_TextureBytes(const vtSceneBuffer* buffer);
