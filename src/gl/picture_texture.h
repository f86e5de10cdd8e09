#pragma once

#include "gl/target.h"

/// Fails with vt_errorContext where a texture of that size is too large for the GPU; `what` it is of.
vtResult vtCheckTextureSize(const vtGL* gl, int width, int height, const char* what, vtError* error);

/// Makes a texture for a picture of that size, with all its levels, sRGB, in place of what there is, on
/// failure that stays; where it has that size already, nothing. `repeat`: what it shows beyond its sides
/// (GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT). It is bound to be filled. Fails as vtUploadPicture does.
vtResult vtMakePictureTexture(vtTexture* texture, const vtGL* gl, int width, int height, GLenum repeat,
                              const char* what, vtError* error);

/// Uploads a picture that is decoded, with all its levels, as sRGB, in place of what the texture holds; on
/// failure that stays. `repeat` as vtMakePictureTexture has it. Fails with vt_errorArgument where it has no
/// pixels, vt_errorContext where it is too large.
vtResult vtUploadPicture(vtTexture* texture, const vtGL* gl, const vtImage* picture, GLenum repeat,
                         const char* what, vtError* error);
