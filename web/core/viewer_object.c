// Objects of the scene that was begun.
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "core/viewer.h"

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
