#include "lab/bench/report_relief.h"

static void writeBytes(size_t bytes, FILE* out)
{
    fprintf(out, "%.1f MB | ", (double)bytes / 1048576.0);
}

/// The default picture beside the reference's of strict paths and of all.
static void writePicture(const vtBenchCase* measured, const vtBenchRow* row, FILE* out)
{
    vtWriteRatio(row->time.processor, measured->traced.strict.processor, out);
    fprintf(out, "%.1f ms | ", row->pictureTime.processor);
    vtWriteRatio(row->pictureTime.processor, measured->traced.picture.processor, out);
}

static void writeRow(const vtBenchCase* measured, int index, FILE* out)
{
    const vtBenchRow *row = &measured->rows[index], *heights = &measured->rows[0];
    const vtTiming *time = &row->time, *traced = &measured->traced.directions;
    fprintf(out, "| %d x %d | %s | ", measured->samples, measured->samples, row->label);
    if (row->absent[0] != '\0') {
        fprintf(out, "not drawn | - | - | - | - | - | - | - | - | - | - | ");
    } else {
        fprintf(out, "%.1f ms | %.1f ms | ", time->wall, time->processor);
        vtWriteRatio(time->processor, heights->time.processor, out);
        vtWriteRatio(time->processor, traced->processor, out);
        writePicture(measured, row, out);
        fprintf(out, traced->wall > 0.0 ? "%.2f %% | %.2f %% | " : "- | - | ", 100.0 * row->error.within1,
                100.0 * row->error.lost);
        fprintf(out, "%.1f | %.1f | ", row->readsAPath, row->readsAnEvent);
    }
    writeBytes(row->hostBytes, out);
    if (row->glassBytes > 0) {
        writeBytes(row->glassBytes, out);
    } else {
        fprintf(out, "- | ");
    }
    fprintf(out, row->triangulation > 0.0 ? "%.0f ms | " : "- | ", row->triangulation);
    fprintf(out, row->absent[0] == '\0' ? "%.0f ms | " : "- | ", row->upload);
    fprintf(out, row->build > 0.0 ? "%.0f ms |\n" : "- |\n", row->build);
}

static void writeTraced(const vtBenchCase* measured, FILE* out)
{
    const vtTiming *traced = &measured->traced.directions, *picture = &measured->traced.picture;
    fprintf(out, "| %d x %d | Embree | ", measured->samples, measured->samples);
    if (measured->untraced[0] != '\0') {
        fprintf(out, "not traced | - | - | - | - | - | - | - | - | - | - | - | - | - | - | - |\n");
        return;
    }
    fprintf(out, "%.1f ms | %.1f ms | ", traced->wall, traced->processor);
    vtWriteRatio(traced->processor, measured->rows[0].time.processor, out);
    fprintf(out, "1 | ");
    vtWriteRatio(traced->processor, measured->traced.strict.processor, out);
    fprintf(out, "%.1f ms | 1 | - | - | - | - | - | - | - | - | %.0f ms |\n", picture->processor,
            measured->tracerBuild);
}

/// A line below the table for each thing that is missing in it.
static void writeReasons(const vtBench* bench, FILE* out)
{
    for (int i = 0; i < bench->caseCount; ++i) {
        const vtBenchCase* measured = &bench->cases[i];
        const int samples = measured->samples;
        for (int row = 0; row < bench->rowCount; ++row) {
            if (measured->rows[row].absent[0] != '\0') {
                fprintf(out,
                        "\n%s is not drawn at %d x %d, %d triangles: %s. Memory is that of the mesh beside "
                        "the GPU.\n",
                        measured->rows[row].id, samples, samples, measured->triangles,
                        measured->rows[row].absent);
            }
        }
        if (measured->untraced[0] != '\0') {
            fprintf(out, "\nEmbree does not trace %d x %d: %s.\n", samples, samples, measured->untraced);
        }
    }
}

static void writeAgreement(const vtBench* bench, FILE* out)
{
    fprintf(out,
            "\nHow far the two draw the same:\n\n"
            "| relief | triangles | mean FLIP | directions within 0.1° | within 1° | lost by heightfield | "
            "lost by exact |\n|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < bench->caseCount; ++i) {
        const vtBenchCase* measured = &bench->cases[i];
        const vtDirectionError *heights = &measured->rows[0].agreement, *exact = &measured->rows[1].agreement;
        if (heights->pixels > 0) {
            fprintf(out, "| %d x %d | %d | %.5f | %.3f %% | %.3f %% | %.3f %% | %.3f %% |\n",
                    measured->samples, measured->samples, measured->triangles, measured->flip,
                    100.0 * heights->within01, 100.0 * heights->within1, 100.0 * heights->lost,
                    100.0 * exact->lost);
        }
    }
}

void vtBench_WriteRelief(const vtBench* bench, FILE* out)
{
    fprintf(
        out,
        "| relief | technique | frame | CPU | CPU / heightfield | CPU / Embree | CPU / strict picture | "
        "picture CPU | picture CPU / Embree | within 1° | lost | reads a path | reads an event | memory | "
        "GPU memory | triangulation | upload | build |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < bench->caseCount; ++i) {
        for (int row = 0; row < bench->rowCount; ++row) {
            writeRow(&bench->cases[i], row, out);
        }
        writeTraced(&bench->cases[i], out);
    }
    writeReasons(bench, out);
    writeAgreement(bench, out);
}
