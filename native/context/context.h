// Headless GL contexts. One file each; the core knows neither.
#pragma once

#include "vitrine.h"

typedef enum vtBackend {
    vt_backendAuto = 0, ///< OSMesa where it is built in and starts, else EGL
    vt_backendOSMesa,
    vt_backendEgl,
} vtBackend;

/// A current context. `destroy` ends it.
typedef struct vtContext {
    const char* name;
    vtGetProcAddressFcn* getProcAddress;
    void (*destroy)(struct vtContext* context);
    void* state;
} vtContext;

/// Makes a context and makes it current in this thread. Fails with vt_errorContext, saying for each backend
/// tried why it did not start.
vtResult vtCreateContext(vtBackend backend, vtContext* context, vtError* error);
void vtDestroyContext(vtContext* context);

vtResult vtCreateOSMesaContext(vtContext* context, vtError* error);
vtResult vtCreateEglContext(vtContext* context, vtError* error);
