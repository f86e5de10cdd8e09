// Animations of glTF files: where nodes, vertices, cameras, lights and materials are at a time, by known
// values; what is refused.
#include <math.h>

#include "animated_models.h"

#define ALL_PATHS                                                                                            \
    ",\"meshes\":[" CUBE_MESH "],\"nodes\":[{\"mesh\":0}],\"animations\":[{\"name\":\"a\",\"samplers\":[{"   \
    "\"input\":2,\"output\":3%s}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"%s\"}}]}]"

static const float twoTimes[2] = {1, 3};

/// A glass cube whose node is moved along `path` by floats, of two keys, at 1 and 3 seconds.
static vtModel* openPath(const char* path, const char* interpolation, const float* values, size_t size,
                         int count, const char* shape, vtScene* scene)
{
    Builder b = beginCube();
    char rest[1000], how[64] = "";
    if (interpolation[0] != '\0') {
        snprintf(how, sizeof how, ",\"interpolation\":\"%s\"", interpolation);
    }
    ADD(&b, twoTimes, glFloat, 2, "SCALAR", "");
    addAccessor(&b, values, size, glFloat, count, shape, "");
    snprintf(rest, sizeof rest, GLASS ALL_PATHS, how, path);
    return openBuilt(build(&b, rest), scene);
}

static void setTime(vtModel* model, int animation, double seconds, vtScene* scene)
{
    vtError error = {0};
    assert_ok(vtModel_SetTime(model, animation, seconds, NULL, scene, &error), error);
}

static void assertPlace(const vtScene* scene, float x, float y, float z)
{
    const vtTransform* place = &scene->objects[0].toWorld;
    assert_near(place->rows[0][3], x, 1e-5f);
    assert_near(place->rows[1][3], y, 1e-5f);
    assert_near(place->rows[2][3], z, 1e-5f);
}

static void numbersAreInterpolated(void** state)
{
    (void)state;
    const float ends[2][3] = {{1, 2, 3}, {5, 2, -1}};
    // Tangents, of which the first and the last are of no interval.
    const float spline[6][3] = {{9, 9, 9}, {1, 2, 3}, {2, 0, 0}, {0, -4, 0}, {5, 2, -1}, {9, 9, 9}};
    vtScene scene;
    vtModel* model = openPath("translation", "", ends[0], sizeof ends, 2, "VEC3", &scene);
    assert_near((float)vtModel_Animation(model, 0)->duration, 3.0f, 0.0f);
    assert_string_equal(vtModel_Animation(model, 0)->name, "a");
    assert_null(vtModel_Animation(model, 1));
    assert_null(scene.notes);
    assertPlace(&scene, 0, 0, 0); // at rest
    setTime(model, 0, 0.0, &scene);
    assertPlace(&scene, 1, 2, 3);
    setTime(model, 0, 1.5, &scene);
    assertPlace(&scene, 2, 2, 2);
    setTime(model, 0, 3.0, &scene);
    assertPlace(&scene, 5, 2, -1);
    setTime(model, 0, 1e9, &scene);
    assertPlace(&scene, 5, 2, -1);
    setTime(model, 0, -1e300, &scene);
    assertPlace(&scene, 1, 2, 3);
    setTime(model, -1, 2.0, &scene);
    assertPlace(&scene, 0, 0, 0);
    vtCloseModel(model);
    vtDestroyScene(&scene);

    model = openPath("translation", "STEP", ends[0], sizeof ends, 2, "VEC3", &scene);
    setTime(model, 0, 2.999, &scene);
    assertPlace(&scene, 1, 2, 3);
    setTime(model, 0, 3.0, &scene);
    assertPlace(&scene, 5, 2, -1);
    vtCloseModel(model);
    vtDestroyScene(&scene);

    // At a quarter of 2 seconds: h = 27/32, 9/64, 5/32, -3/64, tangents times 2.
    model = openPath("translation", "CUBICSPLINE", spline[0], sizeof spline, 6, "VEC3", &scene);
    setTime(model, 0, 1.5, &scene);
    assertPlace(&scene, 27.0f / 32 + 2 * 2 * 9.0f / 64 + 5 * 5.0f / 32, 2 + 2 * 4 * 3.0f / 64,
                3 * 27.0f / 32 - 5.0f / 32);
    setTime(model, 0, 1.0, &scene);
    assertPlace(&scene, 1, 2, 3);
    setTime(model, 0, 3.0, &scene);
    assertPlace(&scene, 5, 2, -1);
    vtCloseModel(model);
    vtDestroyScene(&scene);
}

/// Degrees that the node is turned about z.
static float turnOf(const vtScene* scene)
{
    const vtTransform* place = &scene->objects[0].toWorld;
    return atan2f(place->rows[1][0], place->rows[0][0]) * 57.29578f;
}

static void rotationsGoTheShortWay(void** state)
{
    (void)state;
    // By 100 degrees about z; the second quaternion is negated, which is the same rotation, and not of unit
    // length.
    const float ends[2][4] = {{0, 0, 0, 1}, {0, 0, -2 * 0.76604444f, -2 * 0.64278761f}};
    const float spline[6][4] = {
        {0, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0.70710678f, 0.70710678f},
        {0, 0, 0, 0}};
    vtScene scene;
    vtModel* model = openPath("rotation", "LINEAR", ends[0], sizeof ends, 2, "VEC4", &scene);
    setTime(model, 0, 1.5, &scene); // a quarter: of the angle, not of the chord
    assert_near(turnOf(&scene), 25.0f, 1e-3f);
    setTime(model, 0, 3.0, &scene);
    assert_near(turnOf(&scene), 100.0f, 1e-3f);
    vtCloseModel(model);
    vtDestroyScene(&scene);
    model = openPath("rotation", "CUBICSPLINE", spline[0], sizeof spline, 6, "VEC4", &scene);
    setTime(model, 0, 2.0, &scene);
    assert_near(turnOf(&scene), 45.0f, 1e-3f);
    assert_near(scene.objects[0].toWorld.rows[2][2], 1.0f, 1e-5f); // of unit length
    vtCloseModel(model);
    vtDestroyScene(&scene);
    // 16-bit numbers; the same quaternion twice.
    Builder b = beginCube();
    const int16_t whole[2][4] = {{0, 0, 23170, 23170}, {0, 0, 23170, 23170}};
    char rest[1000];
    ADD(&b, twoTimes, glFloat, 2, "SCALAR", "");
    ADD(&b, whole, glShort, 2, "VEC4", ",\"normalized\":true");
    snprintf(rest, sizeof rest, GLASS ALL_PATHS, "", "rotation");
    model = openBuilt(build(&b, rest), &scene);
    setTime(model, 0, 2.0, &scene);
    assert_near(turnOf(&scene), 90.0f, 1e-2f);
    vtCloseModel(model);
    vtDestroyScene(&scene);
}

/// What is scaled to nothing, a way to hide it, stays something that can be drawn.
static void nothingBecomesFlat(void** state)
{
    (void)state;
    const float ends[2][3] = {{0, 0, 0}, {2, 0, 1}};
    vtScene scene;
    vtError error = {0};
    vtModel* model = openPath("scale", "", ends[0], sizeof ends, 2, "VEC3", &scene);
    for (int i = 0; i <= 2; ++i) {
        setTime(model, 0, 1.0 + i, &scene);
        assert_ok(vtValidateScene(&scene, &error), error);
        assert_near(scene.objects[0].toWorld.rows[0][0], (float)i, 1e-5f);
    }
    vtCloseModel(model);
    vtDestroyScene(&scene);
}

static void assertBox(const vtMesh* mesh, float ax, float ay, float az, float bx, float by, float bz)
{
    const float wanted[6] = {ax, ay, az, bx, by, bz};
    const float found[6] = {mesh->boundsMin.x, mesh->boundsMin.y, mesh->boundsMin.z,
                            mesh->boundsMax.x, mesh->boundsMax.y, mesh->boundsMax.z};
    for (int i = 0; i < 6; ++i) {
        assert_near(found[i], wanted[i], 1e-5f);
    }
}

static void weightsMoveOneNodesVertices(void** state)
{
    (void)state;
    Builder b = beginCube();
    float lifts[8][3] = {{0}}, pushes[8][3] = {{0}};
    for (int i = 4; i < 8; ++i) {
        lifts[i][1] = 4.0f;
        pushes[i][0] = 1.0f;
    }
    const float weights[4] = {0, 0, 1, -0.5f};
    ADD(&b, twoTimes, glFloat, 2, "SCALAR", "");
    ADD(&b, weights, glFloat, 4, "SCALAR", "");
    ADD(&b, lifts, glFloat, 8, "VEC3", "");
    ADD(&b, pushes, glFloat, 8, "VEC3", "");
    vtScene scene;
    vtModel* model = openBuilt(
        build(&b, GLASS ",\"meshes\":[{\"weights\":[0,2],\"primitives\":[{\"attributes\":{\"POSITION\":0},"
                        "\"indices\":1,\"material\":0,\"targets\":[{\"POSITION\":4},{\"POSITION\":5}]}]}],"
                        "\"nodes\":[{\"mesh\":0},{\"mesh\":0},{\"mesh\":0}],\"animations\":[{\"samplers\":[{"
                        "\"input\":2,\"output\":3}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,"
                        "\"path\":\"weights\"}}]}]"),
        &scene);
    assert_int_equal(scene.meshCount, 2); // the second node has its own
    assertBox(&scene.meshes[1], -1, -1, -1, 3, 1, 1);
    assert_int_equal(scene.objects[0].mesh, scene.objects[2].mesh);
    setTime(model, 0, 2.0, &scene);
    assertBox(&scene.meshes[0], -1, -1, -1, 3, 1, 1);
    assertBox(&scene.meshes[1], -1, -1, -1, 0.75f, 3, 1);
    assert_true(scene.meshes[1].normalsComputed);
    assert_int_equal(scene.meshes[1].updates, 1);
    setTime(model, 0, 2.0, &scene); // it is there already
    assert_int_equal(scene.meshes[1].updates, 1);
    setTime(model, -1, 0.0, &scene);
    assertBox(&scene.meshes[1], -1, -1, -1, 3, 1, 1);
    vtCloseModel(model);
    vtDestroyScene(&scene);
}

static void jointsMoveVertices(void** state)
{
    (void)state;
    vtScene scene;
    vtModel* model = openBuilt(buildSkinned(), &scene);
    const vtMesh* mesh = &scene.meshes[0];
    const float* tip = mesh->positions + 3 * (columnCount - 1);
    const float* normal = mesh->normals + 3 * (columnCount - 1);
    assert_near(tip[1], 1.5f, 1e-5f);
    setTime(model, 0, 1.0, &scene); // by 50 degrees about z
    assert_near(tip[0], -1.5f * sinf(50.0f / 57.29578f), 1e-4f);
    assert_near(tip[1], 1.5f * cosf(50.0f / 57.29578f), 1e-4f);
    assert_near(normal[0], -sinf(50.0f / 57.29578f), 1e-4f);
    assert_near(mesh->positions[1], -1.5f, 1e-5f); // the foot stays
    assert_near(scene.objects[0].toWorld.rows[0][3], 0.0f, 0.0f);
    setTime(model, 0, 2.0, &scene); // by 45 degrees about x
    assert_near(tip[2], 1.5f * sqrtf(0.5f), 1e-4f);
    setTime(model, -1, 0.0, &scene);
    assert_near(tip[1], 1.5f, 1e-5f);
    assert_near(normal[1], 1.0f, 1e-5f);
    vtCloseModel(model);
    vtDestroyScene(&scene);
}

/// Glass that was inside out, normals and all, is turned at every time.
static void turnedNormalsStayTurned(void** state)
{
    (void)state;
    Builder b = beginCube();
    uint8_t turned[36];
    float inward[8][3], shifts[8][3] = {{0}};
    const float weights[2] = {0, 1};
    for (int i = 0; i < 36; ++i) {
        turned[i] = cubeTriangles[i % 3 == 0 ? i : i % 3 == 1 ? i + 1 : i - 1];
    }
    for (int i = 0; i < 24; ++i) {
        inward[i / 3][i % 3] = -cubeCorners[i / 3][i % 3];
        shifts[i / 3][0] = 3.0f;
    }
    ADD(&b, twoTimes, glFloat, 2, "SCALAR", "");
    ADD(&b, weights, glFloat, 2, "SCALAR", "");
    ADD(&b, turned, glUnsignedByte, 36, "SCALAR", "");
    ADD(&b, inward, glFloat, 8, "VEC3", "");
    ADD(&b, shifts, glFloat, 8, "VEC3", "");
    vtScene scene;
    vtModel* model = openBuilt(
        build(&b,
              GLASS ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":5},"
                    "\"indices\":4,\"material\":0,\"targets\":[{\"POSITION\":6}]}]}],\"nodes\":[{\"mesh\":"
                    "0}],\"animations\":[{\"samplers\":[{\"input\":2,\"output\":3}],\"channels\":[{"
                    "\"sampler\":0,\"target\":{\"node\":0,\"path\":\"weights\"}}]}]"),
        &scene);
    setTime(model, 0, 2.0, &scene);
    const vtMesh* mesh = &scene.meshes[0];
    assertBox(mesh, 0.5f, -1, -1, 2.5f, 1, 1);
    for (int i = 0; i < 8; ++i) {
        assert_true((mesh->positions[3 * i] - 1.5f) * mesh->normals[3 * i] > 0.0f); // outwards
    }
    vtCloseModel(model);
    vtDestroyScene(&scene);
}

/// In a scene that has something before it, placed by a transform.
static void modelsLieInOtherScenes(void** state)
{
    (void)state;
    const float ends[2][3] = {{1, 2, 3}, {5, 2, -1}};
    vtScene scene, other;
    vtError error = {0};
    vtModel* model = openPath("translation", "", ends[0], sizeof ends, 2, "VEC3", &other);
    vtMesh mesh;
    const vtMaterial glass = vtDefaultMaterial();
    assert_ok(vtCreateShape("sphere", &mesh, &error), error);
    assert_ok(vtCreateMeshScene(&mesh, &glass, &scene, &error), error);
    const vtTransform twice = {{{2, 0, 0, 10}, {0, 2, 0, 0}, {0, 0, 2, 0}}};
    const vtModelPlace place = vtScene_NextPlace(&scene, &twice);
    assert_ok(vtScene_Append(&scene, &other, &twice, &error), error);
    assert_ok(vtModel_SetTime(model, 0, 2.0, &place, &scene, &error), error);
    assert_near(scene.objects[1].toWorld.rows[0][3], 16.0f, 1e-5f);
    assert_near(scene.objects[1].toWorld.rows[1][1], 2.0f, 1e-5f);
    assert_near(scene.objects[0].toWorld.rows[0][3], 0.0f, 0.0f);
    vtModelPlace wrong = place;
    wrong.object = 2;
    assert_int_equal(vtModel_SetTime(model, 0, 2.0, &wrong, &scene, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "the scene does not have there what was loaded with it"));
    assert_int_equal(vtModel_SetTime(model, 1, 0.0, &place, &scene, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "there is no animation 1; it has 1"));
    assert_int_equal(vtModel_SetTime(model, 0, NAN, &place, &scene, &error), vt_errorArgument);
    vtCloseModel(model);
    vtDestroyScene(&scene);
}

static void camerasAndLightsMove(void** state)
{
    (void)state;
    Builder b = beginCube();
    const float turns[2][4] = {{0, 0, 0, 1}, {0, 1, 0, 0}};
    ADD(&b, twoTimes, glFloat, 2, "SCALAR", "");
    ADD(&b, turns, glFloat, 2, "VEC4", "");
    vtScene scene;
    vtModel* model = openBuilt(
        build(&b, GLASS ",\"meshes\":[" CUBE_MESH
                        "],\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}],"
                        "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"directional\"}]}},"
                        "\"nodes\":[{\"mesh\":0},{\"children\":[2,3]},{\"camera\":0,\"translation\":[0,0,6]},"
                        "{\"translation\":[2,0,0],\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],"
                        "\"animations\":[{\"samplers\":[{\"input\":2,\"output\":3}],\"channels\":[{"
                        "\"sampler\":0,\"target\":{\"node\":1,\"path\":\"rotation\"}}]}]"),
        &scene);
    assert_near(scene.cameras[0].view.eye.z, 6.0f, 1e-5f);
    setTime(model, 0, 2.0, &scene); // by 90 degrees about y: z goes to x
    assert_near(scene.cameras[0].view.eye.x, 6.0f, 1e-5f);
    assert_near(scene.cameras[0].view.target.x, 0.0f, 1e-5f);
    assert_near(scene.lights[0].position.z, -2.0f, 1e-5f);
    assert_near(scene.lights[0].direction.x, -1.0f, 1e-5f);
    vtCloseModel(model);
    vtDestroyScene(&scene);
}

#define POINTER(number, text)                                                                                \
    "{\"sampler\":" number ",\"target\":{\"path\":\"pointer\",\"extensions\":{\"KHR_animation_pointer\":{"   \
    "\"pointer\":\"" text "\"}}}}"

static void pointersMoveMaterials(void** state)
{
    (void)state;
    Builder b = beginCube();
    const float colors[2][4] = {{1, 1, 1, 1}, {0, 0.5f, 2, 0.5f}}, iors[2] = {1.5f, 2.5f};
    const float places[2][3] = {{0, 0, 0}, {4, 0, 0}};
    ADD(&b, twoTimes, glFloat, 2, "SCALAR", "");
    ADD(&b, colors, glFloat, 2, "VEC4", "");
    ADD(&b, iors, glFloat, 2, "SCALAR", "");
    ADD(&b, places, glFloat, 2, "VEC3", "");
    vtScene scene;
    vtModel* model = openBuilt(
        build(
            &b, GLASS
            ",\"meshes\":[" CUBE_MESH "],\"nodes\":[{\"mesh\":0}],\"animations\":[{\"samplers\":["
            "{\"input\":2,\"output\":3},{\"input\":2,\"output\":4},{\"input\":2,\"output\":"
            "5}],"
            "\"channels\":[" POINTER(
                "0",
                "/materials/0/pbrMetallicRoughness/"
                "baseColorFactor") "," POINTER("1",
                                               "/materials/"
                                               "0/"
                                               "extensions/"
                                               "KHR_"
                                               "materials_"
                                               "ior/ior") "," POINTER("2",
                                                                      "/nodes/0/translation") "," POINTER("0",
                                                                                                          "/m"
                                                                                                          "at"
                                                                                                          "er"
                                                                                                          "ia"
                                                                                                          "ls"
                                                                                                          "/1"
                                                                                                          "/p"
                                                                                                          "br"
                                                                                                          "Me"
                                                                                                          "ta"
                                                                                                          "ll"
                                                                                                          "ic"
                                                                                                          "Ro"
                                                                                                          "ug"
                                                                                                          "hn"
                                                                                                          "es"
                                                                                                          "s/"
                                                                                                          "ba"
                                                                                                          "se"
                                                                                                          "Co"
                                                                                                          "lo"
                                                                                                          "rF"
                                                                                                          "ac"
                                                                                                          "to"
                                                                                                          "r") "," POINTER("1",
                                                                                                                           "/materi"
                                                                                                                           "als/0/"
                                                                                                                           "occlusi"
                                                                                                                           "onTextu"
                                                                                                                           "re/"
                                                                                                                           "strengt"
                                                                                                                           "h") "," POINTER("1",
                                                                                                                                            "/cameras/0/perspective/yfov") "," POINTER("1",
                                                                                                                                                                                       "nonsense") ",{\"sampler\":0,\"target\":{\"path\":\"scale\"}}]}]"),
        &scene);
    // Of a material that is not used nothing is left out.
    assert_string_equal(scene.notes, "'x.glb': ignored: 4 channels of animations");
    setTime(model, 0, 2.0, &scene);
    assert_near(scene.materials[0].ior, 2.0f, 1e-5f);
    assert_near(scene.materials[0].tint.x, 0.5f, 1e-5f);
    assert_near(scene.materials[0].tint.y, 0.75f, 1e-5f);
    assert_near(scene.materials[0].tint.z, 1.0f, 1e-5f); // not above it
    assert_near(scene.materials[0].alpha, 0.75f, 1e-5f);
    assertPlace(&scene, 2, 0, 0);
    scene.materials[0].roughness = 0.25f; // the caller's, which no animation moves
    setTime(model, -1, 0.0, &scene);
    assert_near(scene.materials[0].ior, 1.5f, 1e-5f);
    assert_near(scene.materials[0].tint.x, 1.0f, 1e-5f);
    assert_near(scene.materials[0].roughness, 0.25f, 0.0f);
    vtCloseModel(model);
    vtDestroyScene(&scene);
}

static void refuse(const Builder* b, const char* animation, const char* reason)
{
    char rest[1600];
    snprintf(rest, sizeof rest,
             GLASS ",\"meshes\":[" CUBE_MESH
                   "],\"nodes\":[{\"mesh\":0},{\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,"
                   "0,0,1]}],\"animations\":[{\"name\":\"a\",%s}]",
             animation);
    const Built file = build(b, rest);
    const vtModelDef def = {.bytes = file.bytes, .size = file.size, .name = "x.glb"};
    vtModel* model;
    vtScene scene;
    vtError error = {0};
    if (vtOpenModel(&def, &model, &scene, &error) == vt_ok || strstr(error.message, reason) == NULL) {
        fail_msg("'%s' does not say '%s'", error.message, reason);
    }
    assert_null(model);
    assert_null(scene.meshes);
    free(file.bytes);
}

#define CHANNEL(path) "\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"" path "\"}}]"
#define SAMPLER(input, output) "\"samplers\":[{\"input\":" #input ",\"output\":" #output "}],"

static void damagedAnimationsAreRefused(void** state)
{
    (void)state;
    Builder b = beginCube();
    const float falling[2] = {3, 1}, broken[2] = {0, NAN}, places[2][3] = {{0}}, none[2][4] = {{0}};
    const float endless[2][3] = {{0, 0, 0}, {0, INFINITY, 0}};
    ADD(&b, twoTimes, glFloat, 2, "SCALAR", ""); // 2
    ADD(&b, places, glFloat, 2, "VEC3", "");     // 3
    ADD(&b, falling, glFloat, 2, "SCALAR", "");
    ADD(&b, broken, glFloat, 2, "SCALAR", "");
    ADD(&b, none, glFloat, 2, "VEC4", ""); // 6
    ADD(&b, endless, glFloat, 2, "VEC3", "");
    ADD(&b, places, glUnsignedInt, 2, "VEC3", ""); // 8
    addAccessorOf(&b, -1, glFloat, 16000000, "SCALAR", "");
    addAccessorOf(&b, -1, glFloat, 0, "SCALAR", ""); // 10
    addAccessorOf(&b, -1, glFloat, 0, "VEC3", "");
    static const struct {
        const char *animation, *reason;
    } cases[] = {
        {SAMPLER(2, 3) CHANNEL("rotation"), "2 values of 3 numbers for 2 keys of 4"},
        {SAMPLER(2, 3) CHANNEL("weights"), "for 2 keys of 0 numbers"},
        {SAMPLER(9, 3) CHANNEL("scale"), "2 values of 3 numbers for 16000000 keys of 3"},
        {SAMPLER(3, 3) CHANNEL("scale"), "times that are no floats"},
        {SAMPLER(8, 3) CHANNEL("scale"), "times that are no floats"},
        {SAMPLER(10, 11) CHANNEL("scale"), "0 times that are no floats or none"},
        {SAMPLER(4, 3) CHANNEL("scale"), "has the time 1 after 3, but times must be finite and rise"},
        {SAMPLER(5, 3) CHANNEL("scale"), "has the time nan after 0"},
        {SAMPLER(2, 7) CHANNEL("scale"), "has a value that is not finite"},
        {SAMPLER(2, 8) CHANNEL("scale"), "neither floats nor normalized numbers"},
        {SAMPLER(2, 6) CHANNEL("rotation"), "has a rotation of zero length"},
        {SAMPLER(2, 99) CHANNEL("scale"), "it refers to accessor 99 but has 12"},
        {SAMPLER(-1, 3) CHANNEL("scale"), "'input' that is not a whole number"},
        {CHANNEL("scale"), "it refers to sampler 0 but has 0"},
        {SAMPLER(2, 3) "\"channels\":[{\"sampler\":0,\"target\":{\"node\":7,\"path\":\"scale\"}}]",
         "it refers to node 7 but has 2"},
        {SAMPLER(2, 3) "\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"scale\"}}]",
         "node 1 has a matrix, so animations cannot move it"},
        {SAMPLER(2, 3) "\"channels\":[" POINTER("0", "/materials/3/emissiveFactor") "]",
         "it refers to material 3 but has 2"},
        {"\"samplers\":[{\"input\":2,\"output\":3,\"interpolation\":\"BOUNCE\"}]," CHANNEL("scale"),
         "animation 0, a, sampler 0, has the interpolation 'BOUNCE'"},
        {"\"samplers\":[{\"input\":2,\"output\":3,\"interpolation\":\"CUBICSPLINE\"}]," CHANNEL("scale"),
         "2 values of 3 numbers for 2 keys of 3"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        refuse(&b, cases[i].animation, cases[i].reason);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbersAreInterpolated),      cmocka_unit_test(rotationsGoTheShortWay),
        cmocka_unit_test(nothingBecomesFlat),          cmocka_unit_test(weightsMoveOneNodesVertices),
        cmocka_unit_test(jointsMoveVertices),          cmocka_unit_test(modelsLieInOtherScenes),
        cmocka_unit_test(camerasAndLightsMove),        cmocka_unit_test(pointersMoveMaterials),
        cmocka_unit_test(damagedAnimationsAreRefused), cmocka_unit_test(turnedNormalsStayTurned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
