// This work is based on:
//   Ravi Ramamoorthi, Pat Hanrahan. An Efficient Representation for Irradiance Environment Maps. 2001: nine
//   spherical harmonics. Constants are multiplied in, so that the sum is of plain products.
//   Brian Karis. Real Shading in Unreal Engine 4. 2013: the environment blurred by GGX with normal, view and
//   reflection alike, importance sampled.
//   Jaroslav Krivanek, Mark Colbert. Real-time Shading with Filtered Importance Sampling. 2008: a sample
//   reads the environment averaged over its share of the sphere.
// Departures: an equirectangular picture is squeezed near the poles, so it is averaged by columns and by rows
// apart (a ripmap). Turning it about +Y shifts it, so a row of texels shares one set of directions.
#include "light/lighting.h"

#include <assert.h>
#include <math.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "light/environment.h"

enum {
    side = VT_LIGHTING_SIDE, // of the environment as sampled, and of the finest level
    rows = side / 2,
    stride = 2 * side, // of the ripmap
    mostTaps = 512,
};

/// Where the ripmap has the environment averaged over 2^across columns and 2^down rows.
static vtVec3* averaged(vtVec3* rip, int across, int down)
{
    return rip + (size_t)(side - (side >> down)) * stride + (size_t)(stride - (stride >> across));
}

/// The part of the sphere that lies in a row, of so many rows.
static float shareOfRow(int row, int count)
{
    const float step = VT_PI / (float)count;
    return 0.5f * (cosf(step * (float)row) - cosf(step * (float)(row + 1)));
}

// -------------------------------------------------------------------------------------- the environment

/// Mean over a texel, without the sun: of every pixel of pictures up to 4096 across, of 2 x 2 directions
/// else.
static vtVec3 sampleTexel(const vtEnvironment* environment, const vtSun* sun, int column, int row)
{
    const bool isLarge = environment->kind == vt_environmentImage && environment->width >= 2 * side;
    const int count = isLarge ? (int)fminf((float)(environment->width / side), 16.0f) : 2;
    vtVec3 sum = {0.0f, 0.0f, 0.0f};
    for (int i = 0; i < count * count; ++i) {
        const float u = ((float)column + ((float)(i % count) + 0.5f) / (float)count) / (float)side;
        const float t = ((float)row + ((float)(i / count) + 0.5f) / (float)count) / (float)rows;
        const vtVec3 direction = vtEnvironmentDirection(u, t);
        vtVec3 light;
        if (isLarge) {
            const size_t x = (size_t)(u * (float)environment->width);
            const size_t y = (size_t)(t * (float)environment->height);
            light = vtMakeVec3(environment->pixels + 3 * (y * (size_t)environment->width + x));
            light = sun != NULL && vtSun_Holds(sun, direction, light) ? (vtVec3){0.0f, 0.0f, 0.0f} : light;
        } else {
            light = sun != NULL ? vtSampleWithoutSun(environment, sun, direction)
                                : vtEnvironment_Sample(environment, direction);
        }
        sum = vtAdd(sum, light);
    }
    return vtScale(sum, 1.0f / (float)(count * count));
}

static void fillRipmap(const vtEnvironment* environment, const vtSun* sun, vtVec3* rip)
{
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < side; ++column) {
            rip[row * stride + column] = sampleTexel(environment, sun, column, row);
        }
    }
    for (int across = 1; side >> across > 0; ++across) {
        const vtVec3* from = averaged(rip, across - 1, 0);
        vtVec3* to = averaged(rip, across, 0);
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < side >> across; ++column) {
                const vtVec3* pair = from + row * stride + 2 * column;
                to[row * stride + column] = vtScale(vtAdd(pair[0], pair[1]), 0.5f);
            }
        }
    }
    for (int down = 1; rows >> down > 0; ++down) {
        const vtVec3* from = averaged(rip, 0, down - 1);
        vtVec3* to = averaged(rip, 0, down);
        for (int row = 0; row < rows >> down; ++row) {
            const float upper = shareOfRow(2 * row, rows >> (down - 1));
            const float part = upper / shareOfRow(row, rows >> down);
            for (int column = 0; column < stride; ++column) {
                const vtVec3* pair = from + 2 * row * stride + column;
                to[row * stride + column] = vtMulAdd(vtScale(pair[0], part), 1.0f - part, pair[stride]);
            }
        }
    }
}

// ----------------------------------------------------------------------------------------------- diffuse

static void harmonics(vtVec3 n, float values[9])
{
    const float all[9] = {
        1.0f, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0f * n.z * n.z - 1.0f, n.x * n.z, n.x * n.x - n.y * n.y};
    for (int i = 0; i < 9; ++i) {
        values[i] = all[i];
    }
}

static void projectIrradiance(const vtVec3* rip, vtVec3 irradiance[9])
{
    // The squares of the harmonics' norms times 1, 2/3 and 1/4: the cosine lobe over pi, band by band.
    static const float factors[9] = {0.0795775f, 0.1591549f, 0.1591549f, 0.1591549f, 0.2984155f,
                                     0.2984155f, 0.0248680f, 0.2984155f, 0.0746039f};
    double sums[9][3] = {{0}};
    for (int row = 0; row < rows; ++row) {
        const float angle = 4.0f * VT_PI * shareOfRow(row, rows) / (float)side;
        for (int column = 0; column < side; ++column) {
            const vtVec3 light = vtScale(rip[row * stride + column], angle);
            float values[9];
            harmonics(vtEnvironmentDirection(((float)column + 0.5f) / (float)side,
                                             ((float)row + 0.5f) / (float)rows),
                      values);
            for (int i = 0; i < 9; ++i) {
                sums[i][0] += (double)(light.x * values[i]);
                sums[i][1] += (double)(light.y * values[i]);
                sums[i][2] += (double)(light.z * values[i]);
            }
        }
    }
    for (int i = 0; i < 9; ++i) {
        irradiance[i] =
            vtScale((vtVec3){(float)sums[i][0], (float)sums[i][1], (float)sums[i][2]}, factors[i]);
    }
}

vtVec3 vtLighting_Diffuse(const vtLighting* lighting, vtVec3 normal)
{
    float values[9];
    harmonics(normal, values);
    vtVec3 sum = {0.0f, 0.0f, 0.0f};
    for (int i = 0; i < 9; ++i) {
        sum = vtMulAdd(sum, values[i], lighting->irradiance[i]);
    }
    return (vtVec3){fmaxf(sum.x, 0.0f), fmaxf(sum.y, 0.0f), fmaxf(sum.z, 0.0f)};
}

// ---------------------------------------------------------------------------------------------- specular

static int levelWidth(int level)
{
    const int width = side >> level;
    return width > VT_LIGHTING_LEAST ? width : VT_LIGHTING_LEAST;
}

static int levelRow(int level)
{
    return side - (side >> level);
}

static float levelRoughness(int level)
{
    return 0.025f * (float)((level + 1) * (level + 4));
}

/// A direction that a row of texels reads the environment in.
typedef struct Tap {
    const vtVec3 *upper, *lower; ///< rows of the ripmap
    float down;                  ///< from the one to the other
    float turn;                  ///< from the texel's azimuth, of a full turn
    float weight;
    int width; ///< of the rows, a power of two
} Tap;

/// The averaging that makes a texel as large as `angle`, rounded; at most `most`.
static int levelFor(float angle, float texel, int most)
{
    const int level = (int)floorf(log2f(fmaxf(angle / texel, 1.0f)) + 0.5f);
    return level < most ? level : most;
}

static Tap makeTap(vtVec3* rip, vtVec3 L, float angle, float weight)
{
    const float across = sqrtf(L.x * L.x + L.z * L.z);
    const int columnLevel = levelFor(angle, 2.0f * VT_PI / (float)side * fmaxf(across, 1e-3f), 8);
    const int rowLevel = levelFor(angle, VT_PI / (float)rows, 7);
    const int count = rows >> rowLevel;
    const float t = 0.5f - atan2f(L.y, across) / VT_PI;
    const float y = vtClamp(t * (float)count - 0.5f, 0.0f, (float)(count - 1));
    const int upper = (int)y, lower = upper + 1 < count ? upper + 1 : upper;
    const vtVec3* from = averaged(rip, columnLevel, rowLevel);
    return (Tap){
        .upper = from + upper * stride,
        .lower = from + lower * stride,
        .down = y - (float)upper,
        .turn = across > 0.0f ? atan2f(L.z, L.x) / (2.0f * VT_PI) : 0.0f,
        .weight = weight,
        .width = side >> columnLevel,
    };
}

/// Directions about the one of azimuth 0 and that latitude, by density of GGX; weights sum to 1.
static int makeTaps(vtVec3* rip, float roughness, float latitude, int count, Tap taps[mostTaps])
{
    const vtVec3 N = {cosf(latitude), sinf(latitude), 0.0f}, up = {-N.y, N.x, 0.0f},
                 east = {0.0f, 0.0f, 1.0f};
    const float alpha = roughness * roughness, alpha2 = alpha * alpha;
    int used = 0;
    float sum = 0.0f;
    for (int i = 0; i < count; ++i) {
        // Hammersley's points: a sequence of halves, quarters, ... turns about N.
        uint32_t bits = 0;
        for (int bit = 0; bit < 16; ++bit) {
            bits |= (((uint32_t)i >> bit) & 1u) << (15 - bit);
        }
        const float turn = 2.0f * VT_PI * (float)bits / 65536.0f, share = ((float)i + 0.5f) / (float)count;
        const float cosine2 = (1.0f - share) / (1.0f + (alpha2 - 1.0f) * share); // between N and half vector
        const float cosine = 2.0f * cosine2 - 1.0f;                              // between N and L
        if (cosine <= 0.0f) {
            continue;
        }
        const float sine = sqrtf(1.0f - cosine * cosine);
        const vtVec3 aside = vtMulAdd(vtScale(up, cosf(turn) * sine), sinf(turn) * sine, east);
        const float spread = cosine2 * (alpha2 - 1.0f) + 1.0f;
        const float density = alpha2 / (4.0f * VT_PI * spread * spread);
        const float angle = sqrtf(1.0f / ((float)count * density));
        taps[used++] = makeTap(rip, vtMulAdd(aside, cosine, N), angle, cosine);
        sum += cosine;
    }
    for (int i = 0; i < used; ++i) {
        taps[i].weight /= sum;
    }
    return used;
}

/// Between two rows of `width` texels, a power of two, u turns from their left side; bilinear, sides joined.
static vtVec3 readRows(const vtVec3* upper, const vtVec3* lower, int width, float u, float down)
{
    const float x = (u + 1.0f) * (float)width - 0.5f; // a turn more: never negative
    const int whole = (int)x, left = whole & (width - 1), right = (whole + 1) & (width - 1);
    const float part = x - (float)whole;
    const vtVec3 a = vtMulAdd(vtScale(upper[left], 1.0f - part), part, upper[right]);
    const vtVec3 b = vtMulAdd(vtScale(lower[left], 1.0f - part), part, lower[right]);
    return vtMulAdd(vtScale(a, 1.0f - down), down, b);
}

static void blurLevel(vtVec3* rip, int level, vtVec3* specular)
{
    static const int tapCounts[VT_LIGHTING_LEVELS] = {64, 128, 256, mostTaps, mostTaps};
    const int width = levelWidth(level), height = width / 2;
    Tap taps[mostTaps];
    for (int row = 0; row < height; ++row) {
        const float latitude = VT_PI * (0.5f - ((float)row + 0.5f) / (float)height);
        const int count = makeTaps(rip, levelRoughness(level), latitude, tapCounts[level], taps);
        for (int column = 0; column < width; ++column) {
            const float u = ((float)column + 0.5f) / (float)width;
            vtVec3 sum = {0.0f, 0.0f, 0.0f};
            for (int i = 0; i < count; ++i) {
                const Tap* tap = &taps[i];
                sum = vtMulAdd(sum, tap->weight,
                               readRows(tap->upper, tap->lower, tap->width, u + tap->turn, tap->down));
            }
            specular[(levelRow(level) + row) * side + column] = sum;
        }
    }
}

static vtVec3 readLevel(const vtLighting* lighting, int level, vtVec3 d)
{
    const int width = levelWidth(level), height = width / 2;
    const float across = sqrtf(d.x * d.x + d.z * d.z);
    const float azimuth = across > 0.0f ? atan2f(d.z, d.x) : 0.0f;
    const float t = 0.5f - atan2f(d.y, across) / VT_PI;
    const float y = vtClamp(t * (float)height - 0.5f, 0.0f, (float)(height - 1));
    const int upper = (int)y, lower = upper + 1 < height ? upper + 1 : upper;
    const vtVec3* first = lighting->specular + levelRow(level) * side;
    return readRows(first + upper * side, first + lower * side, width, 0.5f + azimuth / (2.0f * VT_PI),
                    y - (float)upper);
}

vtVec3 vtLighting_Specular(const vtLighting* lighting, vtVec3 direction, float roughness)
{
    // The inverse of a level's roughness; -1: the environment itself.
    const float at = 0.5f * (sqrtf(9.0f + 160.0f * vtClamp(roughness, 0.0f, 1.0f)) - 5.0f);
    const float below = fminf(floorf(at), (float)(VT_LIGHTING_LEVELS - 1)), part = at - below;
    const int level = (int)below;
    const vtVec3 sharp = level < 0 ? vtEnvironment_Sample(lighting->environment, direction)
                                   : readLevel(lighting, level, direction);
    if (part <= 0.0f) {
        return sharp;
    }
    const vtVec3 blurred = readLevel(lighting, level + 1 < VT_LIGHTING_LEVELS ? level + 1 : level, direction);
    return vtMulAdd(vtScale(sharp, 1.0f - part), part, blurred);
}

// ------------------------------------------------------------------------------------------------- both

vtResult vtCreateLighting(const vtEnvironment* environment, const vtSun* without, vtLighting* lighting,
                          vtError* error)
{
    assert(environment != NULL && lighting != NULL);
    *lighting = (vtLighting){.environment = environment};
    vtVec3* rip = vtAllocateZeroed((size_t)stride * side, sizeof *rip);
    lighting->specular = vtAllocateZeroed((size_t)side * side, sizeof *lighting->specular);
    if (rip == NULL || lighting->specular == NULL) {
        vtFree(rip);
        vtDestroyLighting(lighting);
        return vtFail(error, vt_errorMemory, "lighting: out of memory");
    }
    fillRipmap(environment, without, rip);
    projectIrradiance(rip, lighting->irradiance);
    for (int level = 0; level < VT_LIGHTING_LEVELS; ++level) {
        blurLevel(rip, level, lighting->specular);
    }
    vtFree(rip);
    return vtSucceed(error);
}

void vtDestroyLighting(vtLighting* lighting)
{
    vtFree(lighting->specular);
    *lighting = (vtLighting){0};
}
