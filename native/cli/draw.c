#include "cli/draw.h"

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "cli/trace.h"
#include "image/image.h"
#include "lab/metrics/timing.h"

/// Moves scene and eye to a frame; between two frames, too.
static vtResult moveTo(const vtDrawing* drawing, vtSession* session, double number, vtFrame* frame,
                       vtError* error)
{
    const vtOptions* options = drawing->options;
    const double seconds = fmax((double)options->time, 0.0) + number / (double)options->fps;
    vtResult result = vt_ok;
    if (session->input.motion.count > 0) {
        result = vtSession_SetTime(session, options, seconds, error);
    }
    if (result == vt_ok && session->input.motion.count > 0 &&
        options->cameraOfFile != NULL) { // it may move, too
        vtFrame seen;
        result = vtMakeFrame(options, &session->input, &seen, error);
        frame->view = seen.view;
        frame->orthographicHeight = seen.orthographicHeight;
    }
    vtCameraPath_SetView(drawing->eye, number, frame);
    return result;
}

/// One sample at a time, each finished before the next, each at its moment while the shutter is open.
static vtResult drawSamples(const vtDrawing* drawing, vtSession* session, const vtFrame* frame, float* floats,
                            uint8_t* pixels, vtError* error)
{
    const double start = vtNow(), shutter = (double)drawing->options->shutter;
    vtResult result = vt_ok;
    vtFrame part = *frame;
    part.samples = 1;
    part.moving = drawing->eye != NULL && shutter > 0.0;
    for (; part.firstSample < frame->samples && result == vt_ok; ++part.firstSample) {
        const bool last = part.firstSample == frame->samples - 1;
        if (part.moving) {
            const double moment = ((double)part.firstSample + 0.5) / (double)frame->samples;
            result = moveTo(drawing, session, (double)drawing->number + shutter * moment, &part, error);
        }
        if (result == vt_ok) {
            result = floats != NULL
                         ? vtRenderer_DrawFloats(session->renderer, &part, last ? floats : NULL, error)
                         : vtRenderer_DrawImage(session->renderer, &part, last ? pixels : NULL, error);
        }
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

static vtResult render(const vtDrawing* drawing, vtSession* session, const vtFrame* frame, vtPicture* picture,
                       vtError* error)
{
    const size_t count = 4 * (size_t)frame->width * (size_t)frame->height;
    const bool takesFloats = drawing->format != vt_formatPng;
    float* floats = takesFloats ? malloc(count * sizeof *floats) : NULL;
    picture->pixels = malloc(count);
    vtResult result = vt_ok;
    if (picture->pixels == NULL || (takesFloats && floats == NULL)) {
        result =
            vtFail(error, vt_errorMemory, "picture: out of memory for %d x %d", frame->width, frame->height);
    }
    if (result == vt_ok) {
        result = drawSamples(drawing, session, frame, floats, picture->pixels, error);
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
    vtResult result =
        vtTrace(drawing->options, input, frame, drawing->showsProgress, &picture->traced, error);
    if (result == vt_ok && drawing->format == vt_formatPng) {
        result = vtTracePixels(&picture->traced, input, frame, &picture->pixels, error);
    } else if (result == vt_ok) { // encode gives the pixels, too
        picture->pixels = malloc(4 * (size_t)frame->width * (size_t)frame->height);
        result = picture->pixels != NULL ? vtTraceFloats(&picture->traced, input, frame, &floats, error)
                                         : vtFail(error, vt_errorMemory, "picture: out of memory for %d x %d",
                                                  frame->width, frame->height);
    }
    if (result == vt_ok) {
        result = encode(drawing, frame, floats, picture, error);
    }
    free(floats);
    return result;
}

vtResult vtDrawPicture(const vtDrawing* drawing, vtSession* session, vtFrame* frame, vtPicture* picture,
                       vtError* error)
{
    vtDestroyPicture(picture);
    if (drawing->eye != NULL) {
        const vtResult result = moveTo(drawing, session, (double)drawing->number, frame, error);
        if (result != vt_ok) {
            return result;
        }
    }
    return session->renderer != NULL ? render(drawing, session, frame, picture, error)
                                     : trace(drawing, &session->input, frame, picture, error);
}

void vtDestroyPicture(vtPicture* picture)
{
    free(picture->pixels);
    vtFree(picture->bytes);
    vtDestroyReferenceImage(&picture->traced);
    *picture = (vtPicture){0};
}
