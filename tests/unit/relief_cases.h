// Reliefs, rays at them, and a judge of what a ray meets, for several tests.
#pragma once

#include <math.h>

#include "base/math.h"
#include "mesh/mesh_triangle.h"
#include "testing.h"

typedef enum vtReliefKind { vt_reliefFlat, vt_reliefRamp, vt_reliefHills, vt_reliefNoise } vtReliefKind;

typedef struct vtReliefCase {
    const char* name;
    vtReliefKind kind;
    int width, height;
    float depth;
} vtReliefCase;

/// A number from 0 to 1, the same ones on every machine.
static inline float randomNumber(uint32_t* seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (float)(*seed >> 8) / 16777216.0f;
}

static inline float randomBetween(uint32_t* seed, float low, float high)
{
    return low + (high - low) * randomNumber(seed);
}

static inline vtMesh createRelief(const vtReliefCase* relief)
{
    const size_t width = (size_t)relief->width, height = (size_t)relief->height;
    float* heights = malloc(width * height * sizeof *heights);
    assert_non_null(heights);
    uint32_t seed = 7;
    for (size_t i = 0; i < width * height; ++i) {
        const float x = (float)(i % width) / (float)(width - 1), y = (float)(i / width) / (float)(height - 1);
        heights[i] = relief->kind == vt_reliefFlat   ? 0.5f
                     : relief->kind == vt_reliefRamp ? x + 0.25f * y
                     : relief->kind == vt_reliefHills
                         ? 0.5f + 0.3f * sinf(19.0f * x + 2.0f) * cosf(17.0f * y) + 0.2f * x * y
                         : randomNumber(&seed);
    }
    const vtReliefDef def = {.heights = heights,
                             .width = relief->width,
                             .height = relief->height,
                             .depth = relief->depth,
                             .thickness = 0.2f};
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateRelief(&def, relief->name, &mesh, &error), error);
    free(heights);
    return mesh;
}

typedef struct vtTestRay {
    vtVec3 origin, direction;
} vtTestRay;

static inline vtVec3 randomDirection(uint32_t* seed)
{
    const float z = randomBetween(seed, -1.0f, 1.0f), angle = randomBetween(seed, 0.0f, 2.0f * VT_PI);
    const float across = sqrtf(1.0f - z * z);
    return (vtVec3){across * cosf(angle), across * sinf(angle), z};
}

static inline vtVec3 randomPoint(const vtMesh* mesh, uint32_t* seed)
{
    return (vtVec3){randomBetween(seed, mesh->boundsMin.x, mesh->boundsMax.x),
                    randomBetween(seed, mesh->boundsMin.y, mesh->boundsMax.y),
                    randomBetween(seed, mesh->boundsMin.z, mesh->boundsMax.z)};
}

enum {
    vt_rayAround,
    vt_rayInside,
    vt_rayGrazing,
    vt_rayAlongAxis,
    vt_rayThroughVertex,
    vt_rayThroughEdge,
    vt_rayKinds
};

/// Of the kinds from vt_rayAlongAxis on many meet edges exactly, where a hit is a matter of rounding.
static inline vtTestRay randomRay(const vtMesh* mesh, int kind, uint32_t* seed)
{
    const vtHeightField* field = mesh->heights;
    const vtVec3 far = vtScale(randomDirection(seed), 3.0f);
    vtTestRay ray = {far, randomDirection(seed)};
    vtVec3 target = randomPoint(mesh, seed);
    const int column = (int)(randomNumber(seed) * (float)(field->width - 1));
    const int row = (int)(randomNumber(seed) * (float)(field->height - 1));
    if (kind == vt_rayInside) {
        ray.origin = target;
        return ray;
    }
    if (kind == vt_rayGrazing) {
        target.z = randomBetween(seed, field->low, field->high);
        ray.origin.z = target.z + 0.05f * far.z;
    } else if (kind == vt_rayAlongAxis) {
        const int axis = (int)(randomNumber(seed) * 3.0f);
        target = (column & 1) != 0 ? vtHeightField_Corner(field, column, row) : target;
        const float side = (row & 1) != 0 ? 3.0f : -3.0f;
        const vtVec3 away = {axis == 0 ? side : 0.0f, axis == 1 ? side : 0.0f, axis == 2 ? side : 0.0f};
        return (vtTestRay){
            {axis == 0 ? side : target.x, axis == 1 ? side : target.y, axis == 2 ? side : target.z},
            vtScale(away, -1.0f)};
    } else if (kind == vt_rayThroughVertex) {
        target = vtHeightField_Corner(field, column, row);
    } else if (kind == vt_rayThroughEdge) {
        const int along = (int)(randomNumber(seed) * 3.0f);
        const vtVec3 a = vtHeightField_Corner(field, column, row);
        const vtVec3 b = vtHeightField_Corner(field, column + (along != 1), row + (along != 0));
        target = vtMulAdd(a, randomNumber(seed), vtSub(b, a));
    }
    ray.direction = vtNormalize(vtSub(target, ray.origin));
    return ray;
}

// -------------------------------------------------------------------------------------------------- judge

/// What rounding may move a ray by, or a surface: a few units in the last place of coordinates up to 3.
static const double roundingDistance = 4e-6;

/// How a ray passes a triangle, in double precision.
typedef struct vtPassing {
    double distance; ///< where it meets the plane
    double cosine;   ///< to the plane's normal
    double depth;    ///< least distance to an edge, as the ray passes it; negative: it passes beside
} vtPassing;

static inline void crossDouble(const double* a, const double* b, double* c)
{
    for (int i = 0; i < 3; ++i) {
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

static inline double dotDouble(const double* a, const double* b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline vtPassing passTriangle(const vtVec3 corners[3], const vtTestRay* ray)
{
    const double d[3] = {(double)ray->direction.x, (double)ray->direction.y, (double)ray->direction.z};
    double p[3][3], e[3][3], volumes[3], reaches[3], normal[3], side[3];
    for (int i = 0; i < 3; ++i) {
        p[i][0] = (double)corners[i].x - (double)ray->origin.x;
        p[i][1] = (double)corners[i].y - (double)ray->origin.y;
        p[i][2] = (double)corners[i].z - (double)ray->origin.z;
    }
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            e[i][k] = p[(i + 1) % 3][k] - p[i][k];
        }
        crossDouble(p[i], p[(i + 1) % 3], side);
        volumes[i] = dotDouble(d, side);
        crossDouble(d, e[i], side);
        reaches[i] = sqrt(dotDouble(side, side));
    }
    crossDouble(e[0], e[1], normal);
    const double towards = dotDouble(normal, d), turn = towards < 0.0 ? -1.0 : 1.0;
    vtPassing passing = {dotDouble(p[0], normal) / towards,
                         fabs(towards) / sqrt(dotDouble(normal, normal) * dotDouble(d, d)), INFINITY};
    for (int i = 0; i < 3; ++i) {
        passing.depth = fmin(passing.depth, turn * volumes[i] / fmax(reaches[i], 1e-300));
    }
    return passing;
}

/// Whether a hit at `distance`, or none (INFINITY), is right but for rounding: there is a surface that the
/// ray meets or passes close by, and none before that it meets well within a triangle.
static inline bool isRight(const vtMesh* mesh, const vtTestRay* ray, float near, float distance)
{
    const double length = sqrt((double)vtDot(ray->direction, ray->direction));
    bool meets = isinf(distance);
    for (uint32_t i = 0; i < mesh->indexCount / 3; ++i) {
        vtVec3 corners[3];
        vtMesh_Corners(mesh, i, corners);
        const float reach = vtLength(vtSub(corners[1], corners[0])) + vtLength(vtSub(corners[2], corners[0]));
        const vtVec3 aside = vtCross(vtSub(corners[0], ray->origin), ray->direction);
        if (vtLength(aside) > (float)length * (reach + 1e-4f)) {
            continue; // far off: most of them, sooner said
        }
        const vtPassing at = passTriangle(corners, ray);
        const double before = ((double)distance - at.distance) * at.cosine * length;
        meets = meets || (at.depth > -roundingDistance && fabs(before) < roundingDistance);
        const double beyond = (at.distance - (double)near) * at.cosine * length;
        if (at.depth > roundingDistance && beyond > roundingDistance && before > roundingDistance) {
            return false;
        }
    }
    return meets;
}
