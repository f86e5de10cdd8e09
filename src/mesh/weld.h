// Which vertices share a position, and the hash tables that answer it.
#pragma once

#include "vitrine.h"

/// Maps every vertex to the first one at exactly its position. `welded` has room for vertexCount numbers.
/// False where memory is out.
bool vtWeldPositions(const vtMesh* mesh, uint32_t* welded);

/// Scrambles all bits of a key (the finaliser of MurmurHash3), so that linear probing stays short.
uint64_t vtMixBits(uint64_t key);

/// The power of two that holds `count` keys at most four fifths full; 0 where size_t cannot express it.
size_t vtTableCapacity(uint32_t count);
