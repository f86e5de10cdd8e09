// Directions that stand for the light over a ground; the works that this is based on: ground.c.
#include "light/ground_samples.h"

#include <math.h>

#include "base/memory.h"

enum {
    sampleSide = 64, // VT_GROUND_SAMPLES is its square
    skyColumns = 256,
    skyRows = 64, // of the upper half
};

static float luminance(vtVec3 c)
{
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

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

void vtSampleSun(const vtSun* sun, vtLightSample* samples[vt_groundRaysCount])
{
    vtVec3 right, up;
    vtMakeAxes(sun->direction, &right, &up);
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
    for (int i = 0; i < skyRows * skyColumns; ++i) {
        vtVec3 sum = {0.0f, 0.0f, 0.0f};
        for (int k = 0; k < 4; ++k) {
            const vtVec3 d =
                vtSkyDirection(((float)(i % skyColumns) + 0.25f + 0.5f * (float)(k % 2)) / (float)skyColumns,
                               ((float)(i / skyColumns) + 0.25f + 0.5f * (float)(k / 2)) / (float)skyRows);
            sum = vtMulAdd(sum, 0.25f, vtSampleWithoutSun(environment, sun, d));
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
        samples[i].direction = vtSkyDirection(x / (float)skyColumns, fmaxf(y / (float)skyRows, 0.01f));
        samples[i].color = bright > 0.0f ? vtScale(light, total / bright) : (vtVec3){0.0f, 0.0f, 0.0f};
        mean = vtMulAdd(mean, 1.0f / VT_GROUND_SAMPLES, samples[i].color);
    }
    return mean;
}

bool vtSampleSky(const vtEnvironment* environment, const vtSun* sun,
                 vtLightSample* samples[vt_groundRaysCount], vtVec3* irradiance)
{
    Sky* sky = vtAllocate(1, sizeof *sky);
    if (sky == NULL) {
        return false;
    }
    fillSky(environment, sun, sky);
    *irradiance = sampleSky(sky, true, samples[vt_groundShade]);
    sampleSky(sky, false, samples[vt_groundPhotons]);
    vtFree(sky);
    return true;
}
