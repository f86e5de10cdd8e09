// The objects of a frame beside those of the frame before: only what differs is told to the renderer.
#include <emscripten.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "three/three.h"

static vtMap readMap(const vtThreeMap* given)
{
    vtMap map = {.image = given->image,
                 .texcoords = given->texcoords,
                 .wrapX = (vtWrap)given->wrapX,
                 .wrapY = (vtWrap)given->wrapY,
                 .nearest = given->nearest != 0};
    memcpy(map.rows, given->rows, sizeof map.rows);
    return map;
}

static vtMaterial readMaterial(const vtThreeMaterial* given)
{
    vtMaterial material = vtDefaultMaterial();
    material.opaque = given->opaque != 0;
    material.thin = given->thin != 0;
    material.unlit = given->unlit != 0;
    material.ior = given->ior;
    material.tint = material.baseColor = given->color;
    material.transmission = given->transmission;
    material.attenuationColor = given->attenuationColor;
    material.attenuationDistance = given->attenuationDistance;
    material.metallic = given->metallic;
    material.roughness = given->roughness;
    material.emissive = given->emissive;
    material.alphaMode = (vtAlpha)given->alphaMode;
    material.alpha = given->alpha;
    material.alphaCutoff = given->alphaCutoff;
    material.specular = given->specular;
    material.specularColor = given->specularColor;
    material.iridescence = given->iridescence;
    material.iridescenceIor = given->iridescenceIor;
    material.iridescenceMin = given->iridescenceMin;
    material.iridescenceMax = given->iridescenceMax;
    material.dispersion = given->dispersion;
    material.normalScale = given->normalScale;
    material.occlusionStrength = given->occlusionStrength;
    for (int i = 0; i < vt_mapCount; ++i) {
        material.maps[i] = readMap(&given->maps[i]);
    }
    return material;
}

/// Room for so many; false where memory is out.
static bool grow(vtThree* three, uint32_t objectCount, uint32_t materialCount)
{
    void* objects = vtReallocate(three->objects, objectCount + 1, sizeof *three->objects);
    three->objects = objects != NULL ? objects : three->objects;
    void* materials = vtReallocate(three->materials, materialCount + 1, sizeof *three->materials);
    three->materials = materials != NULL ? materials : three->materials;
    void* instances = vtReallocate(three->instances, objectCount + 1, sizeof *three->instances);
    three->instances = instances != NULL ? instances : three->instances;
    return objects != NULL && materials != NULL && instances != NULL;
}

/// The instance of object `i`, added or changed; one whose geometry has been removed is added anew.
static vtResult place(vtThree* three, uint32_t i, const vtThreeObject* object,
                      const vtThreeMaterial* materials)
{
    vtInstanceDef def = vtDefaultInstance();
    def.geometry = three->geometries[object->geometry - 1].id;
    def.material = readMaterial(&materials[object->material]);
    def.toWorld = object->toWorld;
    vtInstanceId* instance = &three->instances[i];
    if (i < three->objectCount &&
        vtRenderer_SetInstance(three->renderer, *instance, &def, &three->error) == vt_ok) {
        return vt_ok;
    }
    if (i < three->objectCount) {
        vtRenderer_RemoveInstance(three->renderer, *instance, NULL);
    }
    return vtRenderer_AddInstance(three->renderer, &def, instance, &three->error);
}

/// These objects of these materials are drawn from now on; all their geometry can be (vtThree_Build). On
/// failure nothing is.
EMSCRIPTEN_KEEPALIVE const char* vtThree_Place(vtThree* three, const vtThreeObject* objects,
                                               uint32_t objectCount, const vtThreeMaterial* materials,
                                               uint32_t materialCount)
{
    vtResult result = vt_ok;
    for (; three->objectCount > objectCount; --three->objectCount) {
        vtRenderer_RemoveInstance(three->renderer, three->instances[three->objectCount - 1], NULL);
    }
    if (!grow(three, objectCount, materialCount)) {
        result = vtFail(&three->error, vt_errorMemory, "objects: out of memory for %u", objectCount);
    }
    for (uint32_t i = 0; i < objectCount && result == vt_ok; ++i) {
        const vtThreeObject* object = &objects[i];
        const bool same =
            i < three->objectCount && object->material < three->materialCount &&
            memcmp(object, &three->objects[i], sizeof *object) == 0 &&
            memcmp(&materials[object->material], &three->materials[object->material], sizeof *materials) == 0;
        result = same ? vt_ok : place(three, i, object, materials);
        three->objectCount = result == vt_ok && i == three->objectCount ? i + 1 : three->objectCount;
    }
    three->materialCount = 0;
    if (result == vt_ok) {
        memcpy(three->objects, objects, objectCount * sizeof *objects);
        memcpy(three->materials, materials, materialCount * sizeof *materials);
        three->materialCount = materialCount;
    } else {
        memset(three->objects, 0, three->objectCount * sizeof *objects); // none is the same next time
    }
    return result == vt_ok ? NULL : three->error.message;
}
