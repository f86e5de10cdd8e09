// Meshes on the GPU: their vertices, and in one texture the hierarchies over their triangles. Each can be
// added, changed and removed alone. Own coordinates are from the middle of the mesh, so that nothing is lost
// to rounding far from the origin.
#pragma once

#include "base/space.h"
#include "gl/height_texture.h"
#include "gl/mesh_buffer.h"
#include "gl/target.h"

/// What a mesh will be used for, as far as it is known.
typedef struct vtGeometryUse {
    bool any;        ///< else it takes a place, and nothing else
    bool glass;      ///< whether its parts run into each other is found out
    bool attributes; ///< its texture coordinates and colours are uploaded, where it has some
    bool heights;    ///< a relief's heights are uploaded
} vtGeometryUse;

/// Neighbours in a texture of records.
typedef struct vtRecordRange {
    uint32_t first, count;
} vtRecordRange;

typedef struct vtGeometryBuffer {
    bool isThere;
    vtMeshBuffer vertices; ///< empty without triangles
    vtRecordRange records; ///< of its hierarchy, in vtGeometryStore.records; none without triangles
    /// Of the corners of those, in vtGeometryStore.attributes; none: it has none. Twice as many: the second
    /// half is those of more attributes
    vtRecordRange attributes;
    bool colored;              ///< it has colours
    uint32_t builds;           ///< of the hierarchy, whose corners the attributes are in the order of
    vtSpace space;             ///< the own coordinates
    vtVec3 gridLow, gridScale; ///< of the hierarchy's boxes (mesh/hierarchy.h)
    bool overlaps;             ///< glass: parts run into each other
    vtHeightTexture heights;   ///< of a relief that uses them
} vtGeometryBuffer;

typedef struct vtGeometryStore {
    vtGeometryBuffer* items;
    /// Of each, what there is to know without its data: counts, box, volume. Pointers are NULL.
    vtMesh* shapes;
    uint32_t count, capacity;
    vtTexture records;    ///< RGBA32UI, VT_RECORDS_A_ROW a row
    vtTexture attributes; ///< RGBA32UI, constants.h; one row where no mesh has any
} vtGeometryStore;

/// Uploads a mesh; its hierarchy is built where it has none. *index: its place among the items. Fails with
/// vt_errorContext (no room on this GPU), vt_errorGeometry (more triangles than a hierarchy can hold) or
/// vt_errorMemory; then nothing has changed.
vtResult vtGeometryStore_Add(vtGeometryStore* store, const vtGL* gl, const vtMesh* mesh, vtGeometryUse use,
                             uint32_t* index, vtError* error);

/// Uploads the first meshes of a store, in their order, into textures that are as large as they need. Fails
/// as adding one does; what has been added then is there.
vtResult vtGeometryStore_AddAll(vtGeometryStore* store, const vtGL* gl, const vtMesh* meshes, uint32_t count,
                                const vtGeometryUse* uses, vtError* error);

/// Takes over a mesh whose vertices have moved, as vtMesh_Update left it. Fails as adding does; then the item
/// is as it was.
vtResult vtGeometryStore_Update(vtGeometryStore* store, const vtGL* gl, uint32_t index, const vtMesh* mesh,
                                vtError* error);

/// Its place is used again by what is added later. Safe where it is not there.
void vtGeometryStore_Remove(vtGeometryStore* store, const vtGL* gl, uint32_t index);

void vtGeometryStore_Destroy(vtGeometryStore* store, const vtGL* gl);

/// GPU memory of hierarchies and vertices; of heights.
size_t vtGeometryStore_MeshBytes(const vtGeometryStore* store);
size_t vtGeometryStore_HeightBytes(const vtGeometryStore* store);
