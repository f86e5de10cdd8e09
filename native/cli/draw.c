#include "cli/draw.h"

#include <stdlib.h>

#include "base/error.h"
#include "cli/trace.h"
#include "image/image.h"
#include "lab/metrics/timing.h"

/// One sample at a time, each finished before the next, each at its moment.
static vtResult drawSamples(const vtDrawing* drawing, vtRenderer* renderer, const vtFrame* frame,
                            float* floats, uint8_t* pixels, vtError* error)
{
    const double start = vtNow();
    const float shutter = drawing->options->shutter;
    vtResult result = vt_ok;
    vtFrame part = *frame;
    part.samples = 1;
    part.moving = drawing->motion != NULL && shutter > 0.0f;
    for (; part.firstSample < frame->samples && result == vt_ok; ++part.firstSample) {
        const bool last = part.firstSample == frame->samples - 1;
        if (part.moving) {
            const double moment = ((double)part.firstSample + 0.5) / (double)frame->samples;
            vtMotion_SetView(drawing->motion, drawing->number + (double)shutter * moment, &part);
        }
        result = floats != NULL ? vtRenderer_DrawFloats(renderer, &part, last ? floats : NULL, error)
                                : vtRenderer_DrawImage(renderer, &part, last ? pixels : NULL, error);
        if (drawing->showsProgress && frame->samples > 1) {
            vtShowProgress("drawing", (float)(part.firstSample + 1) / (float)frame->samples, start);
        }
    }
    return result;
}

static vtResult encode(const vtDrawing* drawing, const vtFrame* frame, const float* floats,
                       vtPicture* picture, vtError* error)
{
    return floats != NULL ? vtEncodePicture(floats, drawing->format, frame, drawing->comment, picture->pixels,
                                            &picture->bytes, &picture->size, error)
                          : vtEncodePngOf(picture->pixels, 4, 8, frame->width, frame->height,
                                          drawing->comment, &picture->bytes, &picture->size, error);
}

static vtResult render(const vtDrawing* drawing, vtRenderer* renderer, const vtFrame* frame,
                       vtPicture* picture, vtError* error)
{
    const size_t count = 4 * (size_t)frame->width * (size_t)frame->height;
    const bool takesFloats = drawing->format != vt_formatPng;
    float* floats = takesFloats ? malloc(count * sizeof *floats) : NULL;
    picture->pixels = malloc(count);
    vtResult result = vt_ok;
    if (picture->pixels == NULL || (takesFloats && floats == NULL)) {
        result = vtFail(error, vt_errorMemory, "picture: out of memory for %d x %d", frame->width,
                        frame->height);
    }
    if (result == vt_ok) {
        result = drawSamples(drawing, renderer, frame, floats, picture->pixels, error);
    }
    if (result == vt_ok) {
        result = encode(drawing, frame, floats, picture, error);
    }
    free(floats);
    return result;
}

static vtResult trace(const vtDrawing* drawing, const vtInput* input, const vtFrame* frame,
                      vtPicture* picture, vtError* error)
{
    float* floats = NULL;
    vtResult result = vtTrace(drawing->options, input, frame, drawing->showsProgress, &picture->traced, error);
    if (result == vt_ok) {
        result = vtTracePixels(&picture->traced, frame, &picture->pixels, error);
    }
    if (result == vt_ok && drawing->format != vt_formatPng) {
        result = vtTraceFloats(&picture->traced, frame, &floats, error);
    }
    if (result == vt_ok) {
        result = encode(drawing, frame, floats, picture, error);
    }
    free(floats);
    return result;
}

vtResult vtDrawPicture(const vtDrawing* drawing, const vtSession* session, const vtFrame* frame,
                       vtPicture* picture, vtError* error)
{
    vtDestroyPicture(picture);
    return session->renderer != NULL ? render(drawing, session->renderer, frame, picture, error)
                                     : trace(drawing, &session->input, frame, picture, error);
}

void vtDestroyPicture(vtPicture* picture)
{
    free(picture->pixels);
    vtFree(picture->bytes);
    vtDestroyReferenceImage(&picture->traced);
    *picture = (vtPicture){0};
}
