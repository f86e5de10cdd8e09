// Files of glass that moves, put together in memory: by a skin, by morph targets, by nodes. Each lasts two
// seconds.
#pragma once

#include <math.h>

#include "gltf_builder.h"

enum { animatedSkin, animatedMorph, animatedNodes, animatedCount };
enum { columnAround = 24, columnAlong = 20, columnCount = 2 + columnAround * columnAlong };

/// A closed column along y from -1.5 to 1.5, rounded at its ends.
typedef struct Column {
    float positions[columnCount][3], normals[columnCount][3];
    uint16_t indices[6 * columnAround * columnAlong]; // caps are triangles
} Column;

static inline void fillColumn(Column* column)
{
    int corner = 0;
    for (int i = 0; i < columnCount; ++i) {
        const int row = i == 0 ? 0 : i == columnCount - 1 ? columnAlong + 1 : 1 + (i - 1) / columnAround;
        const float polar = 3.14159265f * (float)row / (float)(columnAlong + 1);
        const float around = 6.2831853f * (float)((i - 1) % columnAround) / (float)columnAround;
        const float n[3] = {sinf(polar) * cosf(around) / 0.6f, -cosf(polar) / 1.5f,
                            sinf(polar) * sinf(around) / 0.6f};
        const float length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3; ++k) {
            column->positions[i][k] = n[k] * (k == 1 ? 2.25f : 0.36f);
            column->normals[i][k] = n[k] / length;
        }
    }
    for (int row = 0; row <= columnAlong; ++row) {
        for (int k = 0; k < columnAround; ++k) {
            const int below = row == 0 ? 0 : 1 + (row - 1) * columnAround + k;
            const int besideBelow = row == 0 ? 0 : 1 + (row - 1) * columnAround + (k + 1) % columnAround;
            const int last = columnCount - 1;
            const int above = row == columnAlong ? last : 1 + row * columnAround + k;
            const int besideAbove =
                row == columnAlong ? last : 1 + row * columnAround + (k + 1) % columnAround;
            const int corners[6] = {below, above, besideAbove, below, besideAbove, besideBelow};
            // A triangle alone at either end.
            for (int c = row == columnAlong ? 3 : 0; c < (row == 0 ? 3 : 6); ++c) {
                column->indices[corner++] = (uint16_t)corners[c];
            }
        }
    }
}

#define ANIMATED_TIMES                                                                                       \
    {                                                                                                        \
        0.0f, 1.0f, 2.0f                                                                                     \
    }

/// Accessors: 0 positions, 1 normals, 2 indices, 3 times (0, 1, 2); its own from 4 on.
static inline Builder beginColumn(void)
{
    static Column column;
    static const float times[3] = ANIMATED_TIMES;
    Builder b = {0};
    fillColumn(&column);
    ADD(&b, column.positions, glFloat, columnCount, "VEC3", "");
    ADD(&b, column.normals, glFloat, columnCount, "VEC3", "");
    ADD(&b, column.indices, glUnsignedShort, 6 * columnAround * columnAlong, "SCALAR", "");
    ADD(&b, times, glFloat, 3, "SCALAR", "");
    return b;
}

/// No metal, which GLASS is unless it says so: light passes.
#define CLEAR                                                                                                \
    "\"materials\":[{\"pbrMetallicRoughness\":{\"roughnessFactor\":0,\"metallicFactor\":0},\"extensions\":{" \
    "\"KHR_materials_transmission\":{\"transmissionFactor\":1},\"KHR_materials_volume\":{"                   \
    "\"thicknessFactor\":1}}}]"
#define COLUMN_PRIMITIVE "{\"attributes\":{\"POSITION\":0,\"NORMAL\":1%s},\"indices\":2,\"material\":0%s}"

/// The upper half bends by a joint at the middle.
static inline Built buildSkinned(void)
{
    static Column column;
    static uint8_t joints[columnCount][4];
    static float weights[columnCount][4];
    Builder b = beginColumn();
    fillColumn(&column);
    for (int i = 0; i < columnCount; ++i) {
        const float share = fminf(fmaxf(0.5f + column.positions[i][1], 0.0f), 1.0f);
        joints[i][1] = 1;
        weights[i][0] = 1.0f - share;
        weights[i][1] = share;
    }
    const float turns[3][4] = {{0, 0, 0, 1}, {0, 0, 0.4226183f, 0.9063078f}, {0.3826834f, 0, 0, 0.9238795f}};
    ADD(&b, joints, glUnsignedByte, columnCount, "VEC4", "");
    ADD(&b, weights, glFloat, columnCount, "VEC4", "");
    ADD(&b, turns, glFloat, 3, "VEC4", "");
    char rest[1600];
    snprintf(rest, sizeof rest,
             CLEAR ",\"meshes\":[{\"primitives\":[" COLUMN_PRIMITIVE
                   "]}],\"skins\":[{\"joints\":[1,2]}],\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":["
                   "{\"mesh\":0,\"skin\":0},{\"children\":[2]},{\"name\":\"bend\"}],\"animations\":[{"
                   "\"name\":\"bow\",\"samplers\":[{\"input\":3,\"output\":6}],\"channels\":[{"
                   "\"sampler\":0,\"target\":{\"node\":2,\"path\":\"rotation\"}}]}]",
             ",\"JOINTS_0\":4,\"WEIGHTS_0\":5", "");
    return build(&b, rest);
}

/// It grows thick, then twists to the side.
static inline Built buildMorphed(void)
{
    static Column column;
    static float thick[2][columnCount][3], lean[2][columnCount][3];
    Builder b = beginColumn();
    fillColumn(&column);
    for (int i = 0; i < columnCount; ++i) {
        const float *p = column.positions[i], *n = column.normals[i];
        thick[0][i][0] = p[0], thick[0][i][2] = p[2];
        thick[1][i][1] = n[1];
        lean[0][i][0] = 0.3f * p[1] * p[1];
        lean[1][i][1] = -0.6f * p[1] * n[0]; // of the inverse transposed
    }
    const float weights[6] = {0, 0, 0.5f, 0, 0.2f, 1.0f};
    ADD(&b, thick[0], glFloat, columnCount, "VEC3", "");
    ADD(&b, thick[1], glFloat, columnCount, "VEC3", "");
    ADD(&b, lean[0], glFloat, columnCount, "VEC3", "");
    ADD(&b, lean[1], glFloat, columnCount, "VEC3", "");
    ADD(&b, weights, glFloat, 6, "SCALAR", "");
    char rest[1600];
    snprintf(rest, sizeof rest,
             CLEAR ",\"meshes\":[{\"primitives\":[" COLUMN_PRIMITIVE "]}],\"nodes\":[{\"mesh\":0}],"
                   "\"animations\":[{\"name\":\"breathe\",\"samplers\":[{\"input\":3,\"output\":8}],"
                   "\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"weights\"}}]}]",
             "", ",\"targets\":[{\"POSITION\":4,\"NORMAL\":5},{\"POSITION\":6,\"NORMAL\":7}]");
    return build(&b, rest);
}

/// Two columns, one below a node that turns and one that moves and grows; the file's second animation moves
/// nothing but the second one.
static inline Built buildMoved(void)
{
    Builder b = beginColumn();
    const float turns[3][4] = {{0, 0, 0, 1}, {0, 0, 0.7071068f, 0.7071068f}, {0.5f, 0.5f, 0.5f, 0.5f}};
    const float places[3][3] = {{1.2f, 0, 0}, {1.2f, 0.8f, -0.5f}, {1.2f, -0.6f, 0.4f}};
    const float sizes[3][3] = {{1, 1, 1}, {0.5f, 1.2f, 0.5f}, {0.8f, 0.6f, 1.1f}};
    ADD(&b, turns, glFloat, 3, "VEC4", "");
    ADD(&b, places, glFloat, 3, "VEC3", "");
    ADD(&b, sizes, glFloat, 3, "VEC3", "");
    char rest[2400];
    snprintf(rest, sizeof rest,
             CLEAR
             ",\"meshes\":[{\"primitives\":[" COLUMN_PRIMITIVE
             "]}],\"scenes\":[{\"nodes\":[0,2]}],\"nodes\":[{\"translation\":[-1,0,0],\"children\":[1]},"
             "{\"mesh\":0,\"scale\":[0.8,0.8,0.8]},{\"mesh\":0}],\"animations\":[{\"name\":\"dance\","
             "\"samplers\":[{\"input\":3,\"output\":4},{\"input\":3,\"output\":5},{\"input\":3,"
             "\"output\":6}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"rotation\"}},"
             "{\"sampler\":1,\"target\":{\"node\":2,\"path\":\"translation\"}},{\"sampler\":2,"
             "\"target\":{\"node\":2,\"path\":\"scale\"}}]},{\"samplers\":[{\"input\":3,\"output\":5,"
             "\"interpolation\":\"STEP\"}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":2,\"path\":"
             "\"translation\"}}]}]",
             "", "");
    return build(&b, rest);
}

static inline Built buildAnimated(int kind)
{
    return kind == animatedSkin ? buildSkinned() : kind == animatedMorph ? buildMorphed() : buildMoved();
}

static inline vtModel* openBuilt(Built file, vtScene* scene)
{
    const vtModelDef def = {.bytes = file.bytes, .size = file.size, .name = "x.glb"};
    vtModel* model;
    vtError error = {0};
    assert_ok(vtOpenModel(&def, &model, scene, &error), error);
    free(file.bytes); // nothing of it is needed any more
    return model;
}
