// The figures of `vitrine bench` as JSON.
#include "lab/bench/bench.h"
#include "technique/technique.h"

void vtWriteJsonText(const char* name, const char* text, FILE* out)
{
    fprintf(out, "\"%s\":\"", name);
    for (; *text != '\0'; ++text) {
        if (*text == '"' || *text == '\\') {
            fprintf(out, "\\%c", *text);
        } else if ((unsigned char)*text < 32) {
            fprintf(out, "\\u%04x", (unsigned)*text);
        } else {
            fputc(*text, out);
        }
    }
    fprintf(out, "\",");
}

/// "wallToReference" and "cpuToReference", or "wallToReferencePicture" ...
static void writeRatios(const char* to, const vtTiming* time, const vtTiming* traced, FILE* out)
{
    fprintf(out, "\"wallToReference%s\":%.5f,\"cpuToReference%s\":%.5f,", to, time->wall / traced->wall, to,
            time->processor / traced->processor);
}

/// The default picture of a technique that has all of it.
static void writePicture(const vtBenchCase* measured, const vtBenchRow* row, FILE* out)
{
    const vtTiming *time = &row->pictureTime, *traced = &measured->traced.picture;
    if (time->wall > 0.0) {
        fprintf(out, "\"picture\":{");
        if (traced->wall > 0.0) {
            writeRatios("", time, traced, out);
        }
        fprintf(out, "\"branches\":%d,\"wall\":%.4f,\"cpu\":%.4f},", vtFrame_BranchCount(&row->picture),
                time->wall, time->processor);
    }
}

static void writeStages(const vtBenchRow* row, FILE* out)
{
    const char* comma = "";
    for (int i = 0; i < vt_benchStages; ++i) {
        if (row->stages[i].wall > 0.0) {
            fprintf(out, "%s\"%s\":{\"wall\":%.4f,\"cpu\":%.4f}", comma, vtBenchStage(i), row->stages[i].wall,
                    row->stages[i].processor);
            comma = ",";
        }
    }
}

static void writeReference(const vtBenchCase* measured, FILE* out)
{
    const vtTracedTiming* traced = &measured->traced;
    fprintf(out, "\"reference\":{\"wall\":%.4f,\"cpu\":%.4f,\"build\":%.3f", traced->directions.wall,
            traced->directions.processor, measured->tracerBuild);
    fprintf(out, ",\"strictPicture\":{\"wall\":%.4f,\"cpu\":%.4f}", traced->strict.wall,
            traced->strict.processor);
    fprintf(out, ",\"picture\":{\"wall\":%.4f,\"cpu\":%.4f}},", traced->picture.wall,
            traced->picture.processor);
}

static void writeJsonRow(const vtBench* bench, const vtBenchCase* measured, int index, FILE* out)
{
    const vtBenchRow* row = &measured->rows[index];
    const vtTiming toLayered = vtBench_ToLayered(bench, measured, index);
    fprintf(out, "{");
    vtWriteJsonText("id", row->id, out);
    vtWriteJsonText("label", row->label, out);
    if (bench->sweep == vt_sweepRelief) {
        vtBenchRow_WriteReliefJson(row, out);
    }
    fprintf(out, "\"wall\":%.4f,\"cpu\":%.4f,", row->time.wall, row->time.processor);
    const vtTracedTiming* traced = &measured->traced;
    if (traced->directions.wall > 0.0) {
        writeRatios("", &row->time, &traced->directions, out);
        writeRatios("Picture", &row->time, &traced->strict, out);
    }
    writePicture(measured, row, out);
    if (toLayered.wall > 0.0) {
        fprintf(out, "\"wallToLayered\":%.5f,\"cpuToLayered\":%.5f,", toLayered.wall, toLayered.processor);
    }
    fprintf(out, "\"pixels\":%zu,\"within1\":%.6f,\"within5\":%.6f,\"lost\":%.6f,", row->error.pixels,
            row->error.within1, row->error.within5, row->error.lost);
    fprintf(out, "\"readsAPath\":%.3f,\"readsAnEvent\":%.3f,\"textureBytes\":%zu,", row->readsAPath,
            row->readsAnEvent, row->textureBytes);
    fprintf(out, "\"meshBytes\":%zu,\"bytesATriangle\":%.3f,\"upload\":%.3f,\"build\":%.3f,\"stages\":{",
            row->meshBytes, vtBytesATriangle(measured, row), row->upload, row->build);
    writeStages(row, out);
    fprintf(out, "}}");
}

void vtBench_WriteJson(const vtBench* bench, FILE* out)
{
    fprintf(out, "{");
    vtWriteJsonText("version", VT_VERSION, out);
    vtWriteJsonText("model", bench->model, out);
    vtWriteJsonText("sweep", vtSweepName(bench->sweep), out);
    vtWriteJsonText("preset", bench->preset, out);
    vtWriteJsonText("device", bench->device, out);
    vtWriteJsonText("gl", bench->version, out);
    fprintf(out, "\"threads\":%d,\"processors\":%d,\"ior\":%g,\"maxEvents\":%d,\"cases\":[", bench->threads,
            bench->processors, (double)bench->ior, bench->maxEvents);
    for (int i = 0; i < bench->caseCount; ++i) {
        const vtBenchCase* measured = &bench->cases[i];
        fprintf(out,
                "%s{\"objects\":%d,\"triangles\":%d,\"width\":%d,\"height\":%d,\"rounds\":%d,\"paths\":%zu,",
                i > 0 ? "," : "", measured->copies, measured->triangles, measured->width, measured->height,
                measured->rounds, measured->paths);
        if (bench->sweep == vt_sweepRelief) {
            vtWriteJsonText("untraced", measured->untraced, out);
            fprintf(out, "\"samples\":%d,\"flip\":%.7f,", measured->samples, measured->flip);
        }
        fprintf(out, "\"eventsAPath\":%.4f,\"upload\":%.3f,\"meshBytes\":%zu,", measured->eventsAPath,
                measured->upload, measured->meshBytes);
        writeReference(measured, out);
        fprintf(out, "\"techniques\":[");
        for (int row = 0; row < bench->rowCount; ++row) {
            fprintf(out, "%s", row > 0 ? "," : "");
            writeJsonRow(bench, measured, row, out);
        }
        fprintf(out, "]}");
    }
    fprintf(out, "]}\n");
}
