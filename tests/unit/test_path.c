// The single exact path against closed forms.
#include "base/math.h"
#include "testing.h"

static vtFrame frontal(void)
{
    vtFrame frame = vtDefaultFrame();
    frame.view = (vtView){{0, 0, 4}, {0, 0, 0}, 45};
    frame.width = frame.height = 100;
    return frame;
}

// Through a ball the angles of entry and exit mirror each other, and both obey Snell's law.
static void ballIsPassedInTwoRefractions(void** state)
{
    (void)state;
    vtMesh mesh;
    vtPath path;
    vtError error;
    assert_ok(vtCreateShape("sphere", &mesh, &error), error);
    vtFrame frame = frontal();
    assert_ok(vtTracePath(&mesh, &frame, 65.0f, 40.0f, &path, &error), error);
    assert_int_equal(path.eventCount, 2);
    assert_true(path.exited);
    for (int i = 0; i < 2; ++i) {
        const vtPathEvent* event = &path.events[i];
        assert_false(event->reflected);
        assert_near(vtLength(event->position), 1.0f, 2e-3);
        float ratio = sinf(event->incoming * VT_PI / 180.0f) / sinf(event->outgoing * VT_PI / 180.0f);
        assert_near(ratio, i == 0 ? 1.5f : 1.0f / 1.5f, 1e-3);
    }
    assert_near(path.events[0].incoming, path.events[1].outgoing, 0.2);
    assert_near(vtLength(path.direction), 1.0f, 1e-5);
    vtDestroyMesh(&mesh);
}

static void rayBesideTheGlassMeetsNothing(void** state)
{
    (void)state;
    vtMesh mesh;
    vtPath path;
    vtError error;
    assert_ok(vtCreateShape("sphere", &mesh, &error), error);
    vtFrame frame = frontal();
    assert_ok(vtTracePath(&mesh, &frame, 1.0f, 1.0f, &path, &error), error);
    assert_int_equal(path.eventCount, 0);
    vtDestroyMesh(&mesh);
}

// In a diamond of index 2.42 light that enters the table is reflected inside (its critical angle is 24.4
// degrees): that is what the cut is for.
static void diamondReflectsInside(void** state)
{
    (void)state;
    vtMesh mesh;
    vtPath path;
    vtError error;
    assert_ok(vtCreateShape("diamond", &mesh, &error), error);
    vtFrame frame = frontal();
    frame.view.eye = (vtVec3){0.1f, 4.0f, 0.2f};
    frame.ior = 2.42f;
    frame.maxEvents = 32;
    assert_ok(vtTracePath(&mesh, &frame, 55.0f, 52.0f, &path, &error), error);
    int reflections = 0;
    for (int i = 0; i < path.eventCount; ++i) {
        reflections += path.events[i].reflected;
        assert_true(!path.events[i].reflected || path.events[i].incoming > 24.3f);
    }
    assert_true(reflections >= 2);
    vtDestroyMesh(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ballIsPassedInTwoRefractions),
        cmocka_unit_test(rayBesideTheGlassMeetsNothing),
        cmocka_unit_test(diamondReflectsInside),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
