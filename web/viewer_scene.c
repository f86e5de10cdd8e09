// What a viewer shows: a scene put together of shapes and models, its pictures, its cameras. The calls are
// like those of viewer.c.
#include <emscripten.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "scene/object_spec.h"
#include "viewer.h"

static const char* sentence(const vtViewer* viewer, vtResult result)
{
    return result == vt_ok ? NULL : viewer->error.message;
}

/// Begins a scene; nothing of it is seen before vtViewer_Show.
EMSCRIPTEN_KEEPALIVE void vtViewer_Begin(vtViewer* viewer)
{
    vtDestroyScene(&viewer->next);
}

/// Moves what was made into the scene that was begun. `spec`: an object's line of text (scene/object_spec.h);
/// empty: as it is.
static vtResult add(vtViewer* viewer, vtScene* made, const char* spec)
{
    vtTransform place = vtIdentityTransform();
    vtResult result = vt_ok;
    if (*spec != '\0') {
        vtObjectSpec* parsed = malloc(sizeof *parsed);
        result = parsed != NULL ? vtParseObject(spec, "objects", false, parsed, &viewer->error)
                                : vtFail(&viewer->error, vt_errorMemory, "objects: out of memory");
        if (result == vt_ok) {
            result = vtObjectSpec_Check(parsed, vt_kindMesh, "objects", &viewer->error);
        }
        if (result == vt_ok) {
            vtObjectSpec_Apply(parsed, made);
            place = vtObjectSpec_Place(parsed);
        }
        free(parsed);
    }
    if (result == vt_ok) {
        result = vtScene_Append(&viewer->next, made, &place, &viewer->error);
    }
    vtDestroyScene(made);
    return result;
}

/// Adds a built-in shape by name.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_AddShape(vtViewer* viewer, const char* name, const char* spec)
{
    vtMesh mesh;
    vtScene made = {0};
    vtMaterial material = vtDefaultMaterial();
    material.opaque = strcmp(name, "plane") == 0; // it has no volume
    vtResult result = vtCreateShape(name, &mesh, &viewer->error);
    if (result == vt_ok) {
        result = vtCreateMeshScene(&mesh, &material, &made, &viewer->error);
        vtDestroyMesh(&mesh);
    }
    if (result == vt_ok) {
        snprintf(made.objects[0].name, sizeof made.objects[0].name, "%.63s", name);
        result = add(viewer, &made, spec);
    }
    return sentence(viewer, result);
}

/// Adds the contents of a .glb or self-contained .gltf.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_AddModel(vtViewer* viewer, uint8_t* bytes, size_t size,
                                                   const char* name, const char* spec)
{
    vtScene made;
    const vtModelDef def = {.bytes = bytes, .size = size, .name = name};
    vtResult result = vtLoadScene(&def, &made, &viewer->error);
    free(bytes);
    return sentence(viewer, result == vt_ok ? add(viewer, &made, spec) : result);
}

/// Pictures of the scene that was begun.
EMSCRIPTEN_KEEPALIVE int vtViewer_ImageCount(const vtViewer* viewer)
{
    return (int)viewer->next.imageCount;
}

/// The bytes of a picture that is not decoded yet, else NULL; vtViewer_ImageSize of them.
EMSCRIPTEN_KEEPALIVE const uint8_t* vtViewer_ImageBytes(const vtViewer* viewer, int index)
{
    const vtImage* image = &viewer->next.images[index];
    return image->pixels == NULL ? image->bytes : NULL;
}

EMSCRIPTEN_KEEPALIVE int vtViewer_ImageSize(const vtViewer* viewer, int index)
{
    return (int)viewer->next.images[index].size;
}

/// A picture that the browser has decoded, RGBA, top row first.
EMSCRIPTEN_KEEPALIVE void vtViewer_SetImage(vtViewer* viewer, int index, uint8_t* pixels, int width,
                                            int height)
{
    vtImage* image = &viewer->next.images[index];
    free(image->pixels);
    image->pixels = pixels;
    image->width = width;
    image->height = height;
}

/// Shows the scene that was begun; where it cannot be uploaded, the one before stays.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_Show(vtViewer* viewer)
{
    vtResult result = vtPrepareScene(&viewer->next, viewer->frame.technique, NULL, &viewer->error);
    if (result == vt_ok) {
        result = vtRenderer_SetScene(viewer->renderer, &viewer->next, &viewer->error);
    }
    if (result == vt_ok) {
        vtDestroyScene(&viewer->scene);
        viewer->scene = viewer->next;
        viewer->next = (vtScene){0};
        viewer->changed = true;
    }
    vtDestroyScene(&viewer->next);
    return sentence(viewer, result);
}

/// A scene of one shape.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_SetShape(vtViewer* viewer, const char* name)
{
    vtViewer_Begin(viewer);
    const char* problem = vtViewer_AddShape(viewer, name, "");
    return problem != NULL ? problem : vtViewer_Show(viewer);
}

/// A scene of one model, its pictures white.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_OpenModel(vtViewer* viewer, uint8_t* bytes, size_t size,
                                                    const char* name)
{
    vtViewer_Begin(viewer);
    const char* problem = vtViewer_AddModel(viewer, bytes, size, name, "");
    return problem != NULL ? problem : vtViewer_Show(viewer);
}

/// Looks at the whole scene from the default direction, for a picture of that aspect.
EMSCRIPTEN_KEEPALIVE void vtViewer_ResetView(vtViewer* viewer, float aspect)
{
    viewer->frame.view = vtFrameScene(&viewer->scene, viewer->frame.view.fovY, aspect);
    viewer->changed = true;
}

/// Looks through a camera of the model.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_UseCamera(vtViewer* viewer, int index)
{
    const int count = (int)viewer->scene.cameraCount;
    if (index < 0 || index >= count) {
        vtFail(&viewer->error, vt_errorArgument,
               count > 0 ? "camera-index is %d; the model has the cameras 0 to %d"
                         : "camera-index is %d, but the model has no camera; leave it away",
               index, count - 1);
        return viewer->error.message;
    }
    viewer->frame.view = viewer->scene.cameras[index];
    viewer->changed = true;
    return NULL;
}

static const vtMaterial* materialOf(const vtScene* scene, uint32_t object)
{
    return &scene->materials[scene->objects[object].material];
}

vtSceneFacts vtViewer_SceneFacts(const vtViewer* viewer)
{
    const vtScene* scene = &viewer->scene;
    vtSceneFacts facts = {0};
    bool differs = false;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtMaterial* material = materialOf(scene, i);
        if (material->opaque) {
            continue;
        }
        const vtMesh* mesh = &scene->meshes[scene->objects[i].mesh];
        facts.triangles += mesh->indexCount / 3;
        facts.openEdges += mesh->openEdgeCount;
        differs = differs || (facts.glassCount > 0 && facts.ior != material->ior);
        facts.ior = material->ior;
        ++facts.glassCount;
    }
    facts.ior = viewer->frame.ior > 0.0f ? viewer->frame.ior : differs ? 0.0f : facts.ior;
    return facts;
}
