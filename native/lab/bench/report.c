#include "lab/bench/report.h"

#include <string.h>

#include "lab/bench/report_relief.h"

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

/// Rounds of the cases, which may differ.
static void writeRounds(const vtBench* bench, FILE* out)
{
    int least = bench->cases[0].rounds, most = least;
    for (int i = 1; i < bench->caseCount; ++i) {
        const int rounds = bench->cases[i].rounds;
        least = rounds < least ? rounds : least;
        most = rounds > most ? rounds : most;
    }
    fprintf(out, "; medians of ");
    if (least < most) {
        fprintf(out, "%d to ", least);
    }
    fprintf(out, "%d frames.", most);
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
    writeRounds(bench, out);
    if (bench->sweep == vt_sweepNone) {
        fprintf(out, " Mesh on the GPU: %.1f MB.", mebibytes(first->meshBytes));
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

static void writeTime(double time, FILE* out)
{
    fprintf(out, time > 0.0 ? "%.1f ms | " : "- | ", time);
}

static void writeRatios(const vtTiming* time, const vtTiming* other, FILE* out)
{
    vtWriteRatio(time->wall, other->wall, out);
    vtWriteRatio(time->processor, other->processor, out);
}

static void writeTimes(const vtTiming* time, FILE* out)
{
    writeTime(time->wall, out);
    writeTime(time->processor, out);
}

/// Columns of writeRow from `frame` to `picture CPU / Embree`, by what is measured there.
static void writeAllTimes(const vtTiming* strict, const vtTiming* toLayered, const vtTiming* picture,
                          const vtTracedTiming* traced, FILE* out)
{
    static const vtTiming one = {1.0, 1.0};
    writeTimes(strict, out);
    writeRatios(strict, &traced->directions, out);
    writeRatios(strict, &traced->strict, out);
    writeRatios(toLayered, &one, out);
    writeTimes(picture, out);
    writeRatios(picture, &traced->picture, out);
}

static void writeRow(const vtBench* bench, const vtBenchCase* measured, int index, FILE* out)
{
    const vtBenchRow* row = &measured->rows[index];
    const vtTiming toLayered = vtBench_ToLayered(bench, measured, index);
    writeVariable(bench, measured, out);
    fprintf(out, "| %s | ", row->label);
    writeAllTimes(&row->time, &toLayered, &row->pictureTime, &measured->traced, out);
    fprintf(out, "%.2f %% | %.2f %% | %.2f %% | ", 100.0 * row->error.within1, 100.0 * row->error.within5,
            100.0 * row->error.lost);
    fprintf(out, "%.1f | %.1f | %.1f MB | %.0f | %.0f ms | ", row->readsAPath, row->readsAnEvent,
            mebibytes(row->textureBytes), vtBytesATriangle(measured, row), row->upload);
    fprintf(out, row->build > 0.0 ? "%.0f ms |\n" : "- |\n", row->build);
}

/// The reference's directions and default picture in the columns of a technique's, then its strict picture.
static void writeTraced(const vtBench* bench, const vtBenchCase* measured, FILE* out)
{
    static const vtTiming none = {0.0, 0.0};
    const vtTracedTiming* traced = &measured->traced;
    writeVariable(bench, measured, out);
    fprintf(out, "| Embree | ");
    writeAllTimes(&traced->directions, &none, &traced->picture, traced, out);
    fprintf(out, "- | - | - | - | - | - | - | - | %.0f ms |\n", measured->tracerBuild);
    writeVariable(bench, measured, out);
    fprintf(out, "| Embree, strict picture | ");
    writeAllTimes(&traced->strict, &none, &none, traced, out);
    fprintf(out, "- | - | - | - | - | - | - | - | - |\n");
}

/// Whether any technique has the stage.
static bool hasStage(const vtBench* bench, int stage)
{
    bool has = false;
    for (int i = 0; i < bench->rowCount; ++i) {
        has = has || bench->cases[0].rows[i].stages[stage].wall > 0.0;
    }
    return has;
}

static void writeStages(const vtBench* bench, FILE* out)
{
    fprintf(out,
            "\nStages of strict paths, GL finished after each, with CPU time in brackets:\n\n| technique |");
    for (int i = 0; i < vt_benchStages; ++i) {
        if (hasStage(bench, i)) {
            fprintf(out, " %s |", vtBenchStage(i));
        }
    }
    fprintf(out, "\n|---|");
    for (int i = 0; i < vt_benchStages; ++i) {
        fprintf(out, hasStage(bench, i) ? "---|" : "");
    }
    fprintf(out, "\n");
    for (int i = 0; i < bench->rowCount; ++i) {
        const vtBenchRow* row = &bench->cases[0].rows[i];
        fprintf(out, "| %s |", row->label);
        for (int stage = 0; stage < vt_benchStages; ++stage) {
            const vtTiming* time = &row->stages[stage];
            if (hasStage(bench, stage)) {
                fprintf(out, time->wall > 0.0 ? " %.1f (%.1f) ms |" : " - |", time->wall, time->processor);
            }
        }
        fprintf(out, "\n");
    }
}

/// Processors' time of the stages that follow paths.
static double pathTime(const vtBenchRow* row)
{
    double time = 0.0;
    for (int i = 0; i < vt_benchStages; ++i) {
        const char* name = vtBenchStage(i);
        time += strcmp(name, "refract") == 0 || strcmp(name, "trace") == 0 ? row->stages[i].processor : 0.0;
    }
    return time;
}

/// A row of a sweep over objects; perPixel: glass pixels of the first case over those of this one.
static void writeObjectRow(const vtBench* bench, const vtBenchCase* measured, int index, double perPixel,
                           FILE* out)
{
    const vtBenchRow *row = &measured->rows[index], *one = &bench->cases[0].rows[index];
    const double share = (double)measured->paths / ((double)measured->width * (double)measured->height);
    const vtTracedTiming* traced = &measured->traced;
    fprintf(out, "| %d | %s | %zu | %.1f %% | %.2f | ", measured->copies, row->label, measured->paths,
            100.0 * share, measured->eventsAPath);
    writeTimes(&row->time, out);
    vtWriteRatio(perPixel * row->time.processor, one->time.processor, out);
    vtWriteRatio(perPixel * pathTime(row), pathTime(one), out);
    vtWriteRatio(row->time.processor, traced->directions.processor, out);
    vtWriteRatio(row->time.processor, traced->strict.processor, out);
    writeTimes(&row->pictureTime, out);
    vtWriteRatio(row->pictureTime.processor, traced->picture.processor, out);
    fprintf(out, "%.2f %% | %.2f %% | %.1f MB | %.1f MB | %.0f | %.0f ms | ", 100.0 * row->error.within1,
            100.0 * row->error.lost, mebibytes(row->textureBytes), mebibytes(row->meshBytes),
            vtBytesATriangle(measured, row), row->upload);
    fprintf(out, row->build > 0.0 ? "%.0f ms |\n" : "- |\n", row->build);
}

/// A sweep over objects: what each costs, and what all hold.
static void writeObjects(const vtBench* bench, FILE* out)
{
    const vtBenchCase* first = &bench->cases[0];
    fprintf(out,
            "| objects | technique | glass pixels | of the picture | events a path | frame | CPU | CPU a "
            "glass pixel | paths alone | CPU / Embree | CPU / strict picture | picture | picture CPU | "
            "picture CPU / Embree | within 1° | lost | textures | meshes | bytes a triangle | upload | build "
            "|\n");
    for (int i = 0; i < 21; ++i) {
        fprintf(out, "|---");
    }
    fprintf(out, "|\n");
    for (int i = 0; i < bench->caseCount; ++i) {
        const vtBenchCase* measured = &bench->cases[i];
        const vtTracedTiming* traced = &measured->traced;
        const double perPixel = (double)first->paths / (double)measured->paths;
        for (int k = 0; k < bench->rowCount; ++k) {
            writeObjectRow(bench, measured, k, perPixel, out);
        }
        fprintf(out, "| %d | Embree | - | - | - | ", measured->copies);
        writeTimes(&traced->directions, out);
        vtWriteRatio(perPixel * traced->directions.processor, first->traced.directions.processor, out);
        fprintf(out, "- | 1 | ");
        vtWriteRatio(traced->directions.processor, traced->strict.processor, out);
        writeTimes(&traced->picture, out);
        fprintf(out, "1 | - | - | - | - | - | - | %.0f ms |\n", measured->tracerBuild);
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
    fprintf(
        out,
        "| technique | frame | CPU | frame / Embree | CPU / Embree | frame / strict picture | CPU / strict "
        "picture | frame / layered | CPU / layered | picture | picture CPU | picture / Embree | "
        "picture CPU / Embree | within 1° | within 5° | lost | reads a path | reads an event | "
        "textures | bytes a triangle | upload | build |\n");
    for (int i = 0; i < (bench->sweep != vt_sweepNone ? 23 : 22); ++i) {
        fprintf(out, "|---");
    }
    fprintf(out, "|\n");
    for (int i = 0; i < bench->caseCount; ++i) {
        const vtBenchCase* measured = &bench->cases[i];
        for (int row = 0; row < bench->rowCount; ++row) {
            writeRow(bench, measured, row, out);
        }
        writeTraced(bench, measured, out);
    }
    if (bench->sweep == vt_sweepNone) {
        writeStages(bench, out);
    }
}
