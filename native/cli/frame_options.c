// From the command line's settings to a frame.
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "cli/load.h"
#include "cli/relief_input.h"
#include "cli/trace.h"
#include "technique/background.h"

/// The camera of that number or name, or NULL.
static const vtSceneCamera* findCamera(const vtScene* scene, const char* text)
{
    char* end;
    const unsigned long number = strtoul(text, &end, 10);
    if (isdigit((unsigned char)*text) && *end == '\0') {
        return number < scene->cameraCount ? &scene->cameras[number] : NULL;
    }
    for (uint32_t i = 0; i < scene->cameraCount; ++i) {
        if (strcmp(scene->cameras[i].name, text) == 0) {
            return &scene->cameras[i];
        }
    }
    return NULL;
}

static vtResult failCamera(const vtScene* scene, const char* text, vtError* error)
{
    char names[512] = "";
    for (uint32_t i = 0; i < scene->cameraCount; ++i) {
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%u%s%s", i > 0 ? ", " : "", i,
                 scene->cameras[i].name[0] != '\0' ? " " : "", scene->cameras[i].name);
    }
    return vtFail(
        error, vt_errorArgument,
        scene->cameraCount == 0
            ? "--camera-index is '%.100s', but there are no cameras in what is drawn; leave it out%s"
            : "--camera-index is '%.100s', but the cameras in what is drawn are: %s",
        text, names);
}

/// The eye that the options ask for, else the file's camera, else one that shows the whole scene, at rest
/// where it moves.
static vtResult chooseView(const vtOptions* options, const vtInput* input, float aspect, vtFrame* frame,
                           vtError* error)
{
    const vtScene* scene = &input->scene;
    const vtView* given = &options->frame.view;
    vtView* view = &frame->view;
    if (options->cameraOfFile != NULL) {
        const vtSceneCamera* camera = findCamera(scene, options->cameraOfFile);
        if (camera == NULL) {
            return failCamera(scene, options->cameraOfFile, error);
        }
        *view = camera->view;
        view->fovY = options->hasFov ? given->fovY : view->fovY;
        view->eye = options->hasCamera ? given->eye : view->eye;
        view->target = options->hasTarget ? given->target : view->target;
        frame->orthographicHeight = options->hasFov ? 0.0f : camera->orthographicHeight;
        return vt_ok;
    }
    const vtView whole =
        input->motion.count > 0 ? input->motion.view : vtViewOfScene(scene, given->fovY, aspect);
    const vtVec3 target = options->hasTarget ? given->target : whole.target;
    const vtVec3 offset = vtSub(whole.eye, whole.target);
    const vtVec3 eye = options->hasCamera ? given->eye : vtAdd(target, offset);
    *view = (vtView){eye, target, given->fovY};
    return vt_ok;
}

vtResult vtMakeFrame(const vtOptions* options, const vtInput* input, vtFrame* frame, vtError* error)
{
    *frame = options->frame;
    bool isReference = vtIsReference(options);
    const char* technique = vtChooseTechnique(options, &input->scene);
    frame->technique = isReference ? frame->technique : vtFindTechnique(technique);
    if (frame->technique == vt_techniqueCount) {
        return vtFail(error, vt_errorArgument, "technique '%s' is unknown; see 'vitrine list'",
                      options->technique);
    }
    frame->output = options->analysis ? vt_outputAnalysis : vt_outputPicture;
    frame->fresnel = options->fresnel;
    frame->toneMapping = options->backdrop != NULL ? vt_toneMappingNone : frame->toneMapping;
    if (options->background != NULL && vtFrame_SetBackground(frame, options->background, error) != vt_ok) {
        return vt_errorArgument;
    }
    frame->samples = isReference ? 1 : options->samples; // the reference takes more
    const float aspect = (float)frame->width / (float)frame->height;
    vtResult result = chooseView(options, input, aspect, frame, error);
    return result == vt_ok ? vtValidateFrame(frame, error) : result;
}
