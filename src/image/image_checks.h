// What all decoders and encoders of pictures share.
#pragma once

#include "vitrine.h"

#define VT_MAX_IMAGE_SIDE 16384 ///< larger pictures are refused: they would not fit a texture either

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
