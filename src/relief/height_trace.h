// Rays against the heights of a relief, without triangles.
#pragma once

#include "mesh/height_field.h"

/// Shortcuts that spare a ray the look at cells. What it meets is the same without them; each can be
/// switched off to measure what it saves.
typedef enum vtSeparation {
    vt_separateBox = 1,    ///< the ray is cut to the box of the heights; without it, to their rectangle only
    vt_separateShadow = 2, ///< cells under the ray's shadow; without it, all cells there are
    vt_separateCells = 4,  ///< a cell's lowest and highest sample against the ray over it
    vt_separateTiles = 8,  ///< the same of larger and larger tiles; not without the shadow
    vt_separateAll = 15,
} vtSeparation;

typedef struct vtHeightHit {
    float distance;
    uint32_t triangle; ///< its number, see height_field.h
    float u, v;        ///< weights of its second and third corner
} vtHeightHit;

/// The first surface at a distance in (near, far), in units of the direction's length. `sides`: 1 surfaces
/// that the ray enters the glass through, 2 those that it leaves it through, 3 either. `separations`:
/// vtSeparation. False where there is none; *hit is then undefined.
bool vtHeightField_Trace(const vtHeightField* field, vtVec3 origin, vtVec3 direction, float near, float far,
                         int sides, unsigned separations, vtHeightHit* hit);

/// What a step from one ray to a neighbour, such as the next pixel's, does to its hit.
typedef struct vtFootprint {
    float u, v;      ///< of the hit's weights
    vtVec3 position; ///< within the triangle's plane
    vtVec3 normal;   ///< of the smooth unit normal
} vtFootprint;

/// `originStep`, `directionStep`: derivatives of the ray. All others are those of the hit: a picture's
/// footprint is that of its coordinates at the corners, T: (T1 - T0) u + (T2 - T0) v.
vtFootprint vtHeightField_Footprint(const vtHeightField* field, const vtHeightHit* hit, vtVec3 direction,
                                    vtVec3 originStep, vtVec3 directionStep);
