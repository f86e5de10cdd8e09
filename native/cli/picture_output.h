// The picture as a file: PNG of 8 or 16 bits, or linear light as OpenEXR or Radiance HDR.
#pragma once

#include "cli/options.h"

typedef enum vtPictureFormat {
    vt_formatPng = 0, ///< 8 bits
    vt_formatPng16,
    vt_formatExr,
    vt_formatHdr,
} vtPictureFormat;

/// By the end of the file's name and --bits. Fails with vt_errorArgument where the two, or --analysis,
/// contradict each other. Tells of a name that ends like another kind.
vtResult vtChoosePictureFormat(const vtOptions* options, vtPictureFormat* format, vtError* error);

/// Is linear light written, without tone mapping?
static inline bool vtPictureFormat_IsLinear(vtPictureFormat format)
{
    return format >= vt_formatExr;
}

/// Encodes 4 floats a pixel as vtRenderer_DrawFloats gives them, of a format of more than 8 bits. *bytes are
/// vtFree's. `comment`: of the file, NULL: none. `pixels`: where they go as 8 bits, too.
vtResult vtEncodePicture(const float* rgba, vtPictureFormat format, const vtFrame* frame, const char* comment,
                         uint8_t* pixels, uint8_t** bytes, size_t* size, vtError* error);
