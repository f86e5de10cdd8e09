// Light that glass bends onto opaque things: photons gathered on their triangles. Who follows the photons is
// left open, as in ground.h.
#pragma once

#include "light/caustic_map.h"

/// A photon that has come down on a triangle.
typedef struct vtCausticHit {
    uint32_t object, triangle; ///< any numbers that tell triangles apart
    float u, v;                ///< weights of its second and third corner
    bool behind;               ///< it came from the side that the triangle's normal does not point to
    vtVec3 flux;
} vtCausticHit;

typedef struct vtCaustics {
    vtCausticHit* hits;
    uint32_t count, capacity;
} vtCaustics;

/// False where memory is out.
bool vtCaustics_Add(vtCaustics* caustics, const vtCausticHit* hit);
void vtDestroyCaustics(vtCaustics* caustics);

/// The corners of a triangle, world.
typedef struct vtCornersOf {
    void (*corners)(const void* data, uint32_t object, uint32_t triangle, vtVec3 p[3]);
    const void* data;
} vtCornersOf;

/// Gathers the hits on lattices of that spacing, world, or wider where they would be too many. *map is to be
/// destroyed. False where memory is out; then it is zeroed.
bool vtCaustics_Gather(const vtCaustics* caustics, float spacing, const vtCornersOf* of, vtCausticMap* map);
