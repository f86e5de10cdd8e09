// The ground's light as it is seen.
#pragma once

#include "light/ground.h"

/// What is seen of it.
typedef struct vtGroundMap {
    float* light; ///< VT_GROUND_SIDE squared, 3 each: the ground's light over what it would have without the
                  ///< scene; the first row at lowZ, the first column at lowX. 1 along all sides
    float height, lowX, lowZ, size; ///< as the plan's
    bool matt;
    vtVec3 color;          ///< matt
    vtVec3 irradiance;     ///< without a scene, but for lights of files
    const vtLight* lights; ///< these, not owned
    int lightCount;
    vtVec3 gathered; ///< mean irradiance over the map, before intensity and softness
} vtGroundMap;

/// Makes the map of what was gathered. Fails with vt_errorMemory; then it is zeroed.
vtResult vtGroundPlan_Finish(vtGroundPlan* plan, vtGroundMap* map, vtError* error);
void vtDestroyGroundMap(vtGroundMap* map);

/// Light that a ray brings which meets nothing of the scene any more; `beyond`: the environment's in its
/// direction. The twin of shaders_es3/ground/ground.glsl.
vtVec3 vtGroundMap_Light(const vtGroundMap* map, vtVec3 position, vtVec3 direction, vtVec3 beyond);
/// What it does to another background than the environment: its shadow covers that, caustics are added; a
/// matt one covers all. `light`: as vtGroundMap_Light gives it. Colours times the share *covered. The twin of
/// groundOverPage in shaders_es3/ground/ground.glsl.
vtVec3 vtGroundMap_Over(const vtGroundMap* map, vtVec3 position, vtVec3 direction, vtVec3 light,
                        float* covered);
