// The ways take turns, so that a busy machine slows all alike; times are the processor's.
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/math.h"
#include "lab/metrics/timing.h"
#include "lab/rays/rays.h"
#include "lab/reference/reference_scene.h"
#include "relief/height_trace.h"
#include "scene/camera.h"

/// A square picture of vt_rayCount pixels.
enum { side = 1000 };

typedef struct Ray {
    vtVec3 origin, direction;
} Ray;

/// All that is built of a relief.
typedef struct Built {
    vtMesh mesh; ///< with triangles
    RTCDevice device;
    RTCScene triangles, primitive;
    Ray* rays[vt_raySets];
    atomic_size_t bytes, peak; ///< of Embree
} Built;

// ------------------------------------------------------------------------------------------------ building

static bool countBytes(void* counted, ssize_t bytes, bool post)
{
    Built* built = counted;
    (void)post;
    const size_t now = atomic_fetch_add(&built->bytes, (size_t)bytes) + (size_t)bytes;
    if (now > atomic_load(&built->peak)) {
        atomic_store(&built->peak, now);
    }
    return true;
}

/// A copy of the relief, made anew to be timed.
static vtResult copyRelief(const vtHeightField* field, vtMesh* copy, double* time, vtError* error)
{
    const size_t width = (size_t)field->width, height = (size_t)field->height;
    float* heights = malloc(width * height * sizeof *heights);
    if (heights == NULL) {
        return vtFail(error, vt_errorMemory, "rays: out of memory for %zu heights", width * height);
    }
    for (size_t i = 0; i < width * height; ++i) {
        heights[i] = field->z[(height - 1 - i / width) * width + i % width];
    }
    const vtReliefDef def = {.heights = heights,
                             .width = field->width,
                             .height = field->height,
                             .depth = 1.0f,
                             .thickness = fminf(field->low, 0.0f) - field->back};
    const double start = vtProcessorTime();
    const vtResult result = vtCreateRelief(&def, "rays", copy, error);
    *time = vtProcessorTime() - start;
    free(heights);
    return result;
}

static vtResult buildEmbree(Built* built, vtRayFigures* figures, vtError* error)
{
    built->device = rtcNewDevice("threads=1");
    if (built->device == NULL) {
        return vtFail(error, vt_errorMemory, "rays: Embree cannot start, memory is short");
    }
    rtcSetDeviceMemoryMonitorFunction(built->device, countBytes, built);
    built->triangles = rtcNewScene(built->device);
    const double start = vtProcessorTime();
    const vtSpace space = vtOuterSpace();
    const bool isFilled = vtFillScene(built->device, built->triangles, &built->mesh, &space);
    figures->trianglesBuild = vtProcessorTime() - start;
    figures->embreeBytes = atomic_load(&built->bytes);
    figures->embreePeak = atomic_load(&built->peak);
    built->primitive = rtcNewScene(built->device);
    if (!isFilled || !vtFillReliefScene(built->device, built->primitive, built->mesh.heights)) {
        return vtFail(error, vt_errorMemory, "rays: Embree cannot hold %u triangles",
                      built->mesh.indexCount / 3);
    }
    return vtSucceed(error);
}

static float randomNumber(uint32_t* seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (float)(*seed >> 8) / 16777216.0f;
}

/// From a sphere about the relief to a point of its box.
static Ray randomRay(const vtMesh* mesh, uint32_t* seed)
{
    const float z = 2.0f * randomNumber(seed) - 1.0f, angle = 2.0f * VT_PI * randomNumber(seed);
    const float across = sqrtf(1.0f - z * z);
    const vtVec3 size = vtSub(mesh->boundsMax, mesh->boundsMin);
    const float x = randomNumber(seed), y = randomNumber(seed), depth = randomNumber(seed);
    const vtVec3 target = {mesh->boundsMin.x + x * size.x, mesh->boundsMin.y + y * size.y,
                           mesh->boundsMin.z + depth * size.z};
    const vtVec3 origin =
        vtMulAdd(target, vtLength(size), (vtVec3){across * cosf(angle), across * sinf(angle), z});
    return (Ray){origin, vtNormalize(vtSub(target, origin))};
}

static vtResult makeRays(const vtView* view, Built* built, vtError* error)
{
    for (int set = 0; set < vt_raySets; ++set) {
        built->rays[set] = malloc(vt_rayCount * sizeof *built->rays[set]);
        if (built->rays[set] == NULL) {
            return vtFail(error, vt_errorMemory, "rays: out of memory for %d rays", vt_rayCount);
        }
    }
    const vtCamera camera = vtMakeViewCamera(view);
    const float tangent = tanf(view->fovY * VT_PI / 360.0f);
    uint32_t seed = 1;
    for (int i = 0; i < vt_rayCount; ++i) {
        const float x = (2.0f * ((float)(i % side) + 0.5f) / side - 1.0f) * tangent;
        const float y = (1.0f - 2.0f * ((float)(i / side) + 0.5f) / side) * tangent;
        const vtVec3 direction = vtMulAdd(vtMulAdd(camera.forward, x, camera.right), y, camera.up);
        built->rays[vt_raysOfCamera][i] = (Ray){camera.eye, vtNormalize(direction)};
        built->rays[vt_raysRandom][i] = randomRay(&built->mesh, &seed);
    }
    return vtSucceed(error);
}

static void destroyBuilt(Built* built)
{
    if (built->triangles != NULL) {
        rtcReleaseScene(built->triangles);
    }
    if (built->primitive != NULL) {
        rtcReleaseScene(built->primitive);
    }
    if (built->device != NULL) {
        rtcReleaseDevice(built->device);
    }
    for (int set = 0; set < vt_raySets; ++set) {
        free(built->rays[set]);
    }
    vtDestroyMesh(&built->mesh);
}

// ------------------------------------------------------------------------------------------------- tracing

static bool traceHeights(const vtHeightField* field, const Ray* ray, unsigned separations, vtHeightHit* hit)
{
    return vtHeightField_Trace(field, ray->origin, ray->direction, 0.0f, INFINITY, 3, separations, hit);
}

static size_t tracePacket(RTCScene scene, vtRayQuery* how, const Ray* rays)
{
    static const _Alignas(32) int valid[VT_PACKET] = {-1, -1, -1, -1, -1, -1, -1, -1};
    struct RTCRayHit8 query;
    for (int lane = 0; lane < VT_PACKET; ++lane) {
        vtSetPacketRay(&query, lane, rays[lane].origin, rays[lane].direction);
    }
    vtIntersect8(valid, scene, how, &query);
    size_t hits = 0;
    for (int lane = 0; lane < VT_PACKET; ++lane) {
        hits += query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

static const unsigned separations[vt_rayWays] = {
    [vt_wayDirect] = vt_separateAll,
    [vt_wayThree] = vt_separateBox | vt_separateShadow | vt_separateCells,
    [vt_wayWithoutCells] = vt_separateBox | vt_separateShadow,
    [vt_wayWithoutShadow] = vt_separateBox | vt_separateCells,
    [vt_wayWithoutBox] = vt_separateShadow | vt_separateCells,
};

/// Every how manieth ray is traced: slow ways have fewer.
static int strideOf(vtRayWay way, const vtHeightField* field)
{
    const double cells = (double)field->width * (double)field->height;
    return way == vt_wayWithoutShadow
               ? (int)fmin(vt_rayCount / 8, 1.0 + cells / 40.0) // some 40 million cells
           : way > vt_wayPackets ? 16
                                 : 1;
}

/// Milliseconds that vt_rayCount rays take, measured on some of them. *hits: how many met something.
static double timeWay(const Built* built, vtRaySet set, vtRayWay way, size_t* hits)
{
    vtRayQuery how = vtMakeRayQuery(set == vt_raysOfCamera, NULL);
    const vtHeightField* field = built->mesh.heights;
    const Ray* rays = built->rays[set];
    const int stride = way == vt_wayPackets ? VT_PACKET : strideOf(way, field);
    const double start = vtProcessorTime();
    size_t found = 0;
    int traced = 0;
    for (int i = way == vt_wayPackets ? 0 : stride / 2; i < vt_rayCount; i += stride) {
        vtHeightHit hit;
        if (way == vt_wayPackets) {
            found += tracePacket(built->triangles, &how, rays + i);
            traced += VT_PACKET;
            continue;
        }
        if (way == vt_waySingle || way == vt_wayPrimitive) {
            const RTCScene scene = way == vt_waySingle ? built->triangles : built->primitive;
            found += vtTraceRay(scene, &how, rays[i].origin, rays[i].direction).hit.geomID !=
                     RTC_INVALID_GEOMETRY_ID;
        } else {
            found += traceHeights(field, &rays[i], separations[way], &hit);
        }
        ++traced;
    }
    *hits = found;
    return (vtProcessorTime() - start) * (double)vt_rayCount / (double)traced;
}

/// Rays for which heights say something else than triangles, by more than rounding along the ray explains.
static size_t countDiffering(const Built* built, vtRaySet set)
{
    vtRayQuery how = vtMakeRayQuery(false, NULL);
    size_t differing = 0;
    for (int i = 0; i < vt_rayCount; ++i) {
        const Ray* ray = &built->rays[set][i];
        const struct RTCRayHit truth = vtTraceRay(built->triangles, &how, ray->origin, ray->direction);
        vtHeightHit hit;
        const bool meets = traceHeights(built->mesh.heights, ray, vt_separateAll, &hit);
        const bool should = truth.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        const vtVec3 G = vtNormalize((vtVec3){truth.hit.Ng_x, truth.hit.Ng_y, truth.hit.Ng_z});
        differing += meets != should ||
                     (meets && fabsf((hit.distance - truth.ray.tfar) * vtDot(G, ray->direction)) > 4e-6f);
    }
    return differing;
}

static void timeWays(const Built* built, int rounds, vtRayFigures* figures)
{
    double times[vt_raySets][vt_rayWays][vt_mostRayRounds];
    size_t hits = 0;
    for (int round = 0; round < rounds; ++round) {
        for (int set = 0; set < vt_raySets; ++set) {
            for (int way = 0; way < vt_rayWays; ++way) {
                times[set][way][round] = timeWay(built, (vtRaySet)set, (vtRayWay)way, &hits);
                figures->hits[set] = way == vt_waySingle ? hits : figures->hits[set];
            }
        }
    }
    for (int set = 0; set < vt_raySets; ++set) {
        for (int way = 0; way < vt_rayWays; ++way) {
            figures->times[set][way] = vtMedian(times[set][way], rounds);
        }
        figures->differing[set] = countDiffering(built, (vtRaySet)set);
    }
}

vtResult vtMeasureRays(const vtMesh* mesh, const vtView* view, int rounds, vtRayFigures* figures,
                       vtError* error)
{
    *figures =
        (vtRayFigures){.width = mesh->heights->width, .height = mesh->heights->height, .rounds = rounds};
    Built built = {.device = NULL};
    vtResult result = copyRelief(mesh->heights, &built.mesh, &figures->heightsBuild, error);
    if (result == vt_ok) {
        const double start = vtProcessorTime();
        result = vtTriangulateRelief(&built.mesh, error);
        figures->trianglesMade = vtProcessorTime() - start;
    }
    if (result == vt_ok) {
        result = buildEmbree(&built, figures, error);
    }
    if (result == vt_ok) {
        result = makeRays(view, &built, error);
    }
    if (result == vt_ok) {
        figures->triangles = built.mesh.indexCount / 3;
        figures->heightsBytes = vtHeightField_Bytes(built.mesh.heights);
        figures->meshBytes =
            6 * sizeof(float) * built.mesh.vertexCount + sizeof(uint32_t) * built.mesh.indexCount;
        timeWays(&built, rounds, figures);
    }
    destroyBuilt(&built);
    return result;
}
