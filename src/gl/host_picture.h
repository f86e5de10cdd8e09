// The host's picture and its depth as a frame reads them: textures of the host's, read through samplers of
// ours, so that how the host filters or compares them does not matter.
#pragma once

#include "gl/target.h"

typedef struct vtHostPicture {
    GLuint color, depth; ///< 0: none
    GLuint samplers[2];  ///< of both, without comparison: nearest, of colours with levels blended
} vtHostPicture;

static inline bool vtHostPicture_IsThere(const vtHostPicture* host)
{
    return host->color != 0 || host->depth != 0;
}

#if VT_WITH_HOST
/// Makes the samplers, where they are not there yet. `levels`: the colours have all of theirs.
void vtHostPicture_Set(vtHostPicture* host, const vtGL* gl, GLuint color, GLuint depth, bool levels);

/// Binds both, to be unbound after the drawing: the samplers must not stay.
void vtHostPicture_Bind(const vtHostPicture* host, const vtGL* gl);
void vtHostPicture_Unbind(const vtHostPicture* host, const vtGL* gl);
void vtHostPicture_Destroy(vtHostPicture* host, const vtGL* gl);
#else
static inline void vtHostPicture_Set(vtHostPicture* host, const vtGL* gl, GLuint color, GLuint depth,
                                     bool levels)
{
    (void)host, (void)gl, (void)color, (void)depth, (void)levels;
}
static inline void vtHostPicture_Bind(const vtHostPicture* host, const vtGL* gl)
{
    (void)host, (void)gl;
}
static inline void vtHostPicture_Unbind(const vtHostPicture* host, const vtGL* gl)
{
    (void)host, (void)gl;
}
static inline void vtHostPicture_Destroy(vtHostPicture* host, const vtGL* gl)
{
    (void)host, (void)gl;
}
#endif
