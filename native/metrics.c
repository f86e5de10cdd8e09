#include "metrics.h"

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/math.h"

static bool isBackground(vtVec3 d)
{
    return d.x == 0.0f && d.y == 0.0f && d.z == 0.0f;
}

static bool isLost(vtVec3 d)
{
    return d.x == 2.0f && d.y == 2.0f && d.z == 2.0f;
}

/// Degrees between two unit vectors; atan2 keeps its precision at small angles, where acos has none.
static float angleBetween(vtVec3 a, vtVec3 b)
{
    return atan2f(vtLength(vtCross(a, b)), vtDot(a, b)) * 180.0f / VT_PI;
}

static int compareFloats(const void* a, const void* b)
{
    float x = *(const float*)a, y = *(const float*)b;
    return (x > y) - (x < y);
}

vtResult vtCompareDirections(const float* directions, const float* truth, size_t count,
                             vtDirectionError* result, vtError* error)
{
    *result = (vtDirectionError){0};
    float* angles = malloc(sizeof(float) * (count + 1));
    if (angles == NULL) {
        return vtFail(error, vt_errorMemory, "metrics: out of memory for %zu pixels", count);
    }
    size_t exits = 0, within1 = 0, within5 = 0, lost = 0;
    for (size_t i = 0; i < count; ++i) {
        vtVec3 d = vtMakeVec3(directions + 3 * i), t = vtMakeVec3(truth + 3 * i);
        result->maskErrors += isBackground(d) != isBackground(t);
        if (isBackground(t) || isLost(t)) {
            continue;
        }
        bool answered = !isBackground(d) && !isLost(d);
        float angle = answered ? angleBetween(d, t) : 180.0f;
        lost += isLost(d);
        within1 += angle <= 1.0f;
        within5 += angle <= 5.0f;
        angles[exits++] = angle;
    }
    if (exits > 0) {
        qsort(angles, exits, sizeof(float), compareFloats);
        double all = (double)exits;
        result->pixels = exits;
        result->within1 = (double)within1 / all;
        result->within5 = (double)within5 / all;
        result->lost = (double)lost / all;
        result->median = (double)angles[exits / 2];
    }
    free(angles);
    return vtSucceed(error);
}
