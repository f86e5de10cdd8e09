// What a point of a surface is like, and the light that it sends, on the CPU. The twin of
// shaders_es3/shade/looks.glsl and, for what is opaque and plain, of shading.glsl.
#pragma once

#include "light/lighting.h"
#include "scene/material.h"
#include "scene/objects.h"

/// What there is at a point.
typedef struct vtLook {
    vtVec3 N, G;    ///< normals, outward, world: interpolated and bent by the normal map; the triangle's
    vtVec3 base;    ///< colour
    float coverage; ///< whether the surface is there: 0 to 1
    vtVec3 emissive;
    vtVec3 specularColor; ///< times what a dielectric reflects straight on
    float specular;       ///< share of what it reflects
    float passes;         ///< share that passes as through glass
    float metallic, roughness, occlusion;
    float film, filmIor, filmThickness; ///< iridescence: share, index, nanometres
    bool thin, unlit;
    bool mirror; ///< index 0: reflects everything
    float ior;
} vtLook;

/// What lights a scene.
typedef struct vtIllumination {
    const vtLighting* lighting; ///< of the environment
    const vtLight* lights;
    uint32_t lightCount; ///< those beyond VT_MOST_LIGHTS count for nothing
    const vtSun* sun;    ///< that the lighting is without; NULL: there is none
} vtIllumination;

/// What is between a point and lights: who looks for it has this as his first member.
typedef struct vtShadows {
    /// Share of a light that comes from the unit direction, from so far away (INFINITY: of the sun).
    vtVec3 (*arriving)(const struct vtShadows* shadows, vtVec3 direction, float distance);
    vtVec3 towardsSun; ///< a point of its disc
    vtVec3 gathered;   ///< irradiance by photons
} vtShadows;

/// At the point of `triangle` with weights u and v of its second and third corner. Pictures are read at full
/// size; the shader reads them averaged over a pixel. `ior`: of the object's glass;
/// `roughness`: of all glass, times the picture of it; below 0: the material's own.
vtLook vtLookAt(const vtScene* scene, const vtPlacedObject* object, uint32_t triangle, float u, float v,
                float ior, float roughness);

/// What the surface reflects of light that meets it at that cosine; `exact`: vtFresnel there; `ior`: of the
/// side that is denser over the other. `fromInside`: films are not seen from there.
vtVec3 vtLook_Reflectance(const vtLook* look, float cosine, float exact, float ior, bool fromInside);

/// Radiance that the surface sends against the unit direction I, but for what it reflects and lets pass as
/// glass does: what is matt, metal and light of its own, and lights seen in it. N: unit, against I.
/// `shadows`: NULL, nothing casts any, and there is no sun. `exposure`: the factor that the picture will be
/// multiplied by, which what is unlit evades.
vtVec3 vtLook_SentLight(const vtLook* look, const vtIllumination* illumination, const vtShadows* shadows,
                        vtVec3 N, vtVec3 I, vtVec3 position, float exposure);
