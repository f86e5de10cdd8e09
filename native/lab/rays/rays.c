// `vitrine rays`: a relief's heights traced by themselves, beside triangles made of them.
#include "lab/rays/rays.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/load.h"

/// The direct method's own ratio where it comes from (Weng): 1.4 s before, 1.5 s with it.
static const double sourceRatio = 1.4 / 1.5;

static const char* const wayNames[vt_rayWays] = {
    [vt_wayDirect] = "heights",
    [vt_wayPrimitive] = "heights, through Embree",
    [vt_waySingle] = "Embree's triangles, single rays",
    [vt_wayPackets] = "Embree's triangles, packets of 8",
    [vt_wayThree] = "heights without tiles: the three separations",
    [vt_wayWithoutCells] = "of the three without the cells' heights",
    [vt_wayWithoutShadow] = "of the three without the shadow",
    [vt_wayWithoutBox] = "of the three without the box",
};

static const char* const wayKeys[vt_rayWays] = {"heights",       "primitive",    "single",
                                                "packets",       "withoutTiles", "withoutCells",
                                                "withoutShadow", "withoutBox"};

/// What is printed.
typedef struct Report {
    const char* model;
    const vtRayFigures* figures;
} Report;

static double mebibytes(size_t bytes)
{
    return (double)bytes / 1048576.0;
}

static bool isTriangles(int way)
{
    return way == vt_waySingle || way == vt_wayPackets;
}

static double buildOf(const vtRayFigures* figures, int way)
{
    return figures->heightsBuild +
           (isTriangles(way) ? figures->trianglesMade + figures->trianglesBuild : 0.0);
}

static size_t bytesOf(const vtRayFigures* figures, int way)
{
    return isTriangles(way) ? figures->meshBytes + figures->embreeBytes : figures->heightsBytes;
}

static void writeTable(const void* data, FILE* out)
{
    const Report* report = data;
    const vtRayFigures* figures = report->figures;
    fprintf(
        out,
        "`%s`, %d x %d samples, %zu triangles; one processor, its time; medians of %d rounds in turns. A "
        "million "
        "rays each: of a camera, and random ones from all around. Times a ray are beside single rays against "
        "triangles = 1.\n\n",
        report->model, figures->width, figures->height, figures->triangles, figures->rounds);
    fprintf(
        out,
        "| way | build | memory | camera, million rays a second | time a ray | random | time a ray | build + "
        "a million random |\n|---|---|---|---|---|---|---|---|\n");
    const double *camera = figures->times[vt_raysOfCamera], *random = figures->times[vt_raysRandom];
    for (int way = 0; way < vt_rayWays; ++way) {
        const double build = buildOf(figures, way);
        fprintf(out, "| %s | %.0f ms | %.1f MB | %.3g | %.3g | %.3g | %.3g | %.3g s |\n", wayNames[way],
                build, mebibytes(bytesOf(figures, way)), 1e3 / camera[way],
                camera[way] / camera[vt_waySingle], 1e3 / random[way], random[way] / random[vt_waySingle],
                1e-3 * (build + random[way]));
    }
    const double ours = random[vt_waySingle] / random[vt_wayDirect];
    const double all = (buildOf(figures, vt_waySingle) + random[vt_waySingle]) /
                       (buildOf(figures, vt_wayDirect) + random[vt_wayDirect]);
    fprintf(
        out,
        "\nRays that heights and triangles answer differently: %zu of the camera's, %zu of the random ones; "
        "%zu "
        "and %zu meet the relief. While it builds Embree takes %.1f MB. The source's method had %.2f of its "
        "baseline's speed; this one has %.2f, with building %.1f.\n",
        figures->differing[vt_raysOfCamera], figures->differing[vt_raysRandom],
        figures->hits[vt_raysOfCamera], figures->hits[vt_raysRandom], mebibytes(figures->embreePeak),
        sourceRatio, ours, all);
}

static void writeJson(const void* data, FILE* out)
{
    const Report* report = data;
    const vtRayFigures* figures = report->figures;
    vtJson json = {.out = out};
    vtJson_BeginObject(&json, NULL);
    vtJson_Text(&json, "model", report->model);
    vtJson_Integer(&json, "width", figures->width);
    vtJson_Integer(&json, "height", figures->height);
    vtJson_Integer(&json, "triangles", (long long)figures->triangles);
    vtJson_Integer(&json, "rounds", figures->rounds);
    vtJson_Integer(&json, "rays", vt_rayCount);
    vtJson_Number(&json, "buildHeights", figures->heightsBuild, 3);
    vtJson_Number(&json, "makeTriangles", figures->trianglesMade, 3);
    vtJson_Number(&json, "buildTriangles", figures->trianglesBuild, 3);
    vtJson_Integer(&json, "heightsBytes", (long long)figures->heightsBytes);
    vtJson_Integer(&json, "meshBytes", (long long)figures->meshBytes);
    vtJson_Integer(&json, "embreeBytes", (long long)figures->embreeBytes);
    vtJson_Integer(&json, "embreePeak", (long long)figures->embreePeak);
    vtJson_BeginArray(&json, "differing");
    vtJson_Integer(&json, NULL, (long long)figures->differing[0]);
    vtJson_Integer(&json, NULL, (long long)figures->differing[1]);
    vtJson_EndArray(&json);
    vtJson_Number(&json, "sourceRatio", sourceRatio, 3);
    vtJson_BeginObject(&json, "milliseconds");
    for (int way = 0; way < vt_rayWays; ++way) {
        vtJson_BeginObject(&json, wayKeys[way]);
        vtJson_Number(&json, "camera", figures->times[vt_raysOfCamera][way], 3);
        vtJson_Number(&json, "random", figures->times[vt_raysRandom][way], 3);
        vtJson_EndObject(&json);
    }
    vtJson_EndObject(&json);
    vtJson_EndObject(&json);
    fputc('\n', out);
}

static vtResult writeReport(const vtOptions* options, const vtRayFigures* figures, vtError* error)
{
    const Report report = {options->model, figures};
    vtResult result = options->json ? vtWritePrinted("-", writeJson, &report, error) : vt_ok;
    if (result == vt_ok && (options->table != NULL || !options->json)) {
        result = vtWritePrinted(options->table != NULL ? options->table : "-", writeTable, &report, error);
    }
    return result == vt_ok ? vtSucceed(error) : result;
}

vtResult vtRunRays(const vtOptions* given, vtError* error)
{
    vtOptions options = *given;
    options.technique = "reference"; // makes no triangles of its own
    vtInput input;
    vtFrame frame;
    vtResult result = vtLoadInput(&options, &input, error);
    if (result != vt_ok) {
        return result;
    }
    const vtMesh* mesh = &input.scene.meshes[0];
    if (mesh->heights == NULL) {
        result = vtFail(
            error, vt_errorArgument,
            "rays: '%s' is no relief; give a picture of heights or a built-in relief (see 'vitrine list')",
            options.model);
    } else {
        result = vtMakeFrame(&options, &input, &frame, error);
    }
    if (result == vt_ok) {
        vtRayFigures figures;
        result = vtMeasureRays(mesh, &frame.view, options.rounds > 0 ? options.rounds : 5, &figures, error);
        result = result == vt_ok ? writeReport(&options, &figures, error) : result;
    }
    vtDestroyInput(&input);
    return result;
}
