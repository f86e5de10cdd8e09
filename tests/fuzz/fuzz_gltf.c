// libFuzzer target: whatever the bytes, vtLoadModel returns a mesh or a sentence.
#include <stdlib.h>

#include "vitrine.h"

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    const vtModelDef def = {.bytes = bytes, .size = size, .name = "fuzz"};
    vtModel model;
    vtError error = {0};
    const vtResult result = vtLoadModel(&def, &model, &error);
    if ((result == vt_ok) != (model.mesh.indexCount > 0) || (result != vt_ok && error.message[0] == '\0')) {
        abort();
    }
    vtDestroyModel(&model);
    return 0;
}
