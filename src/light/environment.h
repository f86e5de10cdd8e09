// The built-in surroundings in C; shaders_es3/shade/environment.glsl holds the same functions under the same
// names and must give the same numbers.
#pragma once

#include "vitrine.h"

/// Radiance from a unit direction.
vtVec3 environmentChecker(vtVec3 d);
vtVec3 environmentStudio(vtVec3 d);
vtVec3 environmentSky(vtVec3 d);

/// Bilinear between texel centres as GL does, u repeated and v clamped.
vtVec3 environmentImage(const vtEnvironment* environment, vtVec3 d);
