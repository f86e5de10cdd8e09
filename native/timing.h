// Time as the reports give it: medians, warm, the candidates in turns.
#pragma once

#include "reference.h"
#include "vitrine.h"

enum { vt_timingRounds = 9 };

/// A monotonic clock, milliseconds.
double vtNow(void);

/// A bar on standard error for work begun at `start` (vtNow) and done to that share, 0 to 1; nothing in its
/// first second.
void vtShowProgress(const char* doing, float share, double start);

/// Median time of each frame, GL finished, drawn in turns so that a busy machine slows all alike; one more
/// drawing of each before warms it up. Where `reference` is given, the reference tracer takes its turn with
/// the first frame's view and *traced is its median (directions only).
vtResult vtTimeFrames(vtRenderer* renderer, const vtFrame* frames, int count, const vtReference* reference,
                      double* milliseconds, double* traced, vtError* error);
