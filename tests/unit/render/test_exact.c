// Technique `exact`: its paths against the reference tracer's, of all kinds of meshes and scenes.
#include <math.h>

#include "base/math.h"
#include "image/image.h"
#include "lab/metrics/metrics.h"
#include "rendering.h"

enum { mostThings = 4 };

/// An object: a built-in shape; `ior` 0: opaque; `mirrored`: its x turned round.
typedef struct Thing {
    const char* shape;
    float scale, x, y, z, ior;
    bool mirrored;
} Thing;

static vtScene makeScene(const Thing* things, uint32_t count)
{
    vtScene scene = {.meshes = calloc(count, sizeof(vtMesh)),
                     .materials = calloc(count, sizeof(vtMaterial)),
                     .objects = calloc(count, sizeof(vtObject)),
                     .meshCount = count,
                     .materialCount = count,
                     .objectCount = count};
    vtError error;
    for (uint32_t i = 0; i < count; ++i) {
        const Thing* thing = &things[i];
        assert_ok(vtCreateShape(thing->shape, &scene.meshes[i], &error), error);
        scene.materials[i] = vtDefaultMaterial();
        scene.materials[i].opaque = thing->ior == 0.0f;
        scene.materials[i].ior = thing->ior == 0.0f ? 1.5f : thing->ior;
        const float s = thing->scale, x = thing->mirrored ? -s : s;
        scene.objects[i] = (vtObject){
            .mesh = i,
            .material = i,
            .toWorld = {{{x, 0, 0, thing->x}, {0, s, 0, thing->y}, {0, 0, s, thing->z}}},
        };
    }
    return scene;
}

/// Share of the pixels, of those whose true path meets something and has at most four events, where the path
/// drawn last has the same end: left the glass within a degree, is on something opaque, or lost within open
/// glass.
static double agreementWith(Fixture* fixture, const vtReferenceImage* truth, const char* name)
{
    static uint32_t states[side * side];
    vtError error;
    assert_ok(vtRenderer_ReadStates(fixture->renderer, states, &error), error);
    int compared = 0, agreeing = 0;
    for (int i = 0; i < truth->width * truth->height; ++i) {
        const uint8_t state = truth->states[i];
        if (truth->events[i] > 4 || state == VT_PATH_BACKGROUND) {
            continue;
        }
        ++compared;
        // Paths that are lost, or go straight to something opaque, have no direction in the reference.
        const bool same = (states[i] & 255u) == state;
        const float* direction = fixture->directions + 3 * (size_t)i;
        agreeing += same && (truth->events[i] == 0 || state == VT_PATH_LOST ||
                             vtDirectionAngle(direction, truth->directions + 3 * (size_t)i) < 1.0f);
    }
    print_message("  %s: %d of %d within 1 degree, %.2f %%\n", name, agreeing, compared,
                  100.0 * agreeing / (compared > 0 ? compared : 1));
    assert_true(compared > truth->width * truth->height / 40);
    return (double)agreeing / compared;
}

/// Draws the scene and traces it. 1 without Embree.
static double agreement(Fixture* fixture, const vtScene* scene, const vtFrame* frame, const char* name)
{
    vtReferenceImage truth;
    vtError error;
    assert_ok(vtRenderer_SetScene(fixture->renderer, scene, &error), error);
    draw(fixture, frame);
    if (!canTrace(scene, frame, &truth)) {
        return 1.0;
    }
    const double share = agreementWith(fixture, &truth, name);
    vtDestroyReferenceImage(&truth);
    return share;
}

static vtFrame frameFrom(float x, float y, float z)
{
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.view = (vtView){.eye = {x, y, z}, .target = {0.0f, 0.0f, 0.0f}, .fovY = 30.0f};
    frame.ior = 0.0f; // each object's own
    return frame;
}

static void shapesAgree(void** state)
{
    for (int shape = 0; vtShapeName(shape) != NULL; ++shape) {
        vtScene scene = makeScene(&(Thing){vtShapeName(shape), 1, 0, 0, 0, 1.5f, false}, 1);
        vtFrame frame = frameFrom(0, 0, 1);
        frame.view = vtView_Orbit(vtViewOfMesh(&scene.meshes[0], 45.0f, 1.0f), 0.9f, 0.2f);
        assert_true(agreement(*state, &scene, &frame, vtShapeName(shape)) >= 0.995);
        vtDestroyScene(&scene);
    }
}

static void scenesAgree(void** state)
{
    static const struct {
        const char* name;
        double least;
        Thing things[mostThings];
        float eye[3];
    } scenes[] = {
        {"apart",
         0.995,
         {{"sphere", 0.8f, -0.5f, 0, 1, 1.5f, false}, {"knot", 0.8f, 0.4f, 0, -1, 1.4f, false}},
         {0.4f, 0.5f, 6}},
        {"nested",
         0.995,
         {{"sphere", 1, 0, 0, 0, 1.5f, false}, {"cube", 0.4f, 0, 0, 0, 1.2f, false}},
         {0.4f, 0.5f, 6}},
        {"touching",
         0.995,
         {{"cube", 1, -0.6f, 0, 0, 1.5f, false}, {"cube", 1, 0.6f, 0, 0, 1.7f, false}},
         {5, 0.7f, 0.8f}},
        {"overlapping",
         0.995,
         {{"sphere", 0.8f, -0.4f, 0, 0, 1.5f, false}, {"sphere", 0.7f, 0.4f, 0, 0, 1.3f, false}},
         {0.4f, 0.5f, 6}},
        {"water",
         0.995,
         {{"tumbler", 1, 0, 0, 0, 1.5f, false},
          {"water", 1, 0, 0, 0, 1.33f, false},
          {"plane", 2, 0, 0, -2, 0, false}},
         {0.4f, 1, 6}},
        {"mirrored",
         0.995,
         {{"knot", 1, 0, 0, 0, 1.5f, true}, {"goblet", 0.5f, 0.5f, 0, 1.5f, 1.5f, true}},
         {0.4f, 0.5f, 6}},
        {"opaque inside",
         0.995,
         {{"sphere", 1, 0, 0, 0, 1.5f, false}, {"knot", 0.4f, 0, 0, 0, 0, true}},
         {0.4f, 0.5f, 6}},
        {"opaque close",
         0.995,
         {{"cube", 1, 0, 0, 0, 1.5f, false}, {"plane", 0.4f, 0, 0, -0.61f, 0, false}},
         {0.9f, 0.5f, 6}},
        {"opaque coincident, behind",
         0.995,
         {{"cube", 1, 0, 0, 0, 1.5f, false}, {"plane", 0.4f, 0, 0, -0.6f, 0, false}},
         {0.9f, 0.5f, 6}},
        {"opaque coincident, before",
         0.995,
         {{"cube", 1, 0, 0, 0, 1.5f, false}, {"plane", 0.4f, 0, 0, 0.6f, 0, false}},
         {0.9f, 0.5f, 6}},
        {"opaque, from its back",
         0.995,
         {{"sphere", 1, 0, 0, -2, 1.5f, false}, {"plane", 0.5f, 0.3f, 0, 0, 0, false}},
         {-0.9f, 0.5f, -7}},
        {"on a wide floor",
         0.995,
         {{"sphere", 0.2f, 0, 0, 0.2f, 1.5f, false}, {"plane", 1000, 0, 0, 0, 0, false}},
         {0.3f, -0.6f, 0.9f}},
        {"an open sheet",
         0.995,
         {{"plane", 1, 0, 0, 0, 1.5f, false}, {"sphere", 0.5f, 0, 0, -2, 0, false}},
         {1.9f, 0.5f, 6}},
        {"the eye in glass",
         0.995,
         {{"sphere", 2, 0, 0, 0, 1.5f, false}, {"torus", 0.5f, 0, 0, 0, 1.2f, false}},
         {0.3f, 0.5f, 1.5f}},
        {"the eye in two glasses",
         0.995,
         {{"sphere", 2, 0, 0, 0, 1.5f, false}, {"sphere", 1.8f, 0, 0, 0, 1.2f, false}},
         {0.3f, 0.5f, 1.5f}},
        {"the eye in coloured glass, opaque before it",
         0.995,
         {{"sphere", 2, 0, 0, 0, 1.5f, false},
          {"knot", 0.4f, 0, 0, 0, 0, false},
          {"cube", 0.1f, 0.2f, 0.3f, 0.8f, 2.0f, false}},
         {0.3f, 0.5f, 1.5f}},
        {"within an opaque ball",
         0.995,
         {{"sphere", 3, 0, 0, 0, 0, false}, {"knot", 0.7f, 0, 0, 0, 1.5f, false}},
         {0.4f, 0.5f, 2.5f}},
        {"only opaque",
         0.995,
         {{"knot", 1, 0, 0, 0, 0, false}, {"sphere", 0.5f, 0.5f, 0.5f, 0, 0, true}},
         {0.4f, 0.5f, 6}},
    };
    bool all = true;
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; ++i) {
        uint32_t count = 0;
        while (count < mostThings && scenes[i].things[count].shape != NULL) {
            ++count;
        }
        vtScene scene = makeScene(scenes[i].things, count);
        const vtFrame frame = frameFrom(scenes[i].eye[0], scenes[i].eye[1], scenes[i].eye[2]);
        all = agreement(*state, &scene, &frame, scenes[i].name) >= scenes[i].least && all;
        vtDestroyScene(&scene);
    }
    assert_true(all);
}

/// Positions times `scale`, moved along x.
static void moveMesh(vtMesh* mesh, float scale, float x)
{
    for (uint32_t i = 0; i < 3 * mesh->vertexCount; ++i) {
        mesh->positions[i] = mesh->positions[i] * scale + (i % 3 == 0 ? x : 0.0f);
    }
    float* ends[2] = {&mesh->boundsMin.x, &mesh->boundsMax.x};
    for (int i = 0; i < 6; ++i) {
        float* end = ends[i / 3] + i % 3;
        *end = *end * scale + (i % 3 == 0 ? x : 0.0f);
    }
}

// A mesh far from the origin, or of another size, is drawn as in its middle, in its own: what the reference,
// which works in the world's floats, is right about.
static void placeAndSizeDoNotMatter(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtReferenceImage truth;
    vtScene scene = makeScene(&(Thing){"knot", 1, 0, 0, 0, 1.5f, false}, 1);
    vtMesh* mesh = &scene.meshes[0];
    for (uint32_t i = 0; i < 3 * mesh->vertexCount; ++i) { // as a mesh at 1e5 is stored: steps of 2^-7
        mesh->positions[i] = roundf(mesh->positions[i] * 128.0f) / 128.0f;
    }
    const vtFrame frame = frameFrom(0.5f, 0.5f, 4.0f);
    traceScene(&scene, &frame, &truth);
    const float far = 100000.0f;
    for (int i = 0; i < 4; ++i) {
        static const char* const names[] = {"mesh at 1e5", "object at 1e5", "1e-6", "1e6"};
        vtFrame moved = frame;
        const float scale = i < 2 ? 1.0f : i == 2 ? 1e-6f : 1e6f;
        if (i == 0) {
            moveMesh(mesh, 1.0f, far);
        } else if (i > 1) {
            moveMesh(mesh, scale, 0.0f);
        }
        scene.objects[0].toWorld.rows[0][3] = i == 1 ? far : 0.0f;
        moved.view.eye = vtScale(frame.view.eye, scale);
        moved.view.eye.x += i < 2 ? far : 0.0f;
        moved.view.target.x += i < 2 ? far : 0.0f;
        assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
        draw(fixture, &moved);
        assert_true(agreementWith(fixture, &truth, names[i]) >= 0.995);
        if (i == 0) {
            moveMesh(mesh, 1.0f, -far);
        } else if (i > 1) {
            moveMesh(mesh, 1.0f / scale, 0.0f);
        }
    }
    vtDestroyReferenceImage(&truth);
    vtDestroyScene(&scene);
}

// Sheets, slivers, one triangle, two on one edge twice over: as the tracer has them.
static void strangeMeshesAgree(void** state)
{
    static const float positions[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 0, 0, 0, 1};
    static const uint32_t one[] = {0, 1, 2};
    static const uint32_t sheet[] = {0, 1, 2, 0, 2, 3};
    static const uint32_t slivers[] = {0, 1, 2, 0, 4, 2, 0, 2, 2, 1, 1, 1, 4, 4, 4};
    static const uint32_t fan[] = {0, 2, 5, 0, 2, 1, 0, 2, 3, 2, 0, 5};
    static const struct {
        const char* name;
        const uint32_t* indices;
        uint32_t count;
        bool opaque;
    } cases[] = {{"one triangle", one, 3, false}, {"one triangle, opaque", one, 3, true},
                 {"sheet", sheet, 6, false},      {"sheet, opaque", sheet, 6, true},
                 {"slivers", slivers, 15, false}, {"slivers, opaque", slivers, 15, true},
                 {"fan, opaque", fan, 12, true}};
    for (size_t i = 0; i < 2 * sizeof cases / sizeof cases[0]; ++i) { // from its front, from its back
        vtMesh mesh;
        vtScene scene;
        vtError error;
        const vtMeshDef def = {.positions = positions,
                               .vertexCount = 6,
                               .indices = cases[i / 2].indices,
                               .indexCount = cases[i / 2].count};
        vtMaterial material = vtDefaultMaterial();
        material.opaque = cases[i / 2].opaque;
        assert_ok(vtCreateMesh(&def, "strange", &mesh, &error), error);
        assert_ok(vtCreateMeshScene(&mesh, &material, &scene, &error), error);
        const vtFrame frame = frameFrom(0.9f, 0.7f, i % 2 == 0 ? 5.0f : -5.0f);
        assert_true(agreement(*state, &scene, &frame, cases[i / 2].name) >= 0.995);
        vtDestroyScene(&scene);
    }
}

// Triangles without area change nothing.
static void degenerateTrianglesAreNotSeen(void** state)
{
    Fixture* fixture = *state;
    static float before[sizeof fixture->directions / sizeof(float)];
    vtError error;
    vtScene scene = makeScene(&(Thing){"goblet", 1, 0, 0, 0, 1.5f, false}, 1);
    vtMesh* mesh = &scene.meshes[0];
    const vtFrame frame = frameFrom(0.5f, 0.5f, 5.0f);
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    draw(fixture, &frame);
    memcpy(before, fixture->directions, sizeof before);
    mesh->indices = realloc(mesh->indices, (mesh->indexCount + 300) * sizeof *mesh->indices);
    for (uint32_t i = 0; i < 300; ++i) {
        mesh->indices[mesh->indexCount + i] = i % 3 == 2 ? 7 + i / 3 : 40 + i / 3;
    }
    mesh->indexCount += 300;
    mesh->degenerateCount += 100;
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    draw(fixture, &frame);
    assert_memory_equal(before, fixture->directions, sizeof before);
    vtDestroyScene(&scene);
}

static void instancesShareOneHierarchy(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtScene scene = makeScene(&(Thing){"torus", 0.05f, 0, 0, 0, 1.5f, false}, 1);
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    const size_t bytes = vtRenderer_Info(fixture->renderer).meshBytes;
    const vtObject first = scene.objects[0];
    scene.objectCount = 1000;
    scene.objects = realloc(scene.objects, scene.objectCount * sizeof *scene.objects);
    for (uint32_t i = 0; i < scene.objectCount; ++i) {
        const uint32_t steps[3] = {i % 10, i / 10 % 10, i / 100};
        scene.objects[i] = first;
        for (int k = 0; k < 3; ++k) {
            scene.objects[i].toWorld.rows[k][3] =
                0.18f * ((float)steps[k] - 4.5f) + 0.004f * (float)(i * 7 % 10);
        }
    }
    const vtFrame frame = frameFrom(0.5f, 0.4f, 5.0f);
    assert_true(agreement(fixture, &scene, &frame, "1000 instances") >= 0.995);
    assert_int_equal(vtRenderer_Info(fixture->renderer).meshBytes, bytes);
    vtDestroyScene(&scene);
}

/// Mean difference, of 255, between the scene's picture and that of the reference with the same samples.
/// Below 0: there is no reference.
static double differenceOf(Fixture* fixture, const vtScene* scene, const vtFrame* frame, const char* name)
{
    vtError error;
    vtEnvironment environment;
    vtReference* reference;
    vtReferenceImage truth;
    if (vtCreateReference(scene, &reference, &error) != vt_ok) {
        return -1.0;
    }
    setEnvironment(fixture->renderer, name);
    assert_ok(vtRenderer_SetScene(fixture->renderer, scene, &error), error);
    draw(fixture, frame);
    assert_ok(vtCreateEnvironment(name, &environment, &error), error);
    const vtReferenceDef def = {.frame = frame,
                                .environment = &environment,
                                .samples = frame->samples,
                                .fresnel = true,
                                .onlyPicture = true};
    assert_ok(vtReference_Trace(reference, &def, &truth, &error), error);
    uint8_t* rgba = malloc(4 * (size_t)(frame->width * frame->height));
    vtReference_ToSrgb(&truth, rgba);
    double sum = 0.0;
    for (int i = 0; i < 4 * frame->width * frame->height; ++i) {
        sum += abs(rgba[i] - fixture->pixels[i]);
    }
    const double mean = sum / (3 * frame->width * frame->height);
    print_message("  mean difference %.3f of 255\n", mean);
    free(rgba);
    vtDestroyReferenceImage(&truth);
    vtDestroyReference(reference);
    vtDestroyEnvironment(&environment);
    return mean;
}

// Pictures with Fresnel reflection, several samples: what is followed, is as bright as in the reference.
static void picturesAgree(void** state)
{
    Fixture* fixture = *state;
    static const Thing things[3] = {{"goblet", 1, 0, 0, 0, 1.5f, false},
                                    {"sphere", 0.3f, 0, 0, 1.2f, 1.3f, false},
                                    {"plane", 1.5f, 0, 0, -1.2f, 0, false}};
    vtScene scene = makeScene(things, 3);
    vtFrame frame = frameFrom(0.5f, 0.5f, 6.0f);
    frame.fresnel = true;
    frame.samples = 16;
    frame.preset = vt_presetHigh;
    const double mean = differenceOf(fixture, &scene, &frame, "studio");
    vtDestroyScene(&scene);
    if (mean < 0.0) {
        skip();
    }
    assert_true(mean <= 1.0);
}

// With many samples the preset's branches are no limit: nothing but noise is left between still pictures and
// the reference's whole tree of reflections.
static void stillPicturesConverge(void** state)
{
    Fixture* fixture = *state;
    static const Thing things[2] = {{"sphere", 1, 0, 0, 0, 1.5f, false},
                                    {"sphere", 0.6f, 0, 0, 0, 1.2f, false}};
    vtScene scene = makeScene(things, 2);
    vtFrame frame = frameFrom(0.5f, 0.5f, 4.0f);
    frame.width = frame.height = 48;
    frame.fresnel = true;
    frame.samples = 128;
    frame.maxEvents = 8;
    frame.preset = vt_presetLow;
    const double mean = differenceOf(fixture, &scene, &frame, "studio");
    vtDestroyScene(&scene);
    if (mean < 0.0) {
        skip();
    }
    assert_true(mean <= 1.2);
}

static void checkDirections(const Fixture* fixture, int count)
{
    for (int i = 0; i < count; ++i) {
        const float* d = fixture->directions + 3 * (size_t)i;
        const float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        assert_true(length == 0.0f || fabsf(length - 1.0f) < 1e-4f || fabsf(length - sqrtf(12.0f)) < 1e-4f);
    }
}

static void extremeSettingsAreDrawn(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "goblet");
    static const struct {
        int width, height, events;
        float ior;
    } cases[] = {
        {1, 1, 1, 1.5f}, {128, 1, 64, 4.0f}, {1, 128, 2, 1.0f}, {64, 64, 64, 2.4f}, {37, 91, 8, 1.1f}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        for (int fresnel = 0; fresnel < 2; ++fresnel) {
            vtFrame frame = smallFrame(vt_techniqueExact);
            frame.width = cases[i].width;
            frame.height = cases[i].height;
            frame.maxEvents = cases[i].events;
            frame.ior = cases[i].ior;
            frame.fresnel = fresnel == 1;
            frame.branches = fresnel == 1 ? VT_MAX_BRANCHES : 0;
            draw(fixture, &frame);
            checkDirections(fixture, frame.width * frame.height);
        }
    }
}

// What was drawn before does not matter.
static void picturesFollowTheMesh(void** state)
{
    Fixture* fixture = *state;
    static float first[sizeof fixture->directions / sizeof(float)];
    const vtFrame frame = smallFrame(vt_techniqueExact);
    setShape(fixture->renderer, "knot");
    draw(fixture, &frame);
    memcpy(first, fixture->directions, sizeof first);
    setShape(fixture->renderer, "torus");
    draw(fixture, &frame);
    assert_memory_not_equal(first, fixture->directions, sizeof first);
    setShape(fixture->renderer, "knot");
    draw(fixture, &frame);
    assert_memory_equal(first, fixture->directions, sizeof first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapesAgree),
        cmocka_unit_test(scenesAgree),
        cmocka_unit_test(placeAndSizeDoNotMatter),
        cmocka_unit_test(strangeMeshesAgree),
        cmocka_unit_test(degenerateTrianglesAreNotSeen),
        cmocka_unit_test(instancesShareOneHierarchy),
        cmocka_unit_test(picturesAgree),
        cmocka_unit_test(stillPicturesConverge),
        cmocka_unit_test(extremeSettingsAreDrawn),
        cmocka_unit_test(picturesFollowTheMesh),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
