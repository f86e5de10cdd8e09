// Every function of vitrine.h that needs no GL, called with NULL and nonsense: those with a result give
// vt_errorArgument (or what they document) and a sentence, the others do nothing or give something neutral.
#include <math.h>

#include "testing.h"

/// The result, the function that the sentence must name, and that it is written into the error.
#define assert_missing(call, name)                                                                           \
    do {                                                                                                     \
        vtError error = {0};                                                                                 \
        assert_int_equal(call, vt_errorArgument);                                                            \
        assert_int_equal(error.result, vt_errorArgument);                                                    \
        if (strstr(error.message, name ": ") == NULL || strstr(error.message, " is NULL") == NULL) {         \
            fail_msg("'%s' does not say that an argument of %s is NULL", error.message, name);               \
        }                                                                                                    \
    } while (0)

#define assert_refused(call, wanted, part)                                                                   \
    do {                                                                                                     \
        vtError error = {0};                                                                                 \
        assert_int_equal(call, wanted);                                                                      \
        if (error.result != wanted || strstr(error.message, part) == NULL) {                                 \
            fail_msg("'%s' does not speak of '%s'", error.message, part);                                    \
        }                                                                                                    \
    } while (0)

static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static vtMesh makeShape(const char* name)
{
    vtMesh mesh;
    vtError error = {0};
    assert_ok(vtCreateShape(name, &mesh, &error), error);
    return mesh;
}

static vtScene makeScene(void)
{
    vtMesh mesh = makeShape("cube");
    const vtMaterial material = vtDefaultMaterial();
    vtScene scene;
    vtError error = {0};
    assert_ok(vtCreateMeshScene(&mesh, &material, &scene, &error), error);
    return scene;
}

static void meshes(void** state)
{
    (void)state;
    vtMesh mesh;
    vtMeshDef def = {.positions = corners, .vertexCount = 3, .indexCount = 3};
    assert_missing(vtCreateMesh(&def, "x", NULL, &error), "vtCreateMesh");
    assert_missing(vtCreateMesh(NULL, "x", &mesh, &error), "vtCreateMesh");
    assert_int_equal(vtCreateMesh(&def, NULL, &mesh, NULL), vt_ok);
    assert_missing(vtMesh_Update(NULL, corners, NULL, &error), "vtMesh_Update");
    assert_missing(vtMesh_Update(&mesh, NULL, NULL, &error), "vtMesh_Update");
    vtDestroyMesh(&mesh);
    vtDestroyMesh(&mesh); // again
    vtDestroyMesh(NULL);
    assert_refused(vtMesh_Update(&mesh, corners, NULL, &error), vt_errorGeometry, "no triangles");
    assert_refused(vtComputeInnerDistances(&mesh, &error), vt_errorGeometry, "no triangles");
    assert_int_equal(vtTriangulateRelief(&mesh, NULL), vt_ok); // no relief: nothing is done
    assert_missing(vtComputeInnerDistances(NULL, &error), "vtComputeInnerDistances");
    assert_missing(vtTriangulateRelief(NULL, &error), "vtTriangulateRelief");
    def.positions = NULL;
    assert_missing(vtCreateMesh(&def, "x", &mesh, &error), "vtCreateMesh");
    def.vertexCount = 0;
    assert_refused(vtCreateMesh(&def, "x", &mesh, &error), vt_errorGeometry, "no vertices");
    def = (vtMeshDef){.positions = corners, .vertexCount = 3, .indexCount = UINT32_MAX};
    assert_refused(vtCreateMesh(&def, "x", &mesh, &error), vt_errorGeometry, "no index list");
}

static void shapes(void** state)
{
    (void)state;
    vtMesh mesh;
    assert_missing(vtCreateShape("cube", NULL, &error), "vtCreateShape");
    assert_missing(vtCreateShape(NULL, &mesh, &error), "vtCreateShape");
    const int indices[] = {-1, 1000, INT32_MIN, INT32_MAX};
    for (int i = 0; i < 4; ++i) {
        assert_null(vtShapeName(indices[i]));
        assert_null(vtShapeSummary(indices[i]));
        assert_null(vtReliefPatternName(indices[i]));
        assert_null(vtReliefPatternSummary(indices[i]));
        assert_true(vtReliefPatternDepth(indices[i]) > 0.0f);
        assert_null(vtEnvironmentName(indices[i]));
        assert_null(vtEnvironmentSummary(indices[i]));
        assert_null(vtPresetName(indices[i]));
        assert_null(vtTechnique_Info((vtTechnique)indices[i]));
    }
    assert_int_equal(vtFindTechnique(NULL), vt_techniqueCount);
}

static void reliefs(void** state)
{
    (void)state;
    vtMesh mesh;
    vtReliefDef def = vtDefaultRelief();
    assert_missing(vtCreateRelief(&def, "x", NULL, &error), "vtCreateRelief");
    assert_missing(vtCreateRelief(NULL, "x", &mesh, &error), "vtCreateRelief");
    assert_missing(vtCreateRelief(&def, "x", &mesh, &error), "vtCreateRelief"); // no heights
    def.heights = corners;
    def.width = def.height = -3;
    assert_refused(vtCreateRelief(&def, NULL, &mesh, &error), vt_errorGeometry, "-3 x -3");
    def.width = def.height = INT32_MAX;
    assert_refused(vtCreateRelief(&def, NULL, &mesh, &error), vt_errorGeometry, "a side must be");
    assert_missing(vtLoadRelief(corners, 9, "x", &def, NULL, &error), "vtLoadRelief");
    assert_missing(vtLoadRelief(corners, 9, "x", NULL, &mesh, &error), "vtLoadRelief");
    assert_missing(vtLoadRelief(NULL, 9, "x", &def, &mesh, &error), "vtLoadRelief");
    assert_refused(vtLoadRelief(NULL, 0, NULL, &def, &mesh, &error), vt_errorFormat, "is empty");
    assert_missing(vtCreateReliefPattern("ripples", &def, NULL, &error), "vtCreateReliefPattern");
    assert_missing(vtCreateReliefPattern("ripples", NULL, &mesh, &error), "vtCreateReliefPattern");
    assert_missing(vtCreateReliefPattern(NULL, &def, &mesh, &error), "vtCreateReliefPattern");
    def.width = -1;
    assert_refused(vtCreateReliefPattern("ripples", &def, &mesh, &error), vt_errorArgument, "a side must be");
}

static void environments(void** state)
{
    (void)state;
    vtEnvironment environment;
    const uint8_t pixel[4] = {1, 2, 3, 4};
    assert_missing(vtCreateEnvironment("sky", NULL, &error), "vtCreateEnvironment");
    assert_missing(vtCreateEnvironment(NULL, &environment, &error), "vtCreateEnvironment");
    assert_missing(vtLoadEnvironment(pixel, 4, "x", NULL, &error), "vtLoadEnvironment");
    assert_missing(vtLoadEnvironment(NULL, 4, "x", &environment, &error), "vtLoadEnvironment");
    assert_refused(vtLoadEnvironment(NULL, 0, NULL, &environment, &error), vt_errorFormat, "is empty");
    assert_missing(vtCreateImageEnvironment(pixel, 1, 1, "x", NULL, &error), "vtCreateImageEnvironment");
    assert_missing(vtCreateImageEnvironment(NULL, 1, 1, "x", &environment, &error),
                   "vtCreateImageEnvironment");
    assert_refused(vtCreateImageEnvironment(pixel, -1, 1, NULL, &environment, &error), vt_errorFormat,
                   "-1 x 1");
    const vtVec3 up = {0.0f, 1.0f, 0.0f};
    const vtEnvironment empty = {.kind = vt_environmentImage}, unknown = {.kind = (vtEnvironmentKind)77};
    assert_true(vtEnvironment_Sample(NULL, up).x == 0.0f);
    assert_true(vtEnvironment_Sample(&empty, up).x == 0.0f);
    assert_true(vtEnvironment_Sample(&unknown, up).x == 0.0f);
    vtDestroyEnvironment(&environment);
    vtDestroyEnvironment(&environment);
    vtDestroyEnvironment(NULL);
}

static void scenes(void** state)
{
    (void)state;
    vtScene scene = {0}, other = {0};
    vtMesh mesh = makeShape("cube");
    const vtMaterial material = vtDefaultMaterial();
    const vtTransform place = vtIdentityTransform();
    assert_missing(vtCreateMeshScene(&mesh, &material, NULL, &error), "vtCreateMeshScene");
    assert_missing(vtCreateMeshScene(NULL, &material, &scene, &error), "vtCreateMeshScene");
    assert_missing(vtCreateMeshScene(&mesh, NULL, &scene, &error), "vtCreateMeshScene");
    assert_non_null(mesh.positions); // not taken over
    vtDestroyMesh(&mesh);
    assert_missing(vtScene_Append(NULL, &other, &place, &error), "vtScene_Append");
    assert_missing(vtScene_Append(&scene, NULL, &place, &error), "vtScene_Append");
    assert_missing(vtScene_Append(&scene, &other, NULL, &error), "vtScene_Append");
    assert_refused(vtScene_Append(&scene, &scene, &place, &error), vt_errorArgument, "itself");
    scene.objectCount = UINT32_MAX;
    other.objectCount = 2;
    assert_refused(vtScene_Append(&scene, &other, &place, &error), vt_errorArgument, "more than");
    assert_refused(vtValidateScene(&scene, &error), vt_errorGeometry, "it has");
    vtDestroyScene(&scene);
    vtDestroyScene(&scene);
    vtDestroyScene(NULL);
    assert_missing(vtValidateScene(NULL, &error), "vtValidateScene");
    assert_refused(vtValidateScene(&scene, &error), vt_errorGeometry, "it has 0 objects");
    assert_missing(vtPrepareScene(NULL, vt_techniqueExact, NULL, &error), "vtPrepareScene");
    assert_refused(vtPrepareScene(&scene, (vtTechnique)77, NULL, &error), vt_errorArgument, "technique 77");
    assert_int_equal(vtPrepareScene(&scene, vt_techniqueWyman, NULL, NULL), vt_ok);
    vtVec3 low = {1, 1, 1}, high = {1, 1, 1};
    vtScene_Bounds(NULL, &low, &high);
    assert_true(low.x == 0.0f && high.x == 0.0f);
    vtScene_Bounds(&scene, &low, NULL);
    vtScene_Bounds(&scene, NULL, &high);
    assert_missing(vtLoadScene(NULL, &scene, &error), "vtLoadScene");
    vtModelDef def = {.size = 5};
    assert_missing(vtLoadScene(&def, NULL, &error), "vtLoadScene");
    assert_missing(vtLoadScene(&def, &scene, &error), "vtLoadScene");
    def.size = 0;
    assert_refused(vtLoadScene(&def, &scene, &error), vt_errorFormat, "empty");
    vtModel* model;
    assert_missing(vtOpenModel(NULL, &model, &scene, &error), "vtOpenModel");
    assert_missing(vtOpenModel(&def, NULL, &scene, &error), "vtOpenModel");
    assert_missing(vtOpenModel(&def, &model, NULL, &error), "vtOpenModel");
    assert_refused(vtOpenModel(&def, &model, &scene, &error), vt_errorFormat, "empty");
    assert_missing(vtModel_SetTime(NULL, 0, 0.0, NULL, &scene, &error), "vtModel_SetTime");
    assert_null(vtModel_Animation(NULL, 0));
    assert_int_equal(vtScene_NextPlace(NULL, NULL).object, 0);
    vtCloseModel(NULL);
}

/// Each field of a scene that names something else, or an array that is not there.
static void scenesOfNonsense(void** state)
{
    (void)state;
    vtScene scene = makeScene();
    for (int i = 0; i < 8; ++i) {
        vtObject object = scene.objects[0];
        vtMaterial material = scene.materials[0];
        vtMesh mesh = scene.meshes[0];
        vtScene wrong = scene;
        wrong.objects = i == 0 ? NULL : &object;
        wrong.meshes = i == 1 ? NULL : &mesh;
        wrong.materials = i == 2 ? NULL : &material;
        object.mesh = i == 3 ? 7 : 0;
        object.material = i == 4 ? UINT32_MAX : 0;
        mesh = i == 5 ? (vtMesh){0} : mesh;
        object.toWorld.rows[1][1] = i == 6 ? NAN : 1.0f;
        material.opaque = i == 7;
        material.maps[vt_mapBaseColor].image = i == 7 ? 3 : -1;
        assert_refused(vtValidateScene(&wrong, &error), vt_errorGeometry, "scene: ");
        vtVec3 low, high;
        vtScene_Bounds(&wrong, &low, &high);
        vtViewOfScene(&wrong, 45.0f, 1.0f);
        vtTracer* tracer = (vtTracer*)&wrong;
        assert_refused(vtCreateTracer(&wrong, &tracer, &error), vt_errorGeometry, "scene: ");
        assert_null(tracer);
        assert_int_equal(vtPrepareScene(&wrong, vt_techniqueExact, NULL, NULL), vt_ok);
    }
    vtDestroyScene(&scene);
}

static void preparations(void** state)
{
    (void)state;
    assert_null(vtBeginPreparation(NULL));
    assert_true(vtPreparation_Step(NULL, 1));
    assert_missing(vtEndPreparation(NULL, &error), "vtEndPreparation");
    vtScene scene = {.meshCount = 3};
    vtPreparation* preparation = vtBeginPreparation(&scene);
    assert_true(vtPreparation_Step(preparation, 0));
    assert_int_equal(vtEndPreparation(preparation, NULL), vt_ok);
}

static void views(void** state)
{
    (void)state;
    const float bad[] = {0.0f, -1.0f, NAN, INFINITY};
    vtScene scene = makeScene();
    const vtView view = vtViewOfScene(NULL, 45.0f, 1.0f);
    assert_true(isfinite(view.eye.z) && view.target.z == 0.0f);
    assert_true(isfinite(vtViewOfMesh(NULL, 45.0f, 1.0f).eye.x));
    assert_true(isfinite(vtViewOfMesh(&(vtMesh){0}, 45.0f, 1.0f).eye.x));
    for (int i = 0; i < 4; ++i) {
        vtViewOfScene(&scene, bad[i], bad[i]);
        vtView_Orbit(view, bad[i], bad[i]);
        vtView_Zoom(view, bad[i]);
    }
    vtDestroyScene(&scene);
}

static void frames(void** state)
{
    (void)state;
    assert_missing(vtValidateFrame(NULL, &error), "vtValidateFrame");
    assert_true(vtResolveFrame(NULL).layers > 0);
    vtFrame frame = vtDefaultFrame();
    frame.preset = (vtPreset)-5;
    assert_int_equal(vtResolveFrame(&frame).layers, 0);
    memset(&frame, 0, sizeof frame);
    assert_refused(vtValidateFrame(&frame, &error), vt_errorArgument, "fov");
    frame = vtDefaultFrame();
    frame.technique = (vtTechnique)-1;
    assert_refused(vtValidateFrame(&frame, &error), vt_errorArgument, "technique");
}

static void tracers(void** state)
{
    (void)state;
    vtScene scene = makeScene();
    vtTracer* tracer;
    vtPath path;
    vtError failure = {0};
    vtFrame frame = vtDefaultFrame();
    assert_missing(vtCreateTracer(&scene, NULL, &error), "vtCreateTracer");
    assert_missing(vtCreateTracer(NULL, &tracer, &error), "vtCreateTracer");
    assert_ok(vtCreateTracer(&scene, &tracer, &failure), failure);
    assert_missing(vtTracer_Path(NULL, &frame, 1.0f, 1.0f, &path, &error), "vtTracer_Path");
    assert_missing(vtTracer_Path(tracer, NULL, 1.0f, 1.0f, &path, &error), "vtTracer_Path");
    assert_missing(vtTracer_Path(tracer, &frame, 1.0f, 1.0f, NULL, &error), "vtTracer_Path");
    assert_refused(vtTracer_Path(tracer, &frame, NAN, 1.0f, &path, &error), vt_errorArgument, "nan");
    frame.width = 0;
    assert_refused(vtTracer_Path(tracer, &frame, 1.0f, 1.0f, &path, &error), vt_errorArgument, "width");
    vtDestroyTracer(tracer);
    vtDestroyTracer(NULL);
    vtDestroyScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes),       cmocka_unit_test(shapes), cmocka_unit_test(reliefs),
        cmocka_unit_test(environments), cmocka_unit_test(scenes), cmocka_unit_test(scenesOfNonsense),
        cmocka_unit_test(preparations), cmocka_unit_test(views),  cmocka_unit_test(frames),
        cmocka_unit_test(tracers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
