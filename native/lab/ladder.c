// Every technique from one view beside the reference: a contact sheet with error and time under each
// picture, and the same figures as a Markdown table.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/files.h"
#include "cli/session.h"
#include "cli/trace.h"
#include "image/image.h"
#include "lab/metrics/metrics.h"
#include "lab/metrics/metrics_image.h"
#include "lab/metrics/timing.h"
#include "lab/sheet.h"
#include "scene/objects.h"

// The table's rows, and `layered` once more with twice the layers, and with the other search.
enum { rungTwiceLayers = vt_techniqueCount, rungCells, rungCount };

typedef struct Rung {
    char label[64];
    int year;
    uint8_t* pixels;
    vtDirectionError directions;
    vtPictureError picture;
    double milliseconds;
} Rung;

typedef struct Ladder {
    int count; ///< of rungs
    vtFrame frames[rungCount];
    Rung rungs[rungCount];
    vtReferenceImage truth;
    uint8_t* truthPixels;
    double traced;
} Ladder;

static void nameRungs(const vtFrame* base, bool hasRelief, Ladder* ladder)
{
    for (int i = 0; i < rungCount; ++i) {
        if (i == vt_techniqueHeightField && !hasRelief) {
            continue; // it would be exact once more
        }
        vtFrame* frame = &ladder->frames[ladder->count];
        Rung* rung = &ladder->rungs[ladder->count++];
        *frame = *base;
        frame->technique = i >= vt_techniqueCount ? vt_techniqueLayered : (vtTechnique)i;
        frame->search = i == rungCells ? vt_searchCells : vt_searchSteps;
        const int layers = vtResolveFrame(frame).layers;
        frame->layers = i == rungTwiceLayers && 2 * layers <= VT_MAX_LAYERS ? 2 * layers : base->layers;
        const vtTechniqueInfo* info = vtTechnique_Info(frame->technique);
        rung->year = info->year;
        if (i == rungCells) {
            snprintf(rung->label, sizeof rung->label, "%s, cells", info->id);
        } else if (frame->technique == vt_techniqueLayered) {
            snprintf(rung->label, sizeof rung->label, "%s, %d layers", info->id,
                     vtResolveFrame(frame).layers);
        } else {
            snprintf(rung->label, sizeof rung->label, "%s", info->id);
        }
    }
}

static vtResult climb(vtSession* session, Ladder* ladder, int index, float* directions, vtError* error)
{
    Rung* rung = &ladder->rungs[index];
    const vtFrame* frame = &ladder->frames[index];
    size_t count = (size_t)frame->width * (size_t)frame->height;
    rung->pixels = malloc(4 * count);
    if (rung->pixels == NULL) {
        return vtFail(error, vt_errorMemory, "ladder: out of memory for %d x %d", frame->width,
                      frame->height);
    }
    vtFrame centre = *frame; // what the reference's directions are of
    centre.samples = 1;
    vtResult result = vtRenderer_DrawImage(session->renderer, frame, rung->pixels, error);
    if (result == vt_ok && frame->samples > 1) {
        result = vtRenderer_DrawImage(session->renderer, &centre, NULL, error);
    }
    if (result == vt_ok) {
        result = vtRenderer_ReadDirections(session->renderer, directions, error);
    }
    if (result == vt_ok) {
        result = vtCompareDirections(directions, ladder->truth.directions, count, &rung->directions, error);
    }
    if (result == vt_ok) {
        result = vtComparePictureBytes(rung->pixels, ladder->truthPixels, 4, frame->width, frame->height,
                                       &rung->picture, NULL, error);
    }
    return result;
}

static vtResult measure(const vtOptions* options, vtSession* session, Ladder* ladder, vtError* error)
{
    const vtFrame* frame = &ladder->frames[0];
    float* directions = malloc(3 * sizeof(float) * (size_t)frame->width * (size_t)frame->height);
    vtReference* reference = NULL;
    vtResult result = directions != NULL ? vtTrace(options, &session->input, frame, isatty(STDERR_FILENO),
                                                   &ladder->truth, error)
                                         : vtFail(error, vt_errorMemory, "ladder: out of memory");
    if (result == vt_ok) {
        result = vtTracePixels(&ladder->truth, &session->input, frame, &ladder->truthPixels, error);
    }
    for (int i = 0; i < ladder->count && result == vt_ok; ++i) {
        result = climb(session, ladder, i, directions, error);
    }
    if (result == vt_ok) {
        result = vtCreateReference(&session->input.scene, &reference, error);
    }
    if (result == vt_ok) {
        vtTiming times[rungCount];
        vtTracedTiming traced;
        for (int i = 0; i < ladder->count; ++i) {
            ladder->frames[i].samples = 1; // times are those of one sample, as the reference's is
        }
        const vtTimingDef def = {.renderer = session->renderer,
                                 .frames = ladder->frames,
                                 .count = ladder->count,
                                 .reference = reference};
        result = vtTimeFrames(&def, times, &traced, NULL, error);
        ladder->traced = traced.directions.wall;
        for (int i = 0; i < ladder->count && result == vt_ok; ++i) {
            ladder->rungs[i].milliseconds = times[i].wall;
        }
    }
    vtDestroyReference(reference);
    free(directions);
    return result;
}

/// What the table is made of.
typedef struct Table {
    const vtOptions* options;
    const vtSession* session;
    const Ladder* ladder;
} Table;

static void printTable(const void* data, FILE* out)
{
    const Table* table = data;
    const vtOptions* options = table->options;
    const vtSession* session = table->session;
    const Ladder* ladder = table->ladder;
    const vtFrame* frame = &ladder->frames[0];
    const float ior = vtCommonIor(&session->input);
    char models[1024], index[48] = "indices of their own";
    vtNameModels(options, models, sizeof models);
    if (ior > 0.0f) {
        snprintf(index, sizeof index, "index %g", (double)ior);
    }
    fprintf(out, "`%s`, %d x %d, %s, %d events; reference (Embree) %.0f ms; %s\n\n", models, frame->width,
            frame->height, index, vtResolveFrame(frame).maxEvents, ladder->traced,
            vtRenderer_Info(session->renderer).device);
    fprintf(out,
            "| technique | year | within 1° | within 5° | mean error | median | lost | mean FLIP | time | "
            "time / reference |\n|---|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < ladder->count; ++i) {
        const Rung* r = &ladder->rungs[i];
        fprintf(out, "| %s | %d | %.1f %% | %.1f %% | %.2f° | %.3f° | %.2f %% | %.3f | %.1f ms | %.2f |\n",
                r->label, r->year, 100.0 * r->directions.within1, 100.0 * r->directions.within5,
                r->directions.mean, r->directions.median, 100.0 * r->directions.lost, r->picture.flip,
                r->milliseconds, r->milliseconds / ladder->traced);
    }
}

static vtResult drawSheet(const Ladder* ladder, vtSheet* sheet, vtError* error)
{
    enum { columns = 3, largestTile = 512, gap = 12 };
    const vtFrame* frame = &ladder->frames[0];
    const int longer = frame->width > frame->height ? frame->width : frame->height;
    const int factor = (longer + largestTile - 1) / largestTile;
    const int across = frame->width / factor, down = frame->height / factor;
    const int scale = across >= 360 ? 2 : 1, words = 3 * 12 * scale + gap;
    const int rows = (ladder->count + 1 + columns - 1) / columns;
    vtResult result =
        vtCreateSheet(columns * (across + gap) + gap, rows * (down + words + gap) + gap, 236, sheet, error);
    for (int i = 0; i <= ladder->count && result == vt_ok; ++i) {
        int x = gap + i % columns * (across + gap), y = gap + i / columns * (down + words + gap);
        bool isTruth = i == ladder->count;
        vtSheet_Paste(sheet, x, y, isTruth ? ladder->truthPixels : ladder->rungs[i].pixels, frame->width,
                      frame->height, factor);
        char lines[3][96] = {"reference, Embree", "", ""};
        snprintf(lines[1], sizeof lines[1], "%.1f ms", ladder->traced);
        if (!isTruth) {
            const Rung* r = &ladder->rungs[i];
            snprintf(lines[0], sizeof lines[0], "%s (%d)", r->label, r->year);
            snprintf(lines[1], sizeof lines[1], "%.1f %% within 1 deg, mean %.1f deg",
                     100.0 * r->directions.within1, r->directions.mean);
            snprintf(lines[2], sizeof lines[2], "FLIP %.3f, %.1f ms", r->picture.flip, r->milliseconds);
        }
        for (int k = 0; k < 3; ++k) {
            vtSheet_Text(sheet, x, y + down + 6 + 12 * scale * k, scale, lines[k]);
        }
    }
    return result;
}

static vtResult writeSheet(const char* path, const Ladder* ladder, vtError* error)
{
    vtSheet sheet;
    uint8_t* bytes = NULL;
    size_t size;
    vtResult result = drawSheet(ladder, &sheet, error);
    if (result == vt_ok) {
        result = vtEncodePng(sheet.pixels, 4, sheet.width, sheet.height, &bytes, &size, error);
    }
    if (result == vt_ok) {
        result = vtWriteFile(path, bytes, size, error);
    }
    vtFree(bytes);
    vtDestroySheet(&sheet);
    return result;
}

vtResult vtRunLadder(const vtOptions* given, vtError* error)
{
    vtOptions options = *given;
    options.innerDistances = true;
    vtSession session;
    vtResult result = vtOpenSession(&options, &session, error);
    if (result != vt_ok) {
        return result;
    }
    vtFrame frame;
    Ladder* ladder = calloc(1, sizeof *ladder);
    result = ladder != NULL ? vtMakeFrame(&options, &session.input, &frame, error)
                            : vtFail(error, vt_errorMemory, "ladder: out of memory");
    if (result == vt_ok) {
        frame.fresnel = false; // strict paths, as the reference's; options.fresnel is false here, too
        const vtScene* scene = &session.input.scene;
        nameRungs(&frame, vtScene_HasRelief(scene), ladder);
        result = measure(&options, &session, ladder, error);
    }
    if (result == vt_ok && options.output != NULL) {
        result = writeSheet(options.output, ladder, error);
    }
    if (result == vt_ok && (options.table != NULL || options.output == NULL)) {
        result = vtWritePrinted(options.table != NULL ? options.table : "-", printTable,
                                &(Table){&options, &session, ladder}, error);
    }
    for (int i = 0; ladder != NULL && i < ladder->count; ++i) {
        free(ladder->rungs[i].pixels);
    }
    if (ladder != NULL) {
        free(ladder->truthPixels);
        vtDestroyReferenceImage(&ladder->truth);
    }
    free(ladder);
    vtCloseSession(&session);
    return result;
}
