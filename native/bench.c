// Time, memory and accuracy of techniques on one scene, beside the reference of the same run. Absolute times
// say little on a machine that does other things too: the frames are drawn in turns with the reference, and
// the reports give ratios.
#include "bench.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "commands.h"
#include "files.h"
#include "scene/shapes.h"
#include "session.h"
#include "technique.h"
#include "trace.h"

static const double timeLimit = 40.0; // seconds a case

static const char* const stageNames[vt_benchStages] = {"surface", "peel",    "cube",
                                                       "merge",   "refract", "present"};

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

/// A clock that is read between the stages of a frame.
typedef struct StageClock {
    void (*finish)(void);
    vtTiming last;
    double build;
    vtTiming stages[vt_benchStages];
} StageClock;

static void stageDone(const char* stage, void* userData)
{
    StageClock* clock = userData;
    clock->finish();
    const vtTiming now = {vtNow(), vtProcessorTime()}, last = clock->last;
    clock->build += strcmp(stage, "bvh") == 0 || strcmp(stage, "cube") == 0 ? now.wall - last.wall : 0.0;
    for (int i = 0; i < vt_benchStages; ++i) {
        if (strcmp(stage, stageNames[i]) == 0) {
            clock->stages[i].wall += now.wall - last.wall;
            clock->stages[i].processor += now.processor - last.processor;
        }
    }
    clock->last = now;
}

static StageClock startClock(const vtSession* session)
{
    StageClock clock = {.finish = session->context.getProcAddress("glFinish")};
    clock.finish();
    clock.last = (vtTiming){vtNow(), vtProcessorTime()};
    return clock;
}

/// Draws with the clock between the stages.
static vtResult drawStages(vtSession* session, vtRenderer* renderer, const vtFrame* frame, StageClock* clock,
                           vtError* error)
{
    vtFrame timed = *frame;
    *clock = startClock(session);
    timed.stageDone = stageDone;
    timed.stageData = clock;
    return vtRenderer_DrawImage(renderer, &timed, NULL, error);
}

/// What a renderer of its own costs that draws this technique only: memory, and time to build, shaders
/// compiled.
static vtResult probe(vtSession* session, vtBenchCase* measured, vtBenchRow* row, vtError* error)
{
    vtRenderer* renderer = NULL;
    StageClock clock;
    vtResult result = vtCreateRenderer(&(vtRendererDef){session->context.getProcAddress}, &renderer, error);
    if (result == vt_ok) {
        result = vtRenderer_SetEnvironment(renderer, &session->input.environment, error);
    }
    for (int warm = 0; warm < 2 && result == vt_ok; ++warm) {
        clock = startClock(session);
        result = vtRenderer_SetMesh(renderer, &session->input.mesh, error);
        clock.finish();
        measured->upload = vtNow() - clock.last.wall;
        if (result == vt_ok) {
            result = drawStages(session, renderer, &row->frame, &clock, error);
        }
    }
    if (result == vt_ok) {
        const vtRendererInfo info = vtRenderer_Info(renderer);
        row->textureBytes = info.textureBytes;
        measured->meshBytes = info.meshBytes;
        row->build = clock.build;
    }
    vtDestroyRenderer(renderer);
    return result;
}

static vtResult timeStages(vtSession* session, vtBenchRow* row, int rounds, vtError* error)
{
    double wall[vt_benchStages][vt_maxTimingRounds], processor[vt_benchStages][vt_maxTimingRounds];
    vtResult result = vt_ok;
    for (int round = 0; round < rounds && result == vt_ok; ++round) {
        StageClock clock;
        result = drawStages(session, session->renderer, &row->frame, &clock, error);
        for (int i = 0; i < vt_benchStages; ++i) {
            wall[i][round] = clock.stages[i].wall;
            processor[i][round] = clock.stages[i].processor;
        }
    }
    for (int i = 0; i < vt_benchStages && result == vt_ok; ++i) {
        row->stages[i] = (vtTiming){vtMedian(wall[i], rounds), vtMedian(processor[i], rounds)};
    }
    return result;
}

static void countReads(const uint32_t* states, size_t count, vtBenchRow* row)
{
    double reads = 0.0, events = 0.0;
    size_t paths = 0;
    for (size_t i = 0; i < count; ++i) {
        const bool glass = (states[i] & 255u) != VT_PATH_BACKGROUND;
        paths += glass;
        events += glass ? states[i] >> 8 & 255u : 0;
        reads += states[i] >> VT_PATH_READS_SHIFT;
    }
    row->readsAPath = paths > 0 ? reads / (double)paths : 0.0;
    row->readsAnEvent = events > 0.0 ? reads / events : 0.0;
}

static vtResult checkRow(vtSession* session, const vtReferenceImage* truth, vtBenchRow* row, vtError* error)
{
    const size_t count = (size_t)truth->width * (size_t)truth->height;
    const vtEventRange few = {1, 4};
    float* directions = malloc(3 * sizeof *directions * count);
    uint32_t* states = malloc(sizeof *states * count);
    vtFrame counted = row->frame;
    counted.countReads = true;
    vtResult result = directions != NULL && states != NULL
                          ? vtRenderer_DrawImage(session->renderer, &row->frame, NULL, error)
                          : vtFail(error, vt_errorMemory, "bench: out of memory");
    if (result == vt_ok) {
        result = vtRenderer_ReadDirections(session->renderer, directions, error);
    }
    if (result == vt_ok) {
        result = vtCompareDirectionsOfEvents(directions, truth->directions, truth->events, count, few,
                                             &row->error, error);
    }
    if (result == vt_ok) {
        result = vtRenderer_DrawImage(session->renderer, &counted, NULL, error);
    }
    if (result == vt_ok) {
        result = vtRenderer_ReadStates(session->renderer, states, error);
    }
    if (result == vt_ok) {
        countReads(states, count, row);
    }
    free(directions);
    free(states);
    return result;
}

static vtResult checkRows(vtSession* session, const vtReference* reference, const vtBench* bench,
                          vtBenchCase* measured, vtError* error)
{
    vtReferenceImage truth;
    vtReferenceDef def = {.frame = &measured->rows[0].frame, .threads = bench->threads};
    vtResult result = vtReference_Trace(reference, &def, &truth, error);
    double events = 0.0;
    for (size_t i = 0; result == vt_ok && i < (size_t)truth.width * (size_t)truth.height; ++i) {
        measured->paths += truth.states[i] != VT_PATH_BACKGROUND;
        events += truth.events[i];
    }
    measured->eventsAPath = measured->paths > 0 ? events / (double)measured->paths : 0.0;
    for (int i = 0; i < bench->rowCount && result == vt_ok; ++i) {
        result = checkRow(session, &truth, &measured->rows[i], error);
    }
    vtDestroyReferenceImage(&truth);
    return result;
}

static vtResult timeRows(const vtOptions* options, vtSession* session, const vtReference* reference,
                         const vtBench* bench, vtBenchCase* measured, vtError* error)
{
    vtFrame frames[vt_maxBenchRows];
    vtTiming times[vt_maxBenchRows];
    for (int i = 0; i < bench->rowCount; ++i) {
        frames[i] = measured->rows[i].frame;
    }
    const vtTimingDef def = {session->renderer, frames,          bench->rowCount, reference,
                             bench->threads,    options->rounds, timeLimit};
    vtResult result = vtTimeFrames(&def, times, &measured->traced, &measured->rounds, error);
    for (int i = 0; i < bench->rowCount && result == vt_ok; ++i) {
        measured->rows[i].time = times[i];
        result = timeStages(session, &measured->rows[i], measured->rounds, error);
    }
    return result;
}

/// Measures the session's scene, whose rows are set.
static vtResult measure(const vtOptions* options, vtSession* session, const vtBench* bench,
                        vtBenchCase* measured, vtError* error)
{
    vtReference* reference = NULL;
    vtResult result = vt_ok;
    for (int i = 0; i < bench->rowCount && result == vt_ok; ++i) {
        result = probe(session, measured, &measured->rows[i], error);
    }
    const double start = vtNow();
    if (result == vt_ok) {
        result = vtCreateReference(&session->input.mesh, &reference, error);
    }
    measured->tracerBuild = vtNow() - start;
    if (result == vt_ok) {
        result = checkRows(session, reference, bench, measured, error);
    }
    if (result == vt_ok) {
        result = timeRows(options, session, reference, bench, measured, error);
    }
    vtDestroyReference(reference);
    return result;
}

static void labelRow(vtBenchRow* row)
{
    const vtTechniqueRow* technique = vtTechnique_Row(row->frame.technique);
    row->id = technique->info.id;
    if (technique->cube) {
        snprintf(row->label, sizeof row->label, "%s, %d layers of %d", row->id, row->frame.layers,
                 row->frame.cubeSize);
    } else if (technique->layers == VT_LAYERS_OF_FRAME) {
        snprintf(row->label, sizeof row->label, "%s, %d layers", row->id, row->frame.layers);
    } else {
        snprintf(row->label, sizeof row->label, "%s", row->id);
    }
}

/// The frames of all techniques that the options name.
static vtResult setRows(const vtOptions* options, const vtSession* session, vtBench* bench,
                        vtBenchCase* measured, vtError* error)
{
    char names[256];
    if (strlen(options->technique) >= sizeof names) {
        return vtFail(error, vt_errorArgument, "--technique names too many; at most %d", vt_maxBenchRows);
    }
    strcpy(names, options->technique);
    bench->rowCount = 0;
    char* rest = names;
    for (char* name = strtok_r(names, ",", &rest); name != NULL; name = strtok_r(NULL, ",", &rest)) {
        vtOptions one = *options;
        one.technique = name;
        one.samples = 1;
        if (vtIsReference(&one)) {
            return vtFail(error, vt_errorArgument,
                          "--technique names 'reference', which is always measured; leave it out");
        }
        if (bench->rowCount == vt_maxBenchRows) {
            return vtFail(error, vt_errorArgument, "--technique names too many; at most %d", vt_maxBenchRows);
        }
        vtBenchRow* row = &measured->rows[bench->rowCount++];
        vtResult result = vtMakeFrame(&one, &session->input, &row->frame, error);
        if (result != vt_ok) {
            return result;
        }
        row->frame = vtResolveFrame(&row->frame);
        labelRow(row);
    }
    return bench->rowCount > 0
               ? vt_ok
               : vtFail(error, vt_errorArgument, "--technique names none; see 'vitrine list'");
}

static vtResult runCase(const vtOptions* options, vtSession* session, vtBench* bench, vtError* error)
{
    vtBenchCase* measured = &bench->cases[bench->caseCount];
    vtResult result = setRows(options, session, bench, measured, error);
    if (result != vt_ok) {
        return result;
    }
    measured->triangles = (int)(session->input.mesh.indexCount / 3);
    measured->width = options->size[0];
    measured->height = options->size[1];
    fprintf(stderr, "vitrine: bench: %s, %d triangles, %d x %d\n", options->model, measured->triangles,
            measured->width, measured->height);
    bench->ior = measured->rows[0].frame.ior;
    bench->maxEvents = measured->rows[0].frame.maxEvents;
    result = measure(options, session, bench, measured, error);
    bench->caseCount += result == vt_ok;
    return result;
}

static vtResult sweepTriangles(const vtOptions* options, vtSession* session, vtBench* bench, vtError* error)
{
    static const int counts[] = {1000, 4000, 16000, 64000, 250000, 1000000};
    vtResult result = vt_ok;
    for (size_t i = 0; i < sizeof counts / sizeof counts[0] && result == vt_ok; ++i) {
        vtOptions each = *options;
        each.triangles = counts[i];
        result = vtSession_SetModel(session, &each, error);
        if (result == vt_ok) {
            result = runCase(&each, session, bench, error);
        }
    }
    return result;
}

static vtResult sweepResolution(const vtOptions* options, vtSession* session, vtBench* bench, vtError* error)
{
    vtResult result = vt_ok;
    for (int side = 256; side <= 2048 && result == vt_ok; side *= 2) {
        vtOptions each = *options;
        each.size[0] = each.size[1] = side;
        result = runCase(&each, session, bench, error);
    }
    return result;
}

typedef void WriteFcn(const vtBench* bench, FILE* out);

static vtResult writeReport(const vtBench* bench, WriteFcn* write, const char* path, vtError* error)
{
    char* text = NULL;
    size_t size = 0;
    FILE* memory = open_memstream(&text, &size);
    if (memory == NULL) {
        return vtFail(error, vt_errorMemory, "bench: out of memory");
    }
    write(bench, memory);
    fclose(memory);
    vtResult result = vtWriteFile(path, text, size, error);
    free(text);
    return result;
}

static vtResult report(const vtOptions* options, const vtBench* bench, vtError* error)
{
    vtResult result = vt_ok;
    if (options->table == NULL || options->json) {
        result = writeReport(bench, options->json ? vtBench_WriteJson : vtBench_WriteTable, "-", error);
    }
    if (result == vt_ok && options->table != NULL) {
        result = writeReport(bench, vtBench_WriteTable, options->table, error);
    }
    if (result == vt_ok && options->plot != NULL) {
        result = writeReport(bench, vtBench_WritePlot, options->plot, error);
    }
    return result;
}

static vtResult checkOptions(const vtOptions* options, vtError* error)
{
    const char* sweep = options->sweep;
    if (sweep != NULL && strcmp(sweep, "triangles") != 0 && strcmp(sweep, "resolution") != 0) {
        return vtFail(error, vt_errorArgument, "--sweep is '%s'; it must be triangles or resolution", sweep);
    }
    if (options->plot != NULL && sweep == NULL) {
        return vtFail(error, vt_errorArgument, "--plot draws a sweep; add --sweep triangles or resolution");
    }
    if (sweep != NULL && *sweep == 't' && options->model != NULL && !vtHasFineShape(options->model)) {
        return vtFail(
            error, vt_errorArgument,
            "--sweep triangles needs a model of any number of triangles, knot or torus; '%s' is not",
            options->model);
    }
    return vt_ok;
}

vtResult vtRunBench(const vtOptions* given, vtError* error)
{
    vtOptions options = *given;
    vtResult result = checkOptions(&options, error);
    if (result != vt_ok) {
        return result;
    }
    char threads[16];
    snprintf(threads, sizeof threads, "%d", options.threads);
    if (options.threads > 0) {
        setenv("LP_NUM_THREADS", threads, 1); // before llvmpipe starts
    }
    options.innerDistances = strstr(options.technique, "wyman") != NULL;
    vtSession session;
    result = vtOpenSession(&options, &session, error);
    if (result != vt_ok) {
        return result;
    }
    vtBench* bench = calloc(1, sizeof *bench);
    if (bench == NULL) {
        vtCloseSession(&session);
        return vtFail(error, vt_errorMemory, "bench: out of memory");
    }
    bench->model = options.model;
    bench->sweep = options.sweep;
    bench->preset = options.preset;
    bench->threads = options.threads;
    bench->processors = (int)sysconf(_SC_NPROCESSORS_ONLN);
    const vtRendererInfo info = vtRenderer_Info(session.renderer);
    snprintf(bench->device, sizeof bench->device, "%s", info.device);
    snprintf(bench->version, sizeof bench->version, "%s", info.version);
    result = options.sweep == NULL   ? runCase(&options, &session, bench, error)
             : *options.sweep == 't' ? sweepTriangles(&options, &session, bench, error)
                                     : sweepResolution(&options, &session, bench, error);
    if (result == vt_ok) {
        result = report(&options, bench, error);
    }
    free(bench);
    vtCloseSession(&session);
    return result;
}
