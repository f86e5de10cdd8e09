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

/// Builds the hierarchies of a scene that moves, so that they need not be built anew each time.
static vtResult prepareMotion(vtInput* input, vtError* error)
{
    vtPreparation* preparation = input->motion.count > 0 ? vtBeginPreparation(&input->scene) : NULL;
    while (preparation != NULL && !vtPreparation_Step(preparation, UINT32_MAX)) {
    }
    return preparation != NULL ? vtEndPreparation(preparation, error) : vt_ok;
}

static vtResult setScene(vtRenderer* renderer, vtInput* input, const vtOptions* options, vtError* error)
{
    vtResult result = prepareMotion(input, error);
    if (result == vt_ok) {
        result = vtRenderer_SetScene(renderer, &input->scene, error);
    }
    if (result == vt_ok && options->ground.isThere) {
        result = vtRenderer_SetGround(renderer, &input->ground, error);
    }
    return result;
}

vtResult vtSession_Fill(vtSession* session, const vtOptions* options, vtError* error)
{
    vtResult result = setScene(session->renderer, &session->input, options, error);
    if (result == vt_ok) {
        result = vtRenderer_SetEnvironment(session->renderer, &session->input.environment, error);
    }
    if (result == vt_ok && session->input.background.pixels != NULL) {
        result = vtRenderer_SetBackground(session->renderer, &session->input.background, error);
    }
    if (result == vt_ok && options->backdrop != NULL) {
        const vtBackdrop backdrop = {.distance = options->backdropDistance};
        result = vtRenderer_SetBackdrop(session->renderer, &session->input.backdrop, &backdrop, error);
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
    return result == vt_ok ? vtSession_Fill(session, options, error) : result;
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
    vtInput fresh;
    vtResult result = vtLoadInputModel(options, &fresh, error);
    if (result != vt_ok) {
        return result;
    }
    if (session->renderer != NULL) {
        result = setScene(session->renderer, &fresh, options, error);
    }
    if (result != vt_ok) {
        vtDestroyInput(&fresh);
        return result;
    }
    vtInput_TakeModel(&session->input, &fresh);
    return vtSucceed(error);
}

vtResult vtSession_SetTime(vtSession* session, const vtOptions* options, double seconds, vtError* error)
{
    const vtResult result = vtInput_SetTime(&session->input, options, seconds, error);
    return result == vt_ok && session->renderer != NULL
               ? vtRenderer_UpdateScene(session->renderer, &session->input.scene, error)
               : result;
}

void vtCloseSession(vtSession* session)
{
    vtDestroyRenderer(session->renderer);
    vtDestroyContext(&session->context);
    vtDestroyInput(&session->input);
    *session = (vtSession){0};
}
