// Models that move: which of their animations are played, and the scene at a time.
#pragma once

#include "cli/options.h"

/// A model of what is drawn, and where in the scene it is.
typedef struct vtMovingModel {
    vtModel* model;
    vtModelPlace place;
    int animation; ///< that is played; -1: it stays at rest
} vtMovingModel;

typedef struct vtMotion {
    vtMovingModel models[1 + VT_MAX_OBJECT_OPTIONS]; ///< those that have animations
    int count;
    double duration; ///< seconds, of the longest that is played; 0: nothing moves
    vtView view;     ///< where no camera is given: of the whole scene at rest and at all times
    float lowest;    ///< y of its lowest point then
} vtMotion;

/// Takes a model over, which may be NULL.
void vtMotion_Add(vtMotion* motion, vtModel* model, const vtModelPlace* place);

/// Chooses what is played by the options: of each model the animation of that name or number, else its first.
/// Fails with a sentence where animations are asked for and there is none such.
vtResult vtMotion_Choose(vtMotion* motion, const vtOptions* options, vtError* error);

/// Moves the scene; NAN: to rest. Before and after an animation it is as at its ends.
vtResult vtMotion_SetTime(vtMotion* motion, double seconds, vtScene* scene, vtError* error);

/// Looks at the scene, which is at rest and stays so, at 16 times of what is played: view and lowest point.
vtResult vtMotion_Survey(vtMotion* motion, float fovY, float aspect, vtScene* scene, vtError* error);

/// Safe on a zeroed one.
void vtDestroyMotion(vtMotion* motion);
