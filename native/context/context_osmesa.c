// OSMesa: Mesa's software renderer into memory, no display and no driver. It gives desktop GL only; 3.3
// core with GL_ARB_ES3_compatibility takes the ES 3.0 shaders as they are. Upstream removed it in Mesa 25.1,
// so a build without it stands on EGL.
#include "base/error.h"
#include "context/context.h"

#ifndef VT_WITH_OSMESA

vtResult vtCreateOSMesaContext(vtContext* context, vtError* error)
{
    (void)context;
    return vtFail(error, vt_errorContext,
                  "osmesa: this vitrine was built without it (libosmesa6-dev); try egl");
}

#else

#include <GL/osmesa.h>
#include <stdlib.h>

typedef struct OSMesaState {
    OSMesaContext context;
    uint32_t buffer[16 * 16]; // OSMesa wants one to be current; we draw into framebuffer objects
} OSMesaState;

static void destroy(vtContext* context)
{
    OSMesaState* state = context->state;
    OSMesaMakeCurrent(NULL, NULL, GL_UNSIGNED_BYTE, 0, 0);
    OSMesaDestroyContext(state->context);
    free(state);
}

vtResult vtCreateOSMesaContext(vtContext* context, vtError* error)
{
    static const int attributes[] = {OSMESA_FORMAT,
                                     OSMESA_RGBA,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     3,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     3,
                                     0};
    OSMesaState* state = calloc(1, sizeof *state);
    if (state == NULL) {
        return vtFail(error, vt_errorMemory, "osmesa: out of memory");
    }
    state->context = OSMesaCreateContextAttribs(attributes, NULL);
    if (state->context == NULL) {
        free(state);
        return vtFail(error, vt_errorContext, "osmesa: gives no GL 3.3 core context");
    }
    if (!OSMesaMakeCurrent(state->context, state->buffer, GL_UNSIGNED_BYTE, 16, 16)) {
        OSMesaDestroyContext(state->context);
        free(state);
        return vtFail(error, vt_errorContext, "osmesa: its context cannot be made current");
    }
    *context = (vtContext){"osmesa", OSMesaGetProcAddress, destroy, state};
    return vtSucceed(error);
}

#endif
