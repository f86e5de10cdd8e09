// Tone mapping and blurred environments by closed forms.
#include <math.h>

#include "base/math.h"
#include "light/blur.h"
#include "light/environment.h"
#include "testing.h"

static vtVec3 grey(float value)
{
    return (vtVec3){value, value, value};
}

static void assertColor(vtVec3 color, double red, double green, double blue)
{
    assert_near(color.x, (float)red, 2e-5f);
    assert_near(color.y, (float)green, 2e-5f);
    assert_near(color.z, (float)blue, 2e-5f);
}

static void noneCutsAtWhite(void** state)
{
    (void)state;
    assertColor(vtToneMap(vt_toneMappingNone, (vtVec3){0.25f, 1.0f, 7.0f}), 0.25, 1.0, 1.0);
    assertColor(vtToneMap((vtToneMapping)99, (vtVec3){0.25f, 1.0f, 7.0f}), 0.25, 1.0, 1.0);
}

// By the constants of the specification: F90 0.04, compression from 0.76 on, desaturation 0.15.
static void neutralKeepsColoursBelowItsKnee(void** state)
{
    (void)state;
    assertColor(vtToneMap(vt_toneMappingNeutral, (vtVec3){0.5f, 0.3f, 0.2f}), 0.46, 0.26, 0.16);
    assertColor(vtToneMap(vt_toneMappingNeutral, (vtVec3){0.5f, 0.3f, 0.04f}), 0.47, 0.27, 0.01);
    assertColor(vtToneMap(vt_toneMappingNeutral, (vtVec3){0.5f, 0.3f, 0.0f}), 0.5, 0.3, 0.0);
    assertColor(vtToneMap(vt_toneMappingNeutral, grey(0.0f)), 0.0, 0.0, 0.0);
    // Red of 1: its peak becomes 1 - 0.24^2 / (1 - 0.76 + 0.24), and 1 - 1 / (1 + 0.15 * 0.12) of it grey.
    const double peak = 0.88, share = 1.0 - 1.0 / 1.018;
    assertColor(vtToneMap(vt_toneMappingNeutral, (vtVec3){1.0f, 0.0f, 0.0f}), peak, peak * share,
                peak * share);
    const double bright = 1.0 - 0.0576 / (9.96 - 0.76 + 0.24);
    assertColor(vtToneMap(vt_toneMappingNeutral, grey(10.0f)), bright, bright, bright);
}

// Greys stay grey: the rows of both matrices add up to 1.
static void acesIsItsRationalCurveForGreys(void** state)
{
    (void)state;
    const float greys[] = {0.01f, 0.18f, 1.0f, 8.0f};
    for (int i = 0; i < 4; ++i) {
        const double x = (double)greys[i] / 0.6;
        const double wanted =
            (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081);
        assertColor(vtToneMap(vt_toneMappingAces, grey(greys[i])), wanted, wanted, wanted);
    }
    assertColor(vtToneMap(vt_toneMappingAces, grey(0.18f)), 0.213105, 0.213105, 0.213105);
    assertColor(vtToneMap(vt_toneMappingAces, grey(1e4f)), 1.0, 1.0, 1.0);
    // Red by itself: columns of one matrix through the curve, by rows of the other.
    const vtVec3 red = vtToneMap(vt_toneMappingAces, (vtVec3){0.6f, 0.0f, 0.0f});
    const double in[3] = {0.59719, 0.07600, 0.02840};
    double c[3];
    for (int k = 0; k < 3; ++k) {
        c[k] =
            (in[k] * (in[k] + 0.0245786) - 0.000090537) / (in[k] * (0.983729 * in[k] + 0.4329510) + 0.238081);
    }
    assertColor(red, 1.60475 * c[0] - 0.53108 * c[1] - 0.07367 * c[2],
                fmax(-0.10208 * c[0] + 1.10813 * c[1] - 0.00605 * c[2], 0.0),
                fmax(-0.00327 * c[0] - 0.07276 * c[1] + 1.07602 * c[2], 0.0));
}

static void agxIsItsPolynomialForGreys(void** state)
{
    (void)state;
    const float greys[] = {0.002f, 0.18f, 1.0f, 4.0f};
    for (int i = 0; i < 4; ++i) {
        const double x = (log2((double)greys[i]) + 12.47393) / 16.5; // stops above the darkest, of 16.5
        double y = 15.5;
        const double factors[] = {-40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232};
        for (int k = 0; k < 6; ++k) {
            y = y * x + factors[k];
        }
        const vtVec3 color = vtToneMap(vt_toneMappingAgx, grey(greys[i]));
        const float wanted = (float)pow(fmax(y, 0.0), 2.2);
        assert_near(color.x, wanted, 3e-4f); // its matrices are given by four digits
        assert_near(color.y, wanted, 3e-4f);
        assert_near(color.z, wanted, 3e-4f);
    }
    assert_near(vtToneMap(vt_toneMappingAgx, grey(0.18f)).y, 0.2145f, 5e-4f);
    assertColor(vtToneMap(vt_toneMappingAgx, grey(0.0f)), 0.0, 0.0, 0.0);
    assert_true(vtToneMap(vt_toneMappingAgx, (vtVec3){50.0f, 0.0f, 0.0f}).y > 0.2f); // bright red turns pale
}

static void curvesRiseFromBlackToWhite(void** state)
{
    (void)state;
    for (int i = 0; i < vt_toneMappingCount; ++i) {
        float before = 0.0f;
        for (float value = 0.0f; value < 40.0f; value = 1.05f * value + 0.001f) {
            const float shown = vtToneMap((vtToneMapping)i, grey(value)).y;
            assert_true(shown >= before - 2e-4f && shown <= 1.0f); // agx's polynomial wavers near black
            before = shown;
        }
        assert_true(before > 0.97f);
        assert_non_null(vtToneMappingName(i));
        assert_true(vtToneMappingSummary(i)[0] != '\0');
    }
    assert_null(vtToneMappingName(vt_toneMappingCount));
    assert_null(vtToneMappingName(-1));
}

// ------------------------------------------------------------------------------------------------- blurred

enum { blurWidth = 256, blurHeight = 128 };

static vtEnvironment makePicture(float (*light)(int column, int row))
{
    vtEnvironment picture = {vt_environmentImage, vtAllocate(blurWidth * blurHeight, 3 * sizeof(float)),
                             blurWidth, blurHeight};
    for (int i = 0; i < 3 * blurWidth * blurHeight; ++i) {
        picture.pixels[i] = light(i / 3 % blurWidth, i / 3 / blurWidth) * (float)(1 + i % 3);
    }
    return picture;
}

static float upperHalf(int column, int row)
{
    (void)column;
    return row < blurHeight / 2 ? 1.0f : 0.0f;
}

static float spots(int column, int row)
{
    return (column == 30 && row == 60) || (column == 200 && row == 20) || row == blurHeight - 1 ? 40.0f
                                                                                                : 0.5f;
}

static float meanOf(const vtEnvironment* picture)
{
    double sum = 0.0, all = 0.0;
    for (int row = 0; row < picture->height; ++row) {
        const double share = sin((double)VT_PI * (row + 0.5) / picture->height);
        for (int column = 0; column < picture->width; ++column) {
            sum += share * (double)picture->pixels[3 * (row * picture->width + column)];
            all += share;
        }
    }
    return (float)(sum / all);
}

// A step across the horizon becomes the integral of the Gaussian.
static void aStepBecomesTheErrorFunction(void** state)
{
    (void)state;
    vtEnvironment picture = makePicture(upperHalf), blurred;
    vtError error;
    for (float degrees = 4.0f; degrees < 17.0f; degrees *= 2.0f) {
        assert_ok(vtBlurEnvironment(&picture, degrees, &blurred, &error), error);
        for (int k = -2; k <= 2; ++k) {
            const float height = (float)k * degrees * VT_PI / 180.0f;
            const vtVec3 light = vtEnvironmentImage(&blurred, (vtVec3){cosf(height), sinf(height), 0.0f});
            const float wanted = (float)(0.5 * (1.0 + erf((double)k / sqrt(2.0))));
            assert_near(light.x, wanted, 0.012f);
            assert_near(light.z, 3.0f * wanted, 0.036f);
        }
        vtDestroyEnvironment(&blurred);
    }
    vtDestroyEnvironment(&picture);
}

static void lightIsKept(void** state)
{
    (void)state;
    vtEnvironment picture = makePicture(spots), blurred, sky;
    vtError error;
    for (float degrees = 1.0f; degrees <= 90.0f; degrees *= 3.0f) {
        assert_ok(vtBlurEnvironment(&picture, degrees, &blurred, &error), error);
        assert_near(meanOf(&blurred), meanOf(&picture), 0.02f * meanOf(&picture));
        vtDestroyEnvironment(&blurred);
    }
    vtDestroyEnvironment(&picture);
    assert_ok(vtCreateEnvironment("sky", &sky, &error), error);
    assert_ok(vtBlurEnvironment(&sky, 6.0f, &blurred, &error), error);
    vtEnvironment wide;
    assert_ok(vtBlurEnvironment(&sky, 20.0f, &wide, &error), error);
    assert_near(meanOf(&blurred), meanOf(&wide), 0.02f * meanOf(&wide));
    const vtVec3 up = vtEnvironmentImage(&blurred, (vtVec3){0.0f, 1.0f, 0.0f});
    assert_true(up.z > up.x); // blue above
    vtDestroyEnvironment(&blurred);
    vtDestroyEnvironment(&wide);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(noneCutsAtWhite),
        cmocka_unit_test(neutralKeepsColoursBelowItsKnee),
        cmocka_unit_test(acesIsItsRationalCurveForGreys),
        cmocka_unit_test(agxIsItsPolynomialForGreys),
        cmocka_unit_test(curvesRiseFromBlackToWhite),
        cmocka_unit_test(aStepBecomesTheErrorFunction),
        cmocka_unit_test(lightIsKept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
