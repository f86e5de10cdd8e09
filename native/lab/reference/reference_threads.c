#include "lab/reference/reference_threads.h"

#include <unistd.h>

#include "base/math.h"

void vtStartThreads(vtThreads* threads, int number, void* (*work)(void*), void* job)
{
    const long processors = number > 0 ? number : sysconf(_SC_NPROCESSORS_ONLN);
    const int wanted = (int)vtClamp((float)processors, 1.0f, (float)VT_MAX_THREADS);
    threads->count = 0;
    // A thread that cannot be had is done without: the others take its part.
    while (threads->count < wanted - 1 &&
           pthread_create(&threads->started[threads->count], NULL, work, job) == 0) {
        ++threads->count;
    }
}

void vtJoinThreads(vtThreads* threads)
{
    while (threads->count > 0) {
        pthread_join(threads->started[--threads->count], NULL);
    }
}
