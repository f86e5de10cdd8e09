// Reliefs of files and of built-in patterns: the heights that they have, and bad data.
#include <math.h>

#include "image/image.h"
#include "mesh/height_field.h"
#include "png_cases.h"
#include "relief/relief.h"
#include "testing.h"

/// Of 8 or 16 bits; 1 or 3 channels.
static size_t writePng(uint8_t* to, int width, int height, int bits, int channels, const uint8_t* pixels)
{
    const size_t row = (size_t)width * (size_t)channels * (size_t)bits / 8;
    uint8_t rows[256] = {0};
    assert_true((row + 1) * (size_t)height <= sizeof rows);
    for (size_t i = 0; i < (size_t)height; ++i) {
        memcpy(rows + i * (row + 1) + 1, pixels + i * row, row);
    }
    return putPng(to, &(PngCase){.width = (uint32_t)width,
                                 .height = (uint32_t)height,
                                 .bits = (uint8_t)bits,
                                 .type = channels == 1 ? 0 : 2,
                                 .rows = rows,
                                 .rowsSize = (row + 1) * (size_t)height});
}

/// With depth 1 and no smoothing unless it is -1.
static vtMesh load(const void* bytes, size_t size, float smoothing)
{
    vtReliefDef def = vtDefaultRelief();
    def.depth = 1.0f;
    def.smoothing = smoothing;
    vtMesh mesh;
    vtError error = {0};
    assert_ok(vtLoadRelief(bytes, size, "a file", &def, &mesh, &error), error);
    return mesh;
}

/// Row 0 on top, as in the file.
static float heightAt(const vtMesh* mesh, int column, int row)
{
    return vtHeightField_Z(mesh->heights, column, mesh->heights->height - 1 - row);
}

static void pngsAreHeightsAsStored(void** state)
{
    (void)state;
    const uint8_t grey[6] = {0, 51, 255, 102, 128, 7};
    uint8_t bytes[256];
    size_t size = writePng(bytes, 3, 2, 8, 1, grey);
    vtMesh mesh = load(bytes, size, 0.0f);
    assert_int_equal(mesh.heights->width * 10 + mesh.heights->height, 32);
    for (int i = 0; i < 6; ++i) {
        assert_near(heightAt(&mesh, i % 3, i / 3), (float)grey[i] / 255.0f, 0.0f);
    }
    vtDestroyMesh(&mesh);

    const uint8_t colours[12] = {255, 255, 255, 0, 0, 0, 0, 255, 0, 90, 90, 90};
    size = writePng(bytes, 2, 2, 8, 3, colours);
    mesh = load(bytes, size, 0.0f);
    assert_near(heightAt(&mesh, 0, 0), 1.0f, 0.0f);
    assert_near(heightAt(&mesh, 1, 0), 0.0f, 0.0f);
    assert_near(heightAt(&mesh, 0, 1), 0.587f, 0.005f);
    assert_near(heightAt(&mesh, 1, 1), 90.0f / 255.0f, 0.0f);
    vtDestroyMesh(&mesh);

    const uint8_t fine[12] = {0, 0, 0, 1, 0x12, 0x34, 0xFF, 0xFF, 0x80, 0, 0, 255};
    size = writePng(bytes, 3, 2, 16, 1, fine);
    mesh = load(bytes, size, 0.0f);
    for (int i = 0; i < 6; ++i) {
        assert_near(heightAt(&mesh, i % 3, i / 3), (float)(256 * fine[2 * i] + fine[2 * i + 1]) / 65535.0f,
                    0.0f);
    }
    vtDestroyMesh(&mesh);
}

/// 8 x 8 of grey 102, as ImageMagick writes it.
static const uint8_t jpeg[] = {
    0xFF, 0xD8, 0xFF, 0xE0, 0,    0x10, 0x4A, 0x46, 0x49, 0x46, 0,    1,    1,    0,    0,    1,
    0,    1,    0,    0,    0xFF, 0xDB, 0,    0x43, 0,    3,    2,    2,    3,    2,    2,    3,
    3,    3,    3,    4,    3,    3,    4,    5,    8,    5,    5,    4,    4,    5,    0x0A, 7,
    7,    6,    8,    0x0C, 0x0A, 0x0C, 0x0C, 0x0B, 0x0A, 0x0B, 0x0B, 0x0D, 0x0E, 0x12, 0x10, 0x0D,
    0x0E, 0x11, 0x0E, 0x0B, 0x0B, 0x10, 0x16, 0x10, 0x11, 0x13, 0x14, 0x15, 0x15, 0x15, 0x0C, 0x0F,
    0x17, 0x18, 0x16, 0x14, 0x18, 0x12, 0x14, 0x15, 0x14, 0xFF, 0xC0, 0,    0x0B, 8,    0,    8,
    0,    8,    1,    1,    0x11, 0,    0xFF, 0xC4, 0,    0x14, 0,    1,    0,    0,    0,    0,
    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    7,    0xFF, 0xC4, 0,    0x14,
    0x10, 1,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,    0,
    0,    0,    0xFF, 0xDA, 0,    8,    1,    1,    0,    0,    0x3F, 0,    0x3A, 0x7F, 0xFF, 0xD9};

static void jpegsAreHeights(void** state)
{
    (void)state;
    vtMesh mesh = load(jpeg, sizeof jpeg, -1.0f);
    assert_int_equal(mesh.heights->width * 10 + mesh.heights->height, 88);
    for (int i = 0; i < 64; ++i) {
        assert_near(heightAt(&mesh, i % 8, i / 8), 102.0f / 255.0f, 1.5f / 255.0f);
    }
    vtDestroyMesh(&mesh);
}

static void only8BitsAreSmoothed(void** state)
{
    (void)state;
    uint8_t grey[9 * 9] = {0}, fine[2 * 9 * 9] = {0}, bytes[512];
    grey[40] = fine[80] = fine[81] = 255;
    const size_t size = writePng(bytes, 9, 9, 8, 1, grey);
    vtMesh plain = load(bytes, size, 0.0f), two = load(bytes, size, 2.0f), preset = load(bytes, size, -1.0f);
    assert_near(heightAt(&plain, 4, 4), 1.0f, 0.0f);
    assert_true(heightAt(&two, 4, 4) < 0.1f);
    assert_memory_equal(two.heights->z, preset.heights->z, 81 * sizeof(float));
    vtMesh deep = load(bytes, writePng(bytes, 9, 9, 16, 1, fine), -1.0f);
    assert_memory_equal(plain.heights->z, deep.heights->z, 81 * sizeof(float));
    vtDestroyMesh(&plain);
    vtDestroyMesh(&two);
    vtDestroyMesh(&preset);
    vtDestroyMesh(&deep);
}

static size_t writePfm(uint8_t* to, const char* header, const float* numbers, size_t count)
{
    const size_t length = strlen(header);
    memcpy(to, header, length);
    memcpy(to + length, numbers, count * sizeof *numbers); // the tests' machines are little endian
    return length + count * sizeof *numbers;
}

static void measuredNumbersAreNormalised(void** state)
{
    (void)state;
    uint8_t bytes[256];
    const float grey[6] = {-3.0f, 1.0f, 2.0f, 5.0f, 0.0f, -1.0f}; // the lower row first
    vtMesh mesh = load(bytes, writePfm(bytes, "Pf\n3 2\n-1.0\n", grey, 6), -1.0f);
    for (int i = 0; i < 6; ++i) {
        assert_near(heightAt(&mesh, i % 3, 1 - i / 3), (grey[i] + 3.0f) / 8.0f, 1e-7f);
    }
    vtDestroyMesh(&mesh);

    // The extremes of float: their difference is none of them.
    const float wide[4] = {-3e38f, 3e38f, 0.0f, 3e38f};
    mesh = load(bytes, writePfm(bytes, "Pf\n2 2\n-1.0\n", wide, 4), -1.0f);
    assert_near(heightAt(&mesh, 0, 0), 0.5f, 1e-7f);
    vtDestroyMesh(&mesh);

    const float same[4] = {7.0f, 7.0f, 7.0f, 7.0f};
    mesh = load(bytes, writePfm(bytes, "Pf\n2 2\n-1.0\n", same, 4), -1.0f);
    assert_near(mesh.heights->high, 0.0f, 0.0f);
    assert_near(mesh.heights->back, -0.1f, 1e-7f);
    vtDestroyMesh(&mesh);

    const float colours[12] = {1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.25f, 0.25f, 0.25f};
    mesh = load(bytes, writePfm(bytes, "PF\n2 2\n-1.0\n", colours, 12), -1.0f);
    assert_near(heightAt(&mesh, 0, 1), 1.0f, 0.0f);
    assert_near(heightAt(&mesh, 0, 0), 0.7152f, 1e-6f);
    assert_near(heightAt(&mesh, 1, 0), 0.25f, 0.0f);
    vtDestroyMesh(&mesh);

    const char header[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n";
    const uint8_t texels[16] = {128, 128, 128, 129, 0, 0, 0, 0, 128, 128, 128, 130, 128, 128, 128, 128};
    memcpy(bytes, header, sizeof header - 1); // 1, 0 and below 2, 0.5
    memcpy(bytes + sizeof header - 1, texels, sizeof texels);
    mesh = load(bytes, sizeof header - 1 + sizeof texels, -1.0f);
    const float wanted[4] = {0.5f, 0.0f, 1.0f, 0.25f};
    for (int i = 0; i < 4; ++i) {
        assert_near(heightAt(&mesh, i % 2, i / 2), wanted[i], 0.0f);
    }
    vtDestroyMesh(&mesh);
}

static void expectBad(const void* bytes, size_t size, const char* words)
{
    vtReliefDef def = vtDefaultRelief();
    vtMesh mesh;
    vtError error = {0};
    assert_int_not_equal(vtLoadRelief(bytes, size, "bad.png", &def, &mesh, &error), vt_ok);
    assert_null(mesh.heights);
    assert_non_null(strstr(error.message, "bad.png"));
    if (strstr(error.message, words) == NULL) {
        fail_msg("'%s' does not say '%s'", error.message, words);
    }
}

static void badFilesGetSentences(void** state)
{
    (void)state;
    uint8_t bytes[256];
    const uint8_t grey[6] = {0, 51, 255, 102, 128, 7};
    expectBad(NULL, 0, "is empty");
    expectBad("hello, world", 12, "is no picture that can be read");
    const size_t size = writePng(bytes, 3, 2, 8, 1, grey);
    expectBad(bytes, size - 30, "cannot be decoded");
    expectBad(bytes, writePng(bytes, 1, 1, 8, 1, grey), "is 1 x 1 samples, but a side must be 2 to 4096");
    const PngCase wide = {.width = 4099, .height = 2, .bits = 8, .rows = grey, .rowsSize = sizeof grey};
    expectBad(bytes, putPng(bytes, &wide), "is 4099 x 2 samples, but a side must be 2 to 4096");
    const float numbers[6] = {0.0f, 1.0f, 2.0f, 3.0f, NAN, 5.0f};
    expectBad(bytes, writePfm(bytes, "Pf\n3 2\n-1.0\n", numbers, 6), "the height in column 1, row 0 is nan");
    expectBad(bytes, writePfm(bytes, "Pf\n3 2\n-1.0\n", numbers, 5), "it is truncated");
    expectBad("Pf\n5000 2\n-1.0\n", 15, "is 5000 x 2 samples");
    expectBad("Pf\n0 2\n-1.0\n", 12, "PFM header");
    expectBad("Pf\n3 2\n", 7, "ends within its PFM header");
    for (size_t length = 0; length < size; ++length) {
        uint8_t* cut = malloc(length + 1); // its own allocation, so that a sanitizer sees every byte too far
        memcpy(cut, bytes, length);
        vtMesh mesh;
        const vtReliefDef def = vtDefaultRelief();
        vtLoadRelief(cut, length, "cut", &def, &mesh, NULL);
        vtDestroyMesh(&mesh);
        free(cut);
    }
}

// ----------------------------------------------------------------------------------------------- patterns

static vtMesh createPattern(const char* name, int width, int height)
{
    vtReliefDef def = vtDefaultRelief();
    def.depth = 1.0f;
    def.width = width;
    def.height = height;
    vtMesh mesh;
    vtError error = {0};
    assert_ok(vtCreateReliefPattern(name, &def, &mesh, &error), error);
    return mesh;
}

static void patternsAreFunctionsOfThePlace(void** state)
{
    (void)state;
    int count = 0;
    for (; vtReliefPatternName(count) != NULL; ++count) {
        const char* name = vtReliefPatternName(count);
        assert_non_null(vtReliefPatternSummary(count));
        assert_true(vtReliefPatternDepth(count) > 0.0f && vtReliefPatternDepth(count) <= 0.1f);
        assert_int_equal(vtFindReliefPattern(name), count);
        vtMesh preset = createPattern(name, 0, 0);
        assert_int_equal(preset.heights->width, 512);
        assert_int_equal(preset.heights->height, 512);
        vtDestroyMesh(&preset);
        vtMesh coarse = createPattern(name, 200, 120), again = createPattern(name, 200, 120);
        vtMesh fine = createPattern(name, 399, 239);
        assert_memory_equal(coarse.heights->z, again.heights->z, 200 * 120 * sizeof(float));
        assert_true(fine.heights->low >= 0.0f && fine.heights->high <= 1.0f);
        assert_true(fine.heights->high - fine.heights->low > 0.5f);
        for (int row = 0; row < 120; ++row) {
            for (int column = 0; column < 200; ++column) {
                assert_near(heightAt(&coarse, column, row), heightAt(&fine, 2 * column, 2 * row), 0.0f);
            }
        }
        vtDestroyMesh(&coarse);
        vtDestroyMesh(&again);
        vtDestroyMesh(&fine);
    }
    assert_int_equal(count, 4);
    assert_null(vtReliefPatternSummary(count));
    assert_null(vtReliefPatternName(-1));
}

/// The slopes of the round patterns do not jump.
static void roundPatternsAreSmooth(void** state)
{
    (void)state;
    const char* const names[] = {"ripples", "hammered"};
    for (int i = 0; i < 2; ++i) {
        enum { side = 1025 };
        vtMesh mesh = createPattern(names[i], side, side);
        float worst = 0.0f;
        for (int row = 0; row < side; ++row) {
            for (int column = 1; column + 1 < side; ++column) {
                const float second = heightAt(&mesh, column - 1, row) - 2.0f * heightAt(&mesh, column, row) +
                                     heightAt(&mesh, column + 1, row);
                worst = fmaxf(worst, fabsf(second));
            }
        }
        // A crease between dimples, a jump of the slope by about 12, would be 12 cells: 0.02.
        assert_true(worst < 0.0025f);
        vtDestroyMesh(&mesh);
    }
}

static void badPatternsGetSentences(void** state)
{
    (void)state;
    vtReliefDef def = vtDefaultRelief();
    vtMesh mesh;
    vtError error = {0};
    assert_int_equal(vtCreateReliefPattern("waves", &def, &mesh, &error), vt_errorArgument);
    assert_string_equal(error.message,
                        "relief 'waves' is unknown; the built-in ones are ripples, hammered, fluted "
                        "and lens-array");
    assert_int_equal(vtFindReliefPattern("waves"), -1);
    def.width = 4097;
    assert_int_equal(vtCreateReliefPattern("fluted", &def, &mesh, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "4097 x 512 samples; a side must be 2 to 4096"));
    def.width = 2;
    def.depth = 11.0f;
    assert_int_equal(vtCreateReliefPattern("fluted", &def, &mesh, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "its depth is 11"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pngsAreHeightsAsStored), cmocka_unit_test(jpegsAreHeights),
        cmocka_unit_test(only8BitsAreSmoothed),   cmocka_unit_test(measuredNumbersAreNormalised),
        cmocka_unit_test(badFilesGetSentences),   cmocka_unit_test(patternsAreFunctionsOfThePlace),
        cmocka_unit_test(roundPatternsAreSmooth), cmocka_unit_test(badPatternsGetSentences),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
