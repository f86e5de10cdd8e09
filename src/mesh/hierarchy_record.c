#include "mesh/hierarchy_record.h"

/// One of 21 steps a unit, nearest.
static int toSteps(float value)
{
    return (int)(value * 21.0f + (value < 0.0f ? -0.5f : 0.5f));
}

void vtCone_Pack(const vtCone* cone, uint32_t bytes[3])
{
    bytes[0] = bytes[1] = bytes[2] = 0;
    const float cosine = vtLesser(cone->cosine, 1.0f);
    if (cosine < 0.05f) { // 87 degrees: few rays would miss it
        return;
    }
    const float* a = cone->axis;
    const float sine = sqrtf(1.0f - cosine * cosine);
    float length = sine > 1.0f / 5.9f ? 1.0f / sine : 5.9f; // 127 / 21 is more by a margin
    for (int attempt = 0; attempt < 12 && length > 1.0f; ++attempt, length -= 0.03f + 0.01f * length) {
        int q[3];
        float m[3], along = 0.0f, across = 0.0f;
        for (int k = 0; k < 3; ++k) {
            q[k] = toSteps(a[k] * length);
            m[k] = (float)q[k] * (1.0f / 21.0f);
            along += m[k] * a[k];
        }
        for (int k = 0; k < 3; ++k) {
            const float part = m[k] - along * a[k];
            across += part * part;
        }
        // |m| times the sine of the angle between m and the cone's farthest normal.
        if (sine * along + cosine * sqrtf(across) <= 0.999f) {
            for (int k = 0; k < 3; ++k) {
                bytes[k] = (uint32_t)q[k] & 255u;
            }
            return; // also where |m| <= 1: true of all directions, so harmless
        }
    }
}

void vtWriteChild(const vtGrid* grid, const vtBox* box, const vtCone* cone, uint32_t* texel)
{
    const float margin = 1.0f / 64.0f; // more than what floats lose over 4096 steps
    uint32_t bytes[3];
    vtCone_Pack(cone, bytes);
    for (int k = 0; k < 3; ++k) {
        const float low = (box->low[k] - grid->low[k]) * grid->scale[k] - margin;
        const float high = (box->high[k] - grid->low[k]) * grid->scale[k] + margin;
        const uint32_t first = (uint32_t)vtClamp(low, 0.0f, 4095.0f);
        const uint32_t last = (uint32_t)vtClamp(high, 0.0f, 4095.0f);
        texel[k] = first | last << 12 | bytes[k] << 24;
    }
}

void vtWriteLeaf(const vtGrid* grid, const float* positions, const uint32_t* normals,
                 const uint32_t corners[4], uint32_t* record)
{
    for (int i = 0; i < 4; ++i) {
        float own[3];
        vtGrid_Enter(grid, positions + 3 * (size_t)corners[i], own);
        memcpy(record + 4 * i, own, sizeof own);
        record[4 * i + 3] = normals[corners[i]];
    }
}
