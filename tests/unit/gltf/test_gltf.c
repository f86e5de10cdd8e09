// glTF files built in memory: a cube in every form, each way a file can be wrong, and files cut or corrupted
// at every byte, which must never crash (run under the sanitizers).
#include <math.h>

#include "image/image.h"
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

static vtResult load(File file, vtScene* scene, vtError* error)
{
    const vtModelDef def = {.bytes = file.bytes, .size = file.size, .name = "x.glb"};
    return vtLoadScene(&def, scene, error);
}

static vtScene loadCube(const char* find, const char* replacement)
{
    const File file = makeCube(find, replacement);
    vtScene scene;
    vtError error = {0};
    assert_ok(load(file, &scene, &error), error);
    free(file.bytes);
    return scene;
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

static float ior(const vtScene* scene)
{
    return scene->materials[scene->objects[0].material].ior;
}

/// How much larger the first object is in the world than its mesh; negative where it is mirrored.
static float growth(const vtScene* scene)
{
    const float(*r)[4] = (const float(*)[4])scene->objects[0].toWorld.rows;
    return r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
           r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
           r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
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
    vtScene scene = loadCube(NULL, NULL);
    assert_int_equal(scene.meshes[0].vertexCount, 8);
    assert_int_equal(scene.meshes[0].indexCount, 36);
    assert_int_equal(scene.meshes[0].openEdgeCount, 0);
    assert_false(scene.meshes[0].normalsComputed);
    assert_near(volume(&scene.meshes[0]), 8.0f, 1e-5f);
    assert_near(ior(&scene), 1.45f, 1e-6f);
    expectOutwardNormals(&scene.meshes[0]);
    assert_int_equal(scene.objectCount, 1);
    assert_true(scene.allGlass);
    vtError error;
    assert_ok(vtValidateScene(&scene, &error), error);
    vtDestroyScene(&scene);
    assert_null(scene.meshes);
    vtDestroyScene(&scene);
}

/// What is not wrong: each variant gives a cube of that volume.
static void variantsLoad(void** state)
{
    (void)state;
    static const struct {
        const char *find, *replacement;
        float volume, ior;
    } variants[] = {
        {"\"scene\":0,", "", 8.0f, 1.45f},                                // the first scene
        {"\"scene\":0,\"scenes\":[{\"nodes\":[0]}],", "", 8.0f, 1.45f},   // no scenes: root nodes
        {",\"NORMAL\":2", "", 8.0f, 1.45f},                               // normals computed
        {",\"material\":0", "", 8.0f, 1.5f},                              // no material
        {"\"ior\":1.45", "\"ior\":2", 8.0f, 2.0f},                        // a whole number
        {"\"ior\":1.45", "", 8.0f, 1.5f},                                 // the extension's default
        {"KHR_materials_ior", "KHR_materials_sheen", 8.0f, 1.5f},         // another extension
        {"\"count\":8", "\"count\":8.0", 8.0f, 1.45f},                    // still a whole number
        {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[2,3,1]}", 48.0f, 1.45f}, //
        {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[-2,1,1]}", -16.0f,
         1.45f}, // mirrored: of the object, not the mesh
        {"{\"mesh\":0}", "{\"mesh\":0,\"rotation\":[0,0.6,0,0.8]}", 8.0f, 1.45f},
        {"{\"mesh\":0}", "{\"mesh\":0,\"matrix\":[0,1,0,0,1,0,0,0,0,0,1,0,5,6,7,1]}", -8.0f,
         1.45f}, // mirrored
        {"{\"mesh\":0}", "{\"children\":[1],\"scale\":[1,1,2]},{\"mesh\":0,\"translation\":[1,0,0]}", 16.0f,
         1.45f},
        {"\"asset\":",
         "\"images\":[{\"bufferView\":0,\"mimeType\":\"image/png\"},{\"uri\":\"no.png\"}],\"asset\":", 8.0f,
         1.45f}, // pictures that nothing uses are not looked at
        {"\"asset\":", "\"extensionsRequired\":[\"KHR_materials_ior\"],\"asset\":", 8.0f, 1.45f},
        {"\"asset\":", "\"extras\":{\"count\":-1,\"a\":[{\"mesh\":\"b\"}]},\"asset\":", 8.0f, 1.45f},
        {"\"primitives\":[", "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":1},", 8.0f,
         1.45f}, // lines
    };
    for (size_t i = 0; i < sizeof variants / sizeof variants[0]; ++i) {
        vtScene scene = loadCube(variants[i].find, variants[i].replacement);
        assert_near(volume(&scene.meshes[0]) * growth(&scene), variants[i].volume, 1e-4f);
        assert_near(ior(&scene), variants[i].ior, 1e-6f);
        assert_int_equal(scene.meshes[0].openEdgeCount, 0);
        expectOutwardNormals(&scene.meshes[0]);
        vtDestroyScene(&scene);
    }
}

static void transformsFollowTheHierarchy(void** state)
{
    (void)state;
    // A quarter turn about z, then a shift: the child's +x offset of 3 becomes +y.
    vtScene scene =
        loadCube("{\"mesh\":0}", "{\"children\":[1],\"rotation\":[0,0,1,1],\"translation\":[10,0,0]},"
                                 "{\"mesh\":0,\"translation\":[3,0,0]}");
    assert_near(scene.meshes[0].boundsMin.x, -1.0f, 0.0f); // in its own coordinates
    assert_near(scene.meshes[0].boundsMax.y, 1.0f, 0.0f);
    vtVec3 low, high;
    vtScene_Bounds(&scene, &low, &high);
    assert_near(low.x, 9.0f, 1e-5f);
    assert_near(low.y, 2.0f, 1e-5f);
    assert_near(high.y, 4.0f, 1e-5f);
    assert_near(high.z, 1.0f, 1e-5f);
    vtDestroyScene(&scene);
}

static void primitivesAreMerged(void** state)
{
    (void)state;
    vtScene scene =
        loadCube("\"primitives\":[",
                 "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0},");
    assert_int_equal(scene.meshes[0].vertexCount, 16);
    assert_int_equal(scene.meshes[0].indexCount, 72);
    assert_true(scene.meshes[0].normalsComputed); // for the primitive that has none
    assert_near(volume(&scene.meshes[0]), 16.0f, 1e-4f);
    expectOutwardNormals(&scene.meshes[0]);
    for (uint32_t i = 8; i < 16; ++i) { // those of the other are the file's
        assert_near(fabsf(scene.meshes[0].normals[3 * i]), 0.57735f, 1e-5f);
    }
    vtDestroyScene(&scene);
}

static void stripsAndFansBecomeTriangles(void** state)
{
    (void)state;
    vtScene strip = loadCube("\"indices\":1,", "\"mode\":5,");
    assert_int_equal(strip.meshes[0].indexCount, 18);
    const uint32_t stripStart[9] = {0, 1, 2, 1, 3, 2, 2, 3, 4};
    assert_memory_equal(strip.meshes[0].indices, stripStart, sizeof stripStart);
    vtDestroyScene(&strip);
    vtScene fan = loadCube("\"indices\":1,", "\"mode\":6,");
    assert_int_equal(fan.meshes[0].indexCount, 18);
    const uint32_t fanStart[6] = {1, 2, 0, 2, 3, 0};
    assert_memory_equal(fan.meshes[0].indices, fanStart, sizeof fanStart);
    vtDestroyScene(&fan);
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
        vtScene scene;
        vtError error = {0};
        assert_ok(load(file, &scene, &error), error);
        assert_near(volume(&scene.meshes[0]), 8.0f, 1e-5f);
        assert_true(scene.meshes[0].normalsComputed);
        expectOutwardNormals(&scene.meshes[0]);
        vtDestroyScene(&scene);
        free(file.bytes);
    }
}

// ------------------------------------------------------------------------------------------------ scenes

static void instancesShareMeshes(void** state)
{
    (void)state;
    vtScene scene = loadCube("\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]",
                             "\"nodes\":[0,1,2]}],\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"name\":\"second\","
                             "\"translation\":[5,6,7]},{\"mesh\":0,\"scale\":[1,-1,1]},{\"mesh\":3}]");
    assert_int_equal(scene.meshCount, 1);
    assert_int_equal(scene.materialCount, 1);
    assert_int_equal(scene.objectCount, 3);
    assert_string_equal(scene.objects[0].name, "");
    assert_string_equal(scene.objects[1].name, "second");
    assert_near(scene.objects[1].toWorld.rows[1][3], 6.0f, 0.0f);
    assert_near(scene.objects[2].toWorld.rows[1][1], -1.0f, 0.0f);
    assert_int_equal(scene.objects[2].mesh, 0);
    vtDestroyScene(&scene);
}

static void onlyReachedMeshesAreBuilt(void** state)
{
    (void)state;
    vtScene scene = loadCube("\"meshes\":[", "\"meshes\":[{\"name\":\"cup\",\"primitives\":[{\"attributes\":{"
                                             "\"POSITION\":0},\"indices\":1}]},");
    assert_int_equal(scene.meshCount, 1);
    assert_int_equal(scene.objectCount, 1);
    assert_string_equal(scene.objects[0].name, "cup"); // of the mesh, where the node has none
    vtDestroyScene(&scene);
}

static const char twoPrimitives[] =
    "[{\"attributes\":{\"POSITION\":0},\"indices\":3,\"material\":0},"
    "{\"attributes\":{\"POSITION\":0},\"indices\":4,\"material\":%d}]}],\"materials\":[%s,%s],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\"},"
    "{\"bufferView\":1,\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\"},"
    "{\"bufferView\":2,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\"},"
    "{\"bufferView\":1,\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"},"
    "{\"bufferView\":1,\"byteOffset\":24,\"componentType\":5123,\"count\":24,\"type\":\"SCALAR\"}],"
    "\"bufferViews\":";

/// The cube of two primitives, of 4 and 8 triangles.
static vtScene loadHalves(int secondMaterial, const char* first, const char* second)
{
    char* head = replaced(cubeJson, "[{\"attributes\"", "@");
    *strchr(head, '@') = '\0';
    char json[4096];
    int length = snprintf(json, sizeof json, "%s", head);
    length +=
        snprintf(json + length, sizeof json - (size_t)length, twoPrimitives, secondMaterial, first, second);
    snprintf(json + length, sizeof json - (size_t)length, "%s", strstr(cubeJson, "\"bufferViews\":") + 14);
    free(head);
    uint8_t bin[binBytes];
    fillCube(bin);
    const File file = makeGlb(json, bin, sizeof bin);
    vtScene scene;
    vtError error = {0};
    assert_ok(load(file, &scene, &error), error);
    free(file.bytes);
    return scene;
}

#define GLASS "{\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1}}}"

static void primitivesCloseEachOther(void** state)
{
    (void)state;
    vtScene scene = loadHalves(0, GLASS, "{}");
    assert_int_equal(scene.meshCount, 1);
    assert_int_equal(scene.materialCount, 1);
    assert_int_equal(scene.meshes[0].openEdgeCount, 0);
    assert_int_equal(scene.meshes[0].indexCount, 36);
    assert_false(scene.allGlass);
    vtDestroyScene(&scene);
}

static void materialsDivideMeshes(void** state)
{
    (void)state;
    vtScene scene = loadHalves(1, GLASS, "{}");
    assert_int_equal(scene.meshCount, 2);
    assert_int_equal(scene.objectCount, 2);
    assert_int_equal(scene.meshes[0].indexCount, 12);
    assert_int_equal(scene.meshes[1].indexCount, 24);
    assert_true(scene.meshes[0].openEdgeCount > 0);
    assert_false(scene.materials[scene.objects[0].material].opaque);
    assert_true(scene.materials[scene.objects[1].material].opaque);
    assert_false(scene.allGlass);
    vtDestroyScene(&scene);

    // All made glass they differ no longer, unless in their index.
    scene = loadHalves(1, "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0,0,1]}}", "{}");
    assert_true(scene.allGlass);
    assert_int_equal(scene.meshCount, 1);
    assert_int_equal(scene.materialCount, 1);
    assert_int_equal(scene.meshes[0].openEdgeCount, 0);
    assert_near(scene.materials[0].tint.y, 1.0f, 0.0f);
    vtDestroyScene(&scene);
    scene = loadHalves(1, "{\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.3}}}", "{}");
    assert_true(scene.allGlass);
    assert_int_equal(scene.meshCount, 2);
    assert_near(scene.materials[0].ior, 1.3f, 1e-6f);
    assert_near(scene.materials[1].ior, 1.5f, 0.0f);
    vtDestroyScene(&scene);
}

static void glassMaterialsLoad(void** state)
{
    (void)state;
    vtScene scene = loadHalves(
        1,
        "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,2,0.5]},\"extensions\":{"
        "\"KHR_materials_transmission\":{\"transmissionFactor\":0.1},\"KHR_materials_ior\":{\"ior\":1.7},"
        "\"KHR_materials_volume\":{\"attenuationColor\":[0.5,1,0],\"attenuationDistance\":4294967296}}}",
        "{\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
        "\"KHR_materials_volume\":{\"attenuationDistance\":null}}}");
    const vtMaterial* m = &scene.materials[scene.objects[0].material];
    assert_false(m->opaque);
    assert_near(m->ior, 1.7f, 1e-6f);
    assert_near(m->tint.x, 0.5f, 0.0f);
    assert_near(m->tint.y, 0.25f, 0.0f);
    assert_near(m->tint.z, 1.0f, 0.0f); // kept to 1
    assert_near(m->attenuationColor.x, 0.5f, 0.0f);
    assert_near(m->attenuationColor.z, 0.0f, 0.0f);
    assert_near(m->attenuationDistance, 4294967296.0f, 0.0f); // more than an int
    m = &scene.materials[scene.objects[1].material];
    assert_false(m->opaque);
    assert_near(m->attenuationDistance, 0.0f, 0.0f);
    assert_near(m->attenuationColor.y, 1.0f, 0.0f);
    assert_near(m->ior, 1.5f, 0.0f);
    assert_false(scene.allGlass);
    vtDestroyScene(&scene);
}

static void opaqueMaterialsLoad(void** state)
{
    (void)state;
    vtScene scene =
        loadHalves(1, GLASS,
                   "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,0,1],\"metallicFactor\":0.5,"
                   "\"roughnessFactor\":0},\"emissiveFactor\":[1,0,0.5],\"doubleSided\":true,"
                   "\"extensions\":{\"KHR_materials_unlit\":{},\"KHR_materials_emissive_strength\":{"
                   "\"emissiveStrength\":3}}}");
    const vtMaterial* m = &scene.materials[scene.objects[1].material];
    assert_true(m->opaque);
    assert_near(m->baseColor.y, 0.25f, 0.0f);
    assert_near(m->metallic, 0.5f, 0.0f);
    assert_near(m->roughness, 0.0f, 0.0f);
    assert_near(m->emissive.x, 3.0f, 0.0f);
    assert_near(m->emissive.z, 1.5f, 0.0f);
    assert_int_equal(m->maps[vt_mapBaseColor].image, -1);
    assert_int_equal(m->maps[vt_mapMetallicRoughness].image, -1);
    vtDestroyScene(&scene);

    scene = loadHalves(1, GLASS, "{}"); // glTF's defaults
    m = &scene.materials[scene.objects[1].material];
    assert_near(m->baseColor.x, 1.0f, 0.0f);
    assert_near(m->metallic, 1.0f, 0.0f);
    assert_near(m->roughness, 1.0f, 0.0f);
    assert_near(m->emissive.x, 0.0f, 0.0f);
    vtDestroyScene(&scene);
}

// ------------------------------------------------------------------------------- triangles with pictures

enum { triangleBytes = 36 + 24 + 12 + 12, maxPngBytes = 400 };

// One triangle many times. Its accessors: 0 positions, which are colours, too; 1, 2 texture coordinates as
// floats and 16-bit shares; 3 colours as 8-bit shares. Buffer view 4 is a picture. To be filled in:
// primitives, materials, textures and images, size of the picture, size of the buffer.
static const char triangleJson[] =
    "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[%s]}],%s,%s,"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
    "{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"},"
    "{\"bufferView\":2,\"componentType\":5123,\"normalized\":true,\"count\":3,\"type\":\"VEC2\"},"
    "{\"bufferView\":3,\"componentType\":5121,\"normalized\":true,\"count\":3,\"type\":\"VEC4\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":24},"
    "{\"buffer\":0,\"byteOffset\":60,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":72,\"byteLength\":12},"
    "{\"buffer\":0,\"byteOffset\":84,\"byteLength\":%zu}],\"buffers\":[{\"byteLength\":%zu}]}";

static const float triangle[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5f, 2};

static size_t makePng(uint8_t png[maxPngBytes])
{
    static const uint8_t pixels[16] = {255, 0, 0, 255, 0, 128, 0, 255, 1, 2, 3, 4, 5, 6, 7, 8};
    uint8_t* bytes;
    size_t size;
    vtError error;
    assert_ok(vtEncodePng(pixels, 4, 2, 2, &bytes, &size, &error), error);
    assert_true(size <= maxPngBytes);
    memcpy(png, bytes, size);
    free(bytes);
    return size;
}

static File makeTriangles(const char* primitives, const char* materials, const char* pictures,
                          const uint8_t* png, size_t pngSize)
{
    static const uint16_t shares[6] = {0, 65535, 0, 0, 65535, 13107};
    static const uint8_t colors[12] = {255, 0, 51, 7, 0, 255, 0, 255, 0, 0, 255, 255};
    char json[4096];
    uint8_t bin[triangleBytes + maxPngBytes] = {0};
    const size_t size = (triangleBytes + pngSize + 3) / 4 * 4;
    const int length =
        snprintf(json, sizeof json, triangleJson, primitives, materials, pictures, pngSize, size);
    assert_true(length > 0 && (size_t)length < sizeof json);
    memcpy(bin, triangle, 60);
    memcpy(bin + 60, shares, 12);
    memcpy(bin + 72, colors, 12);
    memcpy(bin + triangleBytes, png, pngSize);
    return makeGlb(json, bin, size);
}

static void texcoordsAndColorsLoad(void** state)
{
    (void)state;
    const File file = makeTriangles("{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,\"COLOR_0\":3}},"
                                    "{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":2,\"COLOR_0\":0}},"
                                    "{\"attributes\":{\"POSITION\":0}}",
                                    "\"materials\":[]", "\"images\":[]", (const uint8_t*)"", 0);
    vtScene scene;
    vtError error = {0};
    assert_ok(load(file, &scene, &error), error);
    assert_int_equal(scene.meshCount, 1);
    assert_int_equal(scene.meshes[0].vertexCount, 9);
    static const float texcoords[18] = {0, 0, 1, 0, 0.5f, 2, 0, 1, 0, 0, 1, 0.2f};
    static const float colors[27] = {1, 0, 0.2f, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0,
                                     0, 0, 1,    0, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    for (int i = 0; i < 18; ++i) {
        assert_near(scene.meshes[0].texcoords[i], texcoords[i], 1e-6f);
    }
    for (int i = 0; i < 27; ++i) {
        assert_near(scene.meshes[0].colors[i], colors[i], 1e-6f);
    }
    vtDestroyScene(&scene);
    free(file.bytes);

    scene = loadCube(NULL, NULL);
    assert_null(scene.meshes[0].texcoords);
    assert_null(scene.meshes[0].colors);
    vtDestroyScene(&scene);
}

/// A triangle of glass and one with pictures on it.
static File makePainted(const char* pictures, const uint8_t* png, size_t pngSize)
{
    return makeTriangles("{\"attributes\":{\"POSITION\":0},\"material\":0},"
                         "{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":2,\"TEXCOORD_1\":1},\"material\":1}",
                         "\"materials\":[" GLASS
                         ",{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1,\"texCoord\":1},"
                         "\"metallicRoughnessTexture\":{\"index\":0}}}]",
                         pictures, png, pngSize);
}

static void picturesLoad(void** state)
{
    (void)state;
    static const char* const pictures[] = {
        "\"samplers\":[{}],\"textures\":[{\"source\":1},{\"sampler\":0,\"source\":1}],\"images\":[{\"uri\":"
        "\"not used.png\"},"
        "{\"bufferView\":4,\"mimeType\":\"image/png\"}]",
        "\"textures\":[{\"source\":0},{\"source\":0}],\"images\":[{\"uri\":\"data:image/png;base64,"
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==\"}"
        "]",
    };
    for (size_t i = 0; i < 2; ++i) {
        uint8_t png[maxPngBytes];
        const size_t size = makePng(png);
        const File file = makePainted(pictures[i], png, size);
        vtScene scene;
        vtError error = {0};
        assert_ok(load(file, &scene, &error), error);
        assert_int_equal(scene.imageCount, 1);
        const vtMaterial* material = &scene.materials[scene.objects[1].material];
        assert_true(material->opaque);
        assert_int_equal(material->maps[vt_mapBaseColor].image, 0);
        assert_int_equal(material->maps[vt_mapMetallicRoughness].image, 0);
        assert_near(scene.meshes[1].texcoords[5], 2.0f, 0.0f); // the set that the picture is placed by
        const vtImage* image = &scene.images[0];
        assert_non_null(image->pixels);
        assert_null(image->bytes);
        assert_int_equal(image->width, i == 0 ? 2 : 1);
        if (i == 0) {
            assert_int_equal(image->pixels[0], 255);
            assert_int_equal(image->pixels[5], 128);
            assert_int_equal(image->pixels[15], 8);
        }
        vtDestroyScene(&scene);
        free(file.bytes);
    }
}

static vtResult readPicture(const char* path, size_t limit, uint8_t** bytes, size_t* size, void* userData,
                            vtError* error)
{
    (void)userData, (void)limit, (void)error;
    if (strcmp(path, "models/wood grain.png") != 0) {
        return vt_errorFile;
    }
    *bytes = malloc(maxPngBytes);
    *size = makePng(*bytes);
    return vt_ok;
}

static void externalPicturesAreRead(void** state)
{
    (void)state;
    const File file = makePainted("\"textures\":[{\"source\":0},{\"source\":0}],"
                                  "\"images\":[{\"uri\":\"wood%20grain.png\"}]",
                                  (const uint8_t*)"", 0);
    vtModelDef def = {.bytes = file.bytes, .size = file.size, .name = "x.glb", .directory = "models"};
    vtScene scene;
    vtError error = {0};
    assert_int_equal(vtLoadScene(&def, &scene, &error), vt_errorFile);
    assert_non_null(strstr(error.message, "picture 'wood grain.png' is a file of its own"));
    def.readFile = readPicture;
    assert_ok(vtLoadScene(&def, &scene, &error), error);
    assert_int_equal(scene.images[0].height, 2);
    vtDestroyScene(&scene);
    def.directory = "";
    assert_int_equal(vtLoadScene(&def, &scene, &error), vt_errorFile);
    assert_non_null(strstr(error.message, "picture 'wood grain.png' cannot be read; put that file beside"));
    assert_null(scene.materials);
    free(file.bytes);
}

static void camerasLoad(void** state)
{
    (void)state;
    // One looks from (10, 0, 3) along -x, its frame made by a quarter turn about y and a scale; one away
    // from the cube; one is orthographic.
    vtScene scene = loadCube(
        "\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]",
        "\"nodes\":[0,1,2,3]}],\"nodes\":[{\"mesh\":0},{\"name\":\"front\",\"camera\":0,\"rotation\":[0,1,0,"
        "1],\"scale\":[2,2,2]"
        ","
        "\"translation\":[10,0,3]},{\"camera\":1},{\"camera\":2,\"translation\":[0,0,-5]}],\"cameras\":[{"
        "\"type\":"
        "\"perspective\",\"perspective\":{\"yfov\":0.785398163,\"znear\":0.1}},{\"type\":\"orthographic\","
        "\"name\":\"top\",\"orthographic\":{\"xmag\":1,\"ymag\":1.5,\"znear\":0,\"zfar\":9}},{\"type\":"
        "\"perspective\","
        "\"perspective\":{\"yfov\":3.1,\"znear\":1}}]");
    assert_int_equal(scene.cameraCount, 3);
    assert_near(scene.cameras[0].view.eye.x, 10.0f, 0.0f);
    assert_near(scene.cameras[0].view.target.x, 0.0f, 1e-5f);
    assert_near(scene.cameras[0].view.target.z, 3.0f, 1e-5f);
    assert_near(scene.cameras[0].view.fovY, 45.0f, 1e-5f);
    assert_near(scene.cameras[2].view.eye.z, -5.0f, 0.0f);
    assert_near(scene.cameras[2].view.target.z, -6.0f, 1e-5f);
    assert_near(scene.cameras[2].view.fovY, 170.0f, 0.0f);
    assert_near(scene.cameras[0].orthographicHeight + scene.cameras[2].orthographicHeight, 0.0f, 0.0f);
    assert_near(scene.cameras[1].orthographicHeight, 3.0f, 0.0f);
    assert_string_equal(scene.cameras[0].name, "front");
    assert_string_equal(scene.cameras[1].name, "top");
    assert_string_equal(scene.cameras[2].name, "");
    vtDestroyScene(&scene);
}

// ---------------------------------------------------------------------------------------- external buffers

static vtResult readCubeBin(const char* path, size_t limit, uint8_t** bytes, size_t* size, void* userData,
                            vtError* error)
{
    assert_true(limit > binBytes);
    if (strcmp(path, "models/my cube.bin") != 0) {
        error->message[0] = '?'; // becomes a part of the sentence
        return vt_errorFile;
    }
    *size = *(const size_t*)userData;
    *bytes = malloc(binBytes);
    fillCube(*bytes);
    return vt_ok;
}

static void externalBuffersAreRead(void** state)
{
    (void)state;
    char* json = replaced(cubeJson, "{\"byteLength\":264}", "{\"byteLength\":264,\"uri\":\"my%20cube.bin\"}");
    size_t size = binBytes;
    vtModelDef def = {.bytes = json, .size = strlen(json), .name = "x.gltf", .directory = "models"};
    vtScene scene;
    vtError error = {0};
    assert_int_equal(vtLoadScene(&def, &scene, &error), vt_errorFile);
    assert_non_null(strstr(error.message, "my cube.bin"));

    def.readFile = readCubeBin;
    def.userData = &size;
    assert_ok(vtLoadScene(&def, &scene, &error), error);
    assert_near(volume(&scene.meshes[0]), 8.0f, 1e-5f);
    vtDestroyScene(&scene);

    size = 100;
    assert_int_equal(vtLoadScene(&def, &scene, &error), vt_errorFormat);
    assert_non_null(strstr(error.message, "should have 264 bytes but has 100"));
    def.directory = "elsewhere/";
    assert_int_equal(vtLoadScene(&def, &scene, &error), vt_errorFile);
    assert_non_null(strstr(error.message, "buffer 'my cube.bin' cannot be read (?); put"));
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
    vtScene scene;
    vtError error = {0};
    assert_ok(vtLoadScene(&def, &scene, &error), error);
    assert_int_equal(scene.meshes[0].indexCount, 3);
    assert_near(scene.meshes[0].boundsMax.x + scene.meshes[0].boundsMax.y, 2.0f, 0.0f);
    vtDestroyScene(&scene);
    static const char* const bad[][3] = {
        {"AAAAAAAAAAAAAAAAAACAPw", "", "should have 36 bytes but has 19"},
        {"AAAA", "AA!A", "data URI of buffer 0 cannot be decoded"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        char* text = replaced(json, bad[i][0], bad[i][1]);
        def.bytes = text;
        def.size = strlen(text);
        assert_int_equal(vtLoadScene(&def, &scene, &error), vt_errorFormat);
        if (strstr(error.message, bad[i][2]) == NULL) {
            fail_msg("'%s' does not say '%s'", error.message, bad[i][2]);
        }
        free(text);
    }
}

// -------------------------------------------------------------------------------------------- what is wrong

static void expectFailure(File file, vtResult expected, const char* reason)
{
    vtScene scene;
    static const vtScene zero = {0};
    memset(&scene, 0xFF, sizeof scene);
    vtError error = {0};
    const vtResult result = load(file, &scene, &error);
    if (result != expected || strstr(error.message, reason) == NULL) {
        fail_msg("result %d and '%s' instead of %d and '%s'", result, error.message, expected, reason);
    }
    assert_int_equal(error.result, expected);
    assert_non_null(strstr(error.message, "x.glb"));
    assert_null(strchr(error.message, '\n'));
    assert_memory_equal(&scene, &zero, sizeof scene);
}

static const struct {
    const char *find, *replacement;
    vtResult result;
    const char* reason;
} badCubes[] = {
    // accessors and what is under them
    {"\"POSITION\":0", "\"POSITION\":9", vt_errorFormat, "accessor 9 but has 3"},
    {"\"NORMAL\":2", "\"NORMAL\":3", vt_errorFormat, "accessor 3 but has 3"},
    {"\"indices\":1", "\"indices\":7", vt_errorFormat, "it refers to accessor 7 but has 3 of them"},
    {"\"indices\":1", "\"indices\":4294967297", vt_errorFormat, "'indices' that is not a whole number"},
    {"\"POSITION\":0", "\"POSITION\":-1", vt_errorFormat, "'POSITION' that is not a whole number"},
    {"\"bufferView\":0", "\"bufferView\":12", vt_errorFormat,
     "it refers to buffer view 12 but has 3 of them"},
    {"\"buffer\":0,\"byteLength\":96", "\"buffer\":1,\"byteLength\":96", vt_errorFormat,
     "buffer 1 but has 1"},
    {"\"count\":8", "\"count\":9", vt_errorFormat, "accessor 0 reads 12 bytes beyond the end of its buffer"},
    {"\"count\":8", "\"count\":2147483647", vt_errorMemory, "a primitive takes 309237645456 bytes"},
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
    {"\"componentType\":5126", "\"componentType\":5125", vt_errorFormat, "POSITION as something else"},
    {"\"componentType\":5126", "\"componentType\":5127", vt_errorFormat, "componentType"},
    {"\"componentType\":5126", "\"componentType\":1", vt_errorFormat, "componentType"},
    {"\"type\":\"VEC3\"", "\"type\":\"VEC2\"", vt_errorFormat, "POSITION as something else"},
    {"\"type\":\"VEC3\"", "\"type\":\"VEC9\"", vt_errorFormat, "VEC9"},
    {"\"componentType\":5123", "\"componentType\":5122", vt_errorFormat,
     "indices that are not 8, 16 or 32-bit"},
    {"\"type\":\"SCALAR\"", "\"type\":\"VEC2\"", vt_errorFormat, "accessor 1 reads 72 bytes beyond"},
    {"\"count\":36", "\"count\":35", vt_errorGeometry, "35 corners, not a multiple of 3"},
    {"\"count\":8", "\"count\":7", vt_errorFormat, "8 of NORMAL for 7 positions"},
    {"\"bufferView\":2,\"componentType\":5126,\"count\":8",
     "\"bufferView\":2,\"componentType\":5126,\"count\":7", vt_errorFormat, "7 of NORMAL for 8 positions"},
    {"\"count\":8",
     "\"count\":8,\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":0,\"componentType\":5123},"
     "\"values\":{\"bufferView\":0}}",
     vt_errorFormat, "accessor 0 replaces element 49024 of 8"},
    {"\"POSITION\":0,\"NORMAL\":2", "\"POSITION\":0,\"NORMAL\":1", vt_errorFormat,
     "NORMAL as something else"},
    {"{\"byteLength\":264}", "{\"byteLength\":265}", vt_errorFormat, "should have 265 bytes but has 264"},
    {"{\"byteLength\":264}", "{}", vt_errorFormat, "buffer 0 has no byteLength"},
    {"{\"byteLength\":264}", "3", vt_errorFormat, "'buffers' in its JSON is no object"},
    {"{\"byteLength\":264}", "{\"byteLength\":0}", vt_errorFormat, "beyond the end of its buffer"},
    {"{\"byteLength\":264}", "{\"byteLength\":264,\"uri\":\"a.bin\"}", vt_errorFile, "'a.bin'"},
    {"{\"byteLength\":264}", "{\"byteLength\":264,\"uri\":\"b\\u001b[31m\\u009b\\u007fc.\"}", vt_errorFile,
     "'b [31m  c.'"},
    {"{\"byteLength\":264}", "{\"byteLength\":264,\"uri\":5}", vt_errorFormat,
     "uri of buffer 0 is not a text"},
    // extensions
    {"\"asset\"", "\"extensionsRequired\":[\"KHR_mesh_quantization\",\"ACME_shape\"],\"asset\"",
     vt_errorFormat,
     "it requires the extension ACME_shape, which is not supported; export it without. Supported: EXT_mesh"},
    // nodes and scenes
    {"\"scene\":0", "\"scene\":4", vt_errorFormat, "scene 4 but has 1"},
    {"\"nodes\":[0]", "\"nodes\":[3]", vt_errorFormat, "node 3 but has 1"},
    {"\"nodes\":[0]", "\"nodes\":[-1]", vt_errorFormat, "'nodes' that is not a whole number"},
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
    {"{\"mesh\":0}", "{\"mesh\":0,\"name\":\"plate\",\"scale\":[2,0,1]}", vt_errorGeometry,
     "node 0 ('plate') is scaled by 2, 0, 1 along its axes in the world, which makes it flat; give it"},
    {"{\"mesh\":0}", "{\"children\":[1],\"scale\":[1,1,0]},{\"mesh\":0}", vt_errorGeometry,
     "node 1 is scaled by 1, 1, 0"},
    {"{\"mesh\":0}", "{\"mesh\":0,\"matrix\":[1,0,0,0,1,0,0,0,0,0,1,0,0,0,0,1]}", vt_errorGeometry,
     "which makes it flat"}, // sheared to nothing
    {"{\"mesh\":0}", "{\"mesh\":0,\"translation\":[1e39,0,0]}", vt_errorGeometry,
     "32-bit numbers do not hold"},
    {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[3e38,1,1e-38],\"translation\":[2e38,0,0]}", vt_errorGeometry,
     "numbers do not hold it"},
    {"{\"mesh\":0}", "{\"mesh\":0,\"matrix\":[1,0,0,0,0,1,0,0.5,0,0,1,0,0,0,0,1]}", vt_errorFormat,
     "node 0 has a matrix whose last row is 0, 0.5, 0, 1, but it must be 0, 0, 0, 1"},
    {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[0,0,0]}", vt_errorGeometry,
     "no triangles that are neither hidden nor scaled to nothing"},
    {"{\"mesh\":0}", "{}", vt_errorGeometry, "no triangles"},
    // materials
    {"\"material\":0", "\"material\":6", vt_errorFormat, "material 6 but has 1"},
    {"\"ior\":1.45", "\"ior\":0.5", vt_errorFormat, "index of refraction of 0.5"},
    {"\"ior\":1.45", "\"ior\":1e300", vt_errorFormat, "index of refraction of 1e+300"},
    {"\"ior\":1.45", "\"ior\":\"glass\"", vt_errorFormat,
     "material 0 has an index of refraction that is no number; correct KHR_materials_ior"},
    {"\"ior\":1.45", "\"ior\":0.5}},\"name\":{\"a\":{", vt_errorFormat, "must be 0, or 1 or more"},
    {"\"ior\":1.45}", "},\"KHR_materials_transmission\":{\"transmissionFactor\":\"all\"}", vt_errorFormat,
     "material 0 has a transmissionFactor that is no number"},
    {"\"ior\":1.45}", "},\"KHR_materials_transmission\":{\"transmissionFactor\":-1}", vt_errorFormat,
     "a transmissionFactor of -1, but it must be a number of 0 or more"},
    {"\"ior\":1.45}",
     "},\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
     "\"KHR_materials_volume\":{\"attenuationDistance\":-2}",
     vt_errorFormat, "an attenuationDistance of -2"},
    {"\"ior\":1.45}",
     "},\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
     "\"KHR_materials_volume\":{\"attenuationColor\":[1,0]}",
     vt_errorFormat, "attenuationColor that is not three numbers"},
    {"\"ior\":1.45}", "},\"KHR_materials_emissive_strength\":{\"emissiveStrength\":-2}", vt_errorFormat,
     "an emissiveStrength of -2"},
    {"{\"extensions\"", "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1]},\"extensions\"",
     vt_errorFormat, "baseColorFactor"},
    // texture coordinates and colours
    {"\"NORMAL\":2", "\"NORMAL\":2,\"TEXCOORD_0\":0", vt_errorFormat,
     "TEXCOORD_0 as something else than two floats"},
    {"\"NORMAL\":2", "\"NORMAL\":2,\"TEXCOORD_0\":-1", vt_errorFormat, "'TEXCOORD_0' that is not a whole"},
    {"\"NORMAL\":2", "\"NORMAL\":2,\"COLOR_0\":1", vt_errorFormat,
     "COLOR_0 as something else than three or four floats"},
    {"\"NORMAL\":2", "\"NORMAL\":2,\"COLOR_0\":3", vt_errorFormat, "accessor 3 but has 3"},
    // cameras
    {"{\"mesh\":0}", "{\"mesh\":0,\"camera\":0}", vt_errorFormat, "camera 0 but has 0"},
    {"{\"mesh\":0}", "{\"mesh\":0,\"camera\":-1}", vt_errorFormat, "'camera' that is not a whole number"},
    {"\"nodes\":[{\"mesh\":0}]",
     "\"nodes\":[{\"mesh\":0,\"camera\":0}],\"cameras\":[{\"type\":\"perspective\",\"name\":\"eye\","
     "\"perspective\":{\"yfov\":0,\"znear\":1}}]",
     vt_errorFormat, "camera 0, eye has a yfov of 0, but it must be above 0 and below pi"},
    {"\"nodes\":[{\"mesh\":0}]",
     "\"nodes\":[{\"mesh\":0},{\"camera\":0,\"scale\":[1,1,0]}],\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
     "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}]",
     vt_errorGeometry, "node 1 scales its camera by 0 along its view"},
    {"\"asset\"", "\"cameras\":[{\"type\":\"fisheye\"}],\"asset\"", vt_errorFormat, "Invalid camera type"},
    // primitives
    {"\"POSITION\":0,", "", vt_errorGeometry, "no triangles"},
    {"\"indices\":1", "\"mode\":0", vt_errorGeometry, "no triangles"},
    {"\"indices\":1,", "", vt_errorGeometry, "8 corners, not a multiple of 3"},
    {"\"attributes\":{\"POSITION\":0,\"NORMAL\":2},", "", vt_errorFormat, "'attributes' property is missing"},
    // the JSON itself
    {"\"version\":\"2.0\"", "\"version\":\"1.0\"", vt_errorFormat, "version '1.0'"},
    {"\"version\":\"2.0\"", "\"version\":\"2.0\",\"minVersion\":\"2.1\"", vt_errorFormat,
     "it needs glTF 2.1 but only 2.0 is supported"},
    {"\"asset\"", "\"asse\"", vt_errorFormat, "asset"},
    {"\"asset\"", "asset", vt_errorFormat, "JSON is broken"},
    {"{\"asset\"", "[{\"asset\"", vt_errorFormat, "JSON is broken"},
    {"\"meshes\":[", "\"meshes\":[4,", vt_errorFormat, "'meshes' in its JSON is no object"},
    {"\"nodes\":[{", "\"nodes\":[true,{", vt_errorFormat, "'nodes' in its JSON is no object"},
    {"\"nodes\":[{\"mesh\":0}]", "\"nodes\":7", vt_errorFormat, "'nodes' in its JSON is no array"},
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

static void badPicturesGetSentences(void** state)
{
    (void)state;
    static const struct {
        const char *pictures, *reason;
        size_t broken; ///< byte of the PNG that is not as it should be; 0: none
    } cases[] = {
        {"\"textures\":[{\"source\":0},{\"source\":0}],\"images\":[{\"bufferView\":4,\"name\":\"wood\"}]",
         "picture '0, wood' cannot be decoded as PNG (", 12},
        {"\"textures\":[{\"source\":0},{\"source\":0}],\"images\":[{\"bufferView\":4,\"name\":\"wood\"}]",
         "picture '0, wood' is neither PNG, JPEG nor WebP; it is damaged", 1},
        {"\"textures\":[{\"source\":0},{\"source\":1}],\"images\":[{\"bufferView\":4}]", "image 1 but has 1",
         0},
        {"\"textures\":[{\"source\":0}],\"images\":[{\"bufferView\":4}]", "texture 1 but has 1", 0},
        {"\"textures\":[{\"source\":0},{}],\"images\":[{\"bufferView\":4}]",
         "texture 1 has no PNG, JPEG or WebP", 0},
        {"\"textures\":[{\"source\":0},{\"extensions\":{\"KHR_texture_basisu\":{\"source\":0}}}],\"images\":["
         "{\"bufferView\":4}]",
         "texture 1 has no PNG, JPEG or WebP picture but one of KHR_texture_basisu; export", 0},
        {"\"textures\":[{\"source\":0},{\"source\":0}],\"images\":[{\"bufferView\":5}]",
         "it refers to buffer view 5 but has 5 of them", 0},
        {"\"textures\":[{\"source\":0},{\"source\":0}],\"images\":[{}]",
         "image 0 has neither a uri nor a buffer view", 0},
        {"\"textures\":[{\"source\":0},{\"source\":0}],\"images\":[7]", "'images' in its JSON is no object",
         0},
        {"\"textures\":[{\"source\":0},{\"source\":0}],\"images\":[{\"bufferView\":{}}]",
         "'bufferView' that is not a whole number", 0},
        {"\"textures\":[{\"source\":0},{\"source\":0}],\"images\":[{\"uri\":\"data:image/png;base64,?\"}]",
         "data URI of image 0 cannot be decoded", 0},
        {"\"textures\":[{\"source\":0},{\"source\":-1}],\"images\":[{\"bufferView\":4}]",
         "'source' that is not a whole number", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        uint8_t png[maxPngBytes];
        const size_t size = makePng(png);
        png[cases[i].broken] ^= cases[i].broken > 0 ? 1 : 0;
        const File file = makePainted(cases[i].pictures, png, size);
        expectFailure(file, vt_errorFormat, cases[i].reason);
        free(file.bytes);
    }
}

static void badTexcoordsGetSentences(void** state)
{
    (void)state;
    const File file = makeTriangles("{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1}}", "\"materials\":[]",
                                    "\"images\":[]", (const uint8_t*)"", 0);
    const float infinite = INFINITY;
    memcpy(file.bytes + file.size - triangleBytes + 56, &infinite, 4);
    expectFailure(file, vt_errorGeometry,
                  "mesh '0': vertex 2 has a texture coordinate that is not finite; export it again");
    free(file.bytes);
}

static void tooManyObjectsGetSentence(void** state)
{
    (void)state;
    char* nodes = malloc(20 * (VT_MAX_OBJECTS + 2));
    char* roots = malloc(8 * (VT_MAX_OBJECTS + 2));
    size_t nodesLength = 0, rootsLength = 0;
    for (int i = 0; i <= VT_MAX_OBJECTS; ++i) {
        nodesLength += (size_t)sprintf(nodes + nodesLength, "%s{\"mesh\":0}", i > 0 ? "," : "");
        rootsLength += (size_t)sprintf(roots + rootsLength, "%s%d", i > 0 ? "," : "", i);
    }
    const size_t capacity = nodesLength + rootsLength + 100;
    char* json = malloc(capacity);
    snprintf(json, capacity, "\"nodes\":[%s]}],\"nodes\":[%s]", roots, nodes);
    const File file = makeCube("\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]", json);
    expectFailure(file, vt_errorGeometry, "its nodes place 4097 meshes but there can be 4096");
    free(file.bytes);
    free(json);
    free(roots);
    free(nodes);
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
        {"\xEF\xBB\xBF{\"asset\":3}", 14, "'asset' in its JSON is no object"},
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
    vtScene scene;
    vtError error = {0};
    assert_ok(load(file, &scene, &error), error);
    vtDestroyScene(&scene);
    free(file.bytes);
    free(json);
    json = replaced("\"extensions\":{\"KHR_materials_sheen\":{\"b\":@},", "@", arrays);
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

/// Every byte of the file in turn made another one.
static void corrupt(File file, size_t jsonEnd)
{
    static const uint8_t values[] = {0,   1,   ' ', '"', '0',  '9',  '-', '[',
                                     ']', '{', '}', ',', 0x7F, 0x80, 0xFF};
    for (size_t at = 0; at < file.size; ++at) {
        const uint8_t kept = file.bytes[at];
        for (size_t i = 0; i < sizeof values; ++i) {
            if (at >= jsonEnd && i % 4 != 0) {
                continue; // numbers and indices need fewer values
            }
            file.bytes[at] = values[i];
            vtScene scene;
            vtError error = {0};
            const vtResult result = load(file, &scene, &error);
            assert_true(result == vt_ok ? scene.meshes[0].indexCount > 0 && scene.objectCount > 0
                                        : error.message[0] != '\0');
            vtDestroyScene(&scene);
        }
        file.bytes[at] = kept;
    }
}

static void corruptFilesNeverCrash(void** state)
{
    (void)state;
    const File cube = makeCube(NULL, NULL);
    corrupt(cube, cube.size - binBytes);
    free(cube.bytes);
    uint8_t png[maxPngBytes];
    const size_t size = makePng(png);
    const File painted = makePainted("\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,"
                                     "\"znear\":1}}],\"textures\":[{\"source\":0},{\"source\":0}],"
                                     "\"images\":[{\"bufferView\":4,\"name\":\"wood\"}]",
                                     png, size);
    corrupt(painted, painted.size - size - triangleBytes);
    free(painted.bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cubeLoads),
        cmocka_unit_test(variantsLoad),
        cmocka_unit_test(transformsFollowTheHierarchy),
        cmocka_unit_test(primitivesAreMerged),
        cmocka_unit_test(stripsAndFansBecomeTriangles),
        cmocka_unit_test(indicesOfAllWidthsLoad),
        cmocka_unit_test(instancesShareMeshes),
        cmocka_unit_test(onlyReachedMeshesAreBuilt),
        cmocka_unit_test(primitivesCloseEachOther),
        cmocka_unit_test(materialsDivideMeshes),
        cmocka_unit_test(glassMaterialsLoad),
        cmocka_unit_test(opaqueMaterialsLoad),
        cmocka_unit_test(texcoordsAndColorsLoad),
        cmocka_unit_test(picturesLoad),
        cmocka_unit_test(externalPicturesAreRead),
        cmocka_unit_test(camerasLoad),
        cmocka_unit_test(externalBuffersAreRead),
        cmocka_unit_test(dataUrisAreRead),
        cmocka_unit_test(badCubesGetSentences),
        cmocka_unit_test(badPicturesGetSentences),
        cmocka_unit_test(badTexcoordsGetSentences),
        cmocka_unit_test(tooManyObjectsGetSentence),
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
