// From light to the picture: tone mapping as the C has it, and what lies behind the scene.
#include <stdlib.h>

#include "image/image.h"
#include "light/blur.h"
#include "light/environment.h"
#include "rendering.h"

enum { pixelCount = side * side };

/// Numbers from 0 to 1, the same in every run.
static float nextNumber(uint32_t* state)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

/// Many colours from 0.002 to 30, so that each pixel sees another one.
static void setColors(vtRenderer* renderer)
{
    enum { width = 128, height = 64 };
    float* pixels = malloc(3 * width * height * sizeof *pixels);
    uint32_t state = 7;
    for (int i = 0; i < 3 * width * height; ++i) {
        pixels[i] = 0.002f * powf(15000.0f, nextNumber(&state));
    }
    vtEnvironment environment = {vt_environmentImage, pixels, width, height};
    vtError error;
    assert_ok(vtRenderer_SetEnvironment(renderer, &environment, &error), error);
    free(pixels);
}

static float* drawFloats(Fixture* fixture, const vtFrame* frame)
{
    vtError error;
    float* pixels = malloc(4 * pixelCount * sizeof *pixels);
    assert_ok(vtRenderer_DrawFloats(fixture->renderer, frame, pixels, &error), error);
    return pixels;
}

static float channel(vtVec3 color, int c)
{
    return c == 0 ? color.x : c == 1 ? color.y : color.z;
}

static void toneMappingIsWhatTheCSays(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    setColors(fixture->renderer);
    const vtTechnique techniques[] = {vt_techniqueExact, vt_techniqueLayered};
    for (int i = 0; i < 2 * vt_toneMappingCount; ++i) {
        vtFrame frame = smallFrame(techniques[i % 2]);
        frame.samples = i % 2 == 0 ? 1 : 4;
        frame.exposure = -0.5f;
        frame.linear = true;
        frame.toneMapping = (vtToneMapping)(i / 2); // which light as it is does not take
        float* light = drawFloats(fixture, &frame);
        frame.linear = false;
        float* shown = drawFloats(fixture, &frame);
        draw(fixture, &frame);
        int bright = 0;
        for (int p = 0; p < pixelCount; ++p) {
            const vtVec3 mapped = vtToneMap(frame.toneMapping, vtMakeVec3(light + 4 * p));
            bright += light[4 * p] > 1.5f;
            for (int c = 0; c < 3; ++c) {
                const float wanted = vtLinearToSrgb(channel(mapped, c));
                assert_near(shown[4 * p + c], wanted, 0.5f / 255.0f);
                assert_near((float)fixture->pixels[4 * p + c], 255.0f * wanted, 1.0f);
            }
            assert_true(shown[4 * p + 3] == 1.0f && light[4 * p + 3] == 1.0f);
        }
        assert_true(bright > pixelCount / 20);
        free(light);
        free(shown);
    }
}

/// Shares of each pixel that the scene covers.
static float* drawShares(Fixture* fixture, const vtFrame* frame)
{
    vtFrame transparent = *frame;
    transparent.background = vt_backgroundTransparent;
    transparent.linear = true;
    return drawFloats(fixture, &transparent);
}

static void aColourIsBehindTheScene(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "knot");
    setEnvironment(fixture->renderer, "studio");
    for (int i = 0; i < 4; ++i) {
        vtFrame frame = smallFrame(i % 2 == 0 ? vt_techniqueExact : vt_techniqueLayered);
        frame.samples = i < 2 ? 1 : 8;
        frame.exposure = 1.0f;
        frame.toneMapping = vt_toneMappingNeutral;
        float* glass = drawShares(fixture, &frame);
        frame.background = vt_backgroundColor;
        frame.backgroundColor = (vtVec3){1.0f, 0.5f, 0.2f};
        draw(fixture, &frame);
        int behind = 0, partly = 0;
        for (int p = 0; p < pixelCount; ++p) {
            const float share = glass[4 * p + 3];
            const vtVec3 light = vtToneMap(frame.toneMapping, vtMakeVec3(glass + 4 * p));
            for (int c = 0; c < 3; ++c) {
                const float back = vtSrgbToLinear(channel(frame.backgroundColor, c));
                const float wanted = vtLinearToSrgb(back + share * (channel(light, c) - back));
                assert_near((float)fixture->pixels[4 * p + c], 255.0f * wanted, 1.1f);
            }
            assert_int_equal(fixture->pixels[4 * p + 3], 255);
            behind += share == 0.0f;
            partly += share > 0.0f && share < 1.0f;
        }
        assert_true(behind > pixelCount / 4 && behind < pixelCount);
        assert_true(i < 2 ? partly == 0 : partly > side);
        free(glass);
    }
}

static void theBlurredEnvironmentIsBehindTheScene(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    setEnvironment(fixture->renderer, "sky");
    vtEnvironment sky, blurred;
    vtError error;
    assert_ok(vtCreateEnvironment("sky", &sky, &error), error);
    const float degrees[] = {6.0f, 25.0f};
    for (int i = 0; i < 4; ++i) {
        vtFrame frame = smallFrame(vt_techniqueExact);
        frame.background = vt_backgroundBlurred;
        frame.backgroundBlur = degrees[i / 2];
        frame.exposure = -1.0f;
        frame.toneMapping = i % 2 == 0 ? vt_toneMappingNone : vt_toneMappingAgx;
        float* glass = drawShares(fixture, &frame);
        draw(fixture, &frame);
        assert_ok(vtBlurEnvironment(&sky, frame.backgroundBlur, &blurred, &error), error);
        int behind = 0;
        for (int p = 0; p < pixelCount; ++p) {
            const bool isGlass = glass[4 * p + 3] > 0.0f;
            const vtVec3 seen =
                vtScale(vtEnvironmentImage(&blurred, eyeRay(&frame, p % side, p / side)), 0.5f);
            const vtVec3 shown = vtToneMap(frame.toneMapping, isGlass ? vtMakeVec3(glass + 4 * p) : seen);
            for (int c = 0; c < 3; ++c) {
                const float wanted = 255.0f * vtLinearToSrgb(channel(shown, c));
                assert_near((float)fixture->pixels[4 * p + c], wanted, 1.6f); // halves, and 8 bits of a place
            }
            behind += !isGlass;
        }
        assert_true(behind > side);
        vtDestroyEnvironment(&blurred);
        free(glass);
    }
}

/// Four columns of colours, each 40 wide, 40 high.
static vtImage columnsPicture(void)
{
    static const uint8_t colors[4][4] = {
        {255, 0, 0, 255}, {0, 200, 0, 0}, {0, 0, 120, 90}, {250, 240, 10, 255}};
    vtImage image = {.pixels = malloc(4 * 160 * 40), .width = 160, .height = 40};
    for (int i = 0; i < 160 * 40; ++i) {
        memcpy(image.pixels + 4 * i, colors[i % 160 / 40], 4);
    }
    return image;
}

// It is four times as wide as high: of the square frame it fills the height, and its two outer columns are
// cut off.
static void aPictureFillsTheFrame(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    setEnvironment(fixture->renderer, "studio");
    vtImage image = columnsPicture();
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.background = vt_backgroundPicture;
    frame.exposure = 2.0f;
    vtError error;
    assert_int_equal(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error),
                     vt_errorArgument);
    assert_non_null(strstr(error.message, "vtRenderer_SetBackground"));
    assert_int_equal(vtRenderer_SetBackground(fixture->renderer, &(vtImage){.width = 3, .height = 3}, &error),
                     vt_errorArgument);
    assert_ok(vtRenderer_SetBackground(fixture->renderer, &image, &error), error);
    frame.view.eye = (vtVec3){0.0f, 0.0f, 8.0f}; // a small ball in the middle
    draw(fixture, &frame);
    const struct {
        int x, y;
        uint8_t color[4];
    } spots[] = {{1, 1, {0, 200, 0, 255}},
                 {60, 2, {0, 200, 0, 255}},
                 {1, 126, {0, 200, 0, 255}},
                 {67, 125, {0, 0, 120, 255}},
                 {126, 64, {0, 0, 120, 255}}};
    for (size_t i = 0; i < sizeof spots / sizeof spots[0]; ++i) {
        const uint8_t* pixel = fixture->pixels + 4 * (side * spots[i].y + spots[i].x);
        for (int c = 0; c < 4; ++c) {
            assert_near((float)pixel[c], (float)spots[i].color[c], 1.0f);
        }
    }
    // In a frame six times as wide as high its whole width is seen, and its middle rows.
    frame.width = 6 * 24;
    frame.height = 24;
    draw(fixture, &frame);
    assert_near((float)fixture->pixels[0], 255.0f, 1.0f);
    const uint8_t* last = fixture->pixels + 4 * (frame.width * 13 - 1);
    assert_near((float)last[1], 240.0f, 1.0f);
    assert_ok(vtRenderer_SetBackground(fixture->renderer, NULL, &error), error);
    assert_int_equal(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error),
                     vt_errorArgument);
    free(image.pixels);
}

// Row 0 of a picture is its top row, and a large one is not sampled but averaged.
static void aPictureStandsUprightAndIsSmooth(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    setEnvironment(fixture->renderer, "studio");
    enum { pictureSide = 1024 };
    vtImage image = {
        .pixels = malloc(4 * pictureSide * pictureSide), .width = pictureSide, .height = pictureSide};
    for (int i = 0; i < pictureSide * pictureSide; ++i) {
        const int row = i / pictureSide, column = i % pictureSide;
        const uint8_t value = row < pictureSide / 2 ? 255 * (uint8_t)((row + column) % 2) : 0;
        memcpy(image.pixels + 4 * i, (const uint8_t[4]){value, value, value, 255}, 4);
    }
    vtError error;
    assert_ok(vtRenderer_SetBackground(fixture->renderer, &image, &error), error);
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.background = vt_backgroundPicture;
    frame.view.eye = (vtVec3){0.0f, 0.0f, 8.0f};
    draw(fixture, &frame);
    const float half = 255.0f * vtLinearToSrgb(0.5f);
    for (int column = 0; column < side; ++column) {
        assert_near((float)fixture->pixels[4 * (10 * side + column)], half, 2.0f);
        assert_int_equal(fixture->pixels[4 * (120 * side + column)], 0);
    }
    free(image.pixels);
}

static void fullAnalysisHasNoBackground(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    vtFrame frame = smallFrame(vt_techniqueLayered);
    frame.output = vt_outputAnalysis;
    frame.background = vt_backgroundColor;
    frame.toneMapping = vt_toneMappingAces;
    draw(fixture, &frame);
    assert_int_equal(fixture->pixels[0], 255); // white, as it stands in the legend
    assert_int_equal(fixture->pixels[3], 255);
}

static void colorsOutOfRangeAreRefused(void** state)
{
    (void)state;
    const vtVec3 colors[] = {{1.5f, 0.0f, 0.0f}, {0.0f, -0.1f, 0.0f}, {0.0f, 0.0f, NAN}};
    vtError error;
    for (int i = 0; i < 3; ++i) {
        vtFrame frame = vtDefaultFrame();
        frame.backgroundColor = colors[i];
        assert_int_equal(vtValidateFrame(&frame, &error), vt_errorArgument);
        assert_non_null(strstr(error.message, "background-color"));
    }
}

static void motionIsTheMeanOfItsMoments(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "knot");
    setEnvironment(fixture->renderer, "studio");
    const vtTechnique techniques[] = {vt_techniqueExact, vt_techniqueLayered};
    for (int i = 0; i < 2; ++i) {
        vtFrame first = smallFrame(techniques[i]);
        first.linear = true;
        vtFrame second = first;
        second.view = vtView_Orbit(first.view, 0.3f, 0.0f);
        second.firstSample = 1;
        float* wanted = drawFloats(fixture, &second); // that sample alone: what is there is not of this view
        float* before = drawFloats(fixture, &first);
        second.moving = true;
        float* both = drawFloats(fixture, &second);
        double apart = 0.0;
        for (int k = 0; k < 4 * pixelCount; ++k) {
            const float mean = 0.5f * (wanted[k] + before[k]);
            assert_near(both[k], mean, 0.004f + 0.004f * mean); // half floats
            apart += (double)fabsf(wanted[k] - before[k]);
        }
        assert_true(apart > 0.01 * 4 * pixelCount); // it did move
        free(wanted);
        free(before);
        free(both);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(toneMappingIsWhatTheCSays),
        cmocka_unit_test(aColourIsBehindTheScene),
        cmocka_unit_test(theBlurredEnvironmentIsBehindTheScene),
        cmocka_unit_test(aPictureFillsTheFrame),
        cmocka_unit_test(aPictureStandsUprightAndIsSmooth),
        cmocka_unit_test(fullAnalysisHasNoBackground),
        cmocka_unit_test(colorsOutOfRangeAreRefused),
        cmocka_unit_test(motionIsTheMeanOfItsMoments),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
