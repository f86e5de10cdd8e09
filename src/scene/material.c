#include "scene/material.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

#include "base/math.h"

vtMap vtDefaultMap(void)
{
    return (vtMap){.image = -1, .rows = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}}};
}

vtMaterial vtDefaultMaterial(void)
{
    vtMaterial material = {
        .ior = 1.5f,
        .tint = {1.0f, 1.0f, 1.0f},
        .transmission = 1.0f,
        .attenuationColor = {1.0f, 1.0f, 1.0f},
        .baseColor = {0.8f, 0.8f, 0.8f},
        .roughness = -1.0f,
        .alpha = 1.0f,
        .alphaCutoff = 0.5f,
        .specular = 1.0f,
        .specularColor = {1.0f, 1.0f, 1.0f},
        .iridescenceIor = 1.3f,
        .iridescenceMin = 100.0f,
        .iridescenceMax = 400.0f,
        .normalScale = 1.0f,
        .occlusionStrength = 1.0f,
    };
    for (int use = 0; use < vt_mapCount; ++use) {
        material.maps[use] = vtDefaultMap();
    }
    return material;
}

static bool isWhite(vtVec3 color)
{
    return color.x == 1.0f && color.y == 1.0f && color.z == 1.0f;
}

static bool isBlack(vtVec3 color)
{
    return color.x == 0.0f && color.y == 0.0f && color.z == 0.0f;
}

/// None, or by the first set of texture coordinates as they are, repeated and blended.
static bool isPlainMap(const vtMap* map, bool allowed)
{
    const vtMap standard = vtDefaultMap();
    bool plain = map->texcoords == 0 && map->wrapX == vt_wrapRepeat && map->wrapY == vt_wrapRepeat &&
                 !map->nearest && allowed;
    for (int i = 0; i < 6; ++i) {
        plain = plain && map->rows[i / 3][i % 3] == standard.rows[i / 3][i % 3];
    }
    return map->image < 0 || plain;
}

bool vtMaterial_IsPlain(const vtMaterial* material, bool colored)
{
    bool plain = material->alphaMode == vt_alphaOpaque && material->specular == 1.0f &&
                 isWhite(material->specularColor) && material->iridescence == 0.0f && !material->unlit;
    for (int use = 0; use < vt_mapCount; ++use) {
        plain = plain && isPlainMap(&material->maps[use], material->opaque && use <= vt_mapMetallicRoughness);
    }
    return material->opaque
               ? plain && material->ior == 1.5f
               : plain && !colored && !material->thin && material->transmission == 1.0f &&
                     material->metallic == 0.0f && isBlack(material->emissive) && material->ior > 0.0f;
}

bool vtMaterial_Check(const vtMaterial* material, const char** what, float* value, float* least, float* most)
{
    const struct {
        const char* name;
        float value, least, most;
    } numbers[] = {
        {"an index of refraction", material->ior == 0.0f || material->opaque ? 1.0f : material->ior, 0.25f,
         4.0f},
        {"a roughness", material->roughness < 0.0f ? 0.0f : material->roughness, 0.0f, 1.0f},
        {"a transmission", material->transmission, 0.0f, 1.0f},
        {"an alpha", material->alpha, 0.0f, 1.0f},
        {"a specular share", material->specular, 0.0f, 1.0f},
        {"an iridescence", material->iridescence, 0.0f, 1.0f},
        {"an iridescence index", material->iridescenceIor, 1.0f, FLT_MAX},
        {"a film thickness", fminf(material->iridescenceMin, material->iridescenceMax), 0.0f, FLT_MAX},
        {"a dispersion", material->dispersion, 0.0f, FLT_MAX},
    };
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i) {
        if (!(numbers[i].value >= numbers[i].least && numbers[i].value <= numbers[i].most)) {
            *what = numbers[i].name;
            *value = i == 0 ? material->ior : numbers[i].value;
            *least = numbers[i].least;
            *most = numbers[i].most;
            return false;
        }
    }
    return true;
}
