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

static vtVec3 surfaceNormal(const vtPlacedObject* object, const vtSurfaceHit* hit)
{
    vtVec3 normals[3];
    vtMesh_Normals(object->mesh, hit->triangle, normals);
    return vtNormalize(vtTransformNormal(&object->toObject, vtBlend(normals, hit->u, hit->v)));
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
    const bool wrongSide = vtMedia_Holds(&path->within, hit->object + 1) != surface->behind;
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
        *surface = (Surface){hit, G, vtDot(G, path->direction) > 0.0f};
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
        fits = fits && (surface->behind != behind || vtMedia_Toggle(media, surface->hit->object + 1));
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
        const uint32_t id = place->surfaces[i].hit->object + 1;
        if (vtMedia_Holds(&place->before, id) != place->surfaces[i].behind) {
            fits = fits && vtMedia_Toggle(&place->before, id);
        }
    }
    place->after = place->before;
    return fits && toggle(&place->after, place, true) && toggle(&place->after, place, false);
}

static float indexOf(const vtReference* reference, const vtPathRules* rules, uint32_t id)
{
    return id == 0 ? 1.0f : rules->ior > 0.0f ? rules->ior : reference->objects[id - 1].material->ior;
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

static bool endOn(vtReferencePath* path, const vtSurfaceHit* opaque)
{
    path->end = *opaque;
    return end(path, VT_PATH_OPAQUE);
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

/// Counts the event; false where the path ends with it.
static bool countEvent(const vtPathRules* rules, vtReferencePath* path)
{
    if (++path->events == rules->maxEvents && vtMedia_Top(&path->within) != 0) {
        return end(path, VT_PATH_LOST);
    }
    return true;
}

/// One event: the path goes on refracted or, where it must, reflected. False where it ends. *branch: a path
/// that is reflected where this one refracts; its weight is 0 where there is none.
static bool bend(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                 const Place* place, float eta, vtReferencePath* branch)
{
    const Surface* surface = &place->surfaces[0];
    const vtPlacedObject* object = &reference->objects[surface->hit->object];
    const float turn = surface->behind ? -1.0f : 1.0f;
    const vtVec3 G = vtScale(surface->G, turn);
    vtVec3 N = vtScale(surfaceNormal(object, surface->hit), turn);
    const vtVec3 I = path->direction;
    bool reflected;
    const vtVec3 T = vtMeetInterface(I, N, G, eta, &reflected);
    startAt(reference, path, place);
    path->reflected |= reflected;
    if (!reflected && rules->fresnel) {
        N = vtDot(N, I) >= 0.0f ? G : N;
        const float F = vtFresnel(-vtDot(N, I), eta);
        const vtVec3 R = mirror(I, N);
        *branch = *path;
        branch->direction = vtDot(R, G) > 0.0f ? R : mirror(I, G);
        branch->weight = vtScale(path->weight, F);
        countEvent(rules, branch);
        path->weight = vtScale(path->weight, 1.0f - F);
    }
    path->direction = T;
    if (!reflected) {
        path->within = place->after;
        path->weight = multiply(path->weight, object->material->tint);
    }
    if (!countEvent(rules, path)) {
        return false;
    }
    // What is opaque and touches the glass comes after it.
    return reflected || place->opaque->triangle == VT_NO_TRIANGLE || endOn(path, place->opaque);
}

/// Lets the path go straight on where nothing changes on the way; false where it ends.
static bool pass(vtReferencePath* path, const Place* place)
{
    for (int i = 0; i < place->count; ++i) {
        path->passed = fmaxf(path->passed, place->surfaces[i].hit->distance);
    }
    path->within = place->after;
    path->nudged = false;
    if (place->opaque->triangle != VT_NO_TRIANGLE) {
        return endOn(path, place->opaque);
    }
    return ++path->passes < maxPasses || end(path, VT_PATH_LOST);
}

/// Takes a path through what it met; false where it ends.
static bool advance(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                    const vtMeeting* meeting, vtReferencePath* branch)
{
    if (meeting->missed && !path->nudged) {
        path->direction = vtNudge(path->direction);
        path->nudged = true;
        return true;
    }
    const vtSurfaceHit* opaque = &meeting->opaque;
    if (opaque->distance < meeting->nearest - VT_TOUCH_DISTANCE * reference->extent) {
        absorb(reference, path, opaque->distance);
        return endOn(path, opaque);
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
    const bool changes = before != after && index != indexAfter;
    if (changes && path->events == rules->maxEvents) {
        return end(path, VT_PATH_LOST); // it had left, and comes back
    }
    absorb(reference, path, meeting->nearest);
    path->within = place.before;
    return changes ? bend(reference, rules, path, &place, index / indexAfter, branch) : pass(path, &place);
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

static float largest(vtVec3 v)
{
    return fmaxf(fmaxf(v.x, v.y), v.z);
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
                vtReferencePath branch;
                branch.weight = (vtVec3){0.0f, 0.0f, 0.0f};
                if (advance(reference, rules, &list->paths[number], &meetings[lane], &branch)) {
                    list->active[left++] = number;
                }
                if (largest(branch.weight) >= leastWeight && !vtPathList_Add(list, &branch)) {
                    return false;
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
