// Models that move, drawn: at each time as the reference traces them, directions and picture, and as a scene
// that is set anew.
#include <math.h>
#include <string.h>

#include "animated_models.h"
#include "lab/metrics/metrics.h"
#include "lab/metrics/metrics_image.h"
#include "mesh/hierarchy.h"
#include "rendering.h"

enum { pixelSide = 96, pixelCount = pixelSide * pixelSide };

static void prepare(vtScene* scene)
{
    vtError error;
    vtPreparation* preparation = vtBeginPreparation(scene);
    assert_non_null(preparation);
    while (!vtPreparation_Step(preparation, UINT32_MAX)) {
    }
    assert_ok(vtEndPreparation(preparation, &error), error);
}

static vtFrame makeFrame(const vtScene* scene)
{
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.width = frame.height = pixelSide;
    frame.view = vtViewOfScene(scene, 45.0f, 1.0f);
    return frame;
}

/// Pixels whose directions differ by more than rounding.
static int countDiffering(const float* a, const float* b)
{
    int differing = 0;
    for (int i = 0; i < pixelCount; ++i) {
        float most = 0.0f;
        for (int k = 0; k < 3; ++k) {
            most = fmaxf(most, fabsf(a[3 * i + k] - b[3 * i + k]));
        }
        differing += most > 1e-3f;
    }
    return differing;
}

/// Mean FLIP of the picture with all its reflections, as users see it, from the traced one.
static double measurePicture(Fixture* fixture, const vtFrame* frame, const vtReferenceImage* truth)
{
    static uint8_t traced[4 * pixelCount];
    vtFrame whole = *frame;
    vtPictureError found;
    vtError error;
    whole.fresnel = true;
    draw(fixture, &whole);
    vtReference_ToSrgb(truth, traced);
    assert_ok(vtComparePictureBytes(fixture->pixels, traced, 4, pixelSide, pixelSide, &found, NULL, &error),
              error);
    return found.flip;
}

/// The scene as it is now, directions and picture. False, and it says so, for want of Embree.
static bool traceWhole(const vtScene* scene, const vtFrame* frame, vtReferenceImage* truth)
{
    vtReference* reference;
    vtEnvironment environment;
    vtError error;
    if (vtCreateReference(scene, &reference, &error) != vt_ok) {
        print_message("skipped: %s\n", error.message);
        return false;
    }
    assert_ok(vtCreateEnvironment("studio", &environment, &error), error);
    const vtReferenceDef def = {.frame = frame, .environment = &environment, .fresnel = true};
    assert_ok(vtReference_Trace(reference, &def, truth, &error), error);
    vtDestroyReference(reference);
    vtDestroyEnvironment(&environment);
    return true;
}

static void drawAt(Fixture* fixture, vtModel* model, double seconds, vtScene* scene, const vtFrame* frame,
                   const char* name)
{
    static float updated[3 * pixelCount];
    vtError error;
    vtReferenceImage truth = {0};
    vtDirectionError found;
    assert_ok(vtModel_SetTime(model, 0, seconds, NULL, scene, &error), error);
    assert_ok(vtRenderer_UpdateScene(fixture->renderer, scene, &error), error);
    draw(fixture, frame);
    memcpy(updated, fixture->directions, sizeof updated);
    if (traceWhole(scene, frame, &truth)) {
        assert_ok(vtCompareDirections(updated, truth.directions, pixelCount, &found, &error), error);
        const double flip = measurePicture(fixture, frame, &truth);
        print_message(
            "%-8s %.2f s: within 1 degree of the reference %.2f %%, mask %zu of %zu pixels, FLIP %.4f\n",
            name, seconds, 100.0 * found.within1, found.maskErrors, found.pixels, flip);
        assert_true(found.pixels > 500);
        assert_true(found.within1 >= 0.99);
        assert_true(found.maskErrors <= 5);
        assert_true(flip <= 0.05);
        vtDestroyReferenceImage(&truth);
    }
    assert_ok(vtRenderer_SetScene(fixture->renderer, scene, &error), error);
    draw(fixture, frame);
    assert_true(countDiffering(updated, fixture->directions) <= pixelCount / 1000);
}

static void movedModelsAreDrawn(void** state)
{
    static const char* const names[] = {"skin", "morph", "nodes"};
    static const double times[] = {0.5, 1.0, 1.75};
    Fixture* fixture = *state;
    setEnvironment(fixture->renderer, "studio");
    for (int kind = 0; kind < animatedCount; ++kind) {
        vtScene scene;
        vtError error;
        vtModel* model = openBuilt(buildAnimated(kind), &scene);
        const vtFrame frame = makeFrame(&scene);
        static float before[3 * pixelCount];
        prepare(&scene);
        assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
        draw(fixture, &frame);
        memcpy(before, fixture->directions, sizeof before);
        const uint32_t* records = scene.meshes[0].hierarchy->records;
        for (int i = 0; i < 3; ++i) {
            drawAt(fixture, model, times[i], &scene, &frame, names[kind]);
            assert_true(countDiffering(before, fixture->directions) > 500);
        }
        assert_int_equal(scene.meshes[0].updates, kind == animatedNodes ? 0 : 3);
        assert_ptr_equal(scene.meshes[0].hierarchy->records, records); // refitted, not built
        assert_ok(vtModel_SetTime(model, -1, 0.0, NULL, &scene, &error), error);
        assert_ok(vtRenderer_UpdateScene(fixture->renderer, &scene, &error), error);
        draw(fixture, &frame);
        assert_true(countDiffering(before, fixture->directions) <= pixelCount / 1000);
        vtCloseModel(model);
        vtDestroyScene(&scene);
    }
}

/// Only what has changed is taken over; another scene is refused.
static void scenesAreFollowed(void** state)
{
    Fixture* fixture = *state;
    vtScene scene, other;
    vtError error = {0};
    vtModel* model = openBuilt(buildMoved(), &scene);
    prepare(&scene);
    vtFrame frame = makeFrame(&scene);
    frame.ior = 0.0f;
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    draw(fixture, &frame);
    static float before[3 * pixelCount];
    memcpy(before, fixture->directions, sizeof before);
    scene.materials[0].ior = 1.2f;
    draw(fixture, &frame);
    assert_int_equal(countDiffering(before, fixture->directions), 0);
    assert_ok(vtRenderer_UpdateScene(fixture->renderer, &scene, &error), error);
    draw(fixture, &frame);
    assert_true(countDiffering(before, fixture->directions) > 500);
    scene.materials[0].ior = 77.0f;
    assert_int_equal(vtRenderer_UpdateScene(fixture->renderer, &scene, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "index of refraction"));
    vtModel* skin = openBuilt(buildSkinned(), &other);
    assert_int_equal(vtRenderer_UpdateScene(fixture->renderer, &other, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "it is not the one that was set last"));
    assert_int_equal(vtRenderer_UpdateScene(fixture->renderer, NULL, &error), vt_errorArgument);
    vtCloseModel(skin);
    vtDestroyScene(&other);
    vtCloseModel(model);
    vtDestroyScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(movedModelsAreDrawn),
        cmocka_unit_test(scenesAreFollowed),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
