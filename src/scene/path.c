// One exact path, for people who want to see what light does: the event loop that the techniques imitate, on
// the CPU. What objects do to each other: scene/media.h and shaders_es3/cross_surface.glsl. Departure: where
// light could pass it does, however much of it is reflected.
#include <float.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/math.h"
#include "base/optics.h"
#include "scene/bvh.h"
#include "scene/camera.h"
#include "scene/height_field.h"
#include "scene/media.h"
#include "scene/objects.h"

/// Surfaces passed by without an event before a path is given up, should rounding ever make an endless loop.
enum { maxPasses = 1000 };

/// What a path meets.
typedef struct Meeting {
    uint32_t object; ///< number of those placed
    vtBvhHit hit;
    uint32_t also;      ///< another object of glass whose surface is at the same place; objectCount: none
    bool touchesOpaque; ///< something opaque is at the same place
} Meeting;

typedef struct Tracer {
    const vtScene* scene;
    vtPlacedObject* placed;
    vtBvh** bvhs; ///< by mesh
    uint32_t glassCount;
    float same; ///< surfaces nearer to one another lie at one place
    float ior;  ///< of all glass; 0: each object's own
} Tracer;

static float degreesBetween(vtVec3 a, vtVec3 b)
{
    return atan2f(vtLength(vtCross(a, b)), vtDot(a, b)) * 180.0f / VT_PI;
}

/// Corners and normals of what was met.
static vtReliefTriangle readTriangle(const vtMesh* mesh, uint32_t number)
{
    if (mesh->heights != NULL) {
        return vtHeightField_Triangle(mesh->heights, number);
    }
    vtReliefTriangle triangle;
    for (int i = 0; i < 3; ++i) {
        const size_t vertex = mesh->indices[3 * (size_t)number + (size_t)i];
        triangle.corners[i] = vtMakeVec3(mesh->positions + 3 * vertex);
        triangle.normals[i] = vtMakeVec3(mesh->normals + 3 * vertex);
    }
    return triangle;
}

static vtVec3 interpolate(const vtVec3* values, const vtBvhHit* hit)
{
    const vtVec3 sum = vtMulAdd(vtScale(values[0], 1.0f - hit->u - hit->v), hit->u, values[1]);
    return vtMulAdd(sum, hit->v, values[2]);
}

static vtVec3 toWorld(const vtPlacedObject* placed, vtVec3 normal)
{
    return vtNormalize(vtTransformNormal(&placed->toObject, normal));
}

// -------------------------------------------------------------------------------------------------- search

static void destroyTracer(Tracer* tracer)
{
    for (uint32_t i = 0; tracer->bvhs != NULL && i < tracer->scene->meshCount; ++i) {
        vtDestroyBvh(tracer->bvhs[i]);
    }
    free(tracer->bvhs);
    free(tracer->placed);
}

static vtResult createTracer(const vtScene* scene, Tracer* tracer, vtError* error)
{
    *tracer = (Tracer){.scene = scene};
    vtResult result = vtPlaceObjects(scene, &tracer->placed, &tracer->glassCount, error);
    if (result != vt_ok) {
        return result;
    }
    tracer->bvhs = calloc(scene->meshCount, sizeof *tracer->bvhs);
    bool isThere = tracer->bvhs != NULL;
    for (uint32_t i = 0; i < scene->objectCount && isThere; ++i) {
        const uint32_t mesh = tracer->placed[i].meshIndex;
        if (tracer->bvhs[mesh] == NULL) {
            tracer->bvhs[mesh] = vtCreateBvh(tracer->placed[i].mesh);
            isThere = tracer->bvhs[mesh] != NULL;
        }
    }
    if (!isThere) {
        destroyTracer(tracer);
        return vtFail(error, vt_errorMemory, "path: out of memory for %u objects", scene->objectCount);
    }
    vtVec3 low, high;
    vtScene_Bounds(scene, &low, &high);
    tracer->same = 1e-5f * vtLength(vtSub(high, low));
    return vt_ok;
}

/// The object's first surface beyond `start`. `sides`: 1 entered through, 2 left through, 3 either.
static bool traceObject(const Tracer* tracer, uint32_t object, vtVec3 origin, vtVec3 direction, float start,
                        int sides, vtBvhHit* hit)
{
    const vtPlacedObject* placed = &tracer->placed[object];
    const vtBvh* bvh = tracer->bvhs[placed->meshIndex];
    // Not made a unit vector, so that distances are the world's.
    const vtVec3 o = vtTransformPoint(&placed->toObject, origin);
    const vtVec3 d = vtTransformVector(&placed->toObject, direction);
    vtBvhHit hits[2] = {{.distance = FLT_MAX}, {.distance = FLT_MAX}};
    const bool enters = (sides & 1) != 0 && vtBvh_Trace(bvh, o, d, start, false, &hits[0]);
    const bool leaves = (sides & 2) != 0 && vtBvh_Trace(bvh, o, d, start, true, &hits[1]);
    *hit = leaves && (!enters || hits[1].distance < hits[0].distance) ? hits[1] : hits[0];
    return enters || leaves;
}

/// The nearest surface of all objects; false where there is none. `start` is 0 at the eye, of which nothing
/// says what it is within.
static bool findNearest(const Tracer* tracer, const vtMedia* media, vtVec3 origin, vtVec3 direction,
                        float start, Meeting* meeting)
{
    const uint32_t count = tracer->scene->objectCount;
    float opaque = FLT_MAX;
    *meeting = (Meeting){.object = count, .hit.distance = FLT_MAX, .also = count};
    for (uint32_t i = 0; i < count; ++i) {
        const bool isOpaque = i >= tracer->glassCount;
        const int sides = isOpaque || start <= 0.0f ? 3 : vtMedia_Holds(media, i + 1) ? 2 : 1;
        vtBvhHit hit;
        if (!traceObject(tracer, i, origin, direction, start, sides, &hit)) {
            continue;
        }
        opaque = isOpaque ? fminf(opaque, hit.distance) : opaque;
        const bool isSame = fabsf(hit.distance - meeting->hit.distance) <= tracer->same;
        if (isSame && !isOpaque) {
            meeting->also = i; // touching glass is crossed at once
        } else if (!isSame && hit.distance < meeting->hit.distance) {
            *meeting = (Meeting){.object = i, .hit = hit, .also = count};
        }
    }
    meeting->touchesOpaque = opaque - meeting->hit.distance <= tracer->same;
    return meeting->object < count;
}

// -------------------------------------------------------------------------------------------------- events

static float indexOf(const Tracer* tracer, uint32_t id)
{
    return id == 0 ? 1.0f : tracer->ior > 0.0f ? tracer->ior : tracer->placed[id - 1].material->ior;
}

/// Takes the path through a surface of glass: an event, where indices differ, or straight on. False where an
/// event is one too many.
static bool cross(const Tracer* tracer, const Meeting* meeting, int maxEvents, vtVec3 position,
                  vtMedia* media, vtVec3* direction, vtPath* path)
{
    const vtPlacedObject* placed = &tracer->placed[meeting->object];
    const vtReliefTriangle triangle = readTriangle(placed->mesh, meeting->hit.triangle);
    const vtVec3* corners = triangle.corners;
    const vtVec3 flat = vtCross(vtSub(corners[1], corners[0]), vtSub(corners[2], corners[0]));
    const vtVec3 G = toWorld(placed, flat);
    const vtVec3 N = toWorld(placed, interpolate(triangle.normals, &meeting->hit));
    const vtVec3 I = *direction;
    // The surface says on which side of it the path is.
    const bool leaving = vtDot(G, I) > 0.0f;
    if (leaving != vtMedia_Holds(media, meeting->object + 1)) {
        vtMedia_Toggle(media, meeting->object + 1);
    }
    vtMedia next = *media;
    vtMedia_Toggle(&next, meeting->object + 1);
    if (meeting->also < tracer->glassCount) {
        vtMedia_Toggle(&next, meeting->also + 1);
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

static void follow(const Tracer* tracer, int maxEvents, vtVec3 origin, vtVec3 direction, vtPath* path)
{
    vtMedia media = {{0}};
    Meeting meeting;
    float start = 0.0f;
    bool isLost = false;
    for (int pass = 0; !isLost && findNearest(tracer, &media, origin, direction, start, &meeting); ++pass) {
        const vtPlacedObject* placed = &tracer->placed[meeting.object];
        const vtReliefTriangle triangle = readTriangle(placed->mesh, meeting.hit.triangle);
        origin = vtTransformPoint(&placed->toWorld, interpolate(triangle.corners, &meeting.hit));
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

vtResult vtTracePath(const vtScene* scene, const vtFrame* frame, float x, float y, vtPath* path,
                     vtError* error)
{
    *path = (vtPath){0};
    Tracer tracer;
    vtResult result = vtValidateFrame(frame, error);
    if (result == vt_ok) {
        result = createTracer(scene, &tracer, error);
    }
    if (result != vt_ok) {
        return result;
    }
    tracer.ior = frame->ior;
    const vtCameraFrame camera = vtMakeCameraFrame(&frame->view);
    const float tangent = tanf(frame->view.fovY * VT_PI / 360.0f);
    const float across =
        (x / (float)frame->width * 2.0f - 1.0f) * tangent * (float)frame->width / (float)frame->height;
    const float up = (1.0f - y / (float)frame->height * 2.0f) * tangent;
    const vtVec3 direction = vtMulAdd(vtMulAdd(camera.forward, across, camera.right), up, camera.up);
    follow(&tracer, vtResolveFrame(frame).maxEvents, camera.eye, vtNormalize(direction), path);
    destroyTracer(&tracer);
    return vtSucceed(error);
}
