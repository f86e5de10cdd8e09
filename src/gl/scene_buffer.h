// A scene on the GPU: geometry, its instances, and the table of objects that shaders read. World coordinates
// are from the middle of the scene, and an object's own from the middle of its mesh, so that nothing is lost
// to rounding far from the origin.
#pragma once

#include "gl/geometry.h"
#include "gl/image_array.h"
#include "gl/object_buffer.h"
#include "gl/program.h"

/// The uniforms of a program that draws objects.
#define VT_OBJECT_UNIFORMS                                                                                   \
    {                                                                                                        \
        "u_toWorld", "u_toObject", "u_object", "u_mirrored"                                                  \
    }

#define VT_NO_GEOMETRY UINT32_MAX

typedef struct vtSceneBuffer {
    vtGeometryStore geometry;
    vtImageArray images;
    vtLight* lights;
    uint32_t lightCount;
    /// The instances as the caller gave them, without gaps, as a scene of meshes that are in geometry.shapes;
    /// a material each.
    vtObject* instances;
    vtMaterial* materials;
    uint32_t instanceCount, instanceCapacity;
    bool isStale; ///< something was added, changed or removed since vtSceneBuffer_Place
    // What vtSceneBuffer_Place makes of them.
    vtObjectBuffer* objects; ///< by rank: glass, then what is opaque
    uint32_t objectCount, glassCount;
    uint32_t* order;           ///< of the glass, from an eye: vtSceneBuffer_SortGlass
    vtSpace space;             ///< the world of shaders, in the caller's
    vtLight* placedLights;     ///< in it
    vtVec3 glassMin, glassMax; ///< box of the glass, or of all where there is none; world
    vtVec3 low, high;          ///< of all
    uint32_t
        relief; ///< geometry that is drawn by its heights, the first of glass; VT_NO_GEOMETRY: there is none
    vtTexture tree;          ///< RGBA32UI, object_tree.h
    bool hasLooks;           ///< some material is not plain, or there are lights: shaders read the next
    vtTexture looks;         ///< RGBA32UI, material_table.h
    vtTexture table;         ///< RGBA32UI: VT_OBJECT_...
    uint32_t *words, *fresh; ///< of the table: as it was uploaded last, and room for the next
} vtSceneBuffer;

/// Uploads a scene and places it; geometry and instances are numbered as the scene's meshes and objects.
/// *buffer need not be initialised. On failure it is zeroed.
vtResult vtSceneBuffer_Create(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, vtError* error);
/// What is made of the objects anew by vtSceneBuffer_Place and vtSceneBuffer_SetTable.
void vtSceneBuffer_DropTables(vtSceneBuffer* buffer, const vtGL* gl);
void vtSceneBuffer_Destroy(vtSceneBuffer* buffer, const vtGL* gl);

/// Adds an instance behind the others; its mesh is a geometry's index, its material's number is not looked
/// at. Removes one: the last takes its place.
vtResult vtSceneBuffer_AddInstance(vtSceneBuffer* buffer, const vtObject* object, const vtMaterial* material,
                                   vtError* error);
void vtSceneBuffer_RemoveInstance(vtSceneBuffer* buffer, uint32_t instance);

/// Ranks, boxes and tree of the instances as they are now, where something has changed. Fails as
/// vtPlaceObjects does.
vtResult vtSceneBuffer_Place(vtSceneBuffer* buffer, const vtGL* gl, vtError* error);

/// Uploads the table of objects that buffer->fresh holds (objectCount * VT_OBJECT_TEXELS * 4 words), if it
/// differs from the one on the GPU. True: it was uploaded.
bool vtSceneBuffer_SetTable(vtSceneBuffer* buffer, const vtGL* gl);

/// Objects of glass by the distance of the middle of their boxes, the nearest first.
void vtSceneBuffer_SortGlass(vtSceneBuffer* buffer, vtVec3 eye);

/// Whether the object is the relief that is drawn by its heights.
static inline bool vtSceneBuffer_HasHeights(const vtSceneBuffer* buffer, uint32_t object)
{
    return buffer->objects[object].geometry == buffer->relief;
}

/// The relief's heights; NULL without one.
static inline const vtHeightTexture* vtSceneBuffer_Heights(const vtSceneBuffer* buffer)
{
    return buffer->relief != VT_NO_GEOMETRY ? &buffer->geometry.items[buffer->relief].heights : NULL;
}

/// Draws objects first to last - 1, each from its vertices; the program is in use and has VT_OBJECT_UNIFORMS.
void vtSceneBuffer_Draw(const vtSceneBuffer* buffer, const vtGL* gl, const vtProgram* program, uint32_t first,
                        uint32_t last);

/// But the meshes.
size_t vtSceneBuffer_TextureBytes(const vtSceneBuffer* buffer);
