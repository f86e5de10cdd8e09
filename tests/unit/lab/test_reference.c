// The CPU reference against closed forms, and against exit directions of Blender Cycles. The latter is
// research material that cannot be shipped; without it (environment variable VITRINE_DATA) that test skips
// itself.
#include "base/math.h"
#include "base/optics.h"
#include "cli/files.h"
#include "image/image.h"
#include "image/pfm.h"
#include "lab/metrics/metrics.h"
#include "lab/reference/reference.h"
#include "scene/camera.h"
#include "scene/objects.h"
#include "testing.h"

static vtReferenceImage trace(const vtScene* scene, vtReferenceDef def)
{
    vtReference* reference;
    vtReferenceImage image;
    vtError error;
    assert_ok(vtCreateReference(scene, &reference, &error), error);
    assert_ok(vtReference_Trace(reference, &def, &image, &error), error);
    vtDestroyReference(reference);
    return image;
}

static vtMesh createShape(const char* name)
{
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateShape(name, &mesh, &error), error);
    return mesh;
}

/// A scene of one object of the index 1.5, which takes the mesh over.
static vtScene makeScene(vtMesh mesh)
{
    const vtMaterial material = vtDefaultMaterial();
    vtScene scene;
    vtError error;
    assert_ok(vtCreateMeshScene(&mesh, &material, &scene, &error), error);
    return scene;
}

/// A built-in shape traced at once.
static vtReferenceImage traceShape(const char* name, vtReferenceDef def)
{
    vtScene scene = makeScene(createShape(name));
    vtReferenceImage image = trace(&scene, def);
    vtDestroyScene(&scene);
    return image;
}

static vtFrame makeFrame(int width, int height)
{
    vtFrame frame = vtDefaultFrame();
    frame.ior = 1.5f;
    frame.width = width;
    frame.height = height;
    return frame;
}

static vtVec3 eyeDirection(const vtFrame* frame, int pixel)
{
    const vtCamera camera = vtMakeViewCamera(&frame->view);
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

static void compareWithTruth(const Case* entry, const vtScene* scene, float* truth, int width, int height)
{
    vtFrame frame = makeFrame(width, height);
    vtReferenceImage image = trace(scene, (vtReferenceDef){.frame = &frame});
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
            scene.materials[0].thin = false; // the file gives no volume
            assert_ok(vtDecodePfm(truthBytes, truthSize, cases[i].model, &truth, &width, &height, &error),
                      error);
            compareWithTruth(&cases[i], &scene, truth, width, height);
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
        float least = 1.0f;
        for (int k = 0; k < 3 * 96 * 64; ++k) {
            least = fminf(least, image.radiance[k]);
            // With the tree a little is missing: what reflects so often that it is not followed.
            assert_near(image.radiance[k], 1.0f, fresnel ? 2e-2f : 1e-3f);
        }
        print_message("%s in a white room: at least %.4f\n", names[i % 3], (double)least);
        vtDestroyReferenceImage(&image);
    }
}

/// A box with flat faces.
static vtMesh createBox(vtVec3 low, vtVec3 high)
{
    float positions[3 * 24], normals[3 * 24] = {0};
    uint32_t indices[36];
    const float bounds[2][3] = {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2, second = (axis + 1) % 3, third = (axis + 2) % 3;
        const int side = face % 2;
        for (int corner = 0; corner < 4; ++corner) {
            float* position = positions + 3 * (4 * face + corner);
            position[axis] = bounds[side][axis];
            position[second] = bounds[corner == 1 || corner == 2][second];
            position[third] = bounds[(corner >= 2) == (side == 1)][third];
            normals[3 * (4 * face + corner) + axis] = side == 1 ? 1.0f : -1.0f;
        }
        static const uint32_t square[6] = {0, 1, 2, 0, 2, 3};
        for (int i = 0; i < 6; ++i) {
            indices[6 * face + i] = 4 * (uint32_t)face + square[i];
        }
    }
    const vtMeshDef def = {
        .positions = positions, .normals = normals, .indices = indices, .vertexCount = 24, .indexCount = 36};
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateMesh(&def, "box", &mesh, &error), error);
    assert_int_equal(mesh.openEdgeCount, 0);
    return mesh;
}

/// A plate 20 x 20 x 1, and a view of it head on.
static vtMesh createPlate(void)
{
    return createBox((vtVec3){-10.0f, -10.0f, -0.5f}, (vtVec3){10.0f, 10.0f, 0.5f});
}

static vtFrame facePlate(void)
{
    vtFrame frame = makeFrame(8, 8);
    frame.view = (vtView){{0.1f, 0.2f, 3.0f}, {0.1f, 0.2f, 0.0f}, 1.0f};
    frame.maxEvents = VT_MAX_EVENTS;
    return frame;
}

/// With reflections to and fro inside, a plate mirrors 2 R / (1 + R) of what falls on it head on, R that of
/// one surface (Hecht, Optics, section 4.6); (1 - R)^2 / (1 - R^2) passes.
static void plateReflectsTheTextbookShare(void** state)
{
    (void)state;
    float behind[3 * texelCount], ahead[3 * texelCount], all[3 * texelCount]; // behind the eye: u > 0.5
    for (int i = 0; i < 3 * texelCount; ++i) {
        behind[i] = i / 3 % texelColumns >= texelColumns / 2 ? 1.0f : 0.0f;
        ahead[i] = 1.0f - behind[i];
        all[i] = 1.0f;
    }
    const vtEnvironment environments[3] = {makeEnvironment(behind), makeEnvironment(ahead),
                                           makeEnvironment(all)};
    const float iors[3] = {1.33f, 1.5f, 2.4f};
    vtScene plate = makeScene(createPlate());
    for (int i = 0; i < 9; ++i) {
        vtFrame frame = facePlate();
        frame.ior = iors[i % 3];
        vtReferenceImage image = trace(
            &plate, (vtReferenceDef){
                        .frame = &frame, .environment = &environments[i / 3], .samples = 2, .fresnel = true});
        const float n = frame.ior, R = (n - 1.0f) * (n - 1.0f) / ((n + 1.0f) * (n + 1.0f));
        const float expected[3] = {2.0f * R / (1.0f + R), (1.0f - R) * (1.0f - R) / (1.0f - R * R), 1.0f};
        for (int k = 0; k < 8 * 8; ++k) {
            assert_int_equal(image.states[k], VT_PATH_EXITED);
            assert_int_equal(image.events[k], 2); // the path whose direction is told does not reflect
            assert_near(image.radiance[3 * k], expected[i / 3], 4e-3f);
        }
        print_message("plate of ior %.2f: %.4f, expected %.4f\n", (double)n, (double)image.radiance[0],
                      (double)expected[i / 3]);
        vtDestroyReferenceImage(&image);
    }
    vtDestroyScene(&plate);
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
            assert_int_equal(image.states[k], VT_PATH_BACKGROUND);
            assert_int_equal(image.events[k], 0);
            assert_int_equal(image.reflections[k], 0);
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
    vtScene scene = makeScene(createShape("torus"));
    vtReference* reference;
    vtError error;
    assert_ok(vtCreateReference(&scene, &reference, &error), error);
    vtFrame good = makeFrame(8, 8), bad = makeFrame(8, 8);
    bad.ior = 0.5f;
    const struct {
        vtReferenceDef def;
        const char* word;
    } entries[] = {
        {{.frame = &good, .samples = -1}, "samples is -1"},
        {{.frame = &good, .samples = VT_MAX_TRACED_SAMPLES + 1}, "samples is 65537"},
        {{.frame = &good, .threads = -2}, "threads is -2"},
        {{.frame = &bad}, "ior is 0.5"},
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
    scene.objects[0].mesh = 7;
    assert_int_equal(vtCreateReference(&scene, &reference, &error), vt_errorGeometry);
    assert_null(reference);
    vtDestroyScene(&scene);
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

// ------------------------------------------------------------------------------------------------ scenes

/// Adds an object, which takes the mesh over.
static void addObject(vtScene* scene, vtMesh mesh, vtMaterial material, vtTransform toWorld)
{
    vtScene one;
    vtError error;
    assert_ok(vtCreateMeshScene(&mesh, &material, &one, &error), error);
    assert_ok(vtScene_Append(scene, &one, &toWorld, &error), error);
}

static vtTransform place(vtVec3 center, float scale)
{
    return (vtTransform){{{scale, 0, 0, center.x}, {0, scale, 0, center.y}, {0, 0, scale, center.z}}};
}

static vtMaterial glassOf(float ior)
{
    vtMaterial material = vtDefaultMaterial();
    material.ior = ior;
    return material;
}

/// Its light is the colour in the dark.
static vtMaterial lamp(vtVec3 color)
{
    vtMaterial material = vtDefaultMaterial();
    material.opaque = true;
    material.baseColor = material.emissive = color;
    return material;
}

/// A unit sphere of 130000 triangles.
static vtMesh createFineSphere(void)
{
    enum { rings = 181, columns = 361 };
    float* positions = malloc(3 * sizeof(float) * rings * columns);
    uint32_t* indices = malloc(6 * sizeof(uint32_t) * (rings - 1) * (columns - 1));
    assert_true(positions != NULL && indices != NULL);
    uint32_t count = 0;
    for (uint32_t i = 0; i < rings * columns; ++i) {
        const float a = VT_PI * (float)(i / columns) / (rings - 1);
        // The last column lies on the first to the bit, and so do the vertices of a pole.
        const float b = 2.0f * VT_PI * (float)(i % columns % (columns - 1)) / (columns - 1);
        const bool pole = i < columns || i >= (rings - 1) * columns;
        const float radius = pole ? 0.0f : sinf(a);
        positions[3 * i] = radius * cosf(b);
        positions[3 * i + 1] = pole ? (i < columns ? 1.0f : -1.0f) : cosf(a);
        positions[3 * i + 2] = radius * sinf(b);
        if (i % columns > 0 && i >= columns) {
            const uint32_t corners[4] = {i - columns - 1, i - columns, i - 1, i};
            const uint32_t triangles[6] = {corners[0], corners[1], corners[2],
                                           corners[1], corners[3], corners[2]};
            for (uint32_t k = 0; k < 6; k += 3) {
                const bool flat = k == 0 ? i < 2 * columns : i >= (rings - 1) * columns;
                memcpy(indices + count, triangles + k, flat ? 0 : 3 * sizeof(uint32_t));
                count += flat ? 0 : 3;
            }
        }
    }
    const vtMeshDef def = {.positions = positions,
                           .normals = positions,
                           .indices = indices,
                           .vertexCount = rings * columns,
                           .indexCount = count};
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateMesh(&def, "fine sphere", &mesh, &error), error);
    assert_int_equal(mesh.openEdgeCount, 0);
    free(positions);
    free(indices);
    return mesh;
}

/// Every object's own index; whole pictures are compared, so paths may be long.
static vtFrame makeSceneFrame(int side)
{
    vtFrame frame = makeFrame(side, side);
    frame.ior = 0.0f;
    frame.maxEvents = VT_MAX_EVENTS;
    return frame;
}

static vtVec3 directionAt(const vtReferenceImage* image, int pixel)
{
    return vtMakeVec3(image->directions + 3 * pixel);
}

/// Pixels whose states or events differ, or whose directions differ by more than `degrees`.
static int countDifferences(const vtReferenceImage* a, const vtReferenceImage* b, float degrees)
{
    int differences = 0;
    for (int i = 0; i < a->width * a->height; ++i) {
        differences += a->states[i] != b->states[i] || a->events[i] != b->events[i] ||
                       a->reflections[i] != b->reflections[i] ||
                       (a->states[i] == VT_PATH_EXITED &&
                        degreesBetween(directionAt(a, i), directionAt(b, i)) > degrees);
    }
    return differences;
}

/// Takes a ray through a ball; false where it passes by, or so near to its rim that facets matter.
static bool passBall(vtVec3 center, float ior, vtVec3* origin, vtVec3* direction)
{
    for (int event = 0; event < 2; ++event) {
        const vtVec3 offset = vtSub(*origin, center);
        const float along = -vtDot(offset, *direction);
        const float distance = vtLength(vtMulAdd(offset, along, *direction));
        if (distance > 0.9f || (event == 0 && along < 0.0f)) {
            return false;
        }
        const float half = sqrtf(1.0f - distance * distance);
        *origin = vtMulAdd(*origin, event == 0 ? along - half : along + half, *direction);
        const vtVec3 N = vtScale(vtSub(*origin, center), event == 0 ? 1.0f : -1.0f);
        bool reflected;
        *direction = vtBend(*direction, N, event == 0 ? 1.0f / ior : ior, &reflected);
        assert_false(reflected);
    }
    return true;
}

static void lightPassesTwoSpheres(void** state)
{
    (void)state;
    const vtVec3 centers[2] = {{0.0f, 0.0f, 0.0f}, {0.3f, 0.2f, -3.0f}};
    const float iors[2] = {1.3f, 1.5f};
    vtScene scene = {0};
    addObject(&scene, createFineSphere(), glassOf(iors[0]), place(centers[0], 1.0f));
    addObject(&scene, createFineSphere(), glassOf(iors[1]), place(centers[1], 1.0f));
    vtFrame frame = makeSceneFrame(96);
    frame.view = (vtView){{0.2f, 0.1f, 5.0f}, {0.0f, 0.0f, 0.0f}, 25.0f};
    vtReferenceImage image = trace(&scene, (vtReferenceDef){.frame = &frame});
    int both = 0, close = 0;
    for (int i = 0; i < 96 * 96; ++i) {
        vtVec3 origin = frame.view.eye, direction = eyeDirection(&frame, i);
        if (passBall(centers[0], iors[0], &origin, &direction) &&
            passBall(centers[1], iors[1], &origin, &direction)) {
            ++both;
            close += image.events[i] == 4 && image.states[i] == VT_PATH_EXITED &&
                     degreesBetween(directionAt(&image, i), direction) < 0.3f;
        }
    }
    print_message("two spheres: %d pixels through both, %d within 0.3 degrees\n", both, close);
    assert_true(both > 1000);
    assert_true(close >= both - both / 200);
    vtDestroyReferenceImage(&image);
    vtDestroyScene(&scene);
}

/// The whole turn, towards the centre, of a ray that passes a unit sphere of index 1.5 with a sphere of half
/// that radius in its middle, by the ray's distance from the centre: index times radius times the sine of the
/// angle to the normal stays the same all the way.
static float turnOfNested(float distance, float innerIor)
{
    const float outer = 2.0f * (asinf(distance) - asinf(distance / 1.5f));
    if (distance >= 0.75f) {
        return outer;
    }
    const float incidence = asinf(distance / 0.75f), sine = distance / (0.5f * innerIor);
    return sine < 1.0f ? outer + 2.0f * (incidence - asinf(sine)) : outer - (VT_PI - 2.0f * incidence);
}

static void compareNested(float innerIor, int reflecting)
{
    vtScene scene = {0};
    addObject(&scene, createFineSphere(), glassOf(1.5f), vtIdentityTransform());
    addObject(&scene, createFineSphere(), glassOf(innerIor), place((vtVec3){0.0f, 0.0f, 0.0f}, 0.5f));
    vtFrame frame = makeSceneFrame(96);
    frame.view = (vtView){{1.0f, 2.0f, 4.0f}, {0.0f, 0.0f, 0.0f}, 30.0f};
    vtReferenceImage image = trace(&scene, (vtReferenceDef){.frame = &frame});
    int compared = 0, close = 0, reflections = 0;
    for (int i = 0; i < 96 * 96; ++i) {
        const vtVec3 direction = eyeDirection(&frame, i);
        const vtVec3 closest = vtMulAdd(frame.view.eye, -vtDot(frame.view.eye, direction), direction);
        const float distance = vtLength(closest);
        // Near the rims, and where total reflection begins, facets matter.
        if (distance < 0.95f && fabsf(distance - 0.75f) > 0.02f && fabsf(distance - 0.5f) > 0.02f) {
            const float turn = turnOfNested(distance, innerIor);
            const vtVec3 exit = vtMulAdd(vtScale(direction, cosf(turn)), -sinf(turn), vtNormalize(closest));
            ++compared;
            reflections += image.reflections[i];
            close += image.states[i] == VT_PATH_EXITED &&
                     degreesBetween(directionAt(&image, i), exit) < 0.5f &&
                     image.events[i] == (distance > 0.75f       ? 2
                                         : image.reflections[i] ? 3
                                                                : 4);
        }
    }
    print_message("index %.1f in 1.5: %d of %d within 0.5 degrees, %d reflected\n", (double)innerIor, close,
                  compared, reflections);
    assert_true(compared > 2000);
    assert_true(close >= compared - compared / 200);
    assert_true(reflecting ? reflections > 300 : reflections == 0);
    vtDestroyReferenceImage(&image);
    vtDestroyScene(&scene);
}

static void nestedSpheresFollowTheClosedForm(void** state)
{
    (void)state;
    compareNested(2.0f, false);
    compareNested(1.0f, true); // a bubble
}

/// Torus, sphere within box, instances and a lamp that overlap and touch, in an order of the caller's.
static vtScene makeMixture(const int* order)
{
    vtMaterial green = glassOf(1.6f);
    green.attenuationColor = (vtVec3){0.3f, 0.9f, 0.4f};
    green.attenuationDistance = 0.5f;
    vtScene scene = {0};
    for (int i = 0; i < 5; ++i) {
        switch (order[i]) {
        case 0:
            addObject(&scene, createShape("torus"), green, place((vtVec3){0.2f, 0, 0}, 0.9f));
            break;
        case 1:
            addObject(&scene, createShape("sphere"), glassOf(1.0f), place((vtVec3){0, 0, -2}, 0.4f));
            break;
        case 2:
            addObject(&scene, createBox((vtVec3){-1, -1, -3}, (vtVec3){1, 1, -1}), glassOf(1.5f),
                      vtIdentityTransform());
            break;
        case 3:
            addObject(&scene, createBox((vtVec3){-1, -1, -5}, (vtVec3){1, 1, -3}), glassOf(1.8f),
                      vtIdentityTransform());
            break;
        default:
            addObject(&scene, createBox((vtVec3){-4, -2, -6}, (vtVec3){4, -1, 2}),
                      lamp((vtVec3){0.5f, 0.2f, 0.1f}), vtIdentityTransform());
            break;
        }
    }
    return scene;
}

static void orderOfObjectsDoesNotMatter(void** state)
{
    (void)state;
    static const int orders[3][5] = {{0, 1, 2, 3, 4}, {4, 3, 2, 1, 0}, {2, 4, 1, 0, 3}};
    vtEnvironment environment;
    vtError error;
    assert_ok(vtCreateEnvironment("studio", &environment, &error), error);
    vtFrame frame = makeSceneFrame(64);
    frame.view = (vtView){{2.0f, 1.5f, 4.0f}, {0.0f, 0.0f, -1.5f}, 50.0f};
    vtReferenceImage images[3];
    int counts[4] = {0};
    for (int i = 0; i < 3; ++i) {
        vtScene scene = makeMixture(orders[i]);
        images[i] = trace(
            &scene,
            (vtReferenceDef){.frame = &frame, .environment = &environment, .samples = 2, .fresnel = true});
        assert_memory_equal(images[i].directions, images[0].directions, 3 * sizeof(float) * 64 * 64);
        assert_memory_equal(images[i].radiance, images[0].radiance, 3 * sizeof(float) * 64 * 64);
        assert_memory_equal(images[i].events, images[0].events, 64 * 64);
        assert_memory_equal(images[i].states, images[0].states, 64 * 64);
        assert_memory_equal(images[i].reflections, images[0].reflections, 64 * 64);
        vtDestroyScene(&scene);
    }
    for (int i = 0; i < 64 * 64; ++i) {
        ++counts[images[0].states[i]];
    }
    print_message("mixture: %d background, %d exited, %d lost, %d opaque\n", counts[VT_PATH_BACKGROUND],
                  counts[VT_PATH_EXITED], counts[VT_PATH_LOST], counts[VT_PATH_OPAQUE]);
    assert_true(counts[VT_PATH_EXITED] > 200 && counts[VT_PATH_OPAQUE] > 200);
    for (int i = 0; i < 3; ++i) {
        vtDestroyReferenceImage(&images[i]);
    }
    vtDestroyEnvironment(&environment);
}

static void touchingBoxesAreOneBox(void** state)
{
    (void)state;
    vtScene two = {0}, one = {0};
    addObject(&two, createBox((vtVec3){-1, -1, -1}, (vtVec3){0.3f, 1, 1}), glassOf(1.5f),
              vtIdentityTransform());
    addObject(&two, createBox((vtVec3){0.3f, -1, -1}, (vtVec3){1.5f, 1, 1}), glassOf(1.5f),
              vtIdentityTransform());
    addObject(&one, createBox((vtVec3){-1, -1, -1}, (vtVec3){1.5f, 1, 1}), glassOf(1.5f),
              vtIdentityTransform());
    vtFrame frame = makeSceneFrame(100);
    frame.view = (vtView){{3.0f, 2.0f, 4.0f}, {0.1f, 0.0f, 0.0f}, 40.0f};
    vtReferenceImage first = trace(&two, (vtReferenceDef){.frame = &frame});
    vtReferenceImage second = trace(&one, (vtReferenceDef){.frame = &frame});
    const int differences = countDifferences(&first, &second, 0.01f);
    print_message("touching boxes: %d pixels differ\n", differences);
    assert_true(differences <= 5); // at the box's edges
    vtDestroyReferenceImage(&first);
    vtDestroyReferenceImage(&second);
    vtDestroyScene(&two);
    vtDestroyScene(&one);
}

/// Three plates, one on the other, turn a ray back to where it came from: four events and no gap of air, in
/// which those of index 2.4 would reflect everything.
static void plateOnPlateLeavesTheDirection(void** state)
{
    (void)state;
    const float iors[3] = {1.5f, 2.4f, 1.3f};
    vtScene scene = {0};
    for (int i = 0; i < 3; ++i) {
        const float low = -0.37f * (float)i, high = -0.37f * (float)(i - 1);
        addObject(&scene, createBox((vtVec3){-20, -20, low}, (vtVec3){20, 20, high}), glassOf(iors[i]),
                  vtIdentityTransform());
    }
    vtFrame frame = makeSceneFrame(64);
    frame.view = (vtView){{3.0f, 2.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 60.0f};
    vtReferenceImage image = trace(&scene, (vtReferenceDef){.frame = &frame});
    int pixels = 0;
    for (int i = 0; i < 64 * 64; ++i) {
        const vtVec3 direction = eyeDirection(&frame, i);
        if (direction.z < -0.3f) {
            ++pixels;
            assert_int_equal(image.events[i], 4);
            assert_int_equal(image.states[i], VT_PATH_EXITED);
            assert_true(degreesBetween(directionAt(&image, i), direction) < 0.01f);
        }
    }
    assert_true(pixels > 2000);
    vtDestroyReferenceImage(&image);
    vtDestroyScene(&scene);
}

/// The mesh where the transform puts it.
static vtMesh bake(const vtMesh* mesh, const vtTransform* t)
{
    vtError error;
    vtScene scene = {0};
    vtPlacedObject* placed;
    uint32_t glassCount;
    const vtMeshDef copy = {.positions = mesh->positions,
                            .normals = mesh->normals,
                            .indices = mesh->indices,
                            .vertexCount = mesh->vertexCount,
                            .indexCount = mesh->indexCount};
    vtMesh baked;
    assert_ok(vtCreateMesh(&copy, "copy", &baked, &error), error);
    addObject(&scene, baked, vtDefaultMaterial(), *t);
    assert_ok(vtPlaceObjects(&scene, &placed, &glassCount, &error), error);
    vtMesh* m = &scene.meshes[0];
    for (size_t i = 0; i < 3 * (size_t)m->vertexCount; i += 3) {
        const vtVec3 p = vtTransformPoint(t, vtMakeVec3(m->positions + i));
        const vtVec3 n = vtTransformNormal(&placed[0].toObject, vtMakeVec3(m->normals + i));
        memcpy(m->positions + i, &p, sizeof p);
        memcpy(m->normals + i, &n, sizeof n);
    }
    for (uint32_t i = 0; placed[0].mirrored && i < m->indexCount; i += 3) {
        const uint32_t second = m->indices[i + 1];
        m->indices[i + 1] = m->indices[i + 2];
        m->indices[i + 2] = second;
    }
    const vtMeshDef def = {.positions = m->positions,
                           .normals = m->normals,
                           .indices = m->indices,
                           .vertexCount = m->vertexCount,
                           .indexCount = m->indexCount};
    assert_ok(vtCreateMesh(&def, "baked", &baked, &error), error);
    free(placed);
    vtDestroyScene(&scene);
    return baked;
}

static void instancesAreAsTheirMeshesBaked(void** state)
{
    (void)state;
    // Where axes are scaled differently, normals interpolated after that are not quite those interpolated
    // before.
    static const struct {
        vtTransform transform;
        float degrees;
    } entries[] = {
        {{{{0.6f, -0.8f, 0, 0.3f}, {0.8f, 0.6f, 0, -0.2f}, {0, 0, 1, 0.1f}}}, 0.1f},     // rotated
        {{{{40, 0, 0, 10}, {0, 40, 0, -7}, {0, 0, 40, 3}}}, 0.1f},                       // scaled
        {{{{-1, 0, 0, 0.5f}, {0, 1, 0, 0}, {0, 0, 1, 0}}}, 0.1f},                        // mirrored
        {{{{0.02f, 0.005f, 0, 0}, {0, -0.015f, 0.005f, 0.1f}, {0, 0, 0.02f, 0}}}, 2.0f}, // and sheared
    };
    vtMesh torus = createShape("torus");
    for (size_t i = 0; i < sizeof entries / sizeof entries[0]; ++i) {
        vtScene instance = {0};
        vtScene baked = makeScene(bake(&torus, &entries[i].transform));
        addObject(&instance, createShape("torus"), glassOf(1.5f), entries[i].transform);
        vtFrame frame = makeSceneFrame(96);
        frame.maxEvents = 8; // rounding decides where paths of twenty go
        frame.view = vtViewOfMesh(&baked.meshes[0], 45.0f, 1.0f);
        vtReferenceImage first = trace(&instance, (vtReferenceDef){.frame = &frame});
        vtReferenceImage second = trace(&baked, (vtReferenceDef){.frame = &frame});
        const int differences = countDifferences(&first, &second, entries[i].degrees);
        print_message("transform %zu: %d of %d pixels differ\n", i, differences, 96 * 96);
        assert_true(differences <= 96 * 96 / (i < 3 ? 1000 : 100));
        vtDestroyReferenceImage(&first);
        vtDestroyReferenceImage(&second);
        vtDestroyScene(&instance);
        vtDestroyScene(&baked);
    }
    vtDestroyMesh(&torus);
}

static void glassAbsorbsByTheWayThroughIt(void** state)
{
    (void)state;
    float white[3 * texelCount];
    for (int i = 0; i < 3 * texelCount; ++i) {
        white[i] = 1.0f;
    }
    const vtEnvironment environment = makeEnvironment(white);
    vtMaterial material = glassOf(1.5f);
    material.attenuationColor = (vtVec3){0.2f, 0.5f, 0.9f};
    material.attenuationDistance = 0.8f;
    material.tint = (vtVec3){1.0f, 0.5f, 1.0f}; // of each of two surfaces
    vtScene scene = {0};
    // A bubble of 0.4 in it absorbs nothing; an instance twice as thick absorbs by the world's unit.
    addObject(&scene, createPlate(), material, place((vtVec3){0.0f, 0.0f, 0.0f}, 2.0f));
    addObject(&scene, createBox((vtVec3){-5, -5, -0.2f}, (vtVec3){5, 5, 0.2f}), glassOf(1.0f),
              vtIdentityTransform());
    vtFrame frame = facePlate();
    frame.ior = 0.0f;
    vtReferenceImage image = trace(&scene, (vtReferenceDef){.frame = &frame, .environment = &environment});
    const float expected[3] = {powf(0.2f, 2.0f), powf(0.5f, 2.0f) * 0.25f, powf(0.9f, 2.0f)};
    for (int i = 0; i < 3 * 8 * 8; ++i) {
        assert_int_equal(image.events[i / 3], 4);
        assert_near(image.radiance[i], expected[i % 3], 1e-3f);
    }
    vtDestroyReferenceImage(&image);
    vtDestroyScene(&scene);
}

/// Of a plate before a lamp, a lamp before a plate, and one upon the other.
static void opaqueEndsPaths(void** state)
{
    (void)state;
    float black[3 * texelCount] = {0};
    const vtEnvironment environment = makeEnvironment(black);
    vtMaterial material = glassOf(1.5f);
    material.tint = (vtVec3){0.5f, 0.6f, 0.7f};
    const float gaps[3] = {-2.0f, 2.0f, 0.0f}; // the lamp is one thick, too
    for (int i = 0; i < 3; ++i) {
        vtScene scene = {0};
        const float z = gaps[i] + (gaps[i] > 0.0f ? 0.5f : -0.5f);
        addObject(&scene, createBox((vtVec3){-9, -9, z - 0.5f}, (vtVec3){9, 9, z + (i == 2 ? 0.0f : 0.5f)}),
                  lamp((vtVec3){0.1f, 0.5f, 0.8f}), vtIdentityTransform());
        addObject(&scene, createPlate(), material, vtIdentityTransform());
        vtFrame frame = facePlate();
        frame.ior = 0.0f;
        frame.view.eye.z = 6.0f;
        vtReferenceImage image =
            trace(&scene, (vtReferenceDef){.frame = &frame, .environment = &environment});
        for (int k = 0; k < 8 * 8; ++k) {
            const bool hidden = i == 1;
            assert_int_equal(image.states[k], VT_PATH_OPAQUE);
            assert_int_equal(image.events[k], hidden ? 0 : 2);
            if (hidden) {
                assert_true(vtLength(directionAt(&image, k)) == 0.0f);
            } else {
                assert_true(degreesBetween(directionAt(&image, k), eyeDirection(&frame, k)) < 0.01f);
            }
            assert_near(image.radiance[3 * k], 0.1f * (hidden ? 1.0f : 0.25f), 1e-4f);
            assert_near(image.radiance[3 * k + 1], 0.5f * (hidden ? 1.0f : 0.36f), 1e-4f);
            assert_near(image.radiance[3 * k + 2], 0.8f * (hidden ? 1.0f : 0.49f), 1e-4f);
        }
        vtDestroyReferenceImage(&image);
        vtDestroyScene(&scene);
    }
}

/// A box of glass that stands on a floor, seen from above at a slant: each path ends on the floor, below the
/// glass or beside it, but for those that totally reflect at the sides and leave upwards.
static void glassStandsOnTheFloor(void** state)
{
    (void)state;
    vtScene scene = {0};
    addObject(&scene, createBox((vtVec3){-50, -1, -50}, (vtVec3){50, 0.1f, 50}), lamp((vtVec3){1, 1, 1}),
              vtIdentityTransform());
    addObject(&scene, createBox((vtVec3){-1, 0.1f, -1}, (vtVec3){1, 1.3f, 1}), glassOf(1.5f),
              vtIdentityTransform());
    vtFrame frame = makeSceneFrame(96);
    frame.view = (vtView){{0.9f, 8.0f, 0.8f}, {0.0f, 0.5f, 0.0f}, 20.0f};
    vtReferenceImage image = trace(&scene, (vtReferenceDef){.frame = &frame});
    int through = 0, others = 0;
    for (int i = 0; i < 96 * 96; ++i) {
        through += image.states[i] == VT_PATH_OPAQUE && image.events[i] > 0;
        others += image.states[i] != VT_PATH_OPAQUE;
        if (image.states[i] == VT_PATH_OPAQUE && image.events[i] > 0) {
            assert_true(image.events[i] >= 2); // in and out: there is air between glass and floor, if no gap
        }
    }
    print_message("on the floor: %d pixels see it through the glass, %d do not\n", through, others);
    assert_true(through > 1500);
    assert_true(others < through / 20);
    vtDestroyReferenceImage(&image);
    vtDestroyScene(&scene);
}

static void eyeMayLieInGlassInGlass(void** state)
{
    (void)state;
    vtScene scene = {0};
    addObject(&scene, createFineSphere(), glassOf(1.5f), place((vtVec3){0.0f, 0.0f, 0.0f}, 2.0f));
    addObject(&scene, createFineSphere(), glassOf(2.0f), vtIdentityTransform());
    vtFrame frame = makeSceneFrame(32);
    frame.view = (vtView){{0.0f, 0.0f, 0.0f}, {0.3f, 0.1f, -1.0f}, 60.0f};
    vtReferenceImage image = trace(&scene, (vtReferenceDef){.frame = &frame});
    for (int i = 0; i < 32 * 32; ++i) {
        assert_int_equal(image.states[i], VT_PATH_EXITED);
        assert_int_equal(image.events[i], 2);
        assert_true(degreesBetween(directionAt(&image, i), eyeDirection(&frame, i)) < 0.1f);
    }
    vtDestroyReferenceImage(&image);
    vtDestroyScene(&scene);
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
        cmocka_unit_test(lightPassesTwoSpheres),
        cmocka_unit_test(nestedSpheresFollowTheClosedForm),
        cmocka_unit_test(orderOfObjectsDoesNotMatter),
        cmocka_unit_test(touchingBoxesAreOneBox),
        cmocka_unit_test(plateOnPlateLeavesTheDirection),
        cmocka_unit_test(instancesAreAsTheirMeshesBaked),
        cmocka_unit_test(glassAbsorbsByTheWayThroughIt),
        cmocka_unit_test(opaqueEndsPaths),
        cmocka_unit_test(glassStandsOnTheFloor),
        cmocka_unit_test(eyeMayLieInGlassInGlass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
