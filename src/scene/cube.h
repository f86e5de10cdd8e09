// Where a mesh's layered depth cube lies.
#pragma once

#include "vitrine.h"

/// Three orthonormal axes and the mesh's extent along each.
typedef struct vtCubeFrame {
    vtVec3 axes[3];
    vtVec3 low, high;
} vtCubeFrame;

/// Axes along which little of the mesh is seen edge-on: of a fixed set of rotations the one with the least
/// surface within 10 degrees of any of its axes.
vtCubeFrame vtFitCube(const vtMesh* mesh);
