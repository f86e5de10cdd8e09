// What the command line and web pages know of reliefs beside vitrine.h.
#pragma once

#include "vitrine.h"

/// As vtLoadRelief; *bits: of a height in the file, 8, 16 or 32.
vtResult vtLoadReliefOfBits(const void* bytes, size_t size, const char* name, const vtReliefDef* def,
                            vtMesh* mesh, int* bits, vtError* error);

/// The same of a picture of 8 bits that is decoded already, RGBA, top row first.
vtResult vtCreateReliefOfPixels(const uint8_t* pixels, int width, int height, const char* name,
                                const vtReliefDef* def, vtMesh* mesh, vtError* error);

/// The relief `unit`, whose depth is 1, with another depth and slab: sooner than from its heights.
vtResult vtCreateReliefOfDepth(const vtMesh* unit, float depth, float thickness, const char* name,
                               vtMesh* mesh, vtError* error);

/// A number of the table of patterns, -1: there is none of that name.
int vtFindReliefPattern(const char* name);
