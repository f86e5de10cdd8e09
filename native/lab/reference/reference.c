// The reference's scene, and rays through it. Pictures: reference_trace.c; the paths of light:
// reference_paths.c.
//
// Instances are no matter of Embree's here: a ray is put to one object after the other, in the object's
// coordinates and with its direction's length as it comes out of that, so that distances are the world's
// everywhere. So what a ray meets does not depend on how objects are arranged in a search structure; where
// there are many, one only leaves out those that lie beside all rays (reference_boxes.c).
#include "lab/reference/reference.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "image/image.h"
#include "lab/reference/reference_scene.h"
#include "shaders_es3/common/constants.h"

/// Embree copies nothing by itself and reads beyond shared buffers, so it gets buffers of its own.
bool vtFillScene(RTCDevice device, RTCScene scene, const vtMesh* mesh, const vtSpace* space)
{
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const size_t vertexSize = 3 * sizeof(float), triangleSize = 3 * sizeof(uint32_t);
    float* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                               vertexSize, mesh->vertexCount);
    uint32_t* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                triangleSize, mesh->indexCount / 3);
    const bool filled = positions != NULL && indices != NULL;
    if (filled) {
        for (size_t i = 0; i < mesh->vertexCount; ++i) {
            const vtVec3 p = vtSpace_Enter(space, vtMakeVec3(mesh->positions + 3 * i));
            memcpy(positions + 3 * i, &p, vertexSize);
        }
        memcpy(indices, mesh->indices, sizeof(uint32_t) * mesh->indexCount);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        // No rays through cracks along edges.
        rtcSetSceneFlags(scene, rtcGetSceneFlags(scene) | RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
        rtcCommitScene(scene);
    }
    rtcReleaseGeometry(geometry);
    return filled && rtcGetDeviceError(device) == RTC_ERROR_NONE;
}

/// A relief is met by its heights, in the mesh's own coordinates.
static vtSpace spaceOf(const vtMesh* mesh)
{
    return mesh->indexCount == 0 ? vtOuterSpace() : vtSpaceOfBox(mesh->boundsMin, mesh->boundsMax);
}

/// Takes objects and lights into the reference's space. False where memory is short.
static bool enterSpace(vtReference* reference)
{
    const vtScene* scene = reference->scene;
    vtVec3 low = {FLT_MAX, FLT_MAX, FLT_MAX}, high = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    const bool any = reference->glassCount > 0;
    reference->space = vtSpaceOfObjects(reference->objects, reference->objectCount);
    for (uint32_t i = 0; i < reference->objectCount; ++i) {
        vtPlacedObject* object = &reference->objects[i];
        const vtSpace own = spaceOf(object->mesh);
        vtPlacedObject_Enter(object, &own, &reference->space);
        const vtVec3 a = object->low, b = object->high;
        if (i < reference->glassCount || !any) {
            low = (vtVec3){fminf(low.x, a.x), fminf(low.y, a.y), fminf(low.z, a.z)};
            high = (vtVec3){fmaxf(high.x, b.x), fmaxf(high.y, b.y), fmaxf(high.z, b.z)};
        }
    }
    reference->extent = fmaxf(vtLength(vtSub(high, low)), 1e6f * FLT_MIN);
    reference->lights = calloc(scene->lightCount > 0 ? scene->lightCount : 1, sizeof *reference->lights);
    for (uint32_t i = 0; i < scene->lightCount && reference->lights != NULL; ++i) {
        reference->lights[i] = vtLight_Enter(&scene->lights[i], &reference->space);
    }
    return reference->lights != NULL;
}

/// Has some object of that mesh only one side?
static bool isOneSided(const vtReference* reference, uint32_t mesh)
{
    bool found = false;
    for (uint32_t i = reference->glassCount; i < reference->objectCount; ++i) {
        const vtPlacedObject* object = &reference->objects[i];
        found = found || (object->meshIndex == mesh && object->material->oneSided);
    }
    return found;
}

static vtResult fillReference(vtReference* reference, vtError* error)
{
    reference->device = rtcNewDevice(NULL);
    reference->meshes = calloc(reference->scene->meshCount, sizeof(RTCScene));
    for (uint32_t i = 0; i < reference->objectCount; ++i) {
        const vtPlacedObject* object = &reference->objects[i];
        if (reference->device == NULL || reference->meshes == NULL) {
            return vtFail(error, vt_errorMemory, "reference: Embree cannot start, memory is short");
        }
        RTCScene* mesh = &reference->meshes[object->meshIndex];
        if (*mesh == NULL) {
            *mesh = rtcNewScene(reference->device);
            if (isOneSided(reference, object->meshIndex)) {
                rtcSetSceneFlags(*mesh, VT_SCENE_FILTERED); // passBacks
            }
            const bool isRelief = object->mesh->indexCount == 0;
            const bool isFilled =
                *mesh != NULL &&
                (isRelief ? vtFillReliefScene(reference->device, *mesh, object->mesh->heights)
                          : vtFillScene(reference->device, *mesh, object->mesh, &object->own));
            if (!isFilled) {
                return vtFail(error, vt_errorMemory, "reference: Embree cannot hold a mesh of %u triangles",
                              object->mesh->indexCount / 3);
            }
        }
    }
    return vtReference_SortObjects(reference)
               ? vtSucceed(error)
               : vtFail(error, vt_errorMemory, "reference: Embree cannot hold %u objects",
                        reference->objectCount);
}

vtResult vtCreateReference(const vtScene* scene, vtReference** reference, vtError* error)
{
    assert(scene != NULL && reference != NULL);
    *reference = NULL;
    vtPlacedObject* objects;
    uint32_t glassCount;
    vtResult result = vtPlaceObjects(scene, &objects, &glassCount, error);
    if (result != vt_ok) {
        return result;
    }
    *reference = calloc(1, sizeof **reference);
    if (*reference == NULL) {
        vtFree(objects);
        return vtFail(error, vt_errorMemory, "reference: out of memory");
    }
    **reference = (vtReference){
        .scene = scene, .objects = objects, .objectCount = scene->objectCount, .glassCount = glassCount};
    result = enterSpace(*reference) ? fillReference(*reference, error)
                                    : vtFail(error, vt_errorMemory, "reference: out of memory");
    if (result != vt_ok) {
        vtDestroyReference(*reference);
        *reference = NULL;
    }
    return result;
}

void vtDestroyReference(vtReference* reference)
{
    if (reference == NULL) {
        return;
    }
    for (uint32_t i = 0; reference->meshes != NULL && i < reference->scene->meshCount; ++i) {
        if (reference->meshes[i] != NULL) {
            rtcReleaseScene(reference->meshes[i]);
        }
    }
    if (reference->boxes != NULL) {
        rtcReleaseScene(reference->boxes);
    }
    if (reference->device != NULL) {
        rtcReleaseDevice(reference->device);
    }
    free(reference->meshes);
    vtFree(reference->objects);
    free(reference->lights);
    free(reference);
}

// -------------------------------------------------------------------------------------------------- rays

/// Whether the ray meets the object's box, made a little larger, at a distance from 0 to `far`.
static bool meetsBox(const vtPlacedObject* object, const vtReferencePath* path, float margin, float far)
{
    const float low[3] = {object->low.x, object->low.y, object->low.z};
    const float high[3] = {object->high.x, object->high.y, object->high.z};
    const float origin[3] = {path->origin.x, path->origin.y, path->origin.z};
    const float direction[3] = {path->direction.x, path->direction.y, path->direction.z};
    float near = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
        const float first = (low[axis] - margin - origin[axis]) / direction[axis];
        const float second = (high[axis] + margin - origin[axis]) / direction[axis];
        const float enter = first < second ? first : second, leave = first < second ? second : first;
        near = enter > near ? enter : near;
        far = leave < far ? leave : far;
    }
    return near <= far;
}

/// From where on the object's surfaces count.
static float startOf(const vtReference* reference, const vtReferencePath* path, uint32_t object)
{
    float start = path->passed > 0.0f ? vtStepBeyond(reference, path->passed) : 0.0f;
    for (int i = 0; i < path->startCount; ++i) {
        if (path->startObjects[i] == object) {
            // An opaque surface that touches the glass is left to either side.
            const float near =
                object < reference->glassCount ? path->near : VT_SELF_DISTANCE * reference->extent;
            start = near > start ? near : start;
        }
    }
    return start;
}

/// How far it matters what the object has: its far side must not be missed where the ray is within.
static float limitOf(const vtReference* reference, const vtReferencePath* path, const vtMeeting* meeting,
                     uint32_t object)
{
    if (object < reference->glassCount && vtMedia_Holds(&path->within, reference->objects[object].body + 1)) {
        return INFINITY;
    }
    const float touching = meeting->nearest + VT_TOUCH_DISTANCE * reference->extent;
    return object >= reference->glassCount && meeting->opaque.distance < touching ? meeting->opaque.distance
                                                                                  : touching;
}

static void keepGlass(const vtReference* reference, vtMeeting* meeting, const vtSurfaceHit* hit)
{
    const float touching = VT_TOUCH_DISTANCE * reference->extent;
    if (hit->distance > meeting->nearest + touching) {
        return;
    }
    if (hit->distance < meeting->nearest) {
        meeting->nearest = hit->distance;
        int kept = 0;
        for (int i = 0; i < meeting->glassCount; ++i) {
            if (meeting->glass[i].distance <= hit->distance + touching) {
                meeting->glass[kept++] = meeting->glass[i];
            }
        }
        meeting->glassCount = kept < VT_MAX_TOUCHING ? kept : VT_MAX_TOUCHING - 1;
    }
    if (meeting->glassCount < VT_MAX_TOUCHING) {
        meeting->glass[meeting->glassCount++] = *hit;
    }
}

/// The packet's rays as the object sees them; lanes beyond `count` repeat the first.
static void aimAt(const vtReference* reference, uint32_t object, const vtReferencePath* paths,
                  const uint32_t* numbers, int count, const vtMeeting* meetings, struct RTCRayHit8* query)
{
    const vtTransform* toObject = &reference->objects[object].toObject;
    for (int lane = 0; lane < VT_PACKET; ++lane) {
        const int source = lane < count ? lane : 0;
        const vtReferencePath* path = &paths[numbers[source]];
        const vtVec3 origin = vtTransformPoint(toObject, path->origin);
        const vtVec3 direction = vtTransformVector(toObject, path->direction);
        vtSetPacketRay(query, lane, origin, direction);
        query->ray.tnear[lane] = startOf(reference, path, object);
        query->ray.tfar[lane] = limitOf(reference, path, &meetings[source], object);
    }
}

/// Embree asks about every triangle that lanes meet: one that they come at from behind is none. Rays and hits
/// are arrays, a field of all lanes after the other (rtcore_ray.h).
static void passBacks(const struct RTCFilterFunctionNArguments* arguments)
{
    const unsigned n = arguments->N;
    const float *direction = (const float*)(const void*)arguments->ray + 4 * n,
                *normal = (const float*)(const void*)arguments->hit;
    for (unsigned i = 0; i < n; ++i) {
        float along = 0.0f;
        for (unsigned axis = 0; axis < 3; ++axis) {
            along += direction[axis * n + i] * normal[axis * n + i];
        }
        arguments->valid[i] = along > 0.0f ? 0 : arguments->valid[i];
    }
}

void vtReference_Meet(const vtReference* reference, const vtReferencePath* paths, const uint32_t* numbers,
                      int count, bool coherent, vtMeeting* meetings)
{
    _Alignas(32) int valid[VT_PACKET];
    int sidesAhead[VT_PACKET] = {0}; // of objects that the ray is within
    for (int lane = 0; lane < VT_PACKET; ++lane) {
        valid[lane] = lane < count ? -1 : 0;
    }
    for (int lane = 0; lane < count; ++lane) {
        meetings[lane].nearest = meetings[lane].opaque.distance = INFINITY;
        meetings[lane].opaque.triangle = VT_NO_TRIANGLE;
        meetings[lane].glassCount = 0;
    }
    const float margin = VT_TOUCH_DISTANCE * reference->extent;
    uint64_t objects[VT_OBJECT_WORDS];
    vtReference_FindObjects(reference, paths, numbers, count, coherent, objects);
    for (uint32_t object = 0; object < reference->objectCount; ++object) {
        if (objects[object / 64] == 0) {
            object |= 63; // none of these
            continue;
        }
        if ((objects[object / 64] >> object % 64 & 1) == 0) {
            continue;
        }
        const vtPlacedObject* placed = &reference->objects[object];
        bool any = false;
        for (int lane = 0; lane < count && !any; ++lane) {
            const vtReferencePath* path = &paths[numbers[lane]];
            any = meetsBox(placed, path, margin, limitOf(reference, path, &meetings[lane], object));
        }
        if (!any) {
            continue;
        }
        struct RTCRayHit8 query;
        aimAt(reference, object, paths, numbers, count, meetings, &query);
        const bool hasBack = !placed->material->opaque || !placed->material->oneSided;
        vtRayQuery how = vtMakeRayQuery(coherent, hasBack ? NULL : passBacks);
        vtIntersect8(valid, reference->meshes[placed->meshIndex], &how, &query);
        for (int lane = 0; lane < count; ++lane) {
            if (query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) {
                continue;
            }
            const vtSurfaceHit hit = {query.ray.tfar[lane], object, query.hit.primID[lane], query.hit.u[lane],
                                      query.hit.v[lane]};
            if (object >= reference->glassCount) {
                if (hit.distance < meetings[lane].opaque.distance) {
                    meetings[lane].opaque = hit;
                }
            } else {
                keepGlass(reference, &meetings[lane], &hit);
                sidesAhead[lane] += vtMedia_Holds(&paths[numbers[lane]].within, placed->body + 1);
            }
        }
    }
    for (int lane = 0; lane < count; ++lane) {
        int sides = 0;
        for (int i = 0; i < VT_MAX_NESTED; ++i) {
            sides += paths[numbers[lane]].within.ids[i] != 0;
        }
        meetings[lane].missed = sidesAhead[lane] < sides;
    }
}

// ------------------------------------------------------------------------------------------------ images

void vtDestroyReferenceImage(vtReferenceImage* image)
{
    free(image->directions);
    free(image->events);
    free(image->states);
    free(image->reflections);
    free(image->radiance);
    free(image->covered);
    *image = (vtReferenceImage){0};
}

void vtReference_ToSrgb(const vtReferenceImage* image, uint8_t* rgba)
{
    assert(image->radiance != NULL);
    const size_t count = (size_t)image->width * (size_t)image->height;
    for (size_t i = 0; i < count; ++i) {
        for (size_t channel = 0; channel < 3; ++channel) {
            const float encoded = vtLinearToSrgb(image->radiance[3 * i + channel]);
            rgba[4 * i + channel] = (uint8_t)(vtClamp(encoded, 0.0f, 1.0f) * 255.0f + 0.5f);
        }
        rgba[4 * i + 3] = 255;
    }
}
