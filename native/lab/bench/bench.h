// What `vitrine bench` measures, for its reports.
#pragma once

#include <stdio.h>

#include "cli/options.h"
#include "cli/session.h"
#include "lab/bench/timing.h"
#include "lab/metrics/metrics.h"

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

/// Measures the session's scene, in which there are `copies` of the model, as the bench's next case.
vtResult vtBench_RunCase(const vtOptions* options, vtSession* session, int copies, vtBench* bench,
                         vtError* error);

/// Measures the session's scene as the case whose rows hold their frames; the reference takes its turns.
vtResult vtBench_Measure(const vtOptions* options, vtSession* session, const vtBench* bench,
                         vtBenchCase* measured, vtError* error);

/// What a renderer of its own costs that draws this technique only: memory, and time to upload and to build,
/// shaders compiled.
vtResult vtBench_Probe(vtSession* session, vtBenchRow* row, vtError* error);

/// Accuracy and times of the rows that are not absent. reference: NULL where there is none.
vtResult vtBench_Compare(const vtOptions* options, vtSession* session, const vtReference* reference,
                         const vtBench* bench, vtBenchCase* measured, vtError* error);

/// As vtBench_Measure: the session's scene is a relief without triangles, the rows are heightfield and exact.
/// Afterwards the scene has triangles.
vtResult vtBench_MeasureRelief(const vtOptions* options, vtSession* session, const vtBench* bench,
                               vtBenchCase* measured, vtError* error);

/// Fails with a sentence where the options do not suit a sweep over a relief's samples.
vtResult vtBench_CheckRelief(const vtOptions* options, vtError* error);
/// All its cases; the session's scene is the least of the sizes, without triangles.
vtResult vtBench_SweepRelief(const vtOptions* options, vtSession* session, vtBench* bench, vtError* error);

/// A relief is measured at five sizes, each twice the one before, up to the given or the largest one.
enum { vt_reliefSizes = 5, vt_leastReliefSweep = 2 << (vt_reliefSizes - 1) };
static inline int vtReliefSweepSize(const vtOptions* options, int index)
{
    const int last = options->reliefSize > 0 ? options->reliefSize : VT_MAX_RELIEF_SIDE;
    return last >> (vt_reliefSizes - 1 - index);
}

/// Fits the eye and the copies of what the session's scene has to a sweep over objects.
typedef struct vtCopies {
    vtObject* objects; ///< of one copy
    uint32_t objectCount;
    vtView view;              ///< of all cases
    vtVec3 low, high;         ///< box of one copy
    float tangentX, tangentY; ///< of half the field of view
    float growth;             ///< one behind the other: of each, about the eye, over the one before it
    vtSweep sweep;
} vtCopies;

/// `aspect`: width over height of the picture.
vtResult vtCreateCopies(const vtScene* scene, const vtView* view, float aspect, vtSweep sweep,
                        vtCopies* copies, vtError* error);
/// Copies in the sweep's case of this index; 0 past the last one.
int vtCopies_Count(const vtCopies* copies, int index);
/// Puts that many in place of the scene's objects; they share its meshes.
vtResult vtCopies_Place(const vtCopies* copies, int count, vtScene* scene, vtError* error);
void vtDestroyCopies(vtCopies* copies);

void vtBench_WriteTable(const vtBench* bench, FILE* out);
void vtBench_WriteJson(const vtBench* bench, FILE* out);
/// The part of the table, and of a row's JSON, that a sweep over a relief's samples has.
void vtBench_WriteRelief(const vtBench* bench, FILE* out);
void vtBenchRow_WriteReliefJson(const vtBenchRow* row, FILE* out);
/// A string as a member of a JSON object, a comma behind it.
void vtWriteJsonText(const char* name, const char* text, FILE* out);

/// Times over the sweep's variable, both logarithmic, SVG.
void vtBench_WritePlot(const vtBench* bench, FILE* out);
