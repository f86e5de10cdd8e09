// WebP, written here by libwebp: without loss and with, with alpha and without; cut, damaged and animated
// ones.
#include "image_cases.h"

#include <webp/encode.h>

static const uint8_t pixels[] = {1,   2,   3,   255, 40, 50, 60, 128, 70, 80, 90, 0, // 3 x 2
                                 200, 210, 220, 255, 0,  0,  0,  255, 9,  8,  7,  1};

/// As the test's own memory.
static uint8_t* own(uint8_t* encoded, size_t size)
{
    assert_true(size > 0);
    uint8_t* bytes = copyOf(encoded, size);
    WebPFree(encoded);
    return bytes;
}

/// The encoder drops colours that are not seen: where alpha is 0 they are black.
static void everyKindIsRead(void** state)
{
    (void)state;
    uint8_t* encoded = NULL;
    size_t size = WebPEncodeLosslessRGBA(pixels, 3, 2, 12, &encoded);
    uint8_t* bytes = own(encoded, size);
    uint8_t wanted[sizeof pixels];
    memcpy(wanted, pixels, sizeof pixels);
    memset(wanted + 8, 0, 3);
    expectRgba(bytes, size, 3, 2, wanted); // not multiplied by alpha
    refusesCuts(bytes, size);
    survivesDamage(bytes, size, 3000);
    free(bytes);

    uint8_t rgb[16 * 16 * 3];
    for (int i = 0; i < 16 * 16; ++i) {
        memcpy(rgb + 3 * i, (const uint8_t[]){180, 90, 30}, 3);
    }
    size = WebPEncodeRGB(rgb, 16, 16, 48, 90.0f, &encoded);
    bytes = own(encoded, size);
    float* light = expectLight(bytes, size, 16, 16);
    assert_near(light[0], vtSrgbToLinear(180 / 255.0f), 0.03f);
    assert_near(light[2], vtSrgbToLinear(30 / 255.0f), 0.03f);
    vtFree(light);
    refusesCuts(bytes, size);
    survivesDamage(bytes, size, 3000);
    free(bytes);
}

static void othersGetSentences(void** state)
{
    (void)state;
    const uint8_t animated[] = "RIFF\x16\0\0\0WEBPVP8X\x0A\0\0\0\x02\0\0\0\x07\0\0\x07\0\0";
    expectSentence(animated, sizeof animated - 1, "is an animated WebP; save one picture of it");
    const uint8_t large[] = "RIFF\x16\0\0\0WEBPVP8L\x0A\0\0\0\x2F\xFF\xFF\xFF\x0F\0\0\0\0\0"; // 16384 x 16384
    expectSentence(large, sizeof large - 1, "at most");
    const uint8_t nothing[] = "RIFF\x04\0\0\0WEBP";
    expectSentence(nothing, sizeof nothing - 1, "cannot be decoded as WebP");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everyKindIsRead),
        cmocka_unit_test(othersGetSentences),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
