// Defaults and ranges of a frame: the one place that knows them.
#include "base/error.h"
#include "base/math.h"
#include "technique/technique.h"

// One row a preset, as the table in vitrine.h.
static const struct {
    const char* name;
    int layers, steps;
    int maxEvents, branches;
} presets[vt_presetCount] = {
    [vt_presetLow] = {"low", 2, 25, 4, 0},
    [vt_presetMedium] = {"medium", 4, 50, 8, 1},
    [vt_presetHigh] = {"high", 8, 100, 8, 2},
};

const char* vtPresetName(int index)
{
    return index >= 0 && index < vt_presetCount ? presets[index].name : NULL;
}

vtFrame vtResolveFrame(const vtFrame* frame)
{
    const int row = frame->preset;
    vtFrame resolved = *frame;
    resolved.layers = frame->layers == 0 ? presets[row].layers : frame->layers;
    resolved.steps = frame->steps == 0 ? presets[row].steps : frame->steps;
    resolved.maxEvents = frame->maxEvents == 0 ? presets[row].maxEvents : frame->maxEvents;
    return resolved;
}

int vtFrame_BranchCount(const vtFrame* frame)
{
    const bool any =
        vtTechnique_Row(frame->technique)->traces && !vtFrame_IsStrict(frame) && frame->branches >= 0;
    return any ? frame->branches > 0 ? frame->branches : presets[frame->preset].branches : 0;
}

vtFrame vtDefaultFrame(void)
{
    return (vtFrame){
        .view = {.eye = {0.36f, 0.3f, 3.05f}, .target = {0.0f, 0.0f, 0.0f}, .fovY = 45.0f},
        .technique = vt_techniqueExact,
        .preset = vt_presetMedium,
        .fresnel = true,
        .transmittance = 0.8f,
        .maxTransmittance = 0.95f,
        .minTransmittance = 0.2f,
        .power = 3.0f,
        .refine = 8,
        .width = 512,
        .height = 512,
        .samples = 1,
    };
}

static bool isFinite(vtVec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static vtResult checkRange(const char* field, double value, double low, double high, vtError* error)
{
    // Written so that NaN fails.
    if (value >= low && value <= high) {
        return vt_ok;
    }
    return vtFail(error, vt_errorArgument, "%s is %g; it must be from %g to %g", field, value, low, high);
}

vtResult vtValidateFrame(const vtFrame* frame, vtError* error)
{
    const vtTechnique technique = frame->technique;
    if (technique < 0 || technique >= vt_techniqueCount) {
        return vtFail(error, vt_errorArgument, "technique %d is not in the table", (int)technique);
    }
    if (frame->output < vt_outputPicture || frame->output > vt_outputLayerNormal) {
        return vtFail(error, vt_errorArgument, "output %d is not one of vtOutput", (int)frame->output);
    }
    const struct {
        const char* field;
        double value, low, high;
    } ranges[] = {
        {"field of view", frame->view.fovY, 1, 170},
        {"index of refraction", frame->ior, frame->ior == 0.0f ? 0 : 1, 4},
        {"preset", frame->preset, 0, vt_presetCount - 1},
        {"layers", frame->layers, 0, VT_MAX_LAYERS},
        {"steps", frame->steps, 0, VT_MAX_STEPS},
        {"refine", frame->refine, 0, VT_MAX_REFINE},
        {"max-events", frame->maxEvents, 0, VT_MAX_EVENTS},
        {"transmittance", frame->transmittance, 0, 1},
        {"max-transmittance", frame->maxTransmittance, 0, 1},
        {"min-transmittance", frame->minTransmittance, 0, frame->maxTransmittance},
        {"power", frame->power, 0, 100},
        {"wall-thickness", frame->wallThickness, 0, 1e6},
        {"branches", frame->branches, -1, VT_MAX_BRANCHES},
        {"multi", frame->multi, vt_multiAny, vt_multiOrdered},
        {"search", frame->search, vt_searchSteps, vt_searchCells},
        {"back-surface", frame->backSurface, vt_backSecond, vt_backFarthest},
        {"exposure", frame->exposure, -20, 20},
        {"samples", frame->samples, 1, VT_MAX_SAMPLES},
        {"first-sample", frame->firstSample, 0, 1000000},
        {"width", frame->width, 1, 16384},
        {"height", frame->height, 1, 16384},
        {"layer-size", frame->layerSize, frame->layerSize == 0 ? 0 : 16, 8192},
    };
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; ++i) {
        if (checkRange(ranges[i].field, ranges[i].value, ranges[i].low, ranges[i].high, error) != vt_ok) {
            return vt_errorArgument;
        }
    }
    const int layers = vtFrame_LayerCount(frame);
    if (frame->output >= vt_outputLayerDepth && layers == 0) {
        return vtFail(error, vt_errorArgument, "technique '%s' peels no layers to be shown",
                      vtTechnique_Info(technique)->id);
    }
    if (frame->output >= vt_outputLayerDepth && (frame->layer < 0 || frame->layer >= layers)) {
        return vtFail(error, vt_errorArgument, "layer is %d; with %d layers it must be from 0 to %d",
                      frame->layer, layers, layers - 1);
    }
    if (!isFinite(frame->view.eye) || !isFinite(frame->view.target)) {
        return vtFail(error, vt_errorArgument, "the camera's position and target must be finite numbers");
    }
    float distance = vtLength(vtSub(frame->view.target, frame->view.eye));
    if (!(distance > 0.0f) || !isfinite(distance)) {
        return vtFail(error, vt_errorArgument,
                      "the camera stands on its target (%g, %g, %g); move one of them",
                      (double)frame->view.eye.x, (double)frame->view.eye.y, (double)frame->view.eye.z);
    }
    return vtSucceed(error);
}
