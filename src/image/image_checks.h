// What all decoders and encoders of pictures share.
#pragma once

#include "vitrine.h"

#define VT_MAX_IMAGE_SIDE 16384 ///< larger pictures are refused: they would not fit a texture either
/// And so are those of more pixels: a panorama of the longest side has as many. A file of some hundred bytes
/// may declare any size; as floats these take 1.5 GB.
#define VT_MAX_IMAGE_PIXELS (16384L * 8192L)

/// Sentences about sides: of a relief's samples, with that result where they fail; of a picture that is
/// read (vt_errorFormat) or written.
vtResult vtCheckHeightSides(const char* name, long width, long height, vtResult failure, vtError* error);
vtResult vtCheckPictureSides(const char* name, long width, long height, vtError* error);
vtResult vtCheckWritten(int width, int height, vtError* error);

/// Of 8 or 16 bits that are no light but heights: integers, so that a file gives the same heights whoever
/// decodes it. Rec. 601's weights in 256ths.
static inline uint32_t vtLumaOfSamples(uint32_t red, uint32_t green, uint32_t blue)
{
    return (77 * red + 150 * green + 29 * blue) >> 8;
}

/// Of Rec. 709; grey stays what it is, to the last bit.
static inline float vtLuma(const float* rgb)
{
    return rgb[0] == rgb[1] && rgb[1] == rgb[2] ? rgb[0]
                                                : 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}
