// Reliefs named on the command line.
#pragma once

#include "cli/options.h"
#include "scene/object_spec.h"

/// What a MODEL's options, or with `spec` (else NULL) an object's keys, say of a relief of `pattern`; -1: of
/// a picture.
vtReliefDef vtMakeReliefDef(const vtOptions* options, const vtObjectSpec* spec, int pattern);

/// Fails with a sentence where one of these options is given, but MODEL is of another kind.
vtResult vtCheckReliefOptions(const vtOptions* options, vtObjectKind kind, vtError* error);

/// A scene of one relief: a built-in one, and that of a picture's bytes, with a note on how it is smoothed.
vtResult vtLoadReliefPattern(int pattern, const vtReliefDef* def, vtScene* scene, vtError* error);
vtResult vtLoadReliefFile(const char* name, const void* bytes, size_t size, const vtReliefDef* def,
                          vtScene* scene, vtError* error);

/// The technique that a scene is drawn with: what the options say, else what suits the scene.
const char* vtChooseTechnique(const vtOptions* options, const vtScene* scene);
