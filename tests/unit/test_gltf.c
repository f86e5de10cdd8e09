// glTF files built in memory: a cube in every form, each way a file can be wrong, and files cut or corrupted
// at every byte, which must never crash (run under the sanitizers).
#include <math.h>

#include "testing.h"

// 8 corners, diagonal normals, 12 triangles.
enum {
    positionBytes = 96,
    indexBytes = 72,
    normalBytes = 96,
    binBytes = positionBytes + indexBytes + normalBytes
};

static const char cubeJson[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":2},\"indices\":1,\"material\":0}"
    "]}],"
    "\"materials\":[{\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.45}}}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\"},"
    "{\"bufferView\":1,\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\"},"
    "{\"bufferView\":2,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":96},{\"buffer\":0,\"byteOffset\":96,\"byteLength\":72},"
    "{\"buffer\":0,\"byteOffset\":168,\"byteLength\":96}],"
    "\"buffers\":[{\"byteLength\":264}]}";

static const uint16_t cubeIndices[36] = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                         2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};

static void fillCube(uint8_t bin[binBytes])
{
    for (int i = 0; i < 8; ++i) { // bit 2 of a corner's number is x, bit 1 y, bit 0 z
        const float corner[3] = {i & 4 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 1 ? 1.0f : -1.0f};
        memcpy(bin + 12 * i, corner, 12);
        memcpy(bin + positionBytes + indexBytes + 12 * i, corner, 12);
    }
    // The list above is clockwise seen from outside: turn each triangle round.
    for (int t = 0; t < 12; ++t) {
        const uint16_t triangle[3] = {cubeIndices[3 * t], cubeIndices[3 * t + 2], cubeIndices[3 * t + 1]};
        memcpy(bin + positionBytes + 6 * t, triangle, 6);
    }
}

typedef struct File {
    uint8_t* bytes;
    size_t size;
} File;

static void putU32(uint8_t* to, size_t value)
{
    for (int i = 0; i < 4; ++i) {
        to[i] = (uint8_t)(value >> (8 * i));
    }
}

static File makeGlb(const char* json, const uint8_t* bin, size_t binSize)
{
    const size_t jsonSize = (strlen(json) + 3) / 4 * 4;
    File file = {.size = 12 + 8 + jsonSize + (bin != NULL ? 8 + binSize : 0)};
    file.bytes = malloc(file.size);
    memset(file.bytes, ' ', file.size);
    memcpy(file.bytes, "glTF\2\0\0\0", 8);
    putU32(file.bytes + 8, file.size);
    putU32(file.bytes + 12, jsonSize);
    memcpy(file.bytes + 16, "JSON", 4);
    memcpy(file.bytes + 20, json, strlen(json));
    if (bin != NULL) {
        uint8_t* chunk = file.bytes + 20 + jsonSize;
        putU32(chunk, binSize);
        memcpy(chunk + 4, "BIN\0", 4);
        memcpy(chunk + 8, bin, binSize);
    }
    return file;
}

/// `text` with the first `find` replaced; the caller frees it. Without `find` a plain copy.
static char* replaced(const char* text, const char* find, const char* replacement)
{
    const char* at = find != NULL ? strstr(text, find) : text;
    if (at == NULL) {
        fail_msg("the test looks for '%s', which the JSON does not have", find);
        return NULL;
    }
    const size_t before = (size_t)(at - text), skipped = find != NULL ? strlen(find) : 0;
    const size_t capacity = strlen(text) + (find != NULL ? strlen(replacement) : 0) + 1;
    char* result = malloc(capacity);
    snprintf(result, capacity, "%.*s%s%s", (int)before, text, find != NULL ? replacement : "", at + skipped);
    return result;
}

static File makeCube(const char* find, const char* replacement)
{
    uint8_t bin[binBytes];
    fillCube(bin);
    char* json = replaced(cubeJson, find, replacement);
    const File file = makeGlb(json, bin, sizeof bin);
    free(json);
    return file;
}

static vtResult load(File file, vtModel* model, vtError* error)
{
    const vtModelDef def = {.bytes = file.bytes, .size = file.size, .name = "x.glb"};
    return vtLoadModel(&def, model, error);
}

static vtModel loadCube(const char* find, const char* replacement)
{
    const File file = makeCube(find, replacement);
    vtModel model;
    vtError error = {0};
    assert_ok(load(file, &model, &error), error);
    free(file.bytes);
    return model;
}

/// The enclosed volume: positive where the triangles face outwards.
static float volume(const vtMesh* mesh)
{
    float sum = 0.0f;
    for (uint32_t i = 0; i < mesh->indexCount; i += 3) {
        const float* a = mesh->positions + 3 * mesh->indices[i];
        const float* b = mesh->positions + 3 * mesh->indices[i + 1];
        const float* c = mesh->positions + 3 * mesh->indices[i + 2];
        sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    return sum / 6.0f;
}

/// Every normal must point away from the centre of a cube, whatever was done to it.
static void expectOutwardNormals(const vtMesh* mesh)
{
    const float centre[3] = {0.5f * (mesh->boundsMin.x + mesh->boundsMax.x),
                             0.5f * (mesh->boundsMin.y + mesh->boundsMax.y),
                             0.5f * (mesh->boundsMin.z + mesh->boundsMax.z)};
    for (uint32_t i = 0; i < mesh->vertexCount; ++i) {
        float outward = 0.0f;
        for (int k = 0; k < 3; ++k) {
            outward +=
                mesh->normals[3 * i + (uint32_t)k] * (mesh->positions[3 * i + (uint32_t)k] - centre[k]);
        }
        assert_true(outward > 0.0f);
    }
}

// ------------------------------------------------------------------------------------------- what must work

static void cubeLoads(void** state)
{
    (void)state;
    vtModel model = loadCube(NULL, NULL);
    assert_int_equal(model.mesh.vertexCount, 8);
    assert_int_equal(model.mesh.indexCount, 36);
    assert_int_equal(model.mesh.openEdgeCount, 0);
    assert_false(model.mesh.normalsComputed);
    assert_near(volume(&model.mesh), 8.0f, 1e-5f);
    assert_near(model.ior, 1.45f, 1e-6f);
    expectOutwardNormals(&model.mesh);
    vtDestroyModel(&model);
    assert_null(model.mesh.positions);
    vtDestroyModel(&model);
}

/// What is not wrong: each variant gives a cube of that volume.
static void variantsLoad(void** state)
{
    (void)state;
    static const struct {
        const char *find, *replacement;
        float volume, ior;
    } variants[] = {
        {"\"scene\":0,", "", 8.0f, 1.45f},                                 // the first scene
        {"\"scene\":0,\"scenes\":[{\"nodes\":[0]}],", "", 8.0f, 1.45f},    // no scenes: root nodes
        {",\"NORMAL\":2", "", 8.0f, 1.45f},                                // normals computed
        {",\"material\":0", "", 8.0f, 0.0f},                               // no material
        {"\"ior\":1.45", "\"ior\":2", 8.0f, 2.0f},                         // a whole number
        {"\"ior\":1.45", "", 8.0f, 1.5f},                                  // the extension's default
        {"KHR_materials_ior", "KHR_materials_sheen", 8.0f, 0.0f},          // another extension
        {"\"count\":8", "\"count\":8.0", 8.0f, 1.45f},                     // still a whole number
        {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[2,3,1]}", 48.0f, 1.45f},  //
        {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[-2,1,1]}", 16.0f, 1.45f}, // mirrored: still outward
        {"{\"mesh\":0}", "{\"mesh\":0,\"rotation\":[0,0.6,0,0.8]}", 8.0f, 1.45f},
        {"{\"mesh\":0}", "{\"mesh\":0,\"matrix\":[0,1,0,0,1,0,0,0,0,0,1,0,5,6,7,1]}", 8.0f,
         1.45f}, // mirrored
        {"{\"mesh\":0}", "{\"children\":[1],\"scale\":[1,1,2]},{\"mesh\":0,\"translation\":[1,0,0]}", 16.0f,
         1.45f},
        {"\"asset\":",
         "\"images\":[{\"bufferView\":0,\"mimeType\":\"image/png\"},{\"uri\":\"no.png\"}],\"asset\":", 8.0f,
         1.45f}, // pictures are not looked at
        {"\"asset\":", "\"extensionsRequired\":[\"KHR_materials_ior\"],\"asset\":", 8.0f, 1.45f},
        {"\"asset\":", "\"extras\":{\"count\":-1,\"a\":[{\"mesh\":\"b\"}]},\"asset\":", 8.0f, 1.45f},
        {"\"primitives\":[", "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":1},", 8.0f,
         1.45f}, // lines
    };
    for (size_t i = 0; i < sizeof variants / sizeof variants[0]; ++i) {
        vtModel model = loadCube(variants[i].find, variants[i].replacement);
        assert_near(volume(&model.mesh), variants[i].volume, 1e-4f);
        assert_near(model.ior, variants[i].ior, 1e-6f);
        assert_int_equal(model.mesh.openEdgeCount, 0);
        expectOutwardNormals(&model.mesh);
        vtDestroyModel(&model);
    }
}

static void normalsGoByInverseTranspose(void** state)
{
    (void)state;
    vtModel model = loadCube("{\"mesh\":0}", "{\"mesh\":0,\"scale\":[2,-1,1]}");
    for (uint32_t i = 0; i < 8; ++i) { // (1, 1, 1) becomes (1/2, -1, 1) / 1.5 at (2, -1, 1)
        const float* p = model.mesh.positions + 3 * i;
        const float* n = model.mesh.normals + 3 * i;
        assert_near(n[0], p[0] / 6.0f, 1e-6f);
        assert_near(n[1], p[1] / 1.5f, 1e-6f);
        assert_near(n[2], p[2] / 1.5f, 1e-6f);
    }
    vtDestroyModel(&model);
}

static void transformsFollowTheHierarchy(void** state)
{
    (void)state;
    // A quarter turn about z, then a shift: the child's +x offset of 3 becomes +y.
    vtModel model =
        loadCube("{\"mesh\":0}", "{\"children\":[1],\"rotation\":[0,0,1,1],\"translation\":[10,0,0]},"
                                 "{\"mesh\":0,\"translation\":[3,0,0]}");
    assert_near(model.mesh.boundsMin.x, 9.0f, 1e-5f);
    assert_near(model.mesh.boundsMin.y, 2.0f, 1e-5f);
    assert_near(model.mesh.boundsMax.y, 4.0f, 1e-5f);
    assert_near(model.mesh.boundsMax.z, 1.0f, 1e-5f);
    vtDestroyModel(&model);
}

static void primitivesAreMerged(void** state)
{
    (void)state;
    vtModel model =
        loadCube("\"primitives\":[", "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1},");
    assert_int_equal(model.mesh.vertexCount, 16);
    assert_int_equal(model.mesh.indexCount, 72);
    assert_true(model.mesh.normalsComputed); // for the primitive that has none
    assert_near(volume(&model.mesh), 16.0f, 1e-4f);
    expectOutwardNormals(&model.mesh);
    for (uint32_t i = 8; i < 16; ++i) { // those of the other are the file's
        assert_near(fabsf(model.mesh.normals[3 * i]), 0.57735f, 1e-5f);
    }
    vtDestroyModel(&model);
}

static void stripsAndFansBecomeTriangles(void** state)
{
    (void)state;
    vtModel strip = loadCube("\"indices\":1,", "\"mode\":5,");
    assert_int_equal(strip.mesh.indexCount, 18);
    const uint32_t stripStart[9] = {0, 1, 2, 1, 3, 2, 2, 3, 4};
    assert_memory_equal(strip.mesh.indices, stripStart, sizeof stripStart);
    vtDestroyModel(&strip);
    vtModel fan = loadCube("\"indices\":1,", "\"mode\":6,");
    assert_int_equal(fan.mesh.indexCount, 18);
    const uint32_t fanStart[6] = {1, 2, 0, 2, 3, 0};
    assert_memory_equal(fan.mesh.indices, fanStart, sizeof fanStart);
    vtDestroyModel(&fan);
}

static void indicesOfAllWidthsLoad(void** state)
{
    (void)state;
    static const int componentTypes[2] = {5121, 5125};
    for (int i = 0; i < 2; ++i) {
        uint8_t bin[positionBytes + 36 * 4] = {0}, cube[binBytes];
        fillCube(cube);
        memcpy(bin, cube, positionBytes);
        for (int k = 0; k < 36; ++k) {
            bin[positionBytes + (i == 0 ? k : 4 * k)] = cube[positionBytes + 2 * k];
        }
        char json[1024];
        snprintf(json, sizeof json,
                 "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{"
                 "\"attributes\":{\"POSITION\":0},\"indices\":1}]}],\"accessors\":[{\"bufferView\":0,"
                 "\"componentType\":5126,\"count\":8,\"type\":\"VEC3\"},{\"bufferView\":0,\"byteOffset\":96,"
                 "\"componentType\":%d,\"count\":36,\"type\":\"SCALAR\"}],\"bufferViews\":[{\"buffer\":0,"
                 "\"byteLength\":240}],\"buffers\":[{\"byteLength\":240}]}",
                 componentTypes[i]);
        const File file = makeGlb(json, bin, sizeof bin);
        vtModel model;
        vtError error = {0};
        assert_ok(load(file, &model, &error), error);
        assert_near(volume(&model.mesh), 8.0f, 1e-5f);
        assert_true(model.mesh.normalsComputed);
        expectOutwardNormals(&model.mesh);
        vtDestroyModel(&model);
        free(file.bytes);
    }
}

// ---------------------------------------------------------------------------------------- external buffers

static bool readCubeBin(const char* path, uint8_t** bytes, size_t* size, void* userData)
{
    if (strcmp(path, "models/my cube.bin") != 0) {
        return false;
    }
    *size = *(const size_t*)userData;
    *bytes = malloc(binBytes);
    fillCube(*bytes);
    return true;
}

static void externalBuffersAreRead(void** state)
{
    (void)state;
    char* json = replaced(cubeJson, "{\"byteLength\":264}", "{\"byteLength\":264,\"uri\":\"my%20cube.bin\"}");
    size_t size = binBytes;
    vtModelDef def = {.bytes = json, .size = strlen(json), .name = "x.gltf", .directory = "models"};
    vtModel model;
    vtError error = {0};
    assert_int_equal(vtLoadModel(&def, &model, &error), vt_errorFile);
    assert_non_null(strstr(error.message, "my cube.bin"));

    def.readFile = readCubeBin;
    def.userData = &size;
    assert_ok(vtLoadModel(&def, &model, &error), error);
    assert_near(volume(&model.mesh), 8.0f, 1e-5f);
    vtDestroyModel(&model);

    size = 100;
    assert_int_equal(vtLoadModel(&def, &model, &error), vt_errorFormat);
    assert_non_null(strstr(error.message, "should have 264 bytes but has 100"));
    def.directory = "elsewhere/";
    assert_int_equal(vtLoadModel(&def, &model, &error), vt_errorFile);
    assert_non_null(strstr(error.message, "'elsewhere/my cube.bin' cannot be read"));
    free(json);
}

static void dataUrisAreRead(void** state)
{
    (void)state;
    // One triangle, (0,0,0) (1,0,0) (0,1,0), as base64.
    const char json[] =
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{"
        "\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
        "\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";
    vtModelDef def = {.bytes = json, .size = strlen(json), .name = "x.gltf"};
    vtModel model;
    vtError error = {0};
    assert_ok(vtLoadModel(&def, &model, &error), error);
    assert_int_equal(model.mesh.indexCount, 3);
    assert_near(model.mesh.boundsMax.x + model.mesh.boundsMax.y, 2.0f, 0.0f);
    vtDestroyModel(&model);
    static const char* const bad[][3] = {
        {"AAAAAAAAAAAAAAAAAACAPw", "", "should have 36 bytes but has 19"},
        {"octet-stream", "x", "data URI of buffer 0 cannot be decoded"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        char* text = replaced(json, bad[i][0], bad[i][1]);
        def.bytes = text;
        def.size = strlen(text);
        assert_int_equal(vtLoadModel(&def, &model, &error), vt_errorFormat);
        if (strstr(error.message, bad[i][2]) == NULL) {
            fail_msg("'%s' does not say '%s'", error.message, bad[i][2]);
        }
        free(text);
    }
}

// -------------------------------------------------------------------------------------------- what is wrong

static void expectFailure(File file, vtResult expected, const char* reason)
{
    vtModel model;
    memset(&model, 0xFF, sizeof model);
    vtError error = {0};
    const vtResult result = load(file, &model, &error);
    if (result != expected || strstr(error.message, reason) == NULL) {
        fail_msg("result %d and '%s' instead of %d and '%s'", result, error.message, expected, reason);
    }
    assert_int_equal(error.result, expected);
    assert_non_null(strstr(error.message, "x.glb"));
    assert_null(strchr(error.message, '\n'));
    assert_null(model.mesh.positions);
    assert_int_equal(model.mesh.indexCount, 0);
}

static const struct {
    const char *find, *replacement;
    vtResult result;
    const char* reason;
} badCubes[] = {
    // accessors and what is under them
    {"\"POSITION\":0", "\"POSITION\":9", vt_errorFormat, "accessor 9 but has 3"},
    {"\"NORMAL\":2", "\"NORMAL\":3", vt_errorFormat, "accessor 3 but has 3"},
    {"\"indices\":1", "\"indices\":7", vt_errorFormat, "indices accessor out of bounds"},
    {"\"indices\":1", "\"indices\":4294967297", vt_errorFormat, "'indices' that is not a whole number"},
    {"\"POSITION\":0", "\"POSITION\":-1", vt_errorFormat, "'POSITION' that is not a whole number"},
    {"\"bufferView\":0", "\"bufferView\":12", vt_errorFormat, "accessor 0 has no data"},
    {"{\"bufferView\":0,", "{", vt_errorFormat, "accessor 0 has no data"},
    {"\"buffer\":0,\"byteLength\":96", "\"buffer\":1,\"byteLength\":96", vt_errorFormat,
     "buffer 1 but has 1"},
    {"\"count\":8", "\"count\":9", vt_errorFormat, "accessor 0 reads 12 bytes beyond the end of its buffer"},
    {"\"count\":8", "\"count\":2147483647", vt_errorFormat, "accessor 0 reads 25769803668 bytes beyond"},
    {"\"count\":8", "\"count\":8,\"byteOffset\":4", vt_errorFormat, "accessor 0 reads 4 bytes beyond"},
    {"\"count\":8", "\"count\":8,\"byteOffset\":-4", vt_errorFormat,
     "'byteOffset' that is not a whole number"},
    {"\"count\":8", "\"count\":8.5", vt_errorFormat, "'count' that is not a whole number"},
    {"\"byteLength\":96}", "\"byteLength\":96,\"byteStride\":16}", vt_errorFormat,
     "accessor 0 reads 28 bytes beyond"},
    {"\"byteLength\":96}", "\"byteLength\":96,\"byteStride\":8}", vt_errorFormat,
     "elements of 12 bytes every 8"},
    {"\"byteLength\":96}", "\"byteLength\":96,\"byteStride\":13}", vt_errorFormat, "byteStride"},
    {"\"byteOffset\":168", "\"byteOffset\":172", vt_errorFormat, "accessor 2 reads 4 bytes beyond"},
    {"\"byteOffset\":168", "\"byteOffset\":2000000000", vt_errorFormat, "accessor 2 reads 96 bytes beyond"},
    {"\"componentType\":5126", "\"componentType\":5123", vt_errorFormat, "POSITION as something else"},
    {"\"componentType\":5126", "\"componentType\":5127", vt_errorFormat, "componentType"},
    {"\"componentType\":5126", "\"componentType\":1", vt_errorFormat, "componentType"},
    {"\"type\":\"VEC3\"", "\"type\":\"VEC2\"", vt_errorFormat, "POSITION as something else"},
    {"\"type\":\"VEC3\"", "\"type\":\"VEC9\"", vt_errorFormat, "VEC9"},
    {"\"componentType\":5123", "\"componentType\":5122", vt_errorFormat,
     "indices that are not 8, 16 or 32-bit"},
    {"\"type\":\"SCALAR\"", "\"type\":\"VEC2\"", vt_errorFormat, "accessor 1 reads 72 bytes beyond"},
    {"\"count\":36", "\"count\":35", vt_errorGeometry, "35 corners, not a multiple of 3"},
    {"\"count\":8", "\"count\":7", vt_errorFormat, "8 normals for 7 positions"},
    {"\"bufferView\":2,\"componentType\":5126,\"count\":8",
     "\"bufferView\":2,\"componentType\":5126,\"count\":7", vt_errorFormat, "7 normals for 8 positions"},
    {"\"count\":8",
     "\"count\":8,\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":1,\"componentType\":5123},"
     "\"values\":{\"bufferView\":0}}",
     vt_errorFormat, "accessor 0 is sparse, which is not supported"},
    {"\"POSITION\":0,\"NORMAL\":2", "\"POSITION\":0,\"NORMAL\":1", vt_errorFormat,
     "NORMAL as something else"},
    {"{\"byteLength\":264}", "{\"byteLength\":265}", vt_errorFormat, "should have 265 bytes but has 264"},
    {"{\"byteLength\":264}", "{}", vt_errorFormat, "buffer 0 has no byteLength"},
    {"{\"byteLength\":264}", "3", vt_errorFormat, "buffer 0 has no byteLength"},
    {"{\"byteLength\":264}", "{\"byteLength\":0}", vt_errorFormat, "beyond the end of its buffer"},
    {"{\"byteLength\":264}", "{\"byteLength\":264,\"uri\":\"a.bin\"}", vt_errorFile, "'a.bin'"},
    {"{\"byteLength\":264}", "{\"byteLength\":264,\"uri\":5}", vt_errorFormat,
     "uri of buffer 0 is not a text"},
    // extensions
    {"\"asset\"", "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"asset\"", vt_errorFormat,
     "KHR_draco_mesh_compression"},
    {"\"asset\"", "\"extensionsRequired\":[\"EXT_meshopt_compression\"],\"asset\"", vt_errorFormat,
     "EXT_meshopt_compression"},
    {"\"asset\"", "\"extensionsRequired\":[\"KHR_mesh_quantization\"],\"asset\"", vt_errorFormat,
     "KHR_mesh_quantization"},
    // nodes and scenes
    {"\"scene\":0", "\"scene\":4", vt_errorFormat, "scene 4 but has 1"},
    {"\"nodes\":[0]", "\"nodes\":[3]", vt_errorFormat, "node 3 but has 1"},
    {"\"nodes\":[0]", "\"nodes\":[-1]", vt_errorFormat, "node -1 but has 1"},
    {"\"nodes\":[0]", "\"nodes\":[0,0]", vt_errorFormat, "node 0 is reached twice"},
    {"\"nodes\":[0]", "\"nodes\":[]", vt_errorGeometry, "no triangles"},
    {"{\"mesh\":0}", "{\"mesh\":8}", vt_errorFormat, "mesh 8 but has 1"},
    {"{\"mesh\":0}", "{\"children\":[1]},{\"children\":[0]}", vt_errorFormat, "node 0 is reached twice"},
    {"{\"mesh\":0}", "{\"mesh\":0,\"children\":[0]}", vt_errorFormat, "node 0 is reached twice"},
    {"{\"mesh\":0}", "{\"mesh\":0,\"children\":[5]}", vt_errorFormat, "node 5 but has 1"},
    {"{\"mesh\":0}", "{\"mesh\":0,\"matrix\":[1,2,3]}", vt_errorFormat, "too many or too few numbers"},
    {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[1,2,3,4]}", vt_errorFormat, "too many or too few numbers"},
    {"{\"mesh\":0}", "{\"mesh\":0,\"rotation\":[0,0,0,0]}", vt_errorFormat, "rotation of zero length"},
    {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[1e300,1,1]}", vt_errorGeometry, "x.glb"},
    {"{\"mesh\":0}", "{}", vt_errorGeometry, "no triangles"},
    // materials
    {"\"material\":0", "\"material\":6", vt_errorFormat, "material 6 but has 1"},
    {"\"ior\":1.45", "\"ior\":0.5", vt_errorFormat, "index of refraction of 0.5"},
    {"\"ior\":1.45", "\"ior\":0", vt_errorFormat, "index of refraction of 0"},
    {"\"ior\":1.45", "\"ior\":1e300", vt_errorFormat, "index of refraction of 1e+300"},
    {"\"ior\":1.45", "\"ior\":\"glass\"", vt_errorFormat, "KHR_materials_ior"},
    // primitives
    {"\"POSITION\":0,", "", vt_errorGeometry, "no triangles"},
    {"\"indices\":1", "\"mode\":0", vt_errorGeometry, "no triangles"},
    {"\"indices\":1,", "", vt_errorGeometry, "8 corners, not a multiple of 3"},
    {"\"attributes\":{\"POSITION\":0,\"NORMAL\":2},", "", vt_errorFormat, "'attributes' property is missing"},
    // the JSON itself
    {"\"version\":\"2.0\"", "\"version\":\"1.0\"", vt_errorFormat, "version '1.0'"},
    {"\"asset\"", "\"asse\"", vt_errorFormat, "asset"},
    {"\"asset\"", "asset", vt_errorFormat, "JSON is broken"},
    {"{\"asset\"", "[{\"asset\"", vt_errorFormat, "JSON is broken"},
    {"\"meshes\":[", "\"meshes\":[4,", vt_errorFormat, "not glTF"},
    {"\"nodes\":[{", "\"nodes\":[true,{", vt_errorFormat, "not glTF"},
};

static void badCubesGetSentences(void** state)
{
    (void)state;
    for (size_t i = 0; i < sizeof badCubes / sizeof badCubes[0]; ++i) {
        const File file = makeCube(badCubes[i].find, badCubes[i].replacement);
        expectFailure(file, badCubes[i].result, badCubes[i].reason);
        free(file.bytes);
    }
}

static void badIndicesAndNumbersGetSentences(void** state)
{
    (void)state;
    uint8_t bin[binBytes];
    fillCube(bin);
    bin[positionBytes] = 8;
    bin[positionBytes + 1] = 0;
    File file = makeGlb(cubeJson, bin, sizeof bin);
    expectFailure(file, vt_errorGeometry, "index 8 in accessor 1 is out of range, there are 8 vertices");
    free(file.bytes);

    fillCube(bin);
    const float notANumber = NAN;
    memcpy(bin + 4, &notANumber, 4);
    file = makeGlb(cubeJson, bin, sizeof bin);
    expectFailure(file, vt_errorGeometry, "x.glb");
    free(file.bytes);
    fillCube(bin);
    memcpy(bin + positionBytes + indexBytes, &notANumber, 4);
    file = makeGlb(cubeJson, bin, sizeof bin);
    expectFailure(file, vt_errorGeometry, "x.glb");
    free(file.bytes);
}

static void otherFilesGetSentences(void** state)
{
    (void)state;
    static const struct {
        const char* bytes;
        size_t size;
        const char* reason;
    } files[] = {
        {"", 0, "the file is empty"},
        {"hello", 5, "is not glTF"},
        {"   \n", 4, "is not glTF"},
        {"\x89PNG\r\n\x1a\n", 8, "is not glTF"},
        {"\0\0\0\0\0", 5, "is not glTF"},
        {"solid cube\nfacet normal", 22, "is not glTF"},
        {"{", 1, "JSON is broken"},
        {"{}", 2, "not glTF"},
        {"{\"asset\":{\"version\":\"2.0\"", 25, "JSON is broken"},
        {"\xEF\xBB\xBF{\"asset\":3}", 14, "not glTF"},
        {"glTF", 4, "ends within its header"},
        {"glTF\1\0\0\0\x14\0\0\0", 12, "version 1"},
        {"glTF\2\0\0\0\x14\0\0\0", 12, "should have 20 bytes but has 12"},
        {"glTF\2\0\0\0\x0c\0\0\0", 12, "does not begin with a JSON chunk"},
        {"glTF\2\0\0\0\0\0\0\0", 12, "does not begin with a JSON chunk"},
        {"glTF\2\0\0\0\x14\0\0\0\x09\0\0\0JSON", 20, "chunk at byte 12 reaches beyond"},
        {"glTF\2\0\0\0\x14\0\0\0\xff\xff\xff\xffJSON", 20, "chunk at byte 12 reaches beyond"},
        {"glTF\2\0\0\0\x14\0\0\0\0\0\0\0JSON", 20, "JSON is broken"},
        {"glTF\2\0\0\0\x14\0\0\0\0\0\0\0BIN\0", 20, "does not begin with a JSON chunk"},
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
        uint8_t* copy = malloc(files[i].size + 1);
        memcpy(copy, files[i].bytes, files[i].size);
        expectFailure((File){copy, files[i].size}, vt_errorFormat, files[i].reason);
        free(copy);
    }
}

static void missingBinChunkGetsSentence(void** state)
{
    (void)state;
    const File file = makeGlb(cubeJson, NULL, 0);
    expectFailure(file, vt_errorFormat, "buffer 0, which has no data");
    free(file.bytes);
}

/// A BIN chunk that claims the 8 bytes of its own header too: tinygltf 2.7 would read past the end.
static void binChunkLengthIsChecked(void** state)
{
    (void)state;
    const File file = makeCube(NULL, NULL);
    putU32(file.bytes + file.size - binBytes - 8, binBytes + 8);
    expectFailure(file, vt_errorFormat, "reaches beyond the end of the .glb");
    free(file.bytes);
}

static void deepNestingGetsSentences(void** state)
{
    (void)state;
    enum { depth = 100000 };
    char* arrays = malloc(2 * depth + 1);
    memset(arrays, '[', depth);
    memset(arrays + depth, ']', depth);
    arrays[2 * depth] = '\0';
    // Where it is skipped it does no harm; where tinygltf would follow it, it is refused.
    char* json = replaced("\"extensions\":{\"a\":{\"b\":@}},\"asset\":", "@", arrays);
    File file = makeCube("\"asset\":", json);
    vtModel model;
    vtError error = {0};
    assert_ok(load(file, &model, &error), error);
    vtDestroyModel(&model);
    free(file.bytes);
    free(json);
    json = replaced("\"extensions\":{\"a\":{\"b\":@},", "@", arrays);
    file = makeCube("\"extensions\":{", json);
    expectFailure(file, vt_errorFormat, "nested deeper than");
    free(file.bytes);
    free(json);
    free(arrays);

    char* nodes = malloc(40 * 2000);
    size_t length = 0;
    for (int i = 1; i < 2000; ++i) {
        length += (size_t)sprintf(nodes + length, "{\"children\":[%d]},", i);
    }
    sprintf(nodes + length, "{\"mesh\":0}");
    file = makeCube("{\"mesh\":0}", nodes);
    expectFailure(file, vt_errorFormat, "nodes are nested deeper than 1000 levels");
    free(file.bytes);
    free(nodes);
}

static void cutFilesNeverCrash(void** state)
{
    (void)state;
    const File whole = makeCube(NULL, NULL);
    for (size_t size = 0; size < whole.size; ++size) {
        uint8_t* copy = malloc(size + 1); // its own allocation, so that a sanitizer sees every byte too far
        memcpy(copy + 1, whole.bytes, size);
        expectFailure((File){copy + 1, size}, vt_errorFormat, "");
        if (size >= 20) { // again with a header that agrees, so that the cut is met further in
            putU32(copy + 1 + 8, size);
            expectFailure((File){copy + 1, size}, vt_errorFormat, "");
        }
        free(copy);
    }
    free(whole.bytes);
}

static void corruptFilesNeverCrash(void** state)
{
    (void)state;
    static const uint8_t values[] = {0,   1,   ' ', '"', '0',  '9',  '-', '[',
                                     ']', '{', '}', ',', 0x7F, 0x80, 0xFF};
    const File file = makeCube(NULL, NULL);
    const size_t jsonEnd = file.size - binBytes;
    for (size_t at = 0; at < file.size; ++at) {
        const uint8_t kept = file.bytes[at];
        for (size_t i = 0; i < sizeof values; ++i) {
            if (at >= jsonEnd && i % 4 != 0) {
                continue; // numbers and indices need fewer values
            }
            file.bytes[at] = values[i];
            vtModel model;
            vtError error = {0};
            const vtResult result = load(file, &model, &error);
            assert_true(result == vt_ok ? model.mesh.indexCount > 0 : error.message[0] != '\0');
            vtDestroyModel(&model);
        }
        file.bytes[at] = kept;
    }
    free(file.bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cubeLoads),
        cmocka_unit_test(variantsLoad),
        cmocka_unit_test(normalsGoByInverseTranspose),
        cmocka_unit_test(transformsFollowTheHierarchy),
        cmocka_unit_test(primitivesAreMerged),
        cmocka_unit_test(stripsAndFansBecomeTriangles),
        cmocka_unit_test(indicesOfAllWidthsLoad),
        cmocka_unit_test(externalBuffersAreRead),
        cmocka_unit_test(dataUrisAreRead),
        cmocka_unit_test(badCubesGetSentences),
        cmocka_unit_test(badIndicesAndNumbersGetSentences),
        cmocka_unit_test(otherFilesGetSentences),
        cmocka_unit_test(missingBinChunkGetsSentence),
        cmocka_unit_test(binChunkLengthIsChecked),
        cmocka_unit_test(deepNestingGetsSentences),
        cmocka_unit_test(cutFilesNeverCrash),
        cmocka_unit_test(corruptFilesNeverCrash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
