// Scenes put together, checked and taken apart.
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "mesh/height_field.h"
#include "scene/objects.h"

vtTransform vtIdentityTransform(void)
{
    return (vtTransform){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

/// Room for `more` elements behind the `count` there are; false where memory is short.
static bool grow(void* array, uint32_t count, uint32_t more, size_t size)
{
    void** at = array;
    void* grown = vtReallocate(*at, (size_t)count + more, size);
    *at = grown != NULL ? grown : *at;
    return grown != NULL;
}

vtResult vtScene_AddMesh(vtScene* scene, vtMesh* mesh, uint32_t* index, vtError* error)
{
    if (scene == NULL || mesh == NULL || index == NULL) {
        return vtFailMissing(error, "vtScene_AddMesh",
                             scene == NULL  ? "scene"
                             : mesh == NULL ? "mesh"
                                            : "index");
    }
    if (!grow(&scene->meshes, scene->meshCount, 1, sizeof *scene->meshes)) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for a mesh more");
    }
    *index = scene->meshCount++;
    scene->meshes[*index] = *mesh;
    *mesh = (vtMesh){0};
    return vtSucceed(error);
}

vtResult vtScene_AddMaterial(vtScene* scene, const vtMaterial* material, uint32_t* index, vtError* error)
{
    if (scene == NULL || material == NULL || index == NULL) {
        return vtFailMissing(error, "vtScene_AddMaterial",
                             scene == NULL      ? "scene"
                             : material == NULL ? "material"
                                                : "index");
    }
    if (!grow(&scene->materials, scene->materialCount, 1, sizeof *scene->materials)) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for a material more");
    }
    *index = scene->materialCount++;
    scene->materials[*index] = *material;
    return vtSucceed(error);
}

vtResult vtScene_AddObject(vtScene* scene, const vtObject* object, uint32_t* index, vtError* error)
{
    if (scene == NULL || object == NULL) {
        return vtFailMissing(error, "vtScene_AddObject", scene == NULL ? "scene" : "object");
    }
    if (object->mesh >= scene->meshCount || object->material >= scene->materialCount) {
        return vtFail(error, vt_errorArgument,
                      "scene: an object of mesh %u and material %u, but there are %u and %u", object->mesh,
                      object->material, scene->meshCount, scene->materialCount);
    }
    if (!grow(&scene->objects, scene->objectCount, 1, sizeof *scene->objects)) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for %u objects", scene->objectCount + 1);
    }
    scene->objects[scene->objectCount] = *object;
    if (index != NULL) {
        *index = scene->objectCount;
    }
    ++scene->objectCount;
    return vtSucceed(error);
}

vtResult vtCreateMeshScene(vtMesh* mesh, const vtMaterial* material, vtScene* scene, vtError* error)
{
    vtScene made = {0};
    vtObject object = {.toWorld = vtIdentityTransform()};
    if (scene == NULL) {
        return vtFailMissing(error, "vtCreateMeshScene", "scene");
    }
    *scene = (vtScene){0};
    if (mesh == NULL || material == NULL) {
        return vtFailMissing(error, "vtCreateMeshScene", mesh == NULL ? "mesh" : "material");
    }
    vtResult result = vtScene_AddMaterial(&made, material, &object.material, error);
    // The mesh comes last: on failure it is still the caller's.
    if (result == vt_ok && !grow(&made.objects, 0, 1, sizeof *made.objects)) {
        result = vtFail(error, vt_errorMemory, "scene: out of memory");
    }
    result = result == vt_ok ? vtScene_AddMesh(&made, mesh, &object.mesh, error) : result;
    result = result == vt_ok ? vtScene_AddObject(&made, &object, NULL, error) : result;
    if (result != vt_ok) {
        vtDestroyScene(&made);
        return result;
    }
    *scene = made;
    return result;
}

const char* vtWallsName(int index)
{
    static const char* const names[] = {"auto", "thin", "solid"};
    return index >= 0 && index < 3 ? names[index] : NULL;
}

void vtScene_SetWalls(vtScene* scene, vtWalls walls)
{
    for (uint32_t i = 0; scene != NULL && walls != vt_wallsAuto && i < scene->materialCount; ++i) {
        scene->materials[i].thin = !scene->materials[i].opaque && walls == vt_wallsThin;
    }
}

static vtTransform multiply(const vtTransform* a, const vtTransform* b)
{
    vtTransform product;
    for (int row = 0; row < 3; ++row) {
        const float* r = a->rows[row];
        for (int column = 0; column < 4; ++column) {
            product.rows[row][column] = r[0] * b->rows[0][column] + r[1] * b->rows[1][column] +
                                        r[2] * b->rows[2][column] + (column == 3 ? r[3] : 0.0f);
        }
    }
    return product;
}

/// So many that a material's image, an int, could not name them all.
static bool isTooLong(uint32_t count, uint32_t more)
{
    return (uint64_t)count + more > INT32_MAX;
}

/// Adds the other's lines to the scene's; false where memory is short.
static bool appendNotes(vtScene* scene, const vtScene* other)
{
    if (other->notes == NULL) {
        return true;
    }
    const size_t before = scene->notes != NULL ? strlen(scene->notes) : 0, more = strlen(other->notes);
    char* grown = vtReallocate(scene->notes, before + more + 2, 1);
    if (grown != NULL) {
        scene->notes = grown;
        if (before > 0) {
            grown[before] = '\n';
        }
        memcpy(grown + before + (before > 0 ? 1 : 0), other->notes, more + 1);
    }
    return grown != NULL;
}

vtResult vtScene_Append(vtScene* scene, vtScene* other, const vtTransform* transform, vtError* error)
{
    if (scene == NULL || other == NULL || transform == NULL) {
        return vtFailMissing(error, "vtScene_Append",
                             scene == NULL   ? "scene"
                             : other == NULL ? "other"
                                             : "transform");
    }
    if (scene == other || isTooLong(scene->meshCount, other->meshCount) ||
        isTooLong(scene->materialCount, other->materialCount) ||
        isTooLong(scene->imageCount, other->imageCount) ||
        isTooLong(scene->objectCount, other->objectCount) ||
        isTooLong(scene->cameraCount, other->cameraCount) ||
        isTooLong(scene->lightCount, other->lightCount)) {
        return vtFail(error, vt_errorArgument, "scene: %s be appended to it; give another",
                      scene == other ? "it cannot itself" : "more than 2^31 things cannot");
    }
    if (!grow(&scene->meshes, scene->meshCount, other->meshCount, sizeof *scene->meshes) ||
        !grow(&scene->materials, scene->materialCount, other->materialCount, sizeof *scene->materials) ||
        !grow(&scene->images, scene->imageCount, other->imageCount, sizeof *scene->images) ||
        !grow(&scene->objects, scene->objectCount, other->objectCount, sizeof *scene->objects) ||
        !grow(&scene->cameras, scene->cameraCount, other->cameraCount, sizeof *scene->cameras) ||
        !grow(&scene->lights, scene->lightCount, other->lightCount, sizeof *scene->lights)) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for %u objects",
                      scene->objectCount + other->objectCount);
    }
    if (!appendNotes(scene, other)) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for the notes of both");
    }
    uint32_t bodies = 0; // numbers in use
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        bodies = scene->objects[i].body > bodies ? scene->objects[i].body : bodies;
    }
    for (uint32_t i = 0; i < other->objectCount; ++i) {
        vtObject* object = &scene->objects[scene->objectCount + i];
        *object = other->objects[i];
        object->body += object->body != 0 ? bodies : 0;
        object->mesh += scene->meshCount;
        object->material += scene->materialCount;
        object->toWorld = multiply(transform, &other->objects[i].toWorld);
    }
    for (uint32_t i = 0; i < other->materialCount; ++i) {
        vtMaterial* material = &scene->materials[scene->materialCount + i];
        *material = other->materials[i];
        for (int k = 0; k < vt_mapCount; ++k) {
            vtMap* map = &material->maps[k];
            map->image += map->image >= 0 ? (int)scene->imageCount : 0;
        }
    }
    for (uint32_t i = 0; i < other->lightCount; ++i) {
        vtLight* light = &scene->lights[scene->lightCount + i];
        *light = other->lights[i];
        light->position = vtTransformPoint(transform, light->position);
        light->direction = vtNormalize(vtTransformVector(transform, light->direction));
    }
    for (uint32_t i = 0; i < other->meshCount; ++i) {
        scene->meshes[scene->meshCount + i] = other->meshes[i];
    }
    for (uint32_t i = 0; i < other->imageCount; ++i) {
        scene->images[scene->imageCount + i] = other->images[i];
    }
    for (uint32_t i = 0; i < other->cameraCount; ++i) {
        scene->cameras[scene->cameraCount + i] = other->cameras[i];
    }
    scene->objectCount += other->objectCount;
    scene->materialCount += other->materialCount;
    scene->meshCount += other->meshCount;
    scene->imageCount += other->imageCount;
    scene->cameraCount += other->cameraCount;
    scene->lightCount += other->lightCount;
    other->meshCount = other->imageCount = 0; // what they hold has moved
    vtDestroyScene(other);
    return vtSucceed(error);
}

void vtDestroyScene(vtScene* scene)
{
    if (scene == NULL) {
        return;
    }
    for (uint32_t i = 0; scene->meshes != NULL && i < scene->meshCount; ++i) {
        vtDestroyMesh(&scene->meshes[i]);
    }
    for (uint32_t i = 0; scene->images != NULL && i < scene->imageCount; ++i) {
        vtFree(scene->images[i].pixels);
        vtFree(scene->images[i].bytes);
    }
    vtFree(scene->meshes);
    vtFree(scene->materials);
    vtFree(scene->images);
    vtFree(scene->objects);
    vtFree(scene->cameras);
    vtFree(scene->lights);
    vtFree(scene->notes);
    *scene = (vtScene){0};
}

vtResult vtScene_Complete(vtScene* scene, bool heights, bool innerDistances, bool* changed, vtError* error)
{
    const uint32_t relief = vtScene_Relief(scene);
    bool any = false;
    vtResult result = vtSucceed(error);
    for (uint32_t i = 0; scene->meshes != NULL && i < scene->meshCount && result == vt_ok; ++i) {
        vtMesh* mesh = &scene->meshes[i];
        const bool byHeights = heights && i == relief;
        if (mesh->heights != NULL && mesh->indexCount == 0 && !byHeights) {
            result = vtTriangulateRelief(mesh, error);
            any = true;
        }
        if (result == vt_ok && innerDistances && mesh->innerDistances == NULL &&
            vtScene_Uses(scene, i, false)) {
            result = vtComputeInnerDistances(mesh, error);
            any = true;
        }
    }
    if (changed != NULL) {
        *changed = any;
    }
    return result;
}

vtResult vtValidateScene(const vtScene* scene, vtError* error)
{
    vtPlacedObject* placed;
    uint32_t glassCount;
    const vtResult result = vtPlaceObjects(scene, &placed, &glassCount, error);
    vtFree(placed);
    return result == vt_ok ? vtSucceed(error) : result;
}
