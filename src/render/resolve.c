// From the frame that is asked for to the one that is drawn.
#include "base/about.h"
#include "base/error.h"
#include "base/math.h"
#include "gl/state.h"
#include "render/renderer.h"
#include "technique/technique.h"

/// What a technique needs of the scene's meshes is there (vtPrepareScene).
static vtResult checkMeshes(const vtSceneBuffer* scene, const vtTechniqueRow* row, vtError* error)
{
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtMeshBuffer* mesh = &scene->geometry.items[scene->objects[i].geometry].vertices;
        const bool byHeights = row->heights && vtSceneBuffer_HasHeights(scene, i);
        if (!byHeights && mesh->indexCount == 0) {
            return vtFail(error, vt_errorArgument,
                          "technique '%s' needs triangles, which a relief in the scene does not have; call "
                          "vtPrepareScene for the technique before vtRenderer_SetScene",
                          row->info.id);
        }
        if (i < scene->glassCount && row->innerDistances && mesh->distances == 0) {
            return vtFail(
                error, vt_errorArgument,
                "technique '%s' needs inner distances; call vtPrepareScene for the technique before "
                "vtRenderer_SetScene",
                row->info.id);
        }
    }
    return vt_ok;
}

/// What a technique cannot draw of a host's view and picture.
static vtResult checkHost(const vtFrame* frame, const vtCamera* camera, const vtTechniqueRow* row,
                          vtError* error)
{
    const char* id = row->info.id;
    if (camera->orthographic && row->layers != 0) {
        return vtFail(error, vt_errorArgument,
                      "technique '%s' peels layers in perspective; an orthographic projection needs exact, "
                      "heightfield or "
                      "single",
                      id);
    }
    if (!VT_WITH_HOST && (frame->overlay || frame->hostColor != 0)) {
        return vtFail(error, vt_errorArgument, "a host's picture takes a native build");
    }
    if (frame->overlay && !row->surface && !row->traces) {
        return vtFail(error, vt_errorArgument,
                      "technique '%s' has no first surface whose depth could be written", id);
    }
    if ((frame->overlay || frame->hostDepth != 0) && frame->viewMatrix == NULL) {
        return vtFail(error, vt_errorArgument,
                      "over the host's picture, or with its depth, a frame needs viewMatrix and "
                      "projectionMatrix, which say "
                      "what its depths mean");
    }
    if (frame->overlay && frame->output != vt_outputPicture) {
        return vtFail(error, vt_errorArgument, "only the picture can be drawn over the host's; output is %d",
                      (int)frame->output);
    }
    return vt_ok;
}

vtResult vtRenderer_ResolveFrame(vtRenderer* renderer, const vtFrame* asked, vtFrame* frame, vtCamera* camera,
                                 vtError* error)
{
    vtResult result = vtCheckGiven(renderer, asked, VT_ABOUT("the frame"), error);
    if (result == vt_ok && renderer->scene.instanceCount == 0) {
        result = vtFail(
            error, vt_errorArgument,
            "renderer: there is nothing to draw; call vtRenderer_SetScene, or add geometry and an instance");
    }
    result = result == vt_ok ? vtValidateFrame(asked, error) : result;
    if (result != vt_ok) {
        return result;
    }
    vtTakeState(&renderer->gl);
    result = vtSceneBuffer_Place(&renderer->scene, &renderer->gl, error);
    if (result != vt_ok) {
        return result;
    }
    *frame = vtResolveFrame(asked);
    frame->background = frame->overlay ? vt_backgroundTransparent : frame->background;
    if (vtRenderer_ShowsBackdrop(renderer, frame)) {
        frame->toneMapping = vt_toneMappingNone; // the picture's colours stay
    }
    *camera = vtMakeCamera(frame);
    vtCamera_Enter(camera, &renderer->scene.space);
    frame->wallThickness *= renderer->scene.space.unit;
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    if (frame->background == vt_backgroundPicture && renderer->background.name == 0) {
        return vtFail(error, vt_errorArgument,
                      "there is no picture for the background; call vtRenderer_SetBackground first");
    }
    result = checkHost(frame, camera, row, error);
    return result == vt_ok ? checkMeshes(&renderer->scene, row, error) : result;
}
