// From what was gathered of the light on the ground to the map of it. It is blurred by a tent of three:
// together with the spread over four texels a smooth kernel three texels wide. What glass bends of the sky is
// blurred once more, by the mean of three texels twice.
#include "light/ground_map.h"

#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"

enum { side = VT_GROUND_SIDE };

static const float edge = 0.06f; // of the map, where it fades to nothing done

/// Means over 2 * reach + 1 texels along columns (step 1) or rows, the sides' texels going on beyond them.
static void blurLine(float* line, int count, int step, int reach, float* copy)
{
    for (int i = 0; i < count; ++i) {
        memcpy(copy + 3 * i, line + 3 * i * step, 3 * sizeof(float));
    }
    for (int channel = 0; channel < 3; ++channel) {
        double sum = 0.0;
        for (int i = -reach; i <= reach; ++i) {
            sum += (double)copy[3 * (i < 0 ? 0 : i >= count ? count - 1 : i) + channel];
        }
        for (int i = 0; i < count; ++i) {
            line[3 * i * step + channel] = (float)(sum / (double)(2 * reach + 1));
            const int before = i - reach, after = i + reach + 1;
            sum += (double)copy[3 * (after >= count ? count - 1 : after) + channel] -
                   (double)copy[3 * (before < 0 ? 0 : before) + channel];
        }
    }
}

static void blur(float* texels, int count, int reach, float* copy)
{
    for (int i = 0; i < count; ++i) {
        blurLine(texels + 3 * i * count, count, 1, reach, copy);
    }
    for (int i = 0; i < count; ++i) {
        blurLine(texels + 3 * i, count, count, reach, copy);
    }
}

/// A quarter, a half, a quarter, both ways.
static void blurByTent(float* texels, int count, float* copy)
{
    for (int line = 0; line < 2 * count; ++line) {
        float* from = line < count ? texels + 3 * line * count : texels + 3 * (line - count);
        const int step = line < count ? 1 : count;
        for (int i = 0; i < count; ++i) {
            memcpy(copy + 3 * i, from + 3 * i * step, 3 * sizeof(float));
        }
        for (int i = 0; i < count; ++i) {
            const int before = i > 0 ? i - 1 : 0, after = i < count - 1 ? i + 1 : i;
            for (int channel = 0; channel < 3; ++channel) {
                from[3 * i * step + channel] = 0.25f * copy[3 * before + channel] +
                                               0.5f * copy[3 * i + channel] +
                                               0.25f * copy[3 * after + channel];
            }
        }
    }
}

/// Bilinear between texel centres.
static vtVec3 readMap(const float* texels, int count, float u, float v)
{
    const float x = vtClamp(u * (float)count - 0.5f, 0.0f, (float)(count - 1));
    const float y = vtClamp(v * (float)count - 0.5f, 0.0f, (float)(count - 1));
    const int left = (int)x, upper = (int)y, right = left + 1 < count ? left + 1 : left;
    const int lower = upper + 1 < count ? upper + 1 : upper;
    const float a = x - (float)left, b = y - (float)upper;
    const vtVec3 above = vtMulAdd(vtScale(vtMakeVec3(texels + 3 * (upper * count + left)), 1.0f - a), a,
                                  vtMakeVec3(texels + 3 * (upper * count + right)));
    const vtVec3 below = vtMulAdd(vtScale(vtMakeVec3(texels + 3 * (lower * count + left)), 1.0f - a), a,
                                  vtMakeVec3(texels + 3 * (lower * count + right)));
    return vtMulAdd(vtScale(above, 1.0f - b), b, below);
}

static float divide(float a, float b)
{
    return b > 0.0f ? a / b : 1.0f;
}

static float smoothEdge(float u, float v)
{
    const float inside = fminf(fminf(u, 1.0f - u), fminf(v, 1.0f - v)) - 1.0f / (float)side;
    const float t = vtClamp(inside / edge, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// What is gathered to shares of the light without a scene.
static void compose(const vtGroundPlan* plan, vtGroundMap* map)
{
    const vtVec3 far = vtAdd(plan->irradiance[vt_groundSky], plan->irradiance[vt_groundSun]);
    const float* byLamps = plan->unshaded[vt_groundLights];
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < side * side; ++i) {
        const float u = ((float)(i % side) + 0.5f) / (float)side,
                    v = ((float)(i / side) + 0.5f) / (float)side;
        const vtVec3 sky = vtAdd(readMap(plan->sums[vt_groundSky], vtGroundSide(vt_groundSky), u, v),
                                 readMap(plan->sums[vt_groundBent], vtGroundSide(vt_groundBent), u, v));
        vtVec3 light = vtAdd(sky, vtMakeVec3(plan->sums[vt_groundSun] + 3 * i));
        light = byLamps != NULL ? vtAdd(light, vtMakeVec3(plan->sums[vt_groundLights] + 3 * i)) : light;
        const vtVec3 whole = byLamps != NULL ? vtAdd(far, vtMakeVec3(byLamps + 3 * i)) : far;
        sum[0] += (double)light.x;
        sum[1] += (double)light.y;
        sum[2] += (double)light.z;
        // Photons of one wavelength may add up to a colour that sRGB does not have.
        map->light[3 * i] = fmaxf(divide(light.x, whole.x), 0.0f);
        map->light[3 * i + 1] = fmaxf(divide(light.y, whole.y), 0.0f);
        map->light[3 * i + 2] = fmaxf(divide(light.z, whole.z), 0.0f);
    }
    const double texels = (double)side * (double)side;
    map->gathered = (vtVec3){(float)(sum[0] / texels), (float)(sum[1] / texels), (float)(sum[2] / texels)};
    map->irradiance = far;
}

vtResult vtGroundPlan_Finish(vtGroundPlan* plan, vtGroundMap* map, vtError* error)
{
    *map = (vtGroundMap){.light = vtAllocate((size_t)side * side, 3 * sizeof(float)),
                         .height = plan->height,
                         .lowX = plan->lowX,
                         .lowZ = plan->lowZ,
                         .size = plan->size,
                         .matt = plan->ground.matt,
                         .color = plan->ground.color,
                         .lights = plan->lights,
                         .lightCount = plan->sourceCount - 2};
    float* copy = vtAllocate(side, 3 * sizeof(float));
    if (map->light == NULL || copy == NULL) {
        vtFree(copy);
        vtDestroyGroundMap(map);
        return vtFail(error, vt_errorMemory, "ground: out of memory");
    }
    for (int light = 0; light < vt_groundLightCount; ++light) {
        if (plan->sums[light] != NULL) {
            blurByTent(plan->sums[light], vtGroundSide((vtGroundLight)light), copy);
        }
    }
    if (plan->unshaded[vt_groundLights] != NULL) {
        blurByTent(plan->unshaded[vt_groundLights], side, copy);
    }
    for (int i = 0; i < 2; ++i) {
        blur(plan->sums[vt_groundBent], vtGroundSide(vt_groundBent), 1, copy);
    }
    compose(plan, map);
    const int reach = (int)(0.05f * plan->ground.shadowSoftness * (float)side);
    for (int i = 0; i < 3 && reach > 0; ++i) {
        blur(map->light, side, reach, copy);
    }
    vtFree(copy);
    for (int i = 0; i < side * side; ++i) {
        const float u = ((float)(i % side) + 0.5f) / (float)side,
                    v = ((float)(i / side) + 0.5f) / (float)side;
        const float share = smoothEdge(u, v) * plan->ground.shadowIntensity;
        for (int channel = 0; channel < 3; ++channel) {
            map->light[3 * i + channel] = 1.0f + share * (map->light[3 * i + channel] - 1.0f);
        }
    }
    return vtSucceed(error);
}

void vtDestroyGroundMap(vtGroundMap* map)
{
    vtFree(map->light);
    *map = (vtGroundMap){0};
}

/// Does the ray come down to it from above? Then *at is where, *share its light there over what it would
/// have.
static bool meet(const vtGroundMap* map, vtVec3 position, vtVec3 direction, vtVec3* at, vtVec3* share)
{
    const float above = position.y - map->height;
    if (!(direction.y < -1e-6f) || above < -1e-3f * map->size) {
        return false;
    }
    *at = vtMulAdd(position, fmaxf(above, 0.0f) / -direction.y, direction);
    *share = readMap(map->light, side, (at->x - map->lowX) / map->size, (at->z - map->lowZ) / map->size);
    return true;
}

vtVec3 vtGroundMap_Light(const vtGroundMap* map, vtVec3 position, vtVec3 direction, vtVec3 beyond)
{
    vtVec3 at, share;
    if (!meet(map, position, direction, &at, &share)) {
        return beyond;
    }
    if (!map->matt) {
        return vtMultiply(share, beyond);
    }
    vtVec3 light = map->irradiance;
    for (int i = 0; i < map->lightCount; ++i) {
        light = vtAdd(light, vtLampOnGround(&map->lights[i], at));
    }
    return vtMultiply(share, vtScale(vtMultiply(map->color, light), 1.0f / VT_PI));
}

vtVec3 vtGroundMap_Over(const vtGroundMap* map, vtVec3 position, vtVec3 direction, vtVec3 light,
                        float* covered)
{
    vtVec3 at, share;
    *covered = 0.0f;
    if (!meet(map, position, direction, &at, &share)) {
        return (vtVec3){0.0f, 0.0f, 0.0f};
    }
    if (map->matt) {
        *covered = 1.0f;
        return light;
    }
    const vtVec3 more = {light.x * fmaxf(1.0f - 1.0f / fmaxf(share.x, 1e-3f), 0.0f),
                         light.y * fmaxf(1.0f - 1.0f / fmaxf(share.y, 1e-3f), 0.0f),
                         light.z * fmaxf(1.0f - 1.0f / fmaxf(share.z, 1e-3f), 0.0f)};
    const float shadow = 1.0f - fminf(fminf(share.x, fminf(share.y, share.z)), 1.0f);
    *covered = vtClamp(fmaxf(shadow, fmaxf(more.x, fmaxf(more.y, more.z))), 0.0f, 1.0f);
    return more;
}
