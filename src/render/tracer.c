// One exact path, for people who want to see what light does: the event loop that the techniques imitate, on
// the CPU. What objects do to each other: scene/media.h and shaders_es3/common/cross_surface.glsl. Departure:
// where light could pass it does, however much of it is reflected.
#include <float.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "base/optics.h"
#include "mesh/hierarchy.h"
#include "mesh/mesh_triangle.h"
#include "relief/height_trace.h"
#include "scene/camera.h"
#include "scene/material.h"
#include "scene/media.h"
#include "scene/objects.h"

/// Surfaces passed by without an event before a path is given up, should rounding ever make an endless loop.
enum { maxPasses = 1000 };

/// Where an object is met.
typedef struct Spot {
    float distance;
    float u, v;           ///< weights of the triangle's second and third corner
    uint32_t triangle;    ///< of a relief
    uint32_t vertices[3]; ///< of another mesh
} Spot;

/// What a path meets.
typedef struct Meeting {
    uint32_t object; ///< number of those placed
    Spot spot;
    uint32_t also;      ///< another object of glass whose surface is at the same place; objectCount: none
    bool touchesOpaque; ///< something opaque is at the same place
} Meeting;

struct vtTracer {
    const vtScene* scene;
    vtPlacedObject* placed;
    vtHierarchy* built; ///< by mesh, of those that have no hierarchy of their own
    uint32_t glassCount;
    float same; ///< surfaces nearer to one another lie at one place
    float ior;  ///< of all glass in the path that is traced; 0: each object's own
};

static float degreesBetween(vtVec3 a, vtVec3 b)
{
    return atan2f(vtLength(vtCross(a, b)), vtDot(a, b)) * 180.0f / VT_PI;
}

// Reliefs are met by their heights even where they have triangles, whose numbers are others on the back.

/// Three numbers of each of the triangle's vertices.
static void readVertices(const float* numbers, const Spot* spot, vtVec3 vectors[3])
{
    for (int i = 0; i < 3; ++i) {
        vectors[i] = vtMakeVec3(numbers + 3 * (size_t)spot->vertices[i]);
    }
}

static void readCorners(const vtMesh* mesh, const Spot* spot, vtVec3 corners[3])
{
    if (mesh->heights != NULL) {
        vtHeightField_Corners(mesh->heights, spot->triangle, corners);
    } else {
        readVertices(mesh->positions, spot, corners);
    }
}

static vtVec3 pointOf(const vtMesh* mesh, const Spot* spot)
{
    vtVec3 corners[3];
    readCorners(mesh, spot, corners);
    return vtBlend(corners, spot->u, spot->v);
}

static vtVec3 flatNormal(const vtMesh* mesh, const Spot* spot)
{
    vtVec3 p[3];
    readCorners(mesh, spot, p);
    return vtCross(vtSub(p[1], p[0]), vtSub(p[2], p[0]));
}

static vtVec3 smoothNormal(const vtMesh* mesh, const Spot* spot)
{
    vtVec3 normals[3];
    if (mesh->heights != NULL) {
        vtHeightField_Normals(mesh->heights, spot->triangle, normals);
    } else {
        readVertices(mesh->normals, spot, normals);
    }
    return vtBlend(normals, spot->u, spot->v);
}

static vtVec3 toWorld(const vtPlacedObject* placed, vtVec3 normal)
{
    return vtNormalize(vtTransformNormal(&placed->toObject, normal));
}

// -------------------------------------------------------------------------------------------------- search

void vtDestroyTracer(vtTracer* tracer)
{
    if (tracer == NULL) {
        return;
    }
    for (uint32_t i = 0; tracer->built != NULL && i < tracer->scene->meshCount; ++i) {
        vtDestroyHierarchy(&tracer->built[i]);
    }
    vtFree(tracer->built);
    vtFree(tracer->placed);
    vtFree(tracer);
}

/// Places the objects and builds the hierarchies that their meshes lack.
static vtResult fillTracer(vtTracer* tracer, vtError* error)
{
    const vtScene* scene = tracer->scene;
    vtResult result = vtPlaceObjects(scene, &tracer->placed, &tracer->glassCount, error);
    if (result != vt_ok) {
        return result;
    }
    tracer->built = vtAllocateZeroed(scene->meshCount, sizeof *tracer->built);
    if (tracer->built == NULL) {
        return vtFail(error, vt_errorMemory, "path: out of memory for %u meshes", scene->meshCount);
    }
    for (uint32_t i = 0; i < scene->objectCount && result == vt_ok; ++i) {
        const vtMesh* mesh = tracer->placed[i].mesh;
        vtHierarchy* hierarchy = &tracer->built[tracer->placed[i].meshIndex];
        if (mesh->hierarchy == NULL && hierarchy->recordCount == 0 && mesh->heights == NULL) {
            result = vtCreateHierarchy(mesh, hierarchy, error);
        }
    }
    vtVec3 low, high;
    vtScene_Bounds(scene, &low, &high);
    tracer->same = 1e-5f * vtLength(vtSub(high, low));
    return result;
}

vtResult vtCreateTracer(const vtScene* scene, vtTracer** tracer, vtError* error)
{
    if (tracer == NULL || scene == NULL) {
        return vtFailMissing(error, "vtCreateTracer", tracer == NULL ? "tracer" : "scene");
    }
    *tracer = NULL;
    vtTracer* made = vtAllocateZeroed(1, sizeof *made);
    if (made == NULL) {
        return vtFail(error, vt_errorMemory, "path: out of memory for %u objects", scene->objectCount);
    }
    made->scene = scene;
    const vtResult result = fillTracer(made, error);
    if (result != vt_ok) {
        vtDestroyTracer(made);
        return result;
    }
    *tracer = made;
    return vtSucceed(error);
}

static bool traceRelief(const vtMesh* mesh, vtVec3 origin, vtVec3 direction, float start, int sides,
                        Spot* spot)
{
    vtHeightHit found;
    spot->distance = FLT_MAX;
    if (!vtHeightField_Trace(mesh->heights, origin, direction, start, FLT_MAX, sides, vt_separateAll,
                             &found)) {
        return false;
    }
    *spot = (Spot){.distance = found.distance, .u = found.u, .v = found.v, .triangle = found.triangle};
    return true;
}

static const vtHierarchy* hierarchyOf(const vtTracer* tracer, const vtPlacedObject* placed)
{
    return placed->mesh->hierarchy != NULL ? placed->mesh->hierarchy : &tracer->built[placed->meshIndex];
}

/// The object's first surface beyond `start`. `sides`: 1 entered through, 2 left through, 3 either.
static bool traceObject(const vtTracer* tracer, uint32_t object, vtVec3 origin, vtVec3 direction, float start,
                        int sides, Spot* spot)
{
    const vtPlacedObject* placed = &tracer->placed[object];
    // Not made a unit vector, so that distances are the world's.
    const vtVec3 o = vtTransformPoint(&placed->toObject, origin);
    const vtVec3 d = vtTransformVector(&placed->toObject, direction);
    if (placed->mesh->heights != NULL) {
        return traceRelief(placed->mesh, o, d, start, sides, spot);
    }
    vtHierarchyHit hit;
    const bool found = vtHierarchy_Trace(hierarchyOf(tracer, placed), o, d, start, sides, &hit);
    *spot = (Spot){.distance = hit.distance, .u = hit.u, .v = hit.v};
    memcpy(spot->vertices, hit.vertices, sizeof spot->vertices);
    return found;
}

/// The nearest surface of all objects; false where there is none. `start` is 0 at the eye, of which nothing
/// says what it is within.
static bool findNearest(const vtTracer* tracer, const vtMedia* media, vtVec3 origin, vtVec3 direction,
                        float start, Meeting* meeting)
{
    const uint32_t count = tracer->scene->objectCount;
    float opaque = FLT_MAX;
    *meeting = (Meeting){.object = count, .spot.distance = FLT_MAX, .also = count};
    for (uint32_t i = 0; i < count; ++i) {
        const bool isOpaque = i >= tracer->glassCount;
        const vtPlacedObject* placed = &tracer->placed[i];
        const bool anySide = isOpaque ? !placed->material->oneSided : start <= 0.0f || placed->thin;
        const int sides = anySide ? 3 : !isOpaque && vtMedia_Holds(media, placed->body + 1) ? 2 : 1;
        Spot spot;
        if (!traceObject(tracer, i, origin, direction, start, sides, &spot)) {
            continue;
        }
        opaque = isOpaque ? fminf(opaque, spot.distance) : opaque;
        const bool isSame = fabsf(spot.distance - meeting->spot.distance) <= tracer->same;
        if (isSame && !isOpaque && !placed->thin) {
            meeting->also = i; // touching glass is crossed at once
        } else if (!isSame && spot.distance < meeting->spot.distance) {
            *meeting = (Meeting){.object = i, .spot = spot, .also = count};
        }
    }
    meeting->touchesOpaque = opaque - meeting->spot.distance <= tracer->same;
    return meeting->object < count;
}

// -------------------------------------------------------------------------------------------------- events

static float indexOf(const vtTracer* tracer, uint32_t id)
{
    return id == 0              ? 1.0f
           : tracer->ior > 0.0f ? tracer->ior
                                : vtMaterial_Index(tracer->placed[id - 1].material);
}

/// Takes the path through a surface of glass: an event, where indices differ, or straight on. False where an
/// event is one too many.
static bool cross(const vtTracer* tracer, const Meeting* meeting, int maxEvents, vtVec3 position,
                  vtMedia* media, vtVec3* direction, vtPath* path)
{
    const vtPlacedObject* placed = &tracer->placed[meeting->object];
    const vtVec3 G = toWorld(placed, flatNormal(placed->mesh, &meeting->spot));
    const vtVec3 N = toWorld(placed, smoothNormal(placed->mesh, &meeting->spot));
    const vtVec3 I = *direction;
    if (placed->thin) { // straight on, and no event
        return true;
    }
    // The surface says on which side of it the path is.
    const bool leaving = vtDot(G, I) > 0.0f;
    if (leaving != vtMedia_Holds(media, placed->body + 1)) {
        vtMedia_Toggle(media, placed->body + 1);
    }
    vtMedia next = *media;
    vtMedia_Toggle(&next, placed->body + 1);
    if (meeting->also < tracer->glassCount) {
        vtMedia_Toggle(&next, tracer->placed[meeting->also].body + 1);
    }
    const float eta = indexOf(tracer, vtMedia_Top(media)) / indexOf(tracer, vtMedia_Top(&next));
    if (eta == 1.0f) {
        *media = next;
        return true;
    }
    if (path->eventCount == maxEvents) {
        return false;
    }
    vtPathEvent* event = &path->events[path->eventCount++];
    const float turn = leaving ? -1.0f : 1.0f;
    const vtVec3 against = vtScale(N, turn);
    event->position = position;
    event->incoming = degreesBetween(vtScale(I, -1.0f), against);
    *direction = vtMeetInterface(I, against, vtScale(G, turn), eta, &event->reflected);
    event->outgoing = degreesBetween(*direction, event->reflected ? against : vtScale(against, -1.0f));
    *media = event->reflected ? *media : next;
    return true;
}

static void follow(const vtTracer* tracer, int maxEvents, vtVec3 origin, vtVec3 direction, vtPath* path)
{
    vtMedia media = {{0}};
    Meeting meeting;
    float start = 0.0f;
    bool isLost = false;
    for (int pass = 0; !isLost && findNearest(tracer, &media, origin, direction, start, &meeting); ++pass) {
        const vtPlacedObject* placed = &tracer->placed[meeting.object];
        origin = vtTransformPoint(&placed->toWorld, pointOf(placed->mesh, &meeting.spot));
        bool isOpaque = meeting.object >= tracer->glassCount;
        if (!isOpaque) {
            const int events = path->eventCount;
            isLost =
                !cross(tracer, &meeting, maxEvents, origin, &media, &direction, path) || pass == maxPasses;
            const bool reflected = path->eventCount > events && path->events[events].reflected;
            isOpaque = meeting.touchesOpaque && !isLost && !reflected;
        }
        if (isOpaque) {
            path->opaque = true;
            path->end = origin;
            break;
        }
        start = tracer->same;
    }
    path->exited = !isLost && !path->opaque && vtMedia_Top(&media) == 0;
    path->direction = direction;
}

vtResult vtTracer_Path(const vtTracer* tracer, const vtFrame* frame, float x, float y, vtPath* path,
                       vtError* error)
{
    if (path == NULL || tracer == NULL || frame == NULL) {
        return vtFailMissing(error, "vtTracer_Path",
                             path == NULL     ? "path"
                             : tracer == NULL ? "tracer"
                                              : "frame");
    }
    *path = (vtPath){0};
    const vtResult result = vtValidateFrame(frame, error);
    if (result != vt_ok) {
        return result;
    }
    if (!isfinite(x) || !isfinite(y)) {
        return vtFail(error, vt_errorArgument, "path: its point is (%g, %g); give finite numbers", (double)x,
                      (double)y);
    }
    vtTracer own = *tracer;
    own.ior = frame->ior;
    const vtCamera camera = vtMakeCamera(frame);
    const float across = camera.low[0] + x / (float)frame->width * (camera.high[0] - camera.low[0]);
    const float up = camera.high[1] - y / (float)frame->height * (camera.high[1] - camera.low[1]);
    const vtVec3 beside = vtMulAdd(vtScale(camera.right, across), up, camera.up);
    const vtVec3 eye = camera.orthographic ? vtAdd(camera.eye, beside) : camera.eye;
    const vtVec3 direction = camera.orthographic ? camera.forward : vtAdd(camera.forward, beside);
    follow(&own, vtResolveFrame(frame).maxEvents, eye, vtNormalize(direction), path);
    return vtSucceed(error);
}
