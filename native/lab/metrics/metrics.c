#include "lab/metrics/metrics.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/math.h"

vtDirectionKind vtClassifyDirection(const float direction[3])
{
    vtVec3 d = vtMakeVec3(direction);
    if (d.x == 0.0f && d.y == 0.0f && d.z == 0.0f) {
        return vt_directionBackground;
    }
    return d.x == 2.0f && d.y == 2.0f && d.z == 2.0f ? vt_directionLost : vt_directionExit;
}

float vtDirectionAngle(const float direction[3], const float truth[3])
{
    if (vtClassifyDirection(direction) != vt_directionExit) {
        return 180.0f;
    }
    // atan2 keeps its precision at small angles, where acos has none.
    vtVec3 a = vtMakeVec3(direction), b = vtMakeVec3(truth);
    float angle = atan2f(vtLength(vtCross(a, b)), vtDot(a, b)) * 180.0f / VT_PI;
    return isnan(angle) ? 180.0f : angle;
}

static int compareFloats(const void* a, const void* b)
{
    float x = *(const float*)a, y = *(const float*)b;
    return (x > y) - (x < y);
}

/// `events` NULL: all pixels.
static vtResult compare(const float* directions, const float* truth, const uint8_t* events, size_t count,
                        vtEventRange range, vtDirectionError* result, vtError* error)
{
    *result = (vtDirectionError){0};
    float* angles = malloc(sizeof(float) * (count + 1));
    if (angles == NULL) {
        return vtFail(error, vt_errorMemory, "metrics: out of memory for %zu pixels", count);
    }
    double sum = 0.0;
    size_t exits = 0, within01 = 0, within1 = 0, within5 = 0, lost = 0;
    for (size_t i = 0; i < count; ++i) {
        if (events != NULL && (events[i] < range.low || events[i] > range.high)) {
            continue;
        }
        vtDirectionKind kind = vtClassifyDirection(directions + 3 * i);
        vtDirectionKind trueKind = vtClassifyDirection(truth + 3 * i);
        result->maskErrors += (kind == vt_directionBackground) != (trueKind == vt_directionBackground);
        if (trueKind != vt_directionExit) {
            continue;
        }
        float angle = vtDirectionAngle(directions + 3 * i, truth + 3 * i);
        lost += kind == vt_directionLost;
        sum += kind == vt_directionExit ? (double)angle : 90.0;
        within01 += angle <= 0.1f;
        within1 += angle <= 1.0f;
        within5 += angle <= 5.0f;
        angles[exits++] = angle;
    }
    if (exits > 0) {
        qsort(angles, exits, sizeof(float), compareFloats);
        double all = (double)exits;
        result->pixels = exits;
        result->within01 = (double)within01 / all;
        result->within1 = (double)within1 / all;
        result->within5 = (double)within5 / all;
        result->lost = (double)lost / all;
        result->mean = sum / all;
        result->median = (double)angles[exits / 2];
    }
    free(angles);
    return vtSucceed(error);
}

vtResult vtCompareDirections(const float* directions, const float* truth, size_t count,
                             vtDirectionError* result, vtError* error)
{
    return compare(directions, truth, NULL, count, (vtEventRange){0, 255}, result, error);
}

vtEventRange vtEventGroup(int index)
{
    static const vtEventRange groups[VT_EVENT_GROUPS] = {{1, 2}, {3, 4}, {5, 8}, {9, 255}};
    assert(index >= 0 && index < VT_EVENT_GROUPS);
    return groups[index];
}

vtResult vtCompareDirectionsOfEvents(const float* directions, const float* truth, const uint8_t* events,
                                     size_t count, vtEventRange range, vtDirectionError* result,
                                     vtError* error)
{
    assert(events != NULL);
    return compare(directions, truth, events, count, range, result, error);
}
