// The built-in surroundings in C; shaders_es3/shade/environment.glsl holds the same functions, without the vt
// before their names, and must give the same numbers.
#pragma once

#include "vitrine.h"

/// Radiance from a unit direction.
vtVec3 vtEnvironmentChecker(vtVec3 d);
vtVec3 vtEnvironmentStudio(vtVec3 d);
vtVec3 vtEnvironmentSky(vtVec3 d);

/// Where an equirectangular picture shows it: u from the left and v from the top, 0 to 1.
vtVec3 vtEnvironmentDirection(float u, float v);

/// Bilinear between texel centres as GL does, u repeated and v clamped.
vtVec3 vtEnvironmentImage(const vtEnvironment* environment, vtVec3 d);
