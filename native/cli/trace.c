#include "cli/trace.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "lab/metrics/timing.h"

bool vtIsReference(const vtOptions* options)
{
    return strcmp(options->technique, "reference") == 0;
}

static void showProgress(float share, void* userData)
{
    vtShowProgress("tracing", share, *(const double*)userData);
}

vtResult vtTrace(const vtOptions* options, const vtInput* input, const vtFrame* frame,
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
        .progress = isatty(STDERR_FILENO) ? showProgress : NULL,
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
    for (size_t i = 0; i < count && frame->output == vt_outputAnalysis; ++i) {
        analysisColor(image, i, *pixels + 4 * i);
    }
    return vtSucceed(error);
}
