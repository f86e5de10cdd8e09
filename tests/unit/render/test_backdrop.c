// What glass shows of a picture behind the scene: exact colours, the shift that a slab makes, and what the
// reference sees.
#include <string.h>

#include "rendering.h"

enum { pictureSide = 256 };

/// Red grows to the right and green downwards, a step a texel.
static vtImage makeRamp(void)
{
    vtImage picture = {
        .pixels = malloc(4 * pictureSide * pictureSide), .width = pictureSide, .height = pictureSide};
    assert_non_null(picture.pixels);
    for (int i = 0; i < pictureSide * pictureSide; ++i) {
        const uint8_t texel[4] = {(uint8_t)(i % pictureSide), (uint8_t)(i / pictureSide), 77, 255};
        memcpy(picture.pixels + 4 * i, texel, 4);
    }
    return picture;
}

static void setRamp(Fixture* fixture, const vtBackdrop* backdrop)
{
    vtError error;
    vtImage picture = makeRamp();
    assert_ok(vtRenderer_SetBackdrop(fixture->renderer, &picture, backdrop, &error), error);
    free(picture.pixels);
}

/// Straight along -z, two units high, without perspective: a level of the ramp is 1 / 128.
static vtFrame straightFrame(void)
{
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.view = (vtView){{0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, 0.0f}, 45.0f};
    frame.orthographicHeight = 2.0f;
    frame.exposure = 1.5f;
    frame.toneMapping = vt_toneMappingAces;
    return frame;
}

static void setMesh(Fixture* fixture, vtMesh* mesh, float degrees)
{
    vtScene scene;
    vtError error;
    const vtMaterial material = vtDefaultMaterial();
    assert_ok(vtCreateMeshScene(mesh, &material, &scene, &error), error);
    const float s = sinf(degrees * VT_PI / 180.0f), c = cosf(degrees * VT_PI / 180.0f);
    scene.objects[0].toWorld = (vtTransform){{{c, 0, s, 0}, {0, 1, 0, 0}, {-s, 0, c, 0}}};
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    vtDestroyScene(&scene);
    vtDestroyMesh(mesh);
}

/// Asserts that a pixel shows the ramp, moved by so many units, to a level of it.
static void assertRamp(const Fixture* fixture, int column, int row, float shift)
{
    const uint8_t* pixel = fixture->pixels + 4 * (row * side + column);
    const float right = 2.0f * (float)column + 0.5f + 128.0f * shift, down = 2.0f * (float)row + 0.5f;
    assert_near((float)pixel[0], right, 1.0f);
    assert_near((float)pixel[1], down, 1.0f);
    assert_near((float)pixel[2], 77.0f, 0.5f);
}

static void aPanelLeavesThePictureAsItIs(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtMesh mesh;
    const vtPanelDef def = {.width = 1.5f, .height = 1.2f, .radius = 0.2f, .bevel = 0.1f, .thickness = 0.3f};
    assert_ok(vtCreatePanel(&def, &mesh, &error), error);
    setMesh(fixture, &mesh, 0.0f);
    setEnvironment(fixture->renderer, "studio");
    const vtBackdrop backdrop = vtDefaultBackdrop();
    setRamp(fixture, &backdrop);
    const vtFrame frame = straightFrame();
    draw(fixture, &frame);
    int bent = 0;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const float x = fabsf((float)column + 0.5f - 64.0f) / 64.0f,
                        y = fabsf((float)row + 0.5f - 64.0f) / 64.0f;
            const bool isFlat = (x < 0.64f && y < 0.39f) || (x < 0.54f && y < 0.49f);
            if (isFlat || x > 0.76f || y > 0.61f) { // its flat middle, and beside it
                assertRamp(fixture, column, row, 0.0f);
            } else {
                bent += abs(fixture->pixels[4 * (row * side + column)] - 2 * column) > 3;
            }
        }
    }
    assert_true(bent > side); // its edge shows other parts
    // Of what the environment reflects nothing else changes: Fresnel reflection adds light.
    vtFrame reflecting = frame;
    reflecting.fresnel = true;
    draw(fixture, &reflecting);
    assert_true(abs(fixture->pixels[4 * (64 * side + 64)] - 128) < 40);
    assert_ok(vtRenderer_SetBackdrop(fixture->renderer, NULL, NULL, &error), error);
    draw(fixture, &frame);
    assert_true(fixture->pixels[2] != 77);
}

static void aSlabShiftsThePicture(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtMesh mesh;
    const vtPanelDef def = {
        .width = 1.9f, .height = 1.9f, .radius = 0.05f, .bevel = 0.01f, .thickness = 0.4f};
    const float degrees = 35.0f, angle = degrees * VT_PI / 180.0f, within = asinf(sinf(angle) / 1.5f);
    assert_ok(vtCreatePanel(&def, &mesh, &error), error);
    setMesh(fixture, &mesh, degrees);
    setEnvironment(fixture->renderer, "studio");
    // The textbook's shift of a ray, whatever the distance; the ray leaves on the side that the slab leans
    // to.
    const float shift = def.thickness * sinf(angle - within) / cosf(within);
    for (int i = 0; i < 2; ++i) {
        const vtBackdrop backdrop = {.distance = i == 0 ? 2.0f : 40.0f};
        setRamp(fixture, &backdrop);
        const vtFrame frame = straightFrame();
        draw(fixture, &frame);
        for (int column = 50; column < 78; column += 3) {
            assertRamp(fixture, column, 20 + column, -shift);
        }
        assertRamp(fixture, 2, 64, 0.0f);
    }
}

static void aPartOfThePictureFillsTheFrame(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    setEnvironment(fixture->renderer, "studio");
    const vtBackdrop backdrop = {.part = {0.25f, -0.5f, 0.75f, 0.5f}};
    setRamp(fixture, &backdrop);
    vtFrame frame = smallFrame(vt_techniqueExact); // in perspective
    frame.toneMapping = vt_toneMappingNeutral;
    draw(fixture, &frame);
    const uint8_t *left = fixture->pixels, *right = left + 4 * (side - 1),
                  *lower = left + 4 * (side - 1) * side;
    assert_near((float)left[0], 64.0f, 1.0f);
    assert_near((float)right[0], 191.0f, 1.0f);
    assert_near((float)left[1], 127.0f, 1.5f); // mirrored above its top
    assert_near((float)lower[1], 127.0f, 1.5f);
    frame.background = vt_backgroundTransparent;
    draw(fixture, &frame);
    assert_int_equal(left[3], 0);
}

static void theReferenceSeesTheSame(void** state)
{
    Fixture* fixture = *state;
    vtScene scene;
    vtError error;
    vtMesh mesh;
    assert_ok(vtCreateShape("sphere", &mesh, &error), error);
    const vtMaterial material = vtDefaultMaterial();
    assert_ok(vtCreateMeshScene(&mesh, &material, &scene, &error), error);
    vtDestroyMesh(&mesh);
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    vtEnvironment environment;
    assert_ok(vtCreateEnvironment("studio", &environment, &error), error);
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
    const vtBackdrop backdrop = {.distance = 1.7f};
    setRamp(fixture, &backdrop);
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.toneMapping = vt_toneMappingNone;
    frame.exposure = 0.5f;
    draw(fixture, &frame);
    vtReference* reference;
    vtReferenceImage truth;
    if (vtCreateReference(&scene, &reference, &error) != vt_ok) {
        vtDestroyScene(&scene);
        skip();
    }
    vtImage picture = makeRamp();
    const vtReferenceDef def = {
        .frame = &frame, .environment = &environment, .backdrop = &backdrop, .backdropPicture = &picture};
    assert_ok(vtReference_Trace(reference, &def, &truth, &error), error);
    static uint8_t wanted[4 * side * side];
    vtReference_ToSrgb(&truth, wanted);
    int far = 0;
    for (int i = 0; i < 4 * side * side; ++i) {
        far += abs(wanted[i] - fixture->pixels[i]) > 4;
    }
    assert_true(far < 2 * side); // at the silhouette, where a pixel's rays part
    vtDestroyReferenceImage(&truth);
    vtDestroyReference(reference);
    vtDestroyScene(&scene);
    free(picture.pixels);
}

static void whatCannotBeIsRefused(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    const vtBackdrop good = vtDefaultBackdrop();
    assert_int_equal(vtRenderer_SetBackdrop(fixture->renderer, NULL, &good, &error), vt_errorArgument);
    assert_string_equal(error.message, "there is no picture for the backdrop; give one");
    const vtImage empty = {0};
    assert_int_equal(vtRenderer_SetBackdrop(fixture->renderer, &empty, &good, &error), vt_errorArgument);
    assert_int_equal(vtRenderer_SetBackdrop(NULL, NULL, &good, &error), vt_errorArgument);
    const vtBackdrop bad[] = {{.distance = NAN},
                              {.distance = -1.0f},
                              {.distance = 2e6f},
                              {.part = {0.5f, 0.0f, 0.5f, 1.0f}},
                              {.part = {0.0f, 1.0f, 1.0f, 0.0f}},
                              {.part = {0.0f, 0.0f, NAN, 1.0f}}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        assert_int_equal(vtValidateBackdrop(&bad[i], &error), vt_errorArgument);
    }
    assert_int_equal(vtValidateBackdrop(NULL, &error), vt_errorArgument);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(aPanelLeavesThePictureAsItIs, setUp, tearDown),
        cmocka_unit_test_setup_teardown(aSlabShiftsThePicture, setUp, tearDown),
        cmocka_unit_test_setup_teardown(aPartOfThePictureFillsTheFrame, setUp, tearDown),
        cmocka_unit_test_setup_teardown(theReferenceSeesTheSame, setUp, tearDown),
        cmocka_unit_test_setup_teardown(whatCannotBeIsRefused, setUp, tearDown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
