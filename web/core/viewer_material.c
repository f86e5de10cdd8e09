// The materials of what a viewer shows, read and changed one by one. The calls are like those of viewer.c.
#include <emscripten.h>
#include <stdio.h>

#include "core/viewer.h"
#include "scene/material.h"

/// As JSON, its keys as the element names them; NULL past the last one. Valid until the next call.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_Material(vtViewer* viewer, uint32_t index)
{
    if (index >= viewer->scene.materialCount) {
        return NULL;
    }
    const vtMaterial* material = &viewer->scene.materials[index];
    const vtVec3 *tint = &material->tint, *absorption = &material->attenuationColor;
    snprintf(viewer->path, sizeof viewer->path,
             "{\"opaque\":%s,\"ior\":%.6g,\"tint\":[%.6g,%.6g,%.6g],\"absorption\":[%.6g,%.6g,%.6g],"
             "\"absorptionDistance\":%.6g,\"roughness\":%.6g,\"dispersion\":%.6g}",
             material->opaque ? "true" : "false", (double)material->ior, (double)tint->x, (double)tint->y,
             (double)tint->z, (double)absorption->x, (double)absorption->y, (double)absorption->z,
             (double)material->attenuationDistance, (double)vtMaterial_Roughness(material, -1.0f),
             (double)material->dispersion);
    return viewer->path;
}

static vtResult changeInstances(vtViewer* viewer, uint32_t index)
{
    vtResult result = vt_ok;
    for (uint32_t i = 0; i < viewer->scene.objectCount && result == vt_ok; ++i) {
        vtInstanceDef def;
        const vtInstanceId id = vtRenderer_SceneInstance(viewer->renderer, i);
        if (viewer->scene.objects[i].material != index) {
            continue;
        }
        result = vtRenderer_GetInstance(viewer->renderer, id, &def, &viewer->error);
        if (result == vt_ok) {
            def.material = viewer->scene.materials[index];
            result = vtRenderer_SetInstance(viewer->renderer, id, &def, &viewer->error);
        }
    }
    return result;
}

/// Gives a material what keys of `objects` say: "INDEX:key=value"; one that is not there, nothing.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_SetMaterial(vtViewer* viewer, uint32_t index, const char* text)
{
    vtObjectSpec spec;
    vtResult result = vtParseObject(text, "material", false, &spec, &viewer->error);
    if (result == vt_ok && index < viewer->scene.materialCount) {
        vtScene one = {.materials = &viewer->scene.materials[index], .materialCount = 1};
        vtObjectSpec_Apply(&spec, &one);
        result = changeInstances(viewer, index);
        vtDestroyTracer(viewer->tracer); // it has the scene as it was
        viewer->tracer = NULL;
        viewer->changed = true;
    }
    return result == vt_ok ? NULL : viewer->error.message;
}
