// Pictures of the reference: pixels in tiles, tiles shared out among threads.
#include <assert.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/math.h"
#include "lab/reference/reference.h"
#include "lab/reference/reference_chance.h"
#include "lab/reference/reference_scene.h"
#include "lab/reference/reference_spectrum.h"
#include "lab/reference/reference_threads.h"
#include "light/backdrop.h"
#include "scene/camera.h"
#include "scene/material.h"

enum { tileSide = 16 };

/// One picture under work, shared by the threads; only nextTile and failed change.
typedef struct Job {
    const vtReference* reference;
    const vtReferenceDef* def;
    vtReferenceImage* image;
    vtCamera camera;
    int samples;
    float exposure; ///< factor
    vtPathRules rules;
    vtMedia eyeMedia;    ///< what the eye is within
    vtLighting lighting; ///< of surfaces that are matt or rough
    vtIllumination illumination;
    vtSun sun;            ///< over the ground
    vtSpectrum* spectrum; ///< NULL: glass does not disperse, or there is one sample only
    bool isRough;         ///< something is, or glass disperses
    vtGroundMap ground;   ///< its light NULL: there is none
    vtCausticMap caustics;
    vtBackdropPlace backdrop; ///< where there is one
    int tileColumns, tileCount;
    atomic_int nextTile;
    atomic_bool failed; ///< memory is short
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

/// The path of the eye ray through (x, y) in pixels from the picture's upper left corner.
static vtReferencePath makeEyePath(const Job* job, float x, float y, uint32_t index)
{
    const vtCamera* camera = &job->camera;
    const float right = (x / (float)job->image->width * 2.0f - 1.0f) * camera->high[0];
    const float up = (1.0f - y / (float)job->image->height * 2.0f) * camera->high[1];
    if (camera->orthographic) {
        const vtVec3 eye = vtMulAdd(vtMulAdd(camera->eye, right, camera->right), up, camera->up);
        return vtMakePath(eye, camera->forward, job->eyeMedia, index);
    }
    const vtVec3 direction = vtMulAdd(camera->forward, right, camera->right);
    return vtMakePath(camera->eye, vtNormalize(vtMulAdd(direction, up, camera->up)), job->eyeMedia, index);
}

static size_t pixelIndex(const Job* job, int column, int row)
{
    return (size_t)row * (size_t)job->image->width + (size_t)column;
}

// ----------------------------------------------------------------------------------------- pixel centres

static void storePath(vtReferenceImage* image, size_t pixel, const vtReferencePath* path)
{
    vtVec3 d = path->direction;
    if (path->events == 0 && !path->throughWall && path->state != VT_PATH_LOST) {
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

/// The pixel centres' own paths without Fresnel reflection.
static bool traceCentres(const Job* job, const Tile* tile, vtPathList* list)
{
    vtPathRules rules = job->rules;
    rules.fresnel = false;
    rules.illumination = job->image->radiance != NULL ? rules.illumination : NULL;
    vtPathList_Clear(list);
    for (int row = tile->firstRow; row < tile->lastRow; ++row) {
        for (int column = tile->firstColumn; column < tile->lastColumn; ++column) {
            const vtReferencePath path =
                makeEyePath(job, (float)column + 0.5f, (float)row + 0.5f, list->count);
            if (!vtPathList_Add(list, &path)) {
                return false;
            }
        }
    }
    if (!vtFollowPaths(job->reference, &rules, list)) {
        return false;
    }
    const vtReferencePath* path = list->paths;
    for (int row = tile->firstRow; row < tile->lastRow; ++row) {
        for (int column = tile->firstColumn; column < tile->lastColumn; ++column, ++path) {
            storePath(job->image, pixelIndex(job, column, row), path);
        }
    }
    return true;
}

// ----------------------------------------------------------------------------------------------- samples

/// Sample number `index` of each pixel, where the renderer has it.
static bool followSamples(const Job* job, const Tile* tile, int index, vtPathList* list)
{
    vtPathRules rules = job->rules;
    rules.chance = true;
    rules.sample = (uint32_t)index;
    float x, y;
    vtPixelSample(index, &x, &y);
    vtPathList_Clear(list);
    for (int row = tile->firstRow; row < tile->lastRow; ++row) {
        for (int column = tile->firstColumn; column < tile->lastColumn; ++column) {
            vtReferencePath path =
                makeEyePath(job, (float)column + 0.5f + x, (float)row + 0.5f - y, list->count);
            path.key = vtMixWords((uint32_t)pixelIndex(job, column, row), 0);
            if (!vtPathList_Add(list, &path)) {
                return false;
            }
        }
    }
    return vtFollowPaths(job->reference, &rules, list);
}

/// What a path brings to the eye.
static vtVec3 lightOf(const Job* job, const vtReferencePath* path)
{
    vtVec3 light = path->light;
    if (path->state != VT_PATH_OPAQUE) { // all that comes from there is in it
        vtVec3 end = vtEnvironment_Sample(job->def->environment, path->direction);
        if (job->def->backdrop != NULL) {
            end = vtScale(vtBackdrop_Light(&job->backdrop, job->def->backdropPicture, path->origin,
                                           path->direction, vtScale(end, job->exposure)),
                          1.0f / job->exposure); // exposure is not for it
        }
        if (job->ground.light != NULL) {
            end = vtGroundMap_Light(&job->ground, path->origin, path->direction, end);
        }
        light =
            vtAdd(light, (vtVec3){end.x * path->weight.x, end.y * path->weight.y, end.z * path->weight.z});
    }
    return vtScale(light, job->exposure);
}

/// What the ground brings of a path from the eye that meets nothing, where another background lies behind.
static vtVec3 overBackground(const Job* job, const vtReferencePath* path, float* covered)
{
    const vtVec3 beyond = vtEnvironment_Sample(job->def->environment, path->direction);
    const vtVec3 light = vtGroundMap_Light(&job->ground, path->origin, path->direction, beyond);
    return vtScale(vtGroundMap_Over(&job->ground, path->origin, path->direction, light, covered),
                   job->exposure);
}

/// Adds a sample of each of the tile's pixels: the light of all paths that branch off from one at the eye.
static void addSamples(const Job* job, const Tile* tile, const vtPathList* list)
{
    vtVec3 sums[tileSide * tileSide] = {{0}};
    float covered[tileSide * tileSide] = {0};
    for (uint32_t i = 0; i < list->count; ++i) {
        const vtReferencePath* path = &list->paths[i];
        vtVec3 light = {0.0f, 0.0f, 0.0f};
        float cover = 0.0f;
        if (job->image->covered == NULL || path->state != VT_PATH_BACKGROUND || path->passes > 0) {
            light = lightOf(job, path);
            cover = 1.0f;
        } else if (job->ground.light != NULL) {
            light = overBackground(job, path, &cover);
        }
        sums[path->source] = vtAdd(sums[path->source], light);
        covered[path->source] = fmaxf(covered[path->source], cover);
    }
    const float share = 1.0f / (float)job->samples;
    const vtVec3* sum = sums;
    for (int row = tile->firstRow; row < tile->lastRow; ++row) {
        for (int column = tile->firstColumn; column < tile->lastColumn; ++column, ++sum) {
            // Only their mean is cut to what a display can show: what is found by chance is seldom, and
            // bright.
            const size_t index = pixelIndex(job, column, row);
            float* pixel = job->image->radiance + 3 * index;
            if (job->image->covered != NULL) {
                job->image->covered[index] += share * covered[sum - sums];
            }
            pixel[0] += sum->x * share;
            pixel[1] += sum->y * share;
            pixel[2] += sum->z * share;
        }
    }
}

static bool traceTile(const Job* job, const Tile* tile, vtPathList* list)
{
    const bool onlyPicture = job->def->onlyPicture;
    if (!onlyPicture && !traceCentres(job, tile, list)) {
        return false;
    }
    if (job->image->radiance == NULL) {
        return true;
    }
    // Where one sample is asked for the centres' paths are it, unless there are more than these.
    const bool again = onlyPicture || job->samples > 1 || job->rules.fresnel || job->isRough;
    for (int sample = 0; sample < job->samples; ++sample) {
        if (again && !followSamples(job, tile, sample, list)) {
            return false;
        }
        addSamples(job, tile, list);
    }
    return true;
}

// ----------------------------------------------------------------------------------------------- threads

/// Takes tiles until none are left. Only the calling thread reports.
static void work(Job* job, bool reports)
{
    vtPathList list = {0};
    for (int index = atomic_fetch_add(&job->nextTile, 1); index < job->tileCount;
         index = atomic_fetch_add(&job->nextTile, 1)) {
        const Tile tile = makeTile(job, index);
        if (atomic_load(&job->failed) || !traceTile(job, &tile, &list)) {
            atomic_store(&job->failed, true);
            break;
        }
        if (reports && job->def->progress != NULL) {
            job->def->progress((float)index / (float)job->tileCount, job->def->userData);
        }
    }
    vtDestroyPathList(&list);
}

static void* runThread(void* job)
{
    work(job, false);
    return NULL;
}

static void runJob(Job* job)
{
    vtThreads threads;
    vtStartThreads(&threads, job->def->threads, runThread, job);
    work(job, true);
    vtJoinThreads(&threads);
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
    vtResult result = def->ground != NULL ? vtValidateGround(def->ground, error) : vt_ok;
    if (result == vt_ok && def->backdrop != NULL) {
        result = vtValidateBackdrop(def->backdrop, error);
    }
    return result == vt_ok ? vtValidateFrame(def->frame, error) : result;
}

static vtResult createImage(const vtReferenceDef* def, vtReferenceImage* image, vtError* error)
{
    const size_t count = (size_t)def->frame->width * (size_t)def->frame->height;
    const bool centres = !def->onlyPicture;
    const bool hasBackground = def->environment != NULL && def->frame->background != vt_backgroundEnvironment;
    *image = (vtReferenceImage){
        .width = def->frame->width,
        .height = def->frame->height,
        .directions = centres ? malloc(3 * sizeof(float) * count) : NULL,
        .events = centres ? malloc(count) : NULL,
        .states = centres ? malloc(count) : NULL,
        .reflections = centres ? malloc(count) : NULL,
        .radiance = def->environment != NULL ? calloc(3 * count, sizeof(float)) : NULL,
        .covered = hasBackground ? calloc(count, sizeof(float)) : NULL,
    };
    const bool hasCentres = image->directions != NULL && image->events != NULL && image->states != NULL &&
                            image->reflections != NULL;
    if ((centres && !hasCentres) || (def->environment != NULL && image->radiance == NULL) ||
        (hasBackground && image->covered == NULL)) {
        vtDestroyReferenceImage(image);
        return vtFail(error, vt_errorMemory, "reference: out of memory for %d x %d", def->frame->width,
                      def->frame->height);
    }
    return vtSucceed(error);
}

/// Objects of glass that contain the eye. Where there are too many, those of lowest precedence are left out.
static vtMedia findEyeMedia(const vtReference* reference, vtVec3 eye)
{
    vtMedia media = {{0}};
    for (uint32_t i = 0; i < reference->glassCount; ++i) {
        if (!reference->objects[i].thin && vtPlacedObject_Contains(&reference->objects[i], eye)) {
            vtMedia_Toggle(&media, reference->objects[i].body + 1);
        }
    }
    return media;
}

/// Does glass disperse? *isRough: does it, or is it rough?
static bool findGlass(const vtReference* reference, const vtFrame* frame, bool* isRough)
{
    bool disperses = false, rough = false;
    for (uint32_t i = 0; i < reference->glassCount; ++i) {
        const vtMaterial* material = reference->objects[i].material;
        disperses |= vtMaterial_Dispersion(material, frame->dispersion) > 0.0f;
        rough |= vtMaterial_Roughness(material, frame->roughness) > 0.0f;
    }
    *isRough = rough || disperses;
    return disperses;
}

vtResult vtReference_Trace(const vtReference* reference, const vtReferenceDef* def, vtReferenceImage* image,
                           vtError* error)
{
    assert(reference != NULL && def != NULL && def->frame != NULL && image != NULL);
    assert(def->environment != NULL || !def->onlyPicture);
    *image = (vtReferenceImage){0};
    vtLighting lighting = {0};
    vtResult result = checkDef(def, error);
    const bool hasOpaque = reference->glassCount < reference->objectCount;
    vtSun sun = {0}, found = {0};
    if (result == vt_ok && def->ground != NULL && def->environment != NULL && hasOpaque) {
        result = vtFindSun(def->environment, &found)
                     ? vt_ok
                     : vtFail(error, vt_errorMemory, "reference: out of memory");
        sun = vtGivenSun(def->ground, &found);
    }
    if (result == vt_ok && def->environment != NULL && (hasOpaque || vtScene_HasLooks(reference->scene))) {
        result = vtCreateLighting(def->environment, vtSun_IsThere(&found) ? &found : NULL, &lighting, error);
    }
    if (result == vt_ok) {
        result = createImage(def, image, error);
    }
    if (result != vt_ok) {
        vtDestroyLighting(&lighting);
        return result;
    }
    const vtFrame* frame = def->frame;
    const int tileColumns = (frame->width + tileSide - 1) / tileSide;
    const int tileRows = (frame->height + tileSide - 1) / tileSide;
    Job job = {
        .reference = reference,
        .def = def,
        .image = image,
        .camera = vtMakeCamera(frame),
        .samples = def->samples > 1 ? def->samples : 1,
        .exposure = exp2f(frame->exposure),
        .rules = {.ior = frame->ior,
                  .maxEvents = vtResolveFrame(frame).maxEvents,
                  .fresnel = def->fresnel,
                  .exposure = exp2f(frame->exposure),
                  .roughness = frame->roughness,
                  .dispersion = frame->dispersion},
        .lighting = lighting,
        .illumination = {NULL, reference->lights, reference->scene->lightCount, NULL},
        .sun = sun,
        .tileColumns = tileColumns,
        .tileCount = tileColumns * tileRows,
    };
    vtCamera_Enter(&job.camera, &reference->space);
    if (!job.camera.orthographic) { // its eyes are taken to be in the air
        job.eyeMedia = findEyeMedia(reference, job.camera.eye);
    }
    job.illumination.lighting = &job.lighting;
    job.illumination.sun = vtSun_IsThere(&sun) ? &job.sun : NULL;
    job.rules.illumination = lighting.specular != NULL ? &job.illumination : NULL;
    atomic_init(&job.nextTile, 0);
    atomic_init(&job.failed, false);
    const bool disperses = findGlass(reference, frame, &job.isRough);
    const bool hasGround = def->ground != NULL && def->environment != NULL;
    const bool parts = disperses && (job.samples > 1 || hasGround);
    job.spectrum = parts ? malloc(sizeof *job.spectrum) : NULL;
    atomic_store(&job.failed, parts && job.spectrum == NULL);
    if (job.spectrum != NULL) {
        vtMakeSpectrum(job.spectrum);
        job.rules.spectrum = job.spectrum;
    }
    if (def->backdrop != NULL) {
        vtVec3 low, high;
        vtScene_Bounds(reference->scene, &low, &high);
        job.backdrop =
            vtPlaceBackdrop(def->backdrop, def->backdropPicture->width, def->backdropPicture->height, frame,
                            &job.camera, vtSpace_Enter(&reference->space, low),
                            vtSpace_Enter(&reference->space, high), reference->space.unit);
    }
    if (hasGround) {
        vtPathRules photons = job.rules;
        photons.chance = job.isRough; // or glass disperses
        result = vtReference_LightGround(reference, &photons, def->ground, def->environment, def->threads,
                                         &job.ground, &job.caustics, error);
        job.rules.caustics = &job.caustics;
    }
    if (result == vt_ok) {
        runJob(&job);
    }
    free(job.spectrum);
    vtDestroyLighting(&lighting);
    vtDestroyGroundMap(&job.ground);
    vtDestroyCausticMap(&job.caustics);
    if (result != vt_ok) {
        vtDestroyReferenceImage(image);
        return result;
    }
    if (atomic_load(&job.failed)) {
        vtDestroyReferenceImage(image);
        return vtFail(error, vt_errorMemory, "reference: out of memory for paths");
    }
    return vt_ok;
}
