// What a scene does to the light on the ground below it: the rays to be followed, and what they bring. Who
// follows them is left open: a shader (passes/ground.h), or the reference. What is seen: ground_map.h.
#pragma once

#include "base/space.h"
#include "light/ground_samples.h"

/// What is gathered by itself: a small light makes sharp shadows and a wide one soft ones.
typedef enum vtGroundLight {
    vt_groundSky = 0,
    vt_groundSun,
    vt_groundLights, ///< of files
    vt_groundBent,   ///< the sky's photons, which are few for all its directions
    vt_groundLightCount
} vtGroundLight;

typedef struct vtGroundPlan {
    vtGround ground;
    float height;               ///< y
    float lowX, lowZ, size;     ///< of the square that the map covers, world
    vtVec3 glassLow, glassHigh; ///< box that photons go through
    float reach;                ///< the scene's diagonal: photons start farther away than anything
    bool hasGlass;              ///< else no photons are wanted
    /// Where light comes from, by number: the sky, the sun, and then the lights of files, those that count.
    int sourceCount;
    const vtLight* lights;
    vtVec3 irradiance[2];                          ///< of the ground without a scene; 0: no such light
    vtLightSample* samples[2][vt_groundRaysCount]; ///< VT_GROUND_SAMPLES each
    float* sums[vt_groundLightCount];              ///< irradiance gathered, 3 a texel
    float* unshaded[vt_groundLightCount];          ///< the same by all shade rays, whatever they meet
} vtGroundPlan;

/// What a ground lies below.
typedef struct vtGroundScene {
    vtSpace space; ///< of the caller's world; all else here, and the plan, is in it
    vtVec3 low, high;
    vtVec3 glassLow, glassHigh; ///< low > high: there is none
    const vtLight* lights;      ///< must outlive the plan
    uint32_t lightCount;        ///< those beyond VT_MOST_LIGHTS count for nothing
} vtGroundScene;

/// *plan is to be destroyed. Fails with vt_errorArgument where the scene reaches below the ground, and with
/// vt_errorMemory; then it is zeroed.
vtResult vtPlanGround(const vtGround* ground, const vtEnvironment* environment, const vtGroundScene* scene,
                      vtGroundPlan* plan, vtError* error);
void vtDestroyGroundPlan(vtGroundPlan* plan);

/// Texels along a side of what is gathered of a light.
static inline int vtGroundSide(vtGroundLight light)
{
    return light == vt_groundSky || light == vt_groundBent ? VT_GROUND_SIDE / 4 : VT_GROUND_SIDE;
}

/// Of a source.
static inline vtGroundLight vtGroundLightOf(int source)
{
    return source < 2 ? (vtGroundLight)source : vt_groundLights;
}

/// Does nothing come from there?
bool vtGroundPlan_IsDark(const vtGroundPlan* plan, int source);

/// Rays along a side of a source's square, of so many along that of the sky: lights of files share them, but
/// each texel of the map has a shade ray.
int vtGroundPlan_Across(const vtGroundPlan* plan, int source, vtGroundRays rays, int across);

/// Irradiance by a light of files of the ground at that place, if nothing is in its way. The twin of
/// ground.glsl's.
vtVec3 vtLampOnGround(const vtLight* light, vtVec3 at);

/// How rays of a light of files go; the twin of photons.frag's uniforms.
typedef struct vtGroundBeam {
    vtVec3 place; ///< of the light; of a directional one, the direction towards it
    bool isNear;  ///< it has a place
    vtVec3 axis;  ///< photons of that: about this direction
    float cosine; ///< within an angle of this cosine
} vtGroundBeam;
vtGroundBeam vtGroundPlan_Beam(const vtGroundPlan* plan, int source);

/// Ray (x, y) of a square of `across` by `across`. `seed`: 0, or another number for other directions.
typedef struct vtGroundRay {
    vtVec3 origin, direction;
    vtVec3 color; ///< irradiance: of the ground, if nothing is in the way; of photons on what faces them
    float area;   ///< photons: of the whole square, across the ray; from a place the solid angle
    float length; ///< shade: as far as the light
} vtGroundRay;
vtGroundRay vtGroundPlan_Ray(const vtGroundPlan* plan, int source, vtGroundRays rays, int x, int y,
                             int across, uint32_t seed);

/// A shade ray has met something, or nothing.
void vtGroundPlan_AddShade(vtGroundPlan* plan, int source, const vtGroundRay* ray, int x, int y, int across,
                           bool isLit);
/// All shade rays of a source are there, and none of its photons. Of sky and sun texels that were without a
/// shadow have all the light then, whatever directions fell to them.
void vtGroundPlan_EndShade(vtGroundPlan* plan, int source);
/// A photon has come down with that share of its light.
void vtGroundPlan_AddPhoton(vtGroundPlan* plan, int source, const vtGroundRay* ray, float x, float z,
                            vtVec3 share, int across);
