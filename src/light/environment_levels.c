// This work is based on:
//   Lance Williams. Pyramidal Parametrics. SIGGRAPH 1983: a picture at half the size, a quarter, ...
// Departures: the pictures are equirectangular. Rows count by their part of the sphere; and since texels are
// narrow near the poles, each shown one is the mean of as many of its row as are as wide as it is high.
#include "light/environment_levels.h"

#include <math.h>

#include "base/math.h"
#include "base/memory.h"

int vtEnvironmentLevelCount(int width, int height)
{
    int levels = 1;
    for (int side = width > height ? width : height; side > 1; side /= 2) {
        ++levels;
    }
    return levels;
}

static int half(int side)
{
    return side > 1 ? side / 2 : 1;
}

/// The share of texel `k`, of `from`, that lies in texel `i` of `to`.
static float coverOf(int i, int to, int k, int from)
{
    const float low = (float)i * (float)from / (float)to, high = (float)(i + 1) * (float)from / (float)to;
    return fmaxf(fminf(high, (float)(k + 1)) - fmaxf(low, (float)k), 0.0f);
}

/// Adds `share` of a row, as long as the target has columns.
static void addRow(const float* row, int from, float share, float* target, int to)
{
    const float part = share * (float)to / (float)from;
    for (int column = 0; column < to; ++column) {
        const int left = column * from / to; // up to three texels lie in one
        for (int i = left; i < left + 3 && i < from; ++i) {
            const float weight = part * coverOf(column, to, i, from);
            for (int c = 0; c < 3; ++c) {
                target[3 * column + c] += weight * row[3 * i + c];
            }
        }
    }
}

bool vtHalveEnvironment(const vtEnvironment* picture, vtEnvironmentLevel* level)
{
    const vtEnvironmentLevel from =
        level->pixels != NULL ? *level
                              : (vtEnvironmentLevel){picture->pixels, picture->width, picture->height};
    vtEnvironmentLevel to = {.width = half(from.width), .height = half(from.height)};
    to.pixels = vtAllocateZeroed((size_t)to.width * (size_t)to.height, 3 * sizeof(float));
    if (to.pixels == NULL) {
        return false;
    }
    for (int row = 0; row < to.height; ++row) {
        const int top = row * from.height / to.height;
        float shares[3] = {0.0f, 0.0f, 0.0f}, all = 0.0f;
        for (int k = 0; k < 3 && top + k < from.height; ++k) {
            shares[k] = coverOf(row, to.height, top + k, from.height) *
                        sinf(VT_PI * ((float)(top + k) + 0.5f) / (float)from.height);
            all += shares[k];
        }
        for (int k = 0; k < 3 && top + k < from.height; ++k) {
            addRow(from.pixels + 3 * (size_t)(top + k) * (size_t)from.width, from.width, shares[k] / all,
                   to.pixels + 3 * (size_t)row * (size_t)to.width, to.width);
        }
    }
    vtFree(level->pixels);
    *level = to;
    return true;
}

/// A row, each texel the mean of `count` of them, a whole number or not.
static void widenRow(const float* in, int width, float count, float* out)
{
    const int reach = (int)ceilf(0.5f * count - 0.5f); // texels on either side, the last in part
    const double beside = (double)((float)reach + 0.5f - 0.5f * count); // what is not of that part
    for (int c = 0; c < 3; ++c) {
        double sum = 0.0; // of those within reach
        for (int i = -reach; i <= reach; ++i) {
            sum += (double)in[3 * ((i + width) % width) + c];
        }
        for (int i = 0; i < width; ++i) {
            const int left = (i - reach + width) % width, right = (i + reach) % width;
            const double ends = (double)in[3 * left + c] + (double)in[3 * right + c];
            out[3 * i + c] = (float)((sum - beside * ends) / (double)count);
            sum += (double)in[3 * ((i + reach + 1) % width) + c] - (double)in[3 * left + c];
        }
    }
}

void vtWidenEnvironment(const vtEnvironmentLevel* level, float* out)
{
    const int width = level->width, height = level->height;
    for (int row = 0; row < height; ++row) {
        const float across = sinf(VT_PI * ((float)row + 0.5f) / (float)height);
        const float count = 0.5f * (float)width / ((float)height * across); // as wide as one texel is high
        const size_t start = 3 * (size_t)row * (size_t)width;
        widenRow(level->pixels + start, width, vtClamp(count, 1.0f, (float)width), out + start);
    }
}
