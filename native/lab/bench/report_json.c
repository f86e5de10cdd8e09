#include "lab/bench/report_json.h"

#include "cli/json.h"
#include "technique/technique.h"

/// Members of the object that is open.
static void writeTiming(vtJson* json, const vtTiming* time)
{
    vtJson_Number(json, "wall", time->wall, 4);
    vtJson_Number(json, "cpu", time->processor, 4);
}

static void writeTimingOf(vtJson* json, const char* name, const vtTiming* time)
{
    vtJson_BeginObject(json, name);
    writeTiming(json, time);
    vtJson_EndObject(json);
}

/// To what was measured; else nothing.
static void writeRatios(vtJson* json, const char* wallName, const char* processorName, const vtTiming* time,
                        const vtTiming* other)
{
    if (other->wall > 0.0) {
        vtJson_Number(json, wallName, time->wall / other->wall, 5);
        vtJson_Number(json, processorName, time->processor / other->processor, 5);
    }
}

/// The default picture of a technique that has all of it.
static void writePicture(vtJson* json, const vtBenchCase* measured, const vtBenchRow* row)
{
    if (row->pictureTime.wall > 0.0) {
        vtJson_BeginObject(json, "picture");
        writeRatios(json, "wallToReference", "cpuToReference", &row->pictureTime, &measured->traced.picture);
        vtJson_Integer(json, "branches", vtFrame_BranchCount(&row->picture));
        writeTiming(json, &row->pictureTime);
        vtJson_EndObject(json);
    }
}

static void writeStages(vtJson* json, const vtBenchRow* row)
{
    vtJson_BeginObject(json, "stages");
    for (int i = 0; i < vt_benchStages; ++i) {
        if (row->stages[i].wall > 0.0) {
            writeTimingOf(json, vtBenchStage(i), &row->stages[i]);
        }
    }
    vtJson_EndObject(json);
}

static void writeReference(vtJson* json, const vtBenchCase* measured)
{
    const vtTracedTiming* traced = &measured->traced;
    vtJson_BeginObject(json, "reference");
    writeTiming(json, &traced->directions);
    vtJson_Number(json, "build", measured->tracerBuild, 3);
    writeTimingOf(json, "strictPicture", &traced->strict);
    writeTimingOf(json, "picture", &traced->picture);
    vtJson_EndObject(json);
}

/// What a sweep over a relief's samples has.
static void writeRelief(vtJson* json, const vtBenchRow* row)
{
    vtJson_Text(json, "absent", row->absent);
    vtJson_Number(json, "triangulation", row->triangulation, 3);
    vtJson_Integer(json, "hostBytes", (long long)row->hostBytes);
    vtJson_Integer(json, "glassBytes", (long long)row->glassBytes);
    vtJson_BeginObject(json, "agreement");
    vtJson_Integer(json, "pixels", (long long)row->agreement.pixels);
    vtJson_Number(json, "within01", row->agreement.within01, 6);
    vtJson_Number(json, "within1", row->agreement.within1, 6);
    vtJson_Number(json, "lost", row->agreement.lost, 6);
    vtJson_EndObject(json);
}

static void writeRow(vtJson* json, const vtBench* bench, const vtBenchCase* measured, int index)
{
    const vtBenchRow* row = &measured->rows[index];
    const vtTracedTiming* traced = &measured->traced;
    const vtTiming toLayered = vtBench_ToLayered(bench, measured, index);
    vtJson_BeginObject(json, NULL);
    vtJson_Text(json, "id", row->id);
    vtJson_Text(json, "label", row->label);
    if (bench->sweep == vt_sweepRelief) {
        writeRelief(json, row);
    }
    writeTiming(json, &row->time);
    writeRatios(json, "wallToReference", "cpuToReference", &row->time, &traced->directions);
    writeRatios(json, "wallToReferencePicture", "cpuToReferencePicture", &row->time, &traced->strict);
    writePicture(json, measured, row);
    if (toLayered.wall > 0.0) {
        vtJson_Number(json, "wallToLayered", toLayered.wall, 5);
        vtJson_Number(json, "cpuToLayered", toLayered.processor, 5);
    }
    vtJson_Integer(json, "pixels", (long long)row->error.pixels);
    vtJson_Number(json, "within1", row->error.within1, 6);
    vtJson_Number(json, "within5", row->error.within5, 6);
    vtJson_Number(json, "lost", row->error.lost, 6);
    vtJson_Number(json, "readsAPath", row->readsAPath, 3);
    vtJson_Number(json, "readsAnEvent", row->readsAnEvent, 3);
    vtJson_Integer(json, "textureBytes", (long long)row->textureBytes);
    vtJson_Integer(json, "meshBytes", (long long)row->meshBytes);
    vtJson_Number(json, "bytesATriangle", vtBytesATriangle(measured, row), 3);
    vtJson_Number(json, "upload", row->upload, 3);
    vtJson_Number(json, "build", row->build, 3);
    writeStages(json, row);
    vtJson_EndObject(json);
}

static void writePoint(vtJson* json, const char* name, vtVec3 point)
{
    vtJson_BeginArray(json, name);
    vtJson_Float(json, NULL, point.x);
    vtJson_Float(json, NULL, point.y);
    vtJson_Float(json, NULL, point.z);
    vtJson_EndArray(json);
}

static void writeCase(vtJson* json, const vtBench* bench, const vtBenchCase* measured)
{
    const vtView* view = &measured->rows[0].frame.view;
    vtJson_BeginObject(json, NULL);
    vtJson_Integer(json, "objects", measured->copies);
    vtJson_Integer(json, "triangles", measured->triangles);
    vtJson_Integer(json, "width", measured->width);
    vtJson_Integer(json, "height", measured->height);
    writePoint(json, "camera", view->eye);
    writePoint(json, "target", view->target);
    vtJson_Integer(json, "rounds", measured->rounds);
    vtJson_Integer(json, "paths", (long long)measured->paths);
    if (bench->sweep == vt_sweepRelief) {
        vtJson_Text(json, "untraced", measured->untraced);
        vtJson_Integer(json, "samples", measured->samples);
        vtJson_Number(json, "flip", measured->flip, 7);
    }
    vtJson_Number(json, "eventsAPath", measured->eventsAPath, 4);
    vtJson_Number(json, "upload", measured->upload, 3);
    vtJson_Integer(json, "meshBytes", (long long)measured->meshBytes);
    writeReference(json, measured);
    vtJson_BeginArray(json, "techniques");
    for (int row = 0; row < bench->rowCount; ++row) {
        writeRow(json, bench, measured, row);
    }
    vtJson_EndArray(json);
    vtJson_EndObject(json);
}

void vtBench_WriteJson(const vtBench* bench, FILE* out)
{
    vtJson json = {.out = out};
    vtJson_BeginObject(&json, NULL);
    vtJson_Text(&json, "version", VT_VERSION);
    vtJson_Text(&json, "model", bench->model);
    vtJson_Text(&json, "sweep", vtSweepName(bench->sweep));
    vtJson_Text(&json, "preset", bench->preset);
    vtJson_Text(&json, "device", bench->device);
    vtJson_Text(&json, "gl", bench->version);
    vtJson_Integer(&json, "threads", bench->threads);
    vtJson_Integer(&json, "processors", bench->processors);
    vtJson_Number(&json, "ior", (double)bench->ior, 5);
    vtJson_Integer(&json, "maxEvents", bench->maxEvents);
    vtJson_BeginArray(&json, "cases");
    for (int i = 0; i < bench->caseCount; ++i) {
        writeCase(&json, bench, &bench->cases[i]);
    }
    vtJson_EndArray(&json);
    vtJson_EndObject(&json);
    fputc('\n', out);
}
