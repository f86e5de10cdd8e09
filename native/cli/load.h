// From names on the command line to a scene.
#pragma once

#include "cli/motion.h"

typedef struct vtInput {
    vtScene scene;
    vtEnvironment environment;
    vtImage background;    ///< its pixels NULL: no picture
    vtImage backdrop;      ///< the same
    float ior;             ///< of the command line; 0: each object's own
    vtGround ground;       ///< of the command line; below a scene that moves, at its lowest point ever
    vtMotion motion;       ///< of the scene
    uint64_t contents;     ///< hash of the scene's files, see cli/hash.h
    uint64_t surroundings; ///< and of those of environment and background
} vtInput;

/// Loads models and environment, prints notes (computed normals) and warnings (an open mesh) to stderr. Where
/// animations are played (options->plays) the scene is as at --time, or 0.
vtResult vtLoadInput(const vtOptions* options, vtInput* input, vtError* error);
/// Loads another model, with what belongs to the scene alone; environment and background stay empty. On
/// failure nothing is left.
vtResult vtLoadInputModel(const vtOptions* options, vtInput* fresh, vtError* error);
/// Puts that model in the scene's place.
void vtInput_TakeModel(vtInput* input, const vtInput* fresh);
void vtDestroyInput(vtInput* input);

/// Moves the scene to another time of its animations, which are played. What a technique needs it has again.
vtResult vtInput_SetTime(vtInput* input, const vtOptions* options, double seconds, vtError* error);

/// The index of refraction that all glass is drawn with; 0 where objects differ, or none is glass.
float vtCommonIor(const vtInput* input);

uint32_t vtCountTriangles(const vtScene* scene);

/// The frame that the options ask for.
vtResult vtMakeFrame(const vtOptions* options, const vtInput* input, vtFrame* frame, vtError* error);
