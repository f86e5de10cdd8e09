#include "cli/session.h"

#include <string.h>

#include "base/error.h"
#include "cli/trace.h"

static vtResult findBackend(const char* name, vtBackend* backend, vtError* error)
{
    static const struct {
        const char* name;
        vtBackend backend;
    } backends[] = {{"auto", vt_backendAuto}, {"osmesa", vt_backendOSMesa}, {"egl", vt_backendEgl}};
    for (int i = 0; i < 3; ++i) {
        if (strcmp(backends[i].name, name) == 0) {
            *backend = backends[i].backend;
            return vt_ok;
        }
    }
    return vtFail(error, vt_errorArgument, "--rendering-backend is '%s'; it must be auto, osmesa or egl",
                  name);
}

static vtResult setSurroundings(const vtOptions* options, const vtSession* session, vtError* error)
{
    vtResult result = vtRenderer_SetEnvironment(session->renderer, &session->input.environment, error);
    if (result == vt_ok && session->input.background.pixels != NULL) {
        result = vtRenderer_SetBackground(session->renderer, &session->input.background, error);
    }
    if (result == vt_ok && options->ground.isThere) {
        result = vtRenderer_SetGround(session->renderer, &options->ground.ground, error);
    }
    return result;
}

static vtResult openRenderer(const vtOptions* options, vtBackend backend, vtSession* session, vtError* error)
{
    vtResult result = vtCreateContext(backend, &session->context, error);
    if (result == vt_ok) {
        result = vtCreateRenderer(&(vtRendererDef){.getProcAddress = session->context.getProcAddress},
                                  &session->renderer, error);
    }
    if (result == vt_ok) {
        result = vtRenderer_SetScene(session->renderer, &session->input.scene, error);
    }
    return result == vt_ok ? setSurroundings(options, session, error) : result;
}

vtResult vtOpenSession(const vtOptions* options, vtSession* session, vtError* error)
{
    *session = (vtSession){0};
    vtBackend backend = vt_backendAuto;
    vtResult result = findBackend(options->backend, &backend, error);
    if (result == vt_ok) {
        result = vtLoadInput(options, &session->input, error);
    }
    if (result == vt_ok && !vtIsReference(options)) {
        result = openRenderer(options, backend, session, error);
    }
    if (result != vt_ok) {
        vtCloseSession(session);
    }
    return result;
}

vtResult vtSession_SetModel(vtSession* session, const vtOptions* options, vtError* error)
{
    vtResult result = vtSetInputModel(options, &session->input, error);
    if (result == vt_ok && session->renderer != NULL) {
        result = vtRenderer_SetScene(session->renderer, &session->input.scene, error);
    }
    return result;
}

void vtCloseSession(vtSession* session)
{
    vtDestroyRenderer(session->renderer);
    vtDestroyContext(&session->context);
    vtDestroyInput(&session->input);
    *session = (vtSession){0};
}
