// The scene's images, for the shaders (shaders_es3/shade/shading.glsl, looks.glsl).
#pragma once

#include "gl/target.h"
#include "scene/material.h"

/// No image is larger on the GPU, and all of them together are no more than so many bytes.
#define VT_MAX_ARRAY_SIDE 2048
#define VT_MAX_ARRAY_BYTES ((size_t)1 << 30)

/// What a layer of the array holds: an image as colours (sRGB) or as numbers, to be read blended or as
/// squares.
typedef struct vtImageLayer {
    int image;
    bool color, nearest;
    int width, height; ///< of the image
} vtImageLayer;

typedef struct vtImageArray {
    vtTexture texture;
    vtImageLayer* layers; ///< texture.layers of them, unless there are none
    uint32_t count;
    bool isReduced; ///< some image is larger than it
} vtImageArray;

/// Makes one SRGB8_ALPHA8 array with mipmaps, repeated and trilinear: a layer for each use that the scene's
/// materials make of an image. All layers are squares of one size, a power of two, at least as large as the
/// largest image, within the limits above; images that are none, or not decoded, are white. Without any it is
/// a white texel. Numbers are stored as sRGB, so that reading gives the linear value again. A scene of images
/// alone, without materials: layer i is image i, as its `linear` says. Replaces the array there is; on
/// failure that one stays: vt_errorContext (more images than layers) or vt_errorMemory.
vtResult vtImageArray_Upload(vtImageArray* array, const vtGL* gl, const vtScene* scene, vtError* error);
void vtImageArray_Destroy(vtImageArray* array, const vtGL* gl);

/// The layer that a material's map is read from; VT_NO_TRIANGLE: none.
uint32_t vtImageArray_Layer(const vtImageArray* array, const vtMap* map, vtMapUse use);
