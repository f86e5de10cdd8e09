#include "lab/bench/sweep.h"

#include <string.h>

#include "base/error.h"
#include "lab/bench/copies.h"
#include "lab/bench/run_case.h"
#include "relief/relief.h"
#include "shapes/shapes.h"
#include "technique/technique.h"

/// A relief is measured at five sizes, each twice the one before, up to the given or the largest one.
enum { reliefSizes = 5, leastReliefSweep = 2 << (reliefSizes - 1) };
static int reliefSweepSize(const vtOptions* options, int index)
{
    const int last = options->reliefSize > 0 ? options->reliefSize : VT_MAX_RELIEF_SIDE;
    return last >> (reliefSizes - 1 - index);
}

static vtResult checkRelief(const vtOptions* options, vtError* error)
{
    if (options->model != NULL && vtFindReliefPattern(options->model) < 0) {
        return vtFail(
            error, vt_errorArgument,
            "--sweep relief needs a built-in relief, which has any number of samples; '%s' is none, "
            "see 'vitrine list'",
            options->model);
    }
    if (options->objectCount > 0) {
        return vtFail(error, vt_errorArgument,
                      "--sweep relief measures the relief named by itself; leave --object out");
    }
    if (strcmp(options->technique, VT_BENCH_TECHNIQUES) != 0) {
        return vtFail(error, vt_errorArgument,
                      "--sweep relief always measures heightfield and exact; leave --technique out");
    }
    if (options->reliefSize > 0 && options->reliefSize < leastReliefSweep) {
        return vtFail(error, vt_errorArgument,
                      "--relief-size is %d; --sweep relief needs at least %d for the largest of its %d sizes",
                      options->reliefSize, leastReliefSweep, reliefSizes);
    }
    return vt_ok;
}

vtResult vtBench_CheckSweep(const vtOptions* options, vtSweep sweep, vtError* error)
{
    if (sweep == vt_sweepCount) {
        return vtFail(error, vt_errorArgument,
                      "--sweep is '%s'; it must be objects, depth, relief, triangles or resolution",
                      options->sweep);
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
    return sweep == vt_sweepRelief ? checkRelief(options, error) : vt_ok;
}

vtResult vtBench_OpenSession(const vtOptions* options, vtSweep sweep, vtSession* session, vtError* error)
{
    vtOptions opened = *options;
    if (sweep == vt_sweepRelief) {
        opened.reliefSize = reliefSweepSize(options, 0);
        opened.technique = VT_RELIEF_TECHNIQUE;
        opened.triangulates = false;
    }
    return vtOpenSession(&opened, session, error);
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
        each.frame.width = each.frame.height = side;
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
        const float aspect = (float)options->frame.width / (float)options->frame.height;
        result = vtCreateCopies(&session->input.scene, &frame.view, aspect, bench->sweep, &copies, error);
    }
    if (result != vt_ok) {
        return result;
    }
    each.technique = options->technique;
    each.frame.view.eye = copies.view.eye;
    each.frame.view.target = copies.view.target;
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

/// The session's scene is the least of the sizes, without triangles.
static vtResult sweepRelief(const vtOptions* options, vtSession* session, vtBench* bench, vtError* error)
{
    vtOptions each = *options;
    vtFrame frame;
    each.technique = VT_RELIEF_TECHNIQUE;
    vtResult result = vtMakeFrame(&each, &session->input, &frame, error);
    each.frame.view.eye = frame.view.eye; // the same of all sizes, whose boxes differ by a hair
    each.frame.view.target = frame.view.target;
    each.hasCamera = each.hasTarget = true;
    for (int i = 0; i < reliefSizes && result == vt_ok; ++i) {
        each.technique = options->technique;
        each.reliefSize = reliefSweepSize(options, i);
        vtOptions loaded = each;
        loaded.technique = VT_RELIEF_TECHNIQUE; // no triangles yet
        result = i > 0 ? vtSession_SetModel(session, &loaded, error) : vt_ok;
        if (result == vt_ok) {
            result = vtBench_RunCase(&each, session, 1, bench, error);
        }
    }
    return result;
}

vtResult vtBench_RunSweep(const vtOptions* options, vtSession* session, vtBench* bench, vtError* error)
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
        return sweepRelief(options, session, bench, error);
    default:
        return vtBench_RunCase(options, session, 1, bench, error);
    }
}
