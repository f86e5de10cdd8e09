// This work is based on:
//   Paul Debevec. A Median Cut Algorithm for Light Probe Sampling, 2005, and Matt Pharr, Greg Humphreys.
//   Physically Based Rendering, 2004, 14.2.4: directions of an environment by its own brightness;
//   James Arvo. Backward Ray Tracing. 1986: light that glass bends, followed from the light and gathered in a
//   map over the surface that it falls on;
//   Henrik Wann Jensen. Global Illumination Using Photon Maps. 1996: what comes straight is not looked for
//   among the photons.
// Departures:
//  - The ground is one square map. A photon is spread over four texels by its place, then the map is blurred
//    by a tent of three: together a smooth kernel three texels wide.
//  - Rays stand on a lattice, rows of a grid shifted by the golden ratio, and their directions come in a
//    fixed order that has all parts of a light in every
//    8 x 8 of them (Bayer 1973), so that even light comes out even.
//  - Glass and what is opaque cast the same shadow; all the light that glass lets through is photons'.
//  - The sun of an environment is what hangs together with its brightest place and is at least a fifth as
//    bright, if that is 20 times the mean and small (0.02 sr; the true sun has 0.00007).
#include "light/ground.h"

#include <math.h>
#include <string.h>

#include "base/about.h"
#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"

enum {
    side = VT_GROUND_SIDE,
    sampleSide = 64, // VT_GROUND_SAMPLES is its square
    skyColumns = 256,
    skyRows = 64, // of the upper half
};

static const float sunShare = 0.2f, sunOverMean = 20.0f, largestSun = 0.02f;
static const float edge = 0.06f; // of the map, where it fades to nothing done

static float luminance(vtVec3 c)
{
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

// ------------------------------------------------------------------------------------------- definition

vtGround vtDefaultGround(void)
{
    return (vtGround){.height = NAN,
                      .color = {0.8f, 0.8f, 0.8f},
                      .shadowIntensity = 1.0f,
                      .sunSize = 0.53f,
                      .sunColor = {3.0f, 3.0f, 3.0f}};
}

#ifdef VT_WITH_ABOUT // a page's attributes have their ranges
static bool isFinite(vtVec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static vtResult checkNumber(const char* name, float value, float most, vtError* error)
{
    return value >= 0.0f && value <= most // written so that NaN fails
               ? vt_ok
               : vtFail(error, vt_errorArgument, "ground: its %s is %g; it must be from 0 to %g", name,
                        (double)value, (double)most);
}

static vtResult checkColor(const char* name, vtVec3 c, float most, vtError* error)
{
    vtResult result = checkNumber(name, c.x, most, error);
    result = result == vt_ok ? checkNumber(name, c.y, most, error) : result;
    return result == vt_ok ? checkNumber(name, c.z, most, error) : result;
}

vtResult vtValidateGround(const vtGround* ground, vtError* error)
{
    if (ground == NULL) {
        return vtFailMissing(error, "vtValidateGround", "ground");
    }
    vtResult result = checkColor("color", ground->color, 1.0f, error);
    result = result == vt_ok ? checkNumber("shadow intensity", ground->shadowIntensity, 1.0f, error) : result;
    result = result == vt_ok ? checkNumber("shadow softness", ground->shadowSoftness, 1.0f, error) : result;
    result = result == vt_ok ? checkNumber("sun's size", ground->sunSize, 90.0f, error) : result;
    result = result == vt_ok ? checkColor("sun's color", ground->sunColor, 1e6f, error) : result;
    if (result != vt_ok) {
        return result;
    }
    if (isinf(ground->height)) {
        return vtFail(error, vt_errorArgument,
                      "ground: its height is infinite; give a number, or NAN for the "
                      "scene's lowest point");
    }
    const vtVec3 sun = ground->sunDirection;
    const bool none = sun.x == 0.0f && sun.y == 0.0f && sun.z == 0.0f;
    if (!none && (!isFinite(sun) || !(sun.y > 0.02f * vtLength(sun)))) {
        return vtFail(error, vt_errorArgument,
                      "ground: the sun's direction is %g, %g, %g; it must point up, by more than a degree",
                      (double)sun.x, (double)sun.y, (double)sun.z);
    }
    return vtSucceed(error);
}
#else
vtResult vtValidateGround(const vtGround* ground, vtError* error)
{
    (void)ground;
    return vtSucceed(error);
}
#endif

// -------------------------------------------------------------------------------------------------- sun

/// u about the upright axis, elevation from 0 to 1 (a right angle).
static vtVec3 skyDirection(float u, float elevation)
{
    const float azimuth = 2.0f * VT_PI * (u - 0.5f), angle = 0.5f * VT_PI * elevation;
    return (vtVec3){cosf(angle) * cosf(azimuth), sinf(angle), cosf(angle) * sinf(azimuth)};
}

/// The upper half of an environment, in texels of equal angles, and their solid angles.
typedef struct Dome {
    int columns, rows;
    vtVec3* light;
    uint32_t* waiting; ///< texels of the sun, in the order in which they were found
    bool* isFound;
} Dome;

static float domeAngle(const Dome* dome, int row)
{
    const float step = 0.5f * VT_PI / (float)dome->rows;
    return (sinf(step * (float)(row + 1)) - sinf(step * (float)row)) * 2.0f * VT_PI / (float)dome->columns;
}

static vtVec3 domeDirection(const Dome* dome, uint32_t at)
{
    const uint32_t columns = (uint32_t)dome->columns;
    return skyDirection(((float)(at % columns) + 0.5f) / (float)dome->columns,
                        ((float)(at / columns) + 0.5f) / (float)dome->rows);
}

/// Texels that hang together with `from` and are brighter than `least`.
static uint32_t spreadSun(Dome* dome, uint32_t from, float least)
{
    const int columns = dome->columns;
    uint32_t count = 1;
    dome->waiting[0] = from;
    dome->isFound[from] = true;
    for (uint32_t i = 0; i < count; ++i) {
        const int column = (int)dome->waiting[i] % columns, row = (int)dome->waiting[i] / columns;
        const int next[4][2] = {
            {column + 1, row}, {column + columns - 1, row}, {column, row + 1}, {column, row - 1}};
        for (int k = 0; k < 4; ++k) {
            const int y = next[k][1];
            if (y < 0 || y >= dome->rows) {
                continue;
            }
            const uint32_t at = (uint32_t)(y * columns + next[k][0] % columns);
            if (!dome->isFound[at] && luminance(dome->light[at]) > least) {
                dome->isFound[at] = true;
                dome->waiting[count++] = at;
            }
        }
    }
    return count;
}

static void measureSun(Dome* dome, const vtEnvironment* environment, vtSun* sun)
{
    const uint32_t count = (uint32_t)dome->columns * (uint32_t)dome->rows;
    uint32_t peak = 0;
    double mean = 0.0;
    for (uint32_t i = 0; i < count; ++i) {
        dome->light[i] = vtEnvironment_Sample(environment, domeDirection(dome, i));
        const float bright = luminance(dome->light[i]);
        mean += (double)(bright * domeAngle(dome, (int)i / dome->columns));
        peak = bright > luminance(dome->light[peak]) ? i : peak;
    }
    mean /= 2.0 * (double)VT_PI;
    const float brightest = luminance(dome->light[peak]);
    if (!((double)brightest > (double)sunOverMean * mean)) {
        return;
    }
    const uint32_t found = spreadSun(dome, peak, sunShare * brightest);
    vtVec3 direction = {0.0f, 0.0f, 0.0f}, irradiance = direction;
    float angle = 0.0f;
    for (uint32_t i = 0; i < found; ++i) {
        const uint32_t at = dome->waiting[i];
        const float part = domeAngle(dome, (int)at / dome->columns);
        angle += part;
        irradiance = vtMulAdd(irradiance, part, dome->light[at]);
        direction = vtMulAdd(direction, part * luminance(dome->light[at]), domeDirection(dome, at));
    }
    direction = vtNormalize(direction);
    if (angle < largestSun && direction.y > 0.02f) {
        *sun = (vtSun){direction, sqrtf(angle / VT_PI), irradiance, sunShare * brightest};
    }
}

bool vtFindSun(const vtEnvironment* environment, vtSun* sun)
{
    *sun = (vtSun){.direction = {0.0f, 1.0f, 0.0f}};
    const bool isPicture = environment->kind == vt_environmentImage;
    const int wide = isPicture && environment->width < 1024 ? environment->width : 1024;
    Dome dome = {.columns = wide > 8 ? wide : 8};
    dome.rows = dome.columns / 4;
    const size_t count = (size_t)dome.columns * (size_t)dome.rows;
    dome.light = vtAllocate(count, sizeof *dome.light);
    dome.waiting = vtAllocate(count, sizeof *dome.waiting);
    dome.isFound = vtAllocateZeroed(count, sizeof *dome.isFound);
    const bool ready = dome.light != NULL && dome.waiting != NULL && dome.isFound != NULL;
    if (ready) {
        measureSun(&dome, environment, sun);
    }
    vtFree(dome.light);
    vtFree(dome.waiting);
    vtFree(dome.isFound);
    return ready;
}

// --------------------------------------------------------------------------------------------- samples

/// Two numbers from 0 to 1 for each sample: neighbours in the list are neighbours in the square (Morton
/// 1966).
static void squareAt(int index, float* u, float* v)
{
    int x = 0, y = 0;
    for (int bit = 0; bit < 6; ++bit) {
        x |= ((index >> (2 * bit)) & 1) << bit;
        y |= ((index >> (2 * bit + 1)) & 1) << bit;
    }
    *u = ((float)x + 0.5f) / (float)sampleSide;
    *v = ((float)y + 0.5f) / (float)sampleSide;
}

static void makeAxes(vtVec3 direction, vtVec3* right, vtVec3* up)
{
    const vtVec3 other = fabsf(direction.y) < 0.9f ? (vtVec3){0.0f, 1.0f, 0.0f} : (vtVec3){1.0f, 0.0f, 0.0f};
    *right = vtNormalize(vtCross(direction, other));
    *up = vtCross(direction, *right);
}

static void sampleSun(const vtSun* sun, vtLightSample* samples[vt_groundRaysCount])
{
    vtVec3 right, up;
    makeAxes(sun->direction, &right, &up);
    for (int i = 0; i < VT_GROUND_SAMPLES; ++i) {
        float u, v;
        squareAt(i, &u, &v);
        const float radius = sinf(sun->radius) / cosf(sun->radius) * sqrtf(u), angle = 2.0f * VT_PI * v;
        vtVec3 d = vtMulAdd(sun->direction, radius * cosf(angle), right);
        d = vtNormalize(vtMulAdd(d, radius * sinf(angle), up));
        d.y = fmaxf(d.y, 0.01f); // none of it has set
        d = vtNormalize(d);
        samples[vt_groundPhotons][i] = (vtLightSample){d, sun->irradiance};
        samples[vt_groundShade][i] = (vtLightSample){d, vtScale(sun->irradiance, d.y)};
    }
}

/// The environment without its sun, and with it sums of luminance: along rows, and of rows.
typedef struct Sky {
    vtVec3 light[skyRows * skyColumns];
    float along[skyRows * skyColumns], rows[skyRows];
} Sky;

static void fillSky(const vtEnvironment* environment, const vtSun* sun, Sky* sky)
{
    const float hides = cosf(1.5f * sun->radius + 0.02f);
    const bool hasSun = luminance(sun->irradiance) > 0.0f;
    for (int i = 0; i < skyRows * skyColumns; ++i) {
        vtVec3 sum = {0.0f, 0.0f, 0.0f};
        for (int k = 0; k < 4; ++k) {
            const vtVec3 d =
                skyDirection(((float)(i % skyColumns) + 0.25f + 0.5f * (float)(k % 2)) / (float)skyColumns,
                             ((float)(i / skyColumns) + 0.25f + 0.5f * (float)(k / 2)) / (float)skyRows);
            vtVec3 light = vtEnvironment_Sample(environment, d);
            const float bright = luminance(light);
            if (hasSun && bright > sun->brightest && vtDot(d, sun->direction) > hides) {
                light = vtScale(light, sun->brightest / bright);
            }
            sum = vtMulAdd(sum, 0.25f, light);
        }
        sky->light[i] = sum;
    }
}

/// The place in 0 to `count` where sums pass `at` times their last, and how much of the whole lies there.
static float findPlace(const float* sums, int count, float at)
{
    const float wanted = at * sums[count - 1];
    int low = 0;
    while (low < count - 1 && sums[low] < wanted) {
        ++low;
    }
    const float before = low > 0 ? sums[low - 1] : 0.0f, part = sums[low] - before;
    return (float)low + (part > 0.0f ? vtClamp((wanted - before) / part, 0.0f, 0.9999f) : 0.5f);
}

/// Directions as often as there is light from them. `byCosine`: light on the ground, else on what faces it.
/// The irradiance that all of them mean.
static vtVec3 sampleSky(Sky* sky, bool byCosine, vtLightSample* samples)
{
    float total = 0.0f;
    for (int row = 0; row < skyRows; ++row) {
        const float step = 0.5f * VT_PI / (float)skyRows, angle = step * ((float)row + 0.5f);
        const float part = (sinf(step * (float)(row + 1)) - sinf(step * (float)row)) * 2.0f * VT_PI /
                           (float)skyColumns * (byCosine ? sinf(angle) : 1.0f);
        float sum = 0.0f;
        for (int column = 0; column < skyColumns; ++column) {
            sum += part * luminance(sky->light[row * skyColumns + column]);
            sky->along[row * skyColumns + column] = sum;
        }
        total += sum;
        sky->rows[row] = total;
    }
    vtVec3 mean = {0.0f, 0.0f, 0.0f};
    for (int i = 0; i < VT_GROUND_SAMPLES; ++i) {
        float u, v;
        squareAt(i, &u, &v);
        const float y = findPlace(sky->rows, skyRows, v);
        const float x = findPlace(sky->along + (int)y * skyColumns, skyColumns, u);
        const vtVec3 light = sky->light[(int)y * skyColumns + (int)x];
        const float bright = luminance(light);
        samples[i].direction = skyDirection(x / (float)skyColumns, fmaxf(y / (float)skyRows, 0.01f));
        samples[i].color = bright > 0.0f ? vtScale(light, total / bright) : (vtVec3){0.0f, 0.0f, 0.0f};
        mean = vtMulAdd(mean, 1.0f / VT_GROUND_SAMPLES, samples[i].color);
    }
    return mean;
}

static vtResult sampleLights(vtGroundPlan* plan, const vtEnvironment* environment, vtSun* sun, vtError* error)
{
    Sky* sky = vtAllocate(1, sizeof *sky);
    bool ready = sky != NULL;
    for (int light = 0; light < vt_groundLightCount; ++light) {
        const size_t texels =
            (size_t)vtGroundSide((vtGroundLight)light) * (size_t)vtGroundSide((vtGroundLight)light);
        plan->sums[light] = vtAllocateZeroed(texels, 3 * sizeof(float));
        ready = ready && plan->sums[light] != NULL;
        for (int rays = 0; rays < vt_groundRaysCount; ++rays) {
            plan->samples[light][rays] = vtAllocate(VT_GROUND_SAMPLES, sizeof(vtLightSample));
            ready = ready && plan->samples[light][rays] != NULL;
        }
    }
    ready = ready && vtFindSun(environment, sun);
    if (!ready) {
        vtFree(sky);
        return vtFail(error, vt_errorMemory, "ground: out of memory");
    }
    fillSky(environment, sun, sky);
    plan->irradiance[vt_groundSky] = sampleSky(sky, true, plan->samples[vt_groundSky][vt_groundShade]);
    sampleSky(sky, false, plan->samples[vt_groundSky][vt_groundPhotons]);
    vtFree(sky);
    const vtGround* ground = &plan->ground;
    if (vtLength(ground->sunDirection) > 0.0f) {
        sun->direction = vtNormalize(ground->sunDirection);
        sun->radius = 0.5f * ground->sunSize * VT_PI / 180.0f;
        sun->irradiance = ground->sunColor;
    }
    sampleSun(sun, plan->samples[vt_groundSun]);
    vtVec3 mean = {0.0f, 0.0f, 0.0f};
    for (int i = 0; i < VT_GROUND_SAMPLES; ++i) {
        mean = vtMulAdd(mean, 1.0f / VT_GROUND_SAMPLES, plan->samples[vt_groundSun][vt_groundShade][i].color);
    }
    plan->irradiance[vt_groundSun] = mean;
    return vt_ok;
}

// ------------------------------------------------------------------------------------------------- plan

/// The square: what stands on the ground, its shadow by the sun, and six tenths of its height around both.
static void placeMap(vtGroundPlan* plan, const vtVec3 scene[2], const vtSun* sun)
{
    const float height = scene[1].y - plan->height;
    const bool hasSun = luminance(sun->irradiance) > 0.0f;
    const float steep = fmaxf(sun->direction.y, 0.25f);
    const float dx = hasSun ? -sun->direction.x / steep * height : 0.0f;
    const float dz = hasSun ? -sun->direction.z / steep * height : 0.0f;
    const float around = 0.6f * height + 0.1f * plan->reach;
    const float lowX = fminf(scene[0].x, scene[0].x + dx) - around;
    const float lowZ = fminf(scene[0].z, scene[0].z + dz) - around;
    const float wide = fmaxf(scene[1].x, scene[1].x + dx) + around - lowX;
    const float deep = fmaxf(scene[1].z, scene[1].z + dz) + around - lowZ;
    plan->size = fmaxf(wide, deep);
    plan->lowX = lowX - 0.5f * (plan->size - wide);
    plan->lowZ = lowZ - 0.5f * (plan->size - deep);
}

vtResult vtPlanGround(const vtGround* ground, const vtEnvironment* environment, const vtVec3 scene[2],
                      const vtVec3 glass[2], vtGroundPlan* plan, vtError* error)
{
    *plan = (vtGroundPlan){.ground = *ground,
                           .height = isnan(ground->height) ? scene[0].y : ground->height,
                           .glassLow = glass[0],
                           .glassHigh = glass[1],
                           .reach = vtLength(vtSub(scene[1], scene[0])),
                           .hasGlass = glass[0].x <= glass[1].x};
#ifdef VT_WITH_ABOUT // a page has it at the lowest point
    if (plan->height > scene[0].y + 1e-3f * plan->reach) {
        return vtFail(error, vt_errorArgument,
                      "ground: it lies at %g, but the scene reaches down to %g; put it there or below",
                      (double)plan->height, (double)scene[0].y);
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
        for (int rays = 0; rays < vt_groundRaysCount; ++rays) {
            vtFree(plan->samples[light][rays]);
        }
    }
    *plan = (vtGroundPlan){0};
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
    const uint32_t part = VT_GROUND_SAMPLES / 64;
    return order * part + scramble(x + y * across + seed) % part;
}

vtGroundRay vtGroundPlan_Ray(const vtGroundPlan* plan, vtGroundLight light, vtGroundRays rays, int x, int y,
                             int across, uint32_t seed)
{
    const uint32_t index = sampleOf((uint32_t)x, (uint32_t)y, (uint32_t)across, seed);
    const vtLightSample* sample = &plan->samples[light][rays][index];
    const vtVec3 d = sample->direction;
    const float shift = vtFract(0.61803399f * (float)y);
    const float u = ((float)x + shift) / (float)across, v = ((float)y + 0.5f) / (float)across;
    if (rays == vt_groundShade) { // from below, so that what lies on the ground is met
        const vtVec3 at = {plan->lowX + u * plan->size, plan->height, plan->lowZ + v * plan->size};
        return (vtGroundRay){vtMulAdd(at, -(float)VT_GROUND_BELOW * plan->reach / d.y, d), d, sample, 0.0f};
    }
    const vtVec3 centre = vtScale(vtAdd(plan->glassLow, plan->glassHigh), 0.5f);
    const vtVec3 half = vtScale(vtSub(plan->glassHigh, plan->glassLow), 0.5f);
    vtVec3 right, up;
    makeAxes(d, &right, &up);
    const float wide = fabsf(right.x) * half.x + fabsf(right.y) * half.y + fabsf(right.z) * half.z;
    const float high = fabsf(up.x) * half.x + fabsf(up.y) * half.y + fabsf(up.z) * half.z;
    vtVec3 origin = vtMulAdd(centre, wide * (2.0f * u - 1.0f), right);
    origin = vtMulAdd(origin, high * (2.0f * v - 1.0f), up);
    return (vtGroundRay){vtMulAdd(origin, 1.5f * plan->reach, d), vtScale(d, -1.0f), sample,
                         4.0f * wide * high};
}

// ----------------------------------------------------------------------------------------------- gather

static void add(float* texel, vtVec3 light, float share)
{
    texel[0] += share * light.x;
    texel[1] += share * light.y;
    texel[2] += share * light.z;
}

void vtGroundPlan_AddLit(vtGroundPlan* plan, vtGroundLight light, const vtGroundRay* ray, int x, int y,
                         int across)
{
    const int count = vtGroundSide(light), column = x * count / across, row = y * count / across;
    const float share = (float)count / (float)across;
    add(plan->sums[light] + 3 * (row * count + column), ray->sample->color, share * share);
}

void vtGroundPlan_AddPhoton(vtGroundPlan* plan, vtGroundLight light, const vtGroundRay* ray, float x, float z,
                            vtVec3 share, int across)
{
    const int count = vtGroundSide(light);
    const float texels = (float)count / plan->size;
    const float column = (x - plan->lowX) * texels - 0.5f, row = (z - plan->lowZ) * texels - 0.5f;
    if (!(column > -1.0f && row > -1.0f && column < (float)count && row < (float)count)) {
        return;
    }
    const float rays = (float)across * (float)across;
    const vtVec3 flux = vtScale(vtMultiply(ray->sample->color, share), ray->area * texels * texels / rays);
    const int left = (int)floorf(column), upper = (int)floorf(row);
    for (int k = 0; k < 4; ++k) {
        const int i = left + k % 2, j = upper + k / 2;
        if (i >= 0 && j >= 0 && i < count && j < count) {
            const float part = (1.0f - fabsf(column - (float)i)) * (1.0f - fabsf(row - (float)j));
            add(plan->sums[light] + 3 * (j * count + i), flux, part);
        }
    }
}

// -------------------------------------------------------------------------------------------------- map

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

/// What is gathered to shares of the light without a scene, nothing done along the sides.
static void compose(const vtGroundPlan* plan, vtGroundMap* map)
{
    const vtVec3 whole = vtAdd(plan->irradiance[vt_groundSky], plan->irradiance[vt_groundSun]);
    double sum[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < side * side; ++i) {
        const float u = ((float)(i % side) + 0.5f) / (float)side,
                    v = ((float)(i / side) + 0.5f) / (float)side;
        const vtVec3 sky = readMap(plan->sums[vt_groundSky], vtGroundSide(vt_groundSky), u, v);
        const vtVec3 light = vtAdd(sky, vtMakeVec3(plan->sums[vt_groundSun] + 3 * i));
        sum[0] += (double)light.x;
        sum[1] += (double)light.y;
        sum[2] += (double)light.z;
        map->light[3 * i] = divide(light.x, whole.x);
        map->light[3 * i + 1] = divide(light.y, whole.y);
        map->light[3 * i + 2] = divide(light.z, whole.z);
    }
    const double texels = (double)side * (double)side;
    map->gathered = (vtVec3){(float)(sum[0] / texels), (float)(sum[1] / texels), (float)(sum[2] / texels)};
    map->radiance = vtMultiply(plan->ground.color, vtScale(whole, 1.0f / VT_PI));
}

vtResult vtGroundPlan_Finish(vtGroundPlan* plan, vtGroundMap* map, vtError* error)
{
    *map = (vtGroundMap){.light = vtAllocate((size_t)side * side, 3 * sizeof(float)),
                         .height = plan->height,
                         .lowX = plan->lowX,
                         .lowZ = plan->lowZ,
                         .size = plan->size,
                         .matt = plan->ground.matt};
    float* copy = vtAllocate(side, 3 * sizeof(float));
    if (map->light == NULL || copy == NULL) {
        vtFree(copy);
        vtDestroyGroundMap(map);
        return vtFail(error, vt_errorMemory, "ground: out of memory");
    }
    for (int light = 0; light < vt_groundLightCount; ++light) {
        blurByTent(plan->sums[light], vtGroundSide((vtGroundLight)light), copy);
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

vtVec3 vtGroundMap_Light(const vtGroundMap* map, vtVec3 position, vtVec3 direction, vtVec3 beyond)
{
    const float above = position.y - map->height;
    if (!(direction.y < -1e-6f) || above < -1e-3f * map->size) {
        return beyond;
    }
    const float distance = fmaxf(above, 0.0f) / -direction.y;
    const float u = (position.x + distance * direction.x - map->lowX) / map->size;
    const float v = (position.z + distance * direction.z - map->lowZ) / map->size;
    const vtVec3 share = readMap(map->light, side, u, v);
    return vtMultiply(share, map->matt ? map->radiance : beyond);
}
