#include "gl/material_table.h"

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "scene/material.h"

static void write(uint32_t* words, int texel, float x, float y, float z, float w)
{
    const float numbers[4] = {x, y, z, w};
    memcpy(words + 4 * texel, numbers, sizeof numbers);
}

static uint32_t clampLights(uint32_t count)
{
    return count < VT_MOST_LIGHTS ? count : VT_MOST_LIGHTS;
}

uint32_t vtMaterialTable_First(uint32_t lightCount)
{
    return (1 + 3 * clampLights(lightCount) + VT_MATERIAL_TEXELS - 1) / VT_MATERIAL_TEXELS;
}

static void writeLight(const vtLight* light, uint32_t* words)
{
    const bool spot = light->kind == vt_lightSpot;
    const vtVec3 at = light->position, d = light->direction, c = light->color;
    const float inner = spot ? cosf(light->innerCone) : -1.0f, outer = spot ? cosf(light->outerCone) : -2.0f;
    write(words, 0, at.x, at.y, at.z, light->kind == vt_lightDirectional ? -1.0f : light->range);
    write(words, 1, d.x, d.y, d.z, inner);
    write(words, 2, c.x, c.y, c.z, outer);
}

static void writeMap(const vtMap* map, vtMapUse use, const vtImageArray* images, uint32_t* words)
{
    const uint32_t layer = vtImageArray_Layer(images, map, use);
    words[0] = VT_NO_TRIANGLE;
    if (layer == VT_NO_TRIANGLE) {
        return;
    }
    const vtImageLayer* image = &images->layers[layer];
    const float offset[2] = {map->rows[0][2], map->rows[1][2]};
    words[0] = layer | (map->texcoords == 1 ? VT_MAP_SECOND : 0) | (map->nearest ? VT_MAP_NEAREST : 0) |
               (uint32_t)map->wrapX << VT_MAP_WRAP_X | (uint32_t)map->wrapY << VT_MAP_WRAP_Y;
    memcpy(words + 1, offset, sizeof offset);
    words[3] = (uint32_t)(image->width & 0xffff) | (uint32_t)image->height << 16;
    write(words, 1, map->rows[0][0], map->rows[0][1], map->rows[1][0], map->rows[1][1]);
}

static void writeMaterial(const vtObjectBuffer* object, const vtImageArray* images, uint32_t* words)
{
    const vtMaterial* m = &object->material;
    const vtVec3 color = m->opaque ? m->baseColor : m->tint, light = m->emissive, glossy = m->specularColor;
    const bool mask = m->alphaMode == vt_alphaMask;
    // A cutoff of 0 shows all of it.
    write(words, VT_MATERIAL_FLAGS, 0.0f, m->alpha, mask ? fmaxf(m->alphaCutoff, 1e-6f) : 0.0f,
          m->transmission);
    words[4 * VT_MATERIAL_FLAGS] =
        (object->placed.thin ? VT_LOOK_THIN : 0) | (m->unlit && m->opaque ? VT_LOOK_UNLIT : 0) |
        (m->ior == 0.0f ? VT_LOOK_MIRROR : 0) | (m->alphaMode == vt_alphaBlend ? VT_LOOK_BLEND : 0);
    write(words, VT_MATERIAL_COLOR, color.x, color.y, color.z, m->metallic);
    write(words, VT_MATERIAL_EMISSIVE, light.x, light.y, light.z, 0.0f); // roughness: object table
    write(words, VT_MATERIAL_SPECULAR, glossy.x, glossy.y, glossy.z, m->specular);
    write(words, VT_MATERIAL_FILM, m->iridescence, m->iridescenceIor, m->iridescenceMin, m->iridescenceMax);
    write(words, VT_MATERIAL_SCALES, m->normalScale, m->occlusionStrength, m->checker, 0.0f);
    for (int use = 0; use < vt_mapCount; ++use) {
        writeMap(&m->maps[use], (vtMapUse)use, images, words + 4 * (VT_MATERIAL_MAPS + 2 * use));
    }
}

vtResult vtMaterialTable_Upload(vtTexture* table, const vtGL* gl, const vtObjectBuffer* objects,
                                uint32_t count, const vtLight* lights, uint32_t lightCount,
                                const vtImageArray* images, vtError* error)
{
    const uint32_t first = vtMaterialTable_First(lightCount), drawn = clampLights(lightCount);
    const uint32_t rows =
        ((first + count) * VT_MATERIAL_TEXELS + VT_MATERIAL_COLUMNS - 1) / VT_MATERIAL_COLUMNS;
    uint32_t* words = vtAllocateZeroed((size_t)rows * VT_MATERIAL_COLUMNS, 4 * sizeof *words);
    if (words == NULL) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for %u materials", count);
    }
    words[0] = drawn;
    for (uint32_t i = 0; i < drawn; ++i) {
        writeLight(&lights[i], words + 4 * (1 + 3 * (size_t)i));
    }
    for (uint32_t i = 0; i < count; ++i) {
        writeMaterial(&objects[i], images, words + 4 * VT_MATERIAL_TEXELS * (size_t)(first + i));
    }
    vtTexture_Resize(table, gl, GL_RGBA32UI, VT_MATERIAL_COLUMNS, (int)rows, 0);
    vtTexture_Bind(table, gl, vt_samplerNone);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, VT_MATERIAL_COLUMNS, (GLsizei)rows, GL_RGBA_INTEGER,
                      GL_UNSIGNED_INT, words);
    vtFree(words);
    return vt_ok;
}
