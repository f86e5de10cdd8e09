// The light on the ground below the reference's scene: all parts of every photon's light are followed,
// without chance, and there are more of them than the renderer has. The sources: src/light/ground.c.
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "base/error.h"
#include "lab/reference/reference_scene.h"
#include "lab/reference/reference_threads.h"

/// Rays along a side of their square.
enum { shadeAcross = 1024, sunPhotons = 1536, skyPhotons = 768, seed = 0x1e3779b9 };

/// The rays of one light of one kind, row by row.
typedef struct GroundJob {
    const vtReference* reference;
    const vtPathRules* rules;
    vtGroundPlan* plan;
    vtGroundLight light;
    vtGroundRays rays;
    int across;
    pthread_mutex_t lock; ///< of the plan's sums
    atomic_int nextRow;
    atomic_bool failed; ///< memory is short
} GroundJob;

static vtGroundRay rayOf(const GroundJob* job, int x, int y)
{
    return vtGroundPlan_Ray(job->plan, job->light, job->rays, x, y, job->across, (uint32_t)seed);
}

/// Adds what came of a path; those that went past everything are no photons' matter.
static void addPath(const GroundJob* job, const vtReferencePath* path, int row)
{
    const bool isOut = path->state == VT_PATH_EXITED || path->state == VT_PATH_BACKGROUND;
    const bool isMet = path->events > 0 || path->passes > 0;
    if (!isOut || !isMet || path->direction.y > -1e-6f) {
        return;
    }
    const float above = fmaxf(path->origin.y - job->plan->height, 0.0f);
    const vtVec3 at = vtMulAdd(path->origin, above / -path->direction.y, path->direction);
    const vtGroundRay ray = rayOf(job, (int)path->source, row);
    vtGroundPlan_AddPhoton(job->plan, job->light, &ray, at.x, at.z, path->weight, job->across);
}

static bool followPhotons(GroundJob* job, int row, vtPathList* list)
{
    if (!vtFollowPaths(job->reference, job->rules, list)) {
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
            if (meetings[lane].glassCount == 0 && meetings[lane].opaque.triangle == VT_NO_TRIANGLE) {
                const int x = (int)numbers[lane];
                const vtGroundRay ray = rayOf(job, x, row);
                vtGroundPlan_AddLit(job->plan, job->light, &ray, x, row, job->across);
            }
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
            const vtReferencePath path = vtMakePath(ray.origin, ray.direction, (vtMedia){{0}}, (uint32_t)x);
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
                       vtGroundPlan* plan, vtGroundLight light, vtGroundRays rays)
{
    GroundJob job = {.reference = reference,
                     .rules = rules,
                     .plan = plan,
                     .light = light,
                     .rays = rays,
                     .across = rays == vt_groundShade  ? shadeAcross
                               : light == vt_groundSun ? sunPhotons
                                                       : skyPhotons};
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

/// Boxes of the scene and of its glass; where surfaces let a part of the light pass that is opaque, all of
/// them are photons' matter.
static void boundObjects(const vtReference* reference, vtVec3 whole[2], vtVec3 glass[2])
{
    const vtVec3 most = {INFINITY, INFINITY, INFINITY}, least = {-INFINITY, -INFINITY, -INFINITY};
    const bool all = vtScene_HasLooks(reference->scene);
    whole[0] = glass[0] = most;
    whole[1] = glass[1] = least;
    for (uint32_t i = 0; i < reference->objectCount; ++i) {
        const vtPlacedObject* object = &reference->objects[i];
        for (int box = 0; box < 2; ++box) {
            vtVec3* bounds = box == 0 ? whole : glass;
            if (box == 0 || all || i < reference->glassCount) {
                bounds[0] = (vtVec3){fminf(bounds[0].x, object->low.x), fminf(bounds[0].y, object->low.y),
                                     fminf(bounds[0].z, object->low.z)};
                bounds[1] = (vtVec3){fmaxf(bounds[1].x, object->high.x), fmaxf(bounds[1].y, object->high.y),
                                     fmaxf(bounds[1].z, object->high.z)};
            }
        }
    }
}

vtResult vtReference_LightGround(const vtReference* reference, const vtPathRules* rules,
                                 const vtGround* ground, const vtEnvironment* environment, int threads,
                                 vtGroundMap* map, vtError* error)
{
    *map = (vtGroundMap){0};
    vtVec3 whole[2], glass[2];
    boundObjects(reference, whole, glass);
    vtGroundPlan plan;
    vtResult result = vtPlanGround(ground, environment, whole, glass, &plan, error);
    if (result != vt_ok) {
        return result;
    }
    vtPathRules dark = *rules;
    dark.illumination = NULL; // what surfaces send is not looked at
    bool ready = true;
    for (int light = 0; light < vt_groundLightCount && ready; ++light) {
        const vtVec3 irradiance = plan.irradiance[light];
        if (irradiance.x + irradiance.y + irradiance.z <= 0.0f) {
            continue;
        }
        ready = followRays(reference, &dark, threads, &plan, (vtGroundLight)light, vt_groundShade) &&
                (!plan.hasGlass ||
                 followRays(reference, &dark, threads, &plan, (vtGroundLight)light, vt_groundPhotons));
    }
    result = ready ? vtGroundPlan_Finish(&plan, map, error)
                   : vtFail(error, vt_errorMemory, "ground: out of memory for photons");
    vtDestroyGroundPlan(&plan);
    return result;
}
