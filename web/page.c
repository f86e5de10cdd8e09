// The page's half in C: what page.js calls. Each call that can fail returns the sentence of its vtError, or
// NULL; what was shown before then stays. Bytes handed over by the page are freed here.
#include <assert.h>
#include <emscripten.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/math.h"
#include "window.h"

typedef struct vtPage {
    vtWindow* window;
    vtRenderer* renderer;
    vtMesh mesh;   // on the GPU as well; kept for its numbers
    vtFrame frame; // of the canvas
    float share;   // of the canvas's width, in its middle, that no panel covers
    bool changed;  // since the frame drawn last
    int drawCount;
    uint8_t* image; // the last one of vtPage_Image
    vtError error;
    char info[512];
} vtPage;

// The exported calls carry no context: a module instance is one page with one canvas.
static vtPage* page;

static const char* sentence(vtResult result)
{
    return result == vt_ok ? NULL : page->error.message;
}

/// Opens the canvas, width x height pixels, and compiles the shaders. Call once, first; then set a shape and
/// an environment before the first tick.
EMSCRIPTEN_KEEPALIVE const char* vtPage_Start(int width, int height)
{
    assert(page == NULL && "one page a module");
    page = calloc(1, sizeof *page);
    if (page == NULL) {
        return "page: out of memory";
    }
    page->frame = vtDefaultFrame();
    page->frame.width = width;
    page->frame.height = height;
    page->share = 1.0f;
    vtResult result = vtCreateWindow("Vitrine", width, height, &page->window, NULL);
    if (result != vt_ok) {
        vtFail(&page->error, result,
               "page: this browser opens no WebGL 2 context; turn hardware acceleration on or try another "
               "browser");
        return page->error.message;
    }
    vtRendererDef def = {NULL}; // on the web GL is linked; the window's loader would pull in all of it
    return sentence(vtCreateRenderer(&def, &page->renderer, &page->error));
}

/// Frames the whole object, within the canvas's share.
EMSCRIPTEN_KEEPALIVE void vtPage_ResetView(void)
{
    vtFrame* frame = &page->frame;
    float aspect = page->share * (float)frame->width / (float)frame->height;
    frame->view = vtFrameMesh(&page->mesh, frame->view.fovY, aspect);
    page->changed = true;
}

/// Takes the mesh over; where it cannot be uploaded, the one before stays.
static vtResult showMesh(vtMesh* mesh)
{
    vtResult result = vtRenderer_SetMesh(page->renderer, mesh, &page->error);
    if (result != vt_ok) {
        vtDestroyMesh(mesh);
        return result;
    }
    vtDestroyMesh(&page->mesh);
    page->mesh = *mesh;
    vtPage_ResetView();
    return vt_ok;
}

/// A built-in shape by name.
EMSCRIPTEN_KEEPALIVE const char* vtPage_SetShape(const char* name)
{
    vtMesh mesh;
    vtResult result = vtCreateShape(name, &mesh, &page->error);
    return sentence(result == vt_ok ? showMesh(&mesh) : result);
}

/// The contents of a .glb or self-contained .gltf; its index of refraction, if it has one, becomes the
/// page's.
EMSCRIPTEN_KEEPALIVE const char* vtPage_OpenModel(uint8_t* bytes, size_t size, const char* name)
{
    vtModel model;
    vtModelDef def = {.bytes = bytes, .size = size, .name = name};
    vtResult result = vtLoadModel(&def, &model, &page->error);
    free(bytes);
    if (result == vt_ok) {
        result = showMesh(&model.mesh);
    }
    if (result == vt_ok && model.ior > 0.0f) {
        page->frame.ior = model.ior;
    }
    return sentence(result);
}

static vtResult showEnvironment(vtEnvironment* environment)
{
    vtResult result = vtRenderer_SetEnvironment(page->renderer, environment, &page->error);
    vtDestroyEnvironment(environment);
    page->changed |= result == vt_ok;
    return result;
}

/// A built-in environment by name.
EMSCRIPTEN_KEEPALIVE const char* vtPage_SetEnvironment(const char* name)
{
    vtEnvironment environment;
    vtResult result = vtCreateEnvironment(name, &environment, &page->error);
    return sentence(result == vt_ok ? showEnvironment(&environment) : result);
}

/// The contents of an equirectangular .hdr, .png or .jpg.
EMSCRIPTEN_KEEPALIVE const char* vtPage_OpenEnvironment(uint8_t* bytes, size_t size, const char* name)
{
    vtEnvironment environment;
    vtResult result = vtLoadEnvironment(bytes, size, name, &environment, &page->error);
    free(bytes);
    return sentence(result == vt_ok ? showEnvironment(&environment) : result);
}

static vtResult showFrame(const vtFrame* frame)
{
    vtResult result = vtValidateFrame(frame, &page->error);
    if (result == vt_ok) {
        page->frame = *frame;
        page->changed = true;
    }
    return result;
}

/// The settings of the glass, ranges as in vtFrame; `analysis` shows path colours.
EMSCRIPTEN_KEEPALIVE const char* vtPage_SetGlass(float ior, int layers, int steps, int maxEvents,
                                                 bool analysis)
{
    vtFrame frame = page->frame;
    frame.ior = ior;
    frame.layers = layers;
    frame.steps = steps;
    frame.maxEvents = maxEvents;
    frame.output = analysis ? vt_outputAnalysis : vt_outputPicture;
    return sentence(showFrame(&frame));
}

EMSCRIPTEN_KEEPALIVE const char* vtPage_SetView(float eyeX, float eyeY, float eyeZ, float targetX,
                                                float targetY, float targetZ, float fovY)
{
    vtFrame frame = page->frame;
    frame.view = (vtView){{eyeX, eyeY, eyeZ}, {targetX, targetY, targetZ}, fovY};
    return sentence(showFrame(&frame));
}

/// Turns the eye about the object, radians; for keys and fingers, the mouse comes through the window.
EMSCRIPTEN_KEEPALIVE void vtPage_Orbit(float yaw, float pitch)
{
    page->frame.view = vtView_Orbit(page->frame.view, yaw, pitch);
    page->changed = true;
}

/// Moves the eye towards (factor < 1) or away from the object, within a tenth and ten times its size.
EMSCRIPTEN_KEEPALIVE void vtPage_Zoom(float factor)
{
    float size = vtLength(vtSub(page->mesh.boundsMax, page->mesh.boundsMin));
    float distance = vtLength(vtSub(page->frame.view.eye, page->frame.view.target));
    float wanted = vtClamp(distance * factor, 0.1f * size, 10.0f * size);
    page->frame.view = vtView_Zoom(page->frame.view, wanted / distance);
    page->changed = true;
}

/// The canvas now has width x height pixels, and is cleared: tick before the browser paints. `share` of its
/// width, in the middle, is free of panels: there the object is framed.
EMSCRIPTEN_KEEPALIVE const char* vtPage_Resize(int width, int height, float share)
{
    vtFrame frame = page->frame;
    frame.width = width;
    frame.height = height;
    page->share = share;
    return sentence(showFrame(&frame));
}

/// Takes the mouse in and draws the canvas if anything changed. 1: drawn, 0: nothing to do, -1: failed, see
/// vtPage_Error.
EMSCRIPTEN_KEEPALIVE int vtPage_Tick(void)
{
    page->changed |= vtWindow_Poll(page->window, &page->frame.view);
    if (!page->changed) {
        return 0;
    }
    page->changed = false;
    if (vtRenderer_Draw(page->renderer, &page->frame, &page->error) != vt_ok) {
        return -1;
    }
    vtWindow_Present(page->window);
    ++page->drawCount;
    return 1;
}

/// The present view and settings at another size: 4 * width * height bytes, top row first, valid until the
/// next call; NULL on failure, see vtPage_Error.
EMSCRIPTEN_KEEPALIVE const uint8_t* vtPage_Image(int width, int height)
{
    vtFrame frame = page->frame;
    frame.width = width;
    frame.height = height;
    if (vtValidateFrame(&frame, &page->error) != vt_ok) {
        return NULL;
    }
    uint8_t* image = realloc(page->image, 4 * (size_t)width * (size_t)height);
    if (image == NULL) {
        vtFail(&page->error, vt_errorMemory, "picture: out of memory for %d x %d", width, height);
        return NULL;
    }
    page->image = image;
    return vtRenderer_DrawImage(page->renderer, &frame, image, &page->error) == vt_ok ? image : NULL;
}

/// The sentence of the call that failed last.
EMSCRIPTEN_KEEPALIVE const char* vtPage_Error(void)
{
    return page->error.message;
}

/// What is shown, as JSON.
EMSCRIPTEN_KEEPALIVE const char* vtPage_Info(void)
{
    const vtFrame* frame = &page->frame;
    vtRendererInfo info = vtRenderer_Info(page->renderer);
    snprintf(page->info, sizeof page->info,
             "{\"triangles\":%u,\"openEdges\":%u,\"layerWidth\":%d,\"layerHeight\":%d,\"drawCount\":%d,"
             "\"ior\":%.6g,\"layers\":%d,\"steps\":%d,\"maxEvents\":%d,\"analysis\":%s}",
             page->mesh.indexCount / 3, page->mesh.openEdgeCount, info.layerWidth, info.layerHeight,
             page->drawCount, (double)frame->ior, frame->layers, frame->steps, frame->maxEvents,
             frame->output == vt_outputAnalysis ? "true" : "false");
    return page->info;
}
