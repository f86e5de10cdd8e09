#include "lab/bench/figures.h"

#include <string.h>

const char* vtSweepName(vtSweep sweep)
{
    static const char* const names[vt_sweepCount] = {
        [vt_sweepNone] = "",           [vt_sweepTriangles] = "triangles", [vt_sweepResolution] = "resolution",
        [vt_sweepObjects] = "objects", [vt_sweepDepth] = "depth",         [vt_sweepRelief] = "relief",
    };
    return names[sweep];
}

vtSweep vtFindSweep(const char* name)
{
    int sweep = vt_sweepNone;
    while (name != NULL && sweep < vt_sweepCount &&
           (sweep == vt_sweepNone || strcmp(name, vtSweepName((vtSweep)sweep)) != 0)) {
        ++sweep;
    }
    return (vtSweep)sweep;
}

static const char* const stageNames[vt_benchStages] = {"surface", "peel",  "merge",  "refract",
                                                       "trace",   "shade", "present"};

const char* vtBenchStage(int index)
{
    return stageNames[index];
}

vtTiming vtBench_ToLayered(const vtBench* bench, const vtBenchCase* measured, int row)
{
    for (int i = 0; i < bench->rowCount; ++i) {
        if (measured->rows[i].frame.technique == vt_techniqueLayered) {
            const vtTiming *time = &measured->rows[row].time, *layered = &measured->rows[i].time;
            return (vtTiming){time->wall / layered->wall, time->processor / layered->processor};
        }
    }
    return (vtTiming){0.0, 0.0};
}
