// libFuzzer target: whatever the bytes, vtOpenModel returns a scene or a sentence, and so does each time of
// its animations.
#include <stdlib.h>

#include "vitrine.h"

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    const vtModelDef def = {.bytes = bytes, .size = size, .name = "fuzz"};
    vtModel* model;
    vtScene scene;
    vtError error = {0};
    vtResult result = vtOpenModel(&def, &model, &scene, &error);
    if ((result == vt_ok) != (scene.objectCount > 0) || (result == vt_ok) != (model != NULL) ||
        (result != vt_ok && error.message[0] == '\0')) {
        abort();
    }
    for (int i = 0; i < 4 && vtModel_Animation(model, i) != NULL; ++i) {
        result = vtModel_SetTime(model, i, 0.4 * vtModel_Animation(model, i)->duration, NULL, &scene, &error);
        if (result != vt_ok && error.message[0] == '\0') {
            abort();
        }
    }
    vtCloseModel(model);
    vtDestroyScene(&scene);
    return 0;
}
