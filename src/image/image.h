// Pictures in memory: PNG, JPEG and Radiance HDR through stb (image.c), PFM (pfm.c).
// All buffers handed out come from malloc; the caller frees them.
#pragma once

#include "vitrine.h"

#define VT_MAX_IMAGE_SIDE 16384 ///< larger pictures are refused: they would not fit a texture either

/// The sRGB transfer curve of IEC 61966-2-1, exact piecewise form, no clamping above 1. Values below 0
/// follow the linear piece.
float vtSrgbToLinear(float encoded);
float vtLinearToSrgb(float linear);

/// 8-bit sRGB samples, top row first, to 3 linear floats a pixel; of `channels` (3 or 4) the first three
/// count. `name` goes into the error sentence. Fails with vt_errorFormat (a side out of range) or
/// vt_errorMemory; then *pixels is NULL.
vtResult vtLinearise(const uint8_t* samples, int channels, const char* name, int width, int height,
                     float** pixels, vtError* error);

/// Decodes PNG, JPEG (sRGB, converted to linear; alpha is dropped, grey is spread) or HDR (linear as it is)
/// to 3 floats a pixel, top row first. Numbers are made usable: NaN and negative become 0, the rest is at
/// most 65504, the largest half float. `name` goes into the error sentence.
/// Fails with vt_errorFormat or vt_errorMemory; then *pixels is NULL.
vtResult vtDecodeImageLinear(const void* bytes, size_t size, const char* name, float** pixels, int* width,
                             int* height, vtError* error);

/// Decodes PNG or JPEG to RGBA as the file has it (sRGB). A build without these decoders keeps a copy of the
/// file in image->bytes instead. `name` goes into the error sentence. Fails with vt_errorFormat or
/// vt_errorMemory; then *image is zeroed.
vtResult vtDecodeImage(const void* bytes, size_t size, const char* name, vtImage* image, vtError* error);

/// Encodes 8-bit pixels, top row first; `channels` is 1 (grey), 3 (RGB) or 4 (RGBA).
vtResult vtEncodePng(const uint8_t* pixels, int channels, int width, int height, uint8_t** bytes,
                     size_t* size, vtError* error);

/// Encodes 3 floats a pixel, top row first, as PFM: "PF", scale -1.0 (little endian), bottom row first.
vtResult vtEncodePfm(const float* rgb, int width, int height, uint8_t** bytes, size_t* size, vtError* error);

/// Decodes a colour PFM of either byte order; *rgb is top row first, numbers untouched (NaN included).
vtResult vtDecodePfm(const void* bytes, size_t size, const char* name, float** rgb, int* width, int* height,
                     vtError* error);

/// Whether this begins as a PNG, JPEG, Radiance HDR or PFM file does; a PFM.
bool vtIsPicture(const void* bytes, size_t size);
bool vtIsPfm(const void* bytes, size_t size);

/// Decodes any of these to one number a pixel, top row first: PNG and JPEG as they are stored, 0 to 1, the
/// others untouched (NaN included), colours by their luma. *bits: of a number in the file, 8, 16 or 32. Sides
/// must be those of a relief. `name` goes into the error sentence. Fails with vt_errorFormat or
/// vt_errorMemory; then *heights is NULL.
vtResult vtDecodeHeights(const void* bytes, size_t size, const char* name, float** heights, int* width,
                         int* height, int* bits, vtError* error);

/// Its part for PFM, grey ("Pf") too.
vtResult vtDecodePfmHeights(const void* bytes, size_t size, const char* name, float** heights, int* width,
                            int* height, vtError* error);

/// Sentences about sides: of a relief's samples, with that result where they fail; of a picture that is
/// written.
vtResult vtCheckHeightSides(const char* name, long width, long height, vtResult failure, vtError* error);
vtResult vtCheckWritten(int width, int height, vtError* error);

/// Of Rec. 709; grey stays what it is, to the last bit.
static inline float vtLuma(const float* rgb)
{
    return rgb[0] == rgb[1] && rgb[1] == rgb[2] ? rgb[0]
                                                : 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}
