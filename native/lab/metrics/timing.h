// Time as the reports give it: medians, warm, the candidates in turns.
#pragma once

#include "lab/reference/reference.h"
#include "vitrine.h"

enum { vt_timingRounds = 9, vt_maxTimingRounds = 99, vt_maxTimedFrames = 64 };

/// A monotonic clock, milliseconds.
double vtNow(void);

/// Milliseconds that the processors have spent on this program, all threads together. A busy machine disturbs
/// it less than the clock.
double vtProcessorTime(void);

/// Milliseconds, medians.
typedef struct vtTiming {
    double wall, processor;
} vtTiming;

/// The median of up to vt_maxTimingRounds values, which are sorted.
double vtMedian(double* values, int count);

/// A bar on standard error for work begun at `start` (vtNow) and done to that share, 0 to 1; nothing in its
/// first second.
void vtShowProgress(const char* doing, float share, double start);

typedef struct vtTimingDef {
    vtRenderer* renderer;
    const vtFrame* frames;
    int count;                    ///< of frames, 1 to vt_maxTimedFrames
    const vtReference* reference; ///< takes its turns with the first frame's view; NULL: it does not
    /// Of the reference's pictures; NULL: it traces directions only.
    const vtEnvironment* environment;
    int threads;  ///< of the reference; 0: as many as there are processors
    int rounds;   ///< 1 to vt_maxTimingRounds; 0: vt_timingRounds
    double limit; ///< seconds after which three rounds are enough; 0: none
} vtTimingDef;

/// What the reference does for the frame.
typedef struct vtTracedTiming {
    vtTiming directions; ///< strict paths
    vtTiming strict;     ///< the picture of strict paths, one sample; 0 without an environment
    vtTiming picture;    ///< the same with Fresnel reflection and all that branches off; 0 without one
} vtTracedTiming;

/// Median time of each frame, GL finished, drawn in turns so that a busy machine slows all alike; one more
/// drawing of each before warms it up. Where there is a reference, *traced has its medians. *rounds, where
/// not NULL: how many there were.
vtResult vtTimeFrames(const vtTimingDef* def, vtTiming* timings, vtTracedTiming* traced, int* rounds,
                      vtError* error);
