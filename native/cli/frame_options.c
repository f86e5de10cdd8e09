// From the command line's settings to a frame.
#include "base/error.h"
#include "base/math.h"
#include "cli/load.h"
#include "cli/relief_input.h"
#include "cli/trace.h"

/// The eye that the options ask for, else the file's camera, else one that shows the whole scene.
static vtResult chooseView(const vtOptions* options, const vtScene* scene, float aspect, vtView* view,
                           vtError* error)
{
    const vtView* given = &options->frame.view;
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
        view->fovY = options->hasFov ? given->fovY : view->fovY;
        view->eye = options->hasCamera ? given->eye : view->eye;
        view->target = options->hasTarget ? given->target : view->target;
        return vt_ok;
    }
    const vtView whole = vtViewOfScene(scene, given->fovY, aspect);
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
    frame->samples = isReference ? 1 : options->samples; // the reference takes more
    const float aspect = (float)frame->width / (float)frame->height;
    vtResult result = chooseView(options, &input->scene, aspect, &frame->view, error);
    return result == vt_ok ? vtValidateFrame(frame, error) : result;
}
