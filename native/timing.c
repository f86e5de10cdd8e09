#include "timing.h"

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

static double median(double* values)
{
    qsort(values, vt_timingRounds, sizeof *values, compareDoubles);
    return values[vt_timingRounds / 2];
}

static vtResult timeReference(const vtReference* reference, const vtFrame* frame, double* milliseconds,
                              vtError* error)
{
    vtReferenceImage image;
    double start = vtNow();
    vtResult result = vtReference_Trace(reference, &(vtReferenceDef){.frame = frame}, &image, error);
    *milliseconds = vtNow() - start;
    vtDestroyReferenceImage(&image);
    return result;
}

vtResult vtTimeFrames(vtRenderer* renderer, const vtFrame* frames, int count, const vtReference* reference,
                      double* milliseconds, double* traced, vtError* error)
{
    enum { maxFrames = 64 };
    static const int warmUp = 1;
    double times[maxFrames + 1][vt_timingRounds];
    if (count > maxFrames) {
        return vtFail(error, vt_errorArgument, "timing: %d frames; at most %d", count, maxFrames);
    }
    vtResult result = vt_ok;
    for (int round = -warmUp; round < vt_timingRounds && result == vt_ok; ++round) {
        for (int i = 0; i < count && result == vt_ok; ++i) {
            double start = vtNow();
            result = vtRenderer_DrawImage(renderer, &frames[i], NULL, error);
            times[i][round < 0 ? 0 : round] = vtNow() - start;
        }
        if (reference != NULL && result == vt_ok) {
            result = timeReference(reference, &frames[0], &times[maxFrames][round < 0 ? 0 : round], error);
        }
    }
    for (int i = 0; i < count && result == vt_ok; ++i) {
        milliseconds[i] = median(times[i]);
    }
    if (reference != NULL && result == vt_ok) {
        *traced = median(times[maxFrames]);
    }
    return result;
}
