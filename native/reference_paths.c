// This work is based on: Turner Whitted. An Improved Illumination Model for Shaded Display. 1980, and Ingo
// Wald, Sven Woop, Carsten Benthin, Gregory Johnson, Manfred Ernst. Embree: A Kernel Framework for Efficient
// CPU Ray Tracing. 2014.
//
// Departures:
//  - A path does not branch: it refracts, or reflects where it must (total internal reflection). With
//    Fresnel reflection one of the two is chosen by chance, so the mean over many paths is Whitted's tree.
//  - Paths advance together, one event a round, and those still under way are packed anew before each round:
//    packets stay full although paths end at different times.
//  - A path does not meet the surface it starts from again: not the same triangle, and close by none that
//    faces the wrong way (a ray inside the glass meets it from behind, a ray outside from the front).
#include <math.h>

#include "base/math.h"
#include "base/optics.h"
#include "reference_scene.h"

enum { packet = 8 }; // rays that Embree takes at a time

/// Of the extent. Surfaces nearer than the first to a path's start are never looked at, which saves asking
/// again after most self-hits; surfaces of the wrong side nearer than the second are self-hits. Rounding is
/// about 1e-7; between 1e-7 and 1e-5 the first makes no difference to any pixel of the tests' models.
static const float startDistance = 1e-6f, selfDistance = 1e-4f;

vtVec3 vtReference_TriangleArea(const vtReference* reference, uint32_t triangle)
{
    const uint32_t* corners = reference->indices + 3 * (size_t)triangle;
    const vtVec3 a = vtMakeVec3(reference->positions + 3 * (size_t)corners[0]);
    const vtVec3 b = vtMakeVec3(reference->positions + 3 * (size_t)corners[1]);
    const vtVec3 c = vtMakeVec3(reference->positions + 3 * (size_t)corners[2]);
    return vtCross(vtSub(b, a), vtSub(c, a));
}

static vtVec3 interpolate(const float* values, const uint32_t* corners, float u, float v)
{
    const vtVec3 a = vtMakeVec3(values + 3 * (size_t)corners[0]);
    const vtVec3 b = vtMakeVec3(values + 3 * (size_t)corners[1]);
    const vtVec3 c = vtMakeVec3(values + 3 * (size_t)corners[2]);
    return vtMulAdd(vtMulAdd(vtScale(a, 1.0f - u - v), u, b), v, c);
}

/// The nearest surface of each active path. `coherent`: neighbours go much the same way.
static void intersect(RTCScene scene, const vtReferencePath* paths, const int* active, int count,
                      bool coherent, vtSurfaceHit* hits)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (coherent) {
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    }
    _Alignas(32) int valid[packet];
    struct RTCRayHit8 query;
    for (int first = 0; first < count; first += packet) {
        for (int lane = 0; lane < packet; ++lane) {
            valid[lane] = first + lane < count ? -1 : 0;
            const vtReferencePath* path = &paths[active[valid[lane] ? first + lane : first]];
            query.ray.org_x[lane] = path->origin.x;
            query.ray.org_y[lane] = path->origin.y;
            query.ray.org_z[lane] = path->origin.z;
            query.ray.dir_x[lane] = path->direction.x;
            query.ray.dir_y[lane] = path->direction.y;
            query.ray.dir_z[lane] = path->direction.z;
            query.ray.tnear[lane] = path->near;
            query.ray.tfar[lane] = INFINITY;
            query.ray.time[lane] = 0.0f;
            query.ray.mask[lane] = ~0u;
            query.ray.flags[lane] = 0;
            query.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect8(valid, scene, &context, &query);
        for (int lane = 0; lane < packet && first + lane < count; ++lane) {
            const bool met = query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
            hits[first + lane] =
                (vtSurfaceHit){query.ray.tfar[lane], met ? query.hit.primID[lane] : VT_NO_TRIANGLE,
                               query.hit.u[lane], query.hit.v[lane]};
        }
    }
}

static vtVec3 mirror(vtVec3 I, vtVec3 N)
{
    return vtNormalize(vtMulAdd(I, -2.0f * vtDot(N, I), N));
}

/// As vtMeetSurface, but light that could pass is reflected with the probability of Fresnel's equations.
static void meetByChance(vtReferencePath* path, vtVec3 N, vtVec3 G, float ior)
{
    const bool wasInside = path->inside;
    const vtVec3 I = path->direction;
    path->direction = vtMeetSurface(I, N, G, ior, &path->inside, &path->reflected);
    if (path->inside == wasInside) {
        return; // total internal reflection
    }
    if (wasInside) {
        N = vtScale(N, -1.0f);
        G = vtScale(G, -1.0f);
    }
    if (vtDot(N, I) >= 0.0f) {
        N = G;
    }
    if (vtNextRandom(&path->random) < vtFresnel(-vtDot(N, I), wasInside ? ior : 1.0f / ior)) {
        const vtVec3 R = mirror(I, N);
        path->direction = vtDot(R, G) > 0.0f ? R : mirror(I, G);
        path->inside = wasInside;
    }
}

/// Whether a surface found is one that the path meets, and not the one it is just leaving. `facing` is above
/// zero where the path comes from behind.
static bool accept(const vtReference* reference, vtReferencePath* path, const vtSurfaceHit* hit, float facing)
{
    const bool wrongSide = path->inside ? facing <= 0.0f : facing >= 0.0f;
    const bool near = hit->distance < selfDistance * reference->extent;
    if (path->events > 0 && (hit->triangle == path->triangle || (wrongSide && near))) {
        path->near = vtStepBeyond(reference, hit->distance);
        return false;
    }
    // The surface itself says where the path is: an eye within the glass sees back faces first, and where
    // parts of a mesh run into each other (the cow's horns) this is what Cycles does.
    path->inside = facing > 0.0f;
    return true;
}

/// Takes a path through what it met; false where it ends.
static bool advance(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                    const vtSurfaceHit* hit)
{
    if (hit->triangle == VT_NO_TRIANGLE) {
        if (path->inside && !path->nudged) {
            path->direction = vtNudge(path->direction);
            path->nudged = true;
            return true;
        }
        path->state = path->events == 0 ? VT_PATH_BACKGROUND : path->inside ? VT_PATH_LOST : VT_PATH_EXITED;
        return false;
    }
    const vtVec3 G = vtNormalize(vtReference_TriangleArea(reference, hit->triangle));
    if (!accept(reference, path, hit, vtDot(G, path->direction))) {
        return true;
    }
    if (path->events == rules->maxEvents) {
        path->state = VT_PATH_LOST; // it had left, and comes back
        return false;
    }
    const uint32_t* corners = reference->indices + 3 * (size_t)hit->triangle;
    const vtVec3 N = vtNormalize(interpolate(reference->normals, corners, hit->u, hit->v));
    if (rules->fresnel) {
        meetByChance(path, N, G, rules->ior);
    } else {
        bool reflected;
        path->direction = vtMeetSurface(path->direction, N, G, rules->ior, &path->inside, &reflected);
        path->reflected |= reflected;
    }
    path->origin = interpolate(reference->positions, corners, hit->u, hit->v);
    path->near = startDistance * reference->extent;
    path->triangle = hit->triangle;
    path->nudged = false;
    if (++path->events == rules->maxEvents && path->inside) {
        path->state = VT_PATH_LOST;
        return false;
    }
    return true;
}

void vtFollowPaths(const vtReference* reference, const vtPathRules* rules, vtReferencePath* paths, int count)
{
    int active[VT_PATH_BATCH];
    vtSurfaceHit hits[VT_PATH_BATCH];
    for (int i = 0; i < count; ++i) {
        active[i] = i;
    }
    for (bool first = true; count > 0; first = false) {
        intersect(reference->scene, paths, active, count, first, hits);
        int left = 0;
        for (int i = 0; i < count; ++i) {
            if (advance(reference, rules, &paths[active[i]], &hits[i])) {
                active[left++] = active[i];
            }
        }
        count = left;
    }
}
