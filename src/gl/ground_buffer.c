#include "gl/ground_buffer.h"

#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "gl/picture_texture.h"

vtResult vtGroundBuffer_Set(vtGroundBuffer* buffer, const vtGL* gl, const vtGroundMap* map, vtError* error)
{
    const size_t count = (size_t)VT_GROUND_SIDE * VT_GROUND_SIDE;
    float* texels = vtAllocate(count, 4 * sizeof *texels);
    if (texels == NULL) {
        return vtFail(error, vt_errorMemory, "ground: out of memory");
    }
    for (size_t i = 0; i < count; ++i) {
        for (size_t channel = 0; channel < 3; ++channel) { // the greatest half float is 65504
            const float share = map->light[3 * i + channel];
            texels[4 * i + channel] = share < 6e4f ? share : 6e4f;
        }
        texels[4 * i + 3] = 1.0f;
    }
    if (vtTexture_Resize(&buffer->map, gl, GL_RGBA16F, VT_GROUND_SIDE, VT_GROUND_SIDE, 0)) {
        gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    }
    vtTexture_Bind(&buffer->map, gl, vt_samplerNone);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, VT_GROUND_SIDE, VT_GROUND_SIDE, GL_RGBA, GL_FLOAT, texels);
    vtFree(texels);
    const float place[4] = {map->height, map->lowX, map->lowZ, 1.0f / map->size};
    const vtVec3 color = map->color, light = map->irradiance;
    const float matt[8] = {color.x, color.y, color.z, map->matt ? 1.0f : 0.0f,
                           light.x, light.y, light.z, 0.0f};
    memcpy(buffer->place, place, sizeof place);
    memcpy(buffer->matt, matt, sizeof matt);
    return vtSucceed(error);
}

vtResult vtGroundBuffer_SetCaustics(vtGroundBuffer* buffer, const vtGL* gl, const vtCausticMap* map,
                                    vtError* error)
{
    const uint32_t none[4] = {0};
    const int width = map->rows > 0 ? VT_CAUSTIC_COLUMNS : 1, height = map->rows > 0 ? (int)map->rows : 1;
    const vtResult result = vtCheckTextureSize(gl, width, height, "caustics", error);
    if (result == vt_ok) {
        vtTexture_Resize(&buffer->caustics, gl, GL_RGBA32UI, width, height, 0);
        vtTexture_Bind(&buffer->caustics, gl, vt_samplerNone);
        gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                          map->rows > 0 ? map->words : none);
    }
    return result;
}

void vtGroundBuffer_Destroy(vtGroundBuffer* buffer, const vtGL* gl)
{
    vtTexture_Destroy(&buffer->map, gl);
    vtTexture_Destroy(&buffer->caustics, gl);
    *buffer = (vtGroundBuffer){0};
}
