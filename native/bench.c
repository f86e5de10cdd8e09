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
#include "technique.h"
#include "trace.h"

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
        row->frame.fresnel = false; // strict paths, as the reference's
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
    measured->triangles = (int)vtCountTriangles(&session->input.scene);
    measured->width = options->size[0];
    measured->height = options->size[1];
    fprintf(stderr, "vitrine: bench: %s, %d triangles, %d x %d\n", bench->model, measured->triangles,
            measured->width, measured->height);
    bench->ior = vtCommonIor(&session->input);
    bench->maxEvents = measured->rows[0].frame.maxEvents;
    result = vtBench_Measure(options, session, bench, measured, error);
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
    const bool counted = options->triangles > 0 || (sweep != NULL && *sweep == 't');
    if (counted && options->model == NULL && options->objectCount > 0) {
        return vtFail(error, vt_errorArgument,
                      "%s concerns the model named by itself; name knot or torus without --object",
                      options->triangles > 0 ? "--triangles" : "--sweep triangles");
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
    char models[1024];
    vtNameModels(&options, models, sizeof models);
    bench->model = models;
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
