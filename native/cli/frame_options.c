// From the command line's settings to a frame.
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "cli/load.h"
#include "cli/relief_input.h"
#include "cli/trace.h"

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

/// The place of an option's word among those it may be, NULL-terminated; goes on only where *result is vt_ok.
static int chooseWord(const char* option, const char* given, const char* const* words, vtResult* result,
                      vtError* error)
{
    int chosen = 0;
    char list[96] = "";
    while (words[chosen] != NULL && strcmp(words[chosen], given) != 0) {
        const char* before = chosen == 0 ? "" : words[chosen + 1] != NULL ? ", " : " or ";
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", before, words[chosen++]);
    }
    if (*result == vt_ok && words[chosen] == NULL) {
        *result = vtFail(error, vt_errorArgument, "--%s is '%s'; it must be %s", option, given, list);
    }
    return chosen;
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
    frame->exposure = options->exposure;
    frame->samples = isReference ? 1 : options->samples; // the reference takes more
    frame->transmittance = options->transmittance;
    frame->maxTransmittance = options->maxTransmittance;
    frame->minTransmittance = options->minTransmittance;
    frame->power = options->power;
    frame->wallThickness = options->wallThickness;
    const char* presets[vt_presetCount + 1];
    for (int i = 0; i <= vt_presetCount; ++i) {
        presets[i] = vtPresetName(i);
    }
    static const char *const backs[] = {"second", "farthest", NULL}, *const orders[] = {"any", "ordered",
                                                                                        NULL};
    static const char* const searches[] = {"steps", "cells", NULL};
    vtResult result = vt_ok;
    frame->preset = (vtPreset)chooseWord("preset", options->preset, presets, &result, error);
    frame->backSurface =
        (vtBackSurface)chooseWord("back-surface", options->backSurface, backs, &result, error);
    frame->multi = (vtMulti)chooseWord("multi", options->multi, orders, &result, error);
    frame->search = (vtSearch)chooseWord("search", options->search, searches, &result, error);
    if (result != vt_ok) {
        return result;
    }
    const float aspect = (float)frame->width / (float)frame->height;
    result = chooseView(options, &input->scene, aspect, &frame->view, error);
    return result == vt_ok ? vtValidateFrame(frame, error) : result;
}
