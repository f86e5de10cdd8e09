// This work is based on: Turner Whitted. An Improved Illumination Model for Shaded Display. 1980, and Ingo
// Wald, Sven Woop, Carsten Benthin, Gregory Johnson, Manfred Ernst. Embree: A Kernel Framework for Efficient
// CPU Ray Tracing. 2014. Objects one in the other, and touching ones: src/scene/media.h.
//
// Departures:
//  - Without Fresnel reflection a path does not branch: it refracts, or reflects where it must (total
//  internal
//    reflection). With it there is Whitted's tree: what refracts goes on as the path, what reflects is a path
//    of its own. The first is the same path in both cases.
//  - Paths advance together, one event a round, and those still under way are packed anew before each round:
//    packets stay full although paths end at different times.
//  - A path does not meet the surface it starts from again: not the same triangle, and close by none that
//    faces the wrong way (a ray inside the glass meets it from behind, a ray outside from the front).
#include <math.h>
#include <stdlib.h>

#include "base/math.h"
#include "base/optics.h"
#include "lab/reference/reference_scene.h"
#include "mesh/mesh_triangle.h"
#include "shaders_es3/common/constants.h"

/// A reflected path of less than this share of the pixel's light is left out: a fifth of a step of 8 bits
/// near white. Where glass is clear 0.04 reflects, so two reflections in a row are followed and three are
/// not.
static const float leastWeight = 0.002f;

/// Surfaces that a path passes by without an event before it is given up: an endless loop otherwise, should
/// rounding ever make one.
enum { maxPasses = 10000 };

/// A surface of glass met by a path.
typedef struct Surface {
    const vtSurfaceHit* hit;
    const vtPlacedObject* object;
    vtVec3 G;    ///< outward normal of the triangle, world
    bool behind; ///< met from within
} Surface;

/// What a path meets at one place.
typedef struct Place {
    Surface surfaces[VT_MAX_TOUCHING]; ///< by rank: the normals of the first count
    int count;
    const vtSurfaceHit* opaque; ///< VT_NO_TRIANGLE: there is none
    vtMedia before, after;      ///< what the path is within, if it goes on straight or refracted
} Place;

// ----------------------------------------------------------------------------------------------- geometry

static vtVec3 triangleNormal(const vtPlacedObject* object, const vtSurfaceHit* hit)
{
    vtVec3 p[3];
    vtMesh_Corners(object->mesh, hit->triangle, p);
    const vtVec3 normal = vtCross(vtSub(p[1], p[0]), vtSub(p[2], p[0]));
    return vtNormalize(vtTransformNormal(&object->toObject, normal));
}

static vtVec3 surfacePoint(const vtPlacedObject* object, const vtSurfaceHit* hit)
{
    vtVec3 corners[3];
    vtMesh_Corners(object->mesh, hit->triangle, corners);
    return vtTransformPoint(&object->toWorld, vtBlend(corners, hit->u, hit->v));
}

static vtVec3 mirror(vtVec3 I, vtVec3 N)
{
    return vtNormalize(vtMulAdd(I, -2.0f * vtDot(N, I), N));
}

// --------------------------------------------------------------------------------------------------- media

/// Whether a surface found is the one that the path is just leaving.
static bool isStart(const vtReference* reference, const vtReferencePath* path, const Surface* surface)
{
    const vtSurfaceHit* hit = surface->hit;
    const vtPlacedObject* object = &reference->objects[hit->object];
    const bool wrongSide = !object->thin && vtMedia_Holds(&path->within, object->body + 1) != surface->behind;
    const bool near = hit->distance < VT_SELF_DISTANCE * reference->extent;
    for (int i = 0; i < path->startCount; ++i) {
        if (path->startObjects[i] == hit->object &&
            (path->startTriangles[i] == hit->triangle || (wrongSide && near))) {
            return true;
        }
    }
    return false;
}

/// The surfaces of glass that the path meets; false where the nearest is the one it starts from.
static bool findSurfaces(const vtReference* reference, const vtReferencePath* path, const vtMeeting* meeting,
                         Place* place)
{
    place->count = 0;
    place->opaque = &meeting->opaque;
    for (int i = 0; i < meeting->glassCount; ++i) {
        const vtSurfaceHit* hit = &meeting->glass[i];
        const vtVec3 G = triangleNormal(&reference->objects[hit->object], hit);
        Surface* surface = &place->surfaces[place->count];
        *surface = (Surface){hit, &reference->objects[hit->object], G, vtDot(G, path->direction) > 0.0f};
        if (!isStart(reference, path, surface)) {
            ++place->count;
        } else if (hit->distance == meeting->nearest) {
            return false;
        }
    }
    return true;
}

/// Toggles the objects of those surfaces that are met from behind, or of the others.
static bool toggle(vtMedia* media, const Place* place, bool behind)
{
    bool fits = true;
    for (int i = 0; i < place->count; ++i) {
        const Surface* surface = &place->surfaces[i];
        fits = fits && (surface->behind != behind || surface->object->thin ||
                        vtMedia_Toggle(media, surface->object->body + 1));
    }
    return fits;
}

/// What the path is within before the surfaces and after them. A surface itself says where the path is: an
/// eye within open glass sees back faces first, and where parts of a mesh run into each other (the cow's
/// horns) this is what Cycles does. False where too much lies one in the other.
static bool findMedia(const vtReferencePath* path, Place* place)
{
    place->before = path->within;
    bool fits = true;
    for (int i = 0; i < place->count; ++i) {
        const uint32_t id = place->surfaces[i].object->body + 1;
        if (!place->surfaces[i].object->thin &&
            vtMedia_Holds(&place->before, id) != place->surfaces[i].behind) {
            fits = fits && vtMedia_Toggle(&place->before, id);
        }
    }
    place->after = place->before;
    return fits && toggle(&place->after, place, true) && toggle(&place->after, place, false);
}

static float iorOf(const vtPathRules* rules, const vtPlacedObject* object)
{
    return rules->ior > 0.0f && !object->material->opaque ? rules->ior : vtMaterial_Index(object->material);
}

static float indexOf(const vtReference* reference, const vtPathRules* rules, uint32_t id)
{
    return id == 0 ? 1.0f : iorOf(rules, &reference->objects[id - 1]);
}

static vtVec3 multiply(vtVec3 a, vtVec3 b)
{
    return (vtVec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

/// Takes off what is absorbed on the way to a surface at `distance`.
static void absorb(const vtReference* reference, vtReferencePath* path, float distance)
{
    const uint32_t id = vtMedia_Top(&path->within);
    if (id != 0 && reference->objects[id - 1].material->attenuationDistance > 0.0f) {
        const vtVec3 a = vtScale(reference->objects[id - 1].absorption, path->passed - distance);
        path->weight = multiply(path->weight, (vtVec3){expf(a.x), expf(a.y), expf(a.z)});
    }
}

// -------------------------------------------------------------------------------------------------- events

static bool end(vtReferencePath* path, uint8_t state)
{
    path->state = state;
    path->ended = true;
    return false;
}

static float largest(vtVec3 v)
{
    return fmaxf(fmaxf(v.x, v.y), v.z);
}

/// Of plain glass, which sends nothing by itself: all that meetGlass asks for, and no more, since the time of
/// plain glass is what others are measured by.
static void lookAtPlain(const vtPathRules* rules, const vtPlacedObject* object, const vtSurfaceHit* hit,
                        vtLook* seen)
{
    vtVec3 normals[3];
    vtMesh_Normals(object->mesh, hit->triangle, normals);
    seen->N = vtNormalize(vtTransformNormal(&object->toObject, vtBlend(normals, hit->u, hit->v)));
    seen->base = object->material->tint;
    seen->coverage = seen->passes = seen->specular = 1.0f;
    seen->specularColor = (vtVec3){1.0f, 1.0f, 1.0f};
    seen->film = 0.0f;
    seen->mirror = false;
    seen->ior = iorOf(rules, object);
}

/// What the surface is like, and what it sends to the eye by itself.
static void look(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                 const vtSurfaceHit* hit, vtLook* seen)
{
    const vtPlacedObject* object = &reference->objects[hit->object];
    if (object->plain && !object->material->opaque) {
        lookAtPlain(rules, object, hit, seen);
        return;
    }
    *seen = vtLookAt(reference->scene, object, hit->triangle, hit->u, hit->v, iorOf(rules, object));
    if (rules->illumination != NULL) {
        const vtVec3 I = path->direction;
        const float side = vtDot(seen->G, I) > 0.0f ? -1.0f : 1.0f;
        const vtVec3 N = vtScale(vtDot(vtScale(seen->N, side), I) < 0.0f ? seen->N : seen->G, side);
        const vtVec3 sent =
            vtLook_SentLight(seen, rules->illumination, N, I, surfacePoint(object, hit), rules->exposure);
        path->light = vtMulAdd(path->light, seen->coverage, multiply(path->weight, sent));
    }
}

/// Meets what is opaque: ends there, unless some of its light passes beside it.
static bool meetOpaque(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                       const vtSurfaceHit* opaque)
{
    vtLook seen;
    look(reference, rules, path, opaque, &seen);
    const vtVec3 beside = vtScale(path->weight, 1.0f - seen.coverage);
    if (largest(beside) < leastWeight) {
        path->end = *opaque;
        return end(path, VT_PATH_OPAQUE);
    }
    path->weight = beside;
    path->nudged = false;
    path->passed = fmaxf(path->passed, opaque->distance);
    return ++path->passes < maxPasses || end(path, VT_PATH_LOST);
}

/// Lets the path begin anew on the surfaces met; the first says where that is.
static void startAt(const vtReference* reference, vtReferencePath* path, const Place* place)
{
    const vtSurfaceHit* first = place->surfaces[0].hit;
    path->origin = surfacePoint(&reference->objects[first->object], first);
    path->near = VT_START_DISTANCE * reference->extent;
    path->passed = 0.0f;
    path->nudged = false;
    path->startCount = 0;
    for (int i = 0; i <= place->count; ++i) {
        const vtSurfaceHit* hit = i < place->count ? place->surfaces[i].hit : place->opaque;
        if (hit->triangle != VT_NO_TRIANGLE) {
            path->startObjects[path->startCount] = hit->object;
            path->startTriangles[path->startCount++] = hit->triangle;
        }
    }
}

/// Lets the path go straight on from the surfaces met.
static void pass(vtReferencePath* path, const Place* place)
{
    for (int i = 0; i < place->count; ++i) {
        path->passed = fmaxf(path->passed, place->surfaces[i].hit->distance);
    }
    path->nudged = false;
    ++path->passes;
}

/// Paths that branch off from one.
typedef struct Branches {
    vtReferencePath paths[2];
    int count;
} Branches;

/// What part of a path's light goes a way of its own.
typedef struct Way {
    vtVec3 weight, direction;
    vtMedia within;
    bool straight, counts; ///< it goes on as it came; it is an event
} Way;

/// Sends the path on its way from the surfaces met.
static void send(const vtReference* reference, vtReferencePath* path, const Place* place, const Way* way)
{
    path->weight = way->weight;
    path->direction = way->direction;
    path->within = way->within;
    if (way->straight) {
        pass(path, place);
    } else {
        startAt(reference, path, place);
    }
}

/// The surface whose material counts: of a body rather than of a thin wall.
static const Surface* surfaceOf(const Place* place)
{
    int first = 0;
    while (first < place->count && place->surfaces[first].object->thin) {
        ++first;
    }
    return &place->surfaces[first < place->count ? first : 0];
}

/// Counts the event, if it is one; what is opaque and touches the glass comes after it. False where the path
/// ends.
static bool leaveSurface(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                         const Place* place, bool counts, bool goesThrough)
{
    if (counts && ++path->events >= rules->maxEvents && vtMedia_Top(&path->within) != 0) {
        return end(path, VT_PATH_LOST);
    }
    if (path->passes >= maxPasses) {
        return end(path, VT_PATH_LOST);
    }
    return !goesThrough || place->opaque->triangle == VT_NO_TRIANGLE ||
           meetOpaque(reference, rules, path, place->opaque);
}

/// Lets light that leaves the path branch off, unless there is too little of it.
static void branchOff(const vtReference* reference, const vtPathRules* rules, const vtReferencePath* path,
                      const Place* place, const Way* way, bool goesThrough, Branches* branches)
{
    if (largest(way->weight) < leastWeight) {
        return;
    }
    vtReferencePath* branch = &branches->paths[branches->count++];
    *branch = *path;
    branch->light = (vtVec3){0.0f, 0.0f, 0.0f};
    send(reference, branch, place, way);
    leaveSurface(reference, rules, branch, place, way->counts, goesThrough);
}

/// Parts the light that meets a surface of glass into what passes through it, what it mirrors and what passes
/// beside it: one of them is the path, the others branch off. `eta`: index before over the one behind; 1: it
/// bends nothing. False where the path has ended.
static bool meetGlass(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                      const Place* place, bool isInterface, float eta, Branches* branches)
{
    const Surface* surface = surfaceOf(place);
    const bool thin = surface->object->thin, straight = thin || eta == 1.0f;
    vtLook seen;
    look(reference, rules, path, surface->hit, &seen);
    const float turn = surface->behind ? -1.0f : 1.0f;
    const vtVec3 G = vtScale(surface->G, turn), I = path->direction;
    const vtVec3 given = vtScale(seen.N, turn), N = vtDot(given, I) >= 0.0f ? G : given;
    bool reflected = false;
    const vtVec3 T = straight ? I : vtMeetInterface(I, given, G, eta, &reflected);
    vtVec3 F = {0.0f, 0.0f, 0.0f};
    if (reflected) {
        F = (vtVec3){1.0f, 1.0f, 1.0f};
    } else if (rules->fresnel && isInterface) {
        const float into = thin ? 1.0f / seen.ior : eta, cosine = -vtDot(N, I);
        F = vtLook_Reflectance(&seen, cosine, vtFresnel(cosine, into), fmaxf(into, 1.0f / into),
                               surface->behind && !thin);
    }
    const vtVec3 share = vtScale(path->weight, seen.coverage * seen.passes), mirrored = multiply(share, F);
    const vtVec3 left = vtSub(share, mirrored), R = reflected ? T : mirror(I, N);
    Way through = {isInterface ? multiply(left, seen.base) : left, T, place->after, straight, !straight};
    const Way mirroring = {mirrored, reflected || vtDot(R, G) > 0.0f ? R : mirror(I, G), path->within, false,
                           true};
    Way beside = {vtScale(path->weight, 1.0f - seen.coverage), I, path->within, true, false};
    if (thin) { // the same way
        through.weight = vtAdd(through.weight, beside.weight);
        beside.weight = (vtVec3){0.0f, 0.0f, 0.0f};
    }
    path->reflected |= reflected;
    const bool passes = seen.passes * seen.coverage + (thin ? 1.0f - seen.coverage : 0.0f) > 0.0f;
    if (!passes && seen.coverage >= 1.0f) {
        return end(path, VT_PATH_OPAQUE);
    }
    // The path itself is what goes through, or is totally reflected; else what passes beside.
    const Way* own = !passes ? &beside : reflected ? &mirroring : &through;
    if (own != &mirroring && rules->fresnel) {
        branchOff(reference, rules, path, place, &mirroring, false, branches);
    }
    if (own != &beside && seen.coverage < 1.0f) {
        branchOff(reference, rules, path, place, &beside, true, branches);
    }
    send(reference, path, place, own);
    return leaveSurface(reference, rules, path, place, own->counts, own != &mirroring);
}

/// Takes a path through what it met; false where it ends.
static bool advance(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                    const vtMeeting* meeting, Branches* branches)
{
    if (meeting->missed && !path->nudged) {
        path->direction = vtNudge(path->direction);
        path->nudged = true;
        return true;
    }
    const vtSurfaceHit* opaque = &meeting->opaque;
    if (opaque->distance < meeting->nearest - VT_TOUCH_DISTANCE * reference->extent) {
        absorb(reference, path, opaque->distance);
        return meetOpaque(reference, rules, path, opaque);
    }
    if (meeting->glassCount == 0) {
        const bool inside = vtMedia_Top(&path->within) != 0;
        return end(path, path->events == 0 ? VT_PATH_BACKGROUND : inside ? VT_PATH_LOST : VT_PATH_EXITED);
    }
    Place place;
    if (!findSurfaces(reference, path, meeting, &place)) {
        path->near = vtStepBeyond(reference, meeting->nearest);
        return true;
    }
    if (!findMedia(path, &place)) {
        return end(path, VT_PATH_LOST);
    }
    const uint32_t before = vtMedia_Top(&place.before), after = vtMedia_Top(&place.after);
    const float index = indexOf(reference, rules, before), indexAfter = indexOf(reference, rules, after);
    const bool thin = surfaceOf(&place)->object->thin;
    const bool changes = !thin && before != after && index != indexAfter;
    if (changes && path->events == rules->maxEvents) {
        return end(path, VT_PATH_LOST); // it had left, and comes back
    }
    absorb(reference, path, meeting->nearest);
    path->within = place.before;
    return meetGlass(reference, rules, path, &place, thin || before != after,
                     changes ? index / indexAfter : 1.0f, branches);
}

// --------------------------------------------------------------------------------------------------- paths

bool vtPathList_Add(vtPathList* list, const vtReferencePath* path)
{
    if (list->count == list->capacity) {
        const uint32_t capacity = list->capacity > 0 ? 2 * list->capacity : 256;
        vtReferencePath* paths = realloc(list->paths, capacity * sizeof *paths);
        list->paths = paths != NULL ? paths : list->paths;
        uint32_t* active = realloc(list->active, capacity * sizeof *active);
        list->active = active != NULL ? active : list->active;
        if (paths == NULL || active == NULL) {
            return false;
        }
        list->capacity = capacity;
    }
    list->paths[list->count++] = *path;
    return true;
}

void vtDestroyPathList(vtPathList* list)
{
    free(list->paths);
    free(list->active);
    *list = (vtPathList){0};
}

bool vtFollowPaths(const vtReference* reference, const vtPathRules* rules, vtPathList* list)
{
    uint32_t count = list->count;
    for (uint32_t i = 0; i < count; ++i) {
        list->active[i] = i;
    }
    vtMeeting meetings[VT_PACKET];
    for (bool first = true; count > 0; first = false) {
        const uint32_t known = list->count;
        uint32_t left = 0;
        for (uint32_t at = 0; at < count; at += VT_PACKET) {
            const int lanes = count - at < VT_PACKET ? (int)(count - at) : VT_PACKET;
            vtReference_Meet(reference, list->paths, list->active + at, lanes, first, meetings);
            for (int lane = 0; lane < lanes; ++lane) {
                const uint32_t number = list->active[at + (uint32_t)lane];
                Branches branches;
                branches.count = 0;
                if (advance(reference, rules, &list->paths[number], &meetings[lane], &branches)) {
                    list->active[left++] = number;
                }
                for (int i = 0; i < branches.count; ++i) {
                    if (!vtPathList_Add(list, &branches.paths[i])) {
                        return false;
                    }
                }
            }
        }
        for (uint32_t i = known; i < list->count; ++i) {
            if (!list->paths[i].ended) {
                list->active[left++] = i;
            }
        }
        count = left;
    }
    return true;
}
