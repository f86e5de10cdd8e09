#pragma once

#include "gl/target.h"

/// Uploads a picture that is decoded, with all its levels, as sRGB, in place of what the texture holds; on
/// failure that stays. Fails with vt_errorArgument where it has no pixels, vt_errorContext where it is too
/// large.
vtResult vtUploadPicture(vtTexture* texture, const vtGL* gl, const vtImage* picture, const char* what,
                         vtError* error);
