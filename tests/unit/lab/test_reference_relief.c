// Reliefs without triangles in the reference, against Embree's triangles of the same reliefs.
#include "cases.h"
#include "lab/reference/reference.h"
#include "lab/reference/reference_scene.h"
#include "relief/height_trace.h"
#include "relief_cases.h"

static const vtReliefCase reliefs[] = {
    {"2 x 2", vt_reliefNoise, 2, 2, 0.5f},        {"flat", vt_reliefFlat, 65, 33, 0.2f},
    {"ramp", vt_reliefRamp, 33, 65, 0.5f},        {"hills", vt_reliefHills, 257, 129, 0.3f},
    {"narrow", vt_reliefHills, 3, 200, 0.5f},     {"noise", vt_reliefNoise, 64, 64, 0.5f},
    {"deep noise", vt_reliefNoise, 40, 31, 3.0f}, {"large hills", vt_reliefHills, 1024, 1024, 0.2f},
};
// A million rays in all; sanitizers make each some ten times slower.
#ifdef __SANITIZE_ADDRESS__
enum { raysEach = 12500 };
#else
enum { raysEach = 125000 };
#endif
enum { reliefCount = sizeof reliefs / sizeof reliefs[0], packet = 8 };

typedef struct Counts {
    int rays, hits;
    int differ, differExactly; ///< of random rays; of those aimed at edges
    int wrong;
} Counts;

static RTCScene createScene(RTCDevice device, const vtMesh* mesh, bool asTriangles)
{
    RTCScene scene = rtcNewScene(device);
    const vtSpace space = vtOuterSpace();
    assert_true(asTriangles ? vtFillScene(device, scene, mesh, &space)
                            : vtFillReliefScene(device, scene, mesh->heights));
    return scene;
}

static struct RTCRayHit trace(RTCScene scene, const vtTestRay* ray)
{
    vtRayQuery how = vtMakeRayQuery(false, NULL);
    return vtTraceRay(scene, &how, ray->origin, ray->direction);
}

/// Whether both triangles are such as the ray meets, or passes close by.
static bool areNeighbours(const vtMesh* mesh, const vtTestRay* ray, const vtHeightHit* hit, uint32_t other)
{
    if (hit->triangle == other) {
        return true;
    }
    vtVec3 corners[3];
    vtHeightField_Corners(mesh->heights, hit->triangle, corners);
    const bool passes = passTriangle(corners, ray).depth > -roundingDistance;
    vtMesh_Corners(mesh, other, corners);
    return passes && passTriangle(corners, ray).depth > -roundingDistance;
}

/// Whether the hit's weights give the point that its distance gives.
static bool agreesWithItself(const vtMesh* mesh, const vtTestRay* ray, const vtHeightHit* hit)
{
    vtVec3 p[3];
    vtHeightField_Corners(mesh->heights, hit->triangle, p);
    const vtVec3 normal = vtNormalize(vtCross(vtSub(p[1], p[0]), vtSub(p[2], p[0])));
    const vtVec3 off =
        vtSub(vtBlend(p, hit->u, hit->v), vtMulAdd(ray->origin, hit->distance, ray->direction));
    // Across the plane; along it as far as the grid's coordinates carry on a steep slope.
    const float slope = fabsf(normal.z) > 1e-6f && hit->triangle < vtHeightField_FirstWall(mesh->heights)
                            ? 1.0f / fabsf(normal.z)
                            : 1.0f;
    const bool weights = hit->u >= 0.0f && hit->v >= 0.0f && hit->u + hit->v <= 1.000001f;
    return weights && fabsf(vtDot(off, normal)) < 4e-6f && vtLength(off) < 4e-6f * slope + 4e-6f;
}

static void compareRay(const vtMesh* mesh, RTCScene triangles, const vtTestRay* ray, bool isExact,
                       Counts* counts)
{
    const struct RTCRayHit truth = trace(triangles, ray);
    const bool meets = truth.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    vtHeightHit hit = {.distance = INFINITY};
    const bool found = vtHeightField_Trace(mesh->heights, ray->origin, ray->direction, 0.0f, INFINITY, 3,
                                           vt_separateAll, &hit);
    const vtVec3 G = vtNormalize((vtVec3){truth.hit.Ng_x, truth.hit.Ng_y, truth.hit.Ng_z});
    const float off = fabsf((truth.ray.tfar - hit.distance) * vtDot(G, ray->direction));
    ++counts->rays;
    counts->hits += found;
    if (found && !agreesWithItself(mesh, ray, &hit)) {
        ++counts->wrong;
    }
    if (found == meets && (!found || (off <= 4e-6f && areNeighbours(mesh, ray, &hit, truth.hit.primID)))) {
        return;
    }
    ++*(isExact ? &counts->differExactly : &counts->differ);
    if (!isRight(mesh, ray, 0.0f, found ? hit.distance : INFINITY)) {
        ++counts->wrong;
        print_message("wrong: from %.9g %.9g %.9g along %.9g %.9g %.9g, at %.9g, truth %.9g\n",
                      (double)ray->origin.x, (double)ray->origin.y, (double)ray->origin.z,
                      (double)ray->direction.x, (double)ray->direction.y, (double)ray->direction.z,
                      found ? (double)hit.distance : (double)INFINITY, (double)truth.ray.tfar);
    }
}

static void raysMeetWhatTrianglesMeet(void** state)
{
    (void)state;
    RTCDevice device = rtcNewDevice("threads=1");
    Counts all = {0};
    for (int i = 0; i < reliefCount; ++i) {
        vtMesh mesh = createRelief(&reliefs[i]);
        assert_ok(vtTriangulateRelief(&mesh, NULL), (vtError){0});
        RTCScene scene = createScene(device, &mesh, true);
        Counts counts = {0};
        uint32_t seed = (uint32_t)i;
        for (int ray = 0; ray < raysEach; ++ray) {
            // Half of them random, from outside and from inside.
            const int kind = ray % 12 < 6 ? ray % 2 : ray % vt_rayKinds;
            const vtTestRay test = randomRay(&mesh, kind, &seed);
            compareRay(&mesh, scene, &test, kind >= vt_rayAlongAxis, &counts);
        }
        print_message("%s: %d rays, %d hits, %d differ, %d of those aimed at edges, %d wrong\n",
                      reliefs[i].name, counts.rays, counts.hits, counts.differ, counts.differExactly,
                      counts.wrong);
        assert_int_equal(counts.wrong, 0);
        assert_true(counts.hits > counts.rays / 2);
        all.rays += counts.rays;
        all.differ += counts.differ;
        rtcReleaseScene(scene);
        vtDestroyMesh(&mesh);
    }
    rtcReleaseDevice(device);
    assert_int_equal(all.rays, reliefCount * raysEach);
    assert_true(all.differ < 20);
}

/// Embree's rays, alone and in packets, bring back what the heights' own function finds, to the last bit.
static void embreeAsksTheHeights(void** state)
{
    (void)state;
    RTCDevice device = rtcNewDevice("threads=1");
    vtMesh mesh = createRelief(&reliefs[3]);
    RTCScene scene = createScene(device, &mesh, false);
    uint32_t seed = 5;
    for (int round = 0; round < 2000; ++round) {
        struct RTCRayHit8 query = {0};
        _Alignas(32) int valid[packet];
        vtTestRay rays[packet];
        for (int i = 0; i < packet; ++i) {
            rays[i] = randomRay(&mesh, round % vt_rayKinds, &seed);
            query.ray.org_x[i] = rays[i].origin.x;
            query.ray.org_y[i] = rays[i].origin.y;
            query.ray.org_z[i] = rays[i].origin.z;
            query.ray.dir_x[i] = rays[i].direction.x;
            query.ray.dir_y[i] = rays[i].direction.y;
            query.ray.dir_z[i] = rays[i].direction.z;
            query.ray.tfar[i] = INFINITY;
            query.ray.mask[i] = ~0u;
            query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            valid[i] = i % 3 == 2 ? 0 : -1;
        }
        vtRayQuery how = vtMakeRayQuery(false, NULL);
        vtIntersect8(valid, scene, &how, &query);
        for (int i = 0; i < packet; ++i) {
            vtHeightHit hit;
            const bool found = vtHeightField_Trace(mesh.heights, rays[i].origin, rays[i].direction, 0.0f,
                                                   INFINITY, 3, vt_separateAll, &hit);
            const struct RTCRayHit alone = trace(scene, &rays[i]);
            assert_true(found == (alone.hit.geomID != RTC_INVALID_GEOMETRY_ID));
            assert_true((found && valid[i] != 0) == (query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID));
            if (found) {
                assert_true(alone.ray.tfar == hit.distance && alone.hit.primID == hit.triangle);
                assert_true(alone.hit.u == hit.u && alone.hit.v == hit.v);
            }
            if (found && valid[i] != 0) {
                assert_true(query.ray.tfar[i] == hit.distance && query.hit.primID[i] == hit.triangle);
                assert_true(query.hit.u[i] == hit.u && query.hit.v[i] == hit.v);
                assert_true(query.hit.Ng_z[i] == alone.hit.Ng_z);
            }
        }
    }
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    vtDestroyMesh(&mesh);
}

// ------------------------------------------------------------------------------------------------ pictures

static vtScene createScenery(const vtReliefCase* relief, bool asTriangles, bool opaque)
{
    vtMesh mesh = createRelief(relief);
    vtError error;
    if (asTriangles) {
        assert_ok(vtTriangulateRelief(&mesh, &error), error);
    }
    vtMaterial material = vtDefaultMaterial();
    material.opaque = opaque;
    vtScene scene;
    assert_ok(vtCreateMeshScene(&mesh, &material, &scene, &error), error);
    // Turned, so that nothing lies along an axis, and mirrored.
    static const vtTransform placed = {
        {{0.8f, 0.0f, -0.6f, 0.1f}, {0.0f, -1.0f, 0.0f, 0.2f}, {0.6f, 0.0f, 0.8f, 0.0f}}};
    scene.objects[0].toWorld = placed;
    return scene;
}

static vtReferenceImage tracePicture(const vtScene* scene, const vtFrame* frame,
                                     const vtEnvironment* environment)
{
    vtReference* reference;
    vtReferenceImage image;
    vtError error;
    const vtReferenceDef def = {.frame = frame, .environment = environment, .fresnel = true, .threads = 1};
    assert_ok(vtCreateReference(scene, &reference, &error), error);
    assert_ok(vtReference_Trace(reference, &def, &image, &error), error);
    vtDestroyReference(reference);
    return image;
}

/// The same paths up to 4 events, and few others after more: each event makes rounding larger.
static void comparePictures(const vtReferenceImage* a, const vtReferenceImage* b, const char* name)
{
    const size_t count = (size_t)a->width * (size_t)a->height;
    int glass = 0, few = 0, states = 0, directions = 0, longDirections = 0, colors = 0;
    for (size_t i = 0; i < count; ++i) {
        const bool isShort = a->events[i] <= 4;
        float direction = 0.0f, color = 0.0f;
        for (size_t k = 3 * i; k < 3 * i + 3; ++k) {
            direction = fmaxf(direction, fabsf(a->directions[k] - b->directions[k]));
            color = fmaxf(color, fabsf(a->radiance[k] - b->radiance[k]));
        }
        glass += a->states[i] != VT_PATH_BACKGROUND;
        few += a->states[i] != VT_PATH_BACKGROUND && isShort;
        states += isShort && (a->states[i] != b->states[i] || a->events[i] != b->events[i]);
        directions += isShort && direction > 1e-3f;
        longDirections += !isShort && direction > 1e-3f;
        colors += color > 1e-2f;
    }
    print_message(
        "%s: %d pixels of glass, %d of few events: %d other states, %d other directions; of all %d other "
        "directions, %d other colours\n",
        name, glass, few, states, directions, directions + longDirections, colors);
    assert_true(few > 300);
    assert_true(states == 0 && directions == 0);
    assert_true(longDirections <= glass / 20 && colors <= glass / 10);
}

static void picturesAreTheSame(void** state)
{
    (void)state;
    vtEnvironment environment;
    assert_ok(vtCreateEnvironment("studio", &environment, NULL), (vtError){0});
    for (int i = 0; i < 8; ++i) {
        const vtReliefCase* relief = &reliefs[i];
        const bool opaque = i % 4 == 1;
        vtScene direct = createScenery(relief, false, opaque),
                triangles = createScenery(relief, true, opaque);
        vtFrame frame = vtDefaultFrame();
        frame.width = frame.height = 96;
        frame.view = vtViewOfScene(&direct, 45.0f, 1.0f);
        vtReferenceImage a = tracePicture(&direct, &frame, &environment);
        vtReferenceImage b = tracePicture(&triangles, &frame, &environment);
        comparePictures(&a, &b, relief->name);
        int differ = 0, lost = 0;
        for (int k = 0; k < 96 * 96 && i < 4; k += 97) { // one path each, with and without triangles
            vtPath path[2];
            const float x = (float)(k % 96) + 0.5f, y = (float)(k / 96) + 0.5f;
            assert_ok(tracePath(&direct, &frame, x, y, &path[0], NULL), (vtError){0});
            assert_ok(tracePath(&triangles, &frame, x, y, &path[1], NULL), (vtError){0});
            assert_true(path[0].eventCount == path[1].eventCount);
            assert_memory_equal(&path[0].direction, &path[1].direction, sizeof(vtVec3));
            const vtVec3 traced = vtMakeVec3(a.directions + 3 * (size_t)k);
            lost += a.states[k] == VT_PATH_LOST;
            differ += a.states[k] == VT_PATH_EXITED && vtLength(vtSub(traced, path[0].direction)) > 1e-3f;
        }
        assert_true(differ <= 1 && lost <= 8);
        vtDestroyReferenceImage(&a);
        vtDestroyReferenceImage(&b);
        vtDestroyScene(&direct);
        vtDestroyScene(&triangles);
    }
    vtDestroyEnvironment(&environment);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(raysMeetWhatTrianglesMeet),
        cmocka_unit_test(embreeAsksTheHeights),
        cmocka_unit_test(picturesAreTheSame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
