// What is measured of one case.
#pragma once

#include "cli/session.h"
#include "lab/bench/figures.h"

/// Measures the session's scene as the case whose rows hold their frames; the reference takes its turns.
vtResult vtBench_Measure(const vtOptions* options, vtSession* session, const vtBench* bench,
                         vtBenchCase* measured, vtError* error);

/// What a renderer of its own costs that draws this technique only: memory, and time to upload and to build,
/// shaders compiled.
vtResult vtBench_Probe(vtSession* session, vtBenchRow* row, vtError* error);

/// Accuracy and times of the rows that are not absent. reference: NULL where there is none.
vtResult vtBench_Compare(const vtOptions* options, vtSession* session, const vtReference* reference,
                         const vtBench* bench, vtBenchCase* measured, vtError* error);
