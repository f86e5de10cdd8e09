// The ground by the renderer against the reference's, which follows all parts of every photon on the CPU.
#include "gl/state.h"
#include "lab/metrics/metrics_image.h"
#include "lab/reference/reference_scene.h"
#include "lab/reference/reference_spectrum.h"
#include "lit_scenes.h"
#include "render/renderer.h"

static vtGround sunnyGround(void)
{
    vtGround ground = vtDefaultGround();
    ground.matt = true;
    ground.color = (vtVec3){0.2f, 0.18f, 0.16f};
    ground.sunDirection = (vtVec3){1.0f, 1.2f, -0.8f};
    ground.sunSize = 1.0f;
    return ground;
}

static vtFrame viewFromAbove(void)
{
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.ior = 0.0f;
    frame.fresnel = true;
    frame.view = (vtView){{2.6f, 2.4f, 3.4f}, {0.0f, -0.3f, 0.0f}, 50.0f};
    return frame;
}

/// What the scene changes of the light on the whole map, both ways.
static double changeOf(const vtGroundMap* map)
{
    double sum = 0.0;
    for (int i = 0; i < 3 * VT_GROUND_SIDE * VT_GROUND_SIDE; ++i) {
        sum += fabs((double)map->light[i] - 1.0);
    }
    return sum / (3.0 * VT_GROUND_SIDE * VT_GROUND_SIDE);
}

/// How far two maps lie apart in the mean of 4 x 4 texels, each colour by itself.
static double distanceOf(const vtGroundMap* a, const vtGroundMap* b)
{
    enum { block = 4 };
    double sum = 0.0;
    for (int i = 0; i < 3 * VT_GROUND_SIDE * VT_GROUND_SIDE / (block * block); ++i) {
        const int channel = i % 3, column = i / 3 % (VT_GROUND_SIDE / block),
                  row = i / 3 / (VT_GROUND_SIDE / block);
        double difference = 0.0;
        for (int k = 0; k < block * block; ++k) {
            const int texel = (block * row + k / block) * VT_GROUND_SIDE + block * column + k % block;
            difference += (double)a->light[3 * texel + channel] - (double)b->light[3 * texel + channel];
        }
        sum += fabs(difference);
    }
    return sum / (3.0 * VT_GROUND_SIDE * VT_GROUND_SIDE);
}

/// `chance`: some glass is rough, or disperses.
static void compareMaps(Fixture* fixture, const vtReference* reference, const vtFrame* frame,
                        const vtGround* ground, const vtEnvironment* environment, bool chance)
{
    vtRenderer* renderer = fixture->renderer;
    vtGroundMap drawn, traced;
    vtCausticMap caustics;
    vtError error;
    vtTakeState(&renderer->gl);
    renderer->gl.BindVertexArray(renderer->emptyVertexArray);
    assert_ok(vtGroundPass_MakeMap(&renderer->ground, &renderer->gl, &renderer->scene, &renderer->environment,
                                   &drawn, &caustics, &error),
              error);
    vtDestroyCausticMap(&caustics);
    static vtSpectrum spectrum;
    vtMakeSpectrum(&spectrum);
    const vtPathRules rules = {.spectrum = &spectrum,
                               .chance = chance,
                               .maxEvents = vtResolveFrame(frame).maxEvents,
                               .fresnel = true,
                               .exposure = 1.0f,
                               .roughness = -1.0f,
                               .dispersion = -1.0f};
    assert_ok(vtReference_LightGround(reference, &rules, ground, environment, 0, &traced, &caustics, &error),
              error);
    vtDestroyCausticMap(&caustics);
    const double reds = (double)(drawn.gathered.x / traced.gathered.x),
                 blues = (double)(drawn.gathered.z / traced.gathered.z);
    const double apart = distanceOf(&drawn, &traced);
    print_message(
        "light on the map %.4f of the reference's, blue %.4f; what is changed %.4f of %.4f, they are "
        "%.4f apart\n",
        reds, blues, changeOf(&drawn), changeOf(&traced), apart);
    assert_true(fabs(reds - 1.0) < 0.03 && fabs(blues - 1.0) < 0.03);
    assert_true(fabs(changeOf(&drawn) / changeOf(&traced) - 1.0) < 0.1);
    assert_true(apart < 0.2 * changeOf(&traced));
    vtDestroyGroundMap(&drawn);
    vtDestroyGroundMap(&traced);
}

static void comparePictures(Fixture* fixture, const vtReference* reference, const vtFrame* frame,
                            const vtGround* ground, const vtEnvironment* environment)
{
    const vtReferenceDef def = {
        .frame = frame, .environment = environment, .ground = ground, .fresnel = true, .onlyPicture = true};
    vtReferenceImage image;
    vtError error;
    assert_ok(vtReference_Trace(reference, &def, &image, &error), error);
    uint8_t* traced = malloc((size_t)4 * side * side);
    assert_non_null(traced);
    vtReference_ToSrgb(&image, traced);
    vtPictureError difference;
    assert_ok(vtComparePictureBytes(fixture->pixels, traced, 4, side, side, &difference, NULL, &error),
              error);
    print_message("mean FLIP %.4f\n", difference.flip);
    assert_true(difference.flip <= 0.06);
    free(traced);
    vtDestroyReferenceImage(&image);
}

static void checkScene(Fixture* fixture, vtScene* scene, const vtGround* ground, vtFrame frame, bool chance,
                       bool withPicture)
{
    vtEnvironment studio;
    vtReference* reference;
    vtError error;
    assert_ok(vtCreateEnvironment("studio", &studio, &error), error);
    assert_ok(vtRenderer_SetScene(fixture->renderer, scene, &error), error);
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &studio, &error), error);
    assert_ok(vtRenderer_SetGround(fixture->renderer, ground, &error), error);
    assert_ok(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error), error);
    assert_ok(vtCreateReference(scene, &reference, &error), error);
    compareMaps(fixture, reference, &frame, ground, &studio, chance);
    if (withPicture) { // for which the reference follows its photons again
        comparePictures(fixture, reference, &frame, ground, &studio);
    }
    vtDestroyReference(reference);
    vtDestroyScene(scene);
}

static const vtVec3 one = {1.0f, 1.0f, 1.0f}, middle = {0.0f, 0.0f, 0.0f};

static void checkShape(Fixture* fixture, const char* shape, bool withPicture)
{
    const vtGround ground = sunnyGround();
    const vtMaterial glass = vtDefaultMaterial();
    vtScene scene = {0};
    addShape(&scene, shape, &glass, one, middle);
    checkScene(fixture, &scene, &ground, viewFromAbove(), false, withPicture);
}

static void theGroundBelowABall(void** state)
{
    checkShape(*state, "sphere", false);
}

#ifndef __SANITIZE_ADDRESS__ // it takes minutes then, and goes the same ways
static void theGroundBelowAGoblet(void** state)
{
    checkShape(*state, "goblet", true);
}

/// A ball of glass and a matt one by two lamps and a sun.
static void theGroundByLamps(void** state)
{
    const vtGround ground = sunnyGround();
    const vtMaterial glass = vtDefaultMaterial(), matt = mattOf((vtVec3){0.7f, 0.5f, 0.3f});
    vtScene scene = {0};
    addShape(&scene, "sphere", &glass, (vtVec3){0.5f, 0.5f, 0.5f}, (vtVec3){-0.4f, 0.0f, 0.2f});
    addShape(&scene, "sphere", &matt, (vtVec3){0.4f, 0.4f, 0.4f}, (vtVec3){0.5f, -0.1f, 0.0f});
    addLight(&scene,
             (vtLight){.kind = vt_lightPoint, .position = {-1.2f, 1.2f, 0.6f}, .color = {1.5f, 1.2f, 0.9f}});
    addLight(&scene, (vtLight){.kind = vt_lightSpot,
                               .position = {1.0f, 1.5f, 1.0f},
                               .direction = {-0.5f, -0.70710678f, -0.5f},
                               .color = {2.0f, 2.5f, 3.0f},
                               .innerCone = 0.3f,
                               .outerCone = 0.6f});
    checkScene(*state, &scene, &ground, viewFromAbove(), false, false);
}

/// A ball and a cube of glass before a wall and a matt ball of many triangles, seen without the ground.
static void lightOnAWall(void** state)
{
    vtGround ground = sunnyGround();
    const vtMaterial glass = vtDefaultMaterial(), matt = mattOf((vtVec3){0.3f, 0.25f, 0.2f});
    vtScene scene = {0};
    vtFrame frame = viewFromAbove();
    ground.sunDirection = (vtVec3){0.5f, 0.8f, 1.5f};
    addBox(&scene, &matt, (vtVec3){1.5f, 1.0f, 0.1f}, (vtVec3){0.0f, 0.0f, -1.2f});
    addShape(&scene, "sphere", &glass, (vtVec3){0.4f, 0.4f, 0.4f}, (vtVec3){-0.5f, 0.0f, 0.2f});
    addBox(&scene, &glass, (vtVec3){0.3f, 0.3f, 0.3f}, (vtVec3){0.6f, 0.0f, 0.2f});
    addShape(&scene, "sphere", &matt, (vtVec3){0.4f, 0.4f, 0.4f}, (vtVec3){-0.6f, -0.5f, -0.6f});
    frame.view = (vtView){{0.6f, 0.5f, 3.4f}, {0.0f, -0.1f, -1.0f}, 36.0f};
    checkScene(*state, &scene, &ground, frame, false, true);
}

/// A ball of frosted glass, rather low.
static void lightThroughFrost(void** state)
{
    const vtGround ground = sunnyGround();
    vtMaterial rough = vtDefaultMaterial();
    vtScene scene = {0};
    rough.roughness = 0.5f;
    addShape(&scene, "sphere", &rough, (vtVec3){0.5f, 0.5f, 0.5f}, (vtVec3){0.0f, 0.0f, 0.0f});
    checkScene(*state, &scene, &ground, viewFromAbove(), true, false);
}

/// Light comes in at the top of a box and leaves by two sides, each colour in another direction.
static void lightThroughAPrism(void** state)
{
    vtGround ground = sunnyGround();
    vtMaterial dispersing = vtDefaultMaterial();
    vtScene scene = {0};
    ground.height = -0.8f;
    dispersing.ior = 1.1f;
    dispersing.dispersion = 15.0f;
    addBox(&scene, &dispersing, (vtVec3){0.4f, 0.2f, 0.4f}, (vtVec3){0.0f, 0.0f, 0.0f});
    checkScene(*state, &scene, &ground, viewFromAbove(), true, false);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(theGroundBelowABall, setUp, tearDown),
#ifndef __SANITIZE_ADDRESS__
        cmocka_unit_test_setup_teardown(theGroundBelowAGoblet, setUp, tearDown),
        cmocka_unit_test_setup_teardown(theGroundByLamps, setUp, tearDown),
        cmocka_unit_test_setup_teardown(lightOnAWall, setUp, tearDown),
        cmocka_unit_test_setup_teardown(lightThroughFrost, setUp, tearDown),
        cmocka_unit_test_setup_teardown(lightThroughAPrism, setUp, tearDown),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
