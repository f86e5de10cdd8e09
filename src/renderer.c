// The whole of a frame, in order: surface, peel, cube, merge, refract, shade, present; with several samples a
// pixel, accumulate in place of present. Each pass reads the targets of those before it and writes its own;
// offscreen, window and canvas differ only in the framebuffer that present draws to.
#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "gl/bvh_buffer.h"
#include "gl/scene_buffer.h"
#include "layout.h"
#include "passes/accumulate.h"
#include "passes/cube.h"
#include "passes/merge.h"
#include "passes/peel.h"
#include "passes/present.h"
#include "passes/refract.h"
#include "passes/shade.h"
#include "passes/surface.h"
#include "uniforms.h"

struct vtRenderer {
    vtGL gl;
    GLuint uniformBuffer;
    GLuint emptyVertexArray; // for passes that draw the viewport's triangle
    vtSurfacePass surface;
    vtPeelPass peel;
    vtMergePass merge;
    vtCubePass cube;
    vtRefractPass refract;
    vtShadePass shade;
    vtPresentPass present;
    vtAccumulatePass accumulate;
    // The scene.
    vtSceneBuffer scene;
    vtLayout layout; // what the cubes hold
    vtBvhBuffer bvh; // of the one mesh, once `bvh` has been drawn
    vtEnvironmentKind environment;
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

static vtResult createPasses(vtRenderer* renderer, vtError* error)
{
    const vtGL* gl = &renderer->gl;
    vtResult result = vtSurfacePass_Create(&renderer->surface, gl, error);
    if (result == vt_ok) {
        result = vtMergePass_Create(&renderer->merge, gl, error);
    }
    if (result == vt_ok) {
        result = vtCubePass_Create(&renderer->cube, gl, error);
    }
    if (result == vt_ok) {
        result = vtShadePass_Create(&renderer->shade, gl, error);
    }
    if (result == vt_ok) {
        result = vtPresentPass_Create(&renderer->present, gl, error);
    }
    return result;
}

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

    result = createPasses(renderer, error);
    if (result == vt_ok) {
        result = vtCheckGL(gl, "creating the renderer", error);
    }
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
    vtCubePass_Destroy(&renderer->cube, gl);
    vtRefractPass_Destroy(&renderer->refract, gl);
    vtShadePass_Destroy(&renderer->shade, gl);
    vtPresentPass_Destroy(&renderer->present, gl);
    vtAccumulatePass_Destroy(&renderer->accumulate, gl);
    vtSceneBuffer_Destroy(&renderer->scene, gl);
    vtDestroyLayout(&renderer->layout);
    vtBvhBuffer_Destroy(&renderer->bvh, gl);
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
    vtDestroyLayout(&renderer->layout);
    vtBvhBuffer_Destroy(&renderer->bvh, &renderer->gl);
    return vtSucceed(error);
}

vtResult vtRenderer_SetMesh(vtRenderer* renderer, const vtMesh* mesh, vtError* error)
{
    vtBorrowedMesh borrowed;
    return vtRenderer_SetScene(renderer, vtBorrowMesh(mesh, &borrowed), error);
}

vtResult vtRenderer_SetEnvironment(vtRenderer* renderer, const vtEnvironment* environment, vtError* error)
{
    vtResult result = vtShadePass_SetEnvironment(&renderer->shade, &renderer->gl, environment, error);
    if (result == vt_ok) {
        renderer->environment = environment->kind;
        renderer->sampleEnd = 0;
    }
    return result;
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

/// Sets of path targets: the branches' two, in turns, beside the pixels' own.
static int pathSets(const vtFrame* frame)
{
    const int branches = vtFrame_BranchCount(frame);
    return 1 + (branches < 2 ? branches : 2);
}

static bool hasOpaque(const vtRenderer* renderer)
{
    return renderer->scene.objectCount > renderer->scene.glassCount;
}

static bool onlyRelief(const vtRenderer* renderer)
{
    bool only = true;
    for (uint32_t i = 0; i < renderer->scene.objectCount; ++i) {
        only = only && vtSceneBuffer_HasHeights(&renderer->scene, i);
    }
    return only;
}

static vtSurfaceKind chooseSurfaceKind(const vtFrame* frame)
{
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    return row->heights ? vt_surfaceHeights : row->innerDistances ? vt_surfaceDistances : vt_surfacePlain;
}

static vtResult resizeTargets(vtRenderer* renderer, const vtFrame* frame, int layerWidth, int layerHeight,
                              vtError* error)
{
    const vtGL* gl = &renderer->gl;
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    const int layers = vtFrame_LayerCount(frame);
    const vtPeelKind kind = choosePeelKind(frame);
    const int sets =
        kind == vt_peelEachObject && renderer->scene.glassCount > 0 ? (int)renderer->scene.glassCount : 1;
    const vtVariant variant = vtFrame_Variant(frame, hasOpaque(renderer), onlyRelief(renderer));
    vtResult result = vt_ok;
    if (row->surface) {
        result = vtSurfacePass_Resize(&renderer->surface, gl, frame->width, frame->height,
                                      chooseSurfaceKind(frame), error);
    }
    if (result == vt_ok) {
        result = vtRefractPass_Resize(&renderer->refract, gl, frame->width, frame->height,
                                      vtVariant_IsOrdered(variant) ? 2 : pathSets(frame),
                                      row->surface ? &renderer->surface.depth : NULL, error);
    }
    if (result == vt_ok && layers > 0) {
        result = vtPeelPass_Resize(&renderer->peel, gl, layerWidth, layerHeight, layers, sets, error);
    }
    if (result == vt_ok && layers > 0) {
        result = vtPeelPass_Prepare(&renderer->peel, gl, kind, error);
    }
    if (result == vt_ok && row->merge) {
        result = vtMergePass_Resize(&renderer->merge, gl, layerWidth, layerHeight, layers, sets, error);
    }
    if (result == vt_ok) {
        result = vtRefractPass_Prepare(&renderer->refract, gl, frame->technique, variant, frame->countReads,
                                       vtFrame_BranchCount(frame) > 0, error);
    }
    if (result == vt_ok) {
        result = vtShadePass_Prepare(&renderer->shade, gl, frame->width, frame->height, hasOpaque(renderer),
                                     row->surface, vtFrame_BranchCount(frame) > 0, error);
    }
    return result;
}

/// Layers of meshes that have changed or are not there yet.
static vtResult drawCubes(vtRenderer* renderer, const vtFrame* frame, vtError* error)
{
    const vtGL* gl = &renderer->gl;
    vtLayout layout;
    vtResult result = vtCreateLayout(&renderer->scene, frame, &layout, error);
    if (result != vt_ok) {
        return result;
    }
    bool changed = false;
    if (layout.slotCount > 0) {
        result = vtCubePass_Resize(&renderer->cube, gl, frame->cubeSize, vtFrame_CubeLayers(frame),
                                   frame->layerSource == vt_layersFromEye ? 1 : 3, layout.slotCount, &changed,
                                   error);
    }
    if (result != vt_ok) {
        vtDestroyLayout(&layout);
        return result;
    }
    renderer->sampleEnd =
        vtSceneBuffer_SetTable(&renderer->scene, gl, layout.words) ? 0 : renderer->sampleEnd;
    // A technique without cubes leaves those of another as they are.
    const bool isDrawn =
        !changed && (layout.slotCount == 0 || vtLayout_SameSlots(&layout, &renderer->layout));
    if (!isDrawn) {
        gl->BindVertexArray(renderer->emptyVertexArray);
        for (int slot = 0; slot < layout.slotCount; ++slot) {
            vtCubePass_Draw(&renderer->cube, gl, &renderer->scene.triangles, slot, &layout.slots[slot]);
        }
    }
    if (layout.slotCount > 0) {
        vtDestroyLayout(&renderer->layout);
        renderer->layout = layout;
    } else {
        vtDestroyLayout(&layout);
    }
    if (!isDrawn) {
        endStage(frame, "cube");
    }
    return vt_ok;
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

#ifdef VT_WITH_BVH
/// The hierarchy, where the frame's technique walks one and it is not there.
static vtResult prepareBvh(vtRenderer* renderer, const vtFrame* frame, vtError* error)
{
    const vtSceneBuffer* scene = &renderer->scene;
    if (!vtTechnique_Row(frame->technique)->bvh || renderer->bvh.nodes.name != 0) {
        return vt_ok;
    }
    if (scene->objectCount != 1) {
        return vtFail(error, vt_errorArgument,
                      "technique 'bvh' draws one object; this scene has %u, use exact", scene->objectCount);
    }
    const vtObjectBuffer* object = &scene->objects[0];
    vtResult result = vtBvhBuffer_Create(&renderer->bvh, &renderer->gl, &scene->triangles,
                                         (uint32_t)scene->meshes[object->mesh].indexCount / 3, object->ownMin,
                                         object->ownMax, error);
    endStage(frame, "bvh");
    return result;
}
#endif

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
            vtSurfacePass_Draw(&renderer->surface, gl, scene, object, object + 1, vt_surfacePlain,
                               renderer->emptyVertexArray);
            gl->BindVertexArray(renderer->emptyVertexArray);
            endStage(frame, "surface");
        }
        vtRefractPass_DrawOrdered(&renderer->refract, gl, frame->technique, variant, inputs, object,
                                  count - 1 - i);
        endStage(frame, "refract");
    }
    if (count > 1) {
        vtSurfacePass_Draw(&renderer->surface, gl, scene, 0, count, vt_surfacePlain,
                           renderer->emptyVertexArray);
        gl->BindVertexArray(renderer->emptyVertexArray);
        endStage(frame, "surface");
    }
}

/// Everything up to the light, with the uniform block that was uploaded.
static void drawPaths(vtRenderer* renderer, const vtFrame* frame, bool layersToo)
{
    const vtGL* gl = &renderer->gl;
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    const vtVariant variant = vtFrame_Variant(frame, hasOpaque(renderer), onlyRelief(renderer));
    if (row->surface) {
        vtSurfacePass_Draw(&renderer->surface, gl, &renderer->scene, 0, renderer->scene.glassCount,
                           chooseSurfaceKind(frame), renderer->emptyVertexArray);
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
#ifdef VT_WITH_BVH
    if (row->bvh) { // VT_BVH_SAMPLERS in technique.c
        vtTexture_Bind(&renderer->bvh.nodes, gl, 11);
        vtTexture_Bind(&renderer->bvh.triangles, gl, 12);
    }
#endif
    const vtRefractInputs inputs = {.surface = &renderer->surface.attributes,
                                    .innerDistances = &renderer->surface.distances,
                                    .layerDepths = &renderer->peel.depths,
                                    .layerNormals = &renderer->peel.normals,
                                    .mergedDepths = &renderer->merge.depths,
                                    .cubeSurfaces = &renderer->cube.surfaces,
                                    .cubeTriangles = &renderer->cube.triangles,
                                    .intervals = &renderer->cube.intervals,
                                    .triangles = &renderer->scene.triangles,
                                    .cubeColumns = &renderer->cube.columns,
                                    .objects = &renderer->scene.table,
                                    .heights = &renderer->scene.heights,
                                    .countReads = frame->countReads};
    const int branches = vtFrame_BranchCount(frame);
    const vtPathTargets* paths = NULL;
    for (int branch = 0; branch <= branches; ++branch) {
        const int set = branch == 0 ? 0 : 1 + (branch - 1) % 2;
        if (vtVariant_IsOrdered(variant)) {
            drawOrdered(renderer, frame, variant, &inputs);
        } else {
            vtRefractPass_Draw(&renderer->refract, gl, frame->technique, variant, &inputs, set, paths);
            endStage(frame, "refract");
        }
        paths = &renderer->refract.targets[set];
        if (frame->output == vt_outputPicture) {
            vtShadePass_Draw(&renderer->shade, gl,
                             &(vtShadeInputs){.paths = paths,
                                              .branch = branch,
                                              .branches = branches - branch,
                                              .surface = row->surface ? &renderer->surface.attributes : NULL,
                                              .scene = &renderer->scene,
                                              .cube = &renderer->cube});
            endStage(frame, "shade");
        }
    }
}

/// Where drawPaths has left the light.
static const vtTexture* drawnLight(const vtRenderer* renderer, const vtFrame* frame)
{
    return vtShadePass_Light(&renderer->shade, vtFrame_BranchCount(frame));
}

static void drawStraight(vtRenderer* renderer, const vtFrame* frame)
{
    const vtGL* gl = &renderer->gl;
    uploadSample(renderer, 0, 1);
    drawPaths(renderer, frame, true);
    vtPresentPass_Draw(&renderer->present, gl,
                       &(vtPresentInputs){.paths = &renderer->refract.targets[0].paths,
                                          .radiance = drawnLight(renderer, frame),
                                          .layerDepths = &renderer->peel.depths,
                                          .layerNormals = &renderer->peel.normals},
                       frame->framebuffer, frame->width, frame->height);
    endStage(frame, "present");
    renderer->accumulate.count = 0;
    renderer->sampleEnd = frame->output == vt_outputPicture;
}

static void addSample(vtRenderer* renderer, const vtFrame* frame)
{
    vtAccumulatePass_Add(&renderer->accumulate, &renderer->gl, drawnLight(renderer, frame));
}

/// `sampleEnd`: of the frame before, if this one goes on with it, else 0.
static vtResult drawSamples(vtRenderer* renderer, const vtFrame* frame, int sampleEnd, vtError* error)
{
    const vtGL* gl = &renderer->gl;
    vtAccumulatePass* accumulate = &renderer->accumulate;
    vtResult result = vtAccumulatePass_Prepare(accumulate, gl, frame->width, frame->height, error);
    if (result != vt_ok) {
        return result;
    }
    gl->BindVertexArray(renderer->emptyVertexArray);
    if (sampleEnd == 0) {
        accumulate->count = 0;
    } else if (accumulate->count == 0) { // sample 0 was drawn straight, and its light is still there
        addSample(renderer, frame);
    }
    bool layersToo = sampleEnd == 0;
    const int end = frame->firstSample + frame->samples;
    for (int i = frame->firstSample > sampleEnd ? frame->firstSample : sampleEnd; i < end; ++i) {
        uploadSample(renderer, i, accumulate->count + 1);
        drawPaths(renderer, frame, layersToo);
        addSample(renderer, frame);
        // Fitted to the object, the layers stay the same for every sample: a third less time, and 0.2 to 0.4
        // dB further from the reference than with layers that move too (knot, bunny, 16 samples).
        layersToo = vtTechnique_Row(frame->technique)->layerSpace == vt_layersOfPicture;
        sampleEnd = i + 1;
    }
    uploadSample(renderer, 0, accumulate->count); // should there have been no sample left to draw
    vtAccumulatePass_Show(accumulate, gl, frame->framebuffer);
    renderer->sampleEnd = sampleEnd;
    return vt_ok;
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

vtResult vtRenderer_Draw(vtRenderer* renderer, const vtFrame* asked, vtError* error)
{
    assert(renderer->scene.objectCount > 0 && "set a scene before drawing");
    vtResult result = vtValidateFrame(asked, error);
    if (result != vt_ok) {
        return result;
    }
    vtFrame resolved = vtResolveFrame(asked);
    if (resolved.technique == vt_techniqueHeightField && renderer->scene.heights.cell == 0.0f) {
        resolved.technique = vt_techniqueExact; // the same without a relief
    }
    const vtFrame* frame = &resolved;
    const vtGL* gl = &renderer->gl;
    result = checkMeshes(&renderer->scene, vtTechnique_Row(frame->technique), error);
    if (result != vt_ok) {
        return result;
    }
    vtFrameUniforms uniforms;
    const bool sameRest = renderer->technique == frame->technique &&
                          renderer->backSurface == frame->backSurface && renderer->multi == frame->multi &&
                          renderer->search == frame->search &&
                          renderer->branches == vtFrame_BranchCount(frame);
    renderer->sampleEnd = frame->firstSample > 0 && sameRest ? renderer->sampleEnd : 0;
    vtMakeUniforms(&renderer->scene, frame, renderer->environment, &uniforms);
    result = resizeTargets(renderer, frame, uniforms.size[2], uniforms.size[3], error);
    result = result == vt_ok ? vtCheckGL(gl, "preparing the frame", error) : result;
    if (result != vt_ok) {
        return result;
    }
    const bool goesOn = memcmp(&uniforms, &renderer->uniforms, sizeof uniforms) == 0;
    renderer->uniforms = uniforms;
    renderer->technique = frame->technique;
    renderer->backSurface = frame->backSurface;
    renderer->multi = frame->multi;
    renderer->search = frame->search;
    renderer->branches = vtFrame_BranchCount(frame);
    vtSceneBuffer_SortGlass(&renderer->scene, frame->view.eye);

    endStage(frame, "prepare");
#ifdef VT_WITH_BVH
    result = prepareBvh(renderer, frame, error);
    if (result != vt_ok) {
        return result;
    }
#endif
    resetState(gl);
    uploadSample(renderer, 0, 1); // cubes need their sizes
    result = drawCubes(renderer, frame, error);
    if (result != vt_ok) {
        return result;
    }
    const int sampleEnd = renderer->sampleEnd;
    renderer->sampleEnd = 0; // should something fail
    if (frame->output != vt_outputPicture || frame->firstSample + frame->samples == 1) {
        drawStraight(renderer, frame);
    } else {
        result = drawSamples(renderer, frame, goesOn ? sampleEnd : 0, error);
    }
    gl->BindVertexArray(0);
    return result == vt_ok ? vtCheckGL(gl, "drawing the frame", error) : result;
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
    const int width = renderer->refract.targets[0].paths.width,
              height = renderer->refract.targets[0].paths.height;
    assert(width > 0 && "draw a frame before reading its directions");
    *paths = malloc(16 * (size_t)width * (size_t)height);
    if (*paths == NULL) {
        return vtFail(error, vt_errorMemory, "directions: out of memory for %d x %d pixels", width, height);
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, renderer->refract.framebuffers[0]);
    gl->ReadPixels(0, 0, width, height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, *paths);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    return vt_ok;
}

vtResult vtRenderer_ReadDirections(vtRenderer* renderer, float* directions, vtError* error)
{
    const int width = renderer->refract.targets[0].paths.width,
              height = renderer->refract.targets[0].paths.height;
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
    const int width = renderer->refract.targets[0].paths.width,
              height = renderer->refract.targets[0].paths.height;
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
                        vtTexture_Bytes(&renderer->merge.depths) + vtCubePass_Bytes(&renderer->cube) +
                        vtTexture_Bytes(&renderer->bvh.nodes) + vtTexture_Bytes(&renderer->bvh.triangles) +
                        vtSceneBuffer_TextureBytes(&renderer->scene) +
                        vtRefractPass_Bytes(&renderer->refract) + vtShadePass_Bytes(&renderer->shade) +
                        vtAccumulatePass_Bytes(&renderer->accumulate) + vtTexture_Bytes(&renderer->image),
        .meshBytes = renderer->scene.meshBytes,
        .heightBytes = vtHeightTexture_Bytes(&renderer->scene.heights),
        .layerWidth = renderer->peel.depths.width,
        .layerHeight = renderer->peel.depths.height,
    };
}
