// libFuzzer target: whatever the text of --object, it becomes an object that can be drawn or a sentence. The
// same text is tried as the name of what is built in, and as a background.
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "scene/object_spec.h"
#include "technique/background.h"

static void checkSpec(const vtObjectSpec* spec)
{
    vtError error = {0};
    for (int kind = vt_kindMesh; kind <= vt_kindReliefPattern; ++kind) {
        requireSentence(vtObjectSpec_Check(spec, (vtObjectKind)kind, "--object", &error), &error);
    }
    const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const vtMeshDef def = {.positions = corners, .vertexCount = 3, .indexCount = 3};
    const vtMaterial material = vtDefaultMaterial();
    vtMesh mesh;
    vtScene scene = {0};
    require(vtCreateMesh(&def, "fuzz", &mesh, &error) == vt_ok);
    require(vtCreateMeshScene(&mesh, &material, &scene, &error) == vt_ok);
    vtObjectSpec_Apply(spec, &scene);
    scene.objects[0].toWorld = vtObjectSpec_Place(spec);
    requireFinite(&scene.objects[0].toWorld.rows[0][0], 12);
    const vtResult result = vtValidateScene(&scene, &error);
    requireSentence(result, &error);
    if (result == vt_ok) {
        requireScene(&scene);
    }
    vtDestroyScene(&scene);
    vtReliefDef relief = vtDefaultRelief();
    relief.width = relief.height = 8;
    vtObjectSpec_ApplyToRelief(spec, &relief);
    if (relief.width <= 64) {
        requireSentence(vtCreateReliefPattern(spec->name, &relief, &mesh, &error), &error);
        vtDestroyMesh(&mesh);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    char* text = malloc(size + 1);
    require(text != NULL);
    memcpy(text, bytes, size);
    text[size] = '\0';
    vtError error = {0};
    vtObjectSpec spec;
    vtResult result = vtParseObject(text, "--object", false, &spec, &error);
    requireSentence(result, &error);
    if (result == vt_ok) {
        checkSpec(&spec);
    }
    vtFrame frame = vtDefaultFrame();
    result = vtFrame_SetBackground(&frame, text, &error);
    requireSentence(result, &error);
    require(vtValidateFrame(&frame, &error) == vt_ok);
    vtEnvironment environment;
    requireSentence(vtCreateEnvironment(text, &environment, &error), &error);
    vtDestroyEnvironment(&environment);
    free(text);
    return 0;
}
