// Rays from surfaces to lights: what is opaque stops them, glass lets pass what it lets pass straight on.
#include "lab/reference/reference_shade.h"

#include <math.h>

#include "base/optics.h"
#include "lab/reference/reference_chance.h"
#include "scene/material.h"

enum { mostSurfaces = 64 };

static const vtVec3 all = {1.0f, 1.0f, 1.0f}, none = {0.0f, 0.0f, 0.0f};

static float indexOf(const vtShadeRays* rays, uint32_t id)
{
    const vtPlacedObject* object = id > 0 ? &rays->reference->objects[id - 1] : NULL;
    return object == NULL            ? 1.0f
           : rays->rules->ior > 0.0f ? rays->rules->ior
                                     : vtMaterial_Index(object->material);
}

static vtVec3 absorbed(const vtReference* reference, const vtMedia* within, float distance)
{
    const uint32_t id = vtMedia_Top(within);
    const vtVec3 a = id > 0 && reference->objects[id - 1].material->attenuationDistance > 0.0f
                         ? reference->objects[id - 1].absorption
                         : none;
    return (vtVec3){expf(-a.x * distance), expf(-a.y * distance), expf(-a.z * distance)};
}

/// What passes the surfaces of glass at a place.
static vtVec3 passedBy(const vtShadeRays* rays, const vtPlace* place, vtVec3 L)
{
    const vtSurface* surface = vtPlace_Surface(place);
    const uint32_t before = vtMedia_Top(&place->before), after = vtMedia_Top(&place->after);
    const float own =
        rays->rules->ior > 0.0f ? rays->rules->ior : vtMaterial_Index(surface->object->material);
    const float eta = surface->object->thin ? own : indexOf(rays, after) / indexOf(rays, before);
    const float ior = fmaxf(eta, 1.0f / eta);
    const vtSurfaceHit* hit = surface->hit;
    const vtLook look =
        vtLookAt(rays->reference->scene, surface->object, hit->triangle, hit->u, hit->v, ior, -1.0f);
    vtVec3 through = all;
    if (surface->object->thin || before != after) {
        const float cosine = fabsf(vtDot(look.N, L));
        const vtVec3 F = rays->rules->fresnel && ior != 1.0f
                             ? vtLook_Reflectance(&look, cosine, vtFresnel(cosine, 1.0f / ior), ior, false)
                             : none;
        through = vtMultiply(vtSub(all, F), look.base);
    }
    return vtMulAdd(vtScale(all, 1.0f - look.coverage), look.coverage * look.passes, through);
}

static vtVec3 passedByOpaque(const vtShadeRays* rays, const vtSurfaceHit* hit)
{
    const vtPlacedObject* object = &rays->reference->objects[hit->object];
    if (object->plain) {
        return none;
    }
    const vtLook look = vtLookAt(rays->reference->scene, object, hit->triangle, hit->u, hit->v, 1.0f, -1.0f);
    return vtScale(all, 1.0f - look.coverage);
}

static vtVec3 arriving(const vtShadows* shadows, vtVec3 direction, float distance)
{
    const vtShadeRays* rays = (const vtShadeRays*)shadows;
    const vtReference* reference = rays->reference;
    vtReferencePath ray = rays->start;
    ray.direction = direction;
    vtVec3 share = all;
    const uint32_t number = 0;
    float gone = 0.0f;
    for (int i = 0; i < mostSurfaces; ++i) {
        vtMeeting meeting;
        vtReference_Meet(reference, &ray, &number, 1, false, &meeting);
        const bool isOpaque =
            meeting.opaque.distance < meeting.nearest - VT_TOUCH_DISTANCE * reference->extent;
        const float met = isOpaque ? meeting.opaque.distance : meeting.nearest;
        if (!(met < distance)) {
            return isinf(distance) ? share
                                   : vtMultiply(share, absorbed(reference, &ray.within, distance - gone));
        }
        vtPlace place = {.count = 0};
        if (!isOpaque && !vtFindSurfaces(reference, &ray, &meeting, &place)) {
            ray.near = vtStepBeyond(reference, met); // the one that it starts on
            continue;
        }
        if (rays->rules->caustics != NULL) {
            return none; // what passes is photons'
        }
        share = vtMultiply(share, absorbed(reference, &ray.within, met - gone));
        if (!isOpaque) {
            if (!vtFindMedia(&ray, &place)) {
                return none;
            }
            share = vtMultiply(share, passedBy(rays, &place, direction));
            ray.within = place.after;
        }
        if (meeting.opaque.triangle != VT_NO_TRIANGLE) {
            share = vtMultiply(share, passedByOpaque(rays, &meeting.opaque));
        }
        if (fmaxf(share.x, fmaxf(share.y, share.z)) < 1e-4f) {
            return none;
        }
        ray.passed = fmaxf(met, meeting.opaque.triangle != VT_NO_TRIANGLE ? meeting.opaque.distance : met);
        gone = met;
    }
    return none;
}

/// A point of the sun: its middle where nothing is left to chance.
static vtVec3 pointOfSun(const vtPathRules* rules, const vtReferencePath* path)
{
    const vtSun* sun = rules->illumination->sun;
    if (sun == NULL || !rules->chance) {
        return sun != NULL ? sun->direction : none;
    }
    float pair[2];
    vtChance_Pair(path->key, vt_chanceSun, rules->sample, pair);
    const vtVec3 d = sun->direction;
    const vtVec3 other = fabsf(d.y) < 0.9f ? (vtVec3){0.0f, 1.0f, 0.0f} : (vtVec3){1.0f, 0.0f, 0.0f};
    const vtVec3 right = vtNormalize(vtCross(d, other)), up = vtCross(d, right);
    const float radius = tanf(sun->radius) * sqrtf(pair[0]), angle = 2.0f * VT_PI * pair[1];
    return vtNormalize(vtMulAdd(vtMulAdd(d, radius * cosf(angle), right), radius * sinf(angle), up));
}

vtShadeRays vtMakeShadeRays(const vtReference* reference, const vtPathRules* rules,
                            const vtReferencePath* path, const vtSurfaceHit* hit)
{
    vtShadeRays rays = {{arriving, pointOfSun(rules, path), none}, reference, rules, *path};
    const vtPlacedObject* object = &reference->objects[hit->object];
    if (rules->caustics != NULL) {
        const bool behind = vtDot(vtTriangleNormal(object, hit), path->direction) > 0.0f;
        rays.shadows.gathered =
            vtCausticMap_Light(rules->caustics, hit->object, hit->triangle, hit->u, hit->v, behind);
    }
    rays.start.origin = vtSurfacePoint(object, hit);
    rays.start.near = VT_START_DISTANCE * reference->extent;
    rays.start.passed = 0.0f;
    rays.start.startCount = 1;
    rays.start.startObjects[0] = hit->object;
    rays.start.startTriangles[0] = hit->triangle;
    return rays;
}
