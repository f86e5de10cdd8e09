#include "gl/environment_buffer.h"

#include "base/error.h"
#include "base/memory.h"
#include "gl/lighting_texture.h"
#include "gl/picture_texture.h"
#include "light/blur.h"
#include "light/environment_levels.h"

void vtEnvironmentBuffer_Create(vtEnvironmentBuffer* buffer, const vtGL* gl)
{
    *buffer = (vtEnvironmentBuffer){0};
    vtTexture_Resize(&buffer->picture, gl, GL_RGB16F, 1, 1, 0);
}

/// A copy whose picture, if it has one, is at most 512 wide: enough for light on surfaces.
static vtResult shrinkEnvironment(const vtEnvironment* environment, vtEnvironment* shrunk, vtError* error)
{
    *shrunk = *environment;
    if (environment->kind != vt_environmentImage) {
        return vt_ok;
    }
    const int factor = (environment->width + 511) / 512;
    shrunk->width = environment->width / factor;
    shrunk->height = environment->height / factor > 0 ? environment->height / factor : 1;
    shrunk->pixels = vtAllocateZeroed((size_t)shrunk->width * (size_t)shrunk->height, 3 * sizeof(float));
    if (shrunk->pixels == NULL) {
        return vtFail(error, vt_errorMemory, "environment: out of memory");
    }
    const int down = environment->height < factor ? environment->height : factor;
    for (int y = 0; y < shrunk->height * down; ++y) {
        for (int x = 0; x < shrunk->width * factor; ++x) {
            const float* from =
                environment->pixels + 3 * ((size_t)y * (size_t)environment->width + (size_t)x);
            float* to =
                shrunk->pixels + 3 * ((size_t)(y / down) * (size_t)shrunk->width + (size_t)(x / factor));
            for (int k = 0; k < 3; ++k) {
                to[k] += from[k] / (float)(factor * down);
            }
        }
    }
    return vt_ok;
}

/// A texture for a picture of that size and all its levels.
static void makePicture(vtTexture* texture, const vtGL* gl, int width, int height)
{
    *texture = (vtTexture){0, GL_TEXTURE_2D, GL_RGB16F, width, height, 0, true};
    gl->GenTextures(1, &texture->name);
    vtTexture_Bind(texture, gl, vt_samplerNone);
    gl->TexStorage2D(GL_TEXTURE_2D, vtEnvironmentLevelCount(width, height), texture->format, width, height);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

static vtResult uploadPicture(vtTexture* texture, const vtGL* gl, const vtEnvironment* environment,
                              vtError* error)
{
    const int width = environment->width, height = environment->height;
    makePicture(texture, gl, width, height);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGB, GL_FLOAT, environment->pixels);
    const size_t quarter = (size_t)(width / 2 + 1) * (size_t)(height / 2 + 1);
    float* shown = vtAllocate(quarter, 3 * sizeof *shown);
    vtEnvironmentLevel level = {0};
    bool ready = shown != NULL;
    for (int i = 1; i < vtEnvironmentLevelCount(width, height) && ready; ++i) {
        ready = vtHalveEnvironment(environment, &level);
        if (ready) {
            vtWidenEnvironment(&level, shown);
            gl->TexSubImage2D(GL_TEXTURE_2D, i, 0, 0, level.width, level.height, GL_RGB, GL_FLOAT, shown);
        }
    }
    vtFree(level.pixels);
    vtFree(shown);
    return ready ? vt_ok : vtFail(error, vt_errorMemory, "environment: out of memory");
}

vtResult vtEnvironmentBuffer_Set(vtEnvironmentBuffer* buffer, const vtGL* gl,
                                 const vtEnvironment* environment, vtError* error)
{
    bool isImage = environment->kind == vt_environmentImage;
    int width = isImage ? environment->width : 1, height = isImage ? environment->height : 1;
    vtResult result = vtCheckTextureSize(gl, width, height, "environment", error);
    if (result != vt_ok) {
        return result;
    }
    vtTexture fresh = {0};
    if (isImage) {
        result = uploadPicture(&fresh, gl, environment, error);
    } else {
        vtTexture_Resize(&fresh, gl, GL_RGB16F, 1, 1, 0);
    }
    result = result == vt_ok ? vtCheckGL(gl, "uploading the environment", error) : result;
    if (result != vt_ok) {
        vtTexture_Destroy(&fresh, gl);
        return result;
    }
    vtEnvironment light;
    result = shrinkEnvironment(environment, &light, error);
    if (result != vt_ok) {
        vtTexture_Destroy(&fresh, gl);
        return result;
    }
    vtEnvironmentBuffer_Destroy(buffer, gl);
    *buffer = (vtEnvironmentBuffer){environment->kind, .picture = fresh, .light = light};
    return vt_ok;
}

void vtEnvironmentBuffer_FindSun(vtEnvironmentBuffer* buffer)
{
    if (!buffer->isSunKnown) {
        vtFindSun(&buffer->light, &buffer->sun);
        buffer->isSunKnown = true;
    }
}

vtResult vtEnvironmentBuffer_Light(vtEnvironmentBuffer* buffer, const vtGL* gl, bool sunless, vtError* error)
{
    if (buffer->lighting.name != 0 && buffer->isSunless == sunless) {
        return vtSucceed(error);
    }
    vtLighting lighting;
    vtResult result = vtCreateLighting(&buffer->light, sunless ? &buffer->sun : NULL, &lighting, error);
    if (result == vt_ok) {
        result = vtLightingTexture_Upload(&buffer->lighting, gl, &lighting, error);
        buffer->isSunless = result == vt_ok ? sunless : buffer->isSunless;
        vtDestroyLighting(&lighting);
    }
    return result;
}

vtResult vtEnvironmentBuffer_Blur(vtEnvironmentBuffer* buffer, const vtGL* gl, float degrees, vtError* error)
{
    if (buffer->blurred.name != 0 && buffer->blurredBy == degrees) {
        return vtSucceed(error);
    }
    vtEnvironment blurred;
    vtResult result = vtBlurEnvironment(&buffer->light, degrees, &blurred, error);
    if (result == vt_ok) {
        vtTexture_Destroy(&buffer->blurred, gl);
        vtTexture_Resize(&buffer->blurred, gl, GL_RGB16F, blurred.width, blurred.height, 0);
        gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, blurred.width, blurred.height, GL_RGB, GL_FLOAT,
                          blurred.pixels);
        gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        gl->TexParameteri(buffer->blurred.target, GL_TEXTURE_WRAP_S, GL_REPEAT);
        buffer->blurredBy = degrees;
        vtDestroyEnvironment(&blurred);
    }
    return result;
}

void vtEnvironmentBuffer_DropLight(vtEnvironmentBuffer* buffer, const vtGL* gl)
{
    vtTexture_Destroy(&buffer->lighting, gl);
    vtTexture_Destroy(&buffer->blurred, gl);
}

void vtEnvironmentBuffer_Destroy(vtEnvironmentBuffer* buffer, const vtGL* gl)
{
    vtEnvironmentBuffer_DropLight(buffer, gl);
    vtTexture_Destroy(&buffer->picture, gl);
    vtDestroyEnvironment(&buffer->light);
    *buffer = (vtEnvironmentBuffer){0};
}

size_t vtEnvironmentBuffer_Bytes(const vtEnvironmentBuffer* buffer)
{
    return vtTexture_Bytes(&buffer->picture) + vtTexture_Bytes(&buffer->lighting) +
           vtTexture_Bytes(&buffer->blurred);
}
