// What a viewer shows: a scene put together of shapes, reliefs and models, its pictures, its cameras. The
// calls are like those of viewer.c.
#include <emscripten.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/error.h"
#include "core/viewer.h"
#include "image/image.h"
#include "relief/relief.h"
#include "scene/objects.h"

static const char* sentence(const vtViewer* viewer, vtResult result)
{
    return result == vt_ok ? NULL : viewer->error.message;
}

static void endPreparation(vtViewer* viewer)
{
    if (viewer->preparation != NULL) {
        vtEndPreparation(viewer->preparation, NULL);
        viewer->preparation = NULL;
    }
}

/// Begins a scene; nothing of it is seen before vtViewer_Show.
EMSCRIPTEN_KEEPALIVE void vtViewer_Begin(vtViewer* viewer)
{
    endPreparation(viewer);
    vtMotion_Clear(&viewer->nextMotion);
    vtDestroyScene(&viewer->next);
}

/// Adds a built-in shape or relief by name.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_AddShape(vtViewer* viewer, const char* name, const char* text)
{
    vtMesh mesh;
    vtObjectSpec spec;
    const int pattern = vtFindReliefPattern(name);
    vtResult result =
        vtViewer_ReadSpec(viewer, text, pattern >= 0 ? vt_kindReliefPattern : vtKindOfShape(name), &spec);
    if (result == vt_ok && pattern >= 0) {
        return sentence(viewer, vtViewer_AddPattern(viewer, pattern, &spec));
    }
    if (result == vt_ok) {
        result = vtObjectSpec_CreateShape(&spec, name, &mesh, &viewer->error);
    }
    return sentence(viewer, result == vt_ok ? vtViewer_AddMesh(viewer, &mesh, name, &spec) : result);
}

/// How the files added from here on are read: their glass, and a variant of their materials or "". What is
/// too long is cut, and no file has it then.
EMSCRIPTEN_KEEPALIVE void vtViewer_Expect(vtViewer* viewer, int walls, const char* variant)
{
    viewer->walls = walls < 0 ? vt_wallsAuto : (vtWalls)walls;
    snprintf(viewer->variant, sizeof viewer->variant, "%s", variant);
}

/// Adds the contents of a .glb or self-contained .gltf, or heights.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_AddModel(vtViewer* viewer, uint8_t* bytes, size_t size,
                                                   const char* name, const char* text, int source)
{
    if (vtIsPicture(bytes, size)) {
        return vtViewer_AddRelief(viewer, bytes, size, name, text, source);
    }
    vtScene made;
    vtModel* model = NULL;
    vtObjectSpec spec;
    const vtModelDef def = {.bytes = bytes,
                            .size = size,
                            .name = name,
                            .variant = viewer->variant,
                            .limits = VT_IS_FULL ? viewer->limits : (vtLimits){0}};
    vtResult result = vtViewer_ReadSpec(viewer, text, vt_kindMesh, &spec);
    if (result == vt_ok) {
        result = VT_IS_FULL ? vtOpenModel(&def, &model, &made, &viewer->error)
                            : vtLoadScene(&def, &made, &viewer->error);
    }
    free(bytes);
    if (result != vt_ok) {
        return sentence(viewer, result);
    }
    vtScene_SetWalls(&made, viewer->walls);
    const vtTransform transform = vtObjectSpec_Place(&spec);
    const vtModelPlace place = vtScene_NextPlace(&viewer->next, &transform);
    result = vtViewer_Add(viewer, &made, &spec);
    if (result != vt_ok) {
        vtCloseModel(model);
        return sentence(viewer, result);
    }
    return sentence(viewer, vtViewer_AddMotion(viewer, model, &place));
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

/// A picture that the browser has decoded, RGBA, top row first, from malloc, which a page's allocator is.
EMSCRIPTEN_KEEPALIVE void vtViewer_SetImage(vtViewer* viewer, int index, uint8_t* pixels, int width,
                                            int height)
{
    vtImage* image = &viewer->next.images[index];
    vtFree(image->pixels);
    image->pixels = pixels;
    image->width = width;
    image->height = height;
}

/// Builds what the scene that was begun is searched by, about so much of it (vtPreparation_Step). 1 once it
/// is whole, or cannot be: then vtViewer_Show tells why.
EMSCRIPTEN_KEEPALIVE int vtViewer_Build(vtViewer* viewer, int work)
{
    if (vtScene_HasRelief(&viewer->next)) {
        return 1; // it is searched by its heights
    }
    if (viewer->preparation == NULL) {
        viewer->preparation = vtBeginPreparation(&viewer->next);
    }
    if (viewer->preparation != NULL && !vtPreparation_Step(viewer->preparation, (uint32_t)work)) {
        return 0;
    }
    endPreparation(viewer);
    return 1;
}

/// Shows the scene that was begun; where it cannot be uploaded, the one before stays. A relief is shown by
/// its heights, so that no triangles are made before a technique asks for them.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_Show(vtViewer* viewer)
{
    endPreparation(viewer);
    const vtTechnique technique =
        vtScene_HasRelief(&viewer->next) ? vt_techniqueHeightField : viewer->frame.technique;
    vtResult result = vtPrepareScene(&viewer->next, technique, NULL, &viewer->error);
    if (result == vt_ok) {
        result = vtRenderer_SetScene(viewer->renderer, &viewer->next, &viewer->error);
    }
    if (result == vt_ok) {
        vtDestroyTracer(viewer->tracer);
        viewer->tracer = NULL;
        vtDestroyScene(&viewer->scene);
        viewer->scene = viewer->next;
        viewer->next = (vtScene){0};
        vtMotion_Clear(&viewer->motion);
        viewer->motion = viewer->nextMotion;
        viewer->nextMotion = (vtMotion){0};
        viewer->lowest = vtViewer_Lowest(viewer);
        if (technique == vt_techniqueHeightField) {
            viewer->frame.technique = technique;
            viewer->frame.output = vt_outputPicture; // it has no layers to show
        }
        viewer->changed = true;
    }
    vtMotion_Clear(&viewer->nextMotion);
    vtDestroyScene(&viewer->next);
    return sentence(viewer, result);
}

/// Reliefs go without their triangles again.
static void dropTriangles(vtScene* scene)
{
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        vtMesh* mesh = &scene->meshes[i];
        if (mesh->heights != NULL) {
            vtFree(mesh->positions);
            vtFree(mesh->normals);
            vtFree(mesh->indices);
            vtFree(mesh->innerDistances);
            mesh->positions = mesh->normals = mesh->innerDistances = NULL;
            mesh->indices = NULL;
            mesh->vertexCount = mesh->indexCount = 0;
        }
    }
}

vtResult vtViewer_PrepareScene(vtViewer* viewer, vtTechnique technique)
{
    bool changed;
    vtResult result = vtPrepareScene(&viewer->scene, technique, &changed, &viewer->error);
    if (result == vt_ok && changed) {
        result = vtRenderer_SetScene(viewer->renderer, &viewer->scene, &viewer->error);
    }
    if (result != vt_ok) {
        dropTriangles(&viewer->scene); // too many: those of another try
    }
    return result;
}

vtTechnique vtViewer_UsualTechnique(const vtViewer* viewer)
{
    return vtScene_HasRelief(&viewer->scene) ? vt_techniqueHeightField : vt_techniqueExact;
}

/// What of the files that are shown is left out or changed, a line each; NULL: nothing.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_Notes(const vtViewer* viewer)
{
    return viewer->scene.notes;
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
    const char* problem = vtViewer_AddModel(viewer, bytes, size, name, "", 0);
    return problem != NULL ? problem : vtViewer_Show(viewer);
}

/// Looks at the whole scene from the default direction, for a picture of that aspect.
EMSCRIPTEN_KEEPALIVE void vtViewer_ResetView(vtViewer* viewer, float aspect)
{
    viewer->frame.view = vtViewOfScene(&viewer->scene, viewer->frame.view.fovY, aspect);
    viewer->frame.orthographicHeight = 0.0f;
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
    viewer->frame.view = viewer->scene.cameras[index].view;
    viewer->frame.orthographicHeight = viewer->scene.cameras[index].orthographicHeight;
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
