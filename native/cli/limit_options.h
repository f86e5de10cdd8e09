// --max-memory, --max-triangles, --max-pixels: what one file may ask for.
#pragma once

#include "vitrine.h"

/// Reads an amount of at least 1: a number, and behind it K, M, G or T. `option` is the name of one of the
/// three; those are powers of 1024 of memory, else of 1000.
vtResult vtReadLimit(const char* option, const char* text, vtLimits* limits, vtError* error);

/// May a picture of that size be drawn? `limits`: as given, 0 where they are not.
vtResult vtCheckDrawn(int width, int height, const vtLimits* limits, vtError* error);
