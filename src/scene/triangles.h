// A mesh as records of single triangles that know their neighbours: what the shaders read where they meet
// triangles rather than pixels.
#pragma once

#include "vitrine.h"

/// Words of one record: four texels of four. Texels 0 to 2 hold a corner each: the bits of its position and
/// the triangle across the edge opposite to it (VT_NO_TRIANGLE: the edge is open). Texel 3 holds the
/// corners' normals, octahedral (shaders_es3/octahedral.glsl), and nothing.
#define VT_TRIANGLE_WORDS 16

/// The records of all triangles, in the order of the indices; NULL where memory is out. Free with free.
/// Neighbours are found over welded positions; of more than two triangles at an edge the first two pair.
uint32_t* vtCreateTriangleRecords(const vtMesh* mesh);
