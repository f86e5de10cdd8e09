// PNG: every kind there is, damaged ones, and what is refused before memory is taken.
#include "image_cases.h"
#include "png_cases.h"

static uint8_t file[8192];

static size_t put(PngCase png)
{
    return putPng(file, &png);
}

static void colours8And16BitsAreRead(void** state)
{
    (void)state;
    const uint8_t rgb[] = {0, 10, 20, 30, 255, 0, 128}; // 2 x 1
    size_t size =
        put((PngCase){.width = 2, .height = 1, .bits = 8, .type = 2, .rows = rgb, .rowsSize = sizeof rgb});
    expectRgba(file, size, 2, 1, (const uint8_t[]){10, 20, 30, 255, 255, 0, 128, 255});

    const uint8_t fine[] = {0, 0x12, 0x34, 0, 1, 0xFF, 0xFF, 0x80, 0x00}; // RGBA of 16 bits
    size =
        put((PngCase){.width = 1, .height = 1, .bits = 16, .type = 6, .rows = fine, .rowsSize = sizeof fine});
    expectRgba(file, size, 1, 1, (const uint8_t[]){0x12, 0, 0xFF, 0x80});
    float* light = expectLight(file, size, 1, 1);
    assert_near(light[0], vtSrgbToLinear(0x1234 / 65535.0f), 1e-7f); // all bits count
    assert_near(light[1], vtSrgbToLinear(1 / 65535.0f), 1e-9f);
    assert_near(light[2], 1.0f, 1e-6f);
    vtFree(light);
}

static void greyAndAlphaAreRead(void** state)
{
    (void)state;
    const uint8_t both[] = {0, 50, 60, 70, 0};
    size_t size =
        put((PngCase){.width = 2, .height = 1, .bits = 8, .type = 4, .rows = both, .rowsSize = sizeof both});
    expectRgba(file, size, 2, 1, (const uint8_t[]){50, 50, 50, 60, 70, 70, 70, 0});

    const uint8_t bits[] = {0, 0xA0}; // black and white: 1, 0, 1
    size =
        put((PngCase){.width = 3, .height = 1, .bits = 1, .type = 0, .rows = bits, .rowsSize = sizeof bits});
    expectRgba(file, size, 3, 1, (const uint8_t[]){255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255});

    const uint8_t pairs[] = {0, 0x1B}; // 2 bits: 0, 1, 2, 3; 2 is transparent
    size = put((PngCase){.width = 4,
                         .height = 1,
                         .bits = 2,
                         .transparency = (const uint8_t[]){0, 2},
                         .transparencySize = 2,
                         .rows = pairs,
                         .rowsSize = sizeof pairs});
    expectRgba(file, size, 4, 1,
               (const uint8_t[]){0, 0, 0, 255, 85, 85, 85, 255, 170, 170, 170, 0, 255, 255, 255, 255});
}

static void palettesAreRead(void** state)
{
    (void)state;
    const uint8_t palette[] = {1, 2, 3, 100, 110, 120, 250, 251, 252}, rows[] = {0, 0x90}; // 2 bits: 2, 1
    PngCase png = {.width = 2,
                   .height = 1,
                   .bits = 2,
                   .type = 3,
                   .palette = palette,
                   .paletteSize = 9,
                   .rows = rows,
                   .rowsSize = sizeof rows};
    size_t size = putPng(file, &png);
    expectRgba(file, size, 2, 1, (const uint8_t[]){250, 251, 252, 255, 100, 110, 120, 255});
    png.transparency = (const uint8_t[]){255, 7};
    png.transparencySize = 2;
    size = putPng(file, &png);
    expectRgba(file, size, 2, 1, (const uint8_t[]){250, 251, 252, 255, 100, 110, 120, 7});
}

/// 3 x 3 in the seven passes of Adam7, of which five have pixels.
static void interlacedIsRead(void** state)
{
    (void)state;
    const uint8_t rows[] = {0, 11, /* pass 4: */ 0, 13, /* 5: */ 0, 31, 33, /* 6: */ 0, 12,
                            0, 32, /* 7: */ 0,      21, 22,         23};
    const PngCase png = {
        .width = 3, .height = 3, .bits = 8, .interlaced = true, .rows = rows, .rowsSize = sizeof rows};
    const size_t size = putPng(file, &png);
    const uint8_t grey[9] = {11, 12, 13, 21, 22, 23, 31, 32, 33};
    uint8_t rgba[36];
    for (int i = 0; i < 36; ++i) {
        rgba[i] = i % 4 == 3 ? 255 : grey[i / 4];
    }
    expectRgba(file, size, 3, 3, rgba);
    refusesCuts(file, size);
}

static void heightsKeepTheirBits(void** state)
{
    (void)state;
    const uint8_t rows[] = {0, 0x12, 0x34, 0xFF, 0xFF, 0, 0, 1, 0x80, 0};
    const size_t size =
        put((PngCase){.width = 2, .height = 2, .bits = 16, .rows = rows, .rowsSize = sizeof rows});
    float* heights = NULL;
    int width = 0, height = 0, bits = 0;
    vtError error = {0};
    assert_ok(vtDecodeHeights(file, size, "file", &heights, &width, &height, &bits, &error), error);
    assert_int_equal(bits, 16);
    assert_near(heights[0], 0x1234 / 65535.0f, 0.0f);
    assert_near(heights[2], 1 / 65535.0f, 0.0f);
    vtFree(heights);
}

static void damagedIsRefused(void** state)
{
    (void)state;
    uint8_t rows[8 * 25];
    for (size_t i = 0; i < sizeof rows; ++i) {
        rows[i] = i % 25 == 0 ? (uint8_t)(i / 25 % 5) : (uint8_t)(i * i);
    }
    const size_t size =
        put((PngCase){.width = 8, .height = 8, .bits = 8, .type = 2, .rows = rows, .rowsSize = sizeof rows});
    vtError error = {0};
    assert_ok(decodeAll(file, size, &error), error);
    refusesCuts(file, size);
    survivesDamage(file, size, 3000);
    file[60] ^= 1; // a pixel
    expectSentence(file, size, "incorrect data check");
    file[60] ^= 1;
    file[24] ^= 2; // the header: bits of a sample
    expectSentence(file, size, "CRC error");
}

/// A header that promises more than there is, or more than may be, costs no memory.
static void sizesAreCheckedFirst(void** state)
{
    (void)state;
    const uint8_t rows[] = {0, 1};
    PngCase png = {.width = 20000, .height = 1, .bits = 8, .rows = rows, .rowsSize = sizeof rows};
    expectSentence(file, putPng(file, &png), "20000 x 1 pixels, but a side must be 1 to 16384");
    png.width = png.height = 16384;
    png.bits = 1; // 32 MB of rows, which 100 bytes cannot hold
    expectSentence(file, putPng(file, &png), "it is cut off");
    png.width = png.height = 0;
    expectSentence(file, putPng(file, &png), "cannot be decoded as PNG");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours8And16BitsAreRead), cmocka_unit_test(greyAndAlphaAreRead),
        cmocka_unit_test(palettesAreRead),          cmocka_unit_test(interlacedIsRead),
        cmocka_unit_test(heightsKeepTheirBits),     cmocka_unit_test(damagedIsRefused),
        cmocka_unit_test(sizesAreCheckedFirst),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
