#include "cli/background.h"

#include <math.h>

#include "base/error.h"
#include "base/math.h"
#include "image/image.h"
#include "light/blur.h"

vtResult vtMakeTracedBackground(const vtInput* input, const vtFrame* frame, vtTracedBackground* background,
                                vtError* error)
{
    *background = (vtTracedBackground){.frame = frame,
                                       .camera = vtMakeCamera(frame),
                                       .picture = &input->background,
                                       .exposure = exp2f(frame->exposure)};
    return frame->background == vt_backgroundBlurred
               ? vtBlurEnvironment(&input->environment, frame->backgroundBlur, &background->blurred, error)
               : vtSucceed(error);
}

void vtDestroyTracedBackground(vtTracedBackground* background)
{
    vtDestroyEnvironment(&background->blurred);
    *background = (vtTracedBackground){0};
}

static vtVec3 toLinear(vtVec3 color)
{
    return (vtVec3){vtSrgbToLinear(color.x), vtSrgbToLinear(color.y), vtSrgbToLinear(color.z)};
}

static vtVec3 toSrgb(vtVec3 color)
{
    return (vtVec3){vtLinearToSrgb(color.x), vtLinearToSrgb(color.y), vtLinearToSrgb(color.z)};
}

static vtVec3 texel(const vtImage* picture, int x, int y)
{
    x = x < 0 ? 0 : x < picture->width ? x : picture->width - 1;
    y = y < 0 ? 0 : y < picture->height ? y : picture->height - 1;
    const uint8_t* at = picture->pixels + 4 * ((size_t)y * (size_t)picture->width + (size_t)x);
    return toLinear((vtVec3){(float)at[0] / 255.0f, (float)at[1] / 255.0f, (float)at[2] / 255.0f});
}

static vtVec3 readBetween(const vtImage* picture, float x, float y)
{
    const float left = floorf(x - 0.5f), top = floorf(y - 0.5f);
    const int i = (int)left, j = (int)top;
    const float across = x - 0.5f - left, down = y - 0.5f - top;
    return vtMix(vtMix(texel(picture, i, j), texel(picture, i + 1, j), across),
                 vtMix(texel(picture, i, j + 1), texel(picture, i + 1, j + 1), across), down);
}

/// The picture fills the frame; of a larger one the mean over the pixel.
static vtVec3 pictureAt(const vtTracedBackground* background, float x, float y)
{
    const vtImage* picture = background->picture;
    const vtFrame* frame = background->frame;
    const float scale =
        fminf((float)picture->width / (float)frame->width, (float)picture->height / (float)frame->height);
    const int parts = scale > 1.0f ? (int)fminf(ceilf(scale), 64.0f) : 1; // along a side of the pixel
    vtVec3 sum = {0.0f, 0.0f, 0.0f};
    for (int i = 0; i < parts * parts; ++i) {
        const float right = ((float)(i % parts) + 0.5f) / (float)parts - 0.5f;
        const float down = ((float)(i / parts) + 0.5f) / (float)parts - 0.5f;
        const float u = 0.5f * (float)picture->width + scale * (x + right - 0.5f * (float)frame->width);
        const float v = 0.5f * (float)picture->height + scale * (y + down - 0.5f * (float)frame->height);
        sum = vtAdd(sum, readBetween(picture, u, v));
    }
    return vtScale(sum, 1.0f / (float)(parts * parts));
}

static vtVec3 blurredAt(const vtTracedBackground* background, float x, float y)
{
    const vtCamera* camera = &background->camera;
    const float right = (x / (float)background->frame->width * 2.0f - 1.0f) * camera->high[0];
    const float up = (1.0f - y / (float)background->frame->height * 2.0f) * camera->high[1];
    const vtVec3 towards = vtMulAdd(vtMulAdd(camera->forward, right, camera->right), up, camera->up);
    const vtVec3 direction = camera->orthographic ? camera->forward : vtNormalize(towards);
    return vtScale(vtEnvironment_Sample(&background->blurred, direction), background->exposure);
}

static vtVec3 shownLight(const vtFrame* frame, vtVec3 light)
{
    light = vtToneMap(frame->toneMapping, light);
    return (vtVec3){fminf(light.x, 1.0f), fminf(light.y, 1.0f), fminf(light.z, 1.0f)};
}

void vtTracedBackground_Show(const vtTracedBackground* background, int column, int row, vtVec3 light,
                             float share, float* rgba)
{
    const vtFrame* frame = background->frame;
    const float x = (float)column + 0.5f, y = (float)row + 0.5f;
    const bool isLight = frame->background == vt_backgroundBlurred;
    vtVec3 back = toLinear(frame->backgroundColor);
    if (isLight) {
        light = vtMix(blurredAt(background, x, y), light, share);
    } else if (frame->background == vt_backgroundPicture) {
        back = pictureAt(background, x, y);
    }
    vtVec3 shown = frame->linear ? light : shownLight(frame, light);
    const bool isOver = !isLight && frame->background != vt_backgroundTransparent;
    shown = isOver ? vtMix(back, shown, share) : shown;
    shown = frame->linear ? shown : toSrgb(shown);
    rgba[0] = shown.x;
    rgba[1] = shown.y;
    rgba[2] = shown.z;
    rgba[3] = frame->background == vt_backgroundTransparent ? share : 1.0f;
}
