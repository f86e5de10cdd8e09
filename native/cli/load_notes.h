// What is worth saying of models and of what a technique leaves out of them, on standard error.
#pragma once

#include "cli/options.h"

/// Notes and warnings of a model's meshes, and what its file leaves out; `verbose`: sizes, too.
void vtPrintLoaded(const char* name, const vtScene* scene, bool verbose);

/// What the technique does not draw of the scene's materials.
void vtPrintLeftOut(vtTechnique technique, const vtScene* scene, const vtFrame* frame);
