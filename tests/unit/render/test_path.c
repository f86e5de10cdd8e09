// The single exact path against closed forms.
#include "base/math.h"
#include "cases.h"
#include "testing.h"

static vtFrame frontal(void)
{
    vtFrame frame = vtDefaultFrame();
    frame.view = (vtView){{0, 0, 4}, {0, 0, 0}, 45};
    frame.width = frame.height = 100;
    return frame;
}

/// Puts a shape into the scene, scaled and moved along z; index 0: opaque.
static void add(vtScene* scene, const char* name, float scale, float z, float ior)
{
    vtMesh mesh;
    vtScene added;
    vtError error;
    vtMaterial material = vtDefaultMaterial();
    material.opaque = ior <= 0.0f;
    material.ior = ior;
    const vtTransform place = {{{scale, 0, 0, 0}, {0, scale, 0, 0}, {0, 0, scale, z}}};
    assert_ok(vtCreateShape(name, &mesh, &error), error);
    assert_ok(vtCreateMeshScene(&mesh, &material, &added, &error), error);
    assert_ok(vtScene_Append(scene, &added, &place, &error), error);
}

/// The sine of the angle before over that after.
static float sineRatio(const vtPathEvent* event)
{
    return sinf(event->incoming * VT_PI / 180.0f) / sinf(event->outgoing * VT_PI / 180.0f);
}

// Through a ball the angles of entry and exit mirror each other, and both obey Snell's law.
static void ballIsPassedInTwoRefractions(void** state)
{
    (void)state;
    vtScene scene = {0};
    vtPath path;
    vtError error;
    add(&scene, "sphere", 1.0f, 0.0f, 1.5f);
    vtFrame frame = frontal();
    assert_ok(tracePath(&scene, &frame, 65.0f, 40.0f, &path, &error), error);
    assert_int_equal(path.eventCount, 2);
    assert_true(path.exited);
    for (int i = 0; i < 2; ++i) {
        const vtPathEvent* event = &path.events[i];
        assert_false(event->reflected);
        assert_near(vtLength(event->position), 1.0f, 2e-3);
        const float ratio = i == 0 ? 1.5f : 1.0f / 1.5f;
        assert_near(sineRatio(event), ratio, 1e-3);
    }
    assert_near(path.events[0].incoming, path.events[1].outgoing, 0.2);
    assert_near(vtLength(path.direction), 1.0f, 1e-5);
    vtDestroyScene(&scene);
}

static void rayBesideTheGlassMeetsNothing(void** state)
{
    (void)state;
    vtScene scene = {0};
    vtPath path;
    vtError error;
    add(&scene, "sphere", 1.0f, 0.0f, 1.5f);
    vtFrame frame = frontal();
    assert_ok(tracePath(&scene, &frame, 1.0f, 1.0f, &path, &error), error);
    assert_int_equal(path.eventCount, 0);
    vtDestroyScene(&scene);
}

// In a diamond of index 2.42 light that enters the table is reflected inside (its critical angle is 24.4
// degrees): that is what the cut is for.
static void diamondReflectsInside(void** state)
{
    (void)state;
    vtScene scene = {0};
    vtPath path;
    vtError error;
    add(&scene, "diamond", 1.0f, 0.0f, 1.5f);
    vtFrame frame = frontal();
    frame.view.eye = (vtVec3){0.1f, 4.0f, 0.2f};
    frame.ior = 2.42f;
    frame.maxEvents = 32;
    assert_ok(tracePath(&scene, &frame, 55.0f, 52.0f, &path, &error), error);
    int reflections = 0;
    for (int i = 0; i < path.eventCount; ++i) {
        reflections += path.events[i].reflected;
        assert_true(!path.events[i].reflected || path.events[i].incoming > 24.3f);
    }
    assert_true(reflections >= 2);
    vtDestroyScene(&scene);
}

// Two balls of their own indices, one behind the other and scaled: four refractions; frame.ior is all
// glass's.
static void twoBallsArePassedOneAfterTheOther(void** state)
{
    (void)state;
    vtScene scene = {0};
    vtPath path;
    vtError error;
    add(&scene, "sphere", 0.5f, -2.0f, 1.6f);
    add(&scene, "sphere", 1.0f, 0.0f, 1.3f);
    vtFrame frame = frontal();
    const float expected[] = {1.3f, 1.0f / 1.3f, 1.6f, 1.0f / 1.6f};
    for (int common = 0; common < 2; ++common) {
        frame.ior = common ? 1.2f : 0.0f;
        assert_ok(tracePath(&scene, &frame, 53.0f, 49.0f, &path, &error), error);
        assert_int_equal(path.eventCount, 4);
        assert_true(path.exited);
        assert_false(path.opaque);
        for (int i = 0; i < 4; ++i) {
            const vtPathEvent* event = &path.events[i];
            const vtVec3 centre = {0, 0, i < 2 ? 0.0f : -2.0f};
            const float radius = i < 2 ? 1.0f : 0.5f;
            assert_near(vtLength(vtSub(event->position, centre)), radius, 2e-3);
            assert_false(event->reflected);
            const float own = expected[i], all = i % 2 == 0 ? 1.2f : 1.0f / 1.2f;
            const float ratio = common ? all : own;
            assert_near(sineRatio(event), ratio, 2e-3);
        }
    }
    vtDestroyScene(&scene);
}

// A ball of air in a ball of glass: the smaller one counts where they overlap, so its walls are met the other
// way round. Filled with the same glass it changes nothing.
static void bubbleIsMetTheOtherWayRound(void** state)
{
    (void)state;
    for (int filled = 0; filled < 2; ++filled) {
        vtScene scene = {0};
        vtPath path;
        vtError error;
        add(&scene, "sphere", 1.0f, 0.0f, 1.5f);
        add(&scene, "sphere", 0.5f, 0.0f, filled ? 1.5f : 1.0f);
        vtFrame frame = frontal();
        assert_ok(tracePath(&scene, &frame, 55.0f, 47.0f, &path, &error), error);
        assert_int_equal(path.eventCount, filled ? 2 : 4);
        assert_true(path.exited);
        for (int i = 0; i < path.eventCount; ++i) {
            const vtPathEvent* event = &path.events[i];
            const bool outer = filled || i == 0 || i == 3;
            const float radius = outer ? 1.0f : 0.5f;
            assert_near(vtLength(event->position), radius, 2e-3);
            const float expected = i % 2 == 0 ? 1.5f : 1.0f / 1.5f;
            assert_near(sineRatio(event), expected, 2e-3);
        }
        vtDestroyScene(&scene);
    }
}

// What is opaque ends a path, behind glass and without.
static void opaqueThingsEndThePath(void** state)
{
    (void)state;
    vtScene scene = {0};
    vtPath path;
    vtError error;
    add(&scene, "sphere", 1.0f, 0.0f, 1.5f);
    add(&scene, "plane", 2.0f, -2.0f, 0.0f);
    vtFrame frame = frontal();
    assert_ok(tracePath(&scene, &frame, 55.0f, 47.0f, &path, &error), error);
    assert_int_equal(path.eventCount, 2);
    assert_true(path.opaque);
    assert_false(path.exited);
    assert_near(path.end.z, -2.0f, 1e-4);
    assert_ok(tracePath(&scene, &frame, 10.0f, 50.0f, &path, &error), error);
    assert_int_equal(path.eventCount, 0);
    assert_true(path.opaque);
    vtDestroyScene(&scene);
}

/// A pattern as glass; `triangles`: as a mesh of those alone.
static void addPattern(vtScene* scene, bool triangles)
{
    vtMesh mesh, plain;
    vtError error;
    vtReliefDef def = vtDefaultRelief();
    const vtMaterial material = vtDefaultMaterial();
    const vtTransform place = vtIdentityTransform();
    def.width = 57;
    def.height = 40;
    assert_ok(vtCreateReliefPattern("hammered", &def, &mesh, &error), error);
    if (triangles) {
        assert_ok(vtTriangulateRelief(&mesh, &error), error);
        const vtMeshDef all = {.positions = mesh.positions,
                               .normals = mesh.normals,
                               .indices = mesh.indices,
                               .vertexCount = mesh.vertexCount,
                               .indexCount = mesh.indexCount};
        assert_ok(vtCreateMesh(&all, "hammered", &plain, &error), error);
        vtDestroyMesh(&mesh);
        mesh = plain;
    }
    vtScene added;
    assert_ok(vtCreateMeshScene(&mesh, &material, &added, &error), error);
    assert_ok(vtScene_Append(scene, &added, &place, &error), error);
}

// A relief without triangles is met where those made of it are.
static void reliefIsMetByItsHeights(void** state)
{
    (void)state;
    vtScene heights = {0}, triangles = {0};
    addPattern(&heights, false);
    addPattern(&triangles, true);
    vtFrame frame = frontal();
    const vtVec3 eyes[] = {{0, 0, 4}, {2, 1, 3}, {-3, 1, 0.2f}, {1, -2, -3}};
    for (size_t eye = 0; eye < sizeof eyes / sizeof eyes[0]; ++eye) {
        frame.view.eye = eyes[eye];
        for (int pixel = 0; pixel < 81; ++pixel) {
            const float x = 25.3f + 6.1f * (float)(pixel % 9), y = 25.7f + 6.1f * (float)(pixel / 9);
            vtPath path, expected;
            vtError error;
            assert_ok(tracePath(&heights, &frame, x, y, &path, &error), error);
            assert_ok(tracePath(&triangles, &frame, x, y, &expected, &error), error);
            assert_int_equal(path.eventCount, expected.eventCount);
            assert_int_equal(path.exited, expected.exited);
            for (int i = 0; i < path.eventCount; ++i) {
                assert_int_equal(path.events[i].reflected, expected.events[i].reflected);
                assert_true(vtLength(vtSub(path.events[i].position, expected.events[i].position)) < 1e-3f);
            }
        }
    }
    assert_int_equal(heights.meshes[0].indexCount, 0);
    vtDestroyScene(&heights);
    vtDestroyScene(&triangles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ballIsPassedInTwoRefractions), cmocka_unit_test(rayBesideTheGlassMeetsNothing),
        cmocka_unit_test(diamondReflectsInside),        cmocka_unit_test(twoBallsArePassedOneAfterTheOther),
        cmocka_unit_test(bubbleIsMetTheOtherWayRound),  cmocka_unit_test(opaqueThingsEndThePath),
        cmocka_unit_test(reliefIsMetByItsHeights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
