// What the page and the element call, one viewer a canvas. Whoever made the context makes it current before
// each call. A call that can fail returns the sentence of its vtError, or NULL; what was shown before
// then stays. Bytes handed over from JavaScript are freed here.
#include "core/viewer.h"

#include <emscripten.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/math.h"
#include "render/renderer.h"
#include "technique/settings.h"
#include "technique/technique.h"

static const char* sentence(const vtViewer* viewer, vtResult result)
{
    return result == vt_ok ? NULL : viewer->error.message;
}

EMSCRIPTEN_KEEPALIVE vtViewer* vtViewer_Create(int width, int height, const vtViewer* other)
{
    vtViewer* viewer = calloc(1, sizeof *viewer);
    if (viewer != NULL) {
        viewer->lowest = NAN;
        viewer->frame = vtDefaultFrame();
        viewer->frame.width = width;
        viewer->frame.height = height;
        viewer->wanted = viewer->frame;
        viewer->sample = VT_MAX_SAMPLES; // nothing to draw yet
        // On the web GL is linked.
        const vtRendererDef def = {.shares = other != NULL ? other->renderer : NULL};
        vtCreateRenderer(&def, &viewer->renderer, &viewer->error);
    }
    return viewer;
}

EMSCRIPTEN_KEEPALIVE void vtViewer_Destroy(vtViewer* viewer)
{
    if (viewer != NULL) {
        vtDestroyRenderer(viewer->renderer);
        vtDestroyTracer(viewer->tracer);
        vtDestroyScene(&viewer->scene);
        vtMotion_Clear(&viewer->motion);
        vtViewer_Begin(viewer);
        vtDestroyMesh(&viewer->kept.unit);
        free(viewer->image);
        free(viewer);
    }
}

/// The sentence of the call that failed last; empty where none did.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_Error(const vtViewer* viewer)
{
    return viewer->error.message;
}

static vtResult showEnvironment(vtViewer* viewer, vtEnvironment* environment)
{
    vtResult result = vtRenderer_SetEnvironment(viewer->renderer, environment, &viewer->error);
    vtDestroyEnvironment(environment);
    viewer->changed |= result == vt_ok;
    return result;
}

/// A built-in environment by name.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_SetEnvironment(vtViewer* viewer, const char* name)
{
    vtEnvironment environment;
    vtResult result = vtCreateEnvironment(name, &environment, &viewer->error);
    return sentence(viewer, result == vt_ok ? showEnvironment(viewer, &environment) : result);
}

/// The contents of an equirectangular .hdr.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_OpenEnvironment(vtViewer* viewer, uint8_t* bytes, size_t size,
                                                          const char* name)
{
    vtEnvironment environment;
    vtResult result =
        vtLoadEnvironmentWithin(bytes, size, name, vtViewer_Limits(viewer), &environment, &viewer->error);
    free(bytes);
    return sentence(viewer, result == vt_ok ? showEnvironment(viewer, &environment) : result);
}

/// An equirectangular picture that the browser has decoded, RGBA, top row first.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_OpenPicture(vtViewer* viewer, uint8_t* pixels, int width,
                                                      int height, const char* name)
{
    vtEnvironment environment;
    vtResult result = vtViewer_CheckPicture(viewer, name, width, height);
    if (result == vt_ok) {
        result = vtCreateImageEnvironment(pixels, width, height, name, &environment, &viewer->error);
    }
    free(pixels);
    return sentence(viewer, result == vt_ok ? showEnvironment(viewer, &environment) : result);
}

/// A picture for the background that the browser has decoded, RGBA, top row first.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_BackgroundPicture(vtViewer* viewer, uint8_t* pixels, int width,
                                                            int height, const char* name)
{
    const vtImage picture = {.pixels = pixels, .width = width, .height = height};
    vtResult result = vtViewer_CheckPicture(viewer, name, width, height);
    if (result == vt_ok) {
        result = vtRenderer_SetBackground(viewer->renderer, &picture, &viewer->error);
    }
    free(pixels);
    viewer->changed |= result == vt_ok;
    return sentence(viewer, result);
}

/// What is behind the scene, for vtViewer_SetGlass: a vtBackground, and the colour; until the picture has
/// come, the page.
EMSCRIPTEN_KEEPALIVE void vtViewer_SetBackground(vtViewer* viewer, int background, float red, float green,
                                                 float blue)
{
    const bool isLate = background == vt_backgroundPicture && viewer->renderer->background.name == 0;
    viewer->wanted.background = isLate ? vt_backgroundTransparent : (vtBackground)background;
    viewer->wanted.backgroundColor = (vtVec3){red, green, blue};
}

/// Takes a frame over if it is valid and its technique has what it needs.
static vtResult showFrame(vtViewer* viewer, const vtFrame* frame)
{
    vtResult result = vtValidateFrame(frame, &viewer->error);
    if (result == vt_ok) {
        result = vtViewer_PrepareScene(viewer, frame->technique);
    }
    if (result == vt_ok) {
        viewer->frame = *frame;
        viewer->changed = true;
    }
    return result;
}

/// A setting, not a vector, by its name in the table of settings; vtViewer_SetGlass takes it over.
EMSCRIPTEN_KEEPALIVE void vtViewer_Set(vtViewer* viewer, const char* name, double value)
{
    vtSetting_Set(vtFindSetting(name), &viewer->wanted, value);
}

#if VT_IS_FULL
static bool same(vtVec3 a, vtVec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// A ground at the scene's lowest point (at rest), or none; the rest as vtGround has it.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_SetGround(vtViewer* viewer, bool isThere, float intensity,
                                                    float softness, bool matt, float red, float green,
                                                    float blue, float sunX, float sunY, float sunZ,
                                                    float sunSize, float sunRed, float sunGreen,
                                                    float sunBlue)
{
    vtGround ground = vtDefaultGround();
    ground.height = viewer->lowest;
    ground.shadowIntensity = intensity;
    ground.shadowSoftness = softness;
    ground.matt = matt;
    ground.color = (vtVec3){red, green, blue};
    ground.sunDirection = (vtVec3){sunX, sunY, sunZ};
    ground.sunSize = sunSize;
    ground.sunColor = (vtVec3){sunRed, sunGreen, sunBlue};
    const vtGround* now = &viewer->renderer->ground.ground;
    if (viewer->renderer->ground.isThere == isThere &&
        (!isThere ||
         ((now->height == ground.height || (isnan(now->height) && isnan(ground.height))) &&
          now->shadowIntensity == intensity && now->shadowSoftness == softness && now->matt == matt &&
          same(now->color, ground.color) && same(now->sunDirection, ground.sunDirection) &&
          now->sunSize == sunSize && same(now->sunColor, ground.sunColor)))) {
        return NULL; // what falls on it is kept
    }
    viewer->changed = true;
    return sentence(viewer, vtRenderer_SetGround(viewer->renderer, isThere ? &ground : NULL, &viewer->error));
}
#endif

/// Draws with what vtViewer_Set was told and a technique by its id, empty: the scene decides. A layer beyond
/// those there are is the last one. With `lessened` it is drawn with no more than preset low asks for.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_SetGlass(vtViewer* viewer, const char* technique, bool lessened)
{
    vtFrame frame = viewer->wanted;
    frame.view = viewer->frame.view;
    frame.width = viewer->frame.width;
    frame.height = viewer->frame.height;
    frame.technique = *technique == '\0' ? vtViewer_UsualTechnique(viewer) : vtFindTechnique(technique);
    if (frame.technique == vt_techniqueCount) {
        return sentence(viewer, vtFail(&viewer->error, vt_errorArgument, "technique '%s' is not in the table",
                                       technique));
    }
    frame.layer = 0;
    vtResult result = vtValidateFrame(&frame, &viewer->error);
    if (result == vt_ok) {
        if (lessened) {
            vtFrame_Lessen(&frame, vt_presetLow);
        }
        const int last = vtFrame_LayerCount(&frame) - 1;
        const int layer = viewer->wanted.layer < last ? viewer->wanted.layer : last;
        frame.layer = last >= 0 ? layer : 0;
        result = showFrame(viewer, &frame);
    }
    return sentence(viewer, result);
}

EMSCRIPTEN_KEEPALIVE const char* vtViewer_SetView(vtViewer* viewer, float eyeX, float eyeY, float eyeZ,
                                                  float targetX, float targetY, float targetZ, float fovY)
{
    vtFrame frame = viewer->frame;
    frame.view = (vtView){{eyeX, eyeY, eyeZ}, {targetX, targetY, targetZ}, fovY};
    return sentence(viewer, showFrame(viewer, &frame));
}

/// Turns the eye about the object, radians.
EMSCRIPTEN_KEEPALIVE void vtViewer_Orbit(vtViewer* viewer, float yaw, float pitch)
{
    viewer->frame.view = vtView_Orbit(viewer->frame.view, yaw, pitch);
    viewer->changed = true;
}

/// Moves the eye towards (factor < 1) or away from the object, within a tenth and ten times its size.
EMSCRIPTEN_KEEPALIVE void vtViewer_Zoom(vtViewer* viewer, float factor)
{
    vtVec3 low, high;
    vtScene_Bounds(&viewer->scene, &low, &high);
    float size = vtLength(vtSub(high, low));
    float distance = vtLength(vtSub(viewer->frame.view.eye, viewer->frame.view.target));
    float wanted = vtClamp(distance * factor, 0.1f * size, 10.0f * size);
    viewer->frame.view = vtView_Zoom(viewer->frame.view, wanted / distance);
    viewer->changed = true;
}

/// The canvas has width x height pixels at the next tick.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_Resize(vtViewer* viewer, int width, int height)
{
    vtFrame frame = viewer->frame;
    frame.width = width;
    frame.height = height;
    return sentence(viewer, showFrame(viewer, &frame));
}

/// What it holds on the GPU.
EMSCRIPTEN_KEEPALIVE double vtViewer_Bytes(const vtViewer* viewer)
{
    const vtRendererInfo info = vtRenderer_Info(viewer->renderer);
    return (double)(info.textureBytes + info.meshBytes);
}

/// Is the last frame asked for to be drawn by shaders that are still to be loaded?
EMSCRIPTEN_KEEPALIVE bool vtViewer_LacksShaders(const vtViewer* viewer)
{
    return viewer->renderer->lacksShaders;
}

/// Those, as vtRenderer_SetLaterShaders has them; the page keeps them.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_SetShaders(vtViewer* viewer, const char* file)
{
    return sentence(viewer, vtRenderer_SetLaterShaders(viewer->renderer, file, &viewer->error));
}

/// Of samples: the frame cannot be drawn.
enum { failed = VT_MAX_SAMPLES + 1 };

EMSCRIPTEN_KEEPALIVE int vtViewer_Tick(vtViewer* viewer)
{
    vtFrame frame = viewer->frame;
    const int sample = viewer->changed ? 0 : viewer->sample;
    if (sample >= (frame.output == vt_outputPicture ? frame.samples : 1)) {
        return 0;
    }
    frame.firstSample = sample;
    frame.samples = 1;
    bool ready = true;
    // Of the programs, the second sample has the last that are new.
    if (sample < 2 && vtRenderer_Prepare(viewer->renderer, &frame, &ready, &viewer->error) == vt_ok &&
        !ready) {
        return 2;
    }
    viewer->changed = false;
    viewer->sample = sample + 1;
    if (vtRenderer_Draw(viewer->renderer, &frame, &viewer->error) != vt_ok) {
        viewer->sample = failed;
        return -1;
    }
    ++viewer->drawCount;
    return 1;
}

/// Has the GPU drawn what vtViewer_Tick asked of it? Asked once it is done, so that it need not be waited
/// for. Where it has not, nothing is drawn until something changes.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_Check(vtViewer* viewer)
{
    const vtResult result =
        vtRenderer_CheckDrawn(viewer->renderer, "drawing; a smaller picture may fit", &viewer->error);
    viewer->sample = result == vt_ok ? viewer->sample : failed;
    return sentence(viewer, result);
}

/// The present view and settings at that size, of at least 16 samples (or all, if those are fewer):
/// 4 * width * height bytes, top row first, valid until the next call; NULL on failure, see vtViewer_Error.
EMSCRIPTEN_KEEPALIVE const uint8_t* vtViewer_Image(vtViewer* viewer, int width, int height)
{
    vtFrame frame = viewer->frame;
    frame.width = width;
    frame.height = height;
    // The canvas's own samples are gone on with; more than some are not worth the wait.
    const bool isCanvas = !viewer->changed && viewer->sample != failed && width == viewer->frame.width &&
                          height == viewer->frame.height;
    const int enough = isCanvas && viewer->sample > 16 ? viewer->sample : 16;
    frame.samples = frame.samples < enough ? frame.samples : enough;
    if (isCanvas && frame.samples > 1) {
        frame.firstSample = 1;
        viewer->sample = frame.samples--;
    } else {
        // The canvas's samples are lost: it starts anew unless it had them all.
        viewer->changed |= viewer->sample < viewer->frame.samples;
    }
    if (vtValidateFrame(&frame, &viewer->error) != vt_ok) {
        return NULL;
    }
    uint8_t* image = realloc(viewer->image, 4 * (size_t)width * (size_t)height);
    if (image == NULL) {
        vtFail(&viewer->error, vt_errorMemory, "picture: out of memory for %d x %d", width, height);
        return NULL;
    }
    viewer->image = image;
    bool drawn = vtRenderer_DrawImage(viewer->renderer, &frame, image, &viewer->error) == vt_ok;
    return drawn ? image : NULL;
}

/// The exact path through a point of the canvas (pixels, from its top left), as JSON: its events, its last
/// direction and, on something opaque, its end; NULL on failure, see vtViewer_Error. Valid until the next
/// call.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_Path(vtViewer* viewer, float x, float y)
{
    vtPath path;
    if (viewer->tracer == NULL && vtCreateTracer(&viewer->scene, &viewer->tracer, &viewer->error) != vt_ok) {
        return NULL;
    }
    if (vtTracer_Path(viewer->tracer, &viewer->frame, x, y, &path, &viewer->error) != vt_ok) {
        return NULL;
    }
    size_t used = 0, size = sizeof viewer->path;
    char* text = viewer->path;
    used += (size_t)snprintf(text, size, "{\"exited\":%s,\"direction\":[%.5g,%.5g,%.5g],\"events\":[",
                             path.exited ? "true" : "false", (double)path.direction.x,
                             (double)path.direction.y, (double)path.direction.z);
    for (int i = 0; i < path.eventCount && used < size; ++i) {
        const vtPathEvent* event = &path.events[i];
        used += (size_t)snprintf(text + used, size - used,
                                 "%s{\"position\":[%.5g,%.5g,%.5g],\"in\":%.2f,\"out\":%.2f,\"kind\":\"%s\"}",
                                 i > 0 ? "," : "", (double)event->position.x, (double)event->position.y,
                                 (double)event->position.z, (double)event->incoming, (double)event->outgoing,
                                 event->reflected ? "reflection" : "refraction");
    }
    used += (size_t)snprintf(text + used, size - used, "]");
    if (path.opaque) {
        used += (size_t)snprintf(text + used, size - used, ",\"end\":[%.5g,%.5g,%.5g]", (double)path.end.x,
                                 (double)path.end.y, (double)path.end.z);
    }
    snprintf(text + used, size - used, "}");
    return text;
}

/// What is shown, as JSON; settings that the preset decides as it decided.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_Info(vtViewer* viewer)
{
    const vtFrame frame = vtResolveFrame(&viewer->frame);
    const vtView* view = &frame.view;
    const vtRendererInfo info = vtRenderer_Info(viewer->renderer);
    const vtSceneFacts facts = vtViewer_SceneFacts(viewer);
    vtVec3 low, high;
    vtScene_Bounds(&viewer->scene, &low, &high);
    snprintf(
        viewer->info, sizeof viewer->info,
        "{\"triangles\":%u,\"openEdges\":%u,\"objects\":%u,\"glassObjects\":%u,\"cameras\":%u,\"images\":%u,"
        "\"layerWidth\":%d,\"layerHeight\":%d,\"drawCount\":%d,"
        "\"technique\":\"%s\",\"preset\":\"%s\",\"ior\":%.6g,\"layers\":%d,\"steps\":%d,\"maxEvents\":%d,"
        "\"branches\":%d,\"wavelengths\":%d,"
        "\"low\":[%.6g,%.6g,%.6g],\"high\":[%.6g,%.6g,%.6g],"
        "\"output\":%d,\"eye\":[%.6g,%.6g,%.6g],\"target\":[%.6g,%.6g,%.6g],\"fov\":%.6g}",
        facts.triangles, facts.openEdges, viewer->scene.objectCount, facts.glassCount,
        viewer->scene.cameraCount, viewer->scene.imageCount, info.layerWidth, info.layerHeight,
        viewer->drawCount, vtTechnique_Info(frame.technique)->id, vtPresetName((int)frame.preset),
        (double)facts.ior, frame.layers, frame.steps, frame.maxEvents, vtFrame_BranchCount(&frame),
        frame.wavelengths, (double)low.x, (double)low.y, (double)low.z, (double)high.x, (double)high.y,
        (double)high.z, (int)frame.output, (double)view->eye.x, (double)view->eye.y, (double)view->eye.z,
        (double)view->target.x, (double)view->target.y, (double)view->target.z, (double)view->fovY);
    return viewer->info;
}
