// Pictures in memory, told apart by how they begin: PNG, JPEG, WebP and OpenEXR through their libraries,
// which a build for the web has not (VT_HDR_ONLY), Radiance HDR and PFM. The caller frees the buffers handed
// out by vtFree.
#pragma once

#include "vitrine.h"

/// The sRGB transfer curve of IEC 61966-2-1, exact piecewise form, no clamping above 1. Values below 0
/// follow the linear piece.
float vtSrgbToLinear(float encoded);
float vtLinearToSrgb(float linear);

/// 8-bit sRGB samples, top row first, to 3 linear floats a pixel; of `channels` (3 or 4) the first three
/// count. `name` goes into the error sentence. Fails with vt_errorFormat (a side out of range) or
/// vt_errorMemory; then *pixels is NULL.
vtResult vtLinearise(const uint8_t* samples, int channels, const char* name, int width, int height,
                     float** pixels, vtError* error);

/// Decodes PNG, JPEG, WebP (sRGB, converted to linear; alpha is dropped, grey is spread) or the others
/// (linear as they are) to 3 floats a pixel, top row first. Numbers are made usable: NaN and negative become
/// 0, the rest is at most 65504, the largest half float. `name` goes into the error sentence. Fails with
/// vt_errorFormat or vt_errorMemory; then *pixels is NULL.
vtResult vtDecodeImageLinear(const void* bytes, size_t size, const char* name, float** pixels, int* width,
                             int* height, vtError* error);

/// Decodes PNG, JPEG or WebP to RGBA as the file has it (sRGB). A build without these decoders keeps a copy
/// of the file in image->bytes instead. `name` goes into the error sentence. Fails with vt_errorFormat or
/// vt_errorMemory; then *image is zeroed.
vtResult vtDecodeImage(const void* bytes, size_t size, const char* name, vtImage* image, vtError* error);

/// Encodes 8-bit pixels, top row first; `channels` is 1 (grey), 3 (RGB) or 4 (RGBA).
vtResult vtEncodePng(const uint8_t* pixels, int channels, int width, int height, uint8_t** bytes,
                     size_t* size, vtError* error);

/// The same of 8 or 16 `bits`, with a comment in the file: a line of ASCII, NULL: none.
vtResult vtEncodePngOf(const void* pixels, int channels, int bits, int width, int height, const char* comment,
                       uint8_t** bytes, size_t* size, vtError* error);

/// Encodes linear light, top row first, as OpenEXR: floats as they are; `channels` is 3 (RGB) or 4 (RGBA, the
/// colours times alpha). `comment`: as above.
vtResult vtEncodeExr(const float* pixels, int channels, int width, int height, const char* comment,
                     uint8_t** bytes, size_t* size, vtError* error);

/// The same of 3 floats a pixel as Radiance HDR: within 0.4 % of a pixel's largest number, which is at
/// most 1.7e38.
vtResult vtEncodeHdr(const float* rgb, int width, int height, const char* comment, uint8_t** bytes,
                     size_t* size, vtError* error);

/// Looks at a picture's header alone, before memory is taken: fails with vt_errorFormat for more pixels than
/// the limits allow (NULL: the defaults), with vt_errorMemory where its samples and what is made of them,
/// `bytesPerPixel`, take more memory. *pixels, which may be NULL: how many it declares. What is damaged
/// passes: decoding it tells what is wrong.
vtResult vtCheckPicture(const void* bytes, size_t size, const char* name, const vtLimits* limits,
                        size_t bytesPerPixel, uint64_t* pixels, vtError* error);

/// The same of a picture of that size, all of whose bytes are told.
vtResult vtCheckPictureSize(const char* name, long width, long height, size_t bytesPerPixel,
                            const vtLimits* limits, vtError* error);

/// Whether this begins as a file of these formats does.
bool vtIsPicture(const void* bytes, size_t size);

/// Decodes any of these to one number a pixel, top row first: PNG, JPEG and WebP as they are stored, 0 to 1,
/// the others untouched (NaN included), colours by their luma. *bits: of a number in the file, 8, 16 or 32.
/// Sides must be those of a relief. `name` goes into the error sentence. Fails with vt_errorFormat or
/// vt_errorMemory; then *heights is NULL.
vtResult vtDecodeHeights(const void* bytes, size_t size, const char* name, float** heights, int* width,
                         int* height, int* bits, vtError* error);
