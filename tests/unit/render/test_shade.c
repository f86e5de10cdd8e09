// Light of the sun and of lights of files on opaque things, and what is in its way, by closed form.
#include "base/optics.h"
#include "light/lighting.h"
#include "lit_scenes.h"

/// Radiance of the surface that is seen at a point, from an eye that looks at it.
static vtVec3 radianceAt(Fixture* fixture, vtVec3 eye, vtVec3 point, vtTechnique technique)
{
    static float pixels[4 * side * side];
    vtError error;
    vtFrame frame = smallFrame(technique);
    frame.width = frame.height = 9;
    frame.linear = true;
    frame.fresnel = true;
    frame.ior = 0.0f;
    frame.view = (vtView){eye, point, 1.0f};
    assert_ok(vtRenderer_DrawFloats(fixture->renderer, &frame, pixels, &error), error);
    return vtMakeVec3(pixels + 4 * (4 * 9 + 4));
}

static void setScene(Fixture* fixture, vtScene* scene)
{
    vtError error;
    assert_ok(vtRenderer_SetScene(fixture->renderer, scene, &error), error);
    vtDestroyScene(scene);
}

static void setSun(Fixture* fixture, vtVec3 direction)
{
    vtGround ground = vtDefaultGround();
    vtError error;
    ground.height = -5.0f;
    ground.sunDirection = direction;
    ground.sunSize = 0.0f;
    ground.sunColor = (vtVec3){2.0f, 2.0f, 2.0f};
    assert_ok(vtRenderer_SetGround(fixture->renderer, &ground, &error), error);
}

/// A table of that colour whose top lies at y = 0.
static void addTable(vtScene* scene)
{
    vtMaterial matt = mattOf((vtVec3){0.5f, 0.4f, 0.3f});
    matt.specular = 0.0f;
    addBox(scene, &matt, (vtVec3){4.0f, 0.5f, 4.0f}, (vtVec3){0.0f, -0.5f, 0.0f});
}

static const vtVec3 over = {0.1f, 6.0f, 3.0f};

/// By a sun straight above, and a box that hides the eye's point from it.
static void aBoxShadesATable(void** state)
{
    Fixture* fixture = *state;
    vtEnvironment night;
    vtScene scene = {0};
    const vtMaterial grey = mattOf((vtVec3){0.5f, 0.5f, 0.5f});
    addTable(&scene);
    addBox(&scene, &grey, (vtVec3){0.3f, 0.1f, 0.3f}, (vtVec3){-1.0f, 1.0f, 0.0f});
    setScene(fixture, &scene);
    setNight(fixture->renderer, 0.0f, &night);
    setSun(fixture, (vtVec3){-1.0f, 1.0f, 0.0f});
    const float lit = 0.5f / VT_PI * 2.0f * sqrtf(0.5f);
    const vtTechnique techniques[] = {vt_techniqueExact, vt_techniqueHeightField};
    for (int i = 0; i < 2; ++i) {
        const vtVec3 away = radianceAt(fixture, over, (vtVec3){1.5f, 0.0f, 0.0f}, techniques[i]);
        const vtVec3 dark = radianceAt(fixture, over, (vtVec3){0.0f, 0.0f, 0.0f}, techniques[i]);
        print_message("lit %.4f of %.4f, in the shadow %.4f\n", (double)away.x, (double)lit, (double)dark.x);
        assert_true(fabsf(away.x - lit) < 0.01f * lit && fabsf(away.z - 0.6f * lit) < 0.01f * lit);
        assert_true(dark.x < 1e-4f);
    }
}

/// What comes straight from above through a tinted slab, of two surfaces, beside what comes between it and
/// another.
static void checkSlabs(Fixture* fixture, vtScene* scene)
{
    vtEnvironment night;
    vtMaterial glass = vtDefaultMaterial();
    glass.tint = (vtVec3){0.9f, 0.5f, 0.25f};
    addTable(scene);
    addBox(scene, &glass, (vtVec3){0.5f, 0.1f, 0.5f}, (vtVec3){0.0f, 1.0f, 0.0f});
    addBox(scene, &glass, (vtVec3){0.5f, 0.1f, 0.5f}, (vtVec3){2.0f, 1.0f, 0.0f});
    setScene(fixture, scene);
    setNight(fixture->renderer, 0.0f, &night);
    const float passed = (1.0f - vtFresnel(1.0f, 1.5f)) * (1.0f - vtFresnel(1.0f, 1.0f / 1.5f));
    const vtVec3 front = {1.0f, 0.7f, 5.0f};
    const vtVec3 away = radianceAt(fixture, front, (vtVec3){1.0f, 0.0f, 0.1f}, vt_techniqueExact);
    const vtVec3 below = radianceAt(fixture, front, (vtVec3){0.1f, 0.0f, 0.0f}, vt_techniqueExact);
    const float lit = 0.5f / VT_PI * 2.0f;
    print_message("beside %.4f of %.4f, through glass %.3f %.3f %.3f of it\n", (double)away.x, (double)lit,
                  (double)(below.x / away.x), (double)(below.y / away.y), (double)(below.z / away.z));
    assert_true(fabsf(away.x - lit) < 0.03f * lit);
    assert_true(fabsf(below.x / away.x - passed * 0.81f) < 0.03f * passed * 0.81f);
    assert_true(fabsf(below.y / away.y - passed * 0.25f) < 0.03f * passed * 0.25f);
    assert_true(fabsf(below.z / away.z - passed * 0.0625f) < 0.03f * passed * 0.0625f);
}

/// Over a ground photons bring it.
static void glassBringsPhotons(void** state)
{
    vtScene scene = {0};
    setSun(*state, (vtVec3){0.0f, 1.0f, 0.0f});
    checkSlabs(*state, &scene);
}

/// Without one it goes straight on.
static void glassDimsAndTints(void** state)
{
    vtScene scene = {0};
    addLight(&scene, (vtLight){.kind = vt_lightDirectional,
                               .direction = {0.0f, -1.0f, 0.0f},
                               .color = {2.0f, 2.0f, 2.0f}});
    checkSlabs(*state, &scene);
}

/// The sun of an environment lights a table once, whether it is a light of its own or not.
static void aSunCountsOnce(void** state)
{
    Fixture* fixture = *state;
    vtEnvironment night;
    vtSun sun;
    vtScene scene = {0};
    vtError error;
    addTable(&scene);
    setScene(fixture, &scene);
    setNight(fixture->renderer, 1000.0f, &night);
    assert_true(vtFindSun(&night, &sun));
    vtGround ground = vtDefaultGround();
    ground.height = -5.0f;
    assert_ok(vtRenderer_SetGround(fixture->renderer, &ground, &error), error);
    const vtVec3 light = radianceAt(fixture, over, (vtVec3){0.0f, 0.0f, 0.0f}, vt_techniqueExact);
    const float lit = 0.5f / VT_PI * sun.irradiance.x * sun.direction.y;
    assert_ok(vtRenderer_SetGround(fixture->renderer, NULL, &error), error);
    const vtVec3 before = radianceAt(fixture, over, (vtVec3){0.0f, 0.0f, 0.0f}, vt_techniqueExact);
    print_message("as a light %.4f of %.4f, in the environment %.4f\n", (double)light.x, (double)lit,
                  (double)before.x);
    assert_true(fabsf(light.x - lit) < 0.02f * lit);
    assert_true(fabsf(before.x - lit) < 0.25f * lit); // nine factors are not much for a sun
}

/// A blurred reflection of the sun is as bright as the lighting had it.
static void glareIsTheLightings(void** state)
{
    (void)state;
    vtEnvironment sky;
    vtLighting with, without;
    vtSun sun;
    vtError error;
    assert_ok(vtCreateEnvironment("sky", &sky, &error), error);
    assert_true(vtFindSun(&sky, &sun));
    assert_ok(vtCreateLighting(&sky, NULL, &with, &error), error);
    assert_ok(vtCreateLighting(&sky, &sun, &without, &error), error);
    const float roughnesses[] = {0.25f, 0.45f, 0.7f, 1.0f};
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 4; ++k) {
            const vtVec3 d =
                vtNormalize(vtMulAdd(sun.direction, 0.15f * (float)k, (vtVec3){1.0f, 0.0f, 0.0f}));
            const float was = vtLighting_Specular(&with, d, roughnesses[i]).x;
            const float now = vtLighting_Specular(&without, d, roughnesses[i]).x +
                              sun.irradiance.x * vtSun_Glare(&sun, d, roughnesses[i]);
            print_message("roughness %.2f: %.4f of %.4f\n", (double)roughnesses[i], (double)now, (double)was);
            assert_true(fabsf(now - was) < 0.15f * was);
        }
    }
    vtDestroyLighting(&with);
    vtDestroyLighting(&without);
}

/// A lamp of a file behind a wall, and one before it; there is no ground.
static void lampsOfFilesCastShadows(void** state)
{
    Fixture* fixture = *state;
    vtEnvironment night;
    vtScene scene = {0};
    vtError error;
    const vtMaterial grey = mattOf((vtVec3){0.5f, 0.5f, 0.5f});
    addTable(&scene);
    addBox(&scene, &grey, (vtVec3){0.1f, 1.0f, 4.0f}, (vtVec3){0.0f, 1.0f, 0.0f});
    addLight(&scene,
             (vtLight){.kind = vt_lightPoint, .position = {1.0f, 1.0f, 0.0f}, .color = {3.0f, 3.0f, 3.0f}});
    setScene(fixture, &scene);
    setNight(fixture->renderer, 0.0f, &night);
    assert_ok(vtRenderer_SetGround(fixture->renderer, NULL, &error), error);
    const vtVec3 near =
        radianceAt(fixture, (vtVec3){3.0f, 5.0f, 1.0f}, (vtVec3){1.0f, 0.0f, 0.0f}, vt_techniqueExact);
    const vtVec3 far =
        radianceAt(fixture, (vtVec3){-3.0f, 5.0f, 1.0f}, (vtVec3){-1.0f, 0.0f, 0.0f}, vt_techniqueExact);
    const vtVec3 behind =
        radianceAt(fixture, (vtVec3){3.5f, 0.2f, 0.0f}, (vtVec3){0.1f, 0.4f, 0.0f}, vt_techniqueExact);
    const float lit = 0.5f / VT_PI * 3.0f;
    print_message("below the lamp %.4f of %.4f, behind the wall %.4f\n", (double)near.x, (double)lit,
                  (double)far.x);
    assert_true(fabsf(near.x - lit) < 0.01f * lit);
    assert_true(far.x < 1e-4f && behind.x > 0.1f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(aBoxShadesATable, setUp, tearDown),
        cmocka_unit_test_setup_teardown(glassBringsPhotons, setUp, tearDown),
        cmocka_unit_test_setup_teardown(glassDimsAndTints, setUp, tearDown),
        cmocka_unit_test_setup_teardown(aSunCountsOnce, setUp, tearDown),
        cmocka_unit_test(glareIsTheLightings),
        cmocka_unit_test_setup_teardown(lampsOfFilesCastShadows, setUp, tearDown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
