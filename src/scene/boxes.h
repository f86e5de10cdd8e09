// Boxes of what is placed.
#pragma once

#include "vitrine.h"

/// The box in the world of the eight corners of the box from a to b.
void vtBoundBox(const vtTransform* toWorld, vtVec3 a, vtVec3 b, vtVec3* low, vtVec3* high);
