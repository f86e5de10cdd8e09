// EGL without a surface: a true OpenGL ES 3 context, on a GPU where there is one, on llvmpipe where not.
#include "base/error.h"
#include "context/context.h"

#ifndef VT_WITH_EGL

vtResult vtCreateEglContext(vtContext* context, vtError* error)
{
    (void)context;
    return vtFail(error, vt_errorContext, "egl: this vitrine was built without it (libegl-dev); try osmesa");
}

#else

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdlib.h>
#include <string.h>

typedef struct EglState {
    EGLDisplay display;
    EGLContext context;
} EglState;

static void destroy(vtContext* context)
{
    EglState* state = context->state;
    eglMakeCurrent(state->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(state->display, state->context);
    eglTerminate(state->display);
    free(state);
}

/// The first display that starts: a device (a GPU comes first there), Mesa's surfaceless platform, default.
static EGLDisplay openDisplay(void)
{
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    PFNEGLGETPLATFORMDISPLAYEXTPROC getDisplay =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    PFNEGLQUERYDEVICESEXTPROC queryDevices =
        (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    EGLDisplay candidates[10];
    int count = 0;
    if (extensions != NULL && getDisplay != NULL && queryDevices != NULL &&
        strstr(extensions, "EGL_EXT_platform_device") != NULL) {
        EGLDeviceEXT devices[8];
        EGLint deviceCount = 0;
        if (queryDevices(8, devices, &deviceCount)) {
            for (int i = 0; i < deviceCount; ++i) {
                candidates[count++] = getDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL);
            }
        }
    }
    if (extensions != NULL && getDisplay != NULL &&
        strstr(extensions, "EGL_MESA_platform_surfaceless") != NULL) {
        candidates[count++] = getDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    }
    candidates[count++] = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    for (int i = 0; i < count; ++i) {
        if (candidates[i] != EGL_NO_DISPLAY && eglInitialize(candidates[i], NULL, NULL)) {
            return candidates[i];
        }
    }
    return EGL_NO_DISPLAY;
}

vtResult vtCreateEglContext(vtContext* context, vtError* error)
{
    static const EGLint configAttributes[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                              EGL_OPENGL_ES3_BIT, EGL_NONE};
    static const EGLint contextAttributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0,
                                               EGL_NONE};
    EGLDisplay display = openDisplay();
    if (display == EGL_NO_DISPLAY) {
        return vtFail(error, vt_errorContext,
                      "egl: no display starts (is a driver installed? libegl1, libgl1-mesa-dri)");
    }
    EGLConfig config = NULL;
    EGLint configCount = 0;
    eglBindAPI(EGL_OPENGL_ES_API);
    EGLContext made = EGL_NO_CONTEXT;
    if (eglChooseConfig(display, configAttributes, &config, 1, &configCount) && configCount > 0) {
        made = eglCreateContext(display, config, EGL_NO_CONTEXT, contextAttributes);
    }
    if (made == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, made)) {
        EGLint code = eglGetError();
        eglTerminate(display);
        return vtFail(error, vt_errorContext,
                      "egl: no OpenGL ES 3.0 context without a surface (EGL error 0x%04x)", (unsigned)code);
    }
    EglState* state = calloc(1, sizeof *state);
    if (state == NULL) {
        eglTerminate(display);
        return vtFail(error, vt_errorMemory, "egl: out of memory");
    }
    *state = (EglState){display, made};
    *context = (vtContext){"egl", (vtGetProcAddressFcn*)eglGetProcAddress, destroy, state};
    return vtSucceed(error);
}

#endif
