// A relief as a primitive of Embree's, without triangles: scene/height_trace.c finds what its rays meet.
#include <math.h>

#include "lab/reference/reference_scene.h"
#include "mesh/mesh_triangle.h"
#include "relief/height_trace.h"

/// Members of Embree's rays and hits, by their place in the packet: N numbers of each, one after the other.
enum {
    rayOrigin = 0,
    rayNear = 3,
    rayDirection = 4,
    rayFar = 8,
    hitNormal = 12,
    hitU = 15,
    hitV,
    hitTriangle,
    hitGeometry,
    hitInstance
};

static void bound(const struct RTCBoundsFunctionArguments* arguments)
{
    const vtHeightField* field = arguments->geometryUserPtr;
    const vtVec3 far = vtHeightField_Corner(field, field->width - 1, field->height - 1);
    // So much larger that rounding in Embree's box loses no ray.
    const vtVec3 size = {far.x - field->left, far.y - field->bottom, field->high - field->back};
    const float margin = 1e-5f * vtLength(size);
    *arguments->bounds_o = (struct RTCBounds){.lower_x = field->left - margin,
                                              .lower_y = field->bottom - margin,
                                              .lower_z = field->back - margin,
                                              .upper_x = far.x + margin,
                                              .upper_y = far.y + margin,
                                              .upper_z = field->high + margin};
}

static vtVec3 readVector(const float* first, unsigned stride)
{
    return (vtVec3){first[0], first[stride], first[2 * (size_t)stride]};
}

static void intersect(const struct RTCIntersectFunctionNArguments* arguments)
{
    const vtHeightField* field = arguments->geometryUserPtr;
    const unsigned count = arguments->N;
    for (unsigned i = 0; i < count; ++i) {
        float* lane = (float*)(void*)arguments->rayhit + i;
        unsigned* ids = (unsigned*)(void*)arguments->rayhit + i;
        const vtVec3 origin = readVector(lane + rayOrigin * count, count);
        const vtVec3 direction = readVector(lane + rayDirection * count, count);
        vtHeightHit hit;
        if (arguments->valid[i] == 0 || !vtHeightField_Trace(field, origin, direction, lane[rayNear * count],
                                                             lane[rayFar * count], 3, vt_separateAll, &hit)) {
            continue;
        }
        vtVec3 p[3];
        vtHeightField_Corners(field, hit.triangle, p);
        const vtVec3 normal = vtCross(vtSub(p[1], p[0]), vtSub(p[2], p[0]));
        lane[rayFar * count] = hit.distance;
        lane[hitNormal * count] = normal.x;
        lane[(hitNormal + 1) * count] = normal.y;
        lane[(hitNormal + 2) * count] = normal.z;
        lane[hitU * count] = hit.u;
        lane[hitV * count] = hit.v;
        ids[hitTriangle * count] = hit.triangle;
        ids[hitGeometry * count] = arguments->geomID;
        ids[hitInstance * count] = arguments->context->instID[0];
    }
}

bool vtFillReliefScene(RTCDevice device, RTCScene scene, const vtHeightField* field)
{
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, 1);
    rtcSetGeometryUserData(geometry, (void*)(uintptr_t)field);
    rtcSetGeometryBoundsFunction(geometry, bound, NULL);
    rtcSetGeometryIntersectFunction(geometry, intersect);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
    rtcReleaseGeometry(geometry);
    return rtcGetDeviceError(device) == RTC_ERROR_NONE;
}
