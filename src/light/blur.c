// A blurred environment. Pictures, and built-in environments drawn as one, are halved until a texel
// is about half a standard deviation wide; what that mean blurs by itself is little beside the Gaussian. Each
// texel is then the weighted mean of all within three of them; the weights follow from two rows and the
// columns between.
#include "light/blur.h"

#include <math.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "light/environment.h"
#include "light/environment_levels.h"

enum { builtInWidth = 1024 };

/// A built-in environment as a picture.
static bool drawBuiltIn(const vtEnvironment* environment, vtEnvironment* picture)
{
    const int width = builtInWidth, height = builtInWidth / 2;
    *picture = (vtEnvironment){vt_environmentImage, NULL, width, height};
    picture->pixels = vtAllocate((size_t)width * (size_t)height, 3 * sizeof(float));
    for (int i = 0; i < width * height && picture->pixels != NULL; ++i) {
        const vtVec3 light = vtEnvironment_Sample(
            environment, vtEnvironmentDirection(((float)(i % width) + 0.5f) / (float)width,
                                                ((float)(i / width) + 0.5f) / (float)height));
        picture->pixels[3 * i] = light.x;
        picture->pixels[3 * i + 1] = light.y;
        picture->pixels[3 * i + 2] = light.z;
    }
    return picture->pixels != NULL;
}

/// Halved while its texels stay narrower than half the standard deviation; level->pixels stays NULL where not
/// at all.
static bool reduce(const vtEnvironment* picture, float radians, vtEnvironmentLevel* level)
{
    bool made = true;
    *level = (vtEnvironmentLevel){0};
    int width = picture->width;
    while (made && width >= 16 && 2.0f * VT_PI / (float)(width / 2) <= 0.5f * radians) {
        made = vtHalveEnvironment(picture, level);
        width = level->width;
    }
    return made;
}

/// What `row` of the source gives to `target` of the blurred picture: the same weights in all columns. *all:
/// their sum.
static void addRow(const vtEnvironmentLevel* source, int target, int row, float radians, float* out,
                   double* all)
{
    const int width = source->width;
    const float height = VT_PI / (float)source->height;
    const float a = ((float)target + 0.5f) * height, b = ((float)row + 0.5f) * height; // from +Y
    const float least = cosf(fminf(3.0f * radians, VT_PI));
    for (int step = 0; step < width; ++step) {
        const float turn = 2.0f * VT_PI * (float)step / (float)width;
        const float cosine = vtClamp(cosf(a) * cosf(b) + sinf(a) * sinf(b) * cosf(turn), -1.0f, 1.0f);
        if (cosine < least) {
            continue;
        }
        const float angle = acosf(cosine) / radians, weight = sinf(b) * expf(-0.5f * angle * angle);
        *all += (double)weight;
        const float* from = source->pixels + 3 * (size_t)row * (size_t)width;
        for (int i = 0; i < width; ++i) {
            const float* texel = from + 3 * ((i + step) % width);
            out[3 * i] += weight * texel[0];
            out[3 * i + 1] += weight * texel[1];
            out[3 * i + 2] += weight * texel[2];
        }
    }
}

static void blurRows(const vtEnvironmentLevel* source, float radians, float* out)
{
    const float height = VT_PI / (float)source->height;
    for (int target = 0; target < source->height; ++target) {
        float* row = out + 3 * (size_t)target * (size_t)source->width;
        double all = 0.0;
        for (int from = 0; from < source->height; ++from) {
            if (fabsf((float)(from - target)) * height <= 3.0f * radians) {
                addRow(source, target, from, radians, row, &all);
            }
        }
        for (int i = 0; i < 3 * source->width; ++i) {
            row[i] = (float)((double)row[i] / all);
        }
    }
}

vtResult vtBlurEnvironment(const vtEnvironment* environment, float degrees, vtEnvironment* blurred,
                           vtError* error)
{
    const float radians = degrees * VT_PI / 180.0f;
    vtEnvironment drawn = {0};
    *blurred = (vtEnvironment){0};
    const bool isPicture = environment->kind == vt_environmentImage;
    bool made = isPicture || drawBuiltIn(environment, &drawn);
    const vtEnvironment* picture = isPicture ? environment : &drawn;
    vtEnvironmentLevel level = {0};
    made = made && reduce(picture, radians, &level);
    if (made) {
        const vtEnvironmentLevel source =
            level.pixels != NULL ? level
                                 : (vtEnvironmentLevel){picture->pixels, picture->width, picture->height};
        *blurred = (vtEnvironment){vt_environmentImage, NULL, source.width, source.height};
        blurred->pixels = vtAllocateZeroed((size_t)source.width * (size_t)source.height, 3 * sizeof(float));
        made = blurred->pixels != NULL;
        if (made) {
            blurRows(&source, radians, blurred->pixels);
        }
    }
    vtFree(level.pixels);
    vtDestroyEnvironment(&drawn);
    if (!made) {
        *blurred = (vtEnvironment){0};
        return vtFail(error, vt_errorMemory, "environment: out of memory");
    }
    return vtSucceed(error);
}
