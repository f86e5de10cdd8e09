// Geometry apart from instances: what is added, moved and removed one by one is drawn as a scene that is set
// at once.
#include <string.h>

#include "gl/gl.h"
#include "rendering.h"

static vtTransform place(float x, float y, float z, float scale)
{
    return (vtTransform){{{scale, 0, 0, x}, {0, scale, 0, y}, {0, 0, scale, z}}};
}

static vtGeometryId addShape(vtRenderer* renderer, const char* name)
{
    vtMesh mesh;
    vtError error;
    vtGeometryId id;
    assert_ok(vtCreateShape(name, &mesh, &error), error);
    assert_ok(vtRenderer_AddGeometry(renderer, &mesh, &id, &error), error);
    vtDestroyMesh(&mesh);
    return id;
}

static vtInstanceId addInstance(vtRenderer* renderer, vtGeometryId geometry, vtTransform toWorld, bool opaque)
{
    vtError error;
    vtInstanceId id;
    vtInstanceDef def = vtDefaultInstance();
    def.geometry = geometry;
    def.toWorld = toWorld;
    def.material.opaque = opaque;
    def.material.checker = opaque ? 3.0f : 0.0f;
    assert_ok(vtRenderer_AddInstance(renderer, &def, &id, &error), error);
    return id;
}

/// Two balls, a cube and a plane, the second ball there; at once.
static void createScene(vtTransform second, vtScene* scene)
{
    const char* shapes[] = {"sphere", "sphere", "cube", "plane"};
    const vtTransform places[] = {place(-0.7f, 0, 0, 0.5f), second, place(0, -0.8f, -0.5f, 0.3f),
                                  place(0, 0, -3, 1.5f)};
    vtError error;
    for (int i = 0; i < 4; ++i) {
        vtMesh mesh;
        vtScene one;
        vtMaterial material = vtDefaultMaterial();
        material.opaque = i == 3;
        material.checker = i == 3 ? 3.0f : 0.0f;
        assert_ok(vtCreateShape(shapes[i], &mesh, &error), error);
        assert_ok(vtCreateMeshScene(&mesh, &material, &one, &error), error);
        one.objects[0].toWorld = places[i];
        if (i == 0) {
            *scene = one;
        } else {
            const vtTransform none = vtIdentityTransform();
            assert_ok(vtScene_Append(scene, &one, &none, &error), error);
        }
    }
}

static void expectDrawnAs(Fixture* fixture, vtRenderer* other, vtTechnique technique)
{
    static uint8_t pixels[4 * side * side];
    vtError error;
    vtFrame frame = vtDefaultFrame();
    frame.technique = technique;
    frame.width = frame.height = side;
    assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error), error);
    assert_ok(vtRenderer_DrawImage(other, &frame, pixels, &error), error);
    assert_memory_equal(fixture->pixels, pixels, sizeof pixels);
}

static void oneByOneIsAsAtOnce(void** state)
{
    Fixture* fixture = *state;
    vtRenderer *renderer = fixture->renderer, *other = createRenderer(fixture);
    vtError error;
    const vtGeometryId cube = addShape(renderer, "cube"), gone = addShape(renderer, "torus");
    const vtGeometryId ball = addShape(renderer, "sphere");
    addInstance(renderer, gone, place(0, 0, 0, 1), false);
    addInstance(renderer, cube, place(0, -0.8f, -0.5f, 0.3f), false);
    const vtInstanceId moved = addInstance(renderer, ball, place(9, 9, 9, 1), false);
    addInstance(renderer, ball, place(-0.7f, 0, 0, 0.5f), false);
    assert_ok(vtRenderer_RemoveGeometry(renderer, gone, &error), error); // its instance goes with it
    addInstance(renderer, addShape(renderer, "plane"), place(0, 0, -3, 1.5f), true);
    for (int step = 0; step < 3; ++step) {
        const vtTransform there = place(0.7f - 0.2f * (float)step, 0.1f, 0.4f * (float)step, 0.45f);
        vtInstanceDef def;
        assert_ok(vtRenderer_GetInstance(renderer, moved, &def, &error), error);
        def.toWorld = there;
        assert_ok(vtRenderer_SetInstance(renderer, moved, &def, &error), error);
        vtScene scene;
        createScene(there, &scene);
        assert_ok(vtRenderer_SetScene(other, &scene, &error), error);
        vtDestroyScene(&scene);
        expectDrawnAs(fixture, other, vt_techniqueExact);
        expectDrawnAs(fixture, other, vt_techniqueLayered);
    }
    vtDestroyRenderer(other);
}

/// The textures of records grow, and what was removed leaves gaps that are used again.
static void geometryComesAndGoes(void** state)
{
    Fixture* fixture = *state;
    enum { most = 24 };
    const char* shapes[] = {"cube", "sphere", "torus", "knot", "diamond", "goblet"};
    vtGeometryId ids[most] = {0};
    vtInstanceId last = {0};
    vtRenderer *renderer = fixture->renderer, *other = createRenderer(fixture);
    vtError error;
    for (int round = 0; round < 3; ++round) {
        for (int i = 0; i < most; ++i) {
            if (i % 3 == round && ids[i].index1 != 0) {
                assert_ok(vtRenderer_RemoveGeometry(renderer, ids[i], &error), error);
                ids[i] = (vtGeometryId){0};
            }
        }
        for (int i = 0; i < most; ++i) {
            if (ids[i].index1 == 0) {
                ids[i] = addShape(renderer, shapes[(i + round) % 6]);
            }
        }
        for (int i = 0; i < most; i += 5) {
            if (last.index1 != 0) {
                vtRenderer_RemoveInstance(renderer, last, &error); // or it went with its geometry
            }
            last = addInstance(renderer, ids[i], vtIdentityTransform(), false);
        }
    }
    // Whatever happened before: a knot that is added now is a knot.
    vtRenderer_RemoveInstance(renderer, last, &error);
    addInstance(renderer, addShape(renderer, "knot"), vtIdentityTransform(), false);
    setShape(other, "knot");
    expectDrawnAs(fixture, other, vt_techniqueExact);
    vtDestroyRenderer(other);
}

static void handlesOfWhatIsGoneAreRefused(void** state)
{
    Fixture* fixture = *state;
    vtRenderer* renderer = fixture->renderer;
    vtError error;
    vtInstanceDef def = vtDefaultInstance();
    vtInstanceId none;
    assert_int_equal(vtRenderer_AddInstance(renderer, &def, &none, &error), vt_errorArgument); // no geometry
    const vtGeometryId ball = addShape(renderer, "sphere");
    const vtInstanceId instance = addInstance(renderer, ball, vtIdentityTransform(), false);
    def.geometry = ball;
    def.toWorld.rows[1][1] = 0.0f;
    assert_int_equal(vtRenderer_SetInstance(renderer, instance, &def, &error), vt_errorGeometry);
    def.toWorld = vtIdentityTransform();
    assert_ok(vtRenderer_RemoveInstance(renderer, instance, &error), error);
    assert_int_equal(vtRenderer_RemoveInstance(renderer, instance, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "is not there"));
    assert_int_equal(vtRenderer_SetInstance(renderer, instance, &def, &error), vt_errorArgument);
    const vtInstanceId again = addInstance(renderer, ball, vtIdentityTransform(), false); // in the same slot
    assert_int_equal(again.index1, instance.index1);
    assert_int_equal(vtRenderer_GetInstance(renderer, instance, &def, &error), vt_errorArgument);
    setShape(renderer, "cube"); // a scene takes the place of all
    assert_int_equal(vtRenderer_SetInstance(renderer, again, &def, &error), vt_errorArgument);
    assert_int_equal(vtRenderer_RemoveGeometry(renderer, ball, &error), vt_errorArgument);
    assert_int_equal(vtRenderer_SceneInstance(renderer, 1).index1, 0);
    assert_ok(vtRenderer_RemoveInstance(renderer, vtRenderer_SceneInstance(renderer, 0), &error), error);
}

/// An open sheet of glass inside other glass is a thin wall, which reflects.
static void openSheetsInsideGlassAreThin(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.fresnel = true;
    setEnvironment(fixture->renderer, "studio");
    addInstance(fixture->renderer, addShape(fixture->renderer, "sphere"), place(0, 0, 0, 1), false);
    assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error), error);
    uint8_t* without = malloc(sizeof fixture->pixels);
    memcpy(without, fixture->pixels, sizeof fixture->pixels);
    addInstance(fixture->renderer, addShape(fixture->renderer, "plane"), place(0, 0, 0, 0.4f), false);
    assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error), error);
    assert_true(memcmp(without, fixture->pixels, sizeof fixture->pixels) != 0);
    free(without);
}

static void keepLine(const char* line, void* userData)
{
    char* lines = userData;
    snprintf(lines + strlen(lines), 512 - strlen(lines), "%s\n", line);
}

/// What is approximated is told once, by the host's function.
static void whatIsApproximatedIsSaid(void** state)
{
    Fixture* fixture = *state;
    char lines[512] = "";
    vtRenderer* renderer;
    vtError error;
    vtMesh plane;
    const vtImage image = {.width = 1, .height = 1};
    assert_ok(vtCreateRenderer(&(vtRendererDef){.getProcAddress = fixture->context.getProcAddress,
                                                .log = keepLine,
                                                .logData = lines},
                               &renderer, &error),
              error);
    setShape(renderer, "sphere"); // as it is
    assert_string_equal(lines, "");
    assert_ok(vtCreateShape("plane", &plane, &error), error);
    assert_ok(vtRenderer_SetMesh(renderer, &plane, &error), error);
    assert_non_null(strstr(lines, "mesh 0: 4 open edges"));
    assert_ok(vtRenderer_SetImages(renderer, &image, 1, &error), error);
    assert_non_null(strstr(lines, "1 of 1 pictures"));
    vtDestroyMesh(&plane);

    // What the loader noted of a scene's files, line by line.
    vtScene scene = {0};
    vtMesh sphere;
    const vtMaterial glass = vtDefaultMaterial();
    assert_ok(vtCreateShape("sphere", &sphere, &error), error);
    assert_ok(vtCreateMeshScene(&sphere, &glass, &scene, &error), error);
    static const char notes[] = "'a': ignored: 1 light\n'b': ignored: 2 lights";
    scene.notes = vtAllocate(sizeof notes, 1);
    memcpy(scene.notes, notes, sizeof notes);
    lines[0] = '\0';
    assert_ok(vtRenderer_SetScene(renderer, &scene, &error), error);
    assert_string_equal(lines, "'a': ignored: 1 light\n'b': ignored: 2 lights\n");
    vtDestroyScene(&scene);
    vtDestroyRenderer(renderer);
}

/// Misuse is a result, and a sentence.
static void misuseIsAResult(void** state)
{
    Fixture* fixture = *state;
    vtRenderer *renderer = fixture->renderer, *made = NULL;
    vtError error;
    vtFrame frame = smallFrame(vt_techniqueExact);
    vtMesh empty = {0};
    vtScene nothing = {0};
    vtGeometryId geometry;
    bool ready;
    const vtResult results[] = {
        vtCreateRenderer(NULL, &made, &error),
        vtCreateRenderer(&(vtRendererDef){.getProcAddress = NULL}, &made, &error),
        vtCreateRenderer(&(vtRendererDef){.getProcAddress = fixture->context.getProcAddress}, NULL, &error),
        vtRenderer_Draw(renderer, &frame, &error), // there is no scene
        vtRenderer_Draw(NULL, &frame, &error),
        vtRenderer_Draw(renderer, NULL, &error),
        vtRenderer_DrawImage(renderer, &frame, fixture->pixels, &error),
        vtRenderer_DrawImage(NULL, NULL, NULL, NULL),
        vtRenderer_Prepare(renderer, &frame, &ready, &error),
        vtRenderer_Prepare(renderer, &frame, NULL, &error),
        vtRenderer_ReadDirections(renderer, fixture->directions, &error), // nothing is drawn
        vtRenderer_ReadDirections(renderer, NULL, &error),
        vtRenderer_ReadStates(renderer, (uint32_t*)fixture->pixels, &error),
        vtRenderer_SetScene(renderer, NULL, &error),
        vtRenderer_SetScene(NULL, &nothing, &error),
        vtRenderer_SetMesh(renderer, NULL, &error),
        vtRenderer_SetEnvironment(renderer, NULL, &error),
        vtRenderer_SetImages(renderer, NULL, 3, &error),
        vtRenderer_AddGeometry(renderer, &empty, &geometry, &error),
        vtRenderer_AddGeometry(renderer, NULL, &geometry, &error),
        vtRenderer_AddGeometry(renderer, &empty, NULL, &error),
        vtRenderer_UpdateGeometry(renderer, (vtGeometryId){1, 0}, &empty, &error),
        vtRenderer_RemoveGeometry(NULL, (vtGeometryId){1, 0}, &error),
        vtRenderer_AddInstance(renderer, NULL, NULL, &error),
    };
    for (size_t i = 0; i < sizeof results / sizeof results[0]; ++i) {
        assert_int_equal(results[i], vt_errorArgument);
    }
    assert_int_equal(vtRenderer_SetScene(renderer, &nothing, &error), vt_errorGeometry);
    assert_int_equal(vtRenderer_SetMesh(renderer, &empty, &error), vt_errorGeometry);
    assert_null(made);
    assert_string_equal(vtRenderer_Info(NULL).device, "");
    vtDestroyRenderer(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(oneByOneIsAsAtOnce, setUp, tearDown),
        cmocka_unit_test_setup_teardown(geometryComesAndGoes, setUp, tearDown),
        cmocka_unit_test_setup_teardown(handlesOfWhatIsGoneAreRefused, setUp, tearDown),
        cmocka_unit_test_setup_teardown(openSheetsInsideGlassAreThin, setUp, tearDown),
        cmocka_unit_test_setup_teardown(whatIsApproximatedIsSaid, setUp, tearDown),
        cmocka_unit_test_setup_teardown(misuseIsAResult, setUp, tearDown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
