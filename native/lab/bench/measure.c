#include "lab/bench/measure.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "mesh/hierarchy.h"

static const double timeLimit = 90.0; // seconds a case

/// A clock that is read between the stages of a frame.
typedef struct StageClock {
    void (*finish)(void);
    vtTiming last;
    vtTiming stages[vt_benchStages];
} StageClock;

static void stageDone(const char* stage, void* userData)
{
    StageClock* clock = userData;
    clock->finish();
    const vtTiming now = {vtNow(), vtProcessorTime()}, last = clock->last;
    for (int i = 0; i < vt_benchStages; ++i) {
        if (strcmp(stage, vtBenchStage(i)) == 0) {
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

/// Builds the scene's hierarchies, those that it has being dropped first; milliseconds.
static vtResult timeBuild(vtScene* scene, double* build, vtError* error)
{
    bool any = false;
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        any = any || scene->meshes[i].indexCount > 0;
        if (scene->meshes[i].hierarchy != NULL) {
            vtDestroyHierarchy(scene->meshes[i].hierarchy);
            vtFree(scene->meshes[i].hierarchy);
            scene->meshes[i].hierarchy = NULL;
        }
    }
    const double start = vtNow();
    vtPreparation* preparation = vtBeginPreparation(scene);
    if (preparation == NULL) {
        return vtFail(error, vt_errorMemory, "bench: out of memory");
    }
    while (!vtPreparation_Step(preparation, UINT32_MAX)) {
    }
    const vtResult result = vtEndPreparation(preparation, error);
    *build = any ? vtNow() - start : 0.0;
    return result;
}

vtResult vtBench_Probe(vtSession* session, vtBenchRow* row, vtError* error)
{
    vtRenderer* renderer = NULL;
    StageClock clock;
    vtResult result = vtCreateRenderer(&(vtRendererDef){.getProcAddress = session->context.getProcAddress},
                                       &renderer, error);
    if (result == vt_ok) {
        result = vtRenderer_SetEnvironment(renderer, &session->input.environment, error);
    }
    for (int warm = 0; warm < 2 && result == vt_ok; ++warm) {
        result = timeBuild(&session->input.scene, &row->build, error);
        if (result != vt_ok) {
            break;
        }
        clock = startClock(session);
        result = vtRenderer_SetScene(renderer, &session->input.scene, error);
        clock.finish();
        row->upload = vtNow() - clock.last.wall;
        if (result == vt_ok) {
            result = drawStages(session, renderer, &row->frame, &clock, error);
        }
    }
    if (result == vt_ok) {
        const vtRendererInfo info = vtRenderer_Info(renderer);
        row->textureBytes = info.textureBytes;
        row->meshBytes = info.meshBytes;
        row->heightBytes = info.heightBytes;
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
        events += glass ? states[i] >> 8 & 127u : 0;
        reads += states[i] >> VT_PATH_READS_SHIFT;
    }
    row->readsAPath = paths > 0 ? reads / (double)paths : 0.0;
    row->readsAnEvent = events > 0.0 ? reads / events : 0.0;
}

/// `truth`: without pixels where nothing was traced.
static vtResult checkRow(vtSession* session, const vtReferenceImage* truth, vtBenchRow* row, vtError* error)
{
    const size_t count = (size_t)row->frame.width * (size_t)row->frame.height;
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
    if (result == vt_ok && truth->directions != NULL) {
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
    vtReferenceImage truth = {0};
    vtReferenceDef def = {.frame = &measured->rows[0].frame, .threads = bench->threads};
    vtResult result = reference != NULL ? vtReference_Trace(reference, &def, &truth, error) : vt_ok;
    double events = 0.0;
    for (size_t i = 0; result == vt_ok && i < (size_t)truth.width * (size_t)truth.height; ++i) {
        measured->paths += truth.states[i] != VT_PATH_BACKGROUND;
        events += truth.events[i];
    }
    measured->eventsAPath = measured->paths > 0 ? events / (double)measured->paths : 0.0;
    for (int i = 0; i < bench->rowCount && result == vt_ok; ++i) {
        const bool absent = measured->rows[i].absent[0] != '\0';
        result = absent ? vt_ok : checkRow(session, &truth, &measured->rows[i], error);
    }
    vtDestroyReferenceImage(&truth);
    return result;
}

static vtResult timeRows(const vtOptions* options, vtSession* session, const vtReference* reference,
                         const vtBench* bench, vtBenchCase* measured, vtError* error)
{
    vtFrame frames[2 * vt_maxBenchRows];
    vtTiming times[2 * vt_maxBenchRows], *places[2 * vt_maxBenchRows];
    int count = 0;
    for (int i = 0; i < bench->rowCount; ++i) {
        vtBenchRow* row = &measured->rows[i];
        for (int k = 0; k < 2 && row->absent[0] == '\0'; ++k) {
            if (k == 0 || row->hasPicture) {
                places[count] = k == 0 ? &row->time : &row->pictureTime;
                frames[count++] = k == 0 ? row->frame : row->picture;
            }
        }
    }
    const vtTimingDef def = {
        .renderer = session->renderer,
        .frames = frames,
        .count = count,
        .reference = reference,
        .environment = &session->input.environment,
        .threads = bench->threads,
        .rounds = options->rounds,
        .limit = timeLimit,
    };
    vtResult result = vtTimeFrames(&def, times, &measured->traced, &measured->rounds, error);
    for (int i = 0; i < count && result == vt_ok; ++i) {
        *places[i] = times[i];
    }
    for (int i = 0; i < bench->rowCount && result == vt_ok; ++i) {
        const bool absent = measured->rows[i].absent[0] != '\0';
        result = absent ? vt_ok : timeStages(session, &measured->rows[i], measured->rounds, error);
    }
    return result;
}

vtResult vtBench_Compare(const vtOptions* options, vtSession* session, const vtReference* reference,
                         const vtBench* bench, vtBenchCase* measured, vtError* error)
{
    const vtResult result = checkRows(session, reference, bench, measured, error);
    return result == vt_ok ? timeRows(options, session, reference, bench, measured, error) : result;
}

vtResult vtBench_Measure(const vtOptions* options, vtSession* session, const vtBench* bench,
                         vtBenchCase* measured, vtError* error)
{
    vtReference* reference = NULL;
    vtResult result = vt_ok;
    for (int i = 0; i < bench->rowCount && result == vt_ok; ++i) {
        result = vtBench_Probe(session, &measured->rows[i], error);
    }
    measured->upload = measured->rows[0].upload;
    measured->meshBytes = measured->rows[0].meshBytes;
    const double start = vtNow();
    if (result == vt_ok) {
        result = vtCreateReference(&session->input.scene, &reference, error);
    }
    measured->tracerBuild = vtNow() - start;
    if (result == vt_ok) {
        result = vtBench_Compare(options, session, reference, bench, measured, error);
    }
    vtDestroyReference(reference);
    return result;
}
