#include "lab/bench/run_case.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "cli/trace.h"
#include "lab/bench/measure.h"
#include "lab/bench/measure_relief.h"
#include "technique/technique.h"

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
    measured->width = options->frame.width;
    measured->height = options->frame.height;
    const bool isRelief = bench->sweep == vt_sweepRelief;
    char times[24] = "", size[32];
    if (copies > 1) {
        snprintf(times, sizeof times, "%d times ", copies);
    }
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
