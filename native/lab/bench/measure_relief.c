// A relief by its heights alone beside the same relief as triangles. At sizes whose triangles the GPU cannot
// hold, heightfield goes on alone, and the table says what they would take.
#include "lab/bench/measure_relief.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/error.h"
#include "lab/bench/measure.h"
#include "lab/metrics/metrics_image.h"
#include "mesh/height_field.h"

// What Embree takes for a triangle while it builds its hierarchy: 5.1 GB in all for 33.6 million of them.
static const double tracedTriangleBytes = 150.0;

static size_t hostBytes(const vtMesh* mesh)
{
    return 24 * (size_t)mesh->vertexCount + sizeof(uint32_t) * (size_t)mesh->indexCount;
}

static vtResult probeHeights(vtSession* session, vtBenchRow* row, vtError* error)
{
    const vtResult result = vtBench_Probe(session, row, error);
    row->hostBytes = vtHeightField_Bytes(session->input.scene.meshes[0].heights);
    row->glassBytes = row->heightBytes;
    return result;
}

/// Makes the triangles, and gives them to the session's renderer where the GPU can hold them.
static vtResult probeTriangles(vtSession* session, vtBenchCase* measured, vtBenchRow* row, vtError* error)
{
    vtMesh* mesh = &session->input.scene.meshes[0];
    vtError reason = {0};
    const double start = vtNow();
    vtResult result = vtTriangulateRelief(mesh, &reason);
    if (result == vt_ok) {
        row->triangulation = vtNow() - start;
        row->hostBytes = hostBytes(mesh);
        measured->triangles = measured->meshTriangles = (int)(mesh->indexCount / 3);
        result = vtRenderer_SetScene(session->renderer, &session->input.scene, &reason);
    }
    if (result == vt_ok) {
        result = vtBench_Probe(session, row, error);
        measured->upload = row->upload;
        measured->meshBytes = row->meshBytes;
        row->glassBytes = row->meshBytes;
        return result;
    }
    if (result != vt_errorMemory && result != vt_errorContext && result != vt_errorGeometry) {
        return vtFail(error, result, "%s", reason.message);
    }
    snprintf(row->absent, sizeof row->absent, "%.500s", reason.message);
    fprintf(stderr, "vitrine: note: %s is left out: %s\n", row->id, row->absent);
    return vt_ok;
}

/// *reference NULL: the triangles and what is built over them are more than half of the memory.
static vtResult createReference(const vtSession* session, vtBenchCase* measured, vtReference** reference,
                                vtError* error)
{
    const vtMesh* mesh = &session->input.scene.meshes[0];
    const double memory = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    const double needed = tracedTriangleBytes * (double)(mesh->indexCount / 3);
    if (mesh->indexCount == 0) {
        snprintf(measured->untraced, sizeof measured->untraced, "there are no triangles");
        return vt_ok;
    }
    if (needed > 0.5 * memory) {
        snprintf(measured->untraced, sizeof measured->untraced,
                 "it would take about %.1f GB of the machine's %.1f GB", needed / 1e9, memory / 1e9);
        return vt_ok;
    }
    const double start = vtNow();
    const vtResult result = vtCreateReference(&session->input.scene, reference, error);
    measured->tracerBuild = vtNow() - start;
    return result;
}

/// A technique's picture and directions.
typedef struct Drawing {
    uint8_t* pixels;
    float* directions;
} Drawing;

static vtResult draw(vtSession* session, const vtFrame* frame, Drawing* drawing, vtError* error)
{
    const size_t count = (size_t)frame->width * (size_t)frame->height;
    drawing->pixels = malloc(4 * count);
    drawing->directions = malloc(3 * sizeof(float) * count);
    if (drawing->pixels == NULL || drawing->directions == NULL) {
        return vtFail(error, vt_errorMemory, "bench: out of memory for %d x %d", frame->width, frame->height);
    }
    const vtResult result = vtRenderer_DrawImage(session->renderer, frame, drawing->pixels, error);
    return result == vt_ok ? vtRenderer_ReadDirections(session->renderer, drawing->directions, error)
                           : result;
}

/// How far the two techniques draw the same.
static vtResult measureAgreement(vtSession* session, vtBenchCase* measured, vtError* error)
{
    const vtFrame* frame = &measured->rows[0].frame;
    const size_t count = (size_t)frame->width * (size_t)frame->height;
    Drawing drawings[2] = {0};
    vtPictureError picture = {0};
    vtResult result = vt_ok;
    for (int i = 0; i < 2 && result == vt_ok; ++i) {
        result = draw(session, &measured->rows[i].frame, &drawings[i], error);
    }
    for (int i = 0; i < 2 && result == vt_ok; ++i) {
        result = vtCompareDirections(drawings[i].directions, drawings[1 - i].directions, count,
                                     &measured->rows[i].agreement, error);
    }
    if (result == vt_ok) {
        result = vtComparePictureBytes(drawings[0].pixels, drawings[1].pixels, 4, frame->width, frame->height,
                                       &picture, NULL, error);
    }
    measured->flip = picture.flip;
    for (int i = 0; i < 2; ++i) {
        free(drawings[i].pixels);
        free(drawings[i].directions);
    }
    return result;
}

vtResult vtBench_MeasureRelief(const vtOptions* options, vtSession* session, const vtBench* bench,
                               vtBenchCase* measured, vtError* error)
{
    vtReference* reference = NULL;
    measured->samples = session->input.scene.meshes[0].heights->width;
    vtResult result = probeHeights(session, &measured->rows[0], error);
    if (result == vt_ok) {
        result = probeTriangles(session, measured, &measured->rows[1], error);
    }
    if (result == vt_ok) {
        result = createReference(session, measured, &reference, error);
    }
    if (result == vt_ok) {
        result = vtBench_Compare(options, session, reference, bench, measured, error);
    }
    if (result == vt_ok && measured->rows[1].absent[0] == '\0') {
        result = measureAgreement(session, measured, error);
    }
    vtDestroyReference(reference);
    return result;
}
