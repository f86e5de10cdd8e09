// The scene on the GPU follows the caller's, whose vertices, objects, lights and materials have changed.
#include <stdio.h>
#include <string.h>

#include "base/about.h"
#include "base/error.h"
#include "gl/state.h"
#include "render/renderer.h"

/// Has the scene as many of everything as the renderer, and objects of the same meshes?
static bool isSetScene(const vtSceneBuffer* buffer, const vtScene* scene)
{
    bool same = scene->objectCount == buffer->instanceCount && scene->meshCount == buffer->geometry.count &&
                scene->lightCount == buffer->lightCount;
    for (uint32_t i = 0; same && i < scene->objectCount; ++i) {
        const vtObject* object = vtScene_Object(scene, i);
        same = object != NULL && object->mesh == buffer->instances[i].mesh;
    }
    for (uint32_t i = 0; same && i < scene->meshCount; ++i) {
        same = !buffer->geometry.items[i].isThere ||
               buffer->geometry.shapes[i].indexCount == scene->meshes[i].indexCount;
    }
    return same;
}

/// Takes an object over where it has changed.
static vtResult updateObject(vtSceneBuffer* buffer, const vtScene* scene, uint32_t index, vtError* error)
{
    const vtObject* given = &scene->objects[index];
    const vtMaterial* material = &scene->materials[given->material];
    vtObject object = *given;
    object.material = index;
    if (memcmp(&object, &buffer->instances[index], sizeof object) == 0 &&
        memcmp(material, &buffer->materials[index], sizeof *material) == 0) {
        return vt_ok;
    }
    char name[96];
    snprintf(name, sizeof name, "object %u ('%.63s')", index, given->name);
    const vtResult result = vtCheckObject(&object, material, name, error);
    if (result == vt_ok) {
        buffer->instances[index] = object;
        buffer->materials[index] = *material;
        buffer->isStale = true;
    }
    return result;
}

static vtResult updateScene(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, vtError* error)
{
    vtResult result = vt_ok;
    for (uint32_t i = 0; i < scene->meshCount && result == vt_ok; ++i) {
        if (buffer->geometry.items[i].isThere &&
            buffer->geometry.shapes[i].updates != scene->meshes[i].updates) {
            result = vtGeometryStore_Update(&buffer->geometry, gl, i, &scene->meshes[i], error);
            buffer->isStale = true;
        }
    }
    for (uint32_t i = 0; i < scene->objectCount && result == vt_ok; ++i) {
        result = updateObject(buffer, scene, i, error);
    }
    const size_t lights = scene->lightCount * sizeof *scene->lights;
    if (lights > 0 && memcmp(buffer->lights, scene->lights, lights) != 0) {
        memcpy(buffer->lights, scene->lights, lights);
        buffer->isStale = true;
    }
    return result;
}

vtResult vtRenderer_UpdateScene(vtRenderer* renderer, const vtScene* scene, vtError* error)
{
    vtResult result = vtCheckGiven(renderer, scene, VT_ABOUT("the scene"), error);
    if (result != vt_ok) {
        return result;
    }
    vtTakeState(&renderer->gl);
    if (isSetScene(&renderer->scene, scene)) {
        result = updateScene(&renderer->scene, &renderer->gl, scene, error);
    } else {
        result = vtFail(error, vt_errorArgument,
                        "scene: it is not the one that was set last; vtRenderer_SetScene takes another");
    }
    if (renderer->scene.isStale) {
        vtForgetDrawn(renderer);
    }
    vtLeaveState(&renderer->gl);
    return result == vt_ok ? vtSucceed(error) : result;
}
