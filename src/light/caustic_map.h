// Light that glass bends onto opaque things, as it was gathered: caustics.h.
#pragma once

#include "base/math.h"
#include "shaders_es3/common/constants.h"

/// What is gathered, as shaders read it (constants.h, VT_CAUSTIC_...): rows of VT_CAUSTIC_COLUMNS texels of
/// four words. Zeroed: nothing.
typedef struct vtCausticMap {
    uint32_t* words;
    uint32_t rows;
} vtCausticMap;

void vtDestroyCausticMap(vtCausticMap* map);

/// Irradiance at a place of a triangle. The twin of shaders_es3/ground/caustics.glsl.
vtVec3 vtCausticMap_Light(const vtCausticMap* map, uint32_t object, uint32_t triangle, float u, float v,
                          bool behind);

/// A number for a triangle, by which the table finds it.
uint32_t vtCausticHash(uint32_t object, uint32_t triangle);
/// The three samples about a place of a lattice of so many sides, and how much each counts.
void vtCausticSamples(uint32_t sides, float u, float v, int32_t at[3][2], float weights[3]);
