// What an environment does to surfaces, for the shaders (shaders_es3/shade/lighting.glsl).
#pragma once

#include "gl/target.h"
#include "light/lighting.h"

/// Makes the RGBA16F texture: the levels as they lie in lighting->specular, then a row that begins with the
/// nine factors of irradiance. Replaces the texture there is; on failure that one stays.
vtResult vtLightingTexture_Upload(vtTexture* texture, const vtGL* gl, const vtLighting* lighting,
                                  vtError* error);
