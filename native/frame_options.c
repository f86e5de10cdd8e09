// From the command line's settings to a frame.
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "load.h"
#include "relief_input.h"
#include "trace.h"

/// The eye that the options ask for, else the file's camera, else one that shows the whole scene.
static vtResult chooseView(const vtOptions* options, const vtScene* scene, float aspect, vtView* view,
                           vtError* error)
{
    const int index = options->cameraIndex;
    if (index >= 0 && (uint32_t)index >= scene->cameraCount) {
        return vtFail(error, vt_errorArgument,
                      scene->cameraCount == 0
                          ? "--camera-index is %d, but there are %u cameras in what is drawn; leave it out"
                          : "--camera-index is %d, but there are %u cameras in what is drawn; the first is 0",
                      index, scene->cameraCount);
    }
    if (index >= 0) {
        *view = scene->cameras[index];
        view->fovY = options->hasFov ? options->fov : view->fovY;
        view->eye = options->hasCamera ? options->camera : view->eye;
        view->target = options->hasTarget ? options->target : view->target;
        return vt_ok;
    }
    const vtView framed = vtFrameScene(scene, options->fov, aspect);
    const vtVec3 target = options->hasTarget ? options->target : framed.target;
    const vtVec3 offset = vtSub(framed.eye, framed.target);
    const vtVec3 eye = options->hasCamera ? options->camera : vtAdd(target, offset);
    *view = (vtView){eye, target, options->fov};
    return vt_ok;
}

vtResult vtMakeFrame(const vtOptions* options, const vtInput* input, vtFrame* frame, vtError* error)
{
    *frame = vtDefaultFrame();
    bool isReference = vtIsReference(options);
    const char* technique = vtChooseTechnique(options, &input->scene);
    frame->technique = isReference ? frame->technique : vtFindTechnique(technique);
    if (frame->technique == vt_techniqueCount) {
        return vtFail(error, vt_errorArgument, "technique '%s' is unknown; see 'vitrine list'",
                      options->technique);
    }
    frame->output = options->analysis ? vt_outputAnalysis : vt_outputPicture;
    frame->width = options->size[0];
    frame->height = options->size[1];
    frame->ior = input->ior;
    frame->fresnel = options->fresnel;
    frame->branches = options->branches;
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

    bool ordered = strcmp(options->multi, "ordered") == 0;
    if (!ordered && strcmp(options->multi, "any") != 0) {
        return vtFail(error, vt_errorArgument, "--multi is '%s'; it must be any or ordered", options->multi);
    }
    frame->multi = ordered ? vt_multiOrdered : vt_multiAny;
    bool cells = strcmp(options->search, "cells") == 0;
    if (!cells && strcmp(options->search, "steps") != 0) {
        return vtFail(error, vt_errorArgument, "--search is '%s'; it must be steps or cells",
                      options->search);
    }
    frame->search = cells ? vt_searchCells : vt_searchSteps;
    const float aspect = (float)frame->width / (float)frame->height;
    const vtResult result = chooseView(options, &input->scene, aspect, &frame->view, error);
    return result == vt_ok ? vtValidateFrame(frame, error) : result;
}
