#include "gl/gl.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"

#ifndef __EMSCRIPTEN__
/// Reads "OpenGL ES 3.0 ..." or "3.3 ..." of desktop GL.
static bool isNewEnough(const char* version)
{
    const char* embedded = strstr(version, "OpenGL ES ");
    char* end = NULL;
    const long major = strtol(embedded != NULL ? embedded + 10 : version, &end, 10);
    const long minor = *end == '.' ? strtol(end + 1, NULL, 10) : 0;
    return embedded != NULL ? major >= 3 : major * 10 + minor >= 33;
}
#endif

static bool hasExtension(const vtGL* gl, const char* name)
{
    GLint count = 0;
    bool found = false;
    gl->GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count && !found; ++i) {
        const char* extension = (const char*)gl->GetStringi(GL_EXTENSIONS, (GLuint)i);
        found = extension != NULL && strcmp(extension, name) == 0;
    }
    return found;
}

vtResult vtLoadGL(vtGetProcAddressFcn* getProcAddress, vtGL* gl, vtError* error)
{
    *gl = (vtGL){0};
#ifdef __EMSCRIPTEN__
    (void)getProcAddress; // nor is a version looked at: the page makes contexts of WebGL 2 only
#define VT_GL_LOAD(type, name) gl->name = gl##name;
    VT_GL_FUNCTIONS(VT_GL_LOAD)
    VT_GL_HOST_FUNCTIONS(VT_GL_LOAD)
#undef VT_GL_LOAD
#else
    const char* missing = NULL;
    if (getProcAddress == NULL) {
        return vtFail(error, vt_errorArgument,
                      "renderer: getProcAddress is NULL; give the context's, as glfwGetProcAddress");
    }
#define VT_GL_LOAD(type, name)                                                                               \
    gl->name = (type)getProcAddress("gl" #name);                                                             \
    if (gl->name == NULL && missing == NULL) {                                                               \
        missing = "gl" #name;                                                                                \
    }
    VT_GL_FUNCTIONS(VT_GL_LOAD)
    VT_GL_HOST_FUNCTIONS(VT_GL_LOAD)
#undef VT_GL_LOAD
    if (missing != NULL) {
        return vtFail(error, vt_errorContext,
                      "GL: the context has no %s; OpenGL ES 3.0, WebGL 2 or desktop GL 3.3 is needed",
                      missing);
    }
    const char* version = (const char*)gl->GetString(GL_VERSION);
    if (version == NULL) {
        return vtFail(error, vt_errorContext,
                      "GL: no context is current in this thread; make one current first");
    }
    if (!isNewEnough(version)) {
        return vtFail(error, vt_errorContext,
                      "GL: the context is '%s'; OpenGL ES 3.0, WebGL 2 or desktop GL 3.3 is needed", version);
    }
    gl->isDesktop = strstr(version, "OpenGL ES ") == NULL;
#endif
    gl->parallelCompile = hasExtension(gl, "GL_KHR_parallel_shader_compile");
    return vtSucceed(error);
}

static const char* errorName(GLenum code)
{
    switch (code) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    default:
        return "an unknown error";
    }
}

vtResult vtCheckGL(const vtGL* gl, const char* doing, vtError* error)
{
    GLenum first = gl->GetError();
    if (first == GL_NO_ERROR) { // each question waits for the GPU
        return vtSucceed(error);
    }
    // A lost context may answer with errors for ever: ask a few times only.
    for (int i = 0; i < 8 && gl->GetError() != GL_NO_ERROR; ++i) {
    }
    if (first == 0x0507 || first == 0x9242) { // GL_CONTEXT_LOST, CONTEXT_LOST_WEBGL
        return vtFail(error, vt_errorContext,
                      "GL: the context was lost while %s; make another one, and another renderer in it",
                      doing);
    }
    const vtResult result = first == GL_OUT_OF_MEMORY ? vt_errorMemory : vt_errorContext;
    return vtFail(error, result, "GL: %s while %s", errorName(first), doing);
}

vtResult vtCheckFrame(const vtGL* gl, const char* doing, vtError* error)
{
#ifdef __EMSCRIPTEN__
    (void)gl;
    (void)doing;
    return vtSucceed(error);
#else
    return vtCheckGL(gl, doing, error);
#endif
}
