#include "cli/trace.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "cli/background.h"
#include "image/image.h"
#include "lab/metrics/timing.h"

static void showProgress(float share, void* userData)
{
    vtShowProgress("tracing", share, *(const double*)userData);
}

vtResult vtTrace(const vtOptions* options, const vtInput* input, const vtFrame* frame, bool showsProgress,
                 vtReferenceImage* image, vtError* error)
{
    vtReference* reference;
    vtResult result = vtCreateReference(&input->scene, &reference, error);
    if (result != vt_ok) {
        return result;
    }
    double start = vtNow();
    const vtBackdrop backdrop = {.distance = options->backdropDistance};
    vtReferenceDef def = {
        .frame = frame,
        .environment = &input->environment,
        .samples = options->samples,
        .fresnel = frame->fresnel,
        .ground = options->ground.isThere ? &input->ground : NULL,
        .backdrop = options->backdrop != NULL ? &backdrop : NULL,
        .backdropPicture = &input->backdrop,
        .progress = showsProgress ? showProgress : NULL,
        .userData = &start,
    };
    result = vtReference_Trace(reference, &def, image, error);
    if (result == vt_ok && options->verbose) {
        fprintf(stderr, "vitrine: traced in %.0f ms\n", vtNow() - start);
    }
    vtDestroyReference(reference);
    return result;
}

/// The colours of present.frag's analysisColor.
static void analysisColor(const vtReferenceImage* image, size_t pixel, uint8_t* rgb)
{
    static const uint8_t background[3] = {255, 255, 255}, lost[3] = {89, 89, 89},
                         reflected[3] = {26, 166, 51}, two[3] = {217, 31, 26}, more[3] = {26, 64, 217};
    const uint8_t* color = image->states[pixel] == VT_PATH_LOST ? lost
                           : image->events[pixel] == 0          ? background
                           : image->reflections[pixel]          ? reflected
                           : image->events[pixel] <= 2          ? two
                                                                : more;
    memcpy(rgb, color, 3);
}

static vtVec3 shownColor(const vtReferenceImage* image, const vtFrame* frame, size_t pixel)
{
    vtVec3 shown = vtMakeVec3(image->radiance + 3 * pixel);
    uint8_t color[3];
    if (frame->output == vt_outputAnalysis) {
        analysisColor(image, pixel, color);
        return (vtVec3){(float)color[0] / 255.0f, (float)color[1] / 255.0f, (float)color[2] / 255.0f};
    }
    if (frame->linear) {
        return shown;
    }
    shown = vtToneMap(frame->toneMapping, shown);
    return (vtVec3){vtLinearToSrgb(shown.x), vtLinearToSrgb(shown.y), vtLinearToSrgb(shown.z)};
}

/// The scene before what is behind it. Analysis shows no background.
static vtResult compose(const vtReferenceImage* image, const vtInput* input, const vtFrame* frame,
                        float* rgba, vtError* error)
{
    vtTracedBackground background;
    const vtResult result = vtMakeTracedBackground(input, frame, &background, error);
    for (int row = 0; row < image->height && result == vt_ok; ++row) {
        for (int column = 0; column < image->width; ++column) {
            const size_t pixel = (size_t)row * (size_t)image->width + (size_t)column;
            const float share = image->covered[pixel];
            const vtVec3 light = vtMakeVec3(image->radiance + 3 * pixel);
            vtTracedBackground_Show(&background, column, row,
                                    vtScale(light, share > 0.0f ? 1.0f / share : 0.0f), share,
                                    rgba + 4 * pixel);
        }
    }
    vtDestroyTracedBackground(&background);
    return result;
}

vtResult vtTraceFloats(const vtReferenceImage* image, const vtInput* input, const vtFrame* frame,
                       float** rgba, vtError* error)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    *rgba = malloc(4 * count * sizeof **rgba);
    if (*rgba == NULL) {
        return vtFail(error, vt_errorMemory, "picture: out of memory for %d x %d", image->width,
                      image->height);
    }
    if (image->covered != NULL && frame->output != vt_outputAnalysis) {
        return compose(image, input, frame, *rgba, error);
    }
    for (size_t i = 0; i < count; ++i) {
        const vtVec3 shown = shownColor(image, frame, i);
        memcpy(*rgba + 4 * i, &(const float[4]){shown.x, shown.y, shown.z, 1.0f}, 4 * sizeof(float));
    }
    return vtSucceed(error);
}

vtResult vtTracePixels(const vtReferenceImage* image, const vtInput* input, const vtFrame* frame,
                       uint8_t** pixels, vtError* error)
{
    const size_t count = 4 * (size_t)image->width * (size_t)image->height;
    vtFrame shown = *frame;
    shown.linear = false;
    float* rgba = NULL;
    *pixels = malloc(count);
    if (*pixels == NULL) {
        return vtFail(error, vt_errorMemory, "picture: out of memory for %d x %d", image->width,
                      image->height);
    }
    const vtResult result = vtTraceFloats(image, input, &shown, &rgba, error);
    for (size_t i = 0; i < count && result == vt_ok; ++i) {
        (*pixels)[i] = (uint8_t)(255.0f * vtClamp(rgba[i], 0.0f, 1.0f) + 0.5f);
    }
    free(rgba);
    return result;
}
