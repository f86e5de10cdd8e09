// One case of a bench, from options to figures.
#pragma once

#include "cli/session.h"
#include "lab/bench/figures.h"

/// Measures the session's scene, in which there are `copies` of the model, as the bench's next case.
vtResult vtBench_RunCase(const vtOptions* options, vtSession* session, int copies, vtBench* bench,
                         vtError* error);
