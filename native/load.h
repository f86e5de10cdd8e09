// From names on the command line to a scene.
#pragma once

#include "options.h"

typedef struct vtInput {
    vtMesh mesh;
    float ior; ///< of the command line, else of the file, else 1.5
    vtEnvironment environment;
} vtInput;

/// Loads model and environment, prints notes (computed normals) and warnings (an open mesh) to stderr.
vtResult vtLoadInput(const vtOptions* options, vtInput* input, vtError* error);
void vtDestroyInput(vtInput* input);

/// The frame that the options ask for.
vtResult vtMakeFrame(const vtOptions* options, const vtInput* input, vtFrame* frame, vtError* error);
