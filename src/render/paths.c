// From a scene to paths and their light: the passes of a frame, in order, but the last. Techniques that
// search layers, or blend: surface, peel, merge, refract, shade; those that need no image of the scene:
// trace. Each pass reads the targets of those before it and writes its own.
#include <string.h>

#include "base/about.h"
#include "base/error.h"
#include "image/image.h"
#include "render/renderer.h"
#include "technique/technique.h"

static vtPeelKind choosePeelKind(const vtFrame* frame)
{
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    if (row->innerDistances && frame->backSurface == vt_backFarthest) {
        return vt_peelFarthest;
    }
    return row->layerSpace == vt_layersOfEachObject ? vt_peelEachObject : vt_peelAll;
}

void vtEndStage(const vtFrame* frame, const char* stage)
{
    if (frame->stageDone != NULL) {
        frame->stageDone(stage, frame->stageData);
    }
}

static bool hasOpaque(const vtRenderer* renderer)
{
    return renderer->scene.objectCount > renderer->scene.glassCount;
}

/// What the last pass makes of the light; views for analysis show no light.
static vtDisplay displayOf(const vtRenderer* renderer, const vtFrame* frame)
{
    const bool isPicture = frame->output == vt_outputPicture;
    return (vtDisplay){.toneMapping = isPicture && !frame->linear ? frame->toneMapping : vt_toneMappingNone,
                       .hasBackground = isPicture && frame->background >= vt_backgroundColor,
                       .toFloats = renderer->drawsFloats};
}

vtBehind vtRenderer_Behind(const vtRenderer* renderer, const vtFrame* frame)
{
    const vtVec3 color = frame->backgroundColor;
    return (vtBehind){.texture = frame->background == vt_backgroundPicture   ? &renderer->background
                                 : frame->background == vt_backgroundBlurred ? &renderer->environment.blurred
                                                                             : NULL,
                      .color = {vtSrgbToLinear(color.x), vtSrgbToLinear(color.y), vtSrgbToLinear(color.z)}};
}

bool vtRenderer_ShowsGround(const vtRenderer* renderer, const vtFrame* frame)
{
    return VT_IS_FULL && renderer->ground.isThere && vtTechnique_Row(frame->technique)->traces;
}

bool vtRenderer_ShowsBackdrop(const vtRenderer* renderer, const vtFrame* frame)
{
    return VT_IS_FULL && renderer->hasBackdrop && vtTechnique_Row(frame->technique)->traces;
}

/// The variant of the trace pass.
static vtTraceVariant chooseTrace(const vtRenderer* renderer, const vtFrame* frame)
{
    const bool ground = vtRenderer_ShowsGround(renderer, frame);
    const bool shades = ground && hasOpaque(renderer) && (VT_SHADES_LOOKS || !renderer->scene.hasLooks);
    const vtSun sun = vtGivenSun(&renderer->ground.ground, &renderer->environment.sun);
    return vtChooseTraceVariant(&renderer->scene, &renderer->environment, frame) |
           (ground ? vt_traceGround : 0) |
           (vtRenderer_ShowsBackdrop(renderer, frame) ? vt_traceBackdrop | vt_traceFootprint : 0) |
           (shades && vtSun_IsThere(&sun) ? vt_traceShade : 0);
}

/// Is the sun of the environment a light of its own in the frame?
static bool partsSun(const vtRenderer* renderer, const vtFrame* frame)
{
    return vtRenderer_ShowsGround(renderer, frame) && (chooseTrace(renderer, frame) & vt_traceShade) != 0 &&
           vtSun_IsThere(&renderer->environment.sun);
}

static void writeSun(const vtSun* sun, float numbers[8])
{
    const vtVec3 d = sun->direction, light = sun->irradiance;
    const float all[8] = {d.x, d.y, d.z, sun->radius, light.x, light.y, light.z, 0.0f};
    memcpy(numbers, all, sizeof all);
}

/// What lights opaque things beside the lighting, for shade.glsl.
static void findSuns(const vtRenderer* renderer, const vtFrame* frame, float suns[16])
{
    const vtSun none = {.direction = {0.0f, 1.0f, 0.0f}};
    const bool ground = vtRenderer_ShowsGround(renderer, frame);
    const vtSun sun = vtGivenSun(&renderer->ground.ground, &renderer->environment.sun);
    writeSun(ground ? &sun : &none, suns);
    writeSun(partsSun(renderer, frame) ? &renderer->environment.sun : &none, suns + 8);
}

void vtRenderer_StartPrograms(vtRenderer* renderer, const vtFrame* frame, vtProgramList* programs)
{
    const vtGL* gl = &renderer->gl;
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    const vtVariant variant = vtFrame_Variant(frame, hasOpaque(renderer));
    if (vtRenderer_ShowsGround(renderer, frame)) {
        vtEnvironmentBuffer_FindSun(&renderer->environment);
    }
    if (row->traces) {
        const vtTraceVariant trace = chooseTrace(renderer, frame);
        vtTracePass_Start(&renderer->trace, gl, trace, programs);
        if (vtRenderer_ShowsGround(renderer, frame)) {
            vtGroundPass_Start(&renderer->ground, gl, trace, programs);
        }
    } else {
        vtRefractPass_Start(&renderer->refract, gl, frame->technique, variant, frame->countReads, programs);
        vtShadePass_Start(&renderer->shade, gl, hasOpaque(renderer), row->surface, vtFrame_HasHost(frame),
                          programs);
    }
    if (row->surface) {
        vtSurfacePass_Start(&renderer->surface, gl, row->innerDistances, programs);
    }
    if (row->layers != 0) {
        vtPeelPass_Start(&renderer->peel, gl, choosePeelKind(frame), programs);
    }
    if (row->merge) {
        vtMergePass_Start(&renderer->merge, gl, programs);
    }
    if (vtFrame_AddsSamples(frame)) {
        vtAccumulatePass_Start(&renderer->accumulate, gl, displayOf(renderer, frame), programs);
    } else if (!vtFrame_IsOverlay(frame)) {
        vtPresentPass_Start(&renderer->present, gl, displayOf(renderer, frame), programs);
    }
    if (vtFrame_IsOverlay(frame)) {
        vtOverlayPass_Start(&renderer->overlay, gl, row->surface, frame->toneMapping, programs);
    }
    renderer->lacksShaders = programs->lacksShaders;
}

/// Targets of the techniques that search layers, or blend.
static vtResult resizeLayers(vtRenderer* renderer, const vtFrame* frame, int layerWidth, int layerHeight,
                             vtError* error)
{
    const vtGL* gl = &renderer->gl;
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    const int layers = vtFrame_LayerCount(frame);
    const int sets = choosePeelKind(frame) == vt_peelEachObject && renderer->scene.glassCount > 0
                         ? (int)renderer->scene.glassCount
                         : 1;
    const bool ordered = vtVariant_IsOrdered(vtFrame_Variant(frame, hasOpaque(renderer)));
    vtResult result = vt_ok;
    if (row->surface) {
        result = vtSurfacePass_Resize(&renderer->surface, gl, frame->width, frame->height,
                                      row->innerDistances, error);
    }
    if (result == vt_ok) {
        result = vtRefractPass_Resize(&renderer->refract, gl, frame->width, frame->height, ordered ? 2 : 1,
                                      row->surface ? &renderer->surface.depth : NULL, error);
    }
    if (result == vt_ok && layers > 0) {
        result = vtPeelPass_Resize(&renderer->peel, gl, layerWidth, layerHeight, layers, sets, error);
    }
    if (result == vt_ok && row->merge) {
        result = vtMergePass_Resize(&renderer->merge, gl, layerWidth, layerHeight, layers, sets, error);
    }
    return result == vt_ok ? vtShadePass_Resize(&renderer->shade, gl, frame->width, frame->height, error)
                           : result;
}

vtResult vtRenderer_CheckSize(const vtRenderer* renderer, const vtFrame* frame, vtError* error)
{
    const vtTexture* light =
        vtTechnique_Row(frame->technique)->traces ? &renderer->trace.radiance : &renderer->shade.radiance;
    GLint largest = frame->width > frame->height ? frame->width : frame->height;
    if (light->width != frame->width || light->height != frame->height) {
        renderer->gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    }
    return frame->width <= largest && frame->height <= largest
               ? vt_ok
               : vtFail(
                     error, vt_errorContext,
                     "frame: %d x %d is more than this GPU's largest texture (%d); ask for a smaller picture",
                     frame->width, frame->height, largest);
}

vtResult vtRenderer_ResizeTargets(vtRenderer* renderer, const vtFrame* frame, int layerWidth, int layerHeight,
                                  vtError* error)
{
    const vtGL* gl = &renderer->gl;
    vtResult result = vtRenderer_CheckSize(renderer, frame, error);
    if (result != vt_ok) {
        return result;
    }
    result = vtTechnique_Row(frame->technique)->traces
                 ? vtTracePass_Resize(&renderer->trace, gl, chooseTrace(renderer, frame), frame->width,
                                      frame->height, error)
                 : resizeLayers(renderer, frame, layerWidth, layerHeight, error);
    if (result == vt_ok && (hasOpaque(renderer) || vtTrace_IsRough(&renderer->scene, frame))) {
        result = vtEnvironmentBuffer_Light(&renderer->environment, gl, partsSun(renderer, frame), error);
    }
    if (result == vt_ok && frame->background == vt_backgroundBlurred) {
        result = vtEnvironmentBuffer_Blur(&renderer->environment, gl, frame->backgroundBlur, error);
    }
    if (result == vt_ok && vtFrame_AddsSamples(frame)) {
        result = vtAccumulatePass_Resize(&renderer->accumulate, gl, frame->width, frame->height, error);
    }
    return result;
}

/// One object after the other, from the eye; then the surfaces of all are there again.
static void drawOrdered(vtRenderer* renderer, const vtFrame* frame, const vtRefractInputs* inputs)
{
    const vtGL* gl = &renderer->gl;
    const vtSceneBuffer* scene = &renderer->scene;
    const uint32_t count = scene->glassCount;
    vtRefractPass_ClearOrdered(&renderer->refract, gl, count);
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t object = scene->order[i];
        if (count > 1) {
            vtSurfacePass_Draw(&renderer->surface, gl, scene, object, object + 1, false);
            gl->BindVertexArray(renderer->emptyVertexArray);
            vtEndStage(frame, "surface");
        }
        vtRefractPass_DrawOrdered(&renderer->refract, gl, inputs, object, count - 1 - i);
        vtEndStage(frame, "refract");
    }
    if (count > 1) {
        vtSurfacePass_Draw(&renderer->surface, gl, scene, 0, count, false);
        gl->BindVertexArray(renderer->emptyVertexArray);
        vtEndStage(frame, "surface");
    }
}

/// Paths and light of the techniques that search layers, or blend.
static void drawLayers(vtRenderer* renderer, const vtFrame* frame, bool layersToo)
{
    const vtGL* gl = &renderer->gl;
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    const vtVariant variant = vtFrame_Variant(frame, hasOpaque(renderer));
    if (row->surface) {
        vtSurfacePass_Draw(&renderer->surface, gl, &renderer->scene, 0, renderer->scene.glassCount,
                           row->innerDistances);
        vtEndStage(frame, "surface");
    }
    if (layersToo && row->layers != 0) {
        vtPeelPass_Draw(&renderer->peel, gl, &renderer->scene, choosePeelKind(frame));
        vtEndStage(frame, "peel");
    }
    gl->BindVertexArray(renderer->emptyVertexArray);
    if (layersToo && row->merge) {
        vtMergePass_Draw(&renderer->merge, gl, &renderer->peel.depths);
        vtEndStage(frame, "merge");
    }
    const vtRefractInputs inputs = {.surface = &renderer->surface.attributes,
                                    .innerDistances = &renderer->surface.distances,
                                    .layerDepths = &renderer->peel.depths,
                                    .layerNormals = &renderer->peel.normals,
                                    .mergedDepths = &renderer->merge.depths,
                                    .scene = &renderer->scene};
    if (vtVariant_IsOrdered(variant)) {
        drawOrdered(renderer, frame, &inputs);
    } else {
        vtRefractPass_Draw(&renderer->refract, gl, frame->technique, &inputs);
        vtEndStage(frame, "refract");
    }
    if (frame->output == vt_outputPicture) {
        vtShadePass_Draw(&renderer->shade, gl,
                         &(vtShadeInputs){.paths = &renderer->refract.targets[0],
                                          .surface = row->surface ? &renderer->surface.attributes : NULL,
                                          .scene = &renderer->scene,
                                          .environment = &renderer->environment,
                                          .host = &renderer->host});
        vtEndStage(frame, "shade");
    }
}

void vtRenderer_DrawPaths(vtRenderer* renderer, const vtFrame* frame, bool layersToo)
{
    if (!vtTechnique_Row(frame->technique)->traces) {
        drawLayers(renderer, frame, layersToo);
        return;
    }
    renderer->gl.BindVertexArray(renderer->emptyVertexArray);
    vtTraceInputs inputs = {.scene = &renderer->scene,
                            .environment = &renderer->environment,
                            .host = &renderer->host,
                            .ground = &renderer->ground.buffer,
                            .backdrop = &renderer->backdropPicture,
                            .backdropPlace = &renderer->backdropPlace,
                            .branches = vtFrame_BranchCount(frame),
                            .wavelengths = vtResolveFrame(frame).wavelengths};
    findSuns(renderer, frame, inputs.sun);
    vtTracePass_Draw(&renderer->trace, &renderer->gl, chooseTrace(renderer, frame), &inputs);
    vtEndStage(frame, "trace");
}

const vtTexture* vtRenderer_Paths(const vtRenderer* renderer)
{
    return vtTechnique_Row(renderer->frame.technique)->traces ? &renderer->trace.paths
                                                              : &renderer->refract.targets[0].paths;
}

const vtTexture* vtRenderer_Light(const vtRenderer* renderer)
{
    return vtTechnique_Row(renderer->frame.technique)->traces ? &renderer->trace.radiance
                                                              : &renderer->shade.radiance;
}

void vtRenderer_DrawOverlay(const vtRenderer* renderer, const vtFrame* frame, const vtTexture* light)
{
    const bool surface = vtTechnique_Row(frame->technique)->surface;
    vtOverlayPass_Draw(
        &renderer->overlay, &renderer->gl,
        &(vtOverlayInputs){.light = light,
                           .depths = surface ? &renderer->surface.attributes : &renderer->trace.depths,
                           .host = &renderer->host,
                           .nearIsGreater = renderer->nearIsGreater},
        frame->framebuffer, frame->x, frame->y);
}
