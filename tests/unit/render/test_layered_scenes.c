// Technique `layered` with several objects, in any order and one after the other.
#include <math.h>

#include "rendering.h"

typedef struct Thing {
    const char* shape;
    float scale, x, y, z, ior;
    bool opaque;
} Thing;

enum { mostThings = 3 };

static void setThings(vtRenderer* renderer, const Thing* things, uint32_t count)
{
    vtMesh meshes[mostThings];
    vtMaterial materials[mostThings];
    vtObject objects[mostThings] = {{0}};
    vtError error;
    assert_true(count <= mostThings);
    for (uint32_t i = 0; i < count; ++i) {
        const Thing* thing = &things[i];
        assert_ok(vtCreateShape(thing->shape, &meshes[i], &error), error);
        materials[i] = vtDefaultMaterial();
        materials[i].ior = thing->ior;
        materials[i].opaque = thing->opaque;
        const float s = thing->scale;
        objects[i] = (vtObject){
            .mesh = i,
            .material = i,
            .toWorld = {{{s, 0, 0, thing->x}, {0, s, 0, thing->y}, {0, 0, s, thing->z}}},
        };
    }
    const vtScene scene = {.meshes = meshes,
                           .materials = materials,
                           .objects = objects,
                           .meshCount = count,
                           .materialCount = count,
                           .objectCount = count};
    assert_ok(vtRenderer_SetScene(renderer, &scene, &error), error);
    for (uint32_t i = 0; i < count; ++i) {
        vtDestroyMesh(&meshes[i]);
    }
}

static vtFrame frameOf(vtTechnique technique, vtMulti multi)
{
    vtFrame frame = smallFrame(technique);
    frame.view = (vtView){.eye = {0.4f, 0.5f, 6.0f}, .target = {0.0f, 0.0f, 0.0f}, .fovY = 25.0f};
    frame.multi = multi;
    frame.ior = 0.0f; // each object's own
    return frame;
}

/// Directions of the frame as `exact` has them, then as `layered` has: share of the pixels through which both
/// leave the glass that differ by less than a degree.
static double agreement(Fixture* fixture, vtMulti multi)
{
    static float exact[3 * side * side];
    vtFrame frame = frameOf(vt_techniqueExact, multi);
    draw(fixture, &frame);
    memcpy(exact, fixture->directions, sizeof exact);
    frame = frameOf(vt_techniqueLayered, multi);
    draw(fixture, &frame);
    int glass = 0, same = 0;
    for (int i = 0; i < 3 * side * side; i += 3) {
        const float* e = exact + i;
        const float* l = fixture->directions + i;
        if (fabsf(e[0] * e[0] + e[1] * e[1] + e[2] * e[2] - 1.0f) < 0.01f) {
            ++glass;
            same += e[0] * l[0] + e[1] * l[1] + e[2] * l[2] > 0.99985f && l[0] != 2.0f;
        }
    }
    assert_true(glass > side * side / 20);
    return (double)same / (double)glass;
}

static void orderInTheSceneDoesNotMatter(void** state)
{
    Fixture* fixture = *state;
    static uint8_t pixels[4 * side * side];
    static float directions[3 * side * side];
    const Thing scenes[2][2] = {
        {{"sphere", 0.8f, 0, 0, 0.5f, 1.5f, false}, {"knot", 1, 0, 0, -2, 1.3f, false}},
        {{"sphere", 1, 0, 0, 0, 1.5f, false}, {"sphere", 0.5f, 0, 0, 0, 2, false}}};
    setEnvironment(fixture->renderer, "studio");
    const vtFrame frame = frameOf(vt_techniqueLayered, vt_multiAny);
    for (int i = 0; i < 2; ++i) {
        setThings(fixture->renderer, scenes[i], 2);
        draw(fixture, &frame);
        memcpy(pixels, fixture->pixels, sizeof pixels);
        memcpy(directions, fixture->directions, sizeof directions);
        setThings(fixture->renderer, (const Thing[]){scenes[i][1], scenes[i][0]}, 2);
        draw(fixture, &frame);
        assert_memory_equal(pixels, fixture->pixels, sizeof pixels);
        assert_memory_equal(directions, fixture->directions, sizeof directions);
    }
}

static void oneObjectInOrderIsAny(void** state)
{
    Fixture* fixture = *state;
    setEnvironment(fixture->renderer, "studio");
    setThings(fixture->renderer, &(Thing){"knot", 1, 0, 0, 0, 1.5f, false}, 1);
    assertOrderedIsAny(fixture, frameOf(vt_techniqueLayered, vt_multiAny));
}

static void separateObjectsAgreeWithExact(void** state)
{
    Fixture* fixture = *state;
    const Thing spheres[3] = {{"sphere", 0.7f, 0.1f, 0, 1, 1.5f, false},
                              {"sphere", 0.8f, 0.2f, 0.1f, -1, 1.4f, false},
                              {"sphere", 0.8f, -0.3f, 0.1f, -3, 1.3f, false}};
    setThings(fixture->renderer, spheres, 2);
    assert_true(agreement(fixture, vt_multiAny) > 0.95);
    assert_true(agreement(fixture, vt_multiOrdered) > 0.95);
    // An odd number of objects ends in the same targets as an even one.
    setThings(fixture->renderer, spheres, 3);
    assert_true(agreement(fixture, vt_multiAny) > 0.9);
    assert_true(agreement(fixture, vt_multiOrdered) > 0.9);
}

static void onlyAnyOrderKnowsObjectsWithinObjects(void** state)
{
    Fixture* fixture = *state;
    const Thing spheres[2] = {{"sphere", 1, 0, 0, 0, 1.5f, false}, {"sphere", 0.5f, 0, 0, 0, 2, false}};
    setThings(fixture->renderer, spheres, 2);
    assert_true(agreement(fixture, vt_multiAny) > 0.95);
    assert_true(agreement(fixture, vt_multiOrdered) < 0.7);
}

static void opaqueThingsEndPaths(void** state)
{
    Fixture* fixture = *state;
    static uint32_t exact[side * side], layered[side * side];
    const Thing things[3] = {{"sphere", 0.7f, 0, 0, 1, 1.5f, false},
                             {"sphere", 0.6f, 0.1f, 0, -1, 1, true},
                             {"sphere", 0.9f, 0, 0, -3, 1.5f, false}};
    setThings(fixture->renderer, things, 3);
    vtError error;
    vtFrame frame = frameOf(vt_techniqueExact, vt_multiAny);
    draw(fixture, &frame);
    assert_ok(vtRenderer_ReadStates(fixture->renderer, exact, &error), error);
    frame = frameOf(vt_techniqueLayered, vt_multiAny);
    draw(fixture, &frame);
    assert_ok(vtRenderer_ReadStates(fixture->renderer, layered, &error), error);
    int ended = 0, same = 0, glass = 0;
    for (int p = 0; p < side * side; ++p) {
        const uint32_t was = exact[p] & 255u, is = layered[p] & 255u;
        glass += was != VT_PATH_BACKGROUND;
        ended += was == VT_PATH_OPAQUE;
        same += was != VT_PATH_BACKGROUND && is == was;
    }
    assert_true(ended > glass / 10);
    assert_true(same > glass * 95 / 100);
    // The middle of the picture: glass, then the opaque ball.
    const uint32_t middle = layered[side / 2 * side + side / 2];
    assert_int_equal(middle & 255u, VT_PATH_OPAQUE);
    assert_int_equal((middle >> 8) & 127u, 2);
}

static void tooManyLayersAreAnError(void** state)
{
    Fixture* fixture = *state;
    enum { count = 1000 };
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateShape("cube", &mesh, &error), error);
    vtMaterial material = vtDefaultMaterial();
    vtObject* objects = calloc(count, sizeof *objects);
    for (int i = 0; i < count; ++i) {
        objects[i] = (vtObject){.toWorld = vtIdentityTransform()};
        objects[i].toWorld.rows[0][3] = 3.0f * (float)i;
    }
    const vtScene scene = {.meshes = &mesh,
                           .materials = &material,
                           .objects = objects,
                           .meshCount = 1,
                           .materialCount = 1,
                           .objectCount = count};
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    vtFrame frame = frameOf(vt_techniqueLayered, vt_multiAny);
    frame.layers = VT_MAX_LAYERS;
    assert_int_equal(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error),
                     vt_errorContext);
    assert_non_null(strstr(error.message, "fewer layers"));
    free(objects);
    vtDestroyMesh(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(orderInTheSceneDoesNotMatter, setUp, tearDown),
        cmocka_unit_test_setup_teardown(oneObjectInOrderIsAny, setUp, tearDown),
        cmocka_unit_test_setup_teardown(separateObjectsAgreeWithExact, setUp, tearDown),
        cmocka_unit_test_setup_teardown(onlyAnyOrderKnowsObjectsWithinObjects, setUp, tearDown),
        cmocka_unit_test_setup_teardown(opaqueThingsEndPaths, setUp, tearDown),
        cmocka_unit_test_setup_teardown(tooManyLayersAreAnError, setUp, tearDown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
