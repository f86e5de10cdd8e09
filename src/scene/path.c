// One exact path, for people who want to see what light does: the event loop that the techniques imitate, on
// the CPU.
#include "base/error.h"
#include "base/math.h"
#include "base/optics.h"
#include "scene/bvh.h"
#include "scene/camera.h"

static float degreesBetween(vtVec3 a, vtVec3 b)
{
    return atan2f(vtLength(vtCross(a, b)), vtDot(a, b)) * 180.0f / VT_PI;
}

static vtVec3 interpolate(const vtMesh* mesh, const float* values, const vtBvhHit* hit)
{
    const uint32_t* corners = mesh->indices + 3 * (size_t)hit->triangle;
    vtVec3 sum = vtScale(vtMakeVec3(values + 3 * (size_t)corners[0]), 1.0f - hit->u - hit->v);
    sum = vtMulAdd(sum, hit->u, vtMakeVec3(values + 3 * (size_t)corners[1]));
    return vtMulAdd(sum, hit->v, vtMakeVec3(values + 3 * (size_t)corners[2]));
}

static vtVec3 flatNormal(const vtMesh* mesh, uint32_t triangle)
{
    const uint32_t* corners = mesh->indices + 3 * (size_t)triangle;
    vtVec3 a = vtMakeVec3(mesh->positions + 3 * (size_t)corners[0]);
    vtVec3 b = vtMakeVec3(mesh->positions + 3 * (size_t)corners[1]);
    vtVec3 c = vtMakeVec3(mesh->positions + 3 * (size_t)corners[2]);
    return vtNormalize(vtCross(vtSub(b, a), vtSub(c, a)));
}

vtResult vtTracePath(const vtMesh* mesh, const vtFrame* frame, float x, float y, vtPath* path, vtError* error)
{
    *path = (vtPath){0};
    vtResult result = vtValidateFrame(frame, error);
    if (result != vt_ok) {
        return result;
    }
    const int maxEvents = vtResolveFrame(frame).maxEvents;
    vtBvh* bvh = vtCreateBvh(mesh);
    if (bvh == NULL) {
        return vtFail(error, vt_errorMemory, "path: out of memory for %u triangles", mesh->indexCount / 3);
    }
    vtCameraFrame camera = vtMakeCameraFrame(&frame->view);
    float tangent = tanf(frame->view.fovY * VT_PI / 360.0f);
    float across =
        (x / (float)frame->width * 2.0f - 1.0f) * tangent * (float)frame->width / (float)frame->height;
    float up = (1.0f - y / (float)frame->height * 2.0f) * tangent;
    vtVec3 origin = camera.eye;
    vtVec3 direction = vtNormalize(vtMulAdd(vtMulAdd(camera.forward, across, camera.right), up, camera.up));

    float start = 0.0f;
    bool inside = false;
    vtBvhHit hit;
    while (path->eventCount < maxEvents && vtBvh_Trace(bvh, origin, direction, start, inside, &hit)) {
        vtPathEvent* event = &path->events[path->eventCount++];
        vtVec3 normal = vtNormalize(interpolate(mesh, mesh->normals, &hit));
        vtVec3 flat = flatNormal(mesh, hit.triangle);
        vtVec3 against = inside ? vtScale(normal, -1.0f) : normal;
        origin = interpolate(mesh, mesh->positions, &hit);
        event->position = origin;
        event->incoming = degreesBetween(vtScale(direction, -1.0f), against);
        direction = vtMeetSurface(direction, normal, flat, frame->ior, &inside, &event->reflected);
        event->outgoing = degreesBetween(direction, event->reflected ? against : vtScale(against, -1.0f));
        start = 1e-5f * vtLength(vtSub(mesh->boundsMax, mesh->boundsMin));
    }
    path->exited =
        !inside && (path->eventCount < maxEvents || !vtBvh_Trace(bvh, origin, direction, start, false, &hit));
    path->direction = direction;
    vtDestroyBvh(bvh);
    return vtSucceed(error);
}
