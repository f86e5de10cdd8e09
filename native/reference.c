// The reference's scene, and what is asked of it besides pictures. Pictures: reference_trace.c; the paths
// of light: reference_paths.c.
#include "reference.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/image.h"
#include "base/math.h"
#include "reference_scene.h"

/// Embree copies nothing by itself and reads beyond shared buffers, so it gets buffers of its own.
static bool fillScene(vtReference* reference, const vtMesh* mesh)
{
    RTCGeometry geometry = rtcNewGeometry(reference->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const size_t vertexSize = 3 * sizeof(float), triangleSize = 3 * sizeof(uint32_t);
    float* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                               vertexSize, mesh->vertexCount);
    uint32_t* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                triangleSize, mesh->indexCount / 3);
    reference->normals = malloc(vertexSize * mesh->vertexCount);
    const bool filled = positions != NULL && indices != NULL && reference->normals != NULL;
    if (filled) {
        memcpy(positions, mesh->positions, vertexSize * mesh->vertexCount);
        memcpy(indices, mesh->indices, sizeof(uint32_t) * mesh->indexCount);
        memcpy(reference->normals, mesh->normals, vertexSize * mesh->vertexCount);
        reference->positions = positions;
        reference->indices = indices;
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(reference->scene, geometry);
        rtcSetSceneFlags(reference->scene, RTC_SCENE_FLAG_ROBUST); // no rays through cracks along edges
        rtcSetSceneBuildQuality(reference->scene, RTC_BUILD_QUALITY_HIGH);
        rtcCommitScene(reference->scene);
    }
    rtcReleaseGeometry(geometry);
    return filled && rtcGetDeviceError(reference->device) == RTC_ERROR_NONE;
}

/// Rounding errors go with the size of the coordinates: far from the origin they outgrow the object.
static float measureExtent(const vtMesh* mesh)
{
    const float diagonal = vtLength(vtSub(mesh->boundsMax, mesh->boundsMin));
    const float distance = fmaxf(vtLength(mesh->boundsMin), vtLength(mesh->boundsMax));
    return fmaxf(fmaxf(diagonal, distance), 1e6f * FLT_MIN);
}

vtResult vtCreateReference(const vtMesh* mesh, vtReference** reference, vtError* error)
{
    assert(mesh != NULL && reference != NULL && mesh->indexCount >= 3);
    *reference = calloc(1, sizeof **reference);
    if (*reference != NULL) {
        (*reference)->vertexCount = mesh->vertexCount;
        (*reference)->extent = measureExtent(mesh);
        (*reference)->device = rtcNewDevice(NULL);
        if ((*reference)->device != NULL) {
            (*reference)->scene = rtcNewScene((*reference)->device);
            if (fillScene(*reference, mesh)) {
                return vtSucceed(error);
            }
        }
    }
    vtDestroyReference(*reference);
    *reference = NULL;
    return vtFail(error, vt_errorMemory, "reference: Embree cannot hold a mesh of %u triangles",
                  mesh->indexCount / 3);
}

void vtDestroyReference(vtReference* reference)
{
    if (reference == NULL) {
        return;
    }
    if (reference->scene != NULL) {
        rtcReleaseScene(reference->scene);
    }
    if (reference->device != NULL) {
        rtcReleaseDevice(reference->device);
    }
    free(reference->normals);
    free(reference);
}

// ------------------------------------------------------------------------------------------------ images

void vtDestroyReferenceImage(vtReferenceImage* image)
{
    free(image->directions);
    free(image->events);
    free(image->states);
    free(image->reflections);
    free(image->radiance);
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

// --------------------------------------------------------------------------------------- inner distances

/// A triangle around the vertex itself, by position: vertices of the same place are told apart by number
/// only because of their normals.
static bool touches(const vtReference* reference, uint32_t triangle, vtVec3 position)
{
    for (size_t k = 0; k < 3; ++k) {
        const float* corner = reference->positions + 3 * (size_t)reference->indices[3 * (size_t)triangle + k];
        if (corner[0] == position.x && corner[1] == position.y && corner[2] == position.z) {
            return true;
        }
    }
    return false;
}

/// Distance to the first surface met from behind; 0: none.
static float innerDistance(const vtReference* reference, vtVec3 position, vtVec3 direction)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    float near = 0.0f;
    while (true) {
        struct RTCRayHit query = {
            .ray = {.org_x = position.x, .org_y = position.y, .org_z = position.z, .tnear = near},
            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID},
        };
        query.ray.dir_x = direction.x;
        query.ray.dir_y = direction.y;
        query.ray.dir_z = direction.z;
        query.ray.tfar = INFINITY;
        query.ray.mask = ~0u;
        rtcIntersect1(reference->scene, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            return 0.0f;
        }
        const vtVec3 area = vtReference_TriangleArea(reference, query.hit.primID);
        if (vtDot(area, direction) > 0.0f && !touches(reference, query.hit.primID, position)) {
            return query.ray.tfar;
        }
        near = vtStepBeyond(reference, query.ray.tfar);
    }
}

vtResult vtReference_InnerDistances(const vtReference* reference, const vtMesh* mesh, float* distances,
                                    vtError* error)
{
    assert(reference != NULL && mesh != NULL && distances != NULL);
    assert(mesh->vertexCount == reference->vertexCount);
    for (size_t i = 0; i < mesh->vertexCount; ++i) {
        const vtVec3 inward = vtScale(vtMakeVec3(mesh->normals + 3 * i), -1.0f);
        const vtVec3 position = vtMakeVec3(mesh->positions + 3 * i);
        distances[i] = innerDistance(reference, position, inward);
        if (distances[i] == 0.0f) {
            distances[i] = innerDistance(reference, position, vtNudge(inward));
        }
    }
    return vtSucceed(error);
}
