// Technique `layered` with the search from cell to cell (vt_searchCells).
#include <math.h>

#include "base/math.h"
#include "lab/metrics/metrics.h"
#include "rendering.h"

static vtFrame cellsFrame(void)
{
    vtFrame frame = smallFrame(vt_techniqueLayered);
    frame.search = vt_searchCells;
    return frame;
}

typedef struct Share {
    double within, lost; // of the pixels whose true path leaves the glass
} Share;

static Share compareWith(const vtReferenceImage* truth, const float* directions)
{
    int compared = 0, within = 0, lost = 0;
    for (int i = 0; i < side * side; ++i) {
        if (truth->states[i] == VT_PATH_EXITED) {
            ++compared;
            within += vtDirectionAngle(directions + 3 * i, truth->directions + 3 * i) < 1.0f;
            lost += directions[3 * i] == 2.0f;
        }
    }
    assert_true(compared > 500);
    return (Share){(double)within / compared, (double)lost / compared};
}

// Against the reference tracer, and no worse than linear steps through the same layers.
static void hitsAreThoseOfATracer(void** state)
{
    Fixture* fixture = *state;
    static const struct {
        const char* shape;
        double within, lost;
    } wanted[] = {
        {"sphere", 0.995, 0.001}, {"torus", 0.91, 0.02}, {"knot", 0.965, 0.006}, {"goblet", 0.93, 0.018}};
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0]; ++i) {
        vtMesh mesh;
        vtError error;
        vtReferenceImage truth;
        assert_ok(vtCreateShape(wanted[i].shape, &mesh, &error), error);
        vtFrame frame = cellsFrame();
        frame.view = vtView_Orbit(vtViewOfMesh(&mesh, 45.0f, 1.0f), 0.3f, 0.2f);
        frame.layerSize = 512;
        traceMesh(&mesh, &frame, &truth);
        assert_ok(vtRenderer_SetMesh(fixture->renderer, &mesh, &error), error);
        draw(fixture, &frame);
        const Share cells = compareWith(&truth, fixture->directions);
        frame.search = vt_searchSteps;
        draw(fixture, &frame);
        const Share steps = compareWith(&truth, fixture->directions);
        print_message("  %s: cells %.4f within 1 degree, %.4f lost; steps %.4f, %.4f\n", wanted[i].shape,
                      cells.within, cells.lost, steps.within, steps.lost);
        assert_true(cells.within >= wanted[i].within && cells.within >= steps.within);
        assert_true(cells.lost <= wanted[i].lost);
        vtDestroyReferenceImage(&truth);
        vtDestroyMesh(&mesh);
    }
}

static void oneObjectInOrderIsAny(void** state)
{
    Fixture* fixture = *state;
    setEnvironment(fixture->renderer, "studio");
    setShape(fixture->renderer, "knot");
    assertOrderedIsAny(fixture, cellsFrame());
}

// A ball within a ball, and an opaque one behind them: paths start on one object and enter another.
static void severalObjectsAgreeWithExact(void** state)
{
    Fixture* fixture = *state;
    vtMesh mesh;
    vtError error;
    static uint32_t exact[side * side], layered[side * side];
    static float directions[3 * side * side];
    assert_ok(vtCreateShape("sphere", &mesh, &error), error);
    vtMaterial materials[2] = {vtDefaultMaterial(), vtDefaultMaterial()};
    materials[1].opaque = true;
    const float scales[3] = {0.9f, 0.4f, 0.8f};
    vtObject objects[3];
    for (uint32_t i = 0; i < 3; ++i) {
        const float s = scales[i];
        objects[i] =
            (vtObject){.material = i / 2,
                       .toWorld = {{{s, 0, 0, 0.1f}, {0, s, 0, 0}, {0, 0, s, i == 2 ? -3.0f : 0.0f}}}};
    }
    const vtScene scene = {.meshes = &mesh,
                           .materials = materials,
                           .objects = objects,
                           .meshCount = 1,
                           .materialCount = 2,
                           .objectCount = 3};
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    vtFrame frame = cellsFrame();
    frame.technique = vt_techniqueExact;
    draw(fixture, &frame);
    memcpy(directions, fixture->directions, sizeof directions);
    assert_ok(vtRenderer_ReadStates(fixture->renderer, exact, &error), error);
    frame.technique = vt_techniqueLayered;
    draw(fixture, &frame);
    assert_ok(vtRenderer_ReadStates(fixture->renderer, layered, &error), error);
    int glass = 0, opaque = 0, same = 0;
    for (int i = 0; i < side * side; ++i) {
        const uint32_t was = exact[i] & 255u;
        glass += was == VT_PATH_EXITED || was == VT_PATH_OPAQUE;
        opaque += was == VT_PATH_OPAQUE;
        same += (was == VT_PATH_EXITED || was == VT_PATH_OPAQUE) && (layered[i] & 255u) == was &&
                vtDirectionAngle(fixture->directions + 3 * i, directions + 3 * i) < 1.0f;
    }
    assert_true(glass > side * side / 10 && opaque > glass / 20);
    print_message("  %d of %d as exact, %d opaque\n", same, glass, opaque);
    assert_true(same > glass * 95 / 100);
    vtDestroyMesh(&mesh);
}

// Whatever the settings, the walk ends, and what it leaves is a direction, lost or background.
static void extremeSettingsAreDrawn(void** state)
{
    Fixture* fixture = *state;
    const char* const shapes[] = {"knot", "diamond", "plane", "cube"};
    const vtVec3 eyes[] = {{0.0f, 0.0f, 0.01f}, {0.9f, 0.1f, 0.2f}, {0.0f, 0.0f, 300.0f}, {3.0f, 0.0f, 0.0f}};
    for (int i = 0; i < 4; ++i) {
        setShape(fixture->renderer, shapes[i]);
        for (int k = 0; k < 4; ++k) {
            vtFrame frame = cellsFrame();
            frame.layers = k == 0 ? 1 : k == 1 ? VT_MAX_LAYERS : 5;
            frame.layerSize = k == 2 ? 1024 : 16;
            frame.view.eye = eyes[k];
            frame.view.fovY = k == 2 ? 1.0f : 100.0f;
            frame.maxEvents = VT_MAX_EVENTS;
            draw(fixture, &frame);
            for (int p = 0; p < side * side; ++p) {
                const float* d = fixture->directions + 3 * p;
                const float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                assert_true(length == 0.0f || d[0] == 2.0f || fabsf(length - 1.0f) < 1e-3f);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hitsAreThoseOfATracer),
        cmocka_unit_test(oneObjectInOrderIsAny),
        cmocka_unit_test(severalObjectsAgreeWithExact),
        cmocka_unit_test(extremeSettingsAreDrawn),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
