#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "base/image.h"
#include "commands.h"
#include "context.h"
#include "files.h"
#include "load.h"
#include "technique.h"

/// A file to be written once everything has been drawn.
typedef struct Output {
    const char* path;
    uint8_t* bytes;
    size_t size;
} Output;

static vtResult drawPicture(vtRenderer* renderer, const vtFrame* frame, Output* output, vtError* error)
{
    uint8_t* pixels = malloc(4 * (size_t)frame->width * (size_t)frame->height);
    if (pixels == NULL) {
        return vtFail(error, vt_errorMemory, "picture: out of memory for %d x %d", frame->width,
                      frame->height);
    }
    vtResult result = vtRenderer_DrawImage(renderer, frame, pixels, error);
    if (result == vt_ok) {
        result = vtEncodePng(pixels, 4, frame->width, frame->height, &output->bytes, &output->size, error);
    }
    free(pixels);
    return result;
}

static vtResult readDirections(vtRenderer* renderer, const vtFrame* frame, Output* output, vtError* error)
{
    float* directions = malloc(3 * sizeof(float) * (size_t)frame->width * (size_t)frame->height);
    if (directions == NULL) {
        return vtFail(error, vt_errorMemory, "directions: out of memory for %d x %d", frame->width,
                      frame->height);
    }
    vtResult result = vtRenderer_ReadDirections(renderer, directions, error);
    if (result == vt_ok) {
        result = vtEncodePfm(directions, frame->width, frame->height, &output->bytes, &output->size, error);
    }
    free(directions);
    return result;
}

/// Depths in the upper row, normals in the lower, layer one on the left; each at the layers' own size.
static vtResult drawLayerSheet(vtRenderer* renderer, const vtFrame* frame, Output* output, vtError* error)
{
    vtRendererInfo info = vtRenderer_Info(renderer);
    const int layers = vtFrame_LayerCount(frame);
    if (layers == 0) {
        return vtFail(error, vt_errorArgument, "layer sheet: technique '%s' peels no layers",
                      vtTechnique_Info(frame->technique)->id);
    }
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

static vtResult drawAll(const vtOptions* options, const vtInput* input, vtRenderer* renderer,
                        Output outputs[3], vtError* error)
{
    vtFrame frame;
    vtResult result = vtMakeFrame(options, input, &frame, error);
    if (result == vt_ok) {
        result = vtRenderer_SetMesh(renderer, &input->mesh, error);
    }
    if (result == vt_ok) {
        result = vtRenderer_SetEnvironment(renderer, &input->environment, error);
    }
    if (result == vt_ok) {
        result = drawPicture(renderer, &frame, &outputs[0], error);
    }
    if (result == vt_ok && options->verbose) {
        vtRendererInfo info = vtRenderer_Info(renderer);
        fprintf(stderr, "vitrine: %s, %s\n", info.device, info.version);
        fprintf(stderr, "vitrine: ior %g, %d layers of %d x %d, %.1f MB of textures, %.1f MB of mesh\n",
                (double)frame.ior, vtFrame_LayerCount(&frame), info.layerWidth, info.layerHeight,
                (double)info.textureBytes / 1e6, (double)info.meshBytes / 1e6);
    }
    if (result == vt_ok && options->directions != NULL) {
        outputs[1].path = options->directions;
        result = readDirections(renderer, &frame, &outputs[1], error);
    }
    if (result == vt_ok && options->layerSheet != NULL) {
        outputs[2].path = options->layerSheet;
        result = drawLayerSheet(renderer, &frame, &outputs[2], error);
    }
    return result;
}

static vtResult renderInContext(const vtOptions* options, const vtInput* input, Output outputs[3],
                                vtError* error)
{
    static const struct {
        const char* name;
        vtBackend backend;
    } backends[] = {{"auto", vt_backendAuto}, {"osmesa", vt_backendOSMesa}, {"egl", vt_backendEgl}};
    int chosen = 0;
    while (chosen < 3 && strcmp(backends[chosen].name, options->backend) != 0) {
        ++chosen;
    }
    if (chosen == 3) {
        return vtFail(error, vt_errorArgument, "--rendering-backend is '%s'; it must be auto, osmesa or egl",
                      options->backend);
    }
    vtContext context;
    vtResult result = vtCreateContext(backends[chosen].backend, &context, error);
    if (result != vt_ok) {
        return result;
    }
    vtRenderer* renderer = NULL;
    result = vtCreateRenderer(&(vtRendererDef){context.getProcAddress}, &renderer, error);
    if (result == vt_ok) {
        result = drawAll(options, input, renderer, outputs, error);
    }
    vtDestroyRenderer(renderer);
    vtDestroyContext(&context);
    return result;
}

vtResult vtRunRender(const vtOptions* options, vtError* error)
{
    if (options->output == NULL && options->directions == NULL && options->layerSheet == NULL) {
        return vtFail(error, vt_errorArgument, "no output given; add -o PICTURE.png");
    }
    if (options->output != NULL && strcmp(options->output, "-") == 0 && isatty(STDOUT_FILENO)) {
        return vtFail(error, vt_errorArgument, "-o - writes PNG bytes; send them to a file or a pipe");
    }
    vtInput input;
    vtResult result = vtLoadInput(options, &input, error);
    if (result != vt_ok) {
        return result;
    }
    Output outputs[3] = {{.path = options->output}};
    result = renderInContext(options, &input, outputs, error);
    for (int i = 0; i < 3 && result == vt_ok; ++i) {
        if (outputs[i].path != NULL) {
            result = vtWriteFile(outputs[i].path, outputs[i].bytes, outputs[i].size, error);
        }
    }
    for (int i = 0; i < 3; ++i) {
        free(outputs[i].bytes);
    }
    vtDestroyInput(&input);
    return result;
}
