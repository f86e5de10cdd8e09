// What every drawing command opens first: the scene, and unless the reference traces it, a headless context
// and a renderer that holds the scene.
#pragma once

#include "cli/load.h"
#include "context/context.h"

typedef struct vtSession {
    vtInput input;
    vtContext context;
    vtRenderer* renderer; ///< NULL: the reference's
} vtSession;

/// Opens all of it as the options say. On failure nothing is left open.
vtResult vtOpenSession(const vtOptions* options, vtSession* session, vtError* error);

/// Puts another model into an open session, before the same environment; on failure the one before stays.
vtResult vtSession_SetModel(vtSession* session, const vtOptions* options, vtError* error);

/// Moves the scene to another time of its animations, and what is drawn with it.
vtResult vtSession_SetTime(vtSession* session, const vtOptions* options, double seconds, vtError* error);

/// Gives a renderer what the session's input has and the options ask for.
vtResult vtSession_Fill(vtSession* session, const vtOptions* options, vtError* error);

/// Safe on a zeroed session.
void vtCloseSession(vtSession* session);
