// What web/three/core.js calls, one vtThree a renderer of three.js's, whose context it makes current before
// each call. A call that can fail returns the sentence of its vtError, or NULL. Memory handed over from
// JavaScript comes from malloc, which a page's allocator is, and is freed here.
#include "three/three.h"

#include <emscripten.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "render/renderer.h"

static const char* sentence(const vtThree* three, vtResult result)
{
    return result == vt_ok ? NULL : three->error.message;
}

/// In the current context; NULL where memory is out. See vtThree_Error.
EMSCRIPTEN_KEEPALIVE vtThree* vtThree_Create(void)
{
    vtThree* three = vtAllocateZeroed(1, sizeof *three);
    if (three != NULL) {
        vtRendererDef def = {0}; // on the web GL is linked
        vtCreateRenderer(&def, &three->renderer, &three->error);
    }
    return three;
}

static void dropGeometry(vtThreeGeometry* geometry)
{
    if (geometry->preparation != NULL) {
        vtEndPreparation(geometry->preparation, NULL);
    }
    vtDestroyScene(&geometry->scene);
    *geometry = (vtThreeGeometry){0};
}

EMSCRIPTEN_KEEPALIVE void vtThree_Destroy(vtThree* three)
{
    vtDestroyRenderer(three->renderer);
    for (uint32_t i = 0; i < three->geometryCount; ++i) {
        dropGeometry(&three->geometries[i]);
    }
    vtFree(three->geometries);
    vtFree(three->objects);
    vtFree(three->materials);
    vtFree(three->instances);
    vtFree(three);
}

/// The sentence of the call that failed last; empty where none did.
EMSCRIPTEN_KEEPALIVE const char* vtThree_Error(const vtThree* three)
{
    return three->error.message;
}

/// Shaders that are loaded once a frame lacks them (vtRenderer_SetLaterShaders); the page keeps them.
EMSCRIPTEN_KEEPALIVE const char* vtThree_SetShaders(vtThree* three, const char* file)
{
    return sentence(three, vtRenderer_SetLaterShaders(three->renderer, file, &three->error));
}

/// Surroundings: 3 * width * height floats, linear, equirectangular, top row first.
EMSCRIPTEN_KEEPALIVE const char* vtThree_SetEnvironment(vtThree* three, float* pixels, int width, int height)
{
    vtEnvironment environment = {vt_environmentImage, pixels, width, height};
    const vtResult result = vtRenderer_SetEnvironment(three->renderer, &environment, &three->error);
    vtDestroyEnvironment(&environment);
    return sentence(three, result);
}

/// The pictures that materials name, one after the other: width, height, whether its numbers are linear, and
/// where its pixels are, RGBA, top row first.
EMSCRIPTEN_KEEPALIVE const char* vtThree_SetImages(vtThree* three, const uint32_t* table, uint32_t count)
{
    vtImage* images = vtAllocateZeroed(count > 0 ? count : 1, sizeof *images);
    if (images == NULL) {
        return sentence(three, vtFail(&three->error, vt_errorMemory, "pictures: out of memory"));
    }
    for (uint32_t i = 0; i < count; ++i, table += 4) {
        images[i] = (vtImage){.pixels = (uint8_t*)(uintptr_t)table[3],
                              .width = (int)table[0],
                              .height = (int)table[1],
                              .linear = table[2] != 0};
    }
    const vtResult result = vtRenderer_SetImages(three->renderer, images, count, &three->error);
    vtFree(images);
    return sentence(three, result);
}

// -------------------------------------------------------------------------------------------- geometry

/// A free place; 0 where memory is out.
static uint32_t findPlace(vtThree* three)
{
    for (uint32_t i = 0; i < three->geometryCount; ++i) {
        if (three->geometries[i].scene.meshCount == 0) {
            return i + 1;
        }
    }
    const uint32_t count = three->geometryCount;
    void* larger = vtReallocate(three->geometries, count + 1, sizeof *three->geometries);
    if (larger == NULL) {
        return 0;
    }
    three->geometries = larger;
    three->geometries[count] = (vtThreeGeometry){0};
    three->geometryCount = count + 1;
    return count + 1;
}

/// Takes triangles over: 3 positions and normals, 2 and 2 texture coordinates and 3 colours a vertex, 0 where
/// there are none; indices or 0. Its number, from 1; 0 where it failed, see vtThree_Error.
EMSCRIPTEN_KEEPALIVE uint32_t vtThree_AddGeometry(vtThree* three, const char* name, uint32_t vertexCount,
                                                  uint32_t indexCount, float* positions, float* normals,
                                                  float* texcoords, float* texcoords1, float* colors,
                                                  uint32_t* indices)
{
    const vtMeshDef def = {.positions = positions,
                           .normals = normals,
                           .texcoords = texcoords,
                           .texcoords1 = texcoords1,
                           .colors = colors,
                           .indices = indices,
                           .vertexCount = vertexCount,
                           .indexCount = indexCount};
    const vtMaterial material = vtDefaultMaterial();
    vtMesh mesh;
    vtScene scene = {0};
    vtResult result = vtCreateMesh(&def, name, &mesh, &three->error);
    result = result == vt_ok ? vtCreateMeshScene(&mesh, &material, &scene, &three->error) : result;
    const uint32_t number = result == vt_ok ? findPlace(three) : 0;
    if (result == vt_ok && number == 0) {
        vtFail(&three->error, vt_errorMemory, "%s: out of memory", name);
    }
    if (number != 0) {
        three->geometries[number - 1].scene = scene;
    } else {
        vtDestroyScene(&scene);
    }
    vtDestroyMesh(&mesh); // empty where the scene has it
    float* const given[] = {positions, normals, texcoords, texcoords1, colors};
    for (int i = 0; i < 5; ++i) {
        vtFree(given[i]);
    }
    vtFree(indices);
    return number;
}

/// Goes on with a geometry's hierarchy, about so much work (vtPreparation_Step), and uploads it. 1: it can be
/// drawn, 0: ask again, -1: failed, see vtThree_Error.
EMSCRIPTEN_KEEPALIVE int vtThree_Build(vtThree* three, uint32_t number, uint32_t work)
{
    vtThreeGeometry* geometry = &three->geometries[number - 1];
    if (geometry->id.index1 != 0) {
        return 1;
    }
    if (geometry->preparation == NULL) {
        geometry->preparation = vtBeginPreparation(&geometry->scene);
    }
    if (geometry->preparation != NULL && !vtPreparation_Step(geometry->preparation, work)) {
        return 0;
    }
    vtResult result = geometry->preparation != NULL
                          ? vtEndPreparation(geometry->preparation, &three->error)
                          : vtFail(&three->error, vt_errorMemory, "geometry: out of memory");
    geometry->preparation = NULL;
    if (result == vt_ok) {
        result =
            vtRenderer_AddGeometry(three->renderer, &geometry->scene.meshes[0], &geometry->id, &three->error);
    }
    return result == vt_ok ? 1 : -1;
}

/// Moves the vertices of a geometry that can be drawn: positions, and normals or 0.
EMSCRIPTEN_KEEPALIVE const char* vtThree_UpdateGeometry(vtThree* three, uint32_t number, float* positions,
                                                        float* normals)
{
    vtThreeGeometry* geometry = &three->geometries[number - 1];
    vtMesh* mesh = &geometry->scene.meshes[0];
    vtResult result = vtMesh_Update(mesh, positions, normals, &three->error);
    vtFree(positions);
    vtFree(normals);
    if (result == vt_ok) {
        result = vtRenderer_UpdateGeometry(three->renderer, geometry->id, mesh, &three->error);
    }
    return sentence(three, result);
}

/// Objects that have it go, too.
EMSCRIPTEN_KEEPALIVE void vtThree_RemoveGeometry(vtThree* three, uint32_t number)
{
    vtThreeGeometry* geometry = &three->geometries[number - 1];
    for (uint32_t i = 0; i < three->objectCount; ++i) { // the number may come again
        three->objects[i].geometry = three->objects[i].geometry == number ? 0 : three->objects[i].geometry;
    }
    if (geometry->id.index1 != 0) {
        vtRenderer_RemoveGeometry(three->renderer, geometry->id, NULL);
    }
    dropGeometry(geometry);
}

// ----------------------------------------------------------------------------------------------- frame

/// Draws what was placed over nothing, in linear light. 1: drawn, 2: shaders are not compiled yet, 3: they
/// are to be loaded (vtThree_SetShaders), -1: failed, see vtThree_Error.
EMSCRIPTEN_KEEPALIVE int vtThree_Draw(vtThree* three, const vtThreeFrame* asked)
{
    vtFrame frame = vtDefaultFrame();
    frame.viewMatrix = asked->view;
    frame.projectionMatrix = asked->projection;
    frame.width = asked->width;
    frame.height = asked->height;
    frame.framebuffer = asked->framebuffer;
    frame.hostColor = asked->color;
    frame.hostDepth = asked->depth;
    frame.hostLinear = frame.linear = frame.overlay = frame.hostOpaque = true;
    frame.hostLevels = asked->levels != 0;
    frame.exposure = asked->exposure;
    frame.samples = asked->samples;
    frame.preset = (vtPreset)asked->preset;
    frame.maxEvents = asked->maxEvents;
    frame.branches = asked->branches;
    frame.fresnel = asked->fresnel != 0;
    bool ready = false;
    if (vtRenderer_Prepare(three->renderer, &frame, &ready, &three->error) != vt_ok) {
        return -1;
    }
    if (!ready) {
        return three->renderer->lacksShaders ? 3 : 2;
    }
    return vtRenderer_Draw(three->renderer, &frame, &three->error) == vt_ok ? 1 : -1;
}
