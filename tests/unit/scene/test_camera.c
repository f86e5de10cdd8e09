// Views, frusta, orbit; and the ranges of a frame.
#include "base/math.h"
#include "scene/camera.h"
#include "scene/objects.h"
#include "testing.h"

static void frameIsOrthonormalAndLooksAtTheTarget(void** state)
{
    (void)state;
    const vtView views[] = {
        {{0.36f, 0.3f, 3.05f}, {0, 0, 0}, 45}, {{0, 5, 0}, {0, 0, 0}, 45}, {{1, -9, 2}, {1, 3, 2}, 20}};
    for (int i = 0; i < 3; ++i) {
        vtCamera c = vtMakeViewCamera(&views[i]);
        assert_near(vtDot(c.right, c.up), 0.0f, 1e-6);
        assert_near(vtDot(c.right, c.forward), 0.0f, 1e-6);
        assert_near(vtDot(c.up, c.forward), 0.0f, 1e-6);
        assert_near(vtLength(c.right), 1.0f, 1e-6);
        assert_near(vtLength(c.up), 1.0f, 1e-6);
        vtVec3 wanted = vtNormalize(vtSub(views[i].target, views[i].eye));
        assert_near(vtLength(vtSub(wanted, c.forward)), 0.0f, 1e-6);
    }
    // Seen along -Z, +X is on the right and +Y is up.
    vtCamera front = vtMakeViewCamera(&(vtView){{0, 0, 2}, {0, 0, 0}, 45});
    assert_near(front.right.x, 1.0f, 1e-6);
    assert_near(front.up.y, 1.0f, 1e-6);
}

static bool holds(const vtFrustum* f, const vtCamera* c, vtVec3 p)
{
    vtVec3 o = vtSub(p, c->eye);
    float x = vtDot(o, c->right), y = vtDot(o, c->up), z = vtDot(o, c->forward);
    return z > f->near && z < f->far && x > f->left * z && x < f->right * z && y > f->bottom * z &&
           y < f->top * z;
}

// However many samples are taken, they lie evenly: each sixteenth of the pixel has its share within 6,
// whatever their number.
static void samplesCoverThePixel(void** state)
{
    (void)state;
    float x, y;
    vtPixelSample(0, &x, &y);
    assert_true(x == 0.0f && y == 0.0f);
    int cells[16] = {0};
    for (int i = 0; i < VT_MAX_SAMPLES; ++i) {
        vtPixelSample(i, &x, &y);
        assert_true(x >= -0.5f && x < 0.5f && y >= -0.5f && y < 0.5f);
        ++cells[(int)(4.0f * (x + 0.5f)) + 4 * (int)(4.0f * (y + 0.5f))];
        for (int cell = 0; cell < 16; ++cell) {
            assert_true(abs(16 * cells[cell] - (i + 1)) <= 16 * 6);
        }
    }
}

static void layerFrustumHoldsTheWholeBox(void** state)
{
    (void)state;
    const vtVec3 low = {-1.4f, -0.4f, -1.4f}, high = {1.4f, 0.4f, 1.4f};
    const vtView views[] = {
        {{0.36f, 0.3f, 3.05f}, {0, 0, 0}, 45}, {{40, 30, -50}, {5, 5, 0}, 10}, {{0, 3, 0}, {0, 0, 0}, 90}};
    for (int i = 0; i < 3; ++i) {
        vtCamera c = vtMakeViewCamera(&views[i]);
        vtFrustum f = vtMakeLayerFrustum(&c, low, high);
        for (int k = 0; k < 8; ++k) {
            vtVec3 corner = {k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z};
            assert_true(holds(&f, &c, corner));
        }
    }
}

static void frustaStaySoundFromInsideTheBox(void** state)
{
    (void)state;
    const vtVec3 low = {-1, -1, -1}, high = {1, 1, 1};
    const vtView views[] = {
        {{0, 0, 0.5f}, {0, 0, 0}, 45}, {{0, 0, 9}, {0, 0, 10}, 45}, {{1, 1, 1}, {0, 0, 0}, 45}};
    for (int i = 0; i < 3; ++i) {
        vtCamera c = vtMakeViewCamera(&views[i]);
        vtFrustum f = vtMakeLayerFrustum(&c, low, high);
        assert_true(f.near > 0.0f && f.far > f.near);
        assert_true(f.right > f.left && f.top > f.bottom);
        assert_true(f.left >= -VT_MAX_LAYER_TANGENT && f.right <= VT_MAX_LAYER_TANGENT);
    }
}

static void framedMeshFitsThePicture(void** state)
{
    (void)state;
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateShape("torus", &mesh, &error), error);
    const float aspects[] = {0.4f, 1.0f, 2.5f};
    for (int i = 0; i < 3; ++i) {
        vtFrame frame = vtDefaultFrame();
        frame.view = vtViewOfMesh(&mesh, 30.0f, aspects[i]);
        frame.width = (int)(1000.0f * aspects[i]);
        frame.height = 1000;
        vtCamera c = vtMakeCamera(&frame);
        vtFrustum f = vtMakePictureFrustum(&c, mesh.boundsMin, mesh.boundsMax);
        for (uint32_t v = 0; v < mesh.vertexCount; ++v) {
            assert_true(holds(&f, &c, vtMakeVec3(mesh.positions + 3 * v)));
        }
    }
    vtDestroyMesh(&mesh);
}

static void orbitKeepsTheDistanceAndStopsAtThePoles(void** state)
{
    (void)state;
    vtView view = {{0, 0, 2}, {0, 0, 0}, 45};
    vtView turned = vtView_Orbit(view, VT_PI / 2.0f, 0.0f);
    assert_near(turned.eye.x, 2.0f, 1e-5);
    assert_near(turned.eye.z, 0.0f, 1e-5);
    vtView above = vtView_Orbit(view, 0.3f, 100.0f);
    assert_near(vtLength(above.eye), 2.0f, 1e-5);
    assert_true(above.eye.y < 2.0f && above.eye.y > 1.99f);
    assert_near(vtLength(vtView_Zoom(view, 0.5f).eye), 1.0f, 1e-6);
}

static void defaultFrameIsValid(void** state)
{
    (void)state;
    vtFrame frame = vtDefaultFrame();
    vtError error;
    assert_ok(vtValidateFrame(&frame, &error), error);
    vtFrame resolved = vtResolveFrame(&frame);
    assert_int_equal(frame.technique, vt_techniqueExact);
    frame.technique = vt_techniqueLayered;
    resolved = vtResolveFrame(&frame);
    assert_int_equal(resolved.layers, 4);
    assert_int_equal(resolved.steps, 50);
    frame.preset = vt_presetLow;
    frame.steps = 7;
    assert_int_equal(vtResolveFrame(&frame).layers, 2);
    assert_int_equal(vtResolveFrame(&frame).steps, 7);
    assert_int_equal(vtResolveFrame(&frame).maxEvents, 4);
    assert_int_equal(frame.refine, 8);
    assert_int_equal(resolved.maxEvents, 8);
}

/// What two views show is shown by the one that they are joined to, and not much more.
static void joinedViewsShowBoth(void** state)
{
    (void)state;
    vtMesh mesh;
    vtError error;
    vtView views[2];
    const vtMaterial glass = vtDefaultMaterial();
    const float aspect = 1.5f;
    vtScene scene;
    assert_ok(vtCreateShape("cube", &mesh, &error), error);
    assert_ok(vtCreateMeshScene(&mesh, &glass, &scene, &error), error);
    views[0] = vtViewOfScene(&scene, 40.0f, aspect);
    scene.objects[0].toWorld = (vtTransform){{{2, 0, 0, 7}, {0, 1, 0, -3}, {0, 0, 1, 5}}};
    views[1] = vtViewOfScene(&scene, 40.0f, aspect);
    const vtView joined = vtJoinViews(views, 2, aspect);
    const vtCamera camera = vtMakeViewCamera(&joined);
    const float tangent = tanf(20.0f * VT_PI / 180.0f);
    const float half = scene.meshes[0].boundsMax.x;
    float widest = 0.0f;
    for (int i = 0; i < 16; ++i) {
        const float x = i & 1 ? half : -half, y = i & 2 ? half : -half, z = i & 4 ? half : -half;
        const vtVec3 p =
            i < 8 ? (vtVec3){x, y, z} : vtTransformPoint(&scene.objects[0].toWorld, (vtVec3){x, y, z});
        const vtVec3 offset = vtSub(p, joined.eye);
        const float depth = vtDot(offset, camera.forward) * tangent;
        const float across = fabsf(vtDot(offset, camera.right)) / (depth * aspect);
        const float along = fabsf(vtDot(offset, camera.up)) / depth;
        widest = fmaxf(widest, fmaxf(across, along));
    }
    assert_in_range(widest * 100.0f, 60, 90);
    const vtView same = vtJoinViews(views, 1, aspect);
    assert_near(same.eye.z, views[0].eye.z, 1e-5f);
    vtDestroyScene(&scene);
}

static void framesOutOfRangeAreNamed(void** state)
{
    (void)state;
    vtFrame base = vtDefaultFrame(), f;
    base.technique = vt_techniqueLayered;
    vtError error;
#define EXPECT(change, text)                                                                                 \
    f = base;                                                                                                \
    change;                                                                                                  \
    assert_int_equal(vtValidateFrame(&f, &error), vt_errorArgument);                                         \
    assert_non_null(strstr(error.message, text))
    EXPECT(f.layers = -1, "layers is -1; it must be from 1 to 16, or 0");
    EXPECT(f.layers = 17, "layers is 17");
    EXPECT(f.steps = -1, "steps");
    EXPECT(f.preset = vt_presetCount, "preset is 3");
    EXPECT(f.refine = 33, "refine");
    EXPECT(f.maxEvents = 65, "max-events");
    EXPECT(f.ior = 0.9f, "ior is 0.9; it must be from 1 to 4, or 0");
    EXPECT(f.ior = NAN, "ior");
    EXPECT(f.width = 0, "width");
    EXPECT(f.height = 20000, "height");
    EXPECT(f.layerSize = 5, "layer-size");
    EXPECT(f.view.fovY = 0.0f, "fov");
    EXPECT(f.view.eye.x = INFINITY, "finite");
    EXPECT(f.view.eye = f.view.target, "stands on its target");
    EXPECT(f.technique = vt_techniqueCount, "technique");
    EXPECT((f.output = vt_outputLayerDepth, f.layer = 4), "layer is 4");
#undef EXPECT
}

static void everyTechniqueCanBeFound(void** state)
{
    (void)state;
    for (int i = 0; i < vt_techniqueCount; ++i) {
        const vtTechniqueInfo* info = vtTechnique_Info((vtTechnique)i);
        assert_int_equal(vtFindTechnique(info->id), i);
        assert_true(strlen(info->summary) > 0 && strlen(info->source) > 0);
    }
    assert_int_equal(vtFindTechnique("no such"), vt_techniqueCount);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frameIsOrthonormalAndLooksAtTheTarget),
        cmocka_unit_test(samplesCoverThePixel),
        cmocka_unit_test(layerFrustumHoldsTheWholeBox),
        cmocka_unit_test(frustaStaySoundFromInsideTheBox),
        cmocka_unit_test(framedMeshFitsThePicture),
        cmocka_unit_test(orbitKeepsTheDistanceAndStopsAtThePoles),
        cmocka_unit_test(defaultFrameIsValid),
        cmocka_unit_test(framesOutOfRangeAreNamed),
        cmocka_unit_test(joinedViewsShowBoth),
        cmocka_unit_test(everyTechniqueCanBeFound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
