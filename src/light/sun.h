// The one light that is small and bright: found in an environment, or given. The twin of
// shaders_es3/ground/shade.glsl.
#pragma once

#include "base/math.h"

/// A light that is as good as a disc, infinitely far away.
typedef struct vtSun {
    vtVec3 direction;  ///< towards it, unit
    float radius;      ///< radians
    vtVec3 irradiance; ///< of a surface that faces it; 0: there is none
    float brightest;   ///< luminance from which on the environment is part of it
} vtSun;

static inline bool vtSun_IsThere(const vtSun* sun)
{
    return sun->irradiance.x > 0.0f || sun->irradiance.y > 0.0f || sun->irradiance.z > 0.0f;
}

/// A direction of the upper half: u about the upright axis, elevation from 0 to 1 (a right angle).
static inline vtVec3 vtSkyDirection(float u, float elevation)
{
    const float azimuth = 2.0f * VT_PI * (u - 0.5f), angle = 0.5f * VT_PI * elevation;
    return (vtVec3){cosf(angle) * cosf(azimuth), sinf(angle), cosf(angle) * sinf(azimuth)};
}

/// What the environment has of a sun: see sun.c. False where memory is out.
bool vtFindSun(const vtEnvironment* environment, vtSun* sun);

/// Is light from that direction, of the environment that the sun was found in, the sun's?
bool vtSun_Holds(const vtSun* sun, vtVec3 direction, vtVec3 light);
/// Radiance of that environment without the sun.
vtVec3 vtSampleWithoutSun(const vtEnvironment* environment, const vtSun* sun, vtVec3 direction);

/// The sun over a ground: its own where it gives one, in place of the one found.
vtSun vtGivenSun(const vtGround* ground, const vtSun* found);

/// Radiance about the unit direction that a surface of that roughness reflects to, over the sun's irradiance:
/// what vtLighting_Specular has less where the sun is taken out of it.
float vtSun_Glare(const vtSun* sun, vtVec3 direction, float roughness);
