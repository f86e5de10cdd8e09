// libFuzzer target: whatever the bytes, each way to decode a picture gives one or a sentence.
#include "fuzz.h"
#include "image/image.h"

static void check(vtResult result, const void* made, const vtError* error)
{
    require((result == vt_ok) == (made != NULL));
    requireSentence(result, error);
}

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    vtError error = {0};
    float *light = NULL, *heights = NULL;
    int width, height, bits;
    vtImage image;
    vtResult result = vtDecodeImageLinear(bytes, size, "fuzz", &light, &width, &height, &error);
    check(result, light, &error);
    for (size_t i = 0; result == vt_ok && i < 3 * (size_t)width * (size_t)height; ++i) {
        require(light[i] >= 0.0f && light[i] <= 65504.0f);
    }
    check(vtDecodeImage(bytes, size, "fuzz", &image, &error), image.pixels, &error);
    check(vtDecodeHeights(bytes, size, "fuzz", &heights, &width, &height, &bits, &error), heights, &error);
    vtFree(light);
    vtFree(image.pixels);
    vtFree(heights);
    return 0;
}
