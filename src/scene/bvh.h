// A bounding volume hierarchy on the CPU: for work that is done once a mesh or for one ray at a time, also
// in the browser. The reference tracer has Embree.
#pragma once

#include "vitrine.h"

typedef struct vtBvh vtBvh;

typedef struct vtBvhHit {
    float distance;
    uint32_t triangle;
    float u, v; ///< barycentric weights of the triangle's second and third corner
} vtBvhHit;

/// Keeps a pointer to the mesh, which must outlive it. A relief is met by its heights; the triangles' numbers
/// are then those of height_field.h. NULL where memory is out.
vtBvh* vtCreateBvh(const vtMesh* mesh);
void vtDestroyBvh(vtBvh* bvh);

/// The first triangle beyond distance `start` that the ray leaves the glass through (`leaving`) or enters it
/// through. False where there is none.
bool vtBvh_Trace(const vtBvh* bvh, vtVec3 origin, vtVec3 direction, float start, bool leaving, vtBvhHit* hit);
