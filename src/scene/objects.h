// Objects as paths meet them: in the order that decides where they overlap.
#pragma once

#include "base/space.h"
#include "mesh/mesh_triangle.h"
#include "vitrine.h"

/// A scene of one object of glass of index 1.5 that borrows its mesh: it lives as long as that, and is not to
/// be destroyed.
typedef struct vtBorrowedMesh {
    vtMesh mesh;
    vtMaterial material;
    vtObject object;
    vtScene scene;
} vtBorrowedMesh;

static inline const vtScene* vtBorrowMesh(const vtMesh* mesh, vtBorrowedMesh* borrowed)
{
    borrowed->mesh = *mesh;
    borrowed->material = vtDefaultMaterial();
    borrowed->object = (vtObject){.toWorld = vtIdentityTransform()};
    borrowed->scene = (vtScene){.meshes = &borrowed->mesh,
                                .materials = &borrowed->material,
                                .objects = &borrowed->object,
                                .meshCount = 1,
                                .materialCount = 1,
                                .objectCount = 1};
    return &borrowed->scene;
}

typedef struct vtPlacedObject {
    const vtMesh* mesh;
    const vtMaterial* material;
    uint32_t meshIndex, object; ///< in the scene
    uint32_t body;              ///< rank of the first object of its body
    bool plain;                 ///< its material is (scene/material.h), and there are no lights
    bool
        thin; ///< glass: a thin wall, by its material or because it has no volume and lies inside other glass
    vtSpace own; ///< of the mesh's coordinates, that toWorld is from and toObject to
    vtTransform toWorld, toObject;
    vtVec3 low, high;  ///< box in the world
    vtVec3 absorption; ///< glass: exp(-absorption * distance) is left of light, per world unit
    bool mirrored;     ///< toWorld turns clockwise into counter-clockwise
} vtPlacedObject;

/// The object, where it, its mesh and its material are in the scene; else NULL.
static inline const vtObject* vtScene_Object(const vtScene* scene, uint32_t index)
{
    if (scene->objects == NULL || scene->meshes == NULL || scene->materials == NULL) {
        return NULL;
    }
    const vtObject* object = &scene->objects[index];
    return object->mesh < scene->meshCount && object->material < scene->materialCount ? object : NULL;
}

/// The scene's objects: glass by falling precedence, then what is opaque. Where objects of glass overlap, the
/// first of them counts: an object's number here is its rank (scene/media.h). The order does not depend on
/// the scene's. From vtAllocate, scene->objectCount of them; *glassCount of these are glass. They point
/// into the scene. An open sheet of glass inside other glass becomes a thin wall: nothing says what is on
/// either side of it. Fails as vtValidateScene does, and with vt_errorMemory.
vtResult vtPlaceObjects(const vtScene* scene, vtPlacedObject** placed, uint32_t* glassCount, vtError* error);

/// The same of a scene whose meshes are known by counts, box and volume alone, and whose images are
/// elsewhere.
vtResult vtPlaceShapes(const vtScene* scene, vtPlacedObject** placed, uint32_t* glassCount, vtError* error);

/// What can be wrong with an object by itself: vt_errorGeometry (no scale along an axis) or vt_errorArgument
/// (its index of refraction). `name`: the sentence's subject.
vtResult vtCheckObject(const vtObject* object, const vtMaterial* material, const char* name, vtError* error);

/// The space of the world in which objects are drawn and traced: about all of them.
vtSpace vtSpaceOfObjects(const vtPlacedObject* placed, uint32_t count);

/// Takes the object, as it was placed, into spaces of the mesh's coordinates and of the world's, at little
/// loss however far from the origin these are.
void vtPlacedObject_Enter(vtPlacedObject* placed, const vtSpace* own, const vtSpace* world);

/// A light in a space: what arrives from it stays the same.
vtLight vtLight_Enter(const vtLight* light, const vtSpace* space);

/// Whether an object made of the mesh is opaque, or else one that is not.
bool vtScene_Uses(const vtScene* scene, uint32_t mesh, bool opaque);

/// Whether an object made of the mesh is glass that bounds a body by itself.
bool vtScene_UsesSolid(const vtScene* scene, uint32_t mesh);

/// The first mesh that is a relief and glass, else the first opaque one: technique `heightfield` draws it by
/// its heights; meshCount: there is none.
uint32_t vtScene_Relief(const vtScene* scene);

/// Whether it has lights, or a material that is not plain (scene/material.h).
bool vtScene_HasLooks(const vtScene* scene);

/// Whether any of its objects is glass.
bool vtScene_HasGlass(const vtScene* scene);

/// As vtPrepareScene, for a technique that meets the relief by its heights, or reads inner distances.
vtResult vtScene_Complete(vtScene* scene, bool heights, bool innerDistances, bool* changed, vtError* error);

static inline bool vtScene_HasRelief(const vtScene* scene)
{
    return vtScene_Relief(scene) < scene->meshCount;
}

/// Does the object's mesh, which is closed, contain the point (world)?
bool vtPlacedObject_Contains(const vtPlacedObject* placed, vtVec3 point);

static inline vtVec3 vtTransformVector(const vtTransform* t, vtVec3 v)
{
    const float* x = t->rows[0];
    const float* y = t->rows[1];
    const float* z = t->rows[2];
    return (vtVec3){x[0] * v.x + x[1] * v.y + x[2] * v.z, y[0] * v.x + y[1] * v.y + y[2] * v.z,
                    z[0] * v.x + z[1] * v.y + z[2] * v.z};
}

static inline vtVec3 vtTransformPoint(const vtTransform* t, vtVec3 p)
{
    const vtVec3 v = vtTransformVector(t, p);
    return (vtVec3){v.x + t->rows[0][3], v.y + t->rows[1][3], v.z + t->rows[2][3]};
}

/// An outward normal of the object in the world, not of unit length; `toObject` is the inverse transform.
static inline vtVec3 vtTransformNormal(const vtTransform* toObject, vtVec3 n)
{
    const float* x = toObject->rows[0];
    const float* y = toObject->rows[1];
    const float* z = toObject->rows[2];
    return (vtVec3){x[0] * n.x + y[0] * n.y + z[0] * n.z, x[1] * n.x + y[1] * n.y + z[1] * n.z,
                    x[2] * n.x + y[2] * n.y + z[2] * n.z};
}

/// Of a triangle (mesh/mesh_triangle.h), in the object's own space.
static inline void vtPlacedObject_Corners(const vtPlacedObject* placed, uint32_t triangle, vtVec3 corners[3])
{
    vtMesh_Corners(placed->mesh, triangle, corners);
    for (int i = 0; i < 3; ++i) {
        corners[i] = vtSpace_Enter(&placed->own, corners[i]);
    }
}
