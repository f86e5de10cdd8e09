// Rough glass, and glass that disperses, as `exact` draws them, by what is known of it without another
// renderer.
#include <math.h>
#include <string.h>

#include "rendering.h"

static float linearOf(uint8_t value)
{
    const float x = (float)value / 255.0f;
    return x <= 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
}

static void drawShape(Fixture* fixture, const vtFrame* frame)
{
    vtError error;
    assert_ok(vtRenderer_DrawImage(fixture->renderer, frame, fixture->pixels, &error), error);
}

/// An environment of one colour everywhere.
static void setWhite(Fixture* fixture)
{
    static float white[3 * 64 * 32];
    for (size_t i = 0; i < sizeof white / sizeof white[0]; ++i) {
        white[i] = 1.0f;
    }
    vtError error;
    const vtEnvironment environment = {vt_environmentImage, white, 64, 32};
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
}

// Where light comes alike from everywhere, glass that absorbs nothing is not to be seen, whatever its
// roughness.
static void nothingIsLostInAFurnace(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    setWhite(fixture);
    static const float roughnesses[] = {0.05f, 0.2f, 0.5f, 1.0f};
    for (int samples = 1; samples <= 33; samples += 32) {
        for (size_t i = 0; i < sizeof roughnesses / sizeof roughnesses[0]; ++i) {
            vtFrame frame = smallFrame(vt_techniqueExact);
            frame.width = frame.height = 48;
            frame.fresnel = true;
            frame.exposure = -1.0f;
            frame.maxEvents = 32;
            frame.roughness = roughnesses[i];
            frame.samples = samples;
            drawShape(fixture, &frame);
            double sum = 0.0;
            for (int at = 0; at < 48 * 48; ++at) {
                sum += (double)linearOf(fixture->pixels[4 * at]) / 0.5 / (48 * 48);
            }
            print_message("  roughness %g, %d samples: %.4f\n", (double)roughnesses[i], samples, sum);
            assert_true(fabs(sum - 1.0) < 0.02);
        }
    }
}

// Glass of the index around it bends nothing, and scatters nothing.
static void indexOneIsNoFog(void** state)
{
    Fixture* fixture = *state;
    static uint8_t smooth[sizeof fixture->pixels];
    setShape(fixture->renderer, "knot");
    setEnvironment(fixture->renderer, "checker");
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.fresnel = true;
    frame.ior = 1.0f;
    for (int chance = 0; chance < 2; ++chance) {
        frame.firstSample = chance;
        frame.samples = chance ? 4 : 1;
        frame.roughness = 0.0f;
        drawShape(fixture, &frame);
        memcpy(smooth, fixture->pixels, sizeof smooth);
        frame.roughness = 0.6f;
        drawShape(fixture, &frame);
        for (size_t i = 0; i < sizeof smooth; ++i) {
            assert_true(abs(smooth[i] - fixture->pixels[i]) <= 1);
        }
    }
}

// As glass gets smoother, pictures come to that of smooth glass; roughness 0 is that picture.
static void littleRoughnessIsSmooth(void** state)
{
    Fixture* fixture = *state;
    static uint8_t smooth[sizeof fixture->pixels];
    setShape(fixture->renderer, "sphere");
    setEnvironment(fixture->renderer, "studio");
    for (int chance = 0; chance < 2; ++chance) { // the first sample weighs more where glass is rough
        vtFrame frame = smallFrame(vt_techniqueExact);
        frame.fresnel = true;
        frame.firstSample = chance;
        frame.samples = chance ? 4 : 1;
        drawShape(fixture, &frame);
        memcpy(smooth, fixture->pixels, sizeof smooth);
        frame.roughness = 0.0f;
        drawShape(fixture, &frame);
        assert_memory_equal(smooth, fixture->pixels, sizeof smooth);
        double before = 1e9;
        for (float roughness = 0.3f; roughness > 0.01f; roughness *= 0.2f) {
            frame.roughness = roughness;
            drawShape(fixture, &frame);
            double sum = 0.0;
            for (size_t i = 0; i < sizeof smooth; ++i) {
                sum += abs(smooth[i] - fixture->pixels[i]) / (3.0 * side * side);
            }
            print_message("  roughness %g, %d samples: %.3f of 255 from smooth\n", (double)roughness,
                          frame.samples, sum);
            assert_true(sum < before);
            before = sum;
        }
        assert_true(before < 0.6);
    }
}

// All wavelengths together are white; without dispersion the picture is that of any other glass.
static void wavelengthsSumToWhite(void** state)
{
    Fixture* fixture = *state;
    static uint8_t plain[sizeof fixture->pixels];
    setShape(fixture->renderer, "knot");
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.width = frame.height = 48;
    frame.fresnel = true;
    frame.maxEvents = 32;
    for (int samples = 1; samples <= 33; samples += 32) {
        frame.samples = samples;
        setEnvironment(fixture->renderer, "studio");
        frame.exposure = 0.0f;
        frame.dispersion = -1.0f;
        drawShape(fixture, &frame);
        memcpy(plain, fixture->pixels, sizeof plain);
        frame.dispersion = 0.0f;
        drawShape(fixture, &frame);
        assert_memory_equal(plain, fixture->pixels, sizeof plain);
        frame.dispersion = 2.0f;
        drawShape(fixture, &frame);
        assert_memory_not_equal(plain, fixture->pixels, sizeof plain);

        setWhite(fixture);
        frame.exposure = -1.0f;
        drawShape(fixture, &frame);
        double sums[3] = {0.0};
        for (int at = 0; at < 4 * 48 * 48; ++at) {
            if (at % 4 < 3) {
                sums[at % 4] += (double)linearOf(fixture->pixels[at]) / 0.5 / (48 * 48);
            }
        }
        print_message("  %d samples: %.4f %.4f %.4f\n", samples, sums[0], sums[1], sums[2]);
        for (int channel = 0; channel < 3; ++channel) {
            assert_true(fabs(sums[channel] - 1.0) < 0.02);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothingIsLostInAFurnace),
        cmocka_unit_test(indexOneIsNoFog),
        cmocka_unit_test(littleRoughnessIsSmooth),
        cmocka_unit_test(wavelengthsSumToWhite),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
