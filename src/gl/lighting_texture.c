#include "gl/lighting_texture.h"

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"

enum { side = VT_LIGHTING_SIDE };

/// As much of it as halves hold.
static void writeTexel(float* texel, vtVec3 light)
{
    const float largest = 65504.0f;
    texel[0] = vtClamp(light.x, -largest, largest);
    texel[1] = vtClamp(light.y, -largest, largest);
    texel[2] = vtClamp(light.z, -largest, largest);
    texel[3] = 1.0f;
}

vtResult vtLightingTexture_Upload(vtTexture* texture, const vtGL* gl, const vtLighting* lighting,
                                  vtError* error)
{
    float* texels = vtAllocateZeroed((size_t)side * (side + 1), 4 * sizeof *texels);
    if (texels == NULL) {
        return vtFail(error, vt_errorMemory, "lighting: out of memory");
    }
    for (size_t i = 0; i < (size_t)side * side; ++i) {
        writeTexel(texels + 4 * i, lighting->specular[i]);
    }
    for (size_t i = 0; i < 9; ++i) {
        writeTexel(texels + 4 * ((size_t)side * side + i), lighting->irradiance[i]);
    }
    vtTexture fresh = {0};
    vtTexture_Resize(&fresh, gl, GL_RGBA16F, side, side + 1, 0);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, side, side + 1, GL_RGBA, GL_FLOAT, texels);
    vtFree(texels);
    const vtResult result = vtCheckGL(gl, "uploading the lighting", error);
    vtTexture* old = result == vt_ok ? texture : &fresh;
    vtTexture_Destroy(old, gl);
    if (result == vt_ok) {
        *texture = fresh;
    }
    return result;
}
