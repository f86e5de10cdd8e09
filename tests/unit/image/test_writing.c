// Pictures of more than 8 bits that are written are read again as they were.
#include <math.h>

#include "base/math.h"
#include "image/image.h"
#include "testing.h"

/// Numbers over many orders of magnitude, some the same in a row.
static float* makeLight(int width, int height, int channels)
{
    float* light = malloc((size_t)(width * height * channels) * sizeof *light);
    for (int i = 0; i < width * height * channels; ++i) {
        const int pixel = i / channels, column = pixel % width, row = pixel / width;
        const float wave = 1.5f + sinf((float)(7 * pixel + 3 * (i % channels)));
        light[i] = row % 3 == 0 && column > 4 ? 0.25f * (float)(1 + i % channels)
                   : pixel % 11 == 0          ? 0.0f
                                              : wave * powf(10.0f, (float)(pixel % 9 - 4));
    }
    return light;
}

static void exrHasTheFloatsThemselves(void** state)
{
    (void)state;
    vtError error;
    const int widths[] = {1, 7, 40, 129};
    for (int i = 0; i < 8; ++i) {
        const int width = widths[i % 4], height = 37, channels = 3 + i / 4;
        float* light = makeLight(width, height, channels);
        uint8_t* bytes;
        size_t size;
        float* read;
        int readWidth, readHeight;
        assert_ok(vtEncodeExr(light, channels, width, height, NULL, &bytes, &size, &error), error);
        assert_ok(vtDecodeImageLinear(bytes, size, "x.exr", &read, &readWidth, &readHeight, &error), error);
        assert_int_equal(readWidth, width);
        assert_int_equal(readHeight, height);
        for (int p = 0; p < width * height; ++p) {
            for (int k = 0; k < 3; ++k) {
                assert_true(read[3 * p + k] == light[channels * p + k]);
            }
        }
        vtFree(bytes);
        vtFree(read);
        free(light);
    }
}

// A mantissa of 8 bits, at least 128 for the largest number: half a step is 1 / 256 of it at most.
static void hdrIsWithinHalfAStep(void** state)
{
    (void)state;
    vtError error;
    const int widths[] = {1, 7, 8, 300}; // the first two are not coded
    for (int i = 0; i < 4; ++i) {
        const int width = widths[i], height = 37;
        float* light = makeLight(width, height, 3);
        uint8_t* bytes;
        size_t size;
        float* read;
        int readWidth, readHeight;
        assert_ok(vtEncodeHdr(light, width, height, NULL, &bytes, &size, &error), error);
        assert_ok(vtDecodeImageLinear(bytes, size, "x.hdr", &read, &readWidth, &readHeight, &error), error);
        assert_int_equal(readWidth, width);
        assert_int_equal(readHeight, height);
        for (int p = 0; p < width * height; ++p) {
            const float most = fmaxf(light[3 * p], fmaxf(light[3 * p + 1], light[3 * p + 2]));
            for (int k = 0; k < 3; ++k) {
                assert_near(read[3 * p + k], fminf(light[3 * p + k], 65504.0f), most / 256.0f);
            }
        }
        vtFree(bytes);
        vtFree(read);
        free(light);
    }
}

static void hdrTakesNumbersThatAreNoLight(void** state)
{
    (void)state;
    const float odd[] = {-1.0f, NAN, 0.0f, INFINITY, 1.0f, 0.0f, 0.99999f, 0.5f, 255.9f / 256.0f};
    uint8_t* bytes;
    size_t size;
    float* read;
    int width, height;
    vtError error;
    assert_ok(vtEncodeHdr(odd, 3, 1, NULL, &bytes, &size, &error), error);
    assert_ok(vtDecodeImageLinear(bytes, size, "x.hdr", &read, &width, &height, &error), error);
    assert_true(read[0] == 0.0f && read[1] == 0.0f && read[2] == 0.0f);
    assert_true(read[3] == 65504.0f); // the most that is read
    assert_near(read[6], 1.0f, 1e-6f);
    assert_near(read[7], 0.5f, 1e-6f);
    vtFree(bytes);
    vtFree(read);
}

static void aPngOf16BitsHasAll16(void** state)
{
    (void)state;
    enum { width = 33, height = 9 };
    uint16_t samples[4 * width * height];
    for (int i = 0; i < 4 * width * height; ++i) {
        samples[i] = i % 4 == 3 ? 65535 : (uint16_t)(i * 257 + 13 * i);
    }
    uint8_t* bytes;
    size_t size;
    float* read;
    int readWidth, readHeight;
    vtError error;
    assert_ok(vtEncodePngOf(samples, 4, 16, width, height, NULL, &bytes, &size, &error), error);
    assert_ok(vtDecodeImageLinear(bytes, size, "x.png", &read, &readWidth, &readHeight, &error), error);
    for (int p = 0; p < width * height; ++p) {
        for (int k = 0; k < 3; ++k) {
            assert_true(read[3 * p + k] == vtSrgbToLinear((float)samples[4 * p + k] / 65535.0f));
        }
    }
    vtFree(bytes);
    vtFree(read);
}

static void sidesAreChecked(void** state)
{
    (void)state;
    const float light[4] = {0};
    const uint16_t samples[4] = {0};
    uint8_t* bytes;
    size_t size;
    vtError error;
    assert_int_equal(vtEncodeExr(light, 3, 0, 1, NULL, &bytes, &size, &error), vt_errorArgument);
    assert_int_equal(vtEncodeHdr(light, 1, 20000, NULL, &bytes, &size, &error), vt_errorArgument);
    assert_int_equal(vtEncodePngOf(samples, 4, 16, -1, 1, NULL, &bytes, &size, &error), vt_errorArgument);
    assert_null(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exrHasTheFloatsThemselves),
        cmocka_unit_test(hdrIsWithinHalfAStep),
        cmocka_unit_test(hdrTakesNumbersThatAreNoLight),
        cmocka_unit_test(aPngOf16BitsHasAll16),
        cmocka_unit_test(sidesAreChecked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
