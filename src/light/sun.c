// This work is based on:
//   Bruce Walter, Stephen Marschner, Hongsong Li, Kenneth Torrance. Microfacet Models for Refraction through
//   Rough Surfaces. EGSR 2007: the lobe (GGX).
// Departures:
//  - The sun of an environment is what hangs together with its brightest place and is at least a fifth as
//    bright, if that is 20 times the mean and small (0.02 sr; the true sun has 0.00007).
//  - Its glare is the lobe that blurs the lighting (lighting.c), so that a sun which is taken out of that and
//    added again changes nothing.
#include "light/sun.h"

#include "base/memory.h"

static const float sunShare = 0.2f, sunOverMean = 20.0f, largestSun = 0.02f;

static float luminance(vtVec3 c)
{
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

// ------------------------------------------------------------------------------------------------ finding

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
    return vtSkyDirection(((float)(at % columns) + 0.5f) / (float)dome->columns,
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

static bool isNear(const vtSun* sun, vtVec3 direction)
{
    return vtSun_IsThere(sun) && vtDot(direction, sun->direction) > cosf(1.5f * sun->radius + 0.02f);
}

bool vtSun_Holds(const vtSun* sun, vtVec3 direction, vtVec3 light)
{
    return luminance(light) > sun->brightest && isNear(sun, direction);
}

/// The same of a picture: its texels are left out one by one, or what of them is blended with others would
/// stay.
static vtVec3 pictureWithoutSun(const vtEnvironment* picture, const vtSun* sun, vtVec3 d, vtVec3 light)
{
    const float across = sqrtf(d.x * d.x + d.z * d.z);
    const float x = (0.5f + atan2f(d.z, d.x) / (2.0f * VT_PI)) * (float)picture->width - 0.5f;
    const float y = (0.5f - atan2f(d.y, across) / VT_PI) * (float)picture->height - 0.5f;
    for (int k = 0; k < 4; ++k) {
        const int column = (int)floorf(x) + k % 2, row = (int)floorf(y) + k / 2;
        const int i = (column + picture->width) % picture->width;
        const int j = row < 0 ? 0 : row >= picture->height ? picture->height - 1 : row;
        const vtVec3 texel =
            vtMakeVec3(picture->pixels + 3 * ((size_t)j * (size_t)picture->width + (size_t)i));
        const float part = (1.0f - fabsf(x - (float)column)) * (1.0f - fabsf(y - (float)row));
        light = luminance(texel) > sun->brightest ? vtMulAdd(light, -part, texel) : light;
    }
    return (vtVec3){fmaxf(light.x, 0.0f), fmaxf(light.y, 0.0f), fmaxf(light.z, 0.0f)};
}

vtVec3 vtSampleWithoutSun(const vtEnvironment* environment, const vtSun* sun, vtVec3 direction)
{
    const vtVec3 light = vtEnvironment_Sample(environment, direction);
    if (!isNear(sun, direction)) {
        return light;
    }
    return environment->kind == vt_environmentImage ? pictureWithoutSun(environment, sun, direction, light)
           : vtSun_Holds(sun, direction, light)     ? (vtVec3){0.0f, 0.0f, 0.0f}
                                                    : light;
}

vtSun vtGivenSun(const vtGround* ground, const vtSun* found)
{
    const vtVec3 direction = vtNormalizeAny(ground->sunDirection);
    if (!(vtLength(direction) > 0.0f)) {
        return *found;
    }
    return (vtSun){.direction = direction,
                   .radius = 0.5f * ground->sunSize * VT_PI / 180.0f,
                   .irradiance = ground->sunColor};
}

// -------------------------------------------------------------------------------------------------- light

float vtSun_Glare(const vtSun* sun, vtVec3 direction, float roughness)
{
    // Up to the first level of the lighting a surface shows the environment itself, sun and all.
    const float seen = vtClamp(0.5f * (sqrtf(9.0f + 160.0f * roughness) - 5.0f) + 1.0f, 0.0f, 1.0f);
    const float r = fmaxf(roughness, 0.1f), alpha2 = r * r * r * r;
    // As wide as facets and sun make it; above 0.9 the difference below is lost in rounding.
    const float a = fminf(alpha2 + 0.125f * sun->radius * sun->radius, 0.9f), k = 1.0f - a;
    const float whole = 1.0f / k - 2.0f * a / (k * k) * logf((1.0f + a) / (2.0f * a));
    const float cosine = vtDot(direction, sun->direction);
    const float spread = 1.0f - 0.5f * (1.0f + cosine) * k;
    return seen * fmaxf(cosine, 0.0f) * a / (4.0f * VT_PI * spread * spread * whole);
}
