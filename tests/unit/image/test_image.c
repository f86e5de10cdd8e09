// Pictures: transfer curve, round trips, row order, and bad data.
#include <math.h>

#include "image/pfm.h"
#include "image_cases.h"

static void curveHasKnownValues(void** state)
{
    (void)state;
    assert_near(vtSrgbToLinear(0.0f), 0.0f, 0.0f);
    assert_near(vtSrgbToLinear(1.0f), 1.0f, 1e-6f);
    assert_near(vtSrgbToLinear(0.5f), 0.21404114f, 1e-6f);
    assert_near(vtSrgbToLinear(128.0f / 255.0f), 0.21586050f, 1e-6f);
    assert_near(vtSrgbToLinear(0.04045f), 0.0031308f, 1e-7f);
    assert_near(vtLinearToSrgb(0.18f), 0.46135613f, 1e-6f);
    for (int i = 0; i < 256; ++i) {
        assert_int_equal((int)lrintf(255.0f * vtLinearToSrgb(vtSrgbToLinear((float)i / 255.0f))), i);
    }
}

static void pngComesBack(void** state)
{
    (void)state;
    const uint8_t rgba[2 * 3 * 4] = {0,  0,  0,  255, 255, 255, 255, 255, 128, 1,  2,  0,
                                     10, 20, 30, 255, 40,  50,  60,  255, 70,  80, 90, 9};
    uint8_t* bytes = NULL;
    size_t size = 0;
    vtError error = {0};
    for (int channels = 3; channels <= 4; ++channels) {
        uint8_t pixels[sizeof rgba];
        for (int i = 0; i < 6; ++i) {
            memcpy(pixels + i * channels, rgba + 4 * i, (size_t)channels);
        }
        assert_ok(vtEncodePng(pixels, channels, 3, 2, &bytes, &size, &error), error);
        assert_memory_equal(bytes, "\x89PNG", 4);
        float* linear = NULL;
        int width = 0, height = 0;
        assert_ok(vtDecodeImageLinear(bytes, size, "a.png", &linear, &width, &height, &error), error);
        assert_int_equal(width, 3);
        assert_int_equal(height, 2);
        for (int i = 0; i < 18; ++i) {
            const float expected = vtSrgbToLinear((float)rgba[i / 3 * 4 + i % 3] / 255.0f);
            assert_near(linear[i], expected, 1e-7f); // alpha is dropped, not multiplied
        }
        free(linear);
        free(bytes);
    }
}

static void badPicturesGetSentences(void** state)
{
    (void)state;
    expectSentence(NULL, 0, "is empty");
    expectSentence((const uint8_t*)"hello, world", 12, "is no picture that can be read");
    expectSentence((const uint8_t*)"RIFF\4\0\0\0WAVE", 12, "is no picture that can be read");
    assert_false(vtIsPicture("RIFF\4\0\0\0WAVE", 12));
    assert_false(vtIsPicture("P", 1));
    assert_true(vtIsPicture("Pf\n", 3));
}

static void anyPfmIsLight(void** state)
{
    (void)state;
    const uint8_t grey[] = {'P', 'f', ' ', '1', ' ', '1', ' ', '1', '\n', 0x40, 0, 0, 0};
    float* light = expectLight(grey, sizeof grey, 1, 1);
    assert_true(light[0] == 2.0f && light[1] == 2.0f && light[2] == 2.0f);
    vtFree(light);
    const uint8_t colour[] = {'P', 'F', ' ',  '1',  ' ', '1', ' ',  '1',  '\n', 0x40, 0,
                              0,   0,   0xBF, 0x80, 0,   0,   0x7F, 0xC0, 0,    0};
    light = expectLight(colour, sizeof colour, 1, 1);
    assert_true(light[0] == 2.0f && light[1] == 0.0f && light[2] == 0.0f); // below 0; not a number
    vtFree(light);
    refusesCuts(colour, sizeof colour);
    survivesDamage(colour, sizeof colour, 1000);
}

static void pfmComesBackBottomRowFirst(void** state)
{
    (void)state;
    const float rgb[2 * 2 * 3] = {1.0f,  2.0f, 3.0f, 4.0f,   5.0f,  6.0f,
                                  -7.0f, 8.5f, 0.0f, 1e-30f, 1e30f, 12.0f};
    uint8_t* bytes = NULL;
    size_t size = 0;
    vtError error = {0};
    assert_ok(vtEncodePfm(rgb, 2, 2, &bytes, &size, &error), error);
    const char header[] = "PF\n2 2\n-1.0\n";
    const size_t headerSize = sizeof header - 1;
    assert_int_equal(size, headerSize + sizeof rgb);
    assert_memory_equal(bytes, header, headerSize);
    const uint8_t minusSeven[4] = {0x00, 0x00, 0xE0, 0xC0}; // the lower row's first number, little endian
    assert_memory_equal(bytes + headerSize, minusSeven, 4);

    float* back = NULL;
    int width = 0, height = 0;
    assert_ok(vtDecodePfm(bytes, size, "a.pfm", &back, &width, &height, &error), error);
    assert_int_equal(width * 10 + height, 22);
    assert_memory_equal(back, rgb, sizeof rgb);
    free(back);
    for (size_t length = 0; length < size; ++length) {
        assert_int_equal(vtDecodePfm(bytes, length, "cut.pfm", &back, &width, &height, &error),
                         vt_errorFormat);
        assert_non_null(strstr(error.message, "cut.pfm"));
        assert_null(back);
    }
    free(bytes);

    const uint8_t bigEndian[] = {'P', 'F', ' ',  '1', ' ', '1', ' ', '1', '\n', 0x3F, 0x80,
                                 0,   0,   0x40, 0,   0,   0,   0,   0,   0,    0};
    assert_ok(vtDecodePfm(bigEndian, sizeof bigEndian, "b.pfm", &back, &width, &height, &error), error);
    assert_near(back[0], 1.0f, 0.0f);
    assert_near(back[1], 2.0f, 0.0f);
    free(back);
}

static void badPfmGetsSentence(void** state)
{
    (void)state;
    const char* const bad[] = {"Pf\n1 1\n-1.0\n0000", "PF\n0 1\n-1.0\n", "PF\n1 99999\n-1.0\n",
                               "PF\n1 1\n0\n",        "PF\n-1 1\n-1\n",  "PF\n1 1\nnan\n",
                               "P6\n1 1\n255\n"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        float* rgb = NULL;
        int width, height;
        vtError error = {0};
        assert_int_equal(vtDecodePfm(bad[i], strlen(bad[i]), "x.pfm", &rgb, &width, &height, &error),
                         vt_errorFormat);
        assert_non_null(strstr(error.message, "x.pfm"));
    }
}

static void sizesAreChecked(void** state)
{
    (void)state;
    const uint8_t pixel[4] = {0};
    uint8_t* bytes = NULL;
    size_t size = 0;
    vtError error = {0};
    assert_int_equal(vtEncodePng(pixel, 4, 0, 1, &bytes, &size, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "0 x 1"));
    assert_int_equal(vtEncodePfm((const float[3]){0}, 1, 16385, &bytes, &size, NULL), vt_errorArgument);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curveHasKnownValues),
        cmocka_unit_test(pngComesBack),
        cmocka_unit_test(badPicturesGetSentences),
        cmocka_unit_test(anyPfmIsLight),
        cmocka_unit_test(pfmComesBackBottomRowFirst),
        cmocka_unit_test(badPfmGetsSentence),
        cmocka_unit_test(sizesAreChecked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
