// Its part of a sweep over a relief's samples: each technique's time and memory, and how far they agree.
#pragma once

#include <stdio.h>

#include "lab/bench/figures.h"

void vtBench_WriteRelief(const vtBench* bench, FILE* out);

/// "1.53 | " of times that are both there.
static inline void vtWriteRatio(double time, double other, FILE* out)
{
    fprintf(out, time > 0.0 && other > 0.0 ? "%.2f | " : "- | ", time / other);
}
