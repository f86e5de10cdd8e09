// The whole of a frame, in order. Techniques that search layers, or blend: surface, peel, merge, refract,
// shade; those that need no image of the scene: trace. Then present or, with several samples a pixel,
// accumulate. Each pass reads the targets of those before it and writes its own; offscreen, window and canvas
// differ only in the framebuffer that present draws to.
#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "gl/environment_buffer.h"
#include "gl/scene_buffer.h"
#include "passes/accumulate.h"
#include "passes/merge.h"
#include "passes/peel.h"
#include "passes/present.h"
#include "passes/refract.h"
#include "passes/shade.h"
#include "passes/surface.h"
#include "passes/trace.h"
#include "render/object_table.h"
#include "render/uniforms.h"

struct vtRenderer {
    vtGL gl;
    GLuint uniformBuffer;
    GLuint emptyVertexArray; // for passes that draw the viewport's triangle
    vtSurfacePass surface;
    vtPeelPass peel;
    vtMergePass merge;
    vtRefractPass refract;
    vtShadePass shade;
    vtTracePass trace;
    vtPresentPass present;
    vtAccumulatePass accumulate;
    // The scene.
    vtSceneBuffer scene;
    vtEnvironmentBuffer environment;
    // What a frame has to agree with to go on with the samples of the one before.
    vtFrameUniforms uniforms; // of the pixel's centre
    vtTechnique technique;
    vtBackSurface backSurface;
    vtMulti multi;
    vtSearch search;
    int branches;
    int sampleEnd; // the first sample not drawn yet; 0: nothing to go on with
    // vtRenderer_DrawImage draws into this.
    GLuint imageFramebuffer;
    vtTexture image;
};

vtResult vtCreateRenderer(const vtRendererDef* def, vtRenderer** out, vtError* error)
{
    *out = NULL;
    vtRenderer* renderer = calloc(1, sizeof *renderer);
    if (renderer == NULL) {
        return vtFail(error, vt_errorMemory, "renderer: out of memory");
    }
    vtResult result = vtLoadGL(def->getProcAddress, &renderer->gl, error);
    if (result != vt_ok) {
        free(renderer);
        return result;
    }
    const vtGL* gl = &renderer->gl;
    gl->GenVertexArrays(1, &renderer->emptyVertexArray);
    gl->GenBuffers(1, &renderer->uniformBuffer);
    gl->BindBuffer(GL_UNIFORM_BUFFER, renderer->uniformBuffer);
    gl->BufferData(GL_UNIFORM_BUFFER, sizeof(vtFrameUniforms), NULL, GL_DYNAMIC_DRAW);

    vtEnvironmentBuffer_Create(&renderer->environment, gl);
    result = vtCheckGL(gl, "creating the renderer", error);
    if (result != vt_ok) {
        vtDestroyRenderer(renderer);
        return result;
    }
    *out = renderer;
    return vtSucceed(error);
}

void vtDestroyRenderer(vtRenderer* renderer)
{
    if (renderer == NULL) {
        return;
    }
    const vtGL* gl = &renderer->gl;
    vtSurfacePass_Destroy(&renderer->surface, gl);
    vtPeelPass_Destroy(&renderer->peel, gl);
    vtMergePass_Destroy(&renderer->merge, gl);
    vtRefractPass_Destroy(&renderer->refract, gl);
    vtShadePass_Destroy(&renderer->shade, gl);
    vtTracePass_Destroy(&renderer->trace, gl);
    vtPresentPass_Destroy(&renderer->present, gl);
    vtAccumulatePass_Destroy(&renderer->accumulate, gl);
    vtSceneBuffer_Destroy(&renderer->scene, gl);
    vtEnvironmentBuffer_Destroy(&renderer->environment, gl);
    vtDestroyFramebuffers(gl, &renderer->imageFramebuffer, 1);
    vtTexture_Destroy(&renderer->image, gl);
    gl->DeleteBuffers(1, &renderer->uniformBuffer);
    gl->DeleteVertexArrays(1, &renderer->emptyVertexArray);
    free(renderer);
}

vtResult vtRenderer_SetScene(vtRenderer* renderer, const vtScene* scene, vtError* error)
{
    vtSceneBuffer fresh;
    vtResult result = vtSceneBuffer_Create(&fresh, &renderer->gl, scene, error);
    if (result != vt_ok) {
        return result;
    }
    vtSceneBuffer_Destroy(&renderer->scene, &renderer->gl);
    renderer->scene = fresh;
    renderer->sampleEnd = 0;
    return vtSucceed(error);
}

vtResult vtRenderer_SetMesh(vtRenderer* renderer, const vtMesh* mesh, vtError* error)
{
    vtBorrowedMesh borrowed;
    return vtRenderer_SetScene(renderer, vtBorrowMesh(mesh, &borrowed), error);
}

vtResult vtRenderer_UpdateMesh(vtRenderer* renderer, const vtScene* scene, uint32_t mesh, vtError* error)
{
    if (mesh >= scene->meshCount) {
        return vtFail(error, vt_errorArgument, "mesh %u is not in the scene, which has %u", mesh,
                      scene->meshCount);
    }
    if (scene->objectCount != renderer->scene.objectCount ||
        !vtSceneBuffer_UpdateMesh(&renderer->scene, &renderer->gl, scene, mesh)) {
        return vtRenderer_SetScene(renderer, scene, error);
    }
    renderer->sampleEnd = 0;
    return vtSucceed(error);
}

vtResult vtRenderer_SetEnvironment(vtRenderer* renderer, const vtEnvironment* environment, vtError* error)
{
    renderer->sampleEnd = 0;
    return vtEnvironmentBuffer_Set(&renderer->environment, &renderer->gl, environment, error);
}

static vtPeelKind choosePeelKind(const vtFrame* frame)
{
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    if (row->innerDistances && frame->backSurface == vt_backFarthest) {
        return vt_peelFarthest;
    }
    return row->layerSpace == vt_layersOfEachObject ? vt_peelEachObject : vt_peelAll;
}

static void endStage(const vtFrame* frame, const char* stage)
{
    if (frame->stageDone != NULL) {
        frame->stageDone(stage, frame->stageData);
    }
}

static bool hasOpaque(const vtRenderer* renderer)
{
    return renderer->scene.objectCount > renderer->scene.glassCount;
}

static bool addsSamples(const vtFrame* frame)
{
    return frame->output == vt_outputPicture && frame->firstSample + frame->samples > 1;
}

/// Starts the programs that the frame draws with.
static void startPrograms(vtRenderer* renderer, const vtFrame* frame, vtProgramList* programs)
{
    const vtGL* gl = &renderer->gl;
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    const vtVariant variant = vtFrame_Variant(frame, hasOpaque(renderer));
    if (row->traces) {
        vtTracePass_Start(&renderer->trace, gl, vtChooseTraceVariant(&renderer->scene, frame), programs);
    } else {
        vtRefractPass_Start(&renderer->refract, gl, frame->technique, variant, frame->countReads, programs);
        vtShadePass_Start(&renderer->shade, gl, hasOpaque(renderer), row->surface, programs);
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
    if (addsSamples(frame)) {
        vtAccumulatePass_Start(&renderer->accumulate, gl, programs);
    } else {
        vtPresentPass_Start(&renderer->present, gl, programs);
    }
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

static vtResult resizeTargets(vtRenderer* renderer, const vtFrame* frame, int layerWidth, int layerHeight,
                              vtError* error)
{
    const vtGL* gl = &renderer->gl;
    vtResult result = vtTechnique_Row(frame->technique)->traces
                          ? vtTracePass_Resize(&renderer->trace, gl, frame->width, frame->height, error)
                          : resizeLayers(renderer, frame, layerWidth, layerHeight, error);
    if (result == vt_ok && hasOpaque(renderer)) {
        result = vtEnvironmentBuffer_Light(&renderer->environment, gl, error);
    }
    if (result == vt_ok && addsSamples(frame)) {
        result = vtAccumulatePass_Resize(&renderer->accumulate, gl, frame->width, frame->height, error);
    }
    return result;
}

/// Uploads the uniform block of one sample; `count` samples are in the sum with it.
static void uploadSample(const vtRenderer* renderer, int sample, int count)
{
    const vtGL* gl = &renderer->gl;
    const bool movesLayers = vtTechnique_Row(renderer->technique)->layerSpace == vt_layersOfPicture;
    const vtFrameUniforms uniforms = vtMoveUniforms(&renderer->uniforms, sample, count, movesLayers);
    gl->BindBufferBase(GL_UNIFORM_BUFFER, VT_FRAME_BINDING, renderer->uniformBuffer);
    gl->BufferSubData(GL_UNIFORM_BUFFER, 0, sizeof uniforms, &uniforms);
}

static void resetState(const vtGL* gl)
{
    gl->Disable(GL_BLEND);
    gl->Disable(GL_CULL_FACE);
    gl->Disable(GL_SCISSOR_TEST);
    gl->Disable(GL_STENCIL_TEST);
    gl->Disable(GL_DEPTH_TEST);
    gl->Disable(GL_DITHER);
    gl->DepthFunc(GL_LESS);
    gl->DepthMask(GL_TRUE);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

/// One object after the other, from the eye; then the surfaces of all are there again.
static void drawOrdered(vtRenderer* renderer, const vtFrame* frame, vtVariant variant,
                        const vtRefractInputs* inputs)
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
            endStage(frame, "surface");
        }
        vtRefractPass_DrawOrdered(&renderer->refract, gl, frame->technique, variant, inputs, object,
                                  count - 1 - i);
        endStage(frame, "refract");
    }
    if (count > 1) {
        vtSurfacePass_Draw(&renderer->surface, gl, scene, 0, count, false);
        gl->BindVertexArray(renderer->emptyVertexArray);
        endStage(frame, "surface");
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
        endStage(frame, "surface");
    }
    if (layersToo && row->layers != 0) {
        vtPeelPass_Draw(&renderer->peel, gl, &renderer->scene, choosePeelKind(frame));
        endStage(frame, "peel");
    }
    gl->BindVertexArray(renderer->emptyVertexArray);
    if (layersToo && row->merge) {
        vtMergePass_Draw(&renderer->merge, gl, &renderer->peel.depths);
        endStage(frame, "merge");
    }
    const vtRefractInputs inputs = {.surface = &renderer->surface.attributes,
                                    .innerDistances = &renderer->surface.distances,
                                    .layerDepths = &renderer->peel.depths,
                                    .layerNormals = &renderer->peel.normals,
                                    .mergedDepths = &renderer->merge.depths,
                                    .scene = &renderer->scene,
                                    .countReads = frame->countReads};
    if (vtVariant_IsOrdered(variant)) {
        drawOrdered(renderer, frame, variant, &inputs);
    } else {
        vtRefractPass_Draw(&renderer->refract, gl, frame->technique, variant, &inputs);
        endStage(frame, "refract");
    }
    if (frame->output == vt_outputPicture) {
        vtShadePass_Draw(&renderer->shade, gl,
                         &(vtShadeInputs){.paths = &renderer->refract.targets[0],
                                          .surface = row->surface ? &renderer->surface.attributes : NULL,
                                          .scene = &renderer->scene,
                                          .environment = &renderer->environment});
        endStage(frame, "shade");
    }
}

/// Everything up to the light, with the uniform block that was uploaded.
static void drawPaths(vtRenderer* renderer, const vtFrame* frame, bool layersToo)
{
    if (!vtTechnique_Row(frame->technique)->traces) {
        drawLayers(renderer, frame, layersToo);
        return;
    }
    renderer->gl.BindVertexArray(renderer->emptyVertexArray);
    vtTracePass_Draw(&renderer->trace, &renderer->gl, vtChooseTraceVariant(&renderer->scene, frame),
                     &renderer->scene, &renderer->environment, vtFrame_BranchCount(frame));
    endStage(frame, "trace");
}

/// Where drawPaths has left the paths and the light.
static const vtTexture* drawnPaths(const vtRenderer* renderer)
{
    return vtTechnique_Row(renderer->technique)->traces ? &renderer->trace.paths
                                                        : &renderer->refract.targets[0].paths;
}

static const vtTexture* drawnLight(const vtRenderer* renderer)
{
    return vtTechnique_Row(renderer->technique)->traces ? &renderer->trace.radiance
                                                        : &renderer->shade.radiance;
}

static void drawStraight(vtRenderer* renderer, const vtFrame* frame)
{
    const vtGL* gl = &renderer->gl;
    uploadSample(renderer, 0, 1);
    drawPaths(renderer, frame, true);
    vtPresentPass_Draw(&renderer->present, gl,
                       &(vtPresentInputs){.paths = drawnPaths(renderer),
                                          .radiance = drawnLight(renderer),
                                          .layerDepths = &renderer->peel.depths,
                                          .layerNormals = &renderer->peel.normals},
                       frame->framebuffer, frame->width, frame->height);
    endStage(frame, "present");
    renderer->accumulate.count = 0;
    renderer->sampleEnd = frame->output == vt_outputPicture;
}

static void addSample(vtRenderer* renderer)
{
    vtAccumulatePass_Add(&renderer->accumulate, &renderer->gl, drawnLight(renderer));
}

/// `sampleEnd`: of the frame before, if this one goes on with it, else 0.
static void drawSamples(vtRenderer* renderer, const vtFrame* frame, int sampleEnd)
{
    const vtGL* gl = &renderer->gl;
    vtAccumulatePass* accumulate = &renderer->accumulate;
    gl->BindVertexArray(renderer->emptyVertexArray);
    if (sampleEnd == 0) {
        accumulate->count = 0;
    } else if (accumulate->count == 0) { // sample 0 was drawn straight, and its light is still there
        addSample(renderer);
    }
    bool layersToo = sampleEnd == 0;
    const int end = frame->firstSample + frame->samples;
    for (int i = frame->firstSample > sampleEnd ? frame->firstSample : sampleEnd; i < end; ++i) {
        uploadSample(renderer, i, accumulate->count + 1);
        drawPaths(renderer, frame, layersToo);
        addSample(renderer);
        // Fitted to the object, the layers stay the same for every sample: a third less time, and 0.2 to 0.4
        // dB further from the reference than with layers that move too (knot, bunny, 16 samples).
        layersToo = vtTechnique_Row(frame->technique)->layerSpace == vt_layersOfPicture;
        sampleEnd = i + 1;
    }
    uploadSample(renderer, 0, accumulate->count); // should there have been no sample left to draw
    vtAccumulatePass_Show(accumulate, gl, frame->framebuffer);
    renderer->sampleEnd = sampleEnd;
}

/// What a technique needs of the scene's meshes is there (vtPrepareScene).
static vtResult checkMeshes(const vtSceneBuffer* scene, const vtTechniqueRow* row, vtError* error)
{
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtMeshBuffer* mesh = &scene->meshes[scene->objects[i].mesh];
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

/// The frame as it is drawn: settings resolved, the view in the scene buffer's world.
static vtResult resolveFrame(const vtRenderer* renderer, const vtFrame* asked, vtFrame* frame, vtError* error)
{
    assert(renderer->scene.objectCount > 0 && "set a scene before drawing");
    const vtResult result = vtValidateFrame(asked, error);
    if (result != vt_ok) {
        return result;
    }
    *frame = vtResolveFrame(asked);
    if (frame->technique == vt_techniqueHeightField && renderer->scene.heights.cell == 0.0f) {
        frame->technique = vt_techniqueExact; // the same without a relief
    }
    frame->view.eye = vtSub(frame->view.eye, renderer->scene.origin);
    frame->view.target = vtSub(frame->view.target, renderer->scene.origin);
    return checkMeshes(&renderer->scene, vtTechnique_Row(frame->technique), error);
}

vtResult vtRenderer_Prepare(vtRenderer* renderer, const vtFrame* asked, bool* ready, vtError* error)
{
    vtFrame frame;
    vtProgramList programs = {0};
    *ready = false;
    const vtResult result = resolveFrame(renderer, asked, &frame, error);
    if (result == vt_ok) {
        startPrograms(renderer, &frame, &programs);
        *ready = vtProgramList_IsReady(&programs, &renderer->gl);
    }
    return result;
}

/// Keeps what the next frame has to agree with to go on with this one's samples. True where this one agrees
/// with the one before.
static bool keepFrame(vtRenderer* renderer, const vtFrame* frame, const vtFrameUniforms* uniforms)
{
    const bool same = renderer->technique == frame->technique &&
                      renderer->backSurface == frame->backSurface && renderer->multi == frame->multi &&
                      renderer->search == frame->search && renderer->branches == vtFrame_BranchCount(frame) &&
                      memcmp(uniforms, &renderer->uniforms, sizeof *uniforms) == 0;
    renderer->uniforms = *uniforms;
    renderer->technique = frame->technique;
    renderer->backSurface = frame->backSurface;
    renderer->multi = frame->multi;
    renderer->search = frame->search;
    renderer->branches = vtFrame_BranchCount(frame);
    return same;
}

vtResult vtRenderer_Draw(vtRenderer* renderer, const vtFrame* asked, vtError* error)
{
    vtFrame resolved;
    const vtFrame* frame = &resolved;
    const vtGL* gl = &renderer->gl;
    vtResult result = resolveFrame(renderer, asked, &resolved, error);
    if (result != vt_ok) {
        return result;
    }
    vtFrameUniforms uniforms;
    vtProgramList programs = {0};
    vtMakeUniforms(&renderer->scene, frame, renderer->environment.kind, &uniforms);
    startPrograms(renderer, frame, &programs);
    result = resizeTargets(renderer, frame, uniforms.size[2], uniforms.size[3], error);
    if (result == vt_ok) {
        result = vtProgramList_Finish(&programs, gl, error);
    }
    result = result == vt_ok ? vtCheckFrame(gl, "preparing the frame", error) : result;
    int sampleEnd = renderer->sampleEnd;
    renderer->sampleEnd = 0; // should something fail
    if (result != vt_ok) {
        return result;
    }
    const bool goesOn = keepFrame(renderer, frame, &uniforms) && frame->firstSample > 0;
    vtSceneBuffer_SortGlass(&renderer->scene, frame->view.eye);
    vtWriteObjectTable(&renderer->scene, frame);
    const bool sameTable = !vtSceneBuffer_SetTable(&renderer->scene, gl);
    sampleEnd = goesOn && sameTable ? sampleEnd : 0;
    endStage(frame, "prepare");
    resetState(gl);
    if (addsSamples(frame)) {
        drawSamples(renderer, frame, sampleEnd);
    } else {
        drawStraight(renderer, frame);
    }
    gl->BindVertexArray(0);
    return vtCheckFrame(gl, "drawing the frame", error);
}

vtResult vtRenderer_DrawImage(vtRenderer* renderer, const vtFrame* frame, uint8_t* rgba, vtError* error)
{
    const vtGL* gl = &renderer->gl;
    vtResult result = vtValidateFrame(frame, error);
    if (result != vt_ok) {
        return result;
    }
    if (vtTexture_Resize(&renderer->image, gl, GL_RGBA8, frame->width, frame->height, 0)) {
        vtAttachment color = {&renderer->image, 0};
        result = vtMakeFramebuffer(gl, "image", &color, 1, NULL, &renderer->imageFramebuffer, error);
        if (result != vt_ok) {
            return result;
        }
    }
    vtFrame offscreen = *frame;
    offscreen.framebuffer = renderer->imageFramebuffer;
    result = vtRenderer_Draw(renderer, &offscreen, error);
    if (result != vt_ok) {
        return result;
    }

    if (rgba == NULL) {
        gl->Finish();
        gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
        return vtSucceed(error);
    }
    gl->PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl->ReadPixels(0, 0, frame->width, frame->height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    // GL's first row is the bottom one.
    size_t rowBytes = 4 * (size_t)frame->width;
    for (int top = 0, bottom = frame->height - 1; top < bottom; ++top, --bottom) {
        uint8_t* a = rgba + rowBytes * (size_t)top;
        uint8_t* b = rgba + rowBytes * (size_t)bottom;
        for (size_t i = 0; i < rowBytes; ++i) {
            uint8_t swapped = a[i];
            a[i] = b[i];
            b[i] = swapped;
        }
    }
    return vtCheckGL(gl, "reading the picture back", error);
}

/// The path target: four words a pixel, bottom row first, allocated by malloc.
static vtResult readPaths(vtRenderer* renderer, uint32_t** paths, vtError* error)
{
    const vtGL* gl = &renderer->gl;
    const int width = drawnPaths(renderer)->width, height = drawnPaths(renderer)->height;
    assert(width > 0 && "draw a frame before reading its directions");
    *paths = malloc(16 * (size_t)width * (size_t)height);
    if (*paths == NULL) {
        return vtFail(error, vt_errorMemory, "directions: out of memory for %d x %d pixels", width, height);
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, vtTechnique_Row(renderer->technique)->traces
                                            ? renderer->trace.framebuffer
                                            : renderer->refract.framebuffers[0]);
    gl->ReadPixels(0, 0, width, height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, *paths);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    return vt_ok;
}

vtResult vtRenderer_ReadDirections(vtRenderer* renderer, float* directions, vtError* error)
{
    const int width = drawnPaths(renderer)->width, height = drawnPaths(renderer)->height;
    uint32_t* paths;
    vtResult result = readPaths(renderer, &paths, error);
    if (result != vt_ok) {
        return result;
    }
    for (int row = 0; row < height; ++row) {
        const uint32_t* from = paths + 4 * (size_t)width * (size_t)(height - 1 - row);
        float* to = directions + 3 * (size_t)width * (size_t)row;
        for (int column = 0; column < width; ++column, from += 4, to += 3) {
            int state = (int)(from[3] & 255u);
            if (state == VT_PATH_EXITED || (state == VT_PATH_OPAQUE && ((from[3] >> 8) & 255u) > 0)) {
                memcpy(to, from, 3 * sizeof(float));
            } else {
                to[0] = to[1] = to[2] = state == VT_PATH_LOST ? 2.0f : 0.0f;
            }
        }
    }
    free(paths);
    return vtCheckGL(&renderer->gl, "reading directions back", error);
}

vtResult vtRenderer_ReadStates(vtRenderer* renderer, uint32_t* states, vtError* error)
{
    const int width = drawnPaths(renderer)->width, height = drawnPaths(renderer)->height;
    uint32_t* paths;
    vtResult result = readPaths(renderer, &paths, error);
    if (result != vt_ok) {
        return result;
    }
    for (int row = 0; row < height; ++row) {
        const uint32_t* from = paths + 4 * (size_t)width * (size_t)(height - 1 - row);
        for (int column = 0; column < width; ++column, from += 4) {
            *states++ = from[3];
        }
    }
    free(paths);
    return vtCheckGL(&renderer->gl, "reading states back", error);
}

vtRendererInfo vtRenderer_Info(const vtRenderer* renderer)
{
    const vtGL* gl = &renderer->gl;
    return (vtRendererInfo){
        .vendor = (const char*)gl->GetString(GL_VENDOR),
        .device = (const char*)gl->GetString(GL_RENDERER),
        .version = (const char*)gl->GetString(GL_VERSION),
        .textureBytes = vtSurfacePass_Bytes(&renderer->surface) + vtPeelPass_Bytes(&renderer->peel) +
                        vtTexture_Bytes(&renderer->merge.depths) + vtRefractPass_Bytes(&renderer->refract) +
                        vtTexture_Bytes(&renderer->shade.radiance) + vtTracePass_Bytes(&renderer->trace) +
                        vtSceneBuffer_TextureBytes(&renderer->scene) +
                        vtEnvironmentBuffer_Bytes(&renderer->environment) +
                        vtAccumulatePass_Bytes(&renderer->accumulate) + vtTexture_Bytes(&renderer->image),
        .meshBytes = renderer->scene.meshBytes,
        .heightBytes = vtHeightTexture_Bytes(&renderer->scene.heights),
        .layerWidth = renderer->peel.depths.width,
        .layerHeight = renderer->peel.depths.height,
    };
}
