#include "cli/trace.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "image/image.h"
#include "lab/metrics/timing.h"

bool vtIsReference(const vtOptions* options)
{
    return strcmp(options->technique, "reference") == 0;
}

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
    vtReferenceDef def = {
        .frame = frame,
        .environment = &input->environment,
        .samples = options->samples,
        .fresnel = frame->fresnel,
        .ground = options->ground.isThere ? &input->ground : NULL,
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

vtResult vtTracePixels(const vtReferenceImage* image, const vtFrame* frame, uint8_t** pixels, vtError* error)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    *pixels = malloc(4 * count);
    if (*pixels == NULL) {
        return vtFail(error, vt_errorMemory, "picture: out of memory for %d x %d", image->width,
                      image->height);
    }
    vtReference_ToSrgb(image, *pixels);
    for (size_t i = 0; i < count && frame->toneMapping != vt_toneMappingNone; ++i) {
        const vtVec3 light = vtToneMap(frame->toneMapping, vtMakeVec3(image->radiance + 3 * i));
        const float shown[3] = {light.x, light.y, light.z};
        for (size_t k = 0; k < 3; ++k) {
            (*pixels)[4 * i + k] = (uint8_t)(255.0f * vtLinearToSrgb(shown[k]) + 0.5f);
        }
    }
    for (size_t i = 0; i < count && frame->output == vt_outputAnalysis; ++i) {
        analysisColor(image, i, *pixels + 4 * i);
    }
    return vtSucceed(error);
}

vtResult vtTraceFloats(const vtReferenceImage* image, const vtFrame* frame, float** rgba, vtError* error)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    *rgba = malloc(4 * count * sizeof **rgba);
    if (*rgba == NULL) {
        return vtFail(error, vt_errorMemory, "picture: out of memory for %d x %d", image->width,
                      image->height);
    }
    for (size_t i = 0; i < count; ++i) {
        vtVec3 shown = vtMakeVec3(image->radiance + 3 * i);
        uint8_t color[3];
        if (frame->output == vt_outputAnalysis) {
            analysisColor(image, i, color);
            shown = (vtVec3){(float)color[0] / 255.0f, (float)color[1] / 255.0f, (float)color[2] / 255.0f};
        } else if (!frame->linear) {
            shown = vtToneMap(frame->toneMapping, shown);
            shown = (vtVec3){vtLinearToSrgb(shown.x), vtLinearToSrgb(shown.y), vtLinearToSrgb(shown.z)};
        }
        memcpy(*rgba + 4 * i, &(const float[4]){shown.x, shown.y, shown.z, 1.0f}, 4 * sizeof(float));
    }
    return vtSucceed(error);
}
