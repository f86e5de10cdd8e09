// A GLFW window that turns and zooms a view under the mouse; the same code drives the browser's canvas
// through Emscripten's GLFW port.
#pragma once

#include "vitrine.h"

typedef struct vtWindow vtWindow;

/// Opens a window with a current OpenGL ES 3 (else desktop 3.3) context. Fails with vt_errorContext where
/// there is no display or no GLFW.
vtResult vtCreateWindow(const char* title, int width, int height, vtWindow** window, vtError* error);
void vtDestroyWindow(vtWindow* window);

/// Functions of the window's context, for vtRendererDef.
vtGetProcAddressFcn* vtWindow_GetProcAddress(void);

/// Takes in events and applies the mouse to the view: drag orbits, the wheel zooms. True where the view
/// changed or the window was resized since the last call.
bool vtWindow_Poll(vtWindow* window, vtView* view);

/// What the keys of an animation were pressed for since the last call, and how it was dragged.
typedef struct vtWindowKeys {
    int steps;    ///< right arrow 1, left arrow -1
    bool pause;   ///< space, an odd number of times
    bool start;   ///< home
    double scrub; ///< along the window with the right button; 1 is its width
} vtWindowKeys;
vtWindowKeys vtWindow_TakeKeys(vtWindow* window);

/// The file that was dropped on the window since the last call, for the caller to free; NULL: none. Of
/// several it is the model, which may have come with its buffers and pictures.
char* vtWindow_TakeDropped(vtWindow* window);

void vtWindow_SetTitle(vtWindow* window, const char* title);

/// Size of the framebuffer, pixels.
void vtWindow_GetSize(const vtWindow* window, int* width, int* height);
bool vtWindow_ShouldClose(const vtWindow* window);
void vtWindow_Present(vtWindow* window);
