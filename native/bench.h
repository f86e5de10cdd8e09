// What `vitrine bench` measures, for its reports.
#pragma once

#include <stdio.h>

#include "metrics.h"
#include "options.h"
#include "session.h"
#include "timing.h"

enum { vt_benchStages = 6, vt_maxBenchRows = 12, vt_maxBenchCases = 8 };

/// Name of a stage as vtStageFcn gives it: surface peel cube merge refract present; index below
/// vt_benchStages.
const char* vtBenchStage(int index);

/// One technique.
typedef struct vtBenchRow {
    vtFrame frame; ///< resolved
    const char* id;
    char label[64]; ///< id and the settings that it depends on
    vtTiming time;
    vtTiming stages[vt_benchStages]; ///< medians, GL finished after each; 0 where there is none
    double build;                    ///< milliseconds, once a mesh, shaders compiled: cube or hierarchy
    size_t textureBytes;             ///< all that the renderer holds for it but the mesh
    vtDirectionError error;          ///< where the true path has at most 4 events
    double readsAPath, readsAnEvent;
} vtBenchRow;

/// All techniques on one mesh at one size.
typedef struct vtBenchCase {
    int triangles, width, height;
    int rounds;
    size_t paths;       ///< pixels that see glass
    double eventsAPath; ///< of the true paths, mean
    vtTiming traced;    ///< the reference, directions only
    double tracerBuild; ///< milliseconds, of the reference's search structure
    double upload;      ///< milliseconds, vtRenderer_SetScene
    size_t meshBytes;   ///< on the GPU
    vtBenchRow rows[vt_maxBenchRows];
} vtBenchCase;

typedef struct vtBench {
    const char* model; ///< and further objects
    const char* sweep; ///< "triangles", "resolution" or NULL
    const char* preset;
    float ior; ///< of all glass; 0 where objects differ
    int maxEvents;
    int threads; ///< 0: as many as there are processors
    char device[128], version[128];
    int processors;
    int rowCount;  ///< of each case
    int caseCount; ///< 1 unless a sweep
    vtBenchCase cases[vt_maxBenchCases];
} vtBench;

/// Times of the row over those of the technique `layered` in the same case; 0 where that is not measured.
vtTiming vtBench_ToLayered(const vtBench* bench, const vtBenchCase* measured, int row);

/// Measures the session's scene as the case whose rows hold their frames; the reference takes its turns.
vtResult vtBench_Measure(const vtOptions* options, vtSession* session, const vtBench* bench,
                         vtBenchCase* measured, vtError* error);

void vtBench_WriteTable(const vtBench* bench, FILE* out);
void vtBench_WriteJson(const vtBench* bench, FILE* out);

/// Times over the sweep's variable, both logarithmic, SVG.
void vtBench_WritePlot(const vtBench* bench, FILE* out);
