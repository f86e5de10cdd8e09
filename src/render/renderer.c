// The whole of a frame, in order: paths and their light (paths.c), then present or, with several samples a
// pixel, accumulate (samples.c), or overlay. Offscreen, window, canvas and a host's framebuffer differ only
// in what the last pass draws to.
#include "render/renderer.h"

#include <stdlib.h>
#include <string.h>

#include "base/about.h"
#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "gl/state.h"
#include "render/object_table.h"
#include "shaders.h"
#include "technique/technique.h"

vtResult vtCreateRenderer(const vtRendererDef* def, vtRenderer** out, vtError* error)
{
    if (out == NULL || def == NULL) {
        return vtFail(error, vt_errorArgument, "renderer: its %s is NULL",
                      out == NULL ? "place" : "definition");
    }
    *out = NULL;
    vtRenderer* renderer = vtAllocateZeroed(1, sizeof *renderer);
    if (renderer == NULL) {
        return vtFail(error, vt_errorMemory, "renderer: out of memory");
    }
    vtResult result = vtLoadGL(def->getProcAddress, &renderer->gl, error);
    if (result != vt_ok) {
        vtFree(renderer);
        return result;
    }
    const vtGL* gl = &renderer->gl;
    renderer->gl.programs = vtProgramStore_Join(def->shares != NULL ? def->shares->gl.programs : NULL);
    if (gl->programs == NULL) {
        vtFree(renderer);
        return vtFail(error, vt_errorMemory, "renderer: out of memory");
    }
    renderer->log = def->log;
    renderer->logData = def->logData;
    vtTakeState(gl);
    renderer->scene.relief = VT_NO_GEOMETRY;
    gl->GenVertexArrays(1, &renderer->emptyVertexArray);
    gl->GenBuffers(1, &renderer->uniformBuffer);
    gl->BindBuffer(GL_UNIFORM_BUFFER, renderer->uniformBuffer);
    gl->BufferData(GL_UNIFORM_BUFFER, sizeof(vtFrameUniforms), NULL, GL_DYNAMIC_DRAW);

    vtEnvironmentBuffer_Create(&renderer->environment, gl);
    vtLeaveState(gl);
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
    vtRenderer_DropTargets(renderer);
    vtHostPicture_Destroy(&renderer->host, gl);
    vtSceneBuffer_Destroy(&renderer->scene, gl);
    vtSlots_Destroy(&renderer->geometrySlots);
    vtSlots_Destroy(&renderer->instanceSlots);
    vtEnvironmentBuffer_Destroy(&renderer->environment, gl);
    vtTexture_Destroy(&renderer->background, gl);
    vtTexture_Destroy(&renderer->backdropPicture, gl);
    gl->DeleteBuffers(1, &renderer->uniformBuffer);
    gl->DeleteVertexArrays(1, &renderer->emptyVertexArray);
    vtProgramStore_Leave(gl->programs, gl);
    vtFree(renderer);
}

vtResult vtRenderer_SetLaterShaders(vtRenderer* renderer, const char* file, vtError* error)
{
    if (strcmp(file, VT_LATER_MARK) != 0) {
        return vtFail(error, vt_errorFormat,
                      "vitrine-shaders.txt is not of the same build as vitrine-core.wasm; serve the two that "
                      "came together");
    }
    renderer->gl.laterShaders = file + strlen(file) + 1;
    return vtSucceed(error);
}

void vtRenderer_DropTargets(vtRenderer* renderer)
{
    const vtGL* gl = &renderer->gl;
    vtSurfacePass_Destroy(&renderer->surface, gl);
    vtPeelPass_Destroy(&renderer->peel, gl);
    vtMergePass_Destroy(&renderer->merge, gl);
    vtRefractPass_Destroy(&renderer->refract, gl);
    vtShadePass_Destroy(&renderer->shade, gl);
    vtTracePass_Destroy(&renderer->trace, gl);
    vtAccumulatePass_Destroy(&renderer->accumulate, gl);
    vtGroundBuffer_Destroy(&renderer->ground.buffer, gl);
    vtEnvironmentBuffer_DropLight(&renderer->environment, gl);
    vtSceneBuffer_DropTables(&renderer->scene, gl);
    vtDestroyFramebuffers(gl, &renderer->imageFramebuffer, 1);
    vtTexture_Destroy(&renderer->image, gl);
    vtForgetDrawn(renderer);
}

vtResult vtRenderer_CheckDrawn(vtRenderer* renderer, const char* doing, vtError* error)
{
    const vtResult result = vtCheckGL(&renderer->gl, doing, error);
    if (result != vt_ok) {
        vtRenderer_DropTargets(renderer);
    }
    return result;
}

static void drawStraight(vtRenderer* renderer, const vtFrame* frame)
{
    const vtGL* gl = &renderer->gl;
    vtRenderer_UploadSample(renderer, 0, 1);
    vtRenderer_DrawPaths(renderer, frame, true);
    if (vtFrame_IsOverlay(frame)) {
        vtRenderer_DrawOverlay(renderer, frame, vtRenderer_Light(renderer));
    } else {
        vtPresentPass_Draw(&renderer->present, gl,
                           &(vtPresentInputs){.paths = vtRenderer_Paths(renderer),
                                              .radiance = vtRenderer_Light(renderer),
                                              .layerDepths = &renderer->peel.depths,
                                              .layerNormals = &renderer->peel.normals,
                                              .behind = vtRenderer_Behind(renderer, frame)},
                           frame->framebuffer, frame->x, frame->y, frame->width, frame->height);
    }
    vtEndStage(frame, "present");
    renderer->accumulate.count = 0;
    renderer->sampleEnd = frame->output == vt_outputPicture;
}

vtResult vtRenderer_Prepare(vtRenderer* renderer, const vtFrame* asked, bool* ready, vtError* error)
{
    vtFrame frame;
    vtCamera camera;
    vtProgramList programs = {0};
    vtResult result = vtCheckGiven(renderer, ready, VT_ABOUT("where to tell that it is ready"), error);
    if (result != vt_ok) {
        return result;
    }
    *ready = false;
    result = vtRenderer_ResolveFrame(renderer, asked, &frame, &camera, error);
    if (result == vt_ok) {
        vtRenderer_StartPrograms(renderer, &frame, &programs);
        *ready = vtProgramList_IsReady(&programs, &renderer->gl);
        vtLeaveState(&renderer->gl);
    }
    return result;
}

/// What falls on the ground, where that is seen and has changed.
static vtResult drawGround(vtRenderer* renderer, const vtFrame* frame, vtError* error)
{
    if (!vtRenderer_ShowsGround(renderer, frame) || !vtGroundPass_IsStale(&renderer->ground, frame)) {
        renderer->ground.isFresh = false;
        return vt_ok;
    }
    vtRenderer_UploadSample(renderer, 0, 1);
    renderer->gl.BindVertexArray(renderer->emptyVertexArray);
    return vtGroundPass_Draw(&renderer->ground, &renderer->gl, &renderer->scene, &renderer->environment,
                             frame, error);
}

/// Are the samples of the frame before another moment of the same picture?
static bool movesOn(const vtRenderer* renderer, const vtFrame* frame)
{
    const vtFrame* before = &renderer->frame;
    return frame->moving && frame->firstSample > 0 && frame->output == vt_outputPicture &&
           frame->width == before->width && frame->height == before->height &&
           frame->technique == before->technique;
}

static vtResult drawFrame(vtRenderer* renderer, const vtFrame* asked, vtError* error)
{
    vtFrame resolved;
    vtCamera camera;
    const vtFrame* frame = &resolved;
    vtResult result = vtRenderer_ResolveFrame(renderer, asked, &resolved, &camera, error);
    if (result != vt_ok) {
        return result;
    }
    const vtGL* gl = &renderer->gl;
    const GLuint hidden = vtFrame_IsOverlay(frame) || vtFrame_HasHost(frame) ? frame->hostDepth : 0;
    vtHostPicture_Set(&renderer->host, gl, frame->hostColor, hidden, frame->hostLevels);
    renderer->nearIsGreater = camera.clip[camera.orthographic ? 0 : 1] > 0.0f;
    vtFrameUniforms uniforms;
    vtProgramList programs = {0};
    vtMakeUniforms(&renderer->scene, frame, &camera, renderer->environment.kind, &uniforms);
    if (vtRenderer_ShowsBackdrop(renderer, frame)) {
        const vtTexture* picture = &renderer->backdropPicture;
        renderer->backdropPlace =
            vtPlaceBackdrop(&renderer->backdrop, picture->width, picture->height, frame, &camera,
                            renderer->scene.glassMin, renderer->scene.glassMax, renderer->scene.space.unit);
    }
    vtRenderer_StartPrograms(renderer, frame, &programs);
    result = vtRenderer_ResizeTargets(renderer, frame, uniforms.size[2], uniforms.size[3], error);
    if (result == vt_ok) {
        result = vtProgramList_Finish(&programs, gl, error);
    }
    result = result == vt_ok ? vtCheckFrame(gl, "preparing the frame", error) : result;
    const int movingEnd = movesOn(renderer, frame) ? renderer->movingEnd : 0;
    int sampleEnd = renderer->sampleEnd;
    renderer->sampleEnd = renderer->movingEnd = 0; // should something fail
    if (result != vt_ok) {
        return result;
    }
    const bool goesOn = vtRenderer_KeepFrame(renderer, frame, &uniforms) && frame->firstSample > 0;
    vtSceneBuffer_SortGlass(&renderer->scene, camera.eye);
    vtWriteObjectTable(&renderer->scene, frame, &camera);
    const bool sameTable = !vtSceneBuffer_SetTable(&renderer->scene, gl);
    sampleEnd = movingEnd > 0 ? movingEnd : goesOn && sameTable ? sampleEnd : 0;
    renderer->ground.isStale = renderer->ground.isStale || !sameTable;
    result = drawGround(renderer, frame, error);
    if (result != vt_ok) {
        return result;
    }
    vtEndStage(frame, "prepare");
    if (vtFrame_AddsSamples(frame)) {
        vtRenderer_DrawSamples(renderer, frame, sampleEnd);
    } else {
        drawStraight(renderer, frame);
    }
    renderer->movingEnd = renderer->sampleEnd;
    vtLeaveState(gl);
    return vtCheckFrame(gl, "drawing the frame", error);
}

vtResult vtRenderer_Draw(vtRenderer* renderer, const vtFrame* frame, vtError* error)
{
    const vtResult result = drawFrame(renderer, frame, error);
    if (result == vt_errorContext || result == vt_errorMemory) {
        vtRenderer_DropTargets(renderer);
    }
    return result;
}

vtRendererInfo vtRenderer_Info(const vtRenderer* renderer)
{
    if (renderer == NULL) {
        return (vtRendererInfo){.vendor = "", .device = "", .version = ""};
    }
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
                        vtAccumulatePass_Bytes(&renderer->accumulate) + vtTexture_Bytes(&renderer->image) +
                        vtTexture_Bytes(&renderer->background) + vtTexture_Bytes(&renderer->backdropPicture),
        .meshBytes = vtGeometryStore_MeshBytes(&renderer->scene.geometry),
        .heightBytes = vtGeometryStore_HeightBytes(&renderer->scene.geometry),
        .layerWidth = renderer->peel.depths.width,
        .layerHeight = renderer->peel.depths.height,
    };
}
