// The light on the ground below the reference's scene: all parts of every photon's light are followed, and
// there are more of them than the renderer has. The sources: src/light/ground.c. Chance decides about
// facets and wavelengths alone.
#include <float.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "base/error.h"
#include "lab/reference/reference_chance.h"
#include "lab/reference/reference_place.h"
#include "lab/reference/reference_threads.h"
#include "mesh/mesh_triangle.h"

/// Rays along a side of their square.
enum { shadeAcross = 1024, sunPhotons = 1536, skyPhotons = 768, seed = 0x1e3779b9 };

/// Photons in a column whose chances are spread evenly.
enum { strip = 64 };

/// The rays of one light of one kind, row by row.
typedef struct GroundJob {
    const vtReference* reference;
    const vtPathRules* rules;
    vtGroundPlan* plan;
    vtCaustics* caustics;
    int source;
    vtGroundRays rays;
    int across;
    pthread_mutex_t lock; ///< of the plan's sums
    atomic_int nextRow;
    atomic_bool failed; ///< memory is short
} GroundJob;

static vtGroundRay rayOf(const GroundJob* job, int x, int y)
{
    return vtGroundPlan_Ray(job->plan, job->source, job->rays, x, y, job->across, (uint32_t)seed);
}

/// Adds what came of a path that ends on something opaque; the sky lights that without shadows.
static void addOpaque(GroundJob* job, const vtReferencePath* path, int row)
{
    if (job->source == vt_groundSky) {
        return;
    }
    const vtGroundRay ray = rayOf(job, (int)path->source, row);
    const float share = ray.area / ((float)job->across * (float)job->across);
    const vtVec3 G = vtTriangleNormal(&job->reference->objects[path->end.object], &path->end);
    const vtCausticHit hit = {.object = path->end.object,
                              .triangle = path->end.triangle,
                              .u = path->end.u,
                              .v = path->end.v,
                              .behind = vtDot(G, path->direction) > 0.0f,
                              .flux = vtScale(vtMultiply(ray.color, path->weight), share)};
    if (!vtCaustics_Add(job->caustics, &hit)) {
        atomic_store(&job->failed, true);
    }
}

/// Adds what came of a path; those that went past everything are no photons' matter.
static void addPath(GroundJob* job, const vtReferencePath* path, int row)
{
    const bool isOut = path->state == VT_PATH_EXITED || path->state == VT_PATH_BACKGROUND;
    const bool isMet = path->events > 0 || path->passes > 0;
    if (isMet && path->state == VT_PATH_OPAQUE) {
        addOpaque(job, path, row);
    }
    if (!isOut || !isMet || path->direction.y > -1e-6f) {
        return;
    }
    const float above = fmaxf(path->origin.y - job->plan->height, 0.0f);
    const vtVec3 at = vtMulAdd(path->origin, above / -path->direction.y, path->direction);
    const vtGroundRay ray = rayOf(job, (int)path->source, row);
    vtGroundPlan_AddPhoton(job->plan, job->source, &ray, at.x, at.z, path->weight, job->across);
}

static bool followPhotons(GroundJob* job, int row, vtPathList* list)
{
    vtPathRules rules = *job->rules;
    rules.sample = (uint32_t)row % strip;
    if (!vtFollowPaths(job->reference, &rules, list)) {
        return false;
    }
    pthread_mutex_lock(&job->lock);
    for (uint32_t i = 0; i < list->count; ++i) {
        addPath(job, &list->paths[i], row);
    }
    pthread_mutex_unlock(&job->lock);
    return true;
}

static void followShade(GroundJob* job, int row, const vtPathList* list)
{
    for (uint32_t at = 0; at < list->count; at += VT_PACKET) {
        const int count = list->count - at < VT_PACKET ? (int)(list->count - at) : VT_PACKET;
        uint32_t numbers[VT_PACKET];
        vtMeeting meetings[VT_PACKET];
        for (int lane = 0; lane < count; ++lane) {
            numbers[lane] = at + (uint32_t)lane;
        }
        vtReference_Meet(job->reference, list->paths, numbers, count, true, meetings);
        pthread_mutex_lock(&job->lock);
        for (int lane = 0; lane < count; ++lane) {
            const int x = (int)numbers[lane];
            const vtGroundRay ray = rayOf(job, x, row);
            const bool isLit = fminf(meetings[lane].nearest, meetings[lane].opaque.distance) >= ray.length;
            vtGroundPlan_AddShade(job->plan, job->source, &ray, x, row, job->across, isLit);
        }
        pthread_mutex_unlock(&job->lock);
    }
}

static void* workGround(void* data)
{
    GroundJob* job = data;
    vtPathList list = {0};
    for (int row = atomic_fetch_add(&job->nextRow, 1); row < job->across;
         row = atomic_fetch_add(&job->nextRow, 1)) {
        bool ready = !atomic_load(&job->failed);
        vtPathList_Clear(&list);
        for (int x = 0; x < job->across && ready; ++x) {
            const vtGroundRay ray = rayOf(job, x, row);
            vtReferencePath path = vtMakePath(ray.origin, ray.direction, (vtMedia){{0}}, (uint32_t)x);
            path.key = vtMixWords((uint32_t)x, (uint32_t)(row / strip));
            ready = vtPathList_Add(&list, &path);
        }
        if (ready && job->rays == vt_groundShade) {
            followShade(job, row, &list);
        } else {
            ready = ready && followPhotons(job, row, &list);
        }
        if (!ready) {
            atomic_store(&job->failed, true);
            break;
        }
    }
    vtDestroyPathList(&list);
    return NULL;
}

static bool followRays(const vtReference* reference, const vtPathRules* rules, int threads,
                       vtGroundPlan* plan, vtCaustics* caustics, int source, vtGroundRays rays)
{
    GroundJob job = {.reference = reference,
                     .rules = rules,
                     .plan = plan,
                     .caustics = caustics,
                     .source = source,
                     .rays = rays,
                     .across = vtGroundPlan_Across(plan, source, rays,
                                                   rays == vt_groundShade   ? shadeAcross
                                                   : source == vt_groundSky ? skyPhotons
                                                                            : sunPhotons)};
    atomic_init(&job.nextRow, 0);
    atomic_init(&job.failed, false);
    if (pthread_mutex_init(&job.lock, NULL) != 0) {
        return false;
    }
    vtThreads others;
    vtStartThreads(&others, threads, workGround, &job);
    workGround(&job);
    vtJoinThreads(&others);
    pthread_mutex_destroy(&job.lock);
    return !atomic_load(&job.failed);
}

static void extend(vtVec3* low, vtVec3* high, const vtPlacedObject* object)
{
    *low = (vtVec3){fminf(low->x, object->low.x), fminf(low->y, object->low.y), fminf(low->z, object->low.z)};
    *high = (vtVec3){fmaxf(high->x, object->high.x), fmaxf(high->y, object->high.y),
                     fmaxf(high->z, object->high.z)};
}

/// Where surfaces let a part of the light pass that is opaque, all of them are photons' matter.
static vtGroundScene describeScene(const vtReference* reference)
{
    const vtVec3 most = {INFINITY, INFINITY, INFINITY}, least = {-INFINITY, -INFINITY, -INFINITY};
    const bool all = vtScene_HasLooks(reference->scene);
    vtGroundScene described = {
        reference->space, most, least, most, least, reference->lights, reference->scene->lightCount};
    for (uint32_t i = 0; i < reference->objectCount; ++i) {
        const vtPlacedObject* object = &reference->objects[i];
        extend(&described.low, &described.high, object);
        if (all || i < reference->glassCount) {
            extend(&described.glassLow, &described.glassHigh, object);
        }
    }
    return described;
}

static void cornersOf(const void* data, uint32_t object, uint32_t triangle, vtVec3 p[3])
{
    const vtPlacedObject* placed = &((const vtReference*)data)->objects[object];
    vtPlacedObject_Corners(placed, triangle, p);
    for (int k = 0; k < 3; ++k) {
        p[k] = vtTransformPoint(&placed->toWorld, p[k]);
    }
}

vtResult vtReference_LightGround(const vtReference* reference, const vtPathRules* rules,
                                 const vtGround* ground, const vtEnvironment* environment, int threads,
                                 vtGroundMap* map, vtCausticMap* caustics, vtError* error)
{
    *map = (vtGroundMap){0};
    *caustics = (vtCausticMap){0};
    vtCaustics photons = {0};
    const vtGroundScene scene = describeScene(reference);
    vtGroundPlan plan;
    vtResult result = vtPlanGround(ground, environment, &scene, &plan, error);
    if (result != vt_ok) {
        return result;
    }
    vtPathRules dark = *rules;
    dark.illumination = NULL; // what surfaces send is not looked at
    bool ready = true;
    for (int source = 0; source < plan.sourceCount && ready; ++source) {
        if (vtGroundPlan_IsDark(&plan, source)) {
            continue;
        }
        ready = followRays(reference, &dark, threads, &plan, &photons, source, vt_groundShade);
        vtGroundPlan_EndShade(&plan, source);
        if (ready && plan.hasGlass) {
            ready = followRays(reference, &dark, threads, &plan, &photons, source, vt_groundPhotons);
        }
    }
    const float spacing = fmaxf(vtLength(vtSub(plan.glassHigh, plan.glassLow)) / 300.0f, FLT_MIN);
    ready = ready && vtCaustics_Gather(&photons, spacing, &(vtCornersOf){cornersOf, reference}, caustics);
    result = ready ? vtGroundPlan_Finish(&plan, map, error)
                   : vtFail(error, vt_errorMemory, "ground: out of memory for photons");
    vtDestroyCaustics(&photons);
    vtDestroyGroundPlan(&plan);
    return result;
}
