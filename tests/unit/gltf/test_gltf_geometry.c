// Where the vertices of glTF files go: packed numbers, sparse ones, morph targets, skins, instances; and what
// is told of what is left out.
#include <math.h>

#include "gltf_builder.h"

static void assertBox(const vtMesh* mesh, float ax, float ay, float az, float bx, float by, float bz)
{
    const float tolerance = 1e-5f;
    assert_near(mesh->boundsMin.x, ax, tolerance);
    assert_near(mesh->boundsMin.y, ay, tolerance);
    assert_near(mesh->boundsMin.z, az, tolerance);
    assert_near(mesh->boundsMax.x, bx, tolerance);
    assert_near(mesh->boundsMax.y, by, tolerance);
    assert_near(mesh->boundsMax.z, bz, tolerance);
}

/// A cube of whole numbers from `low` to `high`, of a type of so many bytes, at `stride` bytes.
static void fillWhole(uint8_t* to, int bytes, int stride, int low, int high)
{
    for (int i = 0; i < 8; ++i) {
        for (int k = 0; k < 3; ++k) {
            const int value = cubeCorners[i][k] < 0 ? low : high;
            for (int n = 0; n < bytes; ++n) {
                to[stride * i + bytes * k + n] = (uint8_t)((uint32_t)value >> (8 * n));
            }
        }
    }
}

static void quantizedNumbersLoad(void** state)
{
    (void)state;
    static const struct {
        int type, bytes, low, high;
        bool normalized;
        float from, to;
    } cases[] = {
        {glByte, 1, -100, 90, false, -100, 90},
        {glByte, 1, -128, 127, true, -1, 1},
        {glUnsignedByte, 1, 3, 200, false, 3, 200},
        {glUnsignedByte, 1, 0, 51, true, 0, 0.2f},
        {glShort, 2, -30000, 20000, false, -30000, 20000},
        {glShort, 2, -32767, 0, true, -1, 0},
        {glUnsignedShort, 2, 7, 60000, false, 7, 60000},
        {glUnsignedShort, 2, 13107, 65535, true, 0.2f, 1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        Builder b = beginCube();
        uint8_t corners[64];
        const int stride = 4 * cases[i].bytes;
        fillWhole(corners, cases[i].bytes, stride, cases[i].low, cases[i].high);
        char more[32];
        snprintf(more, sizeof more, ",\"byteStride\":%d", stride);
        const int view = addView(&b, corners, 8 * (size_t)stride, more);
        addAccessorOf(&b, view, cases[i].type, 8, "VEC3", cases[i].normalized ? ",\"normalized\":true" : "");
        vtScene scene = loadBuilt(
            &b, GLASS
            ",\"extensionsRequired\":[\"KHR_mesh_quantization\"],\"meshes\":[{\"primitives\":[{"
            "\"attributes\":{\"POSITION\":2},\"indices\":1,\"material\":0}]}],\"nodes\":[{\"mesh\":0}]");
        const float from = cases[i].from, to = cases[i].to;
        assertBox(&scene.meshes[0], from, from, from, to, to, to);
        assert_int_equal(scene.meshes[0].openEdgeCount, 0);
        vtDestroyScene(&scene);
    }
}

static void quantizedNormalsAndTexcoordsLoad(void** state)
{
    (void)state;
    Builder b = beginCube();
    int8_t normals[8][4];
    int16_t texcoords[8][2];
    for (int i = 0; i < 8; ++i) {
        normals[i][0] = 127, normals[i][1] = normals[i][2] = normals[i][3] = 0;
        texcoords[i][0] = (int16_t)(i - 4), texcoords[i][1] = 2;
    }
    const int view = addView(&b, normals, sizeof normals, ",\"byteStride\":4");
    addAccessorOf(&b, view, glByte, 8, "VEC3", ",\"normalized\":true");
    ADD(&b, texcoords, glShort, 8, "VEC2", "");
    vtScene scene = loadBuilt(
        &b,
        GLASS ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":2,\"TEXCOORD_0\":3},"
              "\"indices\":1,\"material\":0}]}],\"nodes\":[{\"mesh\":0}]");
    assert_false(scene.meshes[0].normalsComputed);
    assert_near(scene.meshes[0].normals[0], 1.0f, 0.0f);
    assert_near(scene.meshes[0].texcoords[0], -4.0f, 0.0f);
    assert_near(scene.meshes[0].texcoords[15], 2.0f, 0.0f);
    vtDestroyScene(&scene);
    refuseBuilt(&b,
                GLASS
                ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"COLOR_0\":2,\"NORMAL\":3},"
                "\"indices\":1,\"material\":0}]}],\"nodes\":[{\"mesh\":0}]",
                "NORMAL as something else than three floats or normalized 8 or 16-bit numbers");
}

static void sparseAccessorsLoad(void** state)
{
    (void)state;
    Builder b = beginCube();
    const uint16_t which[4] = {4, 5, 6, 7};
    const float places[4][3] = {{3, -1, -1}, {3, -1, 1}, {3, 1, -1}, {3, 1, 1}};
    char sparse[200];
    const int indices = addView(&b, which, sizeof which, ""), values = addView(&b, places, sizeof places, "");
    snprintf(sparse, sizeof sparse,
             ",\"sparse\":{\"count\":4,\"indices\":{\"bufferView\":%d,\"componentType\":5123},\"values\":{"
             "\"bufferView\":%d}}",
             indices, values);
    addAccessorOf(&b, 0, glFloat, 8, "VEC3", sparse);
    addAccessorOf(&b, -1, glFloat, 8, "VEC3", sparse);
    addAccessorOf(&b, -1, glFloat, 8, "VEC3", ""); // zeros
    vtScene scene = loadBuilt(
        &b, GLASS ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":2,\"NORMAL\":4},\"indices\":1,"
                  "\"material\":0}]},"
                  "{\"primitives\":[{\"attributes\":{\"POSITION\":3},\"indices\":1,\"material\":0}]}],"
                  "\"nodes\":[{\"mesh\":0},{\"mesh\":1}]");
    assertBox(&scene.meshes[0], -1, -1, -1, 3, 1, 1);
    assert_true(scene.meshes[0].normalsComputed); // of zero length
    assertBox(&scene.meshes[1], 0, -1, -1, 3, 1, 1);
    assert_near(scene.meshes[1].positions[0], 0.0f, 0.0f);
    vtDestroyScene(&scene);

    // Indices without a buffer view: a mesh of triangles without area.
    addAccessorOf(&b, -1, glUnsignedShort, 36, "SCALAR", "");
    scene = loadBuilt(&b, GLASS ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"\":77},"
                                "\"indices\":5,\"material\":0}]}],"
                                "\"nodes\":[{\"mesh\":0}]");
    assert_int_equal(scene.meshes[0].degenerateCount, 12);
    vtDestroyScene(&scene);

    addAccessorOf(&b, -1, glFloat, 20000000, "VEC3", "");
    refuseBuilt(&b,
                "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":6}}]}],\"nodes\":[{\"mesh\":0}]",
                "accessor 6 has 20000000 elements without data");
}

static void morphTargetsMoveVertices(void** state)
{
    (void)state;
    Builder b = beginCube();
    int8_t moves[8][4] = {{0}};
    float lifts[8][3] = {{0}};
    for (int i = 4; i < 8; ++i) {
        moves[i][0] = 127; // x = 1 goes to 2
        lifts[i][1] = 4.0f;
    }
    const int view = addView(&b, moves, sizeof moves, ",\"byteStride\":4");
    addAccessorOf(&b, view, glByte, 8, "VEC3", ",\"normalized\":true");
    ADD(&b, lifts, glFloat, 8, "VEC3", "");
    vtScene scene =
        loadBuilt(&b, GLASS ",\"meshes\":[{\"weights\":[0.5,0],\"primitives\":[{\"attributes\":{\"POSITION\":"
                            "0,\"NORMAL\":0},\"indices\":1,"
                            "\"material\":0,\"targets\":[{\"POSITION\":2},{\"POSITION\":3,\"NORMAL\":3}]}]}],"
                            "\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"weights\":[0,0.25]},{\"mesh\":0}]");
    assert_int_equal(scene.meshCount, 2); // two shapes of one mesh of the file
    assert_int_equal(scene.objectCount, 3);
    assertBox(&scene.meshes[0], -1, -1, -1, 1.5f, 1, 1);
    assertBox(&scene.meshes[1], -1, -1, -1, 1, 2, 1);
    assert_int_equal(scene.objects[2].mesh, scene.objects[0].mesh);
    // (1, -1, -1) gets (0, 1, 0): (1, 0, -1), of unit length.
    const float* n = scene.meshes[1].normals + 12;
    assert_near(n[0], sqrtf(0.5f), 1e-5f);
    assert_near(n[1], 0.0f, 1e-5f);
    vtDestroyScene(&scene);
}

/// A cube between two joints: half of the weight on each, in `sets` sets, or all on the first.
static Builder beginSkin(bool inTwoSets)
{
    Builder b = beginCube();
    uint8_t joints[2][8][4] = {{{0}}};
    uint8_t weights[2][8][4] = {{{0}}};
    for (int i = 0; i < 8; ++i) {
        joints[0][i][1] = joints[1][i][0] = 1;
        weights[0][i][0] = 255;
        weights[0][i][1] = inTwoSets ? 0 : 255;
        weights[1][i][0] = inTwoSets ? 255 : 0;
    }
    // Their sum is 2: they are taken as shares of it.
    ADD(&b, joints[0], glUnsignedByte, 8, "VEC4", "");
    ADD(&b, weights[0], glUnsignedByte, 8, "VEC4", ",\"normalized\":true");
    ADD(&b, joints[1], glUnsignedByte, 8, "VEC4", "");
    ADD(&b, weights[1], glUnsignedByte, 8, "VEC4", ",\"normalized\":true");
    const float bind[2][16] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -5, 0, 0, 1},
                               {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    ADD(&b, bind, glFloat, 2, "MAT4", "");
    return b;
}

static void skinsPoseMeshes(void** state)
{
    (void)state;
    // The first joint stands at x = 5 in bind pose and at (5, 2, 0) now: it lifts by 2. The second, below a
    // node, and not bound elsewhere, moves by 8 along z. The mean is (0, 1, 4). The skinned node's own place
    // counts for nothing.
    static const char* const sets[] = {"\"JOINTS_0\":2,\"WEIGHTS_0\":3",
                                       "\"JOINTS_0\":2,\"WEIGHTS_0\":3,\"JOINTS_1\":4,\"WEIGHTS_1\":5"};
    for (int i = 0; i < 2; ++i) {
        const Builder b = beginSkin(i == 1);
        char rest[1000];
        snprintf(rest, sizeof rest,
                 GLASS ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,%s},\"indices\":1,"
                       "\"material\":0}]}],"
                       "\"skins\":[{\"joints\":[1,3],\"inverseBindMatrices\":6}],\"scenes\":[{\"nodes\":[0,1,"
                       "2]}],\"nodes\":[{\"mesh\":0,"
                       "\"skin\":0,\"translation\":[100,0,0]},{\"translation\":[5,2,0]},{\"translation\":[0,"
                       "0,6],\"children\":[3]},"
                       "{\"translation\":[0,0,2]}]",
                 sets[i]);
        vtScene scene = loadBuilt(&b, rest);
        assertBox(&scene.meshes[0], -1, 0, 3, 1, 2, 5);
        assert_near(scene.objects[0].toWorld.rows[0][3], 0.0f, 0.0f);
        vtDestroyScene(&scene);
    }
    Builder b = beginSkin(false);
    // Without inverse bind matrices these are the unit; the joint turns by 90 degrees about z and mirrors z.
    vtScene scene = loadBuilt(
        &b, GLASS ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":0,\"JOINTS_0\":2,"
                  "\"WEIGHTS_0\":3},\"indices\":1,"
                  "\"material\":0}]}],\"skins\":[{\"joints\":[1,1]}],\"scenes\":[{\"nodes\":[0,1]}],"
                  "\"nodes\":[{\"mesh\":0,\"skin\":0},{\"rotation\":[0,0,1,1],\"scale\":[2,1,-1]}]");
    assertBox(&scene.meshes[0], -1, -2, -1, 1, 2, 1);
    assert_true(scene.meshes[0].volume > 0.0); // it was mirrored, and turned
    const float *p = scene.meshes[0].positions, *n = scene.meshes[0].normals;
    for (int k = 0; k < 3; ++k) {
        assert_true(p[k] * n[k] > 0.0f); // outwards
    }
    assert_non_null(strstr(scene.notes, "1 mesh part of glass had their triangles inside out"));
    vtDestroyScene(&scene);
    refuseBuilt(
        &b,
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":2,\"WEIGHTS_0\":3},"
        "\"indices\":1}]}],"
        "\"skins\":[{\"joints\":[1]}],\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"skin\":0},{}]",
        "hangs on joint 1, but skin 0 has 1");
}

static void instancesArePlaced(void** state)
{
    (void)state;
    Builder b = beginCube();
    const float places[3][3] = {{1, 2, 3}, {-4, 0, 0}, {0, 0, 0}},
                scales[3][3] = {{1, 1, 1}, {2, 3, 4}, {0, 0, 0}};
    const int16_t turns[3][4] = {{0, 0, 0, 32767}, {0, 0, 23170, 23170}, {0, 0, 0, 32767}};
    ADD(&b, places, glFloat, 3, "VEC3", "");
    ADD(&b, turns, glShort, 3, "VEC4", ",\"normalized\":true");
    ADD(&b, scales, glFloat, 3, "VEC3", "");
    const char* rest = GLASS ",\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\"],\"meshes\":[" CUBE_MESH
                             "],\"nodes\":[{\"mesh\":0,"
                             "\"translation\":[10,0,0],\"extensions\":{\"EXT_mesh_gpu_instancing\":{"
                             "\"attributes\":{\"TRANSLATION\":2,\"ROTATION\":3,"
                             "\"SCALE\":4,\"_ID\":0.5}}}}]";
    vtScene scene = loadBuilt(&b, rest);
    assert_int_equal(scene.meshCount, 1);
    assert_int_equal(scene.objectCount, 2); // the third is scaled to nothing
    assert_near(scene.objects[0].toWorld.rows[0][3], 11.0f, 1e-5f);
    assert_near(scene.objects[0].toWorld.rows[2][3], 3.0f, 1e-5f);
    assert_near(scene.objects[1].toWorld.rows[0][3], 6.0f, 1e-5f);
    // Scaled by (2, 3, 4), then turned by 90 degrees about z: x goes to y.
    assert_near(scene.objects[1].toWorld.rows[1][0], 2.0f, 1e-4f);
    assert_near(scene.objects[1].toWorld.rows[0][1], -3.0f, 1e-4f);
    assert_near(scene.objects[1].toWorld.rows[2][2], 4.0f, 1e-4f);
    vtDestroyScene(&scene);
    ADD(&b, places, glFloat, 2, "VEC3", "");
    refuseBuilt(&b,
                "\"meshes\":[" CUBE_MESH
                "],\"materials\":[{}],\"nodes\":[{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":"
                "{\"attributes\":{\"TRANSLATION\":2,\"SCALE\":5}}}}]",
                "the instances of node 0 have 2 of SCALE");
    addAccessorOf(&b, -1, glFloat, 5000, "VEC3", "");
    refuseBuilt(&b,
                "\"meshes\":[" CUBE_MESH
                "],\"materials\":[{}],\"nodes\":[{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":"
                "{\"attributes\":{\"TRANSLATION\":6}}}}]",
                "node 0 has 5000 instances but there can be 4096");
}

static void insideOutGlassIsTurned(void** state)
{
    (void)state;
    Builder b = beginCube();
    uint8_t turned[36];
    float inward[8][3];
    for (int i = 0; i < 36; ++i) {
        turned[i] = cubeTriangles[i % 3 == 0 ? i : i % 3 == 1 ? i + 1 : i - 1];
    }
    for (int i = 0; i < 24; ++i) {
        inward[i / 3][i % 3] = -cubeCorners[i / 3][i % 3];
    }
    ADD(&b, turned, glUnsignedByte, 36, "SCALAR", "");
    ADD(&b, inward, glFloat, 8, "VEC3", "");
    // Inward normals, outward normals, none, opaque.
    vtScene scene = loadBuilt(
        &b, GLASS
        ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":3},\"indices\":2,"
        "\"material\":0}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":0},\"indices\":2,\"material\":0}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":2,\"material\":0}]},"
        "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":2,\"material\":1}]}],"
        "\"nodes\":[{\"mesh\":0},{\"mesh\":1},{\"mesh\":2},{\"mesh\":3}]");
    for (int i = 0; i < 3; ++i) {
        assert_near((float)scene.meshes[i].volume, 8.0f, 1e-4f);
        assert_true(scene.meshes[i].normals[0] * scene.meshes[i].positions[0] > 0.0f);
    }
    assert_near((float)scene.meshes[3].volume, -8.0f, 1e-4f); // a room, seen from inside
    assert_string_equal(scene.notes,
                        "'x.glb': 3 mesh parts of glass had their triangles inside out and were turned");
    vtDestroyScene(&scene);
}

static void hiddenNodesAreLeftOut(void** state)
{
    (void)state;
    Builder b = beginCube();
    vtScene scene =
        loadBuilt(&b, GLASS ",\"meshes\":[" CUBE_MESH
                            "],\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},{\"children\":[2],"
                            "\"extensions\":{\"KHR_node_visibility\":{\"visible\":false}}},{\"mesh\":0}]");
    assert_int_equal(scene.objectCount, 1);
    vtDestroyScene(&scene);
}

/// Keys that mean something else where others define them; what is told to be left out.
static void whatIsNotReadDoesNoHarm(void** state)
{
    (void)state;
    Builder b = beginCube();
    vtScene scene = loadBuilt(
        &b, "\"extras\":{\"count\":\"many\",\"scene\":-1},\"extensionsUsed\":[\"ACME_motion\",\"KHR_"
            "materials_sheen\"],"
            "\"extensions\":{\"ACME_x\":[1],\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"point\"}]},"
            "\"KHR_materials_"
            "variants\":{\"variants\":"
            "[{\"name\":\"a\"}]}},\"animations\":[{\"channels\":[],\"samplers\":[{\"input\":-1}]},{},{}],"
            "\"materials\":[{\"extras\":{\"index\":1e99},\"extensions\":{"
            "\"KHR_materials_transmission\":"
            "{\"transmissionFactor\":1},\"KHR_materials_sheen\":{\"index\":\"x\"},\"ACME_x\":{\"mode\":\"y\","
            "\"source\":-3}}},"
            "{},{\"alphaMode\":\"BLEND\"}],"
            "\"meshes\":[{\"extras\":{\"targetNames\":[\"a\"]},\"primitives\":[{\"attributes\":{\"POSITION\":"
            "0,\"_TEMPERATURE\":\"hot\"},"
            "\"indices\":1,\"material\":0,\"extras\":{\"mode\":\"loop\"}},{\"attributes\":{\"POSITION\":0},"
            "\"indices\":1,\"material\":1},"
            "{\"attributes\":{\"POSITION\":0},\"mode\":1},{\"attributes\":{\"POSITION\":0},\"mode\":0}]}],"
            "\"nodes\":[{\"mesh\":0,\"extensions\":{\"ACME_motion\":{\"mode\":\"loop\",\"index\":-1,"
            "\"source\":\"studio\",\"count\":0.5}},"
            "\"extras\":[{\"mesh\":\"x\"}],\"mode\":\"free\"}]");
    assert_int_equal(scene.objectCount, 2);
    assert_string_equal(scene.notes, "'x.glb': ignored: 3 animations, 1 variant, extension ACME_motion, "
                                     "KHR_materials_sheen of 1 material, "
                                     "points and lines of 2 primitives");
    vtScene other =
        loadBuilt(&b, GLASS ",\"animations\":[{}],\"meshes\":[" CUBE_MESH "],\"nodes\":[{\"mesh\":0}]");
    const vtTransform place = vtIdentityTransform();
    vtError error = {0};
    assert_ok(vtScene_Append(&scene, &other, &place, &error), error);
    const char* last = strrchr(scene.notes, '\n');
    assert_non_null(last);
    assert_string_equal(last + 1, "'x.glb': ignored: 1 animation");
    vtDestroyScene(&scene);
    scene = loadBuilt(&b, GLASS ",\"meshes\":[" CUBE_MESH "],\"nodes\":[{\"mesh\":0}]");
    assert_null(scene.notes);
    vtDestroyScene(&scene);
}

// ----------------------------------------------------------------------------------------------- files

typedef struct Asked {
    char path[200];
    int count;
} Asked;

static vtResult readAnything(const char* path, size_t limit, uint8_t** bytes, size_t* size, void* userData,
                             vtError* error)
{
    Asked* asked = userData;
    (void)error;
    assert_true(limit >= 264);
    snprintf(asked->path, sizeof asked->path, "%s", path);
    ++asked->count;
    *bytes = calloc(264, 1);
    *size = 264;
    return vt_ok;
}

static void filesOutsideAreNotAskedFor(void** state)
{
    (void)state;
    static const struct {
        const char *uri, *directory, *root, *asked; ///< NULL: it is refused
    } cases[] = {
        {"a.bin", "models", NULL, "models/a.bin"},
        {"./b/../a.bin", "models", NULL, "models/./b/../a.bin"},
        {"b/%61.bin", "/x/models/", NULL, "/x/models/b/a.bin"},
        {"..a/...", "models", NULL, "models/..a/..."},
        {"a.bin", "", NULL, "a.bin"},
        {"../a.bin", "models", NULL, NULL},
        {"../models2/a.bin", "models", NULL, NULL},
        {"%2e%2e/a.bin", "models", NULL, NULL},
        {"b/..%2f..%2Fa.bin", "models", NULL, NULL},
        {"../../../../../../dev/zero", "/x/models", NULL, NULL},
        {"/dev/zero", "models", NULL, NULL},
        {"%2fdev/zero", "", NULL, NULL},
        {"../a.bin", "", NULL, NULL},
        {"..", "models", NULL, NULL},
        {".", "models", NULL, NULL},
        {"", "models", NULL, NULL},
        {"a%00.bin", "models", NULL, NULL},
        {"file:///dev/zero", "models", NULL, NULL},
        {"https://example.org/a.bin", "models", NULL, NULL},
        {"../textures/a.bin", "/x/models", "/x", "/x/models/../textures/a.bin"},
        {"/x/a.bin", "/x/models", "/x", "/x/a.bin"},
        {"../../a.bin", "/x/models", "/x", NULL},
        {"../../xy/a.bin", "/x/models", "/x", NULL},
        {"a.bin", "/x/models", "/y", "/x/models/a.bin"},
        {"/etc/a.bin", "/x/models", "/", "/etc/a.bin"},
    };
    Builder b = {0};
    addAccessorOf(&b, -1, glFloat, 3, "VEC3", "");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        char json[600];
        snprintf(
            json, sizeof json,
            "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}],"
            "\"bufferViews\":[{\"buffer\":0,"
            "\"byteLength\":36}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
            "\"type\":\"VEC3\"}],"
            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]}",
            cases[i].uri);
        Asked asked = {0};
        const vtModelDef def = {.bytes = json,
                                .size = strlen(json),
                                .name = "x.gltf",
                                .directory = cases[i].directory,
                                .root = cases[i].root,
                                .readFile = readAnything,
                                .userData = &asked};
        vtScene scene;
        vtError error = {0};
        const vtResult result = vtLoadScene(&def, &scene, &error);
        if (cases[i].asked != NULL) {
            assert_ok(result, error);
            assert_string_equal(asked.path, cases[i].asked);
        } else if (asked.count > 0 || result != vt_errorFile ||
                   strstr(error.message, "its buffer '") == NULL) {
            fail_msg("'%s': asked for '%s': %s", cases[i].uri, asked.path, error.message);
        }
        vtDestroyScene(&scene);
    }
}

/// Tells how much the loader would take.
static vtResult readMuch(const char* path, size_t limit, uint8_t** bytes, size_t* size, void* userData,
                         vtError* error)
{
    size_t* left = userData;
    (void)path, (void)error;
    *left = limit;
    *bytes = calloc(36, 1);
    *size = 36;
    return vt_ok;
}

static void filesShareABudget(void** state)
{
    (void)state;
    char json[] = "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36,\"uri\":\"a\"},{"
                  "\"byteLength\":36,\"uri\":\"b\"}],"
                  "\"meshes\":[{\"primitives\":[]}],\"nodes\":[{\"mesh\":0}]}";
    size_t left = 0;
    const vtModelDef def = {
        .bytes = json, .size = strlen(json), .name = "x.gltf", .readFile = readMuch, .userData = &left};
    vtScene scene;
    vtError error = {0};
    assert_int_equal(vtLoadScene(&def, &scene, &error), vt_errorGeometry); // no triangles, but both were read
    assert_int_equal(left, vtDefaultLimits().memory - 36);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quantizedNumbersLoad),    cmocka_unit_test(quantizedNormalsAndTexcoordsLoad),
        cmocka_unit_test(sparseAccessorsLoad),     cmocka_unit_test(morphTargetsMoveVertices),
        cmocka_unit_test(skinsPoseMeshes),         cmocka_unit_test(instancesArePlaced),
        cmocka_unit_test(insideOutGlassIsTurned),  cmocka_unit_test(hiddenNodesAreLeftOut),
        cmocka_unit_test(whatIsNotReadDoesNoHarm), cmocka_unit_test(filesOutsideAreNotAskedFor),
        cmocka_unit_test(filesShareABudget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
