// Threads that work on one job.
#pragma once

#include <pthread.h>

#include "lab/reference/reference.h"

/// Threads beside the caller's.
typedef struct vtThreads {
    pthread_t started[VT_MAX_THREADS];
    int count;
} vtThreads;

/// Starts as many that work on a job as make `number` with the caller's, or one a processor where it is 0;
/// those that cannot be had are done without.
void vtStartThreads(vtThreads* threads, int number, void* (*work)(void*), void* job);
void vtJoinThreads(vtThreads* threads);
