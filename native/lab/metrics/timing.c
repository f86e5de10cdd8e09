#include "lab/metrics/timing.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "base/error.h"

double vtNow(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

double vtProcessorTime(void)
{
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

void vtShowProgress(const char* doing, float share, double start)
{
    double spent = 1e-3 * (vtNow() - start);
    if (spent < 1.0) {
        return; // short work needs no progress
    }
    char bar[41];
    for (int i = 0; i < 40; ++i) {
        bar[i] = (float)i < 40.0f * share ? '#' : '.';
    }
    bar[40] = '\0';
    fprintf(stderr, "\r%s %s %3.0f %%, %.0f s left ", doing, bar, 100.0 * (double)share,
            share > 0.0f ? spent * (1.0 / (double)share - 1.0) : 0.0);
    if (share >= 1.0f) {
        fputc('\n', stderr);
    }
}

static int compareDoubles(const void* a, const void* b)
{
    double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

double vtMedian(double* values, int count)
{
    qsort(values, (size_t)count, sizeof *values, compareDoubles);
    return values[count / 2];
}

typedef struct Samples {
    double wall[vt_maxTimingRounds], processor[vt_maxTimingRounds];
} Samples;

/// What the reference takes turns with.
enum { tracedDirections = 0, tracedStrict, tracedPicture, tracedCount };

static vtResult traceOne(const vtTimingDef* def, int kind, vtError* error)
{
    vtReferenceImage image;
    const vtReferenceDef reference = {
        .frame = &def->frames[0],
        .environment = kind == tracedDirections ? NULL : def->environment,
        .onlyPicture = kind != tracedDirections,
        .fresnel = kind == tracedPicture,
        .threads = def->threads,
    };
    const vtResult result = vtReference_Trace(def->reference, &reference, &image, error);
    vtDestroyReferenceImage(&image);
    return result;
}

/// Draws frame `index`, or traces from def->count on, as round `round`; below 0: to warm up.
static vtResult timeOne(const vtTimingDef* def, int index, int round, Samples* samples, vtError* error)
{
    const double wall = vtNow(), processor = vtProcessorTime();
    const vtResult result = index < def->count
                                ? vtRenderer_DrawImage(def->renderer, &def->frames[index], NULL, error)
                                : traceOne(def, index - def->count, error);
    samples->wall[round < 0 ? 0 : round] = vtNow() - wall;
    samples->processor[round < 0 ? 0 : round] = vtProcessorTime() - processor;
    return result;
}

static vtTiming medians(Samples* samples, int rounds)
{
    return (vtTiming){vtMedian(samples->wall, rounds), vtMedian(samples->processor, rounds)};
}

vtResult vtTimeFrames(const vtTimingDef* def, vtTiming* timings, vtTracedTiming* traced, int* rounds,
                      vtError* error)
{
    static const int warmUp = 1, leastRounds = 3;
    const int traces = def->reference == NULL ? 0 : def->environment == NULL ? 1 : tracedCount;
    const int candidates = def->count + traces;
    const int wanted = def->rounds > 0 ? def->rounds : vt_timingRounds;
    if (def->count > vt_maxTimedFrames) {
        return vtFail(error, vt_errorArgument, "timing: %d frames; at most %d", def->count,
                      vt_maxTimedFrames);
    }
    Samples* samples = malloc((size_t)candidates * sizeof *samples);
    if (samples == NULL) {
        return vtFail(error, vt_errorMemory, "timing: out of memory");
    }
    vtResult result = vt_ok;
    const double start = vtNow();
    int round = -warmUp;
    for (; round < wanted && result == vt_ok; ++round) {
        bool late = def->limit > 0.0 && vtNow() - start > 1e3 * def->limit;
        if (late && round >= leastRounds) {
            break;
        }
        for (int i = 0; i < candidates && result == vt_ok; ++i) {
            result = timeOne(def, i, round, &samples[i], error);
        }
    }
    for (int i = 0; i < def->count && result == vt_ok; ++i) {
        timings[i] = medians(&samples[i], round);
    }
    if (def->reference != NULL && result == vt_ok) {
        *traced = (vtTracedTiming){.directions = medians(&samples[def->count], round)};
    }
    if (traces == tracedCount && result == vt_ok) {
        traced->strict = medians(&samples[def->count + tracedStrict], round);
        traced->picture = medians(&samples[def->count + tracedPicture], round);
    }
    if (rounds != NULL) {
        *rounds = round;
    }
    free(samples);
    return result;
}
