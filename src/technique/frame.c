// What a frame's settings come to with its technique.
#include "base/error.h"
#include "base/math.h"
#include "base/space.h"
#include "scene/camera.h"
#include "technique/settings.h"
#include "technique/technique.h"

vtVariant vtFrame_Variant(const vtFrame* frame, bool opaque)
{
    const vtProgramDef* defs = vtTechnique_Row(frame->technique)->refract;
    const bool cells = frame->search == vt_searchCells && defs[vt_variantCells].name != NULL;
    const vtVariant any = cells ? vt_variantCells : vt_variantAny;
    const vtVariant ordered = any + vt_variantOrdered, withOpaque = any + vt_variantOpaque;
    if (frame->multi == vt_multiOrdered && defs[ordered].name != NULL) {
        return ordered;
    }
    return opaque && defs[withOpaque].name != NULL ? withOpaque : any;
}

int vtFrame_LayerCount(const vtFrame* frame)
{
    int layers = vtTechnique_Row(frame->technique)->layers;
    return layers == VT_LAYERS_OF_FRAME ? vtResolveFrame(frame).layers : layers;
}

int vtFrame_BranchCount(const vtFrame* frame)
{
    const int branches = vtResolveFrame(frame).branches;
    const bool any = vtTechnique_Row(frame->technique)->traces && !vtFrame_IsStrict(frame) && branches > 0;
    return any ? branches : 0;
}

static bool isFinite(vtVec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static bool isNear(vtVec3 v)
{
    return fmaxf(fabsf(v.x), fmaxf(fabsf(v.y), fabsf(v.z))) <= VT_FARTHEST_EYE;
}

static vtResult checkView(const vtView* view, vtError* error)
{
    if (!isFinite(view->eye) || !isFinite(view->target)) {
        return vtFail(error, vt_errorArgument, "the camera's position and target must be finite numbers");
    }
    if (!isNear(view->eye) || !isNear(view->target)) {
        const vtVec3 far = isNear(view->eye) ? view->target : view->eye;
        return vtFail(error, vt_errorArgument,
                      "the camera's %s is at (%g, %g, %g); its coordinates must be from -%g to %g",
                      isNear(view->eye) ? "target" : "position", (double)far.x, (double)far.y, (double)far.z,
                      (double)VT_FARTHEST_EYE, (double)VT_FARTHEST_EYE);
    }
    if (view->eye.x == view->target.x && view->eye.y == view->target.y && view->eye.z == view->target.z) {
        return vtFail(error, vt_errorArgument,
                      "the camera stands on its target (%g, %g, %g); move one of them", (double)view->eye.x,
                      (double)view->eye.y, (double)view->eye.z);
    }
    return vt_ok;
}

vtResult vtValidateFrame(const vtFrame* frame, vtError* error)
{
    if (frame == NULL) {
        return vtFailMissing(error, "vtValidateFrame", "frame");
    }
    if (vtCheckSettings(frame, error) != vt_ok) {
        return vt_errorArgument;
    }
    const int layers = vtFrame_LayerCount(frame);
    if (frame->output >= vt_outputLayerDepth && layers == 0) {
        return vtFail(error, vt_errorArgument, "technique '%s' peels no layers to be shown",
                      vtTechnique_Info(frame->technique)->id);
    }
    if (frame->output >= vt_outputLayerDepth && frame->layer >= layers) {
        return vtFail(error, vt_errorArgument, "layer is %d; with %d layers it must be from 0 to %d",
                      frame->layer, layers, layers - 1);
    }
    const vtVec3 behind = frame->backgroundColor;
    // Written so that NaN fails.
    if (!(fminf(behind.x, fminf(behind.y, behind.z)) >= 0.0f &&
          fmaxf(behind.x, fmaxf(behind.y, behind.z)) <= 1.0f) ||
        !isFinite(behind)) {
        return vtFail(error, vt_errorArgument,
                      "background-color is (%g, %g, %g); its numbers must be from 0 to 1", (double)behind.x,
                      (double)behind.y, (double)behind.z);
    }
    if (vtCheckMatrices(frame, error) != vt_ok) {
        return vt_errorArgument;
    }
    if (frame->x < -16384 || frame->x > 16384 || frame->y < -16384 || frame->y > 16384) {
        return vtFail(error, vt_errorArgument, "x, y are %d, %d; they must be from -16384 to 16384", frame->x,
                      frame->y);
    }
    // With matrices eye and target are not looked at.
    return frame->viewMatrix != NULL || checkView(&frame->view, error) == vt_ok ? vtSucceed(error)
                                                                                : vt_errorArgument;
}
