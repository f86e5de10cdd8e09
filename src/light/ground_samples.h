// Directions that stand for the light over a ground.
#pragma once

#include "light/sun.h"
#include "shaders_es3/common/constants.h"

/// Shade rays go from the ground towards the light: what they meet is in the light's way. Photons come from
/// the light, through the box of the glass, and bring what glass bends or reflects.
typedef enum vtGroundRays { vt_groundShade = 0, vt_groundPhotons, vt_groundRaysCount } vtGroundRays;

/// One direction out of VT_GROUND_SAMPLES that stand for a light.
typedef struct vtLightSample {
    vtVec3 direction; ///< towards it
    vtVec3 color; ///< irradiance, if all light came from here: for shade rays of the ground, for photons of
                  ///< a surface that faces it
} vtLightSample;

static inline void vtMakeAxes(vtVec3 direction, vtVec3* right, vtVec3* up)
{
    const vtVec3 other = fabsf(direction.y) < 0.9f ? (vtVec3){0.0f, 1.0f, 0.0f} : (vtVec3){1.0f, 0.0f, 0.0f};
    *right = vtNormalize(vtCross(direction, other));
    *up = vtCross(direction, *right);
}

/// Of a sun, VT_GROUND_SAMPLES for rays of each kind.
void vtSampleSun(const vtSun* sun, vtLightSample* samples[vt_groundRaysCount]);

/// Of the upper half of an environment without that sun; *irradiance: of the ground. False where memory is
/// out.
bool vtSampleSky(const vtEnvironment* environment, const vtSun* sun,
                 vtLightSample* samples[vt_groundRaysCount], vtVec3* irradiance);
