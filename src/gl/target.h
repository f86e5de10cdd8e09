// Textures and framebuffers: made, sized, freed. Everything is nearest-filtered unless it is a picture.
#pragma once

#include "gl/gl.h"
#include "shaders_es3/common/constants.h"

/// A 2-D texture (layers = 0) or 2-D array (layers > 0) of immutable size.
typedef struct vtTexture {
    GLuint name;
    GLenum target;
    GLenum format;
    int width, height, layers;
    bool mipmapped; ///< down to one texel
} vtTexture;

/// Makes the texture of that format and size, dropping an older one of another; does nothing where the
/// size is stable. layers = 0: GL_TEXTURE_2D, else GL_TEXTURE_2D_ARRAY. True where it was made anew.
bool vtTexture_Resize(vtTexture* texture, const vtGL* gl, GLenum format, int width, int height, int layers);
/// Makes room for `count` records of VT_RECORD_WORDS, VT_RECORDS_A_ROW a row, one row at least; fills some of
/// it.
void vtTexture_SizeRecords(vtTexture* texture, const vtGL* gl, uint32_t count);
void vtTexture_SetRecords(const vtTexture* texture, const vtGL* gl, uint32_t first, uint32_t count,
                          const uint32_t* words);
void vtTexture_Destroy(vtTexture* texture, const vtGL* gl);
size_t vtTexture_Bytes(const vtTexture* texture);

/// The textures that shaders read, by the names that program.c gives them. Each has the texture unit of its
/// number in every program; GL has at least 32 of them.
typedef enum vtSampler {
    vt_samplerNone = 0, ///< where textures are made and filled
    vt_samplerSurface,
    vt_samplerInnerDistances,
    vt_samplerLayerDepths,
    vt_samplerLayerNormals,
    vt_samplerMergedDepths,
    vt_samplerPreviousDepth,
    vt_samplerObjects,
    vt_samplerRecords,
    vt_samplerObjectTree,
    vt_samplerAttributes,
    vt_samplerImages,
    vt_samplerMaterials,
    vt_samplerHeights,
    vt_samplerHeightRanges,
    vt_samplerEnvironment,
    vt_samplerLighting,
    vt_samplerPaths,
    vt_samplerEnds,
    vt_samplerLights,
    vt_samplerAsides,
    vt_samplerRadiance,
    vt_samplerSum,
    vt_samplerDepths,
    vt_samplerHostColor,
    vt_samplerHostDepth,
    vt_samplerBackground,
    vt_samplerBackdrop,
    vt_samplerGround,
    vt_samplerGroundLights,
    vt_samplerCaustics,
    vt_samplerCount,
} vtSampler;

/// For a program to read, or with vt_samplerNone to be filled.
void vtTexture_Bind(const vtTexture* texture, const vtGL* gl, vtSampler sampler);

typedef struct vtBinding {
    vtSampler sampler;
    const vtTexture* texture;
} vtBinding;

/// The same of several; those that are NULL or not there are left out.
void vtBindTextures(const vtGL* gl, const vtBinding* bindings, size_t count);

#define VT_MAX_ATTACHMENTS 4

/// A texture, or one layer of an array, to draw into.
typedef struct vtAttachment {
    const vtTexture* texture;
    int layer;
} vtAttachment;

/// (Re)makes a framebuffer of up to VT_MAX_ATTACHMENTS colours and an optional depth texture, checks that
/// it is complete and leaves it bound.
vtResult vtMakeFramebuffer(const vtGL* gl, const char* name, const vtAttachment* colors, int colorCount,
                           const vtTexture* depth, GLuint* framebuffer, vtError* error);
void vtDestroyFramebuffers(const vtGL* gl, GLuint* framebuffers, int count);

/// Binds framebuffer and viewport.
void vtBindFramebuffer(const vtGL* gl, GLuint framebuffer, int width, int height);
