#include "cli/picture_output.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/error.h"
#include "base/math.h"
#include "cli/video.h"
#include "image/image.h"

static bool endsWith(const char* text, const char* end)
{
    const size_t length = strlen(text), endLength = strlen(end);
    return length >= endLength && strcasecmp(text + length - endLength, end) == 0;
}

vtResult vtChoosePictureFormat(const vtOptions* options, vtPictureFormat* format, vtError* error)
{
    const char* name = options->output != NULL ? options->output : "";
    *format = endsWith(name, ".exr")   ? vt_formatExr
              : endsWith(name, ".hdr") ? vt_formatHdr
              : options->bits == 16    ? vt_formatPng16
                                       : vt_formatPng;
    if (options->bits != 0 && options->bits != 8 && options->bits != 16) {
        return vtFail(error, vt_errorArgument, "--bits is %d; a PNG has 8 or 16", options->bits);
    }
    if (vtPictureFormat_IsLinear(*format) && options->bits != 0) {
        return vtFail(error, vt_errorArgument, "--bits is of a PNG; '%.200s' holds floats, so leave it out",
                      name);
    }
    if (vtPictureFormat_IsLinear(*format) && options->analysis) {
        return vtFail(error, vt_errorArgument, "--analysis gives colours, not light; '%.200s' must be a PNG",
                      name);
    }
    const char* slash = strrchr(name, '/');
    const char* dot = strrchr(slash != NULL ? slash : name, '.');
    if (dot != NULL && !vtPictureFormat_IsLinear(*format) && !endsWith(name, ".png") && !vtIsVideo(name)) {
        fprintf(stderr, "vitrine: note: '%s' is written as PNG; .exr and .hdr are the other kinds\n", name);
    }
    return vt_ok;
}

static float cut(float value, float most)
{
    return value > 0.0f ? fminf(value, most) : 0.0f; // NaN fails the comparison
}

static void toBytes(const float* rgba, bool isLinear, size_t count, uint8_t* pixels)
{
    for (size_t i = 0; i < 4 * count; ++i) {
        const float value = isLinear && i % 4 != 3 ? vtLinearToSrgb(cut(rgba[i], 1.0f)) : rgba[i];
        pixels[i] = (uint8_t)(255.0f * cut(value, 1.0f) + 0.5f);
    }
}

static vtResult encodePng16(const float* rgba, const vtFrame* frame, const char* comment, uint8_t** bytes,
                            size_t* size, vtError* error)
{
    const size_t count = 4 * (size_t)frame->width * (size_t)frame->height;
    uint16_t* samples = malloc(count * sizeof *samples);
    if (samples == NULL) {
        return vtFail(error, vt_errorMemory, "picture: out of memory for %d x %d", frame->width,
                      frame->height);
    }
    for (size_t i = 0; i < count; ++i) {
        samples[i] = (uint16_t)(65535.0f * cut(rgba[i], 1.0f) + 0.5f);
    }
    const vtResult result =
        vtEncodePngOf(samples, 4, 16, frame->width, frame->height, comment, bytes, size, error);
    free(samples);
    return result;
}

/// Linear light times alpha, which OpenEXR has beside it and HDR has not.
static vtResult encodeLight(const float* rgba, vtPictureFormat format, const vtFrame* frame,
                            const char* comment, uint8_t** bytes, size_t* size, vtError* error)
{
    const bool isExr = format == vt_formatExr;
    const size_t count = (size_t)frame->width * (size_t)frame->height;
    const size_t channels = isExr && frame->background == vt_backgroundTransparent ? 4 : 3;
    float* light = malloc(count * channels * sizeof *light);
    if (light == NULL) {
        return vtFail(error, vt_errorMemory, "picture: out of memory for %d x %d", frame->width,
                      frame->height);
    }
    for (size_t i = 0; i < count; ++i) {
        const float alpha = rgba[4 * i + 3];
        for (size_t k = 0; k < channels; ++k) {
            light[channels * i + k] = k == 3 ? alpha : alpha * rgba[4 * i + k];
        }
    }
    const vtResult result =
        isExr ? vtEncodeExr(light, (int)channels, frame->width, frame->height, comment, bytes, size, error)
              : vtEncodeHdr(light, frame->width, frame->height, comment, bytes, size, error);
    free(light);
    return result;
}

vtResult vtEncodePicture(const float* rgba, vtPictureFormat format, const vtFrame* frame, const char* comment,
                         uint8_t* pixels, uint8_t** bytes, size_t* size, vtError* error)
{
    const bool isLinear = vtPictureFormat_IsLinear(format);
    toBytes(rgba, isLinear, (size_t)frame->width * (size_t)frame->height, pixels);
    return isLinear ? encodeLight(rgba, format, frame, comment, bytes, size, error)
                    : encodePng16(rgba, frame, comment, bytes, size, error);
}
