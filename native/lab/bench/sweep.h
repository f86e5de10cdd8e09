// The cases of a bench: one, or those of a sweep.
#pragma once

#include "cli/session.h"
#include "lab/bench/figures.h"

/// Fails with a sentence where the options do not suit the sweep.
vtResult vtBench_CheckSweep(const vtOptions* options, vtSweep sweep, vtError* error);

/// With the scene of the first case.
vtResult vtBench_OpenSession(const vtOptions* options, vtSweep sweep, vtSession* session, vtError* error);

/// Measures all cases of bench->sweep.
vtResult vtBench_RunSweep(const vtOptions* options, vtSession* session, vtBench* bench, vtError* error);
