// What materials have in common.
#pragma once

#include "vitrine.h"

/// The index that light bends by: 1 where it is 0, and of what is opaque, which it does not enter, 1.5 where
/// it is no index.
static inline float vtMaterial_Index(const vtMaterial* material)
{
    const bool good = material->ior >= 1.0f && material->ior <= 1000.0f;
    return material->ior == 0.0f ? 1.0f : material->opaque && !good ? 1.5f : material->ior;
}

/// Its roughness, where it has no picture of it. `given`: of all glass; below 0: each material's own.
static inline float vtMaterial_Roughness(const vtMaterial* material, float given)
{
    const float own = material->roughness >= 0.0f ? material->roughness : material->opaque ? 1.0f : 0.0f;
    return given >= 0.0f && !material->opaque ? given : own;
}

/// The same of its dispersion.
static inline float vtMaterial_Dispersion(const vtMaterial* material, float given)
{
    return material->opaque ? 0.0f : given >= 0.0f ? given : material->dispersion;
}

/// Is the picture of colours, sRGB? Else it is of numbers.
static inline bool vtMapUse_IsColor(vtMapUse use)
{
    return use == vt_mapBaseColor || use == vt_mapEmissive || use == vt_mapSpecularColor;
}

/// Do index, tint, absorption and, of opaque things, base colour, metallic, roughness, emissive, checker and
/// their two maps say all of it? `colored`: the mesh has colours of its own.
bool vtMaterial_IsPlain(const vtMaterial* material, bool colored);

/// What is wrong with its numbers: false, and the name of the number, its value and range.
bool vtMaterial_Check(const vtMaterial* material, const char** what, float* value, float* least, float* most);
