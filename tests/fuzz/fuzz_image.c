// libFuzzer target: whatever the bytes, each way to decode a picture gives one or a sentence.
#include <stdlib.h>

#include "image/image.h"

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size);

static void check(vtResult result, const void* made, const vtError* error)
{
    if ((result == vt_ok) != (made != NULL) || (result == vt_ok) != (error->message[0] == '\0')) {
        abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    vtError error = {0};
    float *light = NULL, *heights = NULL;
    int width, height, bits;
    vtImage image;
    check(vtDecodeImageLinear(bytes, size, "fuzz", &light, &width, &height, &error), light, &error);
    check(vtDecodeImage(bytes, size, "fuzz", &image, &error), image.pixels, &error);
    check(vtDecodeHeights(bytes, size, "fuzz", &heights, &width, &height, &bits, &error), heights, &error);
    vtFree(light);
    vtFree(image.pixels);
    vtFree(heights);
    return 0;
}
