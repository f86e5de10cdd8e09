// libFuzzer target: whatever the bytes, vtLoadScene returns a scene or a sentence.
#include <stdlib.h>

#include "vitrine.h"

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    const vtModelDef def = {.bytes = bytes, .size = size, .name = "fuzz"};
    vtScene scene;
    vtError error = {0};
    const vtResult result = vtLoadScene(&def, &scene, &error);
    if ((result == vt_ok) != (scene.objectCount > 0) || (result != vt_ok && error.message[0] == '\0')) {
        abort();
    }
    vtDestroyScene(&scene);
    return 0;
}
