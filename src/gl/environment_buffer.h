// What surrounds the glass, on the GPU: to be seen, and as light on opaque things.
#pragma once

#include "gl/target.h"

typedef struct vtEnvironmentBuffer {
    vtEnvironmentKind kind;
    vtTexture picture;   ///< RGB16F equirectangular, linear; one texel where the environment is built in
    vtTexture lighting;  ///< RGBA16F, gl/lighting_texture.h; made when first used
    vtEnvironment light; ///< what that is made of: a small copy
    vtTexture blurred;   ///< RGB16F equirectangular, linear: for backgrounds; made when first used
    float blurredBy;     ///< degrees
} vtEnvironmentBuffer;

/// One texel, for programs that read a picture which no pixel asks for.
void vtEnvironmentBuffer_Create(vtEnvironmentBuffer* buffer, const vtGL* gl);
/// Uploads an environment in place of the one before; on failure that one stays.
vtResult vtEnvironmentBuffer_Set(vtEnvironmentBuffer* buffer, const vtGL* gl,
                                 const vtEnvironment* environment, vtError* error);
/// Makes buffer->lighting, for scenes with something opaque. Does nothing where it is there.
vtResult vtEnvironmentBuffer_Light(vtEnvironmentBuffer* buffer, const vtGL* gl, vtError* error);
/// Makes buffer->blurred, by so many degrees. Does nothing where it is there.
vtResult vtEnvironmentBuffer_Blur(vtEnvironmentBuffer* buffer, const vtGL* gl, float degrees, vtError* error);
void vtEnvironmentBuffer_Destroy(vtEnvironmentBuffer* buffer, const vtGL* gl);
size_t vtEnvironmentBuffer_Bytes(const vtEnvironmentBuffer* buffer);
