// Rays against heights by themselves: separations, sides, limits, footprints. Against triangles:
// test_reference_relief.c.
#include "relief/height_trace.h"
#include "relief_cases.h"

static const vtReliefCase reliefs[] = {
    {"2 x 2", vt_reliefNoise, 2, 2, 0.5f},    {"flat", vt_reliefFlat, 17, 9, 0.2f},
    {"ramp", vt_reliefRamp, 9, 17, 0.5f},     {"hills", vt_reliefHills, 33, 57, 0.3f},
    {"narrow", vt_reliefHills, 3, 100, 0.5f}, {"noise", vt_reliefNoise, 40, 31, 0.5f},
};
enum { reliefCount = sizeof reliefs / sizeof reliefs[0] };

static bool trace(const vtMesh* mesh, const vtTestRay* ray, int sides, unsigned separations, vtHeightHit* hit)
{
    return vtHeightField_Trace(mesh->heights, ray->origin, ray->direction, 0.0f, INFINITY, sides, separations,
                               hit);
}

/// No separation changes what is met, but where that is a matter of rounding.
static void separationsChangeNothing(void** state)
{
    (void)state;
    int differ = 0;
    for (int i = 0; i < reliefCount; ++i) {
        vtMesh mesh = createRelief(&reliefs[i]);
        assert_int_equal(vtTriangulateRelief(&mesh, NULL), vt_ok);
        uint32_t seed = 3;
        for (int k = 0; k < 12000; ++k) {
            const vtTestRay ray = randomRay(&mesh, k % vt_rayKinds, &seed);
            vtHeightHit all = {.distance = INFINITY};
            const bool found = trace(&mesh, &ray, 3, vt_separateAll, &all);
            for (unsigned separations = 0; separations < vt_separateAll; ++separations) {
                vtHeightHit hit = {.distance = INFINITY};
                const bool same = trace(&mesh, &ray, 3, separations, &hit) == found &&
                                  (!found || fabsf(hit.distance - all.distance) < 2e-6f);
                if (!same) {
                    ++differ;
                    assert_true(isRight(&mesh, &ray, 0.0f, hit.distance) &&
                                isRight(&mesh, &ray, 0.0f, all.distance));
                }
            }
        }
        vtDestroyMesh(&mesh);
    }
    print_message("%d of %d traces differ, all within rounding\n", differ, reliefCount * 12000 * 15);
    assert_true(differ < 1000);
}

/// A ray enters and leaves by turns, and surfaces of one side are those of both.
static void surfacesAlternate(void** state)
{
    (void)state;
    for (int i = 0; i < reliefCount; ++i) {
        vtMesh mesh = createRelief(&reliefs[i]);
        uint32_t seed = 11;
        int broken = 0;
        for (int k = 0; k < 20000; ++k) {
            const vtTestRay ray = randomRay(&mesh, k % 3 == 1 ? vt_rayGrazing : vt_rayAround, &seed);
            bool inside = vtHeightField_Contains(mesh.heights, ray.origin);
            float near = 0.0f;
            vtHeightHit either, side;
            while (vtHeightField_Trace(mesh.heights, ray.origin, ray.direction, near, INFINITY, 3,
                                       vt_separateAll, &either)) {
                const bool found = vtHeightField_Trace(mesh.heights, ray.origin, ray.direction, near,
                                                       INFINITY, inside ? 2 : 1, vt_separateAll, &side);
                broken += !found || side.distance != either.distance || side.triangle != either.triangle;
                assert_true(either.distance > near);
                near = either.distance;
                inside = !inside;
            }
            broken += inside;
        }
        print_message("%s: %d broken\n", reliefs[i].name, broken);
        assert_true(broken <= 2); // two surfaces at one distance, to the last bit
        vtDestroyMesh(&mesh);
    }
}

static void limitsHold(void** state)
{
    (void)state;
    vtMesh mesh = createRelief(&reliefs[3]);
    uint32_t seed = 17;
    for (int k = 0; k < 20000; ++k) {
        const vtTestRay ray = randomRay(&mesh, k % vt_rayKinds, &seed);
        vtHeightHit hit, other;
        if (!trace(&mesh, &ray, 3, vt_separateAll, &hit)) {
            continue;
        }
        assert_false(vtHeightField_Trace(mesh.heights, ray.origin, ray.direction, 0.0f,
                                         0.9999f * hit.distance, 3, vt_separateAll, &other));
        assert_true(!vtHeightField_Trace(mesh.heights, ray.origin, ray.direction, hit.distance, INFINITY, 3,
                                         vt_separateAll, &other) ||
                    other.distance > hit.distance);
        // Distances are told in lengths of the direction.
        const vtTestRay longer = {ray.origin, vtScale(ray.direction, 8.0f)};
        assert_true(trace(&mesh, &longer, 3, vt_separateAll, &other));
        assert_near(8.0f * other.distance, hit.distance, 1e-5f);
    }
    vtDestroyMesh(&mesh);
}

/// Numbers that are no rays meet nothing that is not there, and end.
static void strangeRaysEnd(void** state)
{
    (void)state;
    vtMesh mesh = createRelief(&reliefs[3]);
    static const float numbers[] = {0.0f,  -0.0f,  1.0f,     -1.0f,     1e-20f, -1e-20f,
                                    1e20f, -1e30f, INFINITY, -INFINITY, NAN};
    enum { count = sizeof numbers / sizeof numbers[0] };
    for (int i = 0; i < count * count * count; ++i) {
        const vtVec3 v = {numbers[i % count], numbers[i / count % count], numbers[i / count / count]};
        const vtVec3 inside = {0.01f, 0.02f, -0.05f};
        for (unsigned separations = 0; separations <= vt_separateAll; ++separations) {
            vtHeightHit hit;
            if (trace(&mesh, &(vtTestRay){inside, v}, 3, separations, &hit)) {
                assert_true(hit.distance > 0.0f && hit.triangle < vtHeightField_FirstBack(mesh.heights) + 2);
            }
            if (trace(&mesh, &(vtTestRay){v, {0.3f, 0.2f, -0.9f}}, 3, separations, &hit)) {
                assert_true(hit.distance > 0.0f && hit.triangle < vtHeightField_FirstBack(mesh.heights) + 2);
            }
        }
    }
    vtDestroyMesh(&mesh);
}

// ---------------------------------------------------------------------------------------------- footprints

static vtVec3 pointAt(const vtMesh* mesh, const vtHeightHit* hit)
{
    vtVec3 p[3];
    vtHeightField_Corners(mesh->heights, hit->triangle, p);
    return vtBlend(p, hit->u, hit->v);
}

static vtVec3 normalAt(const vtMesh* mesh, const vtHeightHit* hit)
{
    vtVec3 normals[3];
    vtHeightField_Normals(mesh->heights, hit->triangle, normals);
    return vtNormalize(vtBlend(normals, hit->u, hit->v));
}

static void expectStep(vtVec3 before, vtVec3 after, float step, vtVec3 wanted)
{
    const vtVec3 measured = vtScale(vtSub(after, before), 1.0f / step);
    assert_true(vtLength(vtSub(measured, wanted)) < 0.02f * vtLength(wanted) + 0.01f);
}

/// Against rays a little to both sides.
static void footprintsAreDerivatives(void** state)
{
    (void)state;
    static const vtReliefCase coarse = {"coarse", vt_reliefHills, 12, 9, 0.3f};
    vtMesh mesh = createRelief(&coarse);
    uint32_t seed = 23;
    int compared = 0;
    for (int k = 0; k < 5000; ++k) {
        const vtTestRay ray = randomRay(&mesh, k % 2, &seed);
        const vtVec3 originStep = randomDirection(&seed), directionStep = randomDirection(&seed);
        const float step = 2e-3f;
        vtHeightHit hits[3];
        bool same = true;
        for (int i = 0; i < 3; ++i) {
            const float by = 0.5f * step * (float)(i - 1);
            const vtTestRay aside = {vtMulAdd(ray.origin, by, originStep),
                                     vtMulAdd(ray.direction, by, directionStep)};
            same = same && trace(&mesh, &aside, 3, vt_separateAll, &hits[i]) &&
                   hits[i].triangle == hits[0].triangle;
        }
        vtVec3 p[3];
        vtHeightField_Corners(mesh.heights, same ? hits[1].triangle : 0, p);
        const vtVec3 G = vtNormalize(vtCross(vtSub(p[1], p[0]), vtSub(p[2], p[0])));
        if (!same || fabsf(vtDot(G, ray.direction)) < 0.3f) {
            continue; // over an edge, or so flat that the step is a large one
        }
        const vtFootprint footprint =
            vtHeightField_Footprint(mesh.heights, &hits[1], ray.direction, originStep, directionStep);
        expectStep(pointAt(&mesh, &hits[0]), pointAt(&mesh, &hits[2]), step, footprint.position);
        expectStep(normalAt(&mesh, &hits[0]), normalAt(&mesh, &hits[2]), step, footprint.normal);
        const float size = fabsf(footprint.u) + fabsf(footprint.v);
        assert_near((hits[2].u - hits[0].u) / step, footprint.u, 0.02f * size + 0.02f);
        assert_near((hits[2].v - hits[0].v) / step, footprint.v, 0.02f * size + 0.02f);
        ++compared;
    }
    assert_true(compared > 2000);
    vtDestroyMesh(&mesh);
}

static void innerDistancesNeedTriangles(void** state)
{
    (void)state;
    vtMesh mesh = createRelief(&reliefs[3]);
    vtError error;
    assert_int_equal(vtComputeInnerDistances(&mesh, &error), vt_errorGeometry);
    assert_non_null(strstr(error.message, "vtTriangulateRelief"));
    vtDestroyMesh(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(separationsChangeNothing),
        cmocka_unit_test(surfacesAlternate),
        cmocka_unit_test(limitsHold),
        cmocka_unit_test(strangeRaysEnd),
        cmocka_unit_test(footprintsAreDerivatives),
        cmocka_unit_test(innerDistancesNeedTriangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
