// What an environment does to a surface: the light that matt and glossy surfaces see. The twin of
// shaders_es3/shade/lighting.glsl, which has the numbers from src/gl/lighting_texture.h.
#pragma once

#include "light/sun.h"

// Equirectangular pictures of the environment blurred for five roughnesses, one below the other. Level i is
// max(VT_LIGHTING_SIDE >> i, VT_LIGHTING_LEAST) wide, half as high, starts at row
// VT_LIGHTING_SIDE - (VT_LIGHTING_SIDE >> i) and holds roughness 0.025 (i + 1) (i + 4): 0.1, 0.25, 0.45,
// 0.7, 1.
#define VT_LIGHTING_SIDE 256
#define VT_LIGHTING_LEAST 32
#define VT_LIGHTING_LEVELS 5

typedef struct vtLighting {
    const vtEnvironment* environment; ///< must outlive it
    /// Mean radiance over the cosine lobe about n: factors of 1, y, z, x, xy, yz, 3zz - 1, xz, xx - yy.
    vtVec3 irradiance[9];
    vtVec3* specular; ///< VT_LIGHTING_SIDE squared, the levels
} vtLighting;

/// Some tens of milliseconds. `without`: a sun that is left out of diffuse and blurred light, since it is a
/// light of its own; NULL: none. Fails with vt_errorMemory; then *lighting is zeroed.
vtResult vtCreateLighting(const vtEnvironment* environment, const vtSun* without, vtLighting* lighting,
                          vtError* error);
void vtDestroyLighting(vtLighting* lighting);

/// Radiance of a matt white surface (irradiance over pi) with that unit normal.
vtVec3 vtLighting_Diffuse(const vtLighting* lighting, vtVec3 normal);

/// Radiance about the unit direction a surface of that roughness (0 to 1) reflects to; 0: the environment.
vtVec3 vtLighting_Specular(const vtLighting* lighting, vtVec3 direction, float roughness);
