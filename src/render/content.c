// What there is to draw: geometry, its instances, images and the environment, all at once or one by one.
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/about.h"
#include "base/error.h"
#include "gl/image_array.h"
#include "gl/picture_texture.h"
#include "gl/state.h"
#include "render/renderer.h"
#include "technique/technique.h"

vtResult vtCheckGiven(const vtRenderer* renderer, const void* thing, const char* what, vtError* error)
{
    if (renderer == NULL) {
        return vtFail(error, vt_errorArgument, "renderer: it is NULL; vtCreateRenderer makes one");
    }
    return thing != NULL ? vt_ok : vtFail(error, vt_errorArgument, "renderer: %s is NULL", what);
}

/// Begins a call that changes what there is to draw: what was drawn so far is no part of the next picture.
static vtResult beginChange(vtRenderer* renderer, const void* thing, const char* what, vtError* error)
{
    const vtResult result = vtCheckGiven(renderer, thing, what, error);
    if (result == vt_ok) {
        vtTakeState(&renderer->gl);
    }
    return result;
}

void vtForgetDrawn(vtRenderer* renderer)
{
    renderer->sampleEnd = 0;
    renderer->ground.isStale = true;
}

static vtResult endChange(vtRenderer* renderer, vtResult result, vtError* error)
{
    vtLeaveState(&renderer->gl);
    if (result == vt_ok) {
        vtForgetDrawn(renderer);
        return vtSucceed(error);
    }
    return result;
}

// ---------------------------------------------------------------------------------------------- the log

#ifdef VT_WITH_ABOUT
/// What the loader noted, line by line.
static void tellNotes(const vtRenderer* renderer, const char* notes)
{
    for (const char* line = notes; renderer->log != NULL && line != NULL && *line != '\0';) {
        char text[1024];
        const size_t length = strcspn(line, "\n");
        snprintf(text, sizeof text, "%.*s", (int)length, line);
        renderer->log(text, renderer->logData);
        line += length + (line[length] != '\0');
    }
}

static void say(const vtRenderer* renderer, const char* format, ...) VT_PRINTF(2, 3);
static void say(const vtRenderer* renderer, const char* format, ...)
{
    char line[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (renderer->log != NULL) {
        renderer->log(line, renderer->logData);
    }
}

/// What of a geometry is not drawn as its mesh has it.
static void tellOfGeometry(const vtRenderer* renderer, uint32_t at)
{
    const vtGeometryBuffer* geometry = &renderer->scene.geometry.items[at];
    const vtMesh* shape = &renderer->scene.geometry.shapes[at];
    if (geometry->overlaps) {
        say(renderer,
            "mesh %u: parts of it run into each other; as glass it is searched from both sides, which is "
            "slower",
            at);
    }
    if (shape->openEdgeCount > 0 && shape->indexCount > 0) {
        say(renderer, "mesh %u: %u open edges; as glass it has no volume that would absorb or enclose", at,
            shape->openEdgeCount);
    }
}

static void tellOfImages(const vtRenderer* renderer, const vtImage* images, uint32_t count)
{
    uint32_t missing = 0;
    for (uint32_t i = 0; i < count; ++i) {
        missing += images[i].pixels == NULL;
    }
    if (missing > 0) {
        say(renderer, "%u of %u pictures are not decoded and drawn as white", missing, count);
    }
}

static void tellOfEnvironment(const vtRenderer* renderer, const vtEnvironment* environment)
{
    if (environment->kind == vt_environmentImage && environment->width != 2 * environment->height) {
        say(renderer,
            "the environment is %d x %d pixels, not twice as wide as high; it is stretched over the sphere",
            environment->width, environment->height);
    }
}

static void tellOfScene(const vtRenderer* renderer, const vtScene* scene)
{
    if (scene->allGlass) {
        say(renderer, "no material says that it is glass, so all were made glass");
    }
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        if (vtScene_UsesSolid(scene, i)) {
            tellOfGeometry(renderer, i);
        }
    }
    tellOfImages(renderer, scene->images, scene->imageCount);
    if (renderer->scene.images.isReduced) {
        say(renderer, "pictures are drawn at %d x %d at most", renderer->scene.images.texture.width,
            renderer->scene.images.texture.width);
    }
    if (scene->lightCount > VT_MOST_LIGHTS) {
        say(renderer, "%u lights; the first %d are drawn", scene->lightCount, VT_MOST_LIGHTS);
    }
    for (uint32_t i = 0; i < renderer->scene.glassCount; ++i) {
        const vtObjectBuffer* object = &renderer->scene.objects[i];
        if (object->placed.thin && !object->material.thin) {
            say(renderer, "object %u has open edges and lies inside other glass; it is drawn as a thin wall",
                object->placed.object);
        }
    }
    tellNotes(renderer, scene->notes);
}
#else
#define tellOfGeometry(renderer, at)
#define tellOfImages(renderer, images, count)
#define tellOfScene(renderer, scene)
#define tellOfEnvironment(renderer, environment)
#endif

// ---------------------------------------------------------------------------------------- all at once

vtResult vtRenderer_SetScene(vtRenderer* renderer, const vtScene* scene, vtError* error)
{
    vtResult result = beginChange(renderer, scene, VT_ABOUT("the scene"), error);
    if (result != vt_ok) {
        return result;
    }
    vtSceneBuffer fresh;
    result = vtSceneBuffer_Create(&fresh, &renderer->gl, scene, error);
    if (result == vt_ok) {
        vtSceneBuffer_Destroy(&renderer->scene, &renderer->gl);
        renderer->scene = fresh;
        vtSlots_Clear(&renderer->geometrySlots);
        vtSlots_Clear(&renderer->instanceSlots);
        tellOfScene(renderer, scene);
    }
    return endChange(renderer, result, error);
}

vtResult vtRenderer_SetMesh(vtRenderer* renderer, const vtMesh* mesh, vtError* error)
{
    const vtResult result = vtCheckGiven(renderer, mesh, VT_ABOUT("the mesh"), error);
    vtBorrowedMesh borrowed;
    return result == vt_ok ? vtRenderer_SetScene(renderer, vtBorrowMesh(mesh, &borrowed), error) : result;
}

/// The handle of what is kept there: given out when it is first asked for.
static void giveHandle(vtSlots* slots, uint32_t at, uint32_t* index1, uint32_t* generation)
{
    if (!vtSlots_HandleOf(slots, at, index1, generation) && vtSlots_Reserve(slots)) {
        vtSlots_Add(slots, at, index1, generation);
    }
}

vtGeometryId vtRenderer_SceneGeometry(vtRenderer* renderer, uint32_t mesh)
{
    vtGeometryId id = {0};
    if (renderer != NULL && mesh < renderer->scene.geometry.count &&
        renderer->scene.geometry.items[mesh].isThere) {
        giveHandle(&renderer->geometrySlots, mesh, &id.index1, &id.generation);
    }
    return id;
}

vtInstanceId vtRenderer_SceneInstance(vtRenderer* renderer, uint32_t object)
{
    vtInstanceId id = {0};
    if (renderer != NULL && object < renderer->scene.instanceCount) {
        giveHandle(&renderer->instanceSlots, object, &id.index1, &id.generation);
    }
    return id;
}

// ------------------------------------------------------------------------------------------- geometry

static vtResult findGeometry(const vtRenderer* renderer, vtGeometryId id, uint32_t* at, vtError* error)
{
    return vtSlots_Find(&renderer->geometrySlots, id.index1, id.generation, at)
               ? vt_ok
               : vtFail(error, vt_errorArgument,
                        "geometry %u is not there; it was never added, or has been removed", id.index1);
}

static vtResult checkMesh(const vtMesh* mesh, vtError* error)
{
    const bool hasTriangles = mesh->indexCount > 0 && mesh->positions != NULL && mesh->indices != NULL;
    return hasTriangles || mesh->heights != NULL
               ? vt_ok
               : vtFail(error, vt_errorArgument, "geometry: the mesh is empty; vtCreateMesh makes one");
}

static bool hasRelief(const vtGeometryStore* store)
{
    bool found = false;
    for (uint32_t i = 0; i < store->count; ++i) {
        found = found || store->items[i].heights.cell > 0.0f;
    }
    return found;
}

vtResult vtRenderer_AddGeometry(vtRenderer* renderer, const vtMesh* mesh, vtGeometryId* id, vtError* error)
{
    vtResult result = vtCheckGiven(renderer, id, VT_ABOUT("the handle to be written"), error);
    if (result != vt_ok) {
        return result;
    }
    *id = (vtGeometryId){0};
    result = beginChange(renderer, mesh, VT_ABOUT("the mesh"), error);
    if (result != vt_ok) {
        return result;
    }
    result = checkMesh(mesh, error);
    if (result == vt_ok && !vtSlots_Reserve(&renderer->geometrySlots)) {
        result = vtFail(error, vt_errorMemory, "geometry: out of memory for its handle");
    }
    uint32_t at = 0;
    if (result == vt_ok) {
        // Of several reliefs one is drawn by its heights.
        const vtGeometryUse use = {true, true, true, !hasRelief(&renderer->scene.geometry)};
        result = vtGeometryStore_Add(&renderer->scene.geometry, &renderer->gl, mesh, use, &at, error);
    }
    if (result == vt_ok) {
        vtSlots_Add(&renderer->geometrySlots, at, &id->index1, &id->generation);
        tellOfGeometry(renderer, at);
    }
    return endChange(renderer, result, error);
}

vtResult vtRenderer_UpdateGeometry(vtRenderer* renderer, vtGeometryId id, const vtMesh* mesh, vtError* error)
{
    uint32_t at = 0;
    vtResult result = beginChange(renderer, mesh, VT_ABOUT("the mesh"), error);
    if (result != vt_ok) {
        return result;
    }
    result = findGeometry(renderer, id, &at, error);
    result = result == vt_ok ? checkMesh(mesh, error) : result;
    if (result == vt_ok) {
        result = vtGeometryStore_Update(&renderer->scene.geometry, &renderer->gl, at, mesh, error);
        renderer->scene.isStale = true;
    }
    return endChange(renderer, result, error);
}

static void removeInstance(vtRenderer* renderer, uint32_t at)
{
    vtSlots_Remove(&renderer->instanceSlots, at, renderer->scene.instanceCount - 1);
    vtSceneBuffer_RemoveInstance(&renderer->scene, at);
}

vtResult vtRenderer_RemoveGeometry(vtRenderer* renderer, vtGeometryId id, vtError* error)
{
    uint32_t at = 0;
    vtResult result = beginChange(renderer, renderer, VT_ABOUT("the renderer"), error);
    if (result != vt_ok) {
        return result;
    }
    result = findGeometry(renderer, id, &at, error);
    for (uint32_t i = renderer->scene.instanceCount; i > 0 && result == vt_ok; --i) {
        if (renderer->scene.instances[i - 1].mesh == at) {
            removeInstance(renderer, i - 1);
        }
    }
    if (result == vt_ok) {
        vtGeometryStore_Remove(&renderer->scene.geometry, &renderer->gl, at);
        vtSlots_Remove(&renderer->geometrySlots, at, at);
        renderer->scene.isStale = true;
    }
    return endChange(renderer, result, error);
}

// ------------------------------------------------------------------------------------------- instances

vtInstanceDef vtDefaultInstance(void)
{
    return (vtInstanceDef){.material = vtDefaultMaterial(), .toWorld = vtIdentityTransform()};
}

/// The instance as an object of a scene, checked by itself.
static vtResult checkInstance(const vtRenderer* renderer, const vtInstanceDef* def, vtObject* object,
                              vtError* error)
{
    uint32_t geometry = 0;
    const vtResult result = findGeometry(renderer, def->geometry, &geometry, error);
    if (result != vt_ok) {
        return result;
    }
    *object = (vtObject){.mesh = geometry, .toWorld = def->toWorld, .priority = def->priority};
    memcpy(object->name, def->name, sizeof object->name - 1);
    char name[96];
    snprintf(name, sizeof name, object->name[0] != '\0' ? "instance '%s'" : "an instance", object->name);
    return vtCheckObject(object, &def->material, name, error);
}

vtResult vtRenderer_AddInstance(vtRenderer* renderer, const vtInstanceDef* def, vtInstanceId* id,
                                vtError* error)
{
    vtObject object;
    vtResult result = vtCheckGiven(renderer, id, VT_ABOUT("the handle to be written"), error);
    if (result != vt_ok) {
        return result;
    }
    *id = (vtInstanceId){0};
    result = vtCheckGiven(renderer, def, VT_ABOUT("the instance"), error);
    result = result == vt_ok ? checkInstance(renderer, def, &object, error) : result;
    if (result != vt_ok) {
        return result;
    }
    if (renderer->scene.instanceCount >= VT_MAX_OBJECTS) {
        return vtFail(error, vt_errorArgument, "scene: it has %u objects already, and no more than %d fit",
                      renderer->scene.instanceCount, VT_MAX_OBJECTS);
    }
    if (!vtSlots_Reserve(&renderer->instanceSlots)) {
        return vtFail(error, vt_errorMemory, "instance: out of memory for its handle");
    }
    const uint32_t at = renderer->scene.instanceCount;
    result = vtSceneBuffer_AddInstance(&renderer->scene, &object, &def->material, error);
    if (result != vt_ok) {
        return result;
    }
    vtSlots_Add(&renderer->instanceSlots, at, &id->index1, &id->generation);
    vtForgetDrawn(renderer);
    return vtSucceed(error);
}

static vtResult findInstance(const vtRenderer* renderer, vtInstanceId id, uint32_t* at, vtError* error)
{
    return vtSlots_Find(&renderer->instanceSlots, id.index1, id.generation, at)
               ? vt_ok
               : vtFail(error, vt_errorArgument,
                        "instance %u is not there; it was never added, or has been removed", id.index1);
}

vtResult vtRenderer_SetInstance(vtRenderer* renderer, vtInstanceId id, const vtInstanceDef* def,
                                vtError* error)
{
    uint32_t at = 0;
    vtObject object;
    vtResult result = vtCheckGiven(renderer, def, VT_ABOUT("the instance"), error);
    result = result == vt_ok ? findInstance(renderer, id, &at, error) : result;
    result = result == vt_ok ? checkInstance(renderer, def, &object, error) : result;
    if (result != vt_ok) {
        return result;
    }
    object.material = at;
    renderer->scene.instances[at] = object;
    renderer->scene.materials[at] = def->material;
    renderer->scene.isStale = true;
    vtForgetDrawn(renderer);
    return vtSucceed(error);
}

vtResult vtRenderer_GetInstance(vtRenderer* renderer, vtInstanceId id, vtInstanceDef* def, vtError* error)
{
    uint32_t at = 0;
    vtResult result = vtCheckGiven(renderer, def, VT_ABOUT("the instance to be written"), error);
    result = result == vt_ok ? findInstance(renderer, id, &at, error) : result;
    if (result != vt_ok) {
        return result;
    }
    const vtObject* object = &renderer->scene.instances[at];
    const vtGeometryId geometry = vtRenderer_SceneGeometry(renderer, object->mesh);
    if (geometry.index1 == 0) {
        return vtFail(error, vt_errorMemory, "instance: out of memory for its geometry's handle");
    }
    *def = (vtInstanceDef){.geometry = geometry,
                           .material = renderer->scene.materials[at],
                           .toWorld = object->toWorld,
                           .priority = object->priority};
    memcpy(def->name, object->name, sizeof def->name);
    return vtSucceed(error);
}

vtResult vtRenderer_RemoveInstance(vtRenderer* renderer, vtInstanceId id, vtError* error)
{
    uint32_t at = 0;
    vtResult result = vtCheckGiven(renderer, renderer, VT_ABOUT("the renderer"), error);
    result = result == vt_ok ? findInstance(renderer, id, &at, error) : result;
    if (result != vt_ok) {
        return result;
    }
    removeInstance(renderer, at);
    vtForgetDrawn(renderer);
    return vtSucceed(error);
}

// --------------------------------------------------------------------------------- images, surroundings

vtResult vtRenderer_SetImages(vtRenderer* renderer, const vtImage* images, uint32_t count, vtError* error)
{
    vtResult result = beginChange(renderer, count > 0 ? (const void*)images : (const void*)renderer,
                                  VT_ABOUT("images"), error);
    if (result != vt_ok) {
        return result;
    }
    // The scene only lends its images to the upload.
    const vtScene lent = {.images = (vtImage*)(uintptr_t)images, .imageCount = count};
    result = vtImageArray_Upload(&renderer->scene.images, &renderer->gl, &lent, error);
    if (result == vt_ok) {
        renderer->scene.isStale = true; // its table of materials names layers
        tellOfImages(renderer, images, count);
    }
    return endChange(renderer, result, error);
}

vtResult vtRenderer_SetBackground(vtRenderer* renderer, const vtImage* picture, vtError* error)
{
    vtResult result = beginChange(renderer, renderer, VT_ABOUT("the renderer"), error);
    if (result != vt_ok) {
        return result;
    }
    if (picture == NULL) {
        vtTexture_Destroy(&renderer->background, &renderer->gl);
    } else {
        result = vtUploadPicture(&renderer->background, &renderer->gl, picture, GL_CLAMP_TO_EDGE,
                                 "background", error);
    }
    return endChange(renderer, result, error);
}

vtResult vtRenderer_SizeBackdrop(vtRenderer* renderer, int width, int height, vtError* error)
{
    return vtMakePictureTexture(&renderer->backdropPicture, &renderer->gl, width, height, GL_MIRRORED_REPEAT,
                                "backdrop", error);
}

vtResult vtRenderer_SetBackdrop(vtRenderer* renderer, const vtImage* picture, const vtBackdrop* backdrop,
                                vtError* error)
{
    vtResult result = backdrop != NULL ? vtValidateBackdrop(backdrop, error) : vt_ok;
    result = result == vt_ok ? beginChange(renderer, renderer, VT_ABOUT("the renderer"), error) : result;
    if (result != vt_ok) {
        return result;
    }
    if (backdrop == NULL) {
        vtTexture_Destroy(&renderer->backdropPicture, &renderer->gl);
    } else if (picture != NULL) {
        result = vtUploadPicture(&renderer->backdropPicture, &renderer->gl, picture, GL_MIRRORED_REPEAT,
                                 "backdrop", error);
    } else if (renderer->backdropPicture.name == 0) {
        result = vtFail(error, vt_errorArgument, "there is no picture for the backdrop; give one");
    }
    if (result == vt_ok) {
        renderer->hasBackdrop = backdrop != NULL;
        renderer->backdrop = backdrop != NULL ? *backdrop : vtDefaultBackdrop();
    }
    return endChange(renderer, result, error);
}

vtResult vtRenderer_SetEnvironment(vtRenderer* renderer, const vtEnvironment* environment, vtError* error)
{
    vtResult result = beginChange(renderer, environment, VT_ABOUT("the environment"), error);
    if (result != vt_ok) {
        return result;
    }
    result = vtEnvironmentBuffer_Set(&renderer->environment, &renderer->gl, environment, error);
    if (result == vt_ok) {
        tellOfEnvironment(renderer, environment);
    }
    return endChange(renderer, result, error);
}

// --------------------------------------------------------------------------------------------- ground

vtResult vtRenderer_SetGround(vtRenderer* renderer, const vtGround* ground, vtError* error)
{
    vtResult result = vtCheckGiven(renderer, renderer, "", error);
    result = result == vt_ok && ground != NULL ? vtValidateGround(ground, error) : result;
    if (result != vt_ok) {
        return result;
    }
    renderer->ground.isThere = ground != NULL;
    renderer->ground.ground = ground != NULL ? *ground : vtDefaultGround();
    vtForgetDrawn(renderer);
    return vtSucceed(error);
}
