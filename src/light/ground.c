// This work is based on:
//   Paul Debevec. A Median Cut Algorithm for Light Probe Sampling, 2005, and Matt Pharr, Greg Humphreys.
//   Physically Based Rendering, 2004, 14.2.4: directions of an environment by its own brightness;
//   James Arvo. Backward Ray Tracing. 1986: light that glass bends, followed from the light and gathered in a
//   map over the surface that it falls on;
//   Henrik Wann Jensen. Global Illumination Using Photon Maps. 1996: what comes straight is not looked for
//   among the photons.
// Departures:
//  - The ground is one square map. A photon is spread over four texels by its place.
//  - Rays stand on a lattice, rows of a grid shifted by the golden ratio, and their directions come in a
//    fixed order that has all parts of a light in every
//    8 x 8 of them (Bayer 1973), so that even light comes out even.
//  - Of sky and sun a texel of the map has the lit share of its own rays' light, without noise where nothing
//    is in the way (a ratio estimate: Heitz, Hill & McGuire 2018 have shadows so).
//  - Glass and what is opaque cast the same shadow; all the light that glass lets through is photons'.
#include "light/ground.h"

#include <math.h>
#include <string.h>

#include "base/about.h"
#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"

// ------------------------------------------------------------------------------------------------- plan

static bool allocateSums(vtGroundPlan* plan)
{
    bool ready = true;
    for (int light = 0; light < vt_groundLightCount; ++light) {
        const size_t side = (size_t)vtGroundSide((vtGroundLight)light);
        const bool isThere = light != vt_groundLights || plan->sourceCount > 2;
        const bool isShaded = isThere && light != vt_groundBent;
        plan->sums[light] = isThere ? vtAllocateZeroed(side * side, 3 * sizeof(float)) : NULL;
        plan->unshaded[light] = isShaded ? vtAllocateZeroed(side * side, 3 * sizeof(float)) : NULL;
        ready =
            ready && (plan->sums[light] != NULL || !isThere) && (plan->unshaded[light] != NULL || !isShaded);
        for (int rays = 0; rays < vt_groundRaysCount && light < 2; ++rays) {
            plan->samples[light][rays] = vtAllocate(VT_GROUND_SAMPLES, sizeof(vtLightSample));
            ready = ready && plan->samples[light][rays] != NULL;
        }
    }
    return ready;
}

static vtResult sampleLights(vtGroundPlan* plan, const vtEnvironment* environment, vtSun* sun, vtError* error)
{
    if (!allocateSums(plan) || !vtFindSun(environment, sun) ||
        !vtSampleSky(environment, sun, plan->samples[vt_groundSky], &plan->irradiance[vt_groundSky])) {
        return vtFail(error, vt_errorMemory, "ground: out of memory");
    }
    *sun = vtGivenSun(&plan->ground, sun);
    vtSampleSun(sun, plan->samples[vt_groundSun]);
    vtVec3 mean = {0.0f, 0.0f, 0.0f};
    for (int i = 0; i < VT_GROUND_SAMPLES; ++i) {
        mean = vtMulAdd(mean, 1.0f / VT_GROUND_SAMPLES, plan->samples[vt_groundSun][vt_groundShade][i].color);
    }
    plan->irradiance[vt_groundSun] = mean;
    return vt_ok;
}

/// Takes the shadow that a box throws by light from there into a rectangle.
static void extendByShadow(const vtGroundScene* scene, float height, vtVec3 towards, float low[2],
                           float high[2])
{
    const float steep = fmaxf(towards.y, 0.25f);
    const float dx = -towards.x / steep * height, dz = -towards.z / steep * height;
    low[0] = fminf(low[0], scene->low.x + dx);
    low[1] = fminf(low[1], scene->low.z + dz);
    high[0] = fmaxf(high[0], scene->high.x + dx);
    high[1] = fmaxf(high[1], scene->high.z + dz);
}

/// The square: what stands on the ground, its shadows by sun and lights, and six tenths of its height around
/// them.
static void placeMap(vtGroundPlan* plan, const vtGroundScene* scene, const vtSun* sun)
{
    const float height = scene->high.y - plan->height;
    float low[2] = {scene->low.x, scene->low.z}, high[2] = {scene->high.x, scene->high.z};
    if (vtSun_IsThere(sun)) {
        extendByShadow(scene, height, sun->direction, low, high);
    }
    const vtVec3 top = {0.5f * (scene->low.x + scene->high.x), scene->high.y,
                        0.5f * (scene->low.z + scene->high.z)};
    for (int source = 2; source < plan->sourceCount; ++source) {
        const vtGroundBeam beam = vtGroundPlan_Beam(plan, source);
        const vtVec3 towards = beam.isNear ? vtNormalize(vtSub(beam.place, top)) : beam.place;
        if (!vtGroundPlan_IsDark(plan, source)) {
            extendByShadow(scene, height, towards, low, high);
        }
    }
    const float around = 0.6f * height + 0.1f * plan->reach;
    const float wide = high[0] - low[0] + 2.0f * around, deep = high[1] - low[1] + 2.0f * around;
    plan->size = fmaxf(wide, deep);
    plan->lowX = low[0] - around - 0.5f * (plan->size - wide);
    plan->lowZ = low[1] - around - 0.5f * (plan->size - deep);
}

vtResult vtPlanGround(const vtGround* ground, const vtEnvironment* environment, const vtGroundScene* scene,
                      vtGroundPlan* plan, vtError* error)
{
    const uint32_t lights = scene->lightCount < VT_MOST_LIGHTS ? scene->lightCount : VT_MOST_LIGHTS;
    const float height = vtSpace_Enter(&scene->space, (vtVec3){0.0f, ground->height, 0.0f}).y;
    *plan = (vtGroundPlan){.ground = *ground,
                           .height = isnan(height) ? scene->low.y : height,
                           .glassLow = scene->glassLow,
                           .glassHigh = scene->glassHigh,
                           .reach = vtLength(vtSub(scene->high, scene->low)),
                           .hasGlass = scene->glassLow.x <= scene->glassHigh.x,
                           .sourceCount = 2 + (int)lights,
                           .lights = scene->lights};
#ifdef VT_WITH_ABOUT // a page has it at the lowest point
    if (plan->height > scene->low.y + 1e-3f * plan->reach) {
        return vtFail(error, vt_errorArgument,
                      "ground: it lies at %g, but the scene reaches down to %g; put it there or below",
                      (double)ground->height, (double)vtSpace_Leave(&scene->space, scene->low).y);
    }
#endif
    vtSun sun;
    const vtResult result = sampleLights(plan, environment, &sun, error);
    if (result != vt_ok) {
        vtDestroyGroundPlan(plan);
        return result;
    }
    placeMap(plan, scene, &sun);
    return vt_ok;
}

void vtDestroyGroundPlan(vtGroundPlan* plan)
{
    for (int light = 0; light < vt_groundLightCount; ++light) {
        vtFree(plan->sums[light]);
        vtFree(plan->unshaded[light]);
    }
    for (int rays = 0; rays < vt_groundRaysCount; ++rays) {
        vtFree(plan->samples[vt_groundSky][rays]);
        vtFree(plan->samples[vt_groundSun][rays]);
    }
    *plan = (vtGroundPlan){0};
}

// ------------------------------------------------------------------------------------------------- lights

bool vtGroundPlan_IsDark(const vtGroundPlan* plan, int source)
{
    const vtVec3 light = source < 2 ? plan->irradiance[source] : plan->lights[source - 2].color;
    const vtGroundBeam beam = vtGroundPlan_Beam(plan, source);
    const bool below = source >= 2 && (beam.isNear ? beam.place.y < plan->height + 1e-3f * plan->reach
                                                   : beam.place.y < 0.02f);
    return below || !(fmaxf(light.x, fmaxf(light.y, light.z)) > 0.0f);
}

int vtGroundPlan_Across(const vtGroundPlan* plan, int source, vtGroundRays rays, int across)
{
    const int parts = source < 2 ? 1 : (int)ceilf(sqrtf((float)(plan->sourceCount - 2)));
    const int least = rays == vt_groundShade ? VT_GROUND_SIDE : 128, own = across / (8 * parts) * 8;
    return own > least ? own : least;
}

vtGroundBeam vtGroundPlan_Beam(const vtGroundPlan* plan, int source)
{
    vtGroundBeam beam = {.place = {0.0f, 1.0f, 0.0f}, .axis = {0.0f, -1.0f, 0.0f}, .cosine = -1.0f};
    if (source < 2) {
        return beam;
    }
    const vtLight* light = &plan->lights[source - 2];
    beam.isNear = light->kind != vt_lightDirectional;
    beam.place = beam.isNear ? light->position : vtScale(light->direction, -1.0f);
    const vtVec3 middle = vtScale(vtAdd(plan->glassLow, plan->glassHigh), 0.5f);
    const vtVec3 to = vtSub(middle, beam.place);
    const float radius = 0.5f * vtLength(vtSub(plan->glassHigh, plan->glassLow)), away = vtLength(to);
    if (beam.isNear && away > radius) { // else all around
        beam.axis = vtNormalize(to);
        beam.cosine = sqrtf(1.0f - radius * radius / (away * away));
    }
    return beam;
}

/// Its intensity in a direction away from it, or of a directional one the irradiance of what faces it.
static vtVec3 intensityOf(const vtLight* light, vtVec3 away, float distance)
{
    if (light->kind == vt_lightDirectional) {
        return light->color;
    }
    const float inner = cosf(light->innerCone), outer = cosf(light->outerCone);
    const float cone =
        light->kind == vt_lightSpot
            ? vtClamp((vtDot(away, light->direction) - outer) / fmaxf(inner - outer, 1e-4f), 0.0f, 1.0f)
            : 1.0f;
    const float near = light->range > 0.0f ? distance / light->range : 0.0f;
    return vtScale(light->color, cone * cone * vtClamp(1.0f - near * near * near * near, 0.0f, 1.0f));
}

/// The directions of a cone, or of all, as evenly as the square: Archimedes' hat-box.
static vtVec3 inCone(const vtGroundBeam* beam, float u, float v)
{
    vtVec3 right, up;
    vtMakeAxes(beam->axis, &right, &up);
    const float cosine = 1.0f - u * (1.0f - beam->cosine), sine = sqrtf(fmaxf(1.0f - cosine * cosine, 0.0f));
    const float angle = 2.0f * VT_PI * v;
    const vtVec3 across = vtMulAdd(vtScale(right, sine * cosf(angle)), sine * sinf(angle), up);
    return vtMulAdd(across, cosine, beam->axis);
}

/// From a place to a light, its direction and distance.
static vtVec3 towardsLight(const vtLight* light, vtVec3 at, float* distance)
{
    if (light->kind == vt_lightDirectional) {
        *distance = INFINITY;
        return vtScale(light->direction, -1.0f);
    }
    const vtVec3 to = vtSub(light->position, at);
    *distance = vtLength(to);
    return vtNormalize(to);
}

vtVec3 vtLampOnGround(const vtLight* light, vtVec3 at)
{
    float distance;
    const vtVec3 d = towardsLight(light, at, &distance);
    const float fall = isinf(distance) ? 1.0f : fmaxf(distance * distance, 1e-12f);
    return vtScale(intensityOf(light, vtScale(d, -1.0f), distance), fmaxf(d.y, 0.0f) / fall);
}

static vtGroundRay shadeRay(const vtGroundPlan* plan, const vtLight* light, vtVec3 at)
{
    float distance;
    const vtVec3 d = towardsLight(light, at, &distance);
    const float below = (float)VT_GROUND_BELOW * plan->reach / d.y;
    return (vtGroundRay){vtMulAdd(at, -below, d), d, vtLampOnGround(light, at), 0.0f, distance + below};
}

// ------------------------------------------------------------------------------------------------- rays

/// Chris Wellons' lowbias32, 2018. The twin of photons.frag's.
static uint32_t scramble(uint32_t x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

/// The twin of photons.frag's.
static uint32_t sampleOf(uint32_t x, uint32_t y, uint32_t across, uint32_t seed)
{
    uint32_t order = 0;
    for (uint32_t bit = 0; bit < 3; ++bit) {
        const uint32_t a = (x >> bit) & 1u, b = (y >> bit) & 1u;
        order = 4u * order + 2u * (a ^ b) + b;
    }
    order ^= seed & 3u; // other strata in each 4 x 4 of them
    const uint32_t part = VT_GROUND_SAMPLES / 64;
    return order * part + scramble(x + y * across + seed) % part;
}

/// From far away across the box of the glass.
static vtGroundRay distantPhoton(const vtGroundPlan* plan, vtVec3 d, vtVec3 color, float u, float v)
{
    const vtVec3 centre = vtScale(vtAdd(plan->glassLow, plan->glassHigh), 0.5f);
    const vtVec3 half = vtScale(vtSub(plan->glassHigh, plan->glassLow), 0.5f);
    vtVec3 right, up;
    vtMakeAxes(d, &right, &up);
    const float wide = fabsf(right.x) * half.x + fabsf(right.y) * half.y + fabsf(right.z) * half.z;
    const float high = fabsf(up.x) * half.x + fabsf(up.y) * half.y + fabsf(up.z) * half.z;
    vtVec3 origin = vtMulAdd(centre, wide * (2.0f * u - 1.0f), right);
    origin = vtMulAdd(origin, high * (2.0f * v - 1.0f), up);
    return (vtGroundRay){vtMulAdd(origin, 1.5f * plan->reach, d), vtScale(d, -1.0f), color,
                         4.0f * wide * high, INFINITY};
}

vtGroundRay vtGroundPlan_Ray(const vtGroundPlan* plan, int source, vtGroundRays rays, int x, int y,
                             int across, uint32_t seed)
{
    const float shift = vtFract(0.61803399f * (float)y);
    const float u = ((float)x + shift) / (float)across, v = ((float)y + 0.5f) / (float)across;
    const vtVec3 at = {plan->lowX + u * plan->size, plan->height, plan->lowZ + v * plan->size};
    if (source >= 2) {
        const vtLight* light = &plan->lights[source - 2];
        const vtGroundBeam beam = vtGroundPlan_Beam(plan, source);
        if (rays == vt_groundShade) {
            return shadeRay(plan, light, at);
        }
        if (!beam.isNear) {
            return distantPhoton(plan, beam.place, light->color, u, v);
        }
        // A lattice that is shifted only goes on around the axis.
        const vtVec3 d = inCone(&beam, v, vtFract(u));
        const float away = vtLength(vtSub(vtScale(vtAdd(plan->glassLow, plan->glassHigh), 0.5f), beam.place));
        return (vtGroundRay){beam.place, d, intensityOf(light, d, away), 2.0f * VT_PI * (1.0f - beam.cosine),
                             INFINITY};
    }
    const vtLightSample* sample =
        &plan->samples[source][rays][sampleOf((uint32_t)x, (uint32_t)y, (uint32_t)across, seed)];
    const vtVec3 d = sample->direction;
    if (rays == vt_groundShade) { // from below, so that what lies on the ground is met
        return (vtGroundRay){vtMulAdd(at, -(float)VT_GROUND_BELOW * plan->reach / d.y, d), d, sample->color,
                             0.0f, INFINITY};
    }
    return distantPhoton(plan, d, sample->color, u, v);
}

// ----------------------------------------------------------------------------------------------- gather

static void add(float* texel, vtVec3 light, float share)
{
    texel[0] += share * light.x;
    texel[1] += share * light.y;
    texel[2] += share * light.z;
}

void vtGroundPlan_AddShade(vtGroundPlan* plan, int source, const vtGroundRay* ray, int x, int y, int across,
                           bool isLit)
{
    const vtGroundLight light = vtGroundLightOf(source);
    const int count = vtGroundSide(light), column = x * count / across, row = y * count / across;
    const float share = (float)count / (float)across;
    const int texel = 3 * (row * count + column);
    if (isLit) {
        add(plan->sums[light] + texel, ray->color, share * share);
    }
    add(plan->unshaded[light] + texel, ray->color, share * share);
}

void vtGroundPlan_EndShade(vtGroundPlan* plan, int source)
{
    if (source >= 2) {
        return;
    }
    const int side = vtGroundSide((vtGroundLight)source);
    const float whole[3] = {plan->irradiance[source].x, plan->irradiance[source].y,
                            plan->irradiance[source].z};
    for (int i = 0; i < 3 * side * side; ++i) {
        const float all = plan->unshaded[source][i];
        plan->sums[source][i] *= all > 0.0f ? whole[i % 3] / all : 1.0f;
    }
}

void vtGroundPlan_AddPhoton(vtGroundPlan* plan, int source, const vtGroundRay* ray, float x, float z,
                            vtVec3 share, int across)
{
    const vtGroundLight light = source == vt_groundSky ? vt_groundBent : vtGroundLightOf(source);
    const int count = vtGroundSide(light);
    const float texels = (float)count / plan->size;
    const float column = (x - plan->lowX) * texels - 0.5f, row = (z - plan->lowZ) * texels - 0.5f;
    if (!(column > -1.0f && row > -1.0f && column < (float)count && row < (float)count)) {
        return;
    }
    const float rays = (float)across * (float)across;
    const vtVec3 flux = vtScale(vtMultiply(ray->color, share), ray->area * texels * texels / rays);
    const int left = (int)floorf(column), upper = (int)floorf(row);
    for (int k = 0; k < 4; ++k) {
        const int i = left + k % 2, j = upper + k / 2;
        if (i >= 0 && j >= 0 && i < count && j < count) {
            const float part = (1.0f - fabsf(column - (float)i)) * (1.0f - fabsf(row - (float)j));
            add(plan->sums[light] + 3 * (j * count + i), flux, part);
        }
    }
}
