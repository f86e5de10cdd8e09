// The page's own half in C: a viewer in a GLFW window, which Emscripten's port makes of the page's canvas.
// Everything but the mouse goes to the viewer (viewer.c).
#include <emscripten.h>
#include <stdlib.h>

#include "base/error.h"
#include "core/viewer.h"
#include "view/window.h"

typedef struct vtPage {
    vtWindow* window;
    vtViewer* viewer;
    vtError error;
} vtPage;

/// Opens the canvas, width x height pixels, and compiles the shaders. NULL where memory is out; else ask for
/// vtPage_Error, then set a shape and an environment before the first tick.
EMSCRIPTEN_KEEPALIVE vtPage* vtPage_Start(int width, int height)
{
    vtPage* page = calloc(1, sizeof *page);
    if (page == NULL) {
        return NULL;
    }
    if (vtCreateWindow("Vitrine", width, height, &page->window, NULL) != vt_ok) {
        vtFail(&page->error, vt_errorContext,
               "page: this browser opens no WebGL 2 context; turn hardware acceleration on or try another "
               "browser");
        return page;
    }
    page->viewer = vtViewer_Create(width, height, NULL);
    if (page->viewer != NULL) {
        page->error = page->viewer->error;
    }
    return page;
}

/// Why the page cannot start; empty where it has.
EMSCRIPTEN_KEEPALIVE const char* vtPage_Error(const vtPage* page)
{
    return page->error.message;
}

EMSCRIPTEN_KEEPALIVE vtViewer* vtPage_Viewer(const vtPage* page)
{
    return page->viewer;
}

/// Takes the mouse in and draws the canvas if anything changed, as vtViewer_Tick.
EMSCRIPTEN_KEEPALIVE int vtPage_Tick(vtPage* page)
{
    page->viewer->changed |= vtWindow_Poll(page->window, &page->viewer->frame.view);
    int drawn = vtViewer_Tick(page->viewer);
    if (drawn == 1) {
        vtWindow_Present(page->window);
    }
    return drawn;
}
