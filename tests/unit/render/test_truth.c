// `layered` and `exact` against exit directions of Blender Cycles: refraction and total internal reflection
// of index 1.5, 8 events, 512 x 512, one ray through each pixel centre. The data is research material that
// cannot be shipped; without it (environment variable VITRINE_DATA) the tests skip themselves.
#include "base/math.h"
#include "cli/files.h"
#include "context/context.h"
#include "image/image.h"
#include "image/pfm.h"
#include "lab/metrics/metrics.h"
#include "lab/reference/reference.h"
#include "scene/objects.h"
#include "testing.h"

enum { side = 512 };

typedef struct Case {
    const char* model;
    double twoLayers;  // share of pixels that must be within 1 degree of `layered`, two layers
    double fourLayers; // the same of four
    double exact;      // the same of `exact`
    double shortPaths; // the same of `exact`, of paths of at most four events
    bool convex;       // two layers hold all of it
} Case;

// Less than a point below what is measured; README.md shows those figures.
static const Case cases[] = {
    {"sphere_512f", 0.992, 0.992, 0.999, 0.999, true}, {"torus_576f", 0.433, 0.749, 0.990, 0.993, false},
    {"knot_2400f", 0.645, 0.774, 0.990, 0.993, false}, {"spot_5856", 0.702, 0.840, 0.988, 0.996, false},
    {"cow_5804", 0.812, 0.823, 0.970, 0.988, false},   {"bunny_69666", 0.713, 0.726, 0.944, 0.993, false},
};

typedef struct Fixture {
    vtContext context;
    vtRenderer* renderer;
    const char* data;
} Fixture;

static int setUp(void** state)
{
    Fixture* fixture = calloc(1, sizeof *fixture);
    vtError error;
    fixture->data = getenv("VITRINE_DATA");
    assert_ok(vtCreateContext(vt_backendAuto, &fixture->context, &error), error);
    assert_ok(vtCreateRenderer(&(vtRendererDef){.getProcAddress = fixture->context.getProcAddress},
                               &fixture->renderer, &error),
              error);
    *state = fixture;
    return 0;
}

static int tearDown(void** state)
{
    Fixture* fixture = *state;
    vtDestroyRenderer(fixture->renderer);
    vtDestroyContext(&fixture->context);
    free(fixture);
    return 0;
}

/// NULL with a note where the file is absent.
static uint8_t* readData(const Fixture* fixture, const char* folder, const char* model, const char* ending,
                         size_t* size)
{
    char path[1024];
    uint8_t* bytes;
    vtError error;
    snprintf(path, sizeof path, "%s/%s/%s.%s", fixture->data != NULL ? fixture->data : "", folder, model,
             ending);
    if (vtReadFile(path, &bytes, size, &error) != vt_ok) {
        print_message("skipped: %s\n", error.message);
        return NULL;
    }
    return bytes;
}

static vtDirectionError measure(Fixture* fixture, vtTechnique technique, int layers, const float* truth)
{
    vtFrame frame = vtDefaultFrame();
    frame.fresnel = false;
    vtDirectionError result;
    vtError error;
    uint8_t* pixels = malloc(4 * side * side);
    float* directions = malloc(3 * sizeof(float) * side * side);
    frame.technique = technique;
    frame.layers = layers;
    assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, pixels, &error), error);
    assert_ok(vtRenderer_ReadDirections(fixture->renderer, directions, &error), error);
    assert_ok(vtCompareDirections(directions, truth, side * side, &result, &error), error);
    print_message(
        "  %s, %d layers: within 1 degree %.2f %%, 5 degrees %.2f %%, median %.3f, lost %.2f %%, mask "
        "%zu pixels\n",
        vtTechnique_Info(technique)->id, vtResolveFrame(&frame).layers, 100.0 * result.within1,
        100.0 * result.within5, result.median, 100.0 * result.lost, result.maskErrors);
    free(pixels);
    free(directions);
    return result;
}

/// Paths of at most four events by `exact`, low presets apart; how many events a path has the reference
/// tells. `truth`: NULL: the reference's own directions.
static void checkShortPaths(Fixture* fixture, const vtScene* scene, const float* truth, double least)
{
    for (int preset = vt_presetMedium; preset <= vt_presetHigh; ++preset) {
        vtFrame frame = vtDefaultFrame();
        frame.fresnel = false;
        frame.preset = (vtPreset)preset;
        vtReference* reference;
        vtReferenceImage traced;
        vtError error;
        if (vtCreateReference(scene, &reference, &error) != vt_ok) {
            print_message("  skipped: %s\n", error.message);
            return;
        }
        assert_ok(vtReference_Trace(reference, &(vtReferenceDef){.frame = &frame}, &traced, &error), error);
        uint8_t* pixels = malloc(4 * side * side);
        float* directions = malloc(3 * sizeof(float) * side * side);
        assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, pixels, &error), error);
        assert_ok(vtRenderer_ReadDirections(fixture->renderer, directions, &error), error);
        const float* right = truth != NULL ? truth : traced.directions;
        int compared = 0, within = 0, lost = 0;
        for (int i = 0; i < side * side; ++i) {
            const float* a = directions + 3 * (size_t)i;
            const float* b = right + 3 * (size_t)i;
            const bool isGlass = b[0] != 2.0f && vtDot(vtMakeVec3(b), vtMakeVec3(b)) > 0.5f;
            if (isGlass && traced.events[i] > 0 && traced.events[i] <= 4) {
                ++compared;
                within += a[0] != 2.0f && vtDirectionAngle(a, b) < 1.0f;
                lost += a[0] == 2.0f;
            }
        }
        print_message("  exact, %s, paths of 1 to 4 events: within 1 degree %.3f %%, lost %.4f %%, of %d\n",
                      vtPresetName(preset), 100.0 * within / compared, 100.0 * lost / compared, compared);
        assert_true(compared > side * side / 20);
        assert_true(within >= least * compared);
        assert_true(lost <= 0.0002 * compared);
        free(pixels);
        free(directions);
        vtDestroyReferenceImage(&traced);
        vtDestroyReference(reference);
    }
}

static void shapesAgreeWithTheReference(void** state)
{
    Fixture* fixture = *state;
    static const char* const shapes[] = {"goblet", "bottle"};
    for (int i = 0; i < 2; ++i) {
        vtMesh mesh;
        vtBorrowedMesh borrowed;
        vtError error;
        assert_ok(vtCreateShape(shapes[i], &mesh, &error), error);
        const vtScene* scene = vtBorrowMesh(&mesh, &borrowed);
        assert_ok(vtRenderer_SetScene(fixture->renderer, scene, &error), error);
        print_message("%s\n", shapes[i]);
        checkShortPaths(fixture, scene, NULL, 0.993);
        vtDestroyMesh(&mesh);
    }
}

static void directionsAgreeWithCycles(void** state)
{
    Fixture* fixture = *state;
    int measured = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        size_t size, truthSize;
        uint8_t* bytes = readData(fixture, "mesh", cases[i].model, "glb", &size);
        uint8_t* truthBytes = readData(fixture, "truth", cases[i].model, "pfm", &truthSize);
        if (bytes == NULL || truthBytes == NULL) {
            free(bytes);
            free(truthBytes);
            continue;
        }
        vtError error;
        vtScene scene;
        float* truth;
        int width, height;
        assert_ok(
            vtLoadScene(&(vtModelDef){.bytes = bytes, .size = size, .name = cases[i].model}, &scene, &error),
            error);
        scene.materials[0].thin = false; // the file gives no volume
        assert_ok(vtDecodePfm(truthBytes, truthSize, cases[i].model, &truth, &width, &height, &error), error);
        assert_int_equal(width, side);
        assert_int_equal(height, side);
        assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);

        print_message("%s\n", cases[i].model);
        vtDirectionError two = measure(fixture, vt_techniqueLayered, 2, truth);
        vtDirectionError four = measure(fixture, vt_techniqueLayered, 4, truth);
        vtDirectionError exact = measure(fixture, vt_techniqueExact, 0, truth);
        assert_true(two.within1 >= cases[i].twoLayers);
        assert_true(four.within1 >= cases[i].fourLayers);
        assert_true(exact.within1 >= cases[i].exact);
        assert_true(exact.lost <= 0.01);
        checkShortPaths(fixture, &scene, truth, cases[i].shortPaths);
        assert_true(exact.maskErrors < side * side / 1000);
        assert_true(four.maskErrors < side * side / 1000);
        assert_true(cases[i].convex ? four.within1 >= two.within1 : four.within1 > two.within1);
        ++measured;
        free(bytes);
        free(truthBytes);
        free(truth);
        vtDestroyScene(&scene);
    }
    if (measured == 0) {
        skip();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directionsAgreeWithCycles),
        cmocka_unit_test(shapesAgreeWithTheReference),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
