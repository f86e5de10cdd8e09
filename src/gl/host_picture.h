// The host's picture and its depth as a frame reads them: textures of the host's, read through a sampler of
// ours, so that how the host filters or compares them does not matter.
#pragma once

#include "gl/target.h"

typedef struct vtHostPicture {
    GLuint color, depth; ///< 0: none
    GLuint sampler;      ///< nearest, no comparison
} vtHostPicture;

static inline bool vtHostPicture_IsThere(const vtHostPicture* host)
{
    return host->color != 0 || host->depth != 0;
}

#if VT_WITH_HOST
/// Makes the sampler, where it is not there yet.
void vtHostPicture_Set(vtHostPicture* host, const vtGL* gl, GLuint color, GLuint depth);

/// Binds both, to be unbound after the drawing: the sampler must not stay.
void vtHostPicture_Bind(const vtHostPicture* host, const vtGL* gl);
void vtHostPicture_Unbind(const vtHostPicture* host, const vtGL* gl);
void vtHostPicture_Destroy(vtHostPicture* host, const vtGL* gl);
#else
static inline void vtHostPicture_Set(vtHostPicture* host, const vtGL* gl, GLuint color, GLuint depth)
{
    (void)host, (void)gl, (void)color, (void)depth;
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
