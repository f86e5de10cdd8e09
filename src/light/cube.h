// Pictures of a cube's six faces.
#pragma once

#include "vitrine.h"

/// Makes an equirectangular picture of one of six faces: a strip of 6:1 or 1:6; a cross of 4:3 or 3:4, which
/// is told from other pictures of these sides by the six squares beside it: they are of one colour. Leaves
/// any other. Fails with vt_errorMemory; then *environment is as before.
vtResult vtUnfoldCube(vtEnvironment* environment, const char* name, vtError* error);
