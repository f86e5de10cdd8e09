// What `vitrine bench` measures, for its reports.
#pragma once

#include "lab/metrics/metrics.h"
#include "lab/metrics/timing.h"
#include "vitrine.h"

enum { vt_benchStages = 7, vt_maxBenchRows = 12, vt_maxBenchCases = 8 };

/// Name of a stage as vtStageFcn gives it: surface peel merge refract trace shade present; index below
/// vt_benchStages. A frame has some of them.
/// `trace` is the whole path where one stage follows it.
const char* vtBenchStage(int index);

/// What differs from case to case.
typedef enum vtSweep {
    vt_sweepNone = 0,
    vt_sweepTriangles,
    vt_sweepResolution,
    vt_sweepObjects, ///< copies side by side, as large as all stay inside the picture
    vt_sweepDepth,   ///< copies one behind the other, all as large in the picture
    vt_sweepRelief,  ///< samples of a relief, by its heights and as triangles
    vt_sweepCount,
} vtSweep;

/// "triangles", ...; "" without a sweep.
const char* vtSweepName(vtSweep sweep);

/// vt_sweepNone of NULL, vt_sweepCount where there is none of that name.
vtSweep vtFindSweep(const char* name);

/// Does it go through numbers of objects?
static inline bool vtSweepsObjects(vtSweep sweep)
{
    return sweep == vt_sweepObjects || sweep == vt_sweepDepth;
}

/// One technique.
typedef struct vtBenchRow {
    vtFrame frame;   ///< strict paths, resolved
    vtFrame picture; ///< as a frame is by default, with Fresnel reflection and branches
    bool hasPicture; ///< the technique has all that belongs to it
    const char* id;
    char label[64]; ///< id and the settings that it depends on
    vtTiming time;
    vtTiming pictureTime;            ///< 0 where there is none
    vtTiming stages[vt_benchStages]; ///< medians, GL finished after each; 0 where there is none
    double build;                    ///< milliseconds, of the hierarchies; `upload` is without them
    double upload;                   ///< milliseconds, vtRenderer_SetScene
    size_t textureBytes;             ///< all that the renderer holds for it but the mesh
    size_t meshBytes, heightBytes;   ///< on the GPU; the latter are part of textureBytes
    vtDirectionError error;          ///< where the true path has at most 4 events
    double readsAPath, readsAnEvent;
    // A sweep over a relief's samples only.
    double triangulation;       ///< milliseconds
    size_t hostBytes;           ///< of the heights or the mesh, beside the GPU
    size_t glassBytes;          ///< on the GPU: heights or mesh; 0: unknown
    vtDirectionError agreement; ///< with the other technique's directions
    char absent[512];           ///< why it could not be drawn; "": it was
} vtBenchRow;

/// All techniques on one mesh at one size.
typedef struct vtBenchCase {
    int triangles;     ///< of all objects
    int meshTriangles; ///< copies counted once
    int width, height;
    int copies;  ///< of the model, 1 without a sweep over them
    int samples; ///< a side of the relief; 0 without a sweep over them
    int rounds;
    size_t paths;          ///< pixels that see glass
    double eventsAPath;    ///< of the true paths, mean
    vtTracedTiming traced; ///< the reference; 0: not traced, see untraced
    char untraced[128];    ///< why
    double flip;           ///< mean, between the pictures of a sweep over a relief's samples
    double tracerBuild;    ///< milliseconds, of the reference's search structure
    double upload;         ///< milliseconds, vtRenderer_SetScene, of the first row
    size_t meshBytes;      ///< on the GPU, of the first row
    vtBenchRow rows[vt_maxBenchRows];
} vtBenchCase;

typedef struct vtBench {
    const char* model; ///< and further objects
    vtSweep sweep;
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

/// Of the mesh on the GPU, copies counted once; 0 without triangles.
static inline double vtBytesATriangle(const vtBenchCase* measured, const vtBenchRow* row)
{
    return measured->meshTriangles > 0 ? (double)row->meshBytes / (double)measured->meshTriangles : 0.0;
}
