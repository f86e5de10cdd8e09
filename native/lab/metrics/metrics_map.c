#include "lab/metrics/metrics_map.h"

#include <string.h>

#include "lab/metrics/metrics.h"

/// Between the two entries around `position`, counted in entries.
static void interpolate(const uint8_t (*entries)[3], int count, float position, uint8_t rgb[3])
{
    int index = (int)position;
    index = index > count - 2 ? count - 2 : index;
    float rest = position - (float)index;
    for (int c = 0; c < 3; ++c) {
        float low = entries[index][c], high = entries[index + 1][c];
        rgb[c] = (uint8_t)(low + rest * (high - low) + 0.5f);
    }
}

void vtMagma(float value, uint8_t rgb[3])
{
    // Entries 0, 16, 32, ..., 240 and 255.
    static const uint8_t entries[17][3] = {
        {0, 0, 4},      {10, 8, 34},     {29, 17, 71},    {54, 16, 107},   {81, 18, 124},   {106, 28, 129},
        {131, 38, 129}, {156, 46, 127},  {183, 55, 121},  {208, 65, 111},  {231, 82, 99},   {245, 107, 92},
        {252, 137, 97}, {254, 167, 114}, {254, 196, 136}, {253, 226, 163}, {252, 253, 191},
    };
    float position = 255.0f * (value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f);
    interpolate(entries, 17, position < 240.0f ? position / 16.0f : 15.0f + (position - 240.0f) / 15.0f, rgb);
}

void vtDrawFlip(const float* flipMap, size_t count, uint8_t* rgb)
{
    for (size_t i = 0; i < count; ++i) {
        vtMagma(flipMap[i], rgb + 3 * i);
    }
}

static void drawAngle(float degrees, uint8_t rgb[3])
{
    // 0, 1, ... 5 degrees.
    static const uint8_t entries[6][3] = {
        {16, 32, 84}, {34, 122, 182}, {98, 190, 150}, {240, 214, 72}, {240, 130, 44}, {204, 28, 36},
    };
    interpolate(entries, 6, degrees < 5.0f ? degrees : 5.0f, rgb);
}

void vtDrawDirectionDifference(const float* directions, const float* truth, size_t count, uint8_t* rgb)
{
    static const uint8_t magenta[3] = {255, 0, 255};
    for (size_t i = 0; i < count; ++i) {
        vtDirectionKind kind = vtClassifyDirection(directions + 3 * i);
        vtDirectionKind trueKind = vtClassifyDirection(truth + 3 * i);
        uint8_t* pixel = rgb + 3 * i;
        if (trueKind == vt_directionBackground) {
            memset(pixel, kind == vt_directionBackground ? 255 : 210, 3);
        } else if (trueKind == vt_directionLost) {
            memset(pixel, 128, 3);
        } else if (kind == vt_directionLost) {
            memcpy(pixel, magenta, 3);
        } else {
            drawAngle(vtDirectionAngle(directions + 3 * i, truth + 3 * i), pixel);
        }
    }
}
