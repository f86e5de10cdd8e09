#pragma once

#include "gl/target.h"

/// Fails with vt_errorContext where a texture of that size is too large for the GPU; `what` it is of.
vtResult vtCheckTextureSize(const vtGL* gl, int width, int height, const char* what, vtError* error);

/// Uploads a picture that is decoded, with all its levels, as sRGB, in place of what the texture holds; on
/// failure that stays. Fails with vt_errorArgument where it has no pixels, vt_errorContext where it is too
/// large.
vtResult vtUploadPicture(vtTexture* texture, const vtGL* gl, const vtImage* picture, const char* what,
                         vtError* error);
