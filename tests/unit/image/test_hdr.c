// Radiance pictures: every order, coding and line of the header; what is cut off ends at once.
#include <math.h>

#include "image_cases.h"

static uint8_t file[2048];
static size_t size;

static void put(const void* bytes, size_t count)
{
    memcpy(file + size, bytes, count);
    size += count;
}

static void begin(const char* header)
{
    size = 0;
    put(header, strlen(header));
}

/// A pixel of red, green and blue in 256ths.
static void putPixel(uint8_t red, uint8_t green, uint8_t blue)
{
    put((const uint8_t[4]){red, green, blue, 128}, 4);
}

static void expectReds(int width, int height, const char* reds)
{
    float* light = expectLight(file, size, width, height);
    for (int i = 0; i < width * height; ++i) {
        assert_near(light[3 * i], (float)(reds[i] - 'a' + 1) / 256.0f, 0.0f);
    }
    vtFree(light);
}

static void everyOrderIsRead(void** state)
{
    (void)state;
    // The file has the pixels a to f in its own order; in the picture they are thus.
    const struct {
        const char *resolution, *picture;
        int width;
    } orders[] = {
        {"-Y 2 +X 3", "abcdef", 3}, {"-Y 2 -X 3", "cbafed", 3}, {"+Y 2 +X 3", "defabc", 3},
        {"+Y 2 -X 3", "fedcba", 3}, {"+X 2 -Y 3", "adbecf", 2}, {"+X 2 +Y 3", "cfbead", 2},
        {"-X 2 -Y 3", "daebfc", 2}, {"-X 2 +Y 3", "fcebda", 2},
    };
    for (size_t i = 0; i < sizeof orders / sizeof orders[0]; ++i) {
        begin("#?RADIANCE\n\n"); // no FORMAT: RGB
        put(orders[i].resolution, strlen(orders[i].resolution));
        put("\n", 1);
        for (uint8_t k = 1; k <= 6; ++k) {
            putPixel(k, 0, 0);
        }
        expectReds(orders[i].width, 6 / orders[i].width, orders[i].picture);
        refusesCuts(file, size);
    }
}

static void everyCodingIsRead(void** state)
{
    (void)state;
    // By component: a run of 5 and 3 that differ; then equal ones, in runs of 8 and of 3 and 5.
    begin("#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n");
    put("\x02\x02\x00\x08\x85\x01\x03\x02\x03\x04\x88\x00\x83\x00\x85\x00\x88\x80", 18);
    expectReds(8, 1, "aaaaabcd");
    refusesCuts(file, size);
    survivesDamage(file, size, 3000);
    // The first version: a pixel, then how often it comes again; the second count is of 256.
    begin("#?RADIANCE\n\n-Y 2 +X 300\n");
    for (int row = 0; row < 2; ++row) {
        putPixel(1, 0, 0);
        put("\x01\x01\x01\x2A\x01\x01\x01\x01", 8); // 42 + 256
        putPixel(2, 0, 0);
    }
    char reds[601];
    for (int i = 0; i < 600; ++i) {
        reds[i] = i % 300 == 299 ? 'b' : 'a';
    }
    expectReds(300, 2, reds);
    refusesCuts(file, size);
    survivesDamage(file, size, 2000);
    // Flat, though long enough to be coded.
    begin("#?RADIANCE\n\n-Y 1 +X 9\n");
    for (uint8_t k = 1; k <= 9; ++k) {
        putPixel(k, 7, 7);
    }
    expectReds(9, 1, "abcdefghi");
}

static void expectLine(const char* header, float red, float green, float blue)
{
    begin(header);
    put("\n-Y 1 +X 1\n", 11);
    put((const uint8_t[4]){128, 64, 32, 129}, 4); // 1, 0.5, 0.25
    float* light = expectLight(file, size, 1, 1);
    assert_near(light[0], red, 1e-5f);
    assert_near(light[1], green, 1e-5f);
    assert_near(light[2], blue, 1e-5f);
    vtFree(light);
}

static void headersCount(void** state)
{
    (void)state;
    expectLine("#?RADIANCE\n", 1.0f, 0.5f, 0.25f);
    expectLine("#?RADIANCE\nEXPOSURE=2\nSOFTWARE=x\nEXPOSURE= 0.25\n", 2.0f, 1.0f, 0.5f);
    expectLine("#?RADIANCE\nCOLORCORR=1 2 4\n", 1.0f, 0.25f, 0.0625f);
    expectLine("#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r", 1.0f, 0.5f, 0.25f);
    // XYZ: the white of sRGB is (0.9505, 1, 1.089); this is (1, 0.5, 0.25), a red.
    expectLine("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n", 2.34735f, 0.0f, 0.21795f);
    const struct {
        const char *header, *words;
    } bad[] = {
        {"#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\nabcd", "EXPOSURE is not a number from 1e-30 to 1e30"},
        {"#?RADIANCE\nEXPOSURE=nan\n\n-Y 1 +X 1\nabcd", "EXPOSURE is not a number from 1e-30 to 1e30"},
        {"#?RADIANCE\nCOLORCORR=1 2\n\n-Y 1 +X 1\nabcd", "COLORCORR is not three numbers"},
        {"#?RADIANCE\nFORMAT=32-bit_spectral\n\n-Y 1 +X 1\nabcd", "FORMAT is neither"},
        {"#?RADIANCE\n\n-Y 1 -Y 1\nabcd", "the same axis twice"},
        {"#?RADIANCE\n\n-Y 1 X 1\nabcd", "not like -Y 512 +X 1024"},
        {"#?RADIANCE\n\n-Y -1 +X 1\nabcd", "not like -Y 512 +X 1024"},
        {"#?RADIANCE\n\n-Y 99999999999999999999 +X 1\nabcd", "pixels, but a side must be 1 to 16384"},
        {"#?RADIANCE\n\n-Y 16384 +X 16384\nabcd", "at most"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", "header is cut off"},
        {"#?RADIANCE\n\n-Y 1 +X 8\n\x02\x02\x00\x09\x88\x01\x88\x01\x88\x01\x88\x01",
         "has not the picture's length"},
        {"#?RADIANCE\n\n-Y 1 +X 8\n\x02\x02\x00\x08\x89\x01\x01\x01", "a run of pixels does not fit"},
        {"#?RADIANCE\n\n-Y 1 +X 2\n\x01\x01\x01\x02", "a run of pixels does not fit"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        begin(bad[i].header);
        if (i >= 10) {
            size = i == 10 ? 23 + 12 : i == 11 ? 23 + 8 : 23 + 4; // there are zeros among the bytes
            memcpy(file, bad[i].header, size);
        }
        expectSentence(file, size, bad[i].words);
    }
}

static void valuesAreMadeUsable(void** state)
{
    (void)state;
    begin("#?RADIANCE\n\n-Y 1 +X 3\n");
    put("\xFF\x80\x01\xFF\x80\x80\x80\x00\x80\x00\x00\x01", 12); // huge, none, tiny
    float* light = expectLight(file, size, 3, 1);
    assert_near(light[0], 65504.0f, 0.0f);
    assert_near(light[3], 0.0f, 0.0f);
    assert_near(light[6], ldexpf(1.0f, -128), 0.0f);
    vtFree(light);
}

static void casesAreAsTheyShould(void** state)
{
    (void)state;
    size_t length = 0;
    uint8_t* bytes = loadCase("hdr-crlf.hdr", &length);
    float* light = expectLight(bytes, length, 16, 8);
    for (int i = 0; i < 16 * 8 * 3; ++i) {
        assert_near(light[i], 1.0f, 0.0f);
    }
    vtFree(light);
    refusesCuts(bytes, length);
    free(bytes);
    bytes = loadCase("hdr-rle-cut.hdr", &length);
    expectSentence(bytes, length, "its pixels are cut off");
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everyOrderIsRead),     cmocka_unit_test(everyCodingIsRead),
        cmocka_unit_test(headersCount),         cmocka_unit_test(valuesAreMadeUsable),
        cmocka_unit_test(casesAreAsTheyShould),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
