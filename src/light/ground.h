// What a scene does to the light on the ground below it: the light's samples, the rays to be followed, and
// the map that comes of them. Who follows the rays is left open: a shader (passes/ground.h), or the
// reference.
#pragma once

#include "shaders_es3/common/constants.h"
#include "vitrine.h"

/// Two kinds of light, since a small one makes sharp shadows and a wide one soft ones.
typedef enum vtGroundLight { vt_groundSky = 0, vt_groundSun, vt_groundLightCount } vtGroundLight;

/// Shade rays go from the ground towards the light: what they meet is in the light's way. Photons come from
/// the light, through the box of the glass, and bring what glass bends or reflects.
typedef enum vtGroundRays { vt_groundShade = 0, vt_groundPhotons, vt_groundRaysCount } vtGroundRays;

/// One direction out of VT_GROUND_SAMPLES that stand for a light.
typedef struct vtLightSample {
    vtVec3 direction; ///< towards it
    vtVec3 color; ///< irradiance, if all light came from here: for shade rays of the ground, for photons of
                  ///< a surface that faces it
} vtLightSample;

/// A light that is as good as a disc, infinitely far away.
typedef struct vtSun {
    vtVec3 direction;  ///< towards it, unit
    float radius;      ///< radians
    vtVec3 irradiance; ///< of a surface that faces it; 0: there is none
    float brightest;   ///< luminance from which on the environment is part of it
} vtSun;

/// What the environment has of a sun: see ground.c. False where memory is out.
bool vtFindSun(const vtEnvironment* environment, vtSun* sun);

typedef struct vtGroundPlan {
    vtGround ground;
    float height;               ///< world y
    float lowX, lowZ, size;     ///< of the square that the map covers, world
    vtVec3 glassLow, glassHigh; ///< box that photons go through
    float reach;                ///< the scene's diagonal: photons start farther away than anything
    bool hasGlass;              ///< else no photons are wanted
    vtVec3 irradiance[vt_groundLightCount]; ///< of the ground without a scene; 0: no such light
    vtLightSample* samples[vt_groundLightCount][vt_groundRaysCount]; ///< VT_GROUND_SAMPLES each
    float* sums[vt_groundLightCount];                                ///< irradiance gathered, 3 a texel
} vtGroundPlan;

/// Boxes of the scene and of its glass (low > high: none), world. *plan is to be destroyed. Fails with
/// vt_errorArgument where the scene reaches below the ground, and with vt_errorMemory; then it is zeroed.
vtResult vtPlanGround(const vtGround* ground, const vtEnvironment* environment, const vtVec3 scene[2],
                      const vtVec3 glass[2], vtGroundPlan* plan, vtError* error);
void vtDestroyGroundPlan(vtGroundPlan* plan);

/// Texels along a side of what is gathered of a light.
static inline int vtGroundSide(vtGroundLight light)
{
    return light == vt_groundSky ? VT_GROUND_SIDE / 4 : VT_GROUND_SIDE;
}

/// Ray (x, y) of a square of `across` by `across`. `seed`: 0, or another number for other directions.
typedef struct vtGroundRay {
    vtVec3 origin, direction;
    const vtLightSample* sample;
    float area; ///< photons: of the whole square, across the ray
} vtGroundRay;
vtGroundRay vtGroundPlan_Ray(const vtGroundPlan* plan, vtGroundLight light, vtGroundRays rays, int x, int y,
                             int across, uint32_t seed);

/// A shade ray has met nothing.
void vtGroundPlan_AddLit(vtGroundPlan* plan, vtGroundLight light, const vtGroundRay* ray, int x, int y,
                         int across);
/// A photon has come down with that share of its light.
void vtGroundPlan_AddPhoton(vtGroundPlan* plan, vtGroundLight light, const vtGroundRay* ray, float x, float z,
                            vtVec3 share, int across);

/// What is seen of it.
typedef struct vtGroundMap {
    float* light; ///< VT_GROUND_SIDE squared, 3 each: the ground's light over what it would have without the
                  ///< scene; the first row at lowZ, the first column at lowX. 1 along all sides
    float height, lowX, lowZ, size; ///< as the plan's
    bool matt;
    vtVec3 radiance; ///< matt: of the ground where `light` is 1
    vtVec3 gathered; ///< mean irradiance over the map, before intensity and softness
} vtGroundMap;

/// Makes the map of what was gathered. Fails with vt_errorMemory; then it is zeroed.
vtResult vtGroundPlan_Finish(vtGroundPlan* plan, vtGroundMap* map, vtError* error);
void vtDestroyGroundMap(vtGroundMap* map);

/// Light that a ray brings which meets nothing of the scene any more; `beyond`: the environment's in its
/// direction. The twin of shaders_es3/ground/ground.glsl.
vtVec3 vtGroundMap_Light(const vtGroundMap* map, vtVec3 position, vtVec3 direction, vtVec3 beyond);
