// Time, memory and accuracy of techniques on one scene, beside the reference of the same run. Absolute times
// say little on a machine that does other things too: the frames are drawn in turns with the reference, and
// the reports give ratios.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/files.h"
#include "lab/bench/report.h"
#include "lab/bench/report_json.h"
#include "lab/bench/sweep.h"
#include "scene/objects.h"
#include "technique/technique.h"

static void printTable(const void* bench, FILE* out)
{
    vtBench_WriteTable(bench, out);
}

static void printJson(const void* bench, FILE* out)
{
    vtBench_WriteJson(bench, out);
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
    return result;
}

vtResult vtRunBench(const vtOptions* given, vtError* error)
{
    vtOptions options = *given;
    const vtSweep sweep = vtFindSweep(options.sweep);
    vtResult result = vtBench_CheckSweep(&options, sweep, error);
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
    result = vtBench_OpenSession(&options, sweep, &session, error);
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
    bench->preset = vtPresetName((int)options.frame.preset);
    bench->threads = options.threads;
    bench->processors = (int)sysconf(_SC_NPROCESSORS_ONLN);
    const vtRendererInfo info = vtRenderer_Info(session.renderer);
    snprintf(bench->device, sizeof bench->device, "%s", info.device);
    snprintf(bench->version, sizeof bench->version, "%s", info.version);
    result = vtBench_RunSweep(&options, &session, bench, error);
    if (result == vt_ok) {
        result = report(&options, bench, error);
    }
    free(bench);
    vtCloseSession(&session);
    return result;
}
