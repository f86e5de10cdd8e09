// Surroundings: checker cells, the equirectangular map, names, and that all numbers are usable.
#include <math.h>

#include "base/math.h"
#include "base/memory.h"
#include "image/image.h"
#include "light/environment.h"
#include "light/environment_levels.h"
#include "testing.h"

/// The direction at u, v of the map.
static vtVec3 directionAt(float u, float v)
{
    const float azimuth = (u - 0.5f) * 2.0f * VT_PI, elevation = (v - 0.5f) * VT_PI;
    return (vtVec3){cosf(elevation) * cosf(azimuth), sinf(elevation), cosf(elevation) * sinf(azimuth)};
}

static void expectCell(vtVec3 d, int q)
{
    const vtVec3 radiance = vtEnvironmentChecker(d);
    const float base = 0.15f + 0.75f * (float)q;
    assert_near(radiance.x, base * (0.675f + 0.325f * d.x), 1e-6f);
    assert_near(radiance.y, base * (0.675f + 0.325f * d.y), 1e-6f);
    assert_near(radiance.z, base * (0.675f + 0.325f * d.z), 1e-6f);
}

static void checkerCells(void** state)
{
    (void)state;
    for (int row = 0; row < 16; ++row) {
        for (int column = 0; column < 32; ++column) {
            expectCell(directionAt(((float)column + 0.5f) / 32.0f, ((float)row + 0.5f) / 16.0f),
                       (column + row) % 2);
        }
    }
    // The six axes lie on cell corners: u = .5, .75, 1 (which wraps to 0), .25; v = .5, at the poles 1 and 0.
    expectCell((vtVec3){1.0f, 0.0f, 0.0f}, 0);   // column 16, row 8
    expectCell((vtVec3){0.0f, 0.0f, 1.0f}, 0);   // column 24, row 8
    expectCell((vtVec3){-1.0f, 0.0f, 0.0f}, 0);  // column 32 = 0, row 8
    expectCell((vtVec3){-1.0f, 0.0f, -0.0f}, 0); // the other side of the seam
    expectCell((vtVec3){0.0f, 0.0f, -1.0f}, 0);  // column 8, row 8
    expectCell((vtVec3){0.0f, 1.0f, 0.0f}, 1);   // column 16, row 15: not a seventeenth row
    expectCell((vtVec3){0.0f, -1.0f, 0.0f}, 0);  // column 16, row 0
}

/// A picture whose texel (column, row) holds (column, row, 1).
static vtEnvironment makeRamp(int width, int height)
{
    vtEnvironment ramp = {.kind = vt_environmentImage, .width = width, .height = height};
    ramp.pixels = malloc((size_t)(width * height) * 3 * sizeof(float));
    for (int i = 0; i < width * height; ++i) {
        ramp.pixels[3 * i] = (float)(i % width);
        ramp.pixels[3 * i + 1] = (float)(i / width);
        ramp.pixels[3 * i + 2] = 1.0f;
    }
    return ramp;
}

static void picturesAreMappedAsDocumented(void** state)
{
    (void)state;
    vtEnvironment ramp = makeRamp(8, 4);
    static const struct {
        vtVec3 d;
        float column, row; // in texels from the upper left centre
    } axes[] = {
        {{1.0f, 0.0f, 0.0f}, 3.5f, 1.5f},
        {{0.0f, 0.0f, 1.0f}, 5.5f, 1.5f},
        {{0.0f, 0.0f, -1.0f}, 1.5f, 1.5f},
        {{-1.0f, 0.0f, 0.0f}, 3.5f, 1.5f}, // half of column 7, half of column 0: repeated in u
        {{0.0f, 1.0f, 0.0f}, 3.5f, 0.0f},
        {{0.0f, -1.0f, 0.0f}, 3.5f, 3.0f}, // clamped in v
    };
    for (size_t i = 0; i < sizeof axes / sizeof axes[0]; ++i) {
        const vtVec3 sample = vtEnvironment_Sample(&ramp, axes[i].d);
        assert_near(sample.x, axes[i].column, 1e-5f);
        assert_near(sample.y, axes[i].row, 1e-5f);
        assert_near(sample.z, 1.0f, 1e-6f);
    }
    const vtVec3 centre = vtEnvironment_Sample(&ramp, directionAt(2.5f / 8.0f, 1.0f - 1.5f / 4.0f));
    assert_near(centre.x, 2.0f, 1e-5f); // a texel's centre gives the texel
    assert_near(centre.y, 1.0f, 1e-5f);
    vtDestroyEnvironment(&ramp);
    assert_null(ramp.pixels);
    vtDestroyEnvironment(&ramp);
}

static void namesMakeEnvironments(void** state)
{
    (void)state;
    static const char* const names[] = {"checker", "studio", "sky"};
    vtEnvironment environment;
    vtError error = {0};
    for (int i = 0; i < 3; ++i) {
        assert_string_equal(vtEnvironmentName(i), names[i]);
        assert_true(strlen(vtEnvironmentSummary(i)) > 10);
        assert_ok(vtCreateEnvironment(names[i], &environment, &error), error);
        assert_int_equal(environment.kind, i);
        assert_null(environment.pixels);
        vtDestroyEnvironment(&environment);
    }
    assert_null(vtEnvironmentName(3));
    assert_null(vtEnvironmentName(-1));
    assert_null(vtEnvironmentSummary(3));
    assert_int_equal(vtCreateEnvironment("moon", &environment, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "'moon'"));
    assert_non_null(strstr(error.message, "studio"));
}

static void builtInRadianceIsUsable(void** state)
{
    (void)state;
    for (int i = 0; vtEnvironmentName(i) != NULL; ++i) {
        vtEnvironment environment;
        vtError error = {0};
        assert_ok(vtCreateEnvironment(vtEnvironmentName(i), &environment, &error), error);
        float brightest = 0.0f;
        for (int v = 0; v <= 128; ++v) {
            for (int u = 0; u <= 256; ++u) {
                const vtVec3 light =
                    vtEnvironment_Sample(&environment, directionAt((float)u / 256.0f, (float)v / 128.0f));
                assert_true(light.x >= 0.0f && light.y >= 0.0f && light.z >= 0.0f);
                assert_true(light.x <= 50.0f && light.y <= 50.0f && light.z <= 50.0f);
                brightest = fmaxf(brightest, light.y);
            }
        }
        assert_true(brightest > 0.5f);
    }
    assert_true(vtEnvironmentSky((vtVec3){-0.5f, 0.5f, -0.70710678f}).x > 40.0f); // the sun's disc
}

static void environmentsLoadFromFiles(void** state)
{
    (void)state;
    const uint8_t pixels[2 * 3] = {255, 0, 0, 255, 0, 0};
    uint8_t* bytes = NULL;
    size_t size = 0;
    vtError error = {0};
    assert_ok(vtEncodePng(pixels, 3, 2, 1, &bytes, &size, &error), error);
    vtEnvironment environment;
    assert_ok(vtLoadEnvironment(bytes, size, "red.png", &environment, &error), error);
    assert_int_equal(environment.kind, vt_environmentImage);
    const vtVec3 light = vtEnvironment_Sample(&environment, (vtVec3){0.6f, 0.8f, 0.0f});
    assert_near(light.x, 1.0f, 1e-6f);
    assert_near(light.y, 0.0f, 1e-6f);
    vtDestroyEnvironment(&environment);
    assert_int_equal(vtLoadEnvironment(bytes, 20, "red.png", &environment, &error), vt_errorFormat);
    assert_non_null(strstr(error.message, "red.png"));
    assert_null(environment.pixels);
    free(bytes);
}

static void decodedPixelsGiveWhatTheirFileGives(void** state)
{
    (void)state;
    const uint8_t pixels[2 * 4] = {255, 128, 3, 255, 64, 200, 10, 0};
    uint8_t* bytes = NULL;
    size_t size = 0;
    vtError error = {0};
    assert_ok(vtEncodePng(pixels, 4, 2, 1, &bytes, &size, &error), error);
    vtEnvironment file, decoded;
    assert_ok(vtLoadEnvironment(bytes, size, "two.png", &file, &error), error);
    assert_ok(vtCreateImageEnvironment(pixels, 2, 1, "two.png", &decoded, &error), error);
    assert_int_equal(decoded.kind, vt_environmentImage);
    assert_true(decoded.width == 2 && decoded.height == 1);
    assert_memory_equal(file.pixels, decoded.pixels, 2 * 3 * sizeof(float));
    vtDestroyEnvironment(&file);
    vtDestroyEnvironment(&decoded);
    free(bytes);
    assert_int_equal(vtCreateImageEnvironment(pixels, 1, 20000, "tall.png", &decoded, &error),
                     vt_errorFormat);
    assert_non_null(strstr(error.message, "tall.png"));
    assert_null(decoded.pixels);
}

static vtEnvironmentLevel halved(const vtEnvironment* picture, int times)
{
    vtEnvironmentLevel level = {0};
    for (int i = 0; i < times; ++i) {
        assert_true(vtHalveEnvironment(picture, &level));
    }
    return level;
}

/// Mean of red over the sphere.
static double meanOf(const float* pixels, int width, int height)
{
    double sum = 0.0, all = 0.0;
    for (int i = 0; i < width * height; ++i) {
        const double share = sin(3.14159265358979 * (i / width + 0.5) / height);
        sum += share * (double)pixels[3 * i];
        all += share;
    }
    return sum / all;
}

static void levelsKeepTheMeanOfTheSphere(void** state)
{
    (void)state;
    const int sizes[][2] = {{64, 32}, {50, 25}, {37, 23}, {16, 64}};
    for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; ++k) {
        vtEnvironment ramp = makeRamp(sizes[k][0], sizes[k][1]);
        for (int i = 0; i < ramp.width * ramp.height;
             ++i) { // most of it from the row about the pole, and a ramp across
            ramp.pixels[3 * i] = (i < ramp.width ? 10000.0f : 0.0f) + ramp.pixels[3 * i];
        }
        const double wanted = meanOf(ramp.pixels, ramp.width, ramp.height);
        assert_int_equal(vtEnvironmentLevelCount(ramp.width, ramp.height), k == 0 || k == 3 ? 7 : 6);
        for (int times = 1; times < 4; ++times) {
            vtEnvironmentLevel level = halved(&ramp, times);
            assert_true(level.width == ramp.width >> times && level.height == ramp.height >> times);
            float* shown = malloc((size_t)(level.width * level.height) * 3 * sizeof(float));
            vtWidenEnvironment(&level, shown);
            assert_true(fabs(meanOf(level.pixels, level.width, level.height) - wanted) < 0.05 * wanted);
            assert_true(fabs(meanOf(shown, level.width, level.height) - wanted) < 0.05 * wanted);
            for (int i = 0; i < level.width * level.height; ++i) { // blue is 1 everywhere
                assert_near(shown[3 * i + 2], 1.0f, 1e-4f);
            }
            free(shown);
            vtFree(level.pixels);
        }
        vtDestroyEnvironment(&ramp);
    }
}

/// A texel that is seen is a part of the sphere as wide as it is high: at the pole all of the row, at the
/// equator itself.
static void levelsAreAsWideAsTheyAreHigh(void** state)
{
    (void)state;
    enum { width = 64, height = 32 };
    vtEnvironment stripes = makeRamp(2 * width, 2 * height);
    for (int i = 0; i < 4 * width * height; ++i) {
        stripes.pixels[3 * i] = (float)(i / 2 % 2); // columns of level 1 in turns
    }
    vtEnvironmentLevel level = halved(&stripes, 1);
    static float shown[3 * width * height];
    vtWidenEnvironment(&level, shown);
    for (int column = 0; column < width; ++column) {
        assert_near(shown[3 * column], 0.5f, 0.03f);
        assert_near(shown[3 * (width * (height / 2) + column)], (float)(column % 2), 0.01f);
    }
    vtFree(level.pixels);
    vtDestroyEnvironment(&stripes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(checkerCells),
        cmocka_unit_test(picturesAreMappedAsDocumented),
        cmocka_unit_test(namesMakeEnvironments),
        cmocka_unit_test(builtInRadianceIsUsable),
        cmocka_unit_test(environmentsLoadFromFiles),
        cmocka_unit_test(decodedPixelsGiveWhatTheirFileGives),
        cmocka_unit_test(levelsKeepTheMeanOfTheSphere),
        cmocka_unit_test(levelsAreAsWideAsTheyAreHigh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
