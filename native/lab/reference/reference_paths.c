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
#include "lab/reference/reference_events.h"
#include "shaders_es3/common/constants.h"

/// Takes off what is absorbed on the way to a surface at `distance`.
static void absorb(const vtReference* reference, vtReferencePath* path, float distance)
{
    const uint32_t id = vtMedia_Top(&path->within);
    if (id != 0 && reference->objects[id - 1].material->attenuationDistance > 0.0f) {
        const vtVec3 a = vtScale(reference->objects[id - 1].absorption, path->passed - distance);
        path->weight =
            (vtVec3){path->weight.x * expf(a.x), path->weight.y * expf(a.y), path->weight.z * expf(a.z)};
    }
}

/// Takes a path through what it met; false where it ends.
static bool advance(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                    const vtMeeting* meeting, vtBranches* branches)
{
    if (meeting->missed && !path->nudged) {
        path->direction = vtNudge(path->direction);
        path->nudged = true;
        return true;
    }
    const vtSurfaceHit* opaque = &meeting->opaque;
    if (opaque->distance < meeting->nearest - VT_TOUCH_DISTANCE * reference->extent) {
        absorb(reference, path, opaque->distance);
        return vtMeetOpaque(reference, rules, path, opaque);
    }
    if (meeting->glassCount == 0) {
        const bool inside = vtMedia_Top(&path->within) != 0;
        return vtEndPath(path, path->events == 0 ? VT_PATH_BACKGROUND
                               : inside          ? VT_PATH_LOST
                                                 : VT_PATH_EXITED);
    }
    vtPlace place;
    if (!vtFindSurfaces(reference, path, meeting, &place)) {
        path->near = vtStepBeyond(reference, meeting->nearest);
        return true;
    }
    if (!vtFindMedia(path, &place)) {
        return vtEndPath(path, VT_PATH_LOST);
    }
    const bool thin = vtPlace_Surface(&place)->object->thin;
    const vtReferencePath came = *path;
    absorb(reference, path, meeting->nearest);
    path->within = place.before;
    if (vtParts(reference, rules, path, &place)) {
        const vtIndices white = vtWhiteIndices(reference, rules, &place);
        if (white.whiteMirror && rules->fresnel && path->events < rules->maxEvents) {
            vtMeetGlass(reference, rules, path, &place, &white, branches);
        }
        vtPartLight(rules, path, &came, branches);
    }
    const uint32_t before = vtMedia_Top(&place.before), after = vtMedia_Top(&place.after);
    const float index = vtIndexOf(reference, rules, path, before);
    const float indexAfter = vtIndexOf(reference, rules, path, after);
    const bool changes = !thin && before != after && index != indexAfter;
    if (changes && path->events == rules->maxEvents) {
        return vtEndPath(path, VT_PATH_LOST); // it had left, and comes back
    }
    const float eta = changes ? index / indexAfter : 1.0f;
    const vtIndices indices = {{eta, eta, eta}, thin || before != after, false};
    return vtMeetGlass(reference, rules, path, &place, &indices, branches);
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
                vtBranches branches;
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
