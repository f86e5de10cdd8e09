// The scene's images, for the shaders (shaders_es3/shade/shading.glsl).
#pragma once

#include "gl/target.h"

/// No image is larger on the GPU.
#define VT_MAX_ARRAY_SIDE 2048

/// Makes one SRGB8_ALPHA8 array with mipmaps, repeated and trilinear: image i of the scene is layer i. All
/// layers are squares of one size, a power of two, at least as large as the largest image that an opaque
/// material uses; images that are none, or not decoded, are white. Without any it is a white texel.
/// Metallic-roughness images, which are linear, are stored as sRGB, so that reading gives the linear value
/// again; an image that is a base colour, too, stays as it is. A scene of images alone, without materials:
/// all are used, as their `linear` says. Replaces the texture there is; on failure that one stays:
/// vt_errorContext (more images than layers) or vt_errorMemory.
vtResult vtImageArray_Upload(vtTexture* texture, const vtGL* gl, const vtScene* scene, vtError* error);
