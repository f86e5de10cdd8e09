// The figures of `vitrine bench` as Markdown and as JSON.
#include <string.h>

#include "bench.h"

static double mebibytes(size_t bytes)
{
    return (double)bytes / 1048576.0;
}

/// "bunny_69666" of "/models/bunny_69666.glb".
static void shortName(const char* model, char name[128])
{
    const char* slash = strrchr(model, '/');
    snprintf(name, 128, "%s", slash != NULL ? slash + 1 : model);
    char* dot = strrchr(name, '.');
    if (dot != NULL && dot != name) {
        *dot = '\0';
    }
}

static void writeHeader(const vtBench* bench, FILE* out)
{
    char name[128];
    shortName(bench->model, name);
    const vtBenchCase* first = &bench->cases[0];
    fprintf(out, "`%s`", name);
    if (bench->sweep != vt_sweepTriangles && bench->sweep != vt_sweepRelief) {
        fprintf(out, ", %d triangles", first->triangles);
    }
    if (bench->sweep != vt_sweepResolution) {
        fprintf(out, ", %d x %d", first->width, first->height);
    }
    if (bench->ior > 0.0f) {
        fprintf(out, ", index %g", (double)bench->ior);
    }
    fprintf(out, ", at most %d events, preset %s; ", bench->maxEvents, bench->preset);
    if (bench->sweep == vt_sweepNone) {
        fprintf(out, "%zu pixels see glass, %.2f events a path; ", first->paths, first->eventsAPath);
    }
    fprintf(out, "%s, %s; ", bench->device, bench->version);
    if (bench->threads > 0) {
        fprintf(out, "%d thread%s", bench->threads, bench->threads > 1 ? "s" : "");
    } else {
        fprintf(out, "%d processors", bench->processors);
    }
    fprintf(out, "; medians of %d frames.", first->rounds);
    if (bench->sweep == vt_sweepNone) {
        fprintf(out, " Mesh on the GPU: %.1f MB, %.0f ms.", mebibytes(first->meshBytes), first->upload);
    }
    fprintf(out, "\n\n");
}

/// The sweep's column; nothing without a sweep.
static void writeVariable(const vtBench* bench, const vtBenchCase* measured, FILE* out)
{
    if (bench->sweep == vt_sweepTriangles) {
        fprintf(out, "| %d ", measured->triangles);
    } else if (bench->sweep == vt_sweepResolution) {
        fprintf(out, "| %d x %d ", measured->width, measured->height);
    }
}

static void writeRow(const vtBench* bench, const vtBenchCase* measured, int index, FILE* out)
{
    const vtBenchRow* row = &measured->rows[index];
    const vtTiming *time = &row->time, *traced = &measured->traced;
    const vtTiming toLayered = vtBench_ToLayered(bench, measured, index);
    writeVariable(bench, measured, out);
    fprintf(out, "| %s | %.1f ms | %.1f ms | %.2f | %.2f | ", row->label, time->wall, time->processor,
            time->wall / traced->wall, time->processor / traced->processor);
    fprintf(out, toLayered.wall > 0.0 ? "%.2f | %.2f | " : "- | - | ", toLayered.wall, toLayered.processor);
    fprintf(out, "%.2f %% | %.2f %% | %.2f %% | ", 100.0 * row->error.within1, 100.0 * row->error.within5,
            100.0 * row->error.lost);
    fprintf(out, "%.1f | %.1f | %.1f MB | ", row->readsAPath, row->readsAnEvent,
            mebibytes(row->textureBytes));
    fprintf(out, row->build > 0.0 ? "%.0f ms |\n" : "- |\n", row->build);
}

static void writeStages(const vtBench* bench, FILE* out)
{
    fprintf(out, "\nStages, GL finished after each, with CPU time in brackets:\n\n| technique |");
    for (int i = 0; i < vt_benchStages; ++i) {
        fprintf(out, " %s |", vtBenchStage(i));
    }
    fprintf(out, "\n|---|");
    for (int i = 0; i < vt_benchStages; ++i) {
        fprintf(out, "---|");
    }
    fprintf(out, "\n");
    for (int i = 0; i < bench->rowCount; ++i) {
        const vtBenchRow* row = &bench->cases[0].rows[i];
        fprintf(out, "| %s |", row->label);
        for (int stage = 0; stage < vt_benchStages; ++stage) {
            const vtTiming* time = &row->stages[stage];
            fprintf(out, time->wall > 0.0 ? " %.1f (%.1f) ms |" : " - |", time->wall, time->processor);
        }
        fprintf(out, "\n");
    }
}

static int stageNumber(const char* name)
{
    int stage = 0;
    while (strcmp(vtBenchStage(stage), name) != 0) {
        ++stage;
    }
    return stage;
}

/// A sweep over objects: what each costs, and what all hold.
static void writeObjects(const vtBench* bench, FILE* out)
{
    const vtBenchCase* first = &bench->cases[0];
    const int refract = stageNumber("refract");
    fprintf(out,
            "| objects | technique | glass pixels | of the picture | events a path | frame | CPU | CPU a "
            "glass pixel | refract alone | CPU / Embree | within 1° | lost | textures | meshes |\n"
            "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < bench->caseCount; ++i) {
        const vtBenchCase* measured = &bench->cases[i];
        const double share = (double)measured->paths / ((double)measured->width * (double)measured->height);
        const double perPixel = (double)first->paths / (double)measured->paths;
        for (int k = 0; k < bench->rowCount; ++k) {
            const vtBenchRow *row = &measured->rows[k], *one = &first->rows[k];
            fprintf(out, "| %d | %s | %zu | %.1f %% | %.2f | ", measured->copies, row->label, measured->paths,
                    100.0 * share, measured->eventsAPath);
            fprintf(out, "%.1f ms | %.1f ms | %.2f | %.2f | %.2f | ", row->time.wall, row->time.processor,
                    perPixel * row->time.processor / one->time.processor,
                    perPixel * row->stages[refract].processor / one->stages[refract].processor,
                    row->time.processor / measured->traced.processor);
            fprintf(out, "%.2f %% | %.2f %% | %.1f MB | %.1f MB |\n", 100.0 * row->error.within1,
                    100.0 * row->error.lost, mebibytes(row->textureBytes), mebibytes(measured->meshBytes));
        }
        fprintf(out, "| %d | Embree | - | - | - | %.1f ms | %.1f ms | %.2f | - | 1 | - | - | - | - |\n",
                measured->copies, measured->traced.wall, measured->traced.processor,
                perPixel * measured->traced.processor / first->traced.processor);
    }
}

void vtBench_WriteTable(const vtBench* bench, FILE* out)
{
    writeHeader(bench, out);
    if (vtSweepsObjects(bench->sweep)) {
        writeObjects(bench, out);
        return;
    }
    if (bench->sweep == vt_sweepRelief) {
        vtBench_WriteRelief(bench, out);
        return;
    }
    if (bench->sweep != vt_sweepNone) {
        fprintf(out, "| %s ", vtSweepName(bench->sweep));
    }
    fprintf(out, "| technique | frame | CPU | frame / Embree | CPU / Embree | frame / layered | CPU / "
                 "layered | within 1° | "
                 "within 5° | lost | reads a path | reads an event | textures | build |\n");
    for (int i = 0; i < (bench->sweep != vt_sweepNone ? 15 : 14); ++i) {
        fprintf(out, "|---");
    }
    fprintf(out, "|\n");
    for (int i = 0; i < bench->caseCount; ++i) {
        const vtBenchCase* measured = &bench->cases[i];
        for (int row = 0; row < bench->rowCount; ++row) {
            writeRow(bench, measured, row, out);
        }
        writeVariable(bench, measured, out);
        fprintf(out, "| Embree | %.1f ms | %.1f ms | 1 | 1 | - | - | - | - | - | - | - | - | %.0f ms |\n",
                measured->traced.wall, measured->traced.processor, measured->tracerBuild);
    }
    if (bench->sweep == vt_sweepNone) {
        writeStages(bench, out);
    }
}

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
    if (measured->traced.wall > 0.0) {
        fprintf(out, "\"wallToReference\":%.5f,\"cpuToReference\":%.5f,",
                row->time.wall / measured->traced.wall, row->time.processor / measured->traced.processor);
    }
    if (toLayered.wall > 0.0) {
        fprintf(out, "\"wallToLayered\":%.5f,\"cpuToLayered\":%.5f,", toLayered.wall, toLayered.processor);
    }
    fprintf(out, "\"pixels\":%zu,\"within1\":%.6f,\"within5\":%.6f,\"lost\":%.6f,", row->error.pixels,
            row->error.within1, row->error.within5, row->error.lost);
    fprintf(out, "\"readsAPath\":%.3f,\"readsAnEvent\":%.3f,\"textureBytes\":%zu,\"build\":%.3f,\"stages\":{",
            row->readsAPath, row->readsAnEvent, row->textureBytes, row->build);
    for (int i = 0; i < vt_benchStages; ++i) {
        fprintf(out, "%s\"%s\":{\"wall\":%.4f,\"cpu\":%.4f}", i > 0 ? "," : "", vtBenchStage(i),
                row->stages[i].wall, row->stages[i].processor);
    }
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
        fprintf(out, "\"reference\":{\"wall\":%.4f,\"cpu\":%.4f,\"build\":%.3f},\"techniques\":[",
                measured->traced.wall, measured->traced.processor, measured->tracerBuild);
        for (int row = 0; row < bench->rowCount; ++row) {
            fprintf(out, "%s", row > 0 ? "," : "");
            writeJsonRow(bench, measured, row, out);
        }
        fprintf(out, "]}");
    }
    fprintf(out, "]}\n");
}
