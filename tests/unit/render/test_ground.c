// The ground: light that a ball of glass brings to it by closed form, where it is focused, where a box's
// shadow ends, and the sun of an environment.
#include "base/optics.h"
#include "gl/state.h"
#include "light/ground.h"
#include "lit_scenes.h"
#include "render/renderer.h"

/// What falls on the ground; nothing but the sun, whose irradiance is 1 1 1.
static vtGroundMap lightGround(Fixture* fixture, const vtScene* scene, const vtGround* ground, bool fresnel)
{
    vtRenderer* renderer = fixture->renderer;
    const uint8_t black[4 * 8] = {0};
    vtEnvironment night;
    vtGroundMap map;
    vtCausticMap caustics;
    vtError error;
    assert_ok(vtCreateImageEnvironment(black, 4, 2, "night", &night, &error), error);
    assert_ok(vtRenderer_SetScene(renderer, scene, &error), error);
    assert_ok(vtRenderer_SetEnvironment(renderer, &night, &error), error);
    vtDestroyEnvironment(&night);
    assert_ok(vtRenderer_SetGround(renderer, ground, &error), error);
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.fresnel = fresnel;
    assert_ok(vtRenderer_DrawImage(renderer, &frame, fixture->pixels, &error), error);
    const vtGL* gl = &renderer->gl;
    vtTakeState(gl);
    gl->BindVertexArray(renderer->emptyVertexArray);
    assert_ok(vtGroundPass_MakeMap(&renderer->ground, gl, &renderer->scene, &renderer->environment, &map,
                                   &caustics, &error),
              error);
    vtDestroyCausticMap(&caustics);
    return map;
}

static vtScene makeScene(const char* shape, bool opaque)
{
    vtMaterial material = vtDefaultMaterial();
    material.opaque = opaque;
    vtMesh mesh;
    vtScene scene;
    vtError error;
    assert_ok(vtCreateShape(shape, &mesh, &error), error);
    assert_ok(vtCreateMeshScene(&mesh, &material, &scene, &error), error);
    return scene;
}

static vtGround groundBelow(float height, vtVec3 sun)
{
    vtGround ground = vtDefaultGround();
    ground.height = height;
    ground.sunDirection = sun;
    ground.sunSize = 0.0f;
    ground.sunColor = (vtVec3){1.0f, 1.0f, 1.0f};
    return ground;
}

/// The part of a circle about the middle that lies in a square of half that side.
static double shareInSquare(double radius, double half)
{
    if (radius <= half) {
        return 1.0;
    }
    return radius >= half * sqrt(2.0) ? 0.0 : 1.0 - 4.0 * acos(half / radius) / 3.14159265358979;
}

/// Light through a ball of radius 1 and index 1.5 from above that lands in the square about it: of rays that
/// go through, of those reflected once within, of those reflected outside. Rays in a plane, as sums over
/// where they meet the ball.
static double lightOfBall(double ground, double half, bool fresnel)
{
    const double pi = 3.14159265358979, n = 1.5;
    double sum = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const double b = (i + 0.5) / 20000.0, in = asin(b), out = asin(b / n);
        const double F = fresnel ? (double)vtFresnel((float)cos(in), (float)(1.0 / n)) : 0.0;
        // Where each leaves the ball (from the top), how far it has turned towards the axis, and its light.
        const double places[3] = {in + pi - 2.0 * out, in + 2.0 * pi - 4.0 * out, in};
        const double turns[3] = {2.0 * (in - out), 2.0 * (in - out) + pi - 2.0 * out, pi + 2.0 * in};
        const double lights[3] = {(1.0 - F) * (1.0 - F), (1.0 - F) * (1.0 - F) * F, F};
        for (int k = 0; k < 3; ++k) {
            const double down = cos(turns[k]);
            if (down > 1e-6) {
                const double x = sin(places[k]) - sin(turns[k]) * (cos(places[k]) - ground) / down;
                sum += 2.0 * pi * b / 20000.0 * lights[k] * shareInSquare(fabs(x), half);
            }
        }
    }
    return sum;
}

static void checkBall(Fixture* fixture, bool fresnel)
{
    const vtGround ground = groundBelow(-1.6f, (vtVec3){0.0f, 2.0f, 0.0f});
    vtScene scene = makeScene("sphere", false);
    vtGroundMap map = lightGround(fixture, &scene, &ground, fresnel);
    const double area = (double)map.size * (double)map.size, pi = 3.14159265358979;
    const double brought = (double)map.gathered.x * area - (area - pi);
    const double wanted = lightOfBall(-1.6, 0.5 * (double)map.size, fresnel);
    print_message("ball, %s Fresnel reflection: %.4f of %.4f\n", fresnel ? "with" : "without", brought,
                  wanted);
    assert_true(fabs(brought - wanted) < 0.03 * wanted);
    vtDestroyGroundMap(&map);
    vtDestroyScene(&scene);
}

static void aBallBringsItsLight(void** state)
{
    checkBall(*state, true);
    checkBall(*state, false);
}

/// Texel of the greatest number of the map, world.
static void findBrightest(const vtGroundMap* map, float* x, float* z, float* light)
{
    int best = 0;
    for (int i = 0; i < VT_GROUND_SIDE * VT_GROUND_SIDE; ++i) {
        best = map->light[3 * i] > map->light[3 * best] ? i : best;
    }
    const float texel = map->size / (float)VT_GROUND_SIDE;
    *x = map->lowX + ((float)(best % VT_GROUND_SIDE) + 0.5f) * texel;
    *z = map->lowZ + ((float)(best / VT_GROUND_SIDE) + 0.5f) * texel;
    *light = map->light[3 * best];
}

/// A ball lens focuses n r / (2 (n - 1)) = 1.5 r from its centre.
static void aBallFocusesWhereItShould(void** state)
{
    vtScene scene = makeScene("sphere", false);
    const float away = 1.5f / sqrtf(2.0f);
    const vtGround ground = groundBelow(-away, (vtVec3){-1.0f, 1.0f, 0.0f});
    vtGroundMap map = lightGround(*state, &scene, &ground, true);
    float x, z, light;
    findBrightest(&map, &x, &z, &light);
    const float texel = map.size / (float)VT_GROUND_SIDE;
    print_message("focus at %g, %g of %g, 0: %g\n", (double)x, (double)z, (double)away, (double)light);
    assert_true(fabsf(x - away) < 3.0f * texel + 0.03f && fabsf(z) < 3.0f * texel);
    assert_true(light > 20.0f);
    vtDestroyGroundMap(&map);
    vtDestroyScene(&scene);
}

/// The map's number at a place.
static float lightAt(const vtGroundMap* map, float x, float z)
{
    const vtVec3 white = {1.0f, 1.0f, 1.0f};
    return vtGroundMap_Light(map, (vtVec3){x, map->height + 1.0f, z}, (vtVec3){0.0f, -1.0f, 0.0f}, white).x;
}

static void aBoxShadesWhatItShould(void** state)
{
    vtScene scene = makeScene("cube", true);
    const vtMesh* mesh = &scene.meshes[0];
    const vtVec3 low = mesh->boundsMin, high = mesh->boundsMax;
    const vtGround ground = groundBelow(NAN, (vtVec3){-1.0f, 2.0f, 0.0f});
    vtGroundMap map = lightGround(*state, &scene, &ground, true);
    const float end = high.x + 0.5f * (high.y - low.y), step = 1.5f * map.size / (float)VT_GROUND_SIDE;
    assert_true(fabsf(map.height - low.y) < 1e-5f);
    assert_true(lightAt(&map, end - step, 0.0f) < 0.25f);
    assert_true(lightAt(&map, end + step, 0.0f) > 0.75f);
    assert_true(lightAt(&map, end - step, high.z - step) < 0.5f);
    assert_true(lightAt(&map, end - step, high.z + step) > 0.5f);
    assert_true(lightAt(&map, low.x + step, 0.0f) < 0.25f); // what the box stands on
    assert_true(lightAt(&map, low.x - step, 0.0f) > 0.75f);
    vtDestroyGroundMap(&map);
    vtDestroyScene(&scene);
}

/// A box of glass that stands on the ground, the sun above it: what comes through its two faces, and no more.
/// Shade rays that started within the box would not meet it, and its light would count twice.
static void aBoxOfGlassIsMetFromBelow(void** state)
{
    vtScene scene = makeScene("cube", false);
    const vtGround ground = groundBelow(NAN, (vtVec3){0.0f, 1.0f, 0.0f});
    vtGroundMap map = lightGround(*state, &scene, &ground, true);
    const float F = vtFresnel(1.0f, 1.5f);
    print_message("below the box %.4f of %.4f\n", (double)lightAt(&map, 0.1f, 0.1f),
                  (double)((1.0f - F) * (1.0f - F)));
    assert_true(fabsf(lightAt(&map, 0.1f, 0.1f) - (1.0f - F) * (1.0f - F)) < 0.01f);
    vtDestroyGroundMap(&map);
    vtDestroyScene(&scene);
}

/// A lamp above the middle of a matt ground and a box beside it.
static void aLampLightsTheGround(void** state)
{
    const vtMaterial grey = mattOf((vtVec3){0.5f, 0.5f, 0.5f});
    vtScene scene = {0};
    addBox(&scene, &grey, (vtVec3){0.2f, 0.2f, 0.2f}, (vtVec3){1.0f, 0.2f, 0.0f});
    addLight(&scene,
             (vtLight){.kind = vt_lightPoint, .position = {0.0f, 1.0f, 0.0f}, .color = {2.0f, 2.0f, 2.0f}});
    vtGround ground = groundBelow(0.0f, (vtVec3){0.0f, 1.0f, 0.0f});
    ground.sunColor = (vtVec3){0.0f, 0.0f, 0.0f};
    ground.matt = true;
    ground.color = (vtVec3){0.5f, 0.5f, 0.5f};
    vtGroundMap map = lightGround(*state, &scene, &ground, true);
    const float places[3] = {0.0f, 0.5f, 1.6f}; // the shadow ends at 1.2 * 0.4 / 0.6 + 1.2 = 2
    float lights[3];
    for (int i = 0; i < 3; ++i) {
        lights[i] = lightAt(&map, places[i] - 1.0f, 0.0f); // the map is from the middle of the scene
        const float far = 1.0f + places[i] * places[i], lit = 0.5f / VT_PI * 2.0f / (far * sqrtf(far));
        print_message("at %.1f: %.4f of %.4f\n", (double)places[i], (double)lights[i], (double)lit);
        assert_true(i == 2 ? lights[i] < 1e-3f : fabsf(lights[i] - lit) < 0.02f * lit);
    }
    vtDestroyGroundMap(&map);
    vtDestroyScene(&scene);
}

static void aSunIsFound(void** state)
{
    (void)state;
    vtEnvironment sky, studio;
    vtSun sun;
    vtError error;
    assert_ok(vtCreateEnvironment("sky", &sky, &error), error);
    assert_ok(vtCreateEnvironment("studio", &studio, &error), error);
    assert_true(vtFindSun(&sky, &sun));
    assert_true(vtDot(sun.direction, vtNormalize((vtVec3){-0.5f, 0.5f, -0.70710678f})) > cosf(0.003f));
    // Half of its disc is within 1 - cos = 0.00024; outside that its glare is not a fifth as bright.
    assert_true(fabsf(sun.radius - acosf(1.0f - 0.00024f)) < 0.002f);
    const float red = 48.0f * 2.0f * VT_PI * 0.00024f;
    assert_true(sun.irradiance.x > 0.95f * red && sun.irradiance.x < 1.15f * red);
    assert_true(vtFindSun(&studio, &sun));
    assert_true(sun.irradiance.x == 0.0f);
}

/// Where no ray meets anything every texel has all the light, whatever directions fell to it.
static void freeGroundHasAllItsLight(void** state)
{
    (void)state;
    enum { across = 256 };
    const vtGround ground = vtDefaultGround();
    const vtVec3 low = {-1.0f, 0.0f, -1.0f}, high = {1.0f, 1.0f, 1.0f};
    const vtGroundScene scene = {
        .space = vtSpaceOfBox(low, high), .low = low, .high = high, .glassLow = high, .glassHigh = low};
    vtEnvironment sky;
    vtGroundPlan plan;
    vtError error;
    assert_ok(vtCreateEnvironment("sky", &sky, &error), error);
    assert_ok(vtPlanGround(&ground, &sky, &scene, &plan, &error), error);
    for (int source = 0; source < 2; ++source) {
        const int count = vtGroundPlan_Across(&plan, source, vt_groundShade, across);
        for (int i = 0; i < count * count; ++i) {
            const int x = i % count, y = i / count;
            const vtGroundRay ray = vtGroundPlan_Ray(&plan, source, vt_groundShade, x, y, count, 0);
            vtGroundPlan_AddShade(&plan, source, &ray, x, y, count, true);
        }
        vtGroundPlan_EndShade(&plan, source);
        const int texels = vtGroundSide(vtGroundLightOf(source));
        for (int i = 0; i < texels * texels; ++i) {
            assert_true(fabsf(plan.sums[source][3 * i] / plan.irradiance[source].x - 1.0f) < 1e-4f);
        }
    }
    vtDestroyGroundPlan(&plan);
}

/// Nothing of what the scene does: the picture is that without a ground.
static void withoutIntensityNothingIsSeen(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    setShape(fixture->renderer, "sphere");
    setEnvironment(fixture->renderer, "studio");
    vtFrame frame = smallFrame(vt_techniqueExact);
    assert_ok(vtRenderer_SetGround(fixture->renderer, NULL, &error), error);
    assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error), error);
    uint8_t* before = malloc(sizeof fixture->pixels);
    assert_non_null(before);
    memcpy(before, fixture->pixels, sizeof fixture->pixels);
    int differences[2] = {0, 0};
    for (int i = 0; i < 2; ++i) {
        vtGround ground = vtDefaultGround();
        ground.shadowIntensity = (float)i;
        assert_ok(vtRenderer_SetGround(fixture->renderer, &ground, &error), error);
        assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error), error);
        for (size_t k = 0; k < sizeof fixture->pixels; ++k) {
            differences[i] += abs(fixture->pixels[k] - before[k]) > 1;
        }
    }
    assert_int_equal(differences[0], 0);
    assert_true(differences[1] > 500);
    free(before);
}

static void aSunsDirectionHasAnyLength(void** state)
{
    (void)state;
    vtError error;
    const vtSun none = {.direction = {0.0f, -1.0f, 0.0f}};
    static const float lengths[] = {1e-45f, 1e-30f, 1e-18f, 1.0f, 1e18f, 1e30f, 3e38f};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; ++i) {
        vtGround ground = vtDefaultGround();
        ground.sunDirection = (vtVec3){-lengths[i], lengths[i], lengths[i]};
        assert_ok(vtValidateGround(&ground, &error), error);
        const vtVec3 to = vtGivenSun(&ground, &none).direction;
        const float one = sqrtf(1.0f / 3.0f);
        assert_true(vtLength(vtSub(to, (vtVec3){-one, one, one})) < 1e-6f);
        ground.sunDirection.y = 0.0f;
        assert_int_equal(vtValidateGround(&ground, &error), vt_errorArgument);
    }
    const vtGround own = vtDefaultGround();
    assert_true(vtGivenSun(&own, &none).direction.y == -1.0f);
}

static void badGroundsAreRefused(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtGround ground = vtDefaultGround();
    ground.shadowSoftness = 2.0f;
    assert_int_equal(vtRenderer_SetGround(fixture->renderer, &ground, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "shadow softness is 2"));
    ground = vtDefaultGround();
    ground.sunDirection = (vtVec3){1.0f, -1.0f, 0.0f};
    assert_int_equal(vtRenderer_SetGround(fixture->renderer, &ground, &error), vt_errorArgument);
    ground = vtDefaultGround();
    ground.height = 0.5f;
    setShape(fixture->renderer, "sphere");
    assert_ok(vtRenderer_SetGround(fixture->renderer, &ground, &error), error);
    const vtFrame frame = smallFrame(vt_techniqueExact);
    assert_int_equal(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error),
                     vt_errorArgument);
    assert_non_null(strstr(error.message, "reaches down to -1"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(aBallBringsItsLight, setUp, tearDown),
        cmocka_unit_test_setup_teardown(aBallFocusesWhereItShould, setUp, tearDown),
        cmocka_unit_test_setup_teardown(aBoxShadesWhatItShould, setUp, tearDown),
        cmocka_unit_test_setup_teardown(aBoxOfGlassIsMetFromBelow, setUp, tearDown),
        cmocka_unit_test_setup_teardown(aLampLightsTheGround, setUp, tearDown),
        cmocka_unit_test(aSunIsFound),
        cmocka_unit_test(aSunsDirectionHasAnyLength),
        cmocka_unit_test(freeGroundHasAllItsLight),
        cmocka_unit_test_setup_teardown(withoutIntensityNothingIsSeen, setUp, tearDown),
        cmocka_unit_test_setup_teardown(badGroundsAreRefused, setUp, tearDown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
