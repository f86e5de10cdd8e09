// Objects of the scene that was begun, what of it moves, and what files may ask for.
#include <emscripten.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "core/viewer.h"
#include "image/image.h"
#include "scene/objects.h"

vtResult vtViewer_ReadSpec(vtViewer* viewer, const char* text, vtObjectKind kind, vtObjectSpec* spec)
{
    *spec = (vtObjectSpec){0};
    const vtResult result =
        *text == '\0' ? vt_ok : vtParseObject(text, "objects", false, spec, &viewer->error);
    if (result == vt_ok && spec->image[0] != '\0') {
        return vtFail(&viewer->error, vt_errorArgument,
                      "objects '%.200s': image is a file, which a page cannot read; use a model with it",
                      text);
    }
    return result == vt_ok ? vtObjectSpec_Check(spec, kind, "objects", &viewer->error) : result;
}

vtResult vtViewer_Add(vtViewer* viewer, vtScene* made, const vtObjectSpec* spec)
{
    vtObjectSpec_Apply(spec, made);
    const vtTransform place = vtObjectSpec_Place(spec);
    const vtResult result = vtScene_Append(&viewer->next, made, &place, &viewer->error);
    vtDestroyScene(made);
    return result;
}

vtResult vtViewer_AddMesh(vtViewer* viewer, vtMesh* mesh, const char* name, const vtObjectSpec* spec)
{
    vtScene made = {0};
    vtMaterial material = vtDefaultMaterial();
    material.opaque = mesh->heights == NULL && strcmp(name, "plane") == 0; // it has no volume
    vtResult result = vtCreateMeshScene(mesh, &material, &made, &viewer->error);
    vtDestroyMesh(mesh);
    if (result == vt_ok) {
        snprintf(made.objects[0].name, sizeof made.objects[0].name, "%.63s", name);
        result = vtViewer_Add(viewer, &made, spec);
    }
    return result;
}

// ------------------------------------------------------------------------------------- limits

#if VT_IS_FULL
/// What the files opened from here on may ask for, 0: the defaults.
EMSCRIPTEN_KEEPALIVE void vtViewer_Limit(vtViewer* viewer, uint32_t memory, uint32_t triangles,
                                         uint32_t pixels)
{
    viewer->limits = (vtLimits){memory, triangles, pixels};
}
#endif

vtResult vtViewer_CheckPicture(vtViewer* viewer, const char* name, int width, int height)
{
    const size_t bytesPerPixel = 4 + 3 * sizeof(float); // as it came, and of light
    return VT_IS_FULL
               ? vtCheckPictureSize(name, width, height, bytesPerPixel, &viewer->limits, &viewer->error)
               : vt_ok;
}

// ------------------------------------------------------------------------------------- what moves

void vtMotion_Clear(vtMotion* motion)
{
    for (uint32_t i = 0; VT_IS_FULL && i < motion->count; ++i) {
        vtCloseModel(motion->models[i].model);
    }
    free(motion->models);
    *motion = (vtMotion){0};
}

vtResult vtViewer_AddMotion(vtViewer* viewer, vtModel* model, const vtModelPlace* place)
{
    vtMotion* motion = &viewer->nextMotion;
    if (!VT_IS_FULL || vtModel_Animation(model, 0) == NULL) {
        vtCloseModel(model);
        return vt_ok;
    }
    vtMovingModel* grown = realloc(motion->models, (motion->count + 1) * sizeof *grown);
    if (grown == NULL) {
        vtCloseModel(model);
        return vtFail(&viewer->error, vt_errorMemory, "animations: out of memory");
    }
    motion->models = grown;
    motion->models[motion->count++] = (vtMovingModel){model, *place};
    return vt_ok;
}

/// The scene's lowest point, of one that moves; NAN: of another, or not known.
float vtViewer_Lowest(const vtViewer* viewer)
{
    float lowest = NAN;
    vtPlacedObject* placed;
    uint32_t glassCount;
    if (viewer->motion.count > 0 && vtPlaceObjects(&viewer->scene, &placed, &glassCount, NULL) == vt_ok) {
        for (uint32_t i = 0; i < viewer->scene.objectCount; ++i) {
            lowest = fminf(lowest, placed[i].low.y); // which a NAN gives way to
        }
        vtFree(placed);
    }
    return lowest;
}
