#include "view/window.h"

#include "base/error.h"

#if !defined(VT_WITH_GLFW)

vtResult vtCreateWindow(const char* title, int width, int height, vtWindow** window, vtError* error)
{
    (void)title, (void)width, (void)height;
    *window = NULL;
    return vtFail(error, vt_errorContext, "window: this vitrine was built without GLFW (libglfw3-dev)");
}
void vtDestroyWindow(vtWindow* window)
{
    (void)window;
}
vtGetProcAddressFcn* vtWindow_GetProcAddress(void)
{
    return NULL;
}
bool vtWindow_Poll(vtWindow* window, vtView* view)
{
    (void)window, (void)view;
    return false;
}
vtWindowKeys vtWindow_TakeKeys(vtWindow* window)
{
    (void)window;
    return (vtWindowKeys){0};
}
char* vtWindow_TakeDropped(vtWindow* window)
{
    (void)window;
    return NULL;
}
void vtWindow_SetTitle(vtWindow* window, const char* title)
{
    (void)window, (void)title;
}
void vtWindow_GetSize(const vtWindow* window, int* width, int* height)
{
    (void)window;
    *width = *height = 0;
}
bool vtWindow_ShouldClose(const vtWindow* window)
{
    (void)window;
    return true;
}
void vtWindow_Present(vtWindow* window)
{
    (void)window;
}

#else

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct vtWindow {
    GLFWwindow* handle;
    double x, y;      // of the pointer at the last event
    double yaw, turn; // gathered since the last poll, radians
    double zoom;      // likewise, wheel notches
    bool dragging, scrubbing, resized;
    vtWindowKeys keys;
    char* dropped; // since the last call; NULL: nothing
};

// One turn of the object is two and a half windows' widths of dragging.
static const double radiansPerPixel = 0.005;
static const double zoomPerNotch = 0.9;

static void onButton(GLFWwindow* handle, int button, int action, int modifiers)
{
    (void)modifiers;
    vtWindow* window = glfwGetWindowUserPointer(handle);
    if (button == GLFW_MOUSE_BUTTON_LEFT) {
        window->dragging = action == GLFW_PRESS;
    } else if (button == GLFW_MOUSE_BUTTON_RIGHT) {
        window->scrubbing = action == GLFW_PRESS;
    }
#if defined(__EMSCRIPTEN__) // a finger comes down where no pointer was
    glfwGetCursorPos(handle, &window->x, &window->y);
#endif
}

static void onMove(GLFWwindow* handle, double x, double y)
{
    vtWindow* window = glfwGetWindowUserPointer(handle);
    if (window->dragging) {
        window->yaw -= (x - window->x) * radiansPerPixel;
        window->turn += (y - window->y) * radiansPerPixel;
    }
    if (window->scrubbing) {
        int width, height;
        glfwGetWindowSize(handle, &width, &height);
        window->keys.scrub += (x - window->x) / fmax(width, 1.0);
    }
    window->x = x;
    window->y = y;
}

static void onScroll(GLFWwindow* handle, double x, double y)
{
    (void)x;
    vtWindow* window = glfwGetWindowUserPointer(handle);
    window->zoom += y;
}

static void onKey(GLFWwindow* handle, int key, int code, int action, int modifiers)
{
    (void)code, (void)modifiers;
    vtWindowKeys* keys = &((vtWindow*)glfwGetWindowUserPointer(handle))->keys;
    if (action == GLFW_RELEASE) {
        return;
    }
    keys->pause ^= key == GLFW_KEY_SPACE && action == GLFW_PRESS;
    keys->start |= key == GLFW_KEY_HOME;
    keys->steps += (key == GLFW_KEY_RIGHT) - (key == GLFW_KEY_LEFT);
}

#if !defined(__EMSCRIPTEN__) // a page takes files by itself
static bool isModel(const char* path)
{
    const char* ending = strrchr(path, '.');
    return ending != NULL && (strcmp(ending, ".glb") == 0 || strcmp(ending, ".gltf") == 0);
}

static void onDrop(GLFWwindow* handle, int count, const char** paths)
{
    vtWindow* window = glfwGetWindowUserPointer(handle);
    int chosen = 0;
    while (chosen < count && !isModel(paths[chosen])) {
        ++chosen;
    }
    if (count > 0) {
        free(window->dropped);
        window->dropped = strdup(paths[chosen < count ? chosen : 0]);
    }
}
#endif

static void onResize(GLFWwindow* handle, int width, int height)
{
    (void)width, (void)height;
    vtWindow* window = glfwGetWindowUserPointer(handle);
    window->resized = true;
}

static GLFWwindow* openHandle(const char* title, int width, int height)
{
    glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
    GLFWwindow* handle = glfwCreateWindow(width, height, title, NULL, NULL);
    if (handle == NULL) {
        glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        handle = glfwCreateWindow(width, height, title, NULL, NULL);
    }
    return handle;
}

vtResult vtCreateWindow(const char* title, int width, int height, vtWindow** out, vtError* error)
{
    *out = NULL;
#if defined(GLFW_PLATFORM) && !defined(__EMSCRIPTEN__) // from GLFW 3.4 on
    if (getenv("XDG_RUNTIME_DIR") == NULL && getenv("WAYLAND_SOCKET") == NULL) {
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11); // Wayland's library would print that it has no socket
    }
#endif
    if (!glfwInit()) {
        return vtFail(error, vt_errorContext, "window: GLFW finds no display; 'vitrine render' needs none");
    }
    vtWindow* window = calloc(1, sizeof *window);
    if (window != NULL) {
        window->handle = openHandle(title, width, height);
    }
    if (window == NULL || window->handle == NULL) {
        free(window);
        glfwTerminate();
        return vtFail(error, vt_errorContext,
                      "window: no OpenGL ES 3.0 or desktop GL 3.3 context can be opened");
    }
    glfwMakeContextCurrent(window->handle);
    glfwSetWindowUserPointer(window->handle, window);
    glfwSetMouseButtonCallback(window->handle, onButton);
    glfwSetCursorPosCallback(window->handle, onMove);
    glfwSetScrollCallback(window->handle, onScroll);
    glfwSetKeyCallback(window->handle, onKey);
#if !defined(__EMSCRIPTEN__)
    glfwSetDropCallback(window->handle, onDrop);
#endif
    glfwSetFramebufferSizeCallback(window->handle, onResize);
    window->resized = true;
    *out = window;
    return vtSucceed(error);
}

void vtDestroyWindow(vtWindow* window)
{
    if (window != NULL) {
        glfwDestroyWindow(window->handle);
        glfwTerminate();
        free(window->dropped);
        free(window);
    }
}

vtGetProcAddressFcn* vtWindow_GetProcAddress(void)
{
    return (vtGetProcAddressFcn*)glfwGetProcAddress;
}

bool vtWindow_Poll(vtWindow* window, vtView* view)
{
    glfwPollEvents();
    bool moved = window->yaw != 0.0 || window->turn != 0.0 || window->zoom != 0.0;
    if (moved) {
        *view = vtView_Orbit(*view, (float)window->yaw, (float)window->turn);
        *view = vtView_Zoom(*view, (float)pow(zoomPerNotch, window->zoom));
    }
    bool changed = moved || window->resized;
    window->yaw = window->turn = window->zoom = 0.0;
    window->resized = false;
    return changed;
}

vtWindowKeys vtWindow_TakeKeys(vtWindow* window)
{
    const vtWindowKeys keys = window->keys;
    window->keys = (vtWindowKeys){0};
    return keys;
}

char* vtWindow_TakeDropped(vtWindow* window)
{
    char* dropped = window->dropped;
    window->dropped = NULL;
    return dropped;
}

void vtWindow_SetTitle(vtWindow* window, const char* title)
{
    glfwSetWindowTitle(window->handle, title);
}

void vtWindow_GetSize(const vtWindow* window, int* width, int* height)
{
    glfwGetFramebufferSize(window->handle, width, height);
}

bool vtWindow_ShouldClose(const vtWindow* window)
{
    return glfwWindowShouldClose(window->handle);
}

void vtWindow_Present(vtWindow* window)
{
    glfwSwapBuffers(window->handle);
}

#endif
