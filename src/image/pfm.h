// PFM: floats as they are. All buffers handed out come from malloc; the caller frees them.
#pragma once

#include "vitrine.h"

/// Whether this begins as a PFM file does.
bool vtIsPfm(const void* bytes, size_t size);

/// Encodes 3 floats a pixel, top row first, as PFM: "PF", scale -1.0 (little endian), bottom row first.
vtResult vtEncodePfm(const float* rgb, int width, int height, uint8_t** bytes, size_t* size, vtError* error);

/// Decodes a colour PFM of either byte order; *rgb is top row first, numbers untouched (NaN included).
vtResult vtDecodePfm(const void* bytes, size_t size, const char* name, float** rgb, int* width, int* height,
                     vtError* error);
