#include "gl/scene_buffer.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "gl/material_table.h"
#include "gl/object_tree.h"

// --------------------------------------------------------------------------------------------- instances

/// Room for so many instances; false where memory is out.
static bool reserveInstances(vtSceneBuffer* buffer, uint32_t count)
{
    if (count <= buffer->instanceCapacity) {
        return true;
    }
    const uint32_t doubled = 2 * buffer->instanceCapacity, capacity = count > doubled ? count : doubled;
    vtObject* instances = vtReallocate(buffer->instances, capacity, sizeof *instances);
    buffer->instances = instances != NULL ? instances : buffer->instances;
    vtMaterial* materials = vtReallocate(buffer->materials, capacity, sizeof *materials);
    buffer->materials = materials != NULL ? materials : buffer->materials;
    if (instances == NULL || materials == NULL) {
        return false;
    }
    buffer->instanceCapacity = capacity;
    return true;
}

vtResult vtSceneBuffer_AddInstance(vtSceneBuffer* buffer, const vtObject* object, const vtMaterial* material,
                                   vtError* error)
{
    const uint32_t at = buffer->instanceCount;
    if (!reserveInstances(buffer, at + 1)) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for %u objects", at + 1);
    }
    buffer->instances[at] = *object;
    buffer->instances[at].material = at;
    buffer->materials[at] = *material;
    ++buffer->instanceCount;
    buffer->isStale = true;
    return vt_ok;
}

void vtSceneBuffer_RemoveInstance(vtSceneBuffer* buffer, uint32_t instance)
{
    const uint32_t last = --buffer->instanceCount;
    buffer->instances[instance] = buffer->instances[last];
    buffer->instances[instance].material = instance;
    buffer->materials[instance] = buffer->materials[last];
    buffer->isStale = true;
}

// ---------------------------------------------------------------------------------------------- placing

static void extend(vtVec3* low, vtVec3* high, const vtPlacedObject* placed)
{
    *low = (vtVec3){fminf(low->x, placed->low.x), fminf(low->y, placed->low.y), fminf(low->z, placed->low.z)};
    *high = (vtVec3){fmaxf(high->x, placed->high.x), fmaxf(high->y, placed->high.y),
                     fmaxf(high->z, placed->high.z)};
}

static void findBoxes(vtSceneBuffer* buffer)
{
    buffer->low = buffer->glassMin = (vtVec3){FLT_MAX, FLT_MAX, FLT_MAX};
    buffer->high = buffer->glassMax = (vtVec3){-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (uint32_t i = 0; i < buffer->objectCount; ++i) {
        extend(&buffer->low, &buffer->high, &buffer->objects[i].placed);
        if (i < buffer->glassCount || buffer->glassCount == 0) {
            extend(&buffer->glassMin, &buffer->glassMax, &buffer->objects[i].placed);
        }
    }
}

/// Objects in the coordinates they are drawn in, from the middle of the scene and of their meshes.
static void keepObjects(vtSceneBuffer* buffer, const vtPlacedObject* placed)
{
    buffer->space = vtSpaceOfObjects(placed, buffer->objectCount);
    for (uint32_t i = 0; i < buffer->lightCount; ++i) {
        buffer->placedLights[i] = vtLight_Enter(&buffer->lights[i], &buffer->space);
    }
    bool looks = buffer->lightCount > 0;
    for (uint32_t i = 0; i < buffer->objectCount; ++i) {
        const vtGeometryBuffer* geometry = &buffer->geometry.items[placed[i].meshIndex];
        const vtMesh* shape = placed[i].mesh;
        const vtMaterial* material = placed[i].material;
        const bool any = geometry->attributes.count > 0;
        vtObjectBuffer* object = &buffer->objects[i];
        *object = (vtObjectBuffer){
            .placed = placed[i],
            .material = *placed[i].material,
            .geometry = placed[i].meshIndex,
            .ownMin = vtSpace_Enter(&geometry->space, shape->boundsMin),
            .ownMax = vtSpace_Enter(&geometry->space, shape->boundsMax),
            .firstAttribute = any ? geometry->attributes.first : VT_NO_TRIANGLE,
            .firstMore = any && geometry->attributes.count > geometry->records.count
                             ? geometry->attributes.first + geometry->records.count
                             : VT_NO_TRIANGLE,
            .colorLayer = vtImageArray_Layer(&buffer->images, &material->maps[0], vt_mapBaseColor),
            .roughLayer = vtImageArray_Layer(&buffer->images, &material->maps[1], vt_mapMetallicRoughness),
            .bothSides = material->opaque ? !material->oneSided
                                          : material->alphaMode != vt_alphaOpaque || placed[i].thin ||
                                                shape->openEdgeCount > 0 || geometry->overlaps,
        };
        looks = looks || placed[i].thin || !vtMaterial_IsPlain(material, geometry->colored) ||
                (!material->opaque && buffer->instances[placed[i].object].body != 0);
        vtPlacedObject_Enter(&object->placed, &geometry->space, &buffer->space);
    }
    buffer->hasLooks = looks;
    findBoxes(buffer);
}

/// The first relief that has its heights here, of glass where there is one.
static uint32_t findRelief(const vtSceneBuffer* buffer)
{
    uint32_t relief = VT_NO_GEOMETRY;
    for (uint32_t i = 0; i < buffer->objectCount; ++i) {
        if (i == buffer->glassCount && relief != VT_NO_GEOMETRY) {
            break;
        }
        const uint32_t geometry = buffer->objects[i].geometry;
        const bool isRelief = buffer->geometry.items[geometry].heights.cell > 0.0f;
        relief = isRelief && geometry < relief ? geometry : relief;
    }
    return relief;
}

/// Room for what is made of so many objects; the table is to be uploaded anew.
static vtResult resizeObjects(vtSceneBuffer* buffer, uint32_t count, vtError* error)
{
    if (count == buffer->objectCount && buffer->objects != NULL) {
        return vt_ok;
    }
    const size_t table = VT_OBJECT_TEXELS * 4 * sizeof *buffer->words;
    vtFree(buffer->objects);
    vtFree(buffer->words);
    vtFree(buffer->fresh);
    vtFree(buffer->order);
    buffer->objects = vtAllocateZeroed(count, sizeof *buffer->objects);
    buffer->words = vtAllocateZeroed(count, table);
    buffer->fresh = vtAllocateZeroed(count, table);
    buffer->order = vtAllocateZeroed(count, sizeof *buffer->order);
    buffer->objectCount = buffer->glassCount = 0;
    if (buffer->objects == NULL || buffer->words == NULL || buffer->fresh == NULL || buffer->order == NULL) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for %u objects", count);
    }
    buffer->objectCount = count;
    return vt_ok;
}

vtResult vtSceneBuffer_Place(vtSceneBuffer* buffer, const vtGL* gl, vtError* error)
{
    if (!buffer->isStale) {
        return vt_ok;
    }
    const vtScene given = {.meshes = buffer->geometry.shapes,
                           .materials = buffer->materials,
                           .objects = buffer->instances,
                           .meshCount = buffer->geometry.count,
                           .materialCount = buffer->instanceCount,
                           .objectCount = buffer->instanceCount};
    vtPlacedObject* placed;
    uint32_t glassCount;
    vtResult result = vtPlaceShapes(&given, &placed, &glassCount, error);
    if (result == vt_ok) {
        result = resizeObjects(buffer, given.objectCount, error);
    }
    if (result == vt_ok) {
        buffer->glassCount = glassCount;
        keepObjects(buffer, placed);
        buffer->relief = findRelief(buffer);
        result = vtObjectTree_Upload(&buffer->tree, gl, buffer->objects, buffer->objectCount, error);
    }
    vtFree(placed);
    if (result == vt_ok && (buffer->hasLooks || buffer->glassCount < buffer->objectCount) &&
        buffer->images.texture.name == 0) {
        result = vtImageArray_Upload(&buffer->images, gl, &(vtScene){0}, error);
    }
    if (result == vt_ok && buffer->hasLooks) {
        result = vtMaterialTable_Upload(&buffer->looks, gl, buffer->objects, buffer->objectCount,
                                        buffer->placedLights, buffer->lightCount, &buffer->images, error);
    }
    buffer->isStale = result != vt_ok;
    return result;
}

// --------------------------------------------------------------------------------------- a scene at once

static uint32_t reliefOf(const vtScene* scene)
{
    const uint32_t relief = vtScene_Relief(scene);
    return relief < scene->meshCount ? relief : VT_NO_GEOMETRY;
}

/// What the scene's objects, which are valid, use of its meshes.
static void findUses(const vtScene* scene, vtGeometryUse* uses)
{
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtObject* object = &scene->objects[i];
        const vtMaterial* material = &scene->materials[object->material];
        uses[object->mesh].any = true;
        uses[object->mesh].glass |= !material->opaque && !material->thin;
        uses[object->mesh].attributes |=
            material->opaque || !vtMaterial_IsPlain(material, scene->meshes[object->mesh].colors != NULL);
    }
    const uint32_t relief = reliefOf(scene);
    if (relief != VT_NO_GEOMETRY) {
        uses[relief].heights = true;
    }
}

static vtResult addScene(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, vtError* error)
{
    vtGeometryUse* uses = vtAllocateZeroed(scene->meshCount, sizeof *uses);
    vtResult result = vt_ok;
    if (uses == NULL || !reserveInstances(buffer, scene->objectCount)) {
        result = vtFail(error, vt_errorMemory, "scene: out of memory for %u objects", scene->objectCount);
    }
    if (result == vt_ok) {
        findUses(scene, uses);
        result = vtGeometryStore_AddAll(&buffer->geometry, gl, scene->meshes, scene->meshCount, uses, error);
    }
    for (uint32_t i = 0; i < scene->objectCount && result == vt_ok; ++i) {
        const vtMaterial* material = &scene->materials[scene->objects[i].material];
        result = vtSceneBuffer_AddInstance(buffer, &scene->objects[i], material, error);
    }
    if (result == vt_ok && scene->imageCount > 0) {
        result = vtImageArray_Upload(&buffer->images, gl, scene, error);
    }
    if (result == vt_ok && scene->lightCount > 0) {
        buffer->lights = vtAllocate(scene->lightCount, sizeof *buffer->lights);
        buffer->placedLights = vtAllocate(scene->lightCount, sizeof *buffer->placedLights);
        const bool ready = buffer->lights != NULL && buffer->placedLights != NULL;
        buffer->lightCount = ready ? scene->lightCount : 0;
        if (!ready) {
            result = vtFail(error, vt_errorMemory, "scene: out of memory for %u lights", scene->lightCount);
        } else {
            memcpy(buffer->lights, scene->lights, scene->lightCount * sizeof *buffer->lights);
        }
    }
    vtFree(uses);
    return result;
}

vtResult vtSceneBuffer_Create(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, vtError* error)
{
    *buffer = (vtSceneBuffer){.relief = VT_NO_GEOMETRY};
    vtResult result = vtValidateScene(scene, error);
    if (result == vt_ok) {
        result = addScene(buffer, gl, scene, error);
    }
    if (result == vt_ok) {
        result = vtSceneBuffer_Place(buffer, gl, error);
    }
    result = result == vt_ok ? vtCheckGL(gl, "uploading the scene", error) : result;
    if (result != vt_ok) {
        vtSceneBuffer_Destroy(buffer, gl);
    }
    return result;
}

void vtSceneBuffer_DropTables(vtSceneBuffer* buffer, const vtGL* gl)
{
    vtTexture_Destroy(&buffer->tree, gl);
    vtTexture_Destroy(&buffer->looks, gl);
    vtTexture_Destroy(&buffer->table, gl);
    buffer->isStale = true;
}

void vtSceneBuffer_Destroy(vtSceneBuffer* buffer, const vtGL* gl)
{
    vtSceneBuffer_DropTables(buffer, gl);
    vtGeometryStore_Destroy(&buffer->geometry, gl);
    vtFree(buffer->instances);
    vtFree(buffer->materials);
    vtFree(buffer->objects);
    vtFree(buffer->words);
    vtFree(buffer->fresh);
    vtFree(buffer->order);
    vtImageArray_Destroy(&buffer->images, gl);
    vtFree(buffer->lights);
    vtFree(buffer->placedLights);
    *buffer = (vtSceneBuffer){.relief = VT_NO_GEOMETRY};
}

// ---------------------------------------------------------------------------------------------- drawing

bool vtSceneBuffer_SetTable(vtSceneBuffer* buffer, const vtGL* gl)
{
    const size_t size = (size_t)buffer->objectCount * VT_OBJECT_TEXELS * 4 * sizeof *buffer->words;
    const bool resized =
        vtTexture_Resize(&buffer->table, gl, GL_RGBA32UI, VT_OBJECT_TEXELS, (int)buffer->objectCount, 0);
    if (!resized && memcmp(buffer->fresh, buffer->words, size) == 0) {
        return false;
    }
    memcpy(buffer->words, buffer->fresh, size);
    vtTexture_Bind(&buffer->table, gl, vt_samplerNone);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, VT_OBJECT_TEXELS, (GLsizei)buffer->objectCount, GL_RGBA_INTEGER,
                      GL_UNSIGNED_INT, buffer->words);
    return true;
}

static float distanceFrom(vtVec3 eye, const vtPlacedObject* placed)
{
    return vtLength(vtSub(vtScale(vtAdd(placed->low, placed->high), 0.5f), eye));
}

void vtSceneBuffer_SortGlass(vtSceneBuffer* buffer, vtVec3 eye)
{
    for (uint32_t i = 0; i < buffer->glassCount; ++i) {
        const float distance = distanceFrom(eye, &buffer->objects[i].placed);
        uint32_t place = i;
        while (place > 0 && distanceFrom(eye, &buffer->objects[buffer->order[place - 1]].placed) > distance) {
            buffer->order[place] = buffer->order[place - 1];
            --place;
        }
        buffer->order[place] = i;
    }
}

void vtSceneBuffer_Draw(const vtSceneBuffer* buffer, const vtGL* gl, const vtProgram* program, uint32_t first,
                        uint32_t last)
{
    for (uint32_t i = first; i < last; ++i) {
        const vtPlacedObject* placed = &buffer->objects[i].placed;
        // In the order of VT_OBJECT_UNIFORMS.
        gl->Uniform4fv(program->uniforms[0], 3, &placed->toWorld.rows[0][0]);
        gl->Uniform4fv(program->uniforms[1], 3, &placed->toObject.rows[0][0]);
        gl->Uniform1i(program->uniforms[2], (GLint)i);
        gl->Uniform1i(program->uniforms[3], placed->mirrored);
        const bool oneSided = buffer->objects[i].material.opaque && buffer->objects[i].material.oneSided;
        if (oneSided) {
            gl->Enable(GL_CULL_FACE);
            gl->CullFace(placed->mirrored ? GL_FRONT : GL_BACK);
        }
        vtMeshBuffer_Draw(&buffer->geometry.items[buffer->objects[i].geometry].vertices, gl);
        if (oneSided) {
            gl->Disable(GL_CULL_FACE);
        }
    }
}

size_t vtSceneBuffer_TextureBytes(const vtSceneBuffer* buffer)
{
    return vtTexture_Bytes(&buffer->geometry.attributes) + vtTexture_Bytes(&buffer->images.texture) +
           vtTexture_Bytes(&buffer->looks) + vtTexture_Bytes(&buffer->table) +
           vtTexture_Bytes(&buffer->tree) + vtGeometryStore_HeightBytes(&buffer->geometry);
}
