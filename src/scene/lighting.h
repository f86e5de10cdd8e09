// What an environment does to a surface.
#pragma once

#include "vitrine.h"

typedef struct vtLighting {
    const vtEnvironment* environment; ///< must outlive it
    vtVec3 irradiance[9];             ///< by spherical harmonics up to band 2 (Ramamoorthi & Hanrahan 2001)
} vtLighting;

vtResult vtCreateLighting(const vtEnvironment* environment, vtLighting* lighting, vtError* error);
void vtDestroyLighting(vtLighting* lighting);
