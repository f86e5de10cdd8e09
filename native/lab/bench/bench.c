// Time, memory and accuracy of techniques on one scene, beside the reference of the same run. Absolute times
// say little on a machine that does other things too: the frames are drawn in turns with the reference, and
// the reports give ratios.
#include "lab/bench/bench.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/files.h"
#include "cli/trace.h"
#include "scene/objects.h"
#include "shapes/shapes.h"
#include "technique/technique.h"

const char* vtSweepName(vtSweep sweep)
{
    static const char* const names[vt_sweepCount] = {
        [vt_sweepNone] = "",           [vt_sweepTriangles] = "triangles", [vt_sweepResolution] = "resolution",
        [vt_sweepObjects] = "objects", [vt_sweepDepth] = "depth",         [vt_sweepRelief] = "relief",
    };
    return names[sweep];
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

static void labelRow(vtBenchRow* row)
{
    const vtTechnique technique = row->frame.technique;
    row->id = vtTechnique_Info(technique)->id;
    const bool cells = technique == vt_techniqueLayered && row->frame.search == vt_searchCells;
    if (vtTechnique_Row(technique)->layers == VT_LAYERS_OF_FRAME) {
        snprintf(row->label, sizeof row->label, "%s, %d layers%s", row->id, row->frame.layers,
                 cells ? ", cells" : "");
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
        const vtTechnique technique = row->frame.technique;
        row->hasPicture = technique == vt_techniqueExact || technique == vt_techniqueHeightField;
        row->frame.fresnel = true;
        row->picture = vtResolveFrame(&row->frame);
        row->frame.fresnel = false; // strict paths, as the reference's
        row->frame = vtResolveFrame(&row->frame);
        labelRow(row);
    }
    return bench->rowCount > 0
               ? vt_ok
               : vtFail(error, vt_errorArgument, "--technique names none; see 'vitrine list'");
}

static void countTriangles(const vtScene* scene, vtBenchCase* measured)
{
    measured->triangles = (int)vtCountTriangles(scene);
    measured->meshTriangles = 0;
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        measured->meshTriangles += (int)(scene->meshes[i].indexCount / 3);
    }
}

vtResult vtBench_RunCase(const vtOptions* options, vtSession* session, int copies, vtBench* bench,
                         vtError* error)
{
    vtBenchCase* measured = &bench->cases[bench->caseCount];
    vtResult result = setRows(options, session, bench, measured, error);
    if (result != vt_ok) {
        return result;
    }
    countTriangles(&session->input.scene, measured);
    measured->copies = copies;
    measured->width = options->size[0];
    measured->height = options->size[1];
    const bool isRelief = bench->sweep == vt_sweepRelief;
    char times[24] = "", size[32];
    snprintf(times, sizeof times, copies > 1 ? "%d times " : "", copies);
    snprintf(size, sizeof size, isRelief ? "%d samples a side" : "%d triangles",
             isRelief ? options->reliefSize : measured->triangles);
    fprintf(stderr, "vitrine: bench: %s%s, %s, %d x %d\n", times, bench->model, size, measured->width,
            measured->height);
    bench->ior = vtCommonIor(&session->input);
    bench->maxEvents = measured->rows[0].frame.maxEvents;
    result = (isRelief ? vtBench_MeasureRelief : vtBench_Measure)(options, session, bench, measured, error);
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
            result = vtBench_RunCase(&each, session, 1, bench, error);
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
        result = vtBench_RunCase(&each, session, 1, bench, error);
    }
    return result;
}

static vtResult sweepObjects(const vtOptions* options, vtSession* session, vtBench* bench, vtError* error)
{
    vtOptions each = *options;
    vtFrame frame;
    vtCopies copies;
    each.technique = vtTechnique_Info(vt_techniqueExact)->id; // only the view counts
    vtResult result = vtMakeFrame(&each, &session->input, &frame, error);
    if (result == vt_ok) {
        const float aspect = (float)options->size[0] / (float)options->size[1];
        result = vtCreateCopies(&session->input.scene, &frame.view, aspect, bench->sweep, &copies, error);
    }
    if (result != vt_ok) {
        return result;
    }
    each.technique = options->technique;
    each.camera = copies.view.eye;
    each.target = copies.view.target;
    each.hasCamera = each.hasTarget = true;
    for (int i = 0; vtCopies_Count(&copies, i) > 0 && result == vt_ok; ++i) {
        const int count = vtCopies_Count(&copies, i);
        result = vtCopies_Place(&copies, count, &session->input.scene, error);
        if (result == vt_ok) {
            result = vtRenderer_SetScene(session->renderer, &session->input.scene, error);
        }
        if (result == vt_ok) {
            result = vtBench_RunCase(&each, session, count, bench, error);
        }
    }
    vtDestroyCopies(&copies);
    return result;
}

static vtResult runCases(const vtOptions* options, vtSession* session, vtBench* bench, vtError* error)
{
    switch (bench->sweep) {
    case vt_sweepTriangles:
        return sweepTriangles(options, session, bench, error);
    case vt_sweepResolution:
        return sweepResolution(options, session, bench, error);
    case vt_sweepObjects:
    case vt_sweepDepth:
        return sweepObjects(options, session, bench, error);
    case vt_sweepRelief:
        return vtBench_SweepRelief(options, session, bench, error);
    default:
        return vtBench_RunCase(options, session, 1, bench, error);
    }
}

static void printTable(const void* bench, FILE* out)
{
    vtBench_WriteTable(bench, out);
}

static void printJson(const void* bench, FILE* out)
{
    vtBench_WriteJson(bench, out);
}

static void printPlot(const void* bench, FILE* out)
{
    vtBench_WritePlot(bench, out);
}

static vtResult report(const vtOptions* options, const vtBench* bench, vtError* error)
{
    vtResult result = vt_ok;
    if (options->table == NULL || options->json) {
        result = vtWritePrinted("-", options->json ? printJson : printTable, bench, error);
    }
    if (result == vt_ok && options->table != NULL) {
        result = vtWritePrinted(options->table, printTable, bench, error);
    }
    if (result == vt_ok && options->plot != NULL) {
        result = vtWritePrinted(options->plot, printPlot, bench, error);
    }
    return result;
}

static vtResult checkOptions(const vtOptions* options, vtSweep sweep, vtError* error)
{
    if (sweep == vt_sweepCount) {
        return vtFail(error, vt_errorArgument,
                      "--sweep is '%s'; it must be objects, depth, relief, triangles or resolution",
                      options->sweep);
    }
    if (options->plot != NULL && sweep == vt_sweepNone) {
        return vtFail(error, vt_errorArgument,
                      "--plot draws a sweep; add --sweep objects, depth, relief, triangles or resolution");
    }
    const bool counted = options->triangles > 0 || sweep == vt_sweepTriangles;
    if (counted && options->model == NULL && options->objectCount > 0) {
        return vtFail(error, vt_errorArgument,
                      "%s concerns the model named by itself; name knot or torus without --object",
                      options->triangles > 0 ? "--triangles" : "--sweep triangles");
    }
    if (sweep == vt_sweepTriangles && options->model != NULL && !vtHasFineShape(options->model)) {
        return vtFail(
            error, vt_errorArgument,
            "--sweep triangles needs a model of any number of triangles, knot or torus; '%s' is not",
            options->model);
    }
    return sweep == vt_sweepRelief ? vtBench_CheckRelief(options, error) : vt_ok;
}

/// vt_sweepCount where there is none of that name.
static vtSweep findSweep(const char* name)
{
    int sweep = vt_sweepNone;
    while (name != NULL && sweep < vt_sweepCount &&
           (sweep == vt_sweepNone || strcmp(name, vtSweepName((vtSweep)sweep)) != 0)) {
        ++sweep;
    }
    return (vtSweep)sweep;
}

static vtResult openSession(const vtOptions* options, vtSweep sweep, vtSession* session, vtError* error)
{
    vtOptions opened = *options;
    if (sweep == vt_sweepRelief) {
        opened.reliefSize = vtReliefSweepSize(options, 0);
        opened.technique = VT_RELIEF_TECHNIQUE;
        opened.triangulates = false;
    }
    return vtOpenSession(&opened, session, error);
}

vtResult vtRunBench(const vtOptions* given, vtError* error)
{
    vtOptions options = *given;
    const vtSweep sweep = findSweep(options.sweep);
    vtResult result = checkOptions(&options, sweep, error);
    if (result != vt_ok) {
        return result;
    }
    char threads[16];
    snprintf(threads, sizeof threads, "%d", options.threads);
    if (options.threads > 0) {
        setenv("LP_NUM_THREADS", threads, 1); // before llvmpipe starts
    }
    const bool isDefault = strcmp(options.technique, VT_BENCH_TECHNIQUES) == 0;
    if (vtSweepsObjects(sweep) && isDefault) {
        options.technique = vtTechnique_Info(vt_techniqueExact)->id; // the ones that cost most would hide it
    }
    options.innerDistances = strstr(options.technique, "wyman") != NULL;
    vtSession session;
    result = openSession(&options, sweep, &session, error);
    if (result != vt_ok) {
        return result;
    }
    const vtScene* scene = &session.input.scene;
    if (sweep == vt_sweepRelief) {
        options.triangulates = false;
        options.technique = VT_RELIEF_TECHNIQUE ",exact";
    } else if (isDefault && !vtSweepsObjects(sweep) && vtScene_HasRelief(scene)) {
        options.technique = VT_RELIEF_TECHNIQUE "," VT_BENCH_TECHNIQUES;
    }
    vtBench* bench = calloc(1, sizeof *bench);
    if (bench == NULL) {
        vtCloseSession(&session);
        return vtFail(error, vt_errorMemory, "bench: out of memory");
    }
    char models[1024];
    vtNameModels(&options, models, sizeof models);
    bench->model = models;
    bench->sweep = sweep;
    bench->preset = options.preset;
    bench->threads = options.threads;
    bench->processors = (int)sysconf(_SC_NPROCESSORS_ONLN);
    const vtRendererInfo info = vtRenderer_Info(session.renderer);
    snprintf(bench->device, sizeof bench->device, "%s", info.device);
    snprintf(bench->version, sizeof bench->version, "%s", info.version);
    result = runCases(&options, &session, bench, error);
    if (result == vt_ok) {
        result = report(&options, bench, error);
    }
    free(bench);
    vtCloseSession(&session);
    return result;
}
