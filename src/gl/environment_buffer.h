// What surrounds the glass, on the GPU: to be seen, and as light on opaque things.
#pragma once

#include "gl/target.h"
#include "light/sun.h"

typedef struct vtEnvironmentBuffer {
    vtEnvironmentKind kind;
    vtTexture picture;  ///< RGB16F equirectangular, linear; one texel where the environment is built in
    vtTexture lighting; ///< RGBA16F, gl/lighting_texture.h; made when first used
    bool isSunless;     ///< the sun is left out of that
    vtSun sun;          ///< found in it, when first asked for; irradiance 0: there is none
    bool isSunKnown;
    vtEnvironment light; ///< what that is made of: a small copy
    vtTexture blurred;   ///< RGB16F equirectangular, linear: for backgrounds; made when first used
    float blurredBy;     ///< degrees
} vtEnvironmentBuffer;

/// One texel, for programs that read a picture which no pixel asks for.
void vtEnvironmentBuffer_Create(vtEnvironmentBuffer* buffer, const vtGL* gl);
/// Uploads an environment in place of the one before; on failure that one stays.
vtResult vtEnvironmentBuffer_Set(vtEnvironmentBuffer* buffer, const vtGL* gl,
                                 const vtEnvironment* environment, vtError* error);
/// Looks for the sun, once. Where memory is out there is none.
void vtEnvironmentBuffer_FindSun(vtEnvironmentBuffer* buffer);
/// Makes buffer->lighting, for scenes with something opaque. `sunless`: without the sun, which was looked
/// for. Does nothing where it is there.
vtResult vtEnvironmentBuffer_Light(vtEnvironmentBuffer* buffer, const vtGL* gl, bool sunless, vtError* error);
/// Makes buffer->blurred, by so many degrees. Does nothing where it is there.
vtResult vtEnvironmentBuffer_Blur(vtEnvironmentBuffer* buffer, const vtGL* gl, float degrees, vtError* error);
/// What vtEnvironmentBuffer_Light and vtEnvironmentBuffer_Blur have made.
void vtEnvironmentBuffer_DropLight(vtEnvironmentBuffer* buffer, const vtGL* gl);
void vtEnvironmentBuffer_Destroy(vtEnvironmentBuffer* buffer, const vtGL* gl);
size_t vtEnvironmentBuffer_Bytes(const vtEnvironmentBuffer* buffer);
