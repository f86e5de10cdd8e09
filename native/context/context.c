#include "context/context.h"

#include "base/error.h"

vtResult vtCreateContext(vtBackend backend, vtContext* context, vtError* error)
{
    if (backend == vt_backendOSMesa) {
        return vtCreateOSMesaContext(context, error);
    }
    if (backend == vt_backendEgl) {
        return vtCreateEglContext(context, error);
    }
    vtError osmesa = {0}, egl = {0};
    if (vtCreateOSMesaContext(context, &osmesa) == vt_ok || vtCreateEglContext(context, &egl) == vt_ok) {
        return vtSucceed(error);
    }
    return vtFail(error, vt_errorContext, "no GL context: %.200s; %.200s", osmesa.message, egl.message);
}

void vtDestroyContext(vtContext* context)
{
    if (context->destroy != NULL) {
        context->destroy(context);
    }
    *context = (vtContext){0};
}
