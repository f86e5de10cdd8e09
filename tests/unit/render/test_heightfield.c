// Reliefs by their heights, in technique `heightfield` and in the reference: closed forms, the reference on
// triangles, scenes with other objects.
#include <math.h>

#include "base/math.h"
#include "lab/metrics/metrics.h"
#include "lab/reference/reference.h"
#include "mesh/height_field.h"
#include "rendering.h"

typedef float HeightFcn(float x, float y); // -1 to 1 each, of a square relief

static float flat(float x, float y)
{
    (void)x, (void)y;
    return 0.0f;
}

static float ramp(float x, float y)
{
    (void)y;
    return 0.5f * (x + 1.0f);
}

/// Radius of curvature 4 at its top where the depth is 1.
static float lens(float x, float y)
{
    return -(x * x + y * y) / 8.0f;
}

static float hills(float x, float y)
{
    return 0.5f + 0.3f * sinf(4.5f * x + 2.0f) * cosf(3.5f * y) + 0.1f * x * y;
}

static float spikes(float x, float y)
{
    return vtFract(437.585f * sinf(12.9898f * x + 78.233f * y));
}

static vtMesh makeRelief(HeightFcn* heightOf, int width, int height, float depth, float thickness)
{
    float* heights = malloc((size_t)width * (size_t)height * sizeof *heights);
    assert_non_null(heights);
    const float longer = (float)(width > height ? width - 1 : height - 1);
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const float x = (float)(2 * column - width + 1) / longer,
                        y = (float)(height - 1 - 2 * row) / longer;
            heights[row * width + column] = heightOf(x, y);
        }
    }
    vtReliefDef def = vtDefaultRelief();
    def.heights = heights;
    def.width = width;
    def.height = height;
    def.depth = depth;
    def.thickness = thickness;
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateRelief(&def, "relief", &mesh, &error), error);
    free(heights);
    return mesh;
}

/// Snell's law: behind a surface of normal N, against I.
static vtVec3 refractRay(vtVec3 I, vtVec3 N, float eta)
{
    const float c = -vtDot(N, I), k = 1.0f - eta * eta * (1.0f - c * c);
    assert_true(k > 0.0f);
    return vtMulAdd(vtScale(I, eta), eta * c - sqrtf(k), N);
}

static vtFrame frameAt(vtVec3 eye, vtVec3 target, float fovY)
{
    vtFrame frame = smallFrame(vt_techniqueHeightField);
    frame.view = (vtView){eye, target, fovY};
    return frame;
}

/// Directions by the technique, in the fixture, and by the reference on the same heights. Frees the mesh.
static void drawAndTrace(Fixture* fixture, vtMesh* mesh, const vtFrame* frame, vtReferenceImage* traced)
{
    vtError error;
    vtScene scene;
    const vtMaterial material = vtDefaultMaterial();
    assert_ok(vtCreateMeshScene(mesh, &material, &scene, &error), error);
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    draw(fixture, frame);
    traceScene(&scene, frame, traced);
    assert_int_equal(scene.meshes[0].indexCount, 0);
    vtDestroyScene(&scene);
}

/// Both are within some degrees of what a pixel's direction must be.
static void checkDirection(const Fixture* fixture, const vtReferenceImage* traced, int pixel, vtVec3 wanted,
                           float degrees)
{
    assert_true(degreesBetween(wanted, vtMakeVec3(fixture->directions + 3 * pixel)) < degrees);
    assert_true(degreesBetween(wanted, vtMakeVec3(traced->directions + 3 * pixel)) < degrees);
}

// Through two parallel faces light goes on as it came.
static void slabLeavesDirectionsAlone(void** state)
{
    Fixture* fixture = *state;
    vtMesh mesh = makeRelief(flat, 17, 33, 0.0f, 0.3f);
    const vtFrame frame = frameAt((vtVec3){0.2f, 0.1f, 2.0f}, (vtVec3){0.1f, 0.0f, 0.0f}, 15.0f);
    vtReferenceImage traced;
    drawAndTrace(fixture, &mesh, &frame, &traced);
    for (int i = 0; i < side * side; ++i) {
        checkDirection(fixture, &traced, i, eyeRay(&frame, i % side, i / side), 0.002f);
    }
    vtDestroyReferenceImage(&traced);
}

// A wedge: two plane surfaces.
static void rampIsAPrism(void** state)
{
    Fixture* fixture = *state;
    vtMesh mesh = makeRelief(ramp, 40, 40, 0.5f, 0.2f);
    const vtFrame frame = frameAt((vtVec3){-0.3f, 0.2f, 3.0f}, (vtVec3){0.0f, 0.0f, 0.0f}, 12.0f);
    vtReferenceImage traced;
    drawAndTrace(fixture, &mesh, &frame, &traced);
    const vtVec3 N = vtNormalize((vtVec3){-0.25f, 0.0f, 1.0f});
    for (int i = 0; i < side * side; ++i) {
        const vtVec3 inner = refractRay(eyeRay(&frame, i % side, i / side), N, 1.0f / 1.5f);
        const vtVec3 wanted = refractRay(inner, (vtVec3){0.0f, 0.0f, 1.0f}, 1.5f);
        checkDirection(fixture, &traced, i, wanted, 0.01f);
    }
    vtDestroyReferenceImage(&traced);
}

// A plano-convex paraboloid z = -r^2 / 2R seen along its axis from 100 before it: each ray leaves as the two
// surfaces' normals say, and those near the axis meet at the eye's image, 1 / ((n - 1) / R - 1 / 100) less
// the glass's thickness / n behind the back.
static void paraboloidFocuses(void** state)
{
    Fixture* fixture = *state;
    const float R = 4.0f, n = 1.5f;
    vtMesh mesh = makeRelief(lens, 201, 201, 1.0f, 0.3f);
    const float back = mesh.boundsMin.z;
    const vtFrame frame = frameAt((vtVec3){0.0f, 0.0f, 100.0f}, (vtVec3){0.0f, 0.0f, 0.0f}, 1.0f);
    vtReferenceImage traced;
    drawAndTrace(fixture, &mesh, &frame, &traced);
    int axial = 0;
    for (int i = 0; i < side * side; ++i) {
        const vtVec3 ray = eyeRay(&frame, i % side, i / side);
        // Where it meets the paraboloid; a few rounds are enough.
        vtVec3 p = vtMulAdd(frame.view.eye, 100.0f, ray);
        for (int round = 0; round < 8; ++round) {
            const float z = -(p.x * p.x + p.y * p.y) / (2.0f * R);
            p = vtMulAdd(frame.view.eye, (z - frame.view.eye.z) / ray.z, ray);
        }
        const vtVec3 N = vtNormalize((vtVec3){p.x / R, p.y / R, 1.0f});
        const vtVec3 inner = refractRay(ray, N, 1.0f / n);
        const vtVec3 wanted = refractRay(inner, (vtVec3){0.0f, 0.0f, 1.0f}, n);
        const vtVec3 drawn = vtMakeVec3(fixture->directions + 3 * i);
        checkDirection(fixture, &traced, i, wanted, 0.01f);
        const float r = hypotf(p.x, p.y);
        if (r > 0.1f && r < 0.25f) {
            // The drawn direction from where the ray leaves the back: how far behind it, it comes to the
            // axis.
            const vtVec3 out = vtMulAdd(p, (back - p.z) / inner.z, inner);
            const float distance =
                -(out.x * drawn.x + out.y * drawn.y) / (drawn.x * drawn.x + drawn.y * drawn.y);
            const float focal = 1.0f / ((n - 1.0f) / R - 1.0f / 100.0f) + back / n;
            assert_near(-distance * drawn.z, focal, 0.01f * focal);
            ++axial;
        }
    }
    assert_true(axial > 500);
    vtDestroyReferenceImage(&traced);
}

// -------------------------------------------------------------------------------------------- the reference

static void addMesh(vtScene* scene, vtMesh* mesh, const vtMaterial* material, const vtTransform* toWorld)
{
    vtScene one;
    vtError error;
    assert_ok(vtCreateMeshScene(mesh, material, &one, &error), error);
    assert_ok(vtScene_Append(scene, &one, toWorld, &error), error);
}

static void addShape(vtScene* scene, const char* name, bool opaque, vtVec3 at, float scale)
{
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateShape(name, &mesh, &error), error);
    vtMaterial material = vtDefaultMaterial();
    material.opaque = opaque;
    const vtTransform place = {{{scale, 0, 0, at.x}, {0, scale, 0, at.y}, {0, 0, scale, at.z}}};
    addMesh(scene, &mesh, &material, &place);
}

/// Draws the scene by heights, then traces its triangles: directions agree within a degree for `share` of
/// the pixels whose true path has an end.
static void checkScene(Fixture* fixture, vtScene* scene, const vtFrame* frame, double share, const char* name)
{
    vtError error;
    vtReferenceImage truth;
    vtDirectionError difference;
    assert_ok(vtPrepareScene(scene, vt_techniqueHeightField, NULL, &error), error);
    assert_ok(vtRenderer_SetScene(fixture->renderer, scene, &error), error);
    draw(fixture, frame);
    assert_ok(vtPrepareScene(scene, vt_techniqueExact, NULL, &error), error);
    traceScene(scene, frame, &truth);
    assert_ok(vtCompareDirections(fixture->directions, truth.directions, side * side, &difference, &error),
              error);
    if (difference.pixels < 1000 || difference.within1 < share || difference.maskErrors > 12) {
        fail_msg(
            "%s: %.4f within 0.1 degrees, %.4f within 1, of %zu pixels, %.4f lost, %zu in one picture only",
            name, difference.within01, difference.within1, difference.pixels, difference.lost,
            difference.maskErrors);
    }
    vtDestroyReferenceImage(&truth);
}

static void directionsAreThoseOfATracer(void** state)
{
    Fixture* fixture = *state;
    const struct {
        const char* name;
        HeightFcn* heightOf;
        int width, height;
        float depth, share;
    } reliefs[] = {
        {"flat", flat, 2, 2, 0.1f, 0.999f},
        {"ramp", ramp, 3, 9, 0.4f, 0.999f},
        {"hills", hills, 65, 65, 0.3f, 0.995f},
        {"hills, wide", hills, 200, 37, 0.2f, 0.995f},
        {"hills, tall", hills, 30, 131, 0.2f, 0.995f},
        {"hills, fine", hills, 512, 512, 0.3f, 0.995f},
        {"spikes", spikes, 24, 24, 0.5f, 0.98f},
    };
    const vtVec3 eyes[] = {{0.4f, 0.3f, 3.0f},
                           {-2.5f, 0.4f, 0.8f},
                           {0.7f, -1.0f, -2.6f},
                           {0.0f, 2.8f, 0.0f},
                           {0.05f, 0.02f, -0.05f}};
    for (size_t i = 0; i < sizeof reliefs / sizeof reliefs[0]; ++i) {
        for (size_t eye = 0; eye < sizeof eyes / sizeof eyes[0]; ++eye) {
            vtScene scene = {0};
            vtMesh mesh =
                makeRelief(reliefs[i].heightOf, reliefs[i].width, reliefs[i].height, reliefs[i].depth, 0.3f);
            const vtMaterial material = vtDefaultMaterial();
            const vtTransform place = vtIdentityTransform();
            addMesh(&scene, &mesh, &material, &place);
            vtFrame frame = frameAt(eyes[eye], (vtVec3){0.0f, 0.0f, 0.5f * (float)(eye == 4)}, 50.0f);
            frame.maxEvents = 16;
            char name[64];
            snprintf(name, sizeof name, "%s from eye %zu", reliefs[i].name, eye);
            checkScene(fixture, &scene, &frame, (double)reliefs[i].share, name);
            vtDestroyScene(&scene);
        }
    }
}

// Turned, mirrored, stretched, twice; with glass inside, before and behind, and with what is opaque.
static void reliefsStandAmongOthers(void** state)
{
    Fixture* fixture = *state;
    const float c = cosf(0.6f), s = sinf(0.6f);
    const vtTransform places[] = {{{{c, 0, s, 0}, {0, 1, 0, 0}, {-s, 0, c, 0}}},
                                  {{{-1, 0, 0, 0.1f}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
                                  {{{0.6f, 0.2f, 0, 0}, {-0.1f, 0.9f, 0, 0.1f}, {0, 0.1f, 2, -0.2f}}}};
    for (int i = 0; i < 3; ++i) {
        vtScene scene = {0};
        vtMesh mesh = makeRelief(hills, 90, 70, 0.3f, 0.4f);
        vtMaterial material = vtDefaultMaterial();
        material.ior = 1.4f;
        addMesh(&scene, &mesh, &material, &places[i]);
        // An instance.
        vtObject* objects = realloc(scene.objects, 8 * sizeof *objects);
        assert_non_null(objects);
        scene.objects = objects;
        scene.objects[1] = scene.objects[0];
        scene.objects[1].toWorld.rows[2][3] -= 1.7f;
        scene.objectCount = 2;
        addShape(&scene, "sphere", i == 1, (vtVec3){0.2f, 0.1f, -0.05f}, 0.15f); // within
        addShape(&scene, "torus", false, (vtVec3){-0.3f, 0.0f, 1.2f}, 0.3f);
        addShape(&scene, "cube", true, (vtVec3){0.5f, 0.3f, -3.0f}, 0.8f);
        vtFrame frame = frameAt((vtVec3){0.5f, 0.4f, 3.2f}, (vtVec3){0.0f, 0.0f, 0.0f}, 45.0f);
        frame.ior = 0.0f;
        frame.maxEvents = 24;
        char name[32];
        snprintf(name, sizeof name, "scene %d", i);
        checkScene(fixture, &scene, &frame, 0.98, name);
        vtDestroyScene(&scene);
    }
}

// With Fresnel reflection and its branches the picture is that of the triangles.
static void picturesAreThoseOfTriangles(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    setEnvironment(fixture->renderer, "studio");
    vtScene scene = {0};
    vtMesh mesh = makeRelief(hills, 128, 128, 0.25f, 0.2f);
    const vtMaterial material = vtDefaultMaterial();
    const vtTransform place = vtIdentityTransform();
    addMesh(&scene, &mesh, &material, &place);
    addShape(&scene, "sphere", true, (vtVec3){0.2f, 0.1f, -1.5f}, 0.6f);
    vtFrame frame = frameAt((vtVec3){0.5f, 0.4f, 2.6f}, (vtVec3){0.0f, 0.0f, 0.0f}, 45.0f);
    frame.fresnel = true;
    frame.samples = 1; // chance chooses in the others, and by the least difference
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    draw(fixture, &frame);
    uint8_t* drawn = malloc(sizeof fixture->pixels);
    memcpy(drawn, fixture->pixels, sizeof fixture->pixels);
    assert_ok(vtPrepareScene(&scene, vt_techniqueExact, NULL, &error), error);
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    frame.technique = vt_techniqueExact;
    draw(fixture, &frame);
    int different = 0;
    for (int i = 0; i < 4 * side * side; ++i) {
        different += abs(drawn[i] - fixture->pixels[i]) > 8;
    }
    assert_true(different <= 4 * side * side / 500);
    // With triangles there, too, heights are drawn to the same bytes as without.
    frame.technique = vt_techniqueHeightField;
    draw(fixture, &frame);
    assert_memory_equal(drawn, fixture->pixels, sizeof fixture->pixels);
    free(drawn);
    vtDestroyScene(&scene);
}

static void saysWhatIsMissing(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtMesh mesh = makeRelief(hills, 16, 16, 0.1f, 0.1f);
    assert_ok(vtRenderer_SetMesh(fixture->renderer, &mesh, &error), error);
    vtFrame frame = smallFrame(vt_techniqueLayered);
    assert_int_equal(vtRenderer_DrawImage(fixture->renderer, &frame, NULL, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "technique 'layered' needs triangles"));
    assert_non_null(strstr(error.message, "vtPrepareScene"));
    frame.technique = vt_techniqueHeightField;
    assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, NULL, &error), error);
    assert_int_equal(vtRenderer_Info(fixture->renderer).meshBytes, 32768); // one row of no triangles
    vtDestroyMesh(&mesh);
    // Without a relief it is `exact`.
    setShape(fixture->renderer, "knot");
    setEnvironment(fixture->renderer, "sky");
    draw(fixture, &frame);
    uint8_t* drawn = malloc(sizeof fixture->pixels);
    memcpy(drawn, fixture->pixels, sizeof fixture->pixels);
    frame.technique = vt_techniqueExact;
    draw(fixture, &frame);
    assert_memory_equal(drawn, fixture->pixels, sizeof fixture->pixels);
    free(drawn);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slabLeavesDirectionsAlone), cmocka_unit_test(rampIsAPrism),
        cmocka_unit_test(paraboloidFocuses),         cmocka_unit_test(directionsAreThoseOfATracer),
        cmocka_unit_test(reliefsStandAmongOthers),   cmocka_unit_test(picturesAreThoseOfTriangles),
        cmocka_unit_test(saysWhatIsMissing),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
