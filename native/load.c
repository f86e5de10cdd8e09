#include "load.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "files.h"
#include "scene/shapes.h"
#include "trace.h"

static vtResult loadModelFile(const char* path, vtModel* model, vtError* error)
{
    uint8_t* bytes;
    size_t size;
    vtResult result = vtReadFile(path, &bytes, &size, error);
    if (result != vt_ok) {
        return result;
    }
    char directory[4096] = "";
    const char* slash = strrchr(path, '/');
    if (slash != NULL && (size_t)(slash - path) + 1 < sizeof directory) {
        memcpy(directory, path, (size_t)(slash - path) + 1);
    }
    vtModelDef def = {
        .bytes = bytes, .size = size, .name = path, .directory = directory, .readFile = vtReadFileForModel};
    result = vtLoadModel(&def, model, error);
    free(bytes);
    return result;
}

static bool isShape(const char* name)
{
    int i = 0;
    while (vtShapeName(i) != NULL && strcmp(vtShapeName(i), name) != 0) {
        ++i;
    }
    return vtShapeName(i) != NULL;
}

static vtResult loadEnvironment(const char* name, vtEnvironment* environment, vtError* error)
{
    // Built-in names hold neither a dot nor a slash.
    if (strpbrk(name, "./") == NULL) {
        return vtCreateEnvironment(name, environment, error);
    }
    uint8_t* bytes;
    size_t size;
    vtResult result = vtReadFile(name, &bytes, &size, error);
    if (result == vt_ok) {
        result = vtLoadEnvironment(bytes, size, name, environment, error);
        free(bytes);
    }
    return result;
}

static void printNotes(const char* name, const vtMesh* mesh, bool verbose)
{
    if (mesh->openEdgeCount > 0) {
        fprintf(
            stderr,
            "vitrine: warning: '%s' is not closed (%u open edges); light that enters through a hole never "
            "finds its way out there\n",
            name, mesh->openEdgeCount);
    }
    if (mesh->normalsComputed) {
        fprintf(stderr, "vitrine: note: '%s' lacks normals; they are computed, smooth over its edges\n",
                name);
    }
    if (verbose) {
        fprintf(stderr, "vitrine: '%s': %u triangles, %u vertices, box %g %g %g to %g %g %g\n", name,
                mesh->indexCount / 3, mesh->vertexCount, (double)mesh->boundsMin.x, (double)mesh->boundsMin.y,
                (double)mesh->boundsMin.z, (double)mesh->boundsMax.x, (double)mesh->boundsMax.y,
                (double)mesh->boundsMax.z);
    }
}

vtResult vtLoadInput(const vtOptions* options, vtInput* input, vtError* error)
{
    *input = (vtInput){0};
    if (options->model == NULL) {
        return vtFail(error, vt_errorArgument,
                      "no model given; name a .glb or .gltf file or a built-in shape (see 'vitrine list')");
    }
    vtModel model = {0};
    vtResult result = options->triangles > 0 ? vtCreateFineShape(options->model, (uint32_t)options->triangles,
                                                                 &model.mesh, error)
                      : isShape(options->model) ? vtCreateShape(options->model, &model.mesh, error)
                                                : loadModelFile(options->model, &model, error);
    if (result == vt_ok) {
        result = loadEnvironment(options->environment, &input->environment, error);
    }
    if (result != vt_ok) {
        vtDestroyModel(&model);
        return result;
    }
    if (options->innerDistances || vtFindTechnique(options->technique) == vt_techniqueWyman) {
        result = vtComputeInnerDistances(&model.mesh, error);
        if (result != vt_ok) {
            vtDestroyModel(&model);
            vtDestroyEnvironment(&input->environment);
            return result;
        }
    }
    printNotes(options->model, &model.mesh, options->verbose);
    input->mesh = model.mesh;
    input->ior = options->ior > 0.0f ? options->ior : model.ior > 0.0f ? model.ior : vtDefaultFrame().ior;
    return vtSucceed(error);
}

void vtDestroyInput(vtInput* input)
{
    vtDestroyMesh(&input->mesh);
    vtDestroyEnvironment(&input->environment);
}

vtResult vtMakeFrame(const vtOptions* options, const vtInput* input, vtFrame* frame, vtError* error)
{
    *frame = vtDefaultFrame();
    bool isReference = vtIsReference(options);
    frame->technique = isReference ? frame->technique : vtFindTechnique(options->technique);
    if (frame->technique == vt_techniqueCount) {
        return vtFail(error, vt_errorArgument, "technique '%s' is unknown; see 'vitrine list'",
                      options->technique);
    }
    frame->output = options->analysis ? vt_outputAnalysis : vt_outputPicture;
    frame->width = options->size[0];
    frame->height = options->size[1];
    frame->ior = input->ior;
    frame->layers = options->layers;
    frame->steps = options->steps;
    frame->refine = options->refine;
    frame->maxEvents = options->maxEvents;
    frame->layerSize = options->layerSize;
    frame->cubeSize = options->cubeSize;
    frame->topLevel = options->topLevel;
    bool fromEye = strcmp(options->layerSource, "eye") == 0;
    if (!fromEye && strcmp(options->layerSource, "cube") != 0) {
        return vtFail(error, vt_errorArgument, "--layer-source is '%s'; it must be cube or eye",
                      options->layerSource);
    }
    int preset = 0;
    while (preset < vt_presetCount && strcmp(options->preset, vtPresetName(preset)) != 0) {
        ++preset;
    }
    if (preset == vt_presetCount) {
        return vtFail(error, vt_errorArgument, "--preset is '%s'; it must be low, medium or high",
                      options->preset);
    }
    frame->preset = (vtPreset)preset;
    frame->layerSource = fromEye ? vt_layersFromEye : vt_layersFromCube;
    frame->exposure = options->exposure;
    frame->samples = isReference ? 1 : options->samples; // the reference takes more
    frame->transmittance = options->transmittance;
    frame->maxTransmittance = options->maxTransmittance;
    frame->minTransmittance = options->minTransmittance;
    frame->power = options->power;
    frame->wallThickness = options->wallThickness;
    bool farthest = strcmp(options->backSurface, "farthest") == 0;
    if (!farthest && strcmp(options->backSurface, "second") != 0) {
        return vtFail(error, vt_errorArgument, "--back-surface is '%s'; it must be second or farthest",
                      options->backSurface);
    }
    frame->backSurface = farthest ? vt_backFarthest : vt_backSecond;

    vtView framed = vtFrameMesh(&input->mesh, options->fov, (float)frame->width / (float)frame->height);
    vtVec3 target = options->hasTarget ? options->target : framed.target;
    vtVec3 offset = vtSub(framed.eye, framed.target);
    vtVec3 eye = options->hasCamera ? options->camera : vtAdd(target, offset);
    frame->view = (vtView){eye, target, options->fov};
    return vtValidateFrame(frame, error);
}
