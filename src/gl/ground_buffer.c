#include "gl/ground_buffer.h"

#include <string.h>

#include "base/error.h"
#include "base/memory.h"

vtResult vtGroundBuffer_Set(vtGroundBuffer* buffer, const vtGL* gl, const vtGroundMap* map, vtVec3 origin,
                            vtError* error)
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
    const float place[4] = {map->height - origin.y, map->lowX - origin.x, map->lowZ - origin.z,
                            1.0f / map->size};
    const float radiance[4] = {map->radiance.x, map->radiance.y, map->radiance.z, map->matt ? 1.0f : 0.0f};
    memcpy(buffer->place, place, sizeof place);
    memcpy(buffer->radiance, radiance, sizeof radiance);
    return vtSucceed(error);
}

void vtGroundBuffer_Destroy(vtGroundBuffer* buffer, const vtGL* gl)
{
    vtTexture_Destroy(&buffer->map, gl);
    *buffer = (vtGroundBuffer){0};
}
