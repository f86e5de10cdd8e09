// Pictures of the reference: pixels in tiles, tiles shared out among threads.
#include <assert.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/error.h"
#include "base/math.h"
#include "reference.h"
#include "reference_scene.h"
#include "scene/camera.h"

enum {
    tileSide = 16, // tileSide * tileSide is VT_PATH_BATCH
};
_Static_assert(tileSide* tileSide == VT_PATH_BATCH, "a tile is one batch of paths");

/// One picture under work, shared by the threads; only nextTile changes.
typedef struct Job {
    const vtReference* reference;
    const vtReferenceDef* def;
    vtReferenceImage* image;
    vtCameraFrame camera;
    float tangentX, tangentY; ///< of half the field of view
    int samples;
    float exposure; ///< factor
    int tileColumns, tileCount;
    atomic_int nextTile;
} Job;

/// Pixels first..last-1, cut at the picture's edge.
typedef struct Tile {
    int firstColumn, lastColumn, firstRow, lastRow;
} Tile;

static Tile makeTile(const Job* job, int index)
{
    const int column = index % job->tileColumns * tileSide, row = index / job->tileColumns * tileSide;
    const int width = job->image->width, height = job->image->height;
    return (Tile){column, column + tileSide < width ? column + tileSide : width, row,
                  row + tileSide < height ? row + tileSide : height};
}

/// The eye ray through (x, y) in pixels from the picture's upper left corner.
static vtVec3 eyeDirection(const Job* job, float x, float y)
{
    const float right = (x / (float)job->image->width * 2.0f - 1.0f) * job->tangentX;
    const float up = (1.0f - y / (float)job->image->height * 2.0f) * job->tangentY;
    const vtVec3 direction = vtMulAdd(job->camera.forward, right, job->camera.right);
    return vtNormalize(vtMulAdd(direction, up, job->camera.up));
}

static size_t pixelIndex(const Job* job, int column, int row)
{
    return (size_t)row * (size_t)job->image->width + (size_t)column;
}

// ----------------------------------------------------------------------------------------- pixel centres

static void storePath(vtReferenceImage* image, size_t pixel, const vtReferencePath* path)
{
    vtVec3 d = path->direction;
    if (path->state == VT_PATH_BACKGROUND) {
        d = (vtVec3){0.0f, 0.0f, 0.0f};
    } else if (path->state == VT_PATH_LOST) {
        d = (vtVec3){2.0f, 2.0f, 2.0f};
    }
    image->directions[3 * pixel] = d.x;
    image->directions[3 * pixel + 1] = d.y;
    image->directions[3 * pixel + 2] = d.z;
    image->events[pixel] = path->events;
    image->states[pixel] = path->state;
    image->reflections[pixel] = path->reflected;
}

static void addRadiance(const Job* job, size_t pixel, vtVec3 direction)
{
    vtVec3 light = vtScale(vtEnvironment_Sample(job->def->environment, direction), job->exposure);
    // As add_sample.frag does, and for its reason. But what a path meets by chance is no part of the pixel:
    // of a lamp that is reflected by one path in twenty, all light must count.
    if (job->samples > 1 && !job->def->fresnel) {
        light = (vtVec3){fminf(light.x, 1.0f), fminf(light.y, 1.0f), fminf(light.z, 1.0f)};
    }
    const float share = 1.0f / (float)job->samples;
    float* sum = job->image->radiance + 3 * pixel;
    sum[0] += light.x * share;
    sum[1] += light.y * share;
    sum[2] += light.z * share;
}

/// The pixel centres' own paths; they are all the samples there are where one is asked for.
static void traceCentres(const Job* job, const Tile* tile)
{
    const vtPathRules rules = {job->def->frame->ior, vtResolveFrame(job->def->frame).maxEvents, false};
    const bool colour = job->image->radiance != NULL && job->samples == 1 && !job->def->fresnel;
    vtReferencePath paths[VT_PATH_BATCH];
    int count = 0;
    for (int row = tile->firstRow; row < tile->lastRow; ++row) {
        for (int column = tile->firstColumn; column < tile->lastColumn; ++column) {
            const vtVec3 direction = eyeDirection(job, (float)column + 0.5f, (float)row + 0.5f);
            paths[count++] = vtMakePath(job->camera.eye, direction, 0);
        }
    }
    vtFollowPaths(job->reference, &rules, paths, count);
    const vtReferencePath* path = paths;
    for (int row = tile->firstRow; row < tile->lastRow; ++row) {
        for (int column = tile->firstColumn; column < tile->lastColumn; ++column, ++path) {
            const size_t pixel = pixelIndex(job, column, row);
            storePath(job->image, pixel, path);
            if (colour) {
                addRadiance(job, pixel, path->direction);
            }
        }
    }
}

// ----------------------------------------------------------------------------------------------- samples

/// Sample number `index` of a pixel, where the renderer has it.
static vtReferencePath makeSample(const Job* job, int column, int row, int index)
{
    const uint32_t random = vtHash((uint32_t)pixelIndex(job, column, row) ^ vtHash((uint32_t)index));
    float x, y;
    vtPixelSample(index, &x, &y);
    const vtVec3 direction = eyeDirection(job, (float)column + 0.5f + x, (float)row + 0.5f - y);
    return vtMakePath(job->camera.eye, direction, random);
}

static void traceSamples(const Job* job, const Tile* tile, int index)
{
    const vtPathRules rules = {job->def->frame->ior, vtResolveFrame(job->def->frame).maxEvents,
                               job->def->fresnel};
    vtReferencePath paths[VT_PATH_BATCH];
    int count = 0;
    for (int row = tile->firstRow; row < tile->lastRow; ++row) {
        for (int column = tile->firstColumn; column < tile->lastColumn; ++column) {
            paths[count++] = makeSample(job, column, row, index);
        }
    }
    vtFollowPaths(job->reference, &rules, paths, count);
    const vtReferencePath* path = paths;
    for (int row = tile->firstRow; row < tile->lastRow; ++row) {
        for (int column = tile->firstColumn; column < tile->lastColumn; ++column, ++path) {
            addRadiance(job, pixelIndex(job, column, row), path->direction);
        }
    }
}

// ----------------------------------------------------------------------------------------------- threads

/// Takes tiles until none are left. Only the calling thread reports.
static void work(Job* job, bool reports)
{
    const bool sampled = job->image->radiance != NULL && (job->samples > 1 || job->def->fresnel);
    for (int index = atomic_fetch_add(&job->nextTile, 1); index < job->tileCount;
         index = atomic_fetch_add(&job->nextTile, 1)) {
        const Tile tile = makeTile(job, index);
        traceCentres(job, &tile);
        for (int sample = 0; sampled && sample < job->samples; ++sample) {
            traceSamples(job, &tile, sample);
        }
        if (reports && job->def->progress != NULL) {
            job->def->progress((float)index / (float)job->tileCount, job->def->userData);
        }
    }
}

static void* runThread(void* job)
{
    work(job, false);
    return NULL;
}

static void runJob(Job* job)
{
    const long processors = job->def->threads > 0 ? job->def->threads : sysconf(_SC_NPROCESSORS_ONLN);
    const int wanted = (int)vtClamp((float)processors, 1.0f, (float)VT_MAX_THREADS);
    pthread_t threads[VT_MAX_THREADS];
    int started = 0;
    // A thread that cannot be had is done without: the others take its tiles.
    while (started < wanted - 1 && pthread_create(&threads[started], NULL, runThread, job) == 0) {
        ++started;
    }
    work(job, true);
    while (started > 0) {
        pthread_join(threads[--started], NULL);
    }
    if (job->def->progress != NULL) {
        job->def->progress(1.0f, job->def->userData);
    }
}

// ----------------------------------------------------------------------------------------------- picture

static vtResult checkDef(const vtReferenceDef* def, vtError* error)
{
    if (def->samples < 0 || def->samples > VT_MAX_TRACED_SAMPLES) {
        return vtFail(error, vt_errorArgument, "samples is %d; it must be 0 to %d", def->samples,
                      VT_MAX_TRACED_SAMPLES);
    }
    if (def->threads < 0 || def->threads > VT_MAX_THREADS) {
        return vtFail(error, vt_errorArgument, "threads is %d; it must be 0 to %d", def->threads,
                      VT_MAX_THREADS);
    }
    return vtValidateFrame(def->frame, error);
}

static vtResult createImage(const vtReferenceDef* def, vtReferenceImage* image, vtError* error)
{
    const size_t count = (size_t)def->frame->width * (size_t)def->frame->height;
    *image = (vtReferenceImage){
        .width = def->frame->width,
        .height = def->frame->height,
        .directions = malloc(3 * sizeof(float) * count),
        .events = malloc(count),
        .states = malloc(count),
        .reflections = malloc(count),
        .radiance = def->environment != NULL ? calloc(3 * count, sizeof(float)) : NULL,
    };
    if (image->directions == NULL || image->events == NULL || image->states == NULL ||
        image->reflections == NULL || (def->environment != NULL && image->radiance == NULL)) {
        vtDestroyReferenceImage(image);
        return vtFail(error, vt_errorMemory, "reference: out of memory for %d x %d", def->frame->width,
                      def->frame->height);
    }
    return vtSucceed(error);
}

vtResult vtReference_Trace(const vtReference* reference, const vtReferenceDef* def, vtReferenceImage* image,
                           vtError* error)
{
    assert(reference != NULL && def != NULL && def->frame != NULL && image != NULL);
    *image = (vtReferenceImage){0};
    vtResult result = checkDef(def, error);
    if (result == vt_ok) {
        result = createImage(def, image, error);
    }
    if (result != vt_ok) {
        return result;
    }
    const vtFrame* frame = def->frame;
    const float tangent = tanf(frame->view.fovY * VT_PI / 360.0f);
    const int tileColumns = (frame->width + tileSide - 1) / tileSide;
    const int tileRows = (frame->height + tileSide - 1) / tileSide;
    Job job = {
        .reference = reference,
        .def = def,
        .image = image,
        .camera = vtMakeCameraFrame(&frame->view),
        .tangentX = tangent * (float)frame->width / (float)frame->height,
        .tangentY = tangent,
        .samples = def->samples > 1 ? def->samples : 1,
        .exposure = exp2f(frame->exposure),
        .tileColumns = tileColumns,
        .tileCount = tileColumns * tileRows,
    };
    atomic_init(&job.nextTile, 0);
    runJob(&job);
    return vt_ok;
}
