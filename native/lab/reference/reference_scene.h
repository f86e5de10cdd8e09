// What the files of the reference share: the scene, rays through it, and paths.
#pragma once

#include "base/math.h"
#include "lab/reference/embree.h"
#include "lab/reference/reference.h"
#include "light/caustics.h"
#include "light/ground_map.h"
#include "light/look.h"
#include "scene/media.h"
#include "scene/objects.h"
#include "shaders_es3/common/constants.h"

struct vtReference {
    const vtScene* scene;
    RTCDevice device;
    RTCScene* meshes;        ///< one for each mesh of the scene, in its own coordinates; NULL: no object's
    RTCScene boxes;          ///< of the objects, where there are many; else NULL
    vtPlacedObject* objects; ///< glass, then what is opaque
    uint32_t objectCount, glassCount;
    vtSpace space; ///< of the scene's world, that all here is in
    vtLight* lights;
    float extent; ///< what small distances are measured by
};

/// Of the extent. Of the objects that a path starts from, surfaces nearer than the first are never looked at,
/// which saves asking again after most self-hits; those of the wrong side nearer than the second are
/// self-hits. Rounding is about 1e-7; between 1e-7 and 1e-5 the first makes no difference to any pixel of the
/// tests' models. Surfaces of several objects that lie no farther apart than the third touch.
#define VT_START_DISTANCE 1e-6f
#define VT_SELF_DISTANCE 1e-4f
#define VT_TOUCH_DISTANCE 1e-5f

/// Most objects whose surfaces a path can meet at one place. Where there are more, the others' follow.
#define VT_MAX_TOUCHING 4

/// Rays that Embree takes at a time.
#define VT_PACKET 8

/// A point of an object's surface on a ray.
typedef struct vtSurfaceHit {
    float distance;
    uint32_t object;   ///< its rank
    uint32_t triangle; ///< VT_NO_TRIANGLE: the ray met nothing
    float u, v;        ///< weights of the triangle's second and third corner
} vtSurfaceHit;

/// What is next on a ray.
typedef struct vtMeeting {
    float nearest;                       ///< distance of the first surface of glass; INFINITY: none
    vtSurfaceHit glass[VT_MAX_TOUCHING]; ///< that surface and those that it touches, by rank
    int glassCount;
    vtSurfaceHit opaque; ///< the first opaque one, unless it lies behind glass that it does not touch
    bool missed;         ///< an object that the ray is within has no surface ahead
} vtMeeting;

/// A path between two events.
typedef struct vtReferencePath {
    vtVec3 origin, direction;
    vtVec3 weight;    ///< share of the light at its end that arrives at the eye
    vtVec3 light;     ///< that surfaces on its way have sent there already
    float near;       ///< distance from which the surfaces of the objects count that it starts from
    float passed;     ///< distance of the last surface passed by since the last event; 0: none
    vtMedia within;   ///< scene/media.h
    vtSurfaceHit end; ///< state VT_PATH_OPAQUE: where
    uint32_t source;  ///< number of the path at the eye that it is or has branched off from
    uint32_t startObjects[VT_MAX_TOUCHING + 1], startTriangles[VT_MAX_TOUCHING + 1]; ///< where it starts
    uint16_t passes;                                                                 ///< surfaces passed by
    uint8_t startCount;                                                              ///< 0 at the eye
    uint8_t events;
    uint8_t state; ///< VT_PATH_..., once it has ended
    bool ended, reflected;
    bool throughWall; ///< it has passed a thin wall
    bool nudged;      ///< see vtNudge
    bool parted;      ///< it has light of one spread only
    bool mirrored;    ///< what the surface ahead mirrors of it has branched off already
    float spread;     ///< of a wavelength, see reference_spectrum.h
    uint32_t key;     ///< what it draws its chances by
} vtReferencePath;

/// Paths from the eye, and those that branch off from them.
typedef struct vtPathList {
    vtReferencePath* paths;
    uint32_t* active; ///< numbers of those under way; room for all
    uint32_t count, capacity;
} vtPathList;

typedef struct vtPathRules {
    float ior; ///< of all glass; 0: each object's own
    int maxEvents;
    bool fresnel;
    const vtIllumination* illumination; ///< NULL: only where paths go is asked for
    float exposure;                     ///< factor
    float roughness, dispersion;        ///< of all glass; below 0: each object's own
    /// With all that is decided by chance: roughness, wavelengths, what little light goes on. Else surfaces
    /// are smooth, glass has one index, and paths of less than 0.002 are left out.
    bool chance;
    uint32_t sample;              ///< its number
    const vtCausticMap* caustics; ///< light that glass bends onto opaque things; NULL: it goes straight on
    const struct vtSpectrum* spectrum; ///< NULL: three paths at the channels' means in place of one
} vtPathRules;

/// Fills an empty Embree scene with a mesh's triangles, in a space, and one with a relief without any.
bool vtFillScene(RTCDevice device, RTCScene scene, const vtMesh* mesh, const vtSpace* space);
bool vtFillReliefScene(RTCDevice device, RTCScene scene, const vtHeightField* field);

/// A bit an object.
#define VT_OBJECT_WORDS ((VT_MAX_OBJECTS + 63) / 64)

/// Builds the boxes' hierarchy where there are objects enough. False where memory is short.
bool vtReference_SortObjects(vtReference* reference);

/// The bits of the objects whose boxes a packet's rays can meet, of all where there are few.
void vtReference_FindObjects(const vtReference* reference, const vtReferencePath* paths,
                             const uint32_t* numbers, int count, bool coherent,
                             uint64_t objects[VT_OBJECT_WORDS]);

/// What is next for `count` paths, 1 to VT_PACKET, given by their numbers. `coherent`: neighbours go much the
/// same way.
void vtReference_Meet(const vtReference* reference, const vtReferencePath* paths, const uint32_t* numbers,
                      int count, bool coherent, vtMeeting* meetings);

/// One ray at the meshes of a scene of Embree's.
static inline struct RTCRayHit vtTraceRay(RTCScene scene, vtRayQuery* how, vtVec3 origin, vtVec3 direction)
{
    struct RTCRayHit query = {.ray = {.org_x = origin.x,
                                      .org_y = origin.y,
                                      .org_z = origin.z,
                                      .dir_x = direction.x,
                                      .dir_y = direction.y,
                                      .dir_z = direction.z,
                                      .tfar = INFINITY,
                                      .mask = ~0u},
                              .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    vtIntersect1(scene, how, &query);
    return query;
}

/// Empties the list, with room for paths kept. A zeroed list is empty.
static inline void vtPathList_Clear(vtPathList* list)
{
    list->count = 0;
}

/// False where memory is short.
bool vtPathList_Add(vtPathList* list, const vtReferencePath* path);
void vtDestroyPathList(vtPathList* list);

/// Follows paths from the eye, all that the list holds, until each has ended; those that branch off are added
/// to it. False where memory is short.
bool vtFollowPaths(const vtReference* reference, const vtPathRules* rules, vtPathList* list);

/// What falls on a ground below the scene, and through glass on opaque things: photons that follow the rules,
/// of which `sample` does not count. Both maps are to be destroyed. Fails as vtPlanGround does; then they are
/// zeroed.
vtResult vtReference_LightGround(const vtReference* reference, const vtPathRules* rules,
                                 const vtGround* ground, const vtEnvironment* environment, int threads,
                                 vtGroundMap* map, vtCausticMap* caustics, vtError* error);

/// A path that starts at the eye, which lies within these objects.
static inline vtReferencePath vtMakePath(vtVec3 origin, vtVec3 direction, vtMedia within, uint32_t source)
{
    return (vtReferencePath){.origin = origin,
                             .direction = direction,
                             .weight = {1.0f, 1.0f, 1.0f},
                             .within = within,
                             .source = source};
}

/// Where to look on after a surface at `distance` that does not count.
static inline float vtStepBeyond(const vtReference* reference, float distance)
{
    return distance * 1.000001f + 1e-7f * reference->extent;
}

/// A direction 1e-5 (0.0006 degrees) beside this one. Embree can miss a surface where a ray meets a vertex
/// exactly, its robust mode included (its issues 174 and 181), and vertices do face vertices in regular
/// shapes: a ray that misses the far side of the glass it is in asks once more this way.
static inline vtVec3 vtNudge(vtVec3 direction)
{
    const vtVec3 axis = fabsf(direction.x) < 0.5f ? (vtVec3){1.0f, 0.0f, 0.0f} : (vtVec3){0.0f, 1.0f, 0.0f};
    return vtNormalize(vtMulAdd(direction, 1e-5f, vtCross(direction, axis)));
}

/// A ray of a packet from its origin to infinity, nothing met yet.
static inline void vtSetPacketRay(struct RTCRayHit8* query, int lane, vtVec3 origin, vtVec3 direction)
{
    query->ray.org_x[lane] = origin.x;
    query->ray.org_y[lane] = origin.y;
    query->ray.org_z[lane] = origin.z;
    query->ray.dir_x[lane] = direction.x;
    query->ray.dir_y[lane] = direction.y;
    query->ray.dir_z[lane] = direction.z;
    query->ray.tnear[lane] = 0.0f;
    query->ray.tfar[lane] = INFINITY;
    query->ray.time[lane] = 0.0f;
    query->ray.mask[lane] = ~0u;
    query->ray.flags[lane] = 0;
    query->hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
}
