// The CPU reference against closed forms, and against exit directions of Blender Cycles. The latter is
// research material that cannot be shipped; without it (environment variable VITRINE_DATA) that test skips
// itself.
#include "base/image.h"
#include "base/math.h"
#include "files.h"
#include "metrics.h"
#include "reference.h"
#include "scene/camera.h"
#include "testing.h"

static vtReference* createReference(const vtMesh* mesh)
{
    vtReference* reference;
    vtError error;
    assert_ok(vtCreateReference(mesh, &reference, &error), error);
    return reference;
}

static vtReferenceImage trace(const vtReference* reference, vtReferenceDef def)
{
    vtReferenceImage image;
    vtError error;
    assert_ok(vtReference_Trace(reference, &def, &image, &error), error);
    return image;
}

/// A built-in shape traced at once.
static vtReferenceImage traceShape(const char* name, vtReferenceDef def)
{
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateShape(name, &mesh, &error), error);
    vtReference* reference = createReference(&mesh);
    vtDestroyMesh(&mesh); // the reference must have copied what it needs
    vtReferenceImage image = trace(reference, def);
    vtDestroyReference(reference);
    return image;
}

static vtFrame makeFrame(int width, int height)
{
    vtFrame frame = vtDefaultFrame();
    frame.width = width;
    frame.height = height;
    return frame;
}

static vtVec3 eyeDirection(const vtFrame* frame, int pixel)
{
    const vtCameraFrame camera = vtMakeCameraFrame(&frame->view);
    const float tangent = tanf(frame->view.fovY * VT_PI / 360.0f);
    const float width = (float)frame->width, height = (float)frame->height;
    const float x = ((float)(pixel % frame->width) + 0.5f) / width * 2.0f - 1.0f;
    const float y = 1.0f - ((float)(pixel / frame->width) + 0.5f) / height * 2.0f;
    vtVec3 direction = vtMulAdd(camera.forward, x * tangent * width / height, camera.right);
    return vtNormalize(vtMulAdd(direction, y * tangent, camera.up));
}

static float degreesBetween(vtVec3 a, vtVec3 b)
{
    return atan2f(vtLength(vtCross(a, b)), vtDot(a, b)) * 180.0f / VT_PI;
}

/// Environments of 8 x 4 texels; the picture is the caller's.
enum { texelColumns = 8, texelRows = 4, texelCount = texelColumns * texelRows };

static vtEnvironment makeEnvironment(float* pixels)
{
    return (vtEnvironment){vt_environmentImage, pixels, texelColumns, texelRows};
}

// ------------------------------------------------------------------------------------------------ Cycles

typedef struct Case {
    const char* model;
    double within1; // share of pixels with at most 4 events that must be within 1 degree
} Case;

// Measured: sphere 99.98, torus 99.44, knot 99.33, spot 99.74, cow 98.99, bunny 99.82 %. What differs (2749
// pixels of 2775, the truth's lost ones counted; the other 26 are the bunny's) has an event where Cycles
// bends the interpolated normal because a ray mirrored at it would not clear the triangle. Our rules leave
// the normal alone as long as the ray itself goes to the right side.
static const Case cases[] = {
    {"sphere_512f", 0.999}, {"torus_576f", 0.99}, {"knot_2400f", 0.99},
    {"spot_5856", 0.99},    {"cow_5804", 0.98},   {"bunny_69666", 0.98},
};

/// NULL with a note where the file is absent.
static uint8_t* readData(const char* folder, const char* model, const char* ending, size_t* size)
{
    const char* data = getenv("VITRINE_DATA");
    char path[1024];
    uint8_t* bytes;
    vtError error;
    snprintf(path, sizeof path, "%s/%s/%s.%s", data != NULL ? data : "", folder, model, ending);
    if (vtReadFile(path, &bytes, size, &error) != vt_ok) {
        print_message("skipped: %s\n", error.message);
        return NULL;
    }
    return bytes;
}

/// Keeps the pixels whose path exits after at most 4 events and makes the others background in both.
static void keepShortPaths(const vtReferenceImage* image, float* truth, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        if (image->states[i] != VT_PATH_EXITED || image->events[i] > 4) {
            memset(truth + 3 * i, 0, 3 * sizeof(float));
            memset(image->directions + 3 * i, 0, 3 * sizeof(float));
        }
    }
}

static void compareWithTruth(const Case* entry, const vtMesh* mesh, float* truth, int width, int height)
{
    vtFrame frame = makeFrame(width, height);
    vtReference* reference = createReference(mesh);
    vtReferenceImage image = trace(reference, (vtReferenceDef){.frame = &frame});
    const size_t count = (size_t)width * (size_t)height;
    vtDirectionError all, few;
    vtError error;
    assert_ok(vtCompareDirections(image.directions, truth, count, &all, &error), error);
    keepShortPaths(&image, truth, count);
    assert_ok(vtCompareDirections(image.directions, truth, count, &few, &error), error);
    print_message("%-12s up to 4 events: within 1 degree %.2f %%, 5 degrees %.2f %%, median %.4f; "
                  "all: %.2f %%, lost %.2f %%, mask %zu pixels\n",
                  entry->model, 100.0 * few.within1, 100.0 * few.within5, few.median, 100.0 * all.within1,
                  100.0 * all.lost, all.maskErrors);
    assert_true(few.within1 >= entry->within1);
    assert_true(all.maskErrors < count / 1000);
    vtDestroyReferenceImage(&image);
    vtDestroyReference(reference);
}

static void agreesWithCycles(void** state)
{
    (void)state;
    int measured = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        size_t size, truthSize;
        uint8_t* bytes = readData("mesh", cases[i].model, "glb", &size);
        uint8_t* truthBytes = readData("truth", cases[i].model, "pfm", &truthSize);
        if (bytes != NULL && truthBytes != NULL) {
            vtError error;
            vtScene scene;
            vtModelDef def = {.bytes = bytes, .size = size, .name = cases[i].model};
            float* truth;
            int width, height;
            assert_ok(vtLoadScene(&def, &scene, &error), error);
            assert_ok(vtDecodePfm(truthBytes, truthSize, cases[i].model, &truth, &width, &height, &error),
                      error);
            compareWithTruth(&cases[i], &scene.meshes[0], truth, width, height);
            ++measured;
            free(truth);
            vtDestroyScene(&scene);
        }
        free(bytes);
        free(truthBytes);
    }
    if (measured == 0) {
        skip();
    }
}

// ------------------------------------------------------------------------------------------ closed forms

/// A ray that meets the unit sphere at the angle a is turned by 2 (a - b), sin b = sin a / ior, towards the
/// centre, in the plane of the two.
static bool passSphere(vtVec3 eye, vtVec3 direction, float ior, vtVec3* exit)
{
    const float along = -vtDot(eye, direction);
    const vtVec3 closest = vtMulAdd(eye, along, direction);
    const float offset = vtLength(closest);
    if (offset >= 1.0f) {
        return false;
    }
    const float turn = 2.0f * (asinf(offset) - asinf(offset / ior));
    *exit = vtMulAdd(vtScale(direction, cosf(turn)), -sinf(turn), vtNormalize(closest));
    return true;
}

static void sphereFollowsTheClosedForm(void** state)
{
    (void)state;
    vtFrame frame = makeFrame(128, 128);
    vtReferenceImage image = traceShape("sphere", (vtReferenceDef){.frame = &frame});
    int glass = 0, close = 0, mask = 0;
    for (int i = 0; i < 128 * 128; ++i) {
        vtVec3 exit;
        const bool met = passSphere(frame.view.eye, eyeDirection(&frame, i), frame.ior, &exit);
        mask += met != (image.states[i] != VT_PATH_BACKGROUND);
        if (met && image.states[i] == VT_PATH_EXITED) {
            ++glass;
            close += degreesBetween(vtMakeVec3(image.directions + 3 * i), exit) < 0.5f;
        }
    }
    print_message("sphere: %d pixels, %.2f %% within 0.5 degrees, %d of another mask\n", glass,
                  100.0 * close / glass, mask);
    assert_true(glass > 6000);
    assert_true(close >= 0.99 * glass);
    assert_true(mask < 128 * 128 / 1000);
    vtDestroyReferenceImage(&image);
}

/// Light neither appears nor vanishes: in a white room glass is white.
static void whiteRoomStaysWhite(void** state)
{
    (void)state;
    static const char* const names[] = {"sphere", "knot", "diamond"};
    float white[3 * texelCount];
    for (int i = 0; i < 3 * texelCount; ++i) {
        white[i] = 1.0f;
    }
    const vtEnvironment environment = makeEnvironment(white);
    vtFrame frame = makeFrame(96, 64);
    for (int i = 0; i < 6; ++i) {
        const bool fresnel = i >= 3;
        vtReferenceImage image = traceShape(names[i % 3], (vtReferenceDef){.frame = &frame,
                                                                           .environment = &environment,
                                                                           .samples = fresnel ? 8 : 1,
                                                                           .fresnel = fresnel});
        for (int k = 0; k < 3 * 96 * 64; ++k) {
            assert_near(image.radiance[k], 1.0f, 1e-3f);
        }
        vtDestroyReferenceImage(&image);
    }
}

/// A plate 20 x 20 x 1 with flat faces, seen head on.
static vtReference* createPlate(void)
{
    float positions[3 * 24], normals[3 * 24] = {0};
    uint32_t indices[36];
    const float size[3] = {10.0f, 10.0f, 0.5f};
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2, second = (axis + 1) % 3, third = (axis + 2) % 3;
        const float side = face % 2 == 0 ? 1.0f : -1.0f;
        for (int corner = 0; corner < 4; ++corner) {
            float* position = positions + 3 * (4 * face + corner);
            position[axis] = side * size[axis];
            position[second] = (corner == 1 || corner == 2 ? 1.0f : -1.0f) * size[second];
            position[third] = (corner >= 2 ? 1.0f : -1.0f) * side * size[third];
            normals[3 * (4 * face + corner) + axis] = side;
        }
        static const uint32_t square[6] = {0, 1, 2, 0, 2, 3};
        for (int i = 0; i < 6; ++i) {
            indices[6 * face + i] = 4 * (uint32_t)face + square[i];
        }
    }
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateMesh(&(vtMeshDef){.positions = positions,
                                        .normals = normals,
                                        .indices = indices,
                                        .vertexCount = 24,
                                        .indexCount = 36},
                           "plate", &mesh, &error),
              error);
    assert_int_equal(mesh.openEdgeCount, 0);
    vtReference* reference = createReference(&mesh);
    vtDestroyMesh(&mesh);
    return reference;
}

/// With reflections to and fro inside, a plate mirrors 2 R / (1 + R) of what falls on it head on, R that of
/// one surface (Hecht, Optics, section 4.6).
static void plateReflectsTheTextbookShare(void** state)
{
    (void)state;
    float behind[3 * texelCount]; // white behind the eye (u > 0.5), black before it
    for (int i = 0; i < 3 * texelCount; ++i) {
        behind[i] = i / 3 % texelColumns >= texelColumns / 2 ? 1.0f : 0.0f;
    }
    const vtEnvironment environment = makeEnvironment(behind);
    const float iors[3] = {1.33f, 1.5f, 2.4f};
    vtReference* plate = createPlate();
    for (int i = 0; i < 3; ++i) {
        vtFrame frame = makeFrame(64, 64);
        frame.view = (vtView){{0.1f, 0.2f, 3.0f}, {0.1f, 0.2f, 0.0f}, 1.0f};
        frame.ior = iors[i];
        frame.maxEvents = VT_MAX_EVENTS;
        vtReferenceImage image = trace(
            plate,
            (vtReferenceDef){.frame = &frame, .environment = &environment, .samples = 64, .fresnel = true});
        double mean = 0.0;
        for (int k = 0; k < 64 * 64; ++k) {
            assert_int_equal(image.states[k], VT_PATH_EXITED);
            assert_int_equal(image.events[k], 2); // the centre's path does not reflect
            mean += (double)image.radiance[3 * k] / (64.0 * 64.0);
        }
        const double n = (double)iors[i], R = (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
        const double expected = 2.0 * R / (1.0 + R);
        print_message("plate of ior %.2f: reflects %.4f, expected %.4f\n", n, mean, expected);
        // Four standard deviations of 64^3 yes-or-no samples.
        assert_near((float)mean, (float)expected,
                    4.0f * sqrtf((float)(expected * (1.0 - expected))) / 512.0f);
        vtDestroyReferenceImage(&image);
    }
    vtDestroyReference(plate);
}

static void indexOneIsNotThere(void** state)
{
    (void)state;
    float smooth[3 * texelCount];
    for (int i = 0; i < 3 * texelCount; ++i) {
        smooth[i] = 0.5f + 0.4f * sinf((float)(i % 3) + 2.0f * VT_PI * (float)(i / 3 % texelColumns) / 8.0f);
    }
    const vtEnvironment environment = makeEnvironment(smooth);
    vtFrame frame = makeFrame(64, 48);
    frame.ior = 1.0f;
    frame.maxEvents = VT_MAX_EVENTS;
    for (int i = 0; i < 3; ++i) {
        vtReferenceImage image = traceShape("knot", (vtReferenceDef){.frame = &frame,
                                                                     .environment = &environment,
                                                                     .samples = i == 0 ? 1 : 16,
                                                                     .fresnel = i == 2});
        for (int k = 0; k < 64 * 48; ++k) {
            const vtVec3 direction = eyeDirection(&frame, k);
            const vtVec3 bare = vtEnvironment_Sample(&environment, direction);
            // Samples spread over the pixel see a mean, which a smooth environment hardly changes.
            const float tolerance = i == 0 ? 1e-4f : 5e-3f;
            assert_near(image.radiance[3 * k], bare.x, tolerance);
            assert_near(image.radiance[3 * k + 1], bare.y, tolerance);
            assert_near(image.radiance[3 * k + 2], bare.z, tolerance);
            assert_int_not_equal(image.states[k], VT_PATH_LOST);
            if (image.states[k] == VT_PATH_EXITED) {
                assert_true(degreesBetween(vtMakeVec3(image.directions + 3 * k), direction) < 0.01f);
                assert_int_equal(image.events[k] % 2, 0);
                assert_int_equal(image.reflections[k], 0);
            }
        }
        vtDestroyReferenceImage(&image);
    }
}

// ----------------------------------------------------------------------------------------------- picture

static void eventsRunOut(void** state)
{
    (void)state;
    vtFrame frame = makeFrame(32, 32);
    frame.maxEvents = 1;
    vtReferenceImage image = traceShape("sphere", (vtReferenceDef){.frame = &frame});
    assert_null(image.radiance);
    for (int i = 0; i < 32 * 32; ++i) {
        const bool lost = image.states[i] == VT_PATH_LOST;
        assert_true(lost || image.states[i] == VT_PATH_BACKGROUND);
        assert_int_equal(image.events[i], lost);
        for (int k = 0; k < 3; ++k) {
            assert_true(image.directions[3 * i + k] == (lost ? 2.0f : 0.0f));
        }
    }
    assert_int_equal(image.states[32 * 16 + 16], VT_PATH_LOST);
    assert_int_equal(image.states[0], VT_PATH_BACKGROUND);
    vtDestroyReferenceImage(&image);
}

static void totalReflectionIsNoted(void** state)
{
    (void)state;
    vtFrame frame = makeFrame(64, 64);
    int counts[2] = {0, 0};
    for (int i = 0; i < 2; ++i) {
        vtReferenceImage image = traceShape(i == 0 ? "sphere" : "torus", (vtReferenceDef){.frame = &frame});
        for (int k = 0; k < 64 * 64; ++k) {
            counts[i] += image.reflections[k];
            // Without a reflection a path that has left has gone in and out in turns.
            if (image.states[k] == VT_PATH_EXITED && image.reflections[k] == 0) {
                assert_int_equal(image.events[k] % 2, 0);
            }
        }
        vtDestroyReferenceImage(&image);
    }
    assert_true(counts[0] <= 20); // none in a true sphere; facets at the rim would allow a few
    assert_true(counts[1] > 500); // measured: 876
}

static void eyeWithinTheGlassSeesOut(void** state)
{
    (void)state;
    vtFrame frame = makeFrame(32, 32);
    frame.view = (vtView){{0.0f, 0.0f, 0.0f}, {0.3f, 0.1f, -1.0f}, 60.0f};
    vtReferenceImage image = traceShape("sphere", (vtReferenceDef){.frame = &frame});
    for (int i = 0; i < 32 * 32; ++i) {
        // From the centre every ray meets the surface head on.
        assert_int_equal(image.states[i], VT_PATH_EXITED);
        assert_int_equal(image.events[i], 1);
        assert_true(degreesBetween(vtMakeVec3(image.directions + 3 * i), eyeDirection(&frame, i)) < 0.1f);
    }
    vtDestroyReferenceImage(&image);
}

static void threadsDoNotChangeThePicture(void** state)
{
    (void)state;
    vtFrame frame = makeFrame(101, 67);
    vtEnvironment environment;
    vtError error;
    assert_ok(vtCreateEnvironment("studio", &environment, &error), error);
    vtReferenceDef def = {.frame = &frame, .environment = &environment, .samples = 5, .fresnel = true};
    vtReferenceImage images[3];
    for (int i = 0; i < 3; ++i) {
        def.threads = i == 0 ? 1 : i == 1 ? 7 : 0;
        images[i] = traceShape("knot", def);
        assert_memory_equal(images[i].directions, images[0].directions, 3 * sizeof(float) * 101 * 67);
        assert_memory_equal(images[i].radiance, images[0].radiance, 3 * sizeof(float) * 101 * 67);
        assert_memory_equal(images[i].events, images[0].events, 101 * 67);
        assert_memory_equal(images[i].states, images[0].states, 101 * 67);
        assert_memory_equal(images[i].reflections, images[0].reflections, 101 * 67);
    }
    for (int i = 0; i < 3; ++i) {
        vtDestroyReferenceImage(&images[i]);
    }
    vtDestroyEnvironment(&environment);
}

static void rememberProgress(float share, void* userData)
{
    float* last = userData;
    assert_true(share >= *last && share <= 1.0f);
    *last = share;
}

static void progressEndsAtOne(void** state)
{
    (void)state;
    vtFrame frame = makeFrame(64, 64);
    float last = 0.0f;
    vtReferenceImage image = traceShape(
        "torus", (vtReferenceDef){.frame = &frame, .progress = rememberProgress, .userData = &last});
    assert_true(last == 1.0f);
    vtDestroyReferenceImage(&image);
}

static void wrongSettingsAreNamed(void** state)
{
    (void)state;
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateShape("torus", &mesh, &error), error);
    vtReference* reference = createReference(&mesh);
    vtFrame good = makeFrame(8, 8), bad = makeFrame(8, 8);
    bad.ior = 0.5f;
    const struct {
        vtReferenceDef def;
        const char* word;
    } entries[] = {
        {{.frame = &good, .samples = -1}, "samples is -1"},
        {{.frame = &good, .samples = VT_MAX_TRACED_SAMPLES + 1}, "samples is 65537"},
        {{.frame = &good, .threads = -2}, "threads is -2"},
        {{.frame = &bad}, "index of refraction is 0.5"},
    };
    for (size_t i = 0; i < sizeof entries / sizeof entries[0]; ++i) {
        vtReferenceImage image = {.width = 5};
        assert_int_equal(vtReference_Trace(reference, &entries[i].def, &image, &error), vt_errorArgument);
        assert_non_null(strstr(error.message, entries[i].word));
        assert_int_equal(image.width, 0);
        vtDestroyReferenceImage(&image);
    }
    vtDestroyReference(reference);
    vtDestroyReference(NULL);
    vtDestroyMesh(&mesh);
}

static void pictureIsEncodedAsSrgb(void** state)
{
    (void)state;
    float radiance[6] = {0.0f, 0.002f, 1.0f, 7.0f, -1.0f, 0.5f}; // 0.002 lies on the linear piece
    uint8_t rgba[8];
    vtReference_ToSrgb(&(vtReferenceImage){.width = 2, .height = 1, .radiance = radiance}, rgba);
    const uint8_t expected[8] = {0, 7, 255, 255, 255, 0, 188, 255};
    assert_memory_equal(rgba, expected, sizeof rgba);
}

// --------------------------------------------------------------------------------------- inner distances

static void checkInnerDistances(const char* name, float expected, float tolerance)
{
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateShape(name, &mesh, &error), error);
    vtReference* reference = createReference(&mesh);
    float* distances = malloc(sizeof(float) * mesh.vertexCount);
    assert_non_null(distances);
    assert_ok(vtReference_InnerDistances(reference, &mesh, distances, &error), error);
    for (uint32_t i = 0; i < mesh.vertexCount; ++i) {
        assert_near(distances[i], expected, tolerance);
    }
    free(distances);
    vtDestroyReference(reference);
    vtDestroyMesh(&mesh);
}

static void innerDistancesAreDiameters(void** state)
{
    (void)state;
    checkInnerDistances("sphere", 2.0f, 2e-3f);
    checkInnerDistances("torus", 0.8f, 2e-3f);
}

// The core's own search, which the browser uses, gives what Embree gives.
static void portableInnerDistancesAreTheSame(void** state)
{
    (void)state;
    static const char* const shapes[] = {"torus", "goblet", "diamond"};
    for (int i = 0; i < 3; ++i) {
        vtMesh mesh;
        vtReference* reference;
        vtError error;
        assert_ok(vtCreateShape(shapes[i], &mesh, &error), error);
        assert_ok(vtCreateReference(&mesh, &reference, &error), error);
        float* traced = malloc(mesh.vertexCount * sizeof *traced);
        assert_ok(vtReference_InnerDistances(reference, &mesh, traced, &error), error);
        assert_ok(vtComputeInnerDistances(&mesh, &error), error);
        uint32_t different = 0;
        for (uint32_t v = 0; v < mesh.vertexCount; ++v) {
            different += fabsf(mesh.innerDistances[v] - traced[v]) > 1e-3f;
        }
        print_message("%s: %u of %u inner distances differ\n", shapes[i], different, mesh.vertexCount);
        assert_true(different <= mesh.vertexCount / 100); // rays along an edge, where either side may be met
        free(traced);
        vtDestroyReference(reference);
        vtDestroyMesh(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agreesWithCycles),
        cmocka_unit_test(sphereFollowsTheClosedForm),
        cmocka_unit_test(whiteRoomStaysWhite),
        cmocka_unit_test(plateReflectsTheTextbookShare),
        cmocka_unit_test(indexOneIsNotThere),
        cmocka_unit_test(eventsRunOut),
        cmocka_unit_test(totalReflectionIsNoted),
        cmocka_unit_test(eyeWithinTheGlassSeesOut),
        cmocka_unit_test(threadsDoNotChangeThePicture),
        cmocka_unit_test(progressEndsAtOne),
        cmocka_unit_test(wrongSettingsAreNamed),
        cmocka_unit_test(pictureIsEncodedAsSrgb),
        cmocka_unit_test(innerDistancesAreDiameters),
        cmocka_unit_test(portableInnerDistancesAreTheSame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
