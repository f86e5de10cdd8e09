#include "light/backdrop.h"

#include "base/error.h"
#include "base/math.h"
#include "image/image.h"

vtBackdrop vtDefaultBackdrop(void)
{
    return (vtBackdrop){0};
}

vtResult vtValidateBackdrop(const vtBackdrop* backdrop, vtError* error)
{
    if (backdrop == NULL) {
        return vtFailMissing(error, "vtValidateBackdrop", "backdrop");
    }
    // Written so that NaN fails.
    if (!(backdrop->distance >= 0.0f && backdrop->distance <= 1e6f)) {
        return vtFail(error, vt_errorArgument, "backdrop-distance is %g; it must be from 0 to 1000000",
                      (double)backdrop->distance);
    }
    const float* part = backdrop->part;
    const bool isAll = part[0] == 0.0f && part[1] == 0.0f && part[2] == 0.0f && part[3] == 0.0f;
    for (int i = 0; i < 4; ++i) {
        if (!(fabsf(part[i]) <= 1e6f) || !(isAll || part[i % 2] < part[i % 2 + 2])) {
            return vtFail(error, vt_errorArgument,
                          "the backdrop's part is %g, %g, %g, %g; it must be left, top, right and bottom, "
                          "right and bottom the greater ones",
                          (double)part[0], (double)part[1], (double)part[2], (double)part[3]);
        }
    }
    return vtSucceed(error);
}

/// How far in front of the eye it stands.
static float depthOf(const vtBackdrop* backdrop, const vtFrame* frame, const vtCamera* camera, vtVec3 low,
                     vtVec3 high, float unit)
{
    const vtVec3 half = vtScale(vtSub(high, low), 0.5f), forward = camera->forward;
    float depth = vtDot(vtSub(vtAdd(low, half), camera->eye), forward);
    if (backdrop->distance > 0.0f) {
        const float target = vtLength(vtSub(frame->view.target, frame->view.eye));
        depth = (frame->viewMatrix == NULL ? target * unit : depth) + backdrop->distance * unit;
    } else { // beyond all glass
        depth += fabsf(forward.x) * half.x + fabsf(forward.y) * half.y + fabsf(forward.z) * half.z +
                 0.25f * vtLength(half);
    }
    return fmaxf(depth, 1e-6f * vtLength(half));
}

/// The part of the picture that fills the frame: left, top, right, bottom.
static void partOf(const vtBackdrop* backdrop, float pictureAspect, float aspect, float part[4])
{
    const float across = fminf(aspect / pictureAspect, 1.0f), down = fminf(pictureAspect / aspect, 1.0f);
    const float whole[4] = {0.5f - 0.5f * across, 0.5f - 0.5f * down, 0.5f + 0.5f * across,
                            0.5f + 0.5f * down};
    const bool isGiven = backdrop->part[0] < backdrop->part[2];
    for (int i = 0; i < 4; ++i) {
        part[i] = isGiven ? backdrop->part[i] : whole[i];
    }
}

static void setRow(float* row, vtVec3 axis, float constant)
{
    row[0] = axis.x;
    row[1] = axis.y;
    row[2] = axis.z;
    row[3] = constant;
}

vtBackdropPlace vtPlaceBackdrop(const vtBackdrop* backdrop, int width, int height, const vtFrame* frame,
                                const vtCamera* camera, vtVec3 low, vtVec3 high, float unit)
{
    const float depth = depthOf(backdrop, frame, camera, low, high, unit);
    const float scale = camera->orthographic ? 1.0f : depth; // of what is seen at depth 1
    const float wide = scale * (camera->high[0] - camera->low[0]),
                tall = scale * (camera->high[1] - camera->low[1]);
    float part[4];
    partOf(backdrop, (float)width / (float)height, wide / tall, part);
    const float u = (part[2] - part[0]) / wide, v = (part[3] - part[1]) / tall;
    const vtVec3 eye = camera->eye;
    vtBackdropPlace place;
    setRow(place.plane, camera->forward, vtDot(camera->forward, eye) + depth);
    setRow(place.across, vtScale(camera->right, u),
           part[0] - u * (vtDot(camera->right, eye) + scale * camera->low[0]));
    setRow(place.down, vtScale(camera->up, -v),
           part[1] + v * (vtDot(camera->up, eye) + scale * camera->high[1]));
    return place;
}

/// A texel's place from 0 to count - 1 of one that may lie beyond.
static int mirror(int at, int count)
{
    const int turn = 2 * count, within = (at % turn + turn) % turn;
    return within < count ? within : turn - 1 - within;
}

static vtVec3 texel(const vtImage* picture, int x, int y)
{
    const size_t row = (size_t)mirror(y, picture->height), width = (size_t)picture->width;
    const uint8_t* at = picture->pixels + 4 * (row * width + (size_t)mirror(x, picture->width));
    return (vtVec3){vtSrgbToLinear((float)at[0] / 255.0f), vtSrgbToLinear((float)at[1] / 255.0f),
                    vtSrgbToLinear((float)at[2] / 255.0f)};
}

static float valueAt(const float* row, vtVec3 point)
{
    return row[0] * point.x + row[1] * point.y + row[2] * point.z + row[3];
}

vtVec3 vtBackdrop_Light(const vtBackdropPlace* place, const vtImage* picture, vtVec3 position,
                        vtVec3 direction, vtVec3 beyond)
{
    const vtVec3 normal = vtMakeVec3(place->plane);
    const float towards = vtDot(normal, direction), gap = place->plane[3] - vtDot(normal, position);
    if (towards < 1e-3f || gap < 0.0f) {
        return beyond;
    }
    const vtVec3 point = vtMulAdd(position, gap / towards, direction);
    const float x = valueAt(place->across, point) * (float)picture->width - 0.5f;
    const float y = valueAt(place->down, point) * (float)picture->height - 0.5f;
    if (!(fabsf(x) < 1e9f && fabsf(y) < 1e9f)) {
        return beyond;
    }
    const int i = (int)floorf(x), j = (int)floorf(y);
    const float right = x - floorf(x), below = y - floorf(y);
    return vtMix(vtMix(texel(picture, i, j), texel(picture, i + 1, j), right),
                 vtMix(texel(picture, i, j + 1), texel(picture, i + 1, j + 1), right), below);
}
