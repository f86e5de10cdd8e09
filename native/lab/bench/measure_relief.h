// The same of a relief, by its heights and as triangles.
#pragma once

#include "cli/session.h"
#include "lab/bench/figures.h"

/// As vtBench_Measure: the session's scene is a relief without triangles, the rows are heightfield and exact.
/// Afterwards the scene has triangles.
vtResult vtBench_MeasureRelief(const vtOptions* options, vtSession* session, const vtBench* bench,
                               vtBenchCase* measured, vtError* error);
