// Which of many objects a packet of rays can meet: a hierarchy of Embree's over their boxes. It leaves out
// what is not met anyway, so that pictures are the same without it; it makes the time of a ray no matter of
// how many objects there are elsewhere.
#include "lab/reference/reference_scene.h"

/// Of up to so many objects each packet tests all boxes itself.
enum { fewObjects = 8 };

/// What Embree hands to `found` with a packet.
typedef struct Search {
    vtRayQuery query; ///< first, as Embree knows only that
    uint64_t* objects;
} Search;

static void bound(const struct RTCBoundsFunctionArguments* arguments)
{
    const vtReference* reference = arguments->geometryUserPtr;
    const vtPlacedObject* object = &reference->objects[arguments->primID];
    // More than vtReference_Meet makes boxes larger by, so that rounding loses none.
    const float margin = 2.0f * VT_TOUCH_DISTANCE * reference->extent;
    *arguments->bounds_o = (struct RTCBounds){.lower_x = object->low.x - margin,
                                              .lower_y = object->low.y - margin,
                                              .lower_z = object->low.z - margin,
                                              .upper_x = object->high.x + margin,
                                              .upper_y = object->high.y + margin,
                                              .upper_z = object->high.z + margin};
}

/// Notes the object, and lets the rays go on.
static void found(const struct RTCIntersectFunctionNArguments* arguments)
{
    Search* search = (Search*)(void*)arguments->context;
    search->objects[arguments->primID / 64] |= UINT64_C(1) << arguments->primID % 64;
}

bool vtReference_SortObjects(vtReference* reference)
{
    if (reference->objectCount <= fewObjects) {
        return true;
    }
    reference->boxes = rtcNewScene(reference->device);
    RTCGeometry geometry = rtcNewGeometry(reference->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, reference->objectCount);
    rtcSetGeometryUserData(geometry, reference);
    rtcSetGeometryBoundsFunction(geometry, bound, NULL);
    rtcSetGeometryIntersectFunction(geometry, found);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(reference->boxes, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(reference->boxes, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(reference->boxes, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(reference->boxes);
    return rtcGetDeviceError(reference->device) == RTC_ERROR_NONE;
}

void vtReference_FindObjects(const vtReference* reference, const vtReferencePath* paths,
                             const uint32_t* numbers, int count, bool coherent,
                             uint64_t objects[VT_OBJECT_WORDS])
{
    for (int i = 0; i < VT_OBJECT_WORDS; ++i) {
        objects[i] = reference->boxes == NULL ? UINT64_MAX : 0;
    }
    if (reference->boxes == NULL) {
        return;
    }
    Search search = {vtMakeRayQuery(coherent, NULL), objects};
    _Alignas(32) int valid[VT_PACKET];
    struct RTCRayHit8 rays;
    for (int lane = 0; lane < VT_PACKET; ++lane) {
        const vtReferencePath* path = &paths[numbers[lane < count ? lane : 0]];
        valid[lane] = lane < count ? -1 : 0;
        vtSetPacketRay(&rays, lane, path->origin, path->direction);
    }
    vtIntersect8(valid, reference->boxes, &search.query, &rays);
}
