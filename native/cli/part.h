// One machine's part of a series of pictures.
#pragma once

#include "cli/options.h"

typedef struct vtPart {
    int number; ///< from 1 on
    int count;
} vtPart;

/// By --part, else by what a scheduler says in the environment, which is told on standard error: a job array
/// of Slurm (SLURM_ARRAY_TASK_ID, _COUNT, _MIN, _STEP). `auto/N` takes the number from there, from the
/// Indexed Job of Kubernetes (JOB_COMPLETION_INDEX) or from GNU parallel (PARALLEL_SEQ). 1 of 1 without any.
vtResult vtFindPart(const vtOptions* options, vtPart* part, vtError* error);
