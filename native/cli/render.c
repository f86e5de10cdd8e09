#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/draw.h"
#include "cli/files.h"
#include "cli/series.h"
#include "cli/trace.h"
#include "image/image.h"
#include "image/pfm.h"
#include "lab/metrics/metrics_image.h"
#include "lab/metrics/metrics_map.h"
#include "technique/technique.h"

/// A file to be written once everything has been drawn.
typedef struct Output {
    const char* path;
    uint8_t* bytes;
    size_t size;
} Output;

enum { outputDirections, outputSheet, outputEvents, outputCount };

/// `fresnel`: with Fresnel reflection, where the frame has it.
static vtResult readDirections(vtRenderer* renderer, const vtFrame* frame, bool fresnel, Output* output,
                               vtError* error)
{
    float* directions = malloc(3 * sizeof(float) * (size_t)frame->width * (size_t)frame->height);
    if (directions == NULL) {
        return vtFail(error, vt_errorMemory, "directions: out of memory for %d x %d", frame->width,
                      frame->height);
    }
    // Those of the pixel's centre, as the reference has them.
    vtFrame centre = *frame;
    centre.samples = 1;
    centre.fresnel = frame->fresnel && fresnel;
    const bool drawn = frame->samples == 1 && centre.fresnel == frame->fresnel;
    vtResult result = !drawn ? vtRenderer_DrawImage(renderer, &centre, NULL, error) : vt_ok;
    if (result == vt_ok) {
        result = vtRenderer_ReadDirections(renderer, directions, error);
    }
    if (result == vt_ok) {
        result = vtEncodePfm(directions, frame->width, frame->height, &output->bytes, &output->size, error);
    }
    free(directions);
    return result;
}

/// Depths in the upper row, normals in the lower, layer one on the left; each at the layers' own size.
static vtResult drawLayerSheet(vtRenderer* renderer, const vtFrame* frame, Output* output, vtError* error)
{
    const int layers = vtFrame_LayerCount(frame);
    if (layers == 0) {
        return vtFail(error, vt_errorArgument, "layer sheet: technique '%s' peels no layers",
                      vtTechnique_Info(frame->technique)->id);
    }
    vtRendererInfo info = vtRenderer_Info(renderer);
    vtFrame tile = *frame;
    tile.layerSize = info.layerWidth > info.layerHeight ? info.layerWidth : info.layerHeight;
    tile.width = info.layerWidth;
    tile.height = info.layerHeight;
    const size_t tileRow = 4 * (size_t)tile.width, sheetRow = tileRow * (size_t)layers;
    uint8_t* pixels = malloc(tileRow * (size_t)tile.height);
    uint8_t* sheet = malloc(2 * sheetRow * (size_t)tile.height);
    vtResult result = vt_ok;
    if (pixels == NULL || sheet == NULL) {
        result = vtFail(error, vt_errorMemory, "layer sheet: out of memory for %d layers", layers);
    }
    for (int i = 0; i < 2 * layers && result == vt_ok; ++i) {
        tile.layer = i % layers;
        bool isDepth = i < layers;
        tile.output = isDepth ? vt_outputLayerDepth : vt_outputLayerNormal;
        result = vtRenderer_DrawImage(renderer, &tile, pixels, error);
        uint8_t* corner =
            sheet + (isDepth ? 0 : sheetRow * (size_t)tile.height) + tileRow * (size_t)tile.layer;
        for (int row = 0; row < tile.height; ++row) {
            memcpy(corner + sheetRow * (size_t)row, pixels + tileRow * (size_t)row, tileRow);
        }
    }
    if (result == vt_ok) {
        result =
            vtEncodePng(sheet, 4, tile.width * layers, 2 * tile.height, &output->bytes, &output->size, error);
    }
    free(pixels);
    free(sheet);
    return result;
}

static void sayLayers(const vtFrame* frame, const vtRendererInfo* info)
{
    const int layers = vtFrame_LayerCount(frame);
    if (layers > 0) {
        fprintf(stderr, "vitrine: %d layers of %d x %d\n", layers, info->layerWidth, info->layerHeight);
    } else if (vtTechnique_Row(frame->technique)->traces) {
        fprintf(stderr, "vitrine: hierarchies and vertices take %.1f MB, targets and pictures %.1f MB\n",
                (double)info->meshBytes / 1e6, (double)info->textureBytes / 1e6);
    }
}

static void sayRenderer(const vtSession* session, const vtFrame* frame)
{
    const float ior = vtCommonIor(&session->input); // 0: there are several
    const vtRendererInfo info = vtRenderer_Info(session->renderer);
    fprintf(stderr, "vitrine: %s, %s\n", info.device, info.version);
    if (ior > 0.0f) {
        fprintf(stderr, "vitrine: ior %g\n", (double)ior);
    }
    fprintf(stderr, "vitrine: %.1f MB of textures, %.1f MB of mesh\n", (double)info.textureBytes / 1e6,
            (double)info.meshBytes / 1e6);
    sayLayers(frame, &info);
}

/// What else the renderer gives of the frame that was drawn.
static vtResult readDrawn(const vtOptions* options, const vtFrame* frame, const vtSession* session,
                          Output* outputs, vtError* error)
{
    vtRenderer* renderer = session->renderer;
    vtResult result = vt_ok;
    if (options->verbose) {
        sayRenderer(session, frame);
    }
    if (options->directions != NULL) {
        result = readDirections(renderer, frame, options->fresnelGiven, &outputs[outputDirections], error);
    }
    if (result == vt_ok && options->layerSheet != NULL) {
        result = drawLayerSheet(renderer, frame, &outputs[outputSheet], error);
    }
    return result;
}

/// What else the reference gives.
static vtResult readTraced(const vtOptions* options, const vtReferenceImage* image, Output* outputs,
                           vtError* error)
{
    Output *directions = &outputs[outputDirections], *events = &outputs[outputEvents];
    vtResult result = vt_ok;
    if (options->directions != NULL) {
        result = vtEncodePfm(image->directions, image->width, image->height, &directions->bytes,
                             &directions->size, error);
    }
    if (result == vt_ok && options->events != NULL) {
        result =
            vtEncodePng(image->events, 1, image->width, image->height, &events->bytes, &events->size, error);
    }
    return result;
}

/// What cannot be had of the technique.
static vtResult checkOutputs(const vtOptions* options, vtError* error)
{
    if (vtIsReference(options) && options->layerSheet != NULL) {
        return vtFail(error, vt_errorArgument, "layer sheet: technique 'reference' peels no layers");
    }
    if (!vtIsReference(options) && options->events != NULL) {
        return vtFail(error, vt_errorArgument,
                      "--events comes from the reference; add --technique reference");
    }
    return vt_ok;
}

static vtResult drawAll(const vtOptions* options, vtFrame* frame, vtPicture* picture, Output* outputs,
                        vtError* error)
{
    vtSession session = {0};
    vtDrawing drawing = {.options = options, .showsProgress = isatty(STDERR_FILENO)};
    vtResult result = checkOutputs(options, error);
    if (result == vt_ok) {
        result = vtChoosePictureFormat(options, &drawing.format, error);
    }
    if (result == vt_ok) {
        result = vtOpenSession(options, &session, error);
    }
    if (result == vt_ok) {
        result = vtMakeFrame(options, &session.input, frame, error);
        frame->linear = vtPictureFormat_IsLinear(drawing.format);
    }
    if (result == vt_ok) {
        result = vtDrawPicture(&drawing, &session, frame, picture, error);
    }
    if (result == vt_ok) {
        result = session.renderer != NULL ? readDrawn(options, frame, &session, outputs, error)
                                          : readTraced(options, &picture->traced, outputs, error);
    }
    vtCloseSession(&session);
    return result;
}

/// Mean FLIP between the picture just made and the file named by --reference; above the threshold the
/// difference is written beside the output.
static vtResult compareWithReference(const vtOptions* options, const vtFrame* frame, const uint8_t* pixels,
                                     vtError* error)
{
    uint8_t *bytes, *encoded = NULL;
    size_t size, pixelCount = (size_t)frame->width * (size_t)frame->height;
    float *wanted, *map = NULL;
    int width, height;
    vtResult result = vtReadInput(options->reference, &options->limits, &bytes, &size, error);
    if (result != vt_ok) {
        return result;
    }
    result =
        vtCheckPicture(bytes, size, options->reference, &options->limits, 3 * sizeof *wanted, NULL, error);
    if (result == vt_ok) {
        result = vtDecodeImageLinear(bytes, size, options->reference, &wanted, &width, &height, error);
    }
    vtFree(bytes);
    if (result != vt_ok) {
        return result;
    }
    float* drawn = malloc(3 * pixelCount * sizeof *drawn);
    map = malloc(pixelCount * sizeof *map);
    uint8_t* colors = malloc(3 * pixelCount);
    vtPictureError difference;
    if (width != frame->width || height != frame->height) {
        result = vtFail(error, vt_errorArgument,
                        "reference '%s' is %d x %d, the picture %d x %d; set --resolution",
                        options->reference, width, height, frame->width, frame->height);
    } else if (drawn == NULL || map == NULL || colors == NULL) {
        result = vtFail(error, vt_errorMemory, "reference: out of memory for %d x %d", width, height);
    } else {
        for (size_t i = 0; i < 3 * pixelCount; ++i) {
            drawn[i] = vtSrgbToLinear((float)pixels[i / 3 * 4 + i % 3] / 255.0f);
        }
        result = vtComparePictures(drawn, wanted, width, height, &difference, map, error);
    }
    if (result == vt_ok && difference.flip > (double)options->referenceThreshold) {
        char path[4096];
        snprintf(path, sizeof path, "%s.difference.png",
                 options->output != NULL && strcmp(options->output, "-") != 0 ? options->output : "vitrine");
        vtDrawFlip(map, pixelCount, colors);
        result = vtEncodePng(colors, 3, width, height, &encoded, &size, error);
        if (result == vt_ok) {
            result = vtWriteFile(path, encoded, size, error);
        }
        if (result == vt_ok) {
            result = vtFail(
                error, vt_errorArgument,
                "the picture differs from '%s': mean FLIP %.4f is above --reference-threshold %g; see '%s'",
                options->reference, difference.flip, (double)options->referenceThreshold, path);
        }
    }
    vtFree(encoded);
    free(colors);
    free(map);
    free(drawn);
    vtFree(wanted);
    return result;
}

static vtResult renderOne(const vtOptions* options, vtError* error)
{
    Output outputs[outputCount] = {
        [outputDirections] = {.path = options->directions},
        [outputSheet] = {.path = options->layerSheet},
        [outputEvents] = {.path = options->events},
    };
    vtFrame frame;
    vtPicture picture = {0};
    vtResult result = drawAll(options, &frame, &picture, outputs, error);
    if (result == vt_ok && options->output != NULL) {
        result = vtWriteFile(options->output, picture.bytes, picture.size, error);
    }
    for (int i = 0; i < outputCount && result == vt_ok; ++i) {
        if (outputs[i].path != NULL) {
            result = vtWriteFile(outputs[i].path, outputs[i].bytes, outputs[i].size, error);
        }
    }
    if (result == vt_ok && options->reference != NULL) {
        result = compareWithReference(options, &frame, picture.pixels, error);
    }
    for (int i = 0; i < outputCount; ++i) {
        vtFree(outputs[i].bytes);
    }
    vtDestroyPicture(&picture);
    return result;
}

vtResult vtRunRender(const vtOptions* options, vtError* error)
{
    if (vtIsSeries(options)) {
        return vtRunSeries(options, error);
    }
    const char* moves = options->shutter > 0.0f ? "--shutter" : options->part != NULL ? "--part" : NULL;
    if (moves != NULL) {
        return vtFail(
            error, vt_errorArgument,
            "%s is of many pictures, and one is asked for; add --turntable N, --camera-keys FILE or "
            "more models",
            moves);
    }
    if (options->output == NULL && options->directions == NULL && options->layerSheet == NULL &&
        options->reference == NULL && options->events == NULL) {
        return vtFail(error, vt_errorArgument, "no output given; add -o PICTURE.png");
    }
    if (options->output != NULL && strcmp(options->output, "-") == 0 && isatty(STDOUT_FILENO)) {
        return vtFail(error, vt_errorArgument, "-o - writes PNG bytes; send them to a file or a pipe");
    }
    return renderOne(options, error);
}
