// The allocator, and what happens where it has no memory: each call is repeated with the first allocation
// failing, then the second and so on, C++ containers' included, alone and with all that follow. It succeeds
// or gives vt_errorMemory, and all that it took is given back.
#include "base/error.h"
#include "base/memory.h"
#include "exr_cases.h"
#include "failing_memory.h"
#include "image/image.h"
#include "image/pfm.h"
#include "png_cases.h"
#include "testing.h"

void* testAllocate(size_t size);
void testFree(void* block);

void* testAllocate(size_t size)
{
    return takeBlock(size);
}

void testFree(void* block)
{
    giveBlock(block);
}

// ------------------------------------------------------------------------------------------------- calls

typedef struct Bytes {
    uint8_t* data;
    size_t size;
} Bytes;

/// Files, made while there is memory.
static Bytes png8, png16, hdr, pfm, exr, model;

static vtResult shapes(vtError* error)
{
    const char* const names[] = {"sphere", "diamond", "cube", "plane"};
    vtResult result = vt_ok;
    for (size_t i = 0; i < sizeof names / sizeof names[0] && result == vt_ok; ++i) {
        vtMesh mesh;
        result = vtCreateShape(names[i], &mesh, error);
        vtDestroyMesh(&mesh);
    }
    return result;
}

static vtResult reliefs(vtError* error)
{
    vtMesh mesh;
    vtReliefDef def = vtDefaultRelief();
    def.width = 33;
    def.height = 17;
    def.smoothing = 1.0f;
    vtResult result = vtCreateReliefPattern("ripples", &def, &mesh, error);
    result = result == vt_ok ? vtTriangulateRelief(&mesh, error) : result;
    vtDestroyMesh(&mesh);
    const Bytes files[] = {png8, png16, hdr, pfm};
    for (size_t i = 0; i < sizeof files / sizeof files[0] && result == vt_ok; ++i) {
        result = vtLoadRelief(files[i].data, files[i].size, "x", &def, &mesh, error);
        vtDestroyMesh(&mesh);
    }
    return result;
}

static vtResult environments(vtError* error)
{
    vtEnvironment environment;
    const uint8_t pixels[2 * 4] = {255, 128, 3, 255, 64, 200, 10, 0};
    vtResult result = vtCreateImageEnvironment(pixels, 2, 1, "x", &environment, error);
    vtDestroyEnvironment(&environment);
    const Bytes files[] = {png8, png16, hdr, pfm, exr};
    for (size_t i = 0; i < sizeof files / sizeof files[0] && result == vt_ok; ++i) {
        result = vtLoadEnvironment(files[i].data, files[i].size, "x", &environment, error);
        vtDestroyEnvironment(&environment);
    }
    return result;
}

static vtResult pictures(vtError* error)
{
    const Bytes files[] = {png8, png16};
    vtResult result = vt_ok;
    for (size_t i = 0; i < sizeof files / sizeof files[0] && result == vt_ok; ++i) {
        vtImage image;
        result = vtDecodeImage(files[i].data, files[i].size, "x", &image, error);
        vtFree(image.pixels);
    }
    return result;
}

/// Noise, so that the file outgrows what is taken for it at first.
static vtResult writing(vtError* error)
{
    enum { side = 64 };
    static uint8_t pixels[3 * side * side];
    uint32_t random = 1;
    for (size_t i = 0; i < sizeof pixels; ++i) {
        random = 1664525u * random + 1013904223u;
        pixels[i] = (uint8_t)(random >> 24);
    }
    uint8_t* bytes = NULL;
    size_t size = 0;
    const vtResult result = vtEncodePng(pixels, 3, side, side, &bytes, &size, error);
    assert_true((result == vt_ok) == (bytes != NULL) && (result == vt_ok) == (size > sizeof pixels));
    vtFree(bytes);
    return result;
}

static vtResult writingFloats(vtError* error)
{
    enum { side = 24 };
    static float pixels[3 * side * side];
    uint8_t* bytes = NULL;
    size_t size = 0;
    vtResult result = vtEncodeExr(pixels, 3, side, side, "x", &bytes, &size, error);
    assert_true((result == vt_ok) == (bytes != NULL));
    vtFree(bytes);
    bytes = NULL;
    result = result == vt_ok ? vtEncodeHdr(pixels, side, side, "x", &bytes, &size, error) : result;
    vtFree(bytes);
    return result;
}

/// A scene of the cube and, behind it, the plane.
static vtResult makeScene(vtScene* scene, vtError* error)
{
    *scene = (vtScene){0};
    const char* const names[] = {"cube", "plane"};
    vtMaterial material = vtDefaultMaterial();
    vtTransform place = vtIdentityTransform();
    vtResult result = vt_ok;
    for (int i = 0; i < 2 && result == vt_ok; ++i) {
        vtMesh mesh;
        vtScene other = {0};
        result = vtCreateShape(names[i], &mesh, error);
        result = result == vt_ok ? vtCreateMeshScene(&mesh, &material, &other, error) : result;
        result = result == vt_ok ? vtScene_Append(scene, &other, &place, error) : result;
        vtDestroyMesh(&mesh);
        vtDestroyScene(&other);
        material.opaque = true;
        place.rows[2][3] = -2.0f;
    }
    return result;
}

static vtResult append(vtError* error)
{
    vtScene scene;
    const vtResult result = makeScene(&scene, error);
    vtDestroyScene(&scene);
    return result;
}

static vtResult build(vtScene* scene, vtError* error)
{
    vtPreparation* preparation = vtBeginPreparation(scene);
    if (preparation == NULL) {
        return vtFail(error, vt_errorMemory, "the test's");
    }
    while (!vtPreparation_Step(preparation, 7)) {
    }
    return vtEndPreparation(preparation, error);
}

/// Its hierarchy is refitted, built anew as the mesh has a triangle of no area, and built for distances.
static vtResult update(vtError* error)
{
    vtScene scene;
    vtResult result = makeScene(&scene, error);
    result = result == vt_ok ? build(&scene, error) : result;
    for (uint32_t degenerate = 0; degenerate < 2 && result == vt_ok; ++degenerate) {
        vtMesh* mesh = &scene.meshes[0];
        mesh->degenerateCount = degenerate;
        const size_t count = 3 * (size_t)mesh->vertexCount;
        float positions[3 * 64];
        assert_true(count <= sizeof positions / sizeof positions[0]);
        memcpy(positions, mesh->positions, count * sizeof *positions);
        positions[0] += 0.01f;
        result = vtMesh_Update(mesh, positions, NULL, error);
    }
    result = result == vt_ok ? vtPrepareScene(&scene, vt_techniqueWyman, NULL, error) : result;
    vtDestroyScene(&scene);
    return result;
}

static vtResult trace(vtError* error)
{
    vtScene scene;
    vtTracer* tracer = NULL;
    vtPath path;
    vtFrame frame = vtDefaultFrame();
    vtResult result = makeScene(&scene, error);
    result = result == vt_ok ? vtValidateScene(&scene, error) : result;
    result = result == vt_ok ? vtCreateTracer(&scene, &tracer, error) : result;
    result = result == vt_ok ? vtTracer_Path(tracer, &frame, 256.0f, 256.0f, &path, error) : result;
    assert_true(result != vt_ok || path.eventCount > 0);
    vtDestroyTracer(tracer);
    vtDestroyScene(&scene);
    return result;
}

/// The test's own memory is never out.
static vtResult readFile(const char* path, size_t limit, uint8_t** bytes, size_t* size, void* userData,
                         vtError* error)
{
    (void)userData, (void)limit, (void)error;
    const Bytes file = strstr(path, ".png") != NULL ? png16 : (Bytes){model.data, 104};
    const long failing = memory.failing;
    failNone();
    *bytes = vtAllocate(file.size, 1);
    memory.failing = failing;
    memcpy(*bytes, file.data, file.size);
    *size = file.size;
    return vt_ok;
}

static const char json[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,2]}],\"nodes\":["
    "{\"name\":\"a glass of some length, longer than fits a short text\",\"mesh\":0,\"children\":[1]},"
    "{\"mesh\":1,\"translation\":[0,0,-3]},{\"camera\":0,\"translation\":[0,0,9]}],"
    "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":0.1}}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":2,\"material\":0}]},"
    "{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1},\"indices\":2,\"material\":1,"
    "\"targets\":[{\"POSITION\":0}]}],\"weights\":[1]}],"
    "\"materials\":[{\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1}},"
    "\"extras\":{\"a\":[[1,2,[3]],{\"b\":[4]}]}},"
    "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
    "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"wood.png\"}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
    "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
    "{\"bufferView\":2,\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"},"
    "{\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},"
    "{\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"}],"
    "\"animations\":[{\"name\":\"an animation whose name is longer than fits a short text\",\"samplers\":["
    "{\"input\":3,\"output\":4},{\"input\":3,\"output\":3}],\"channels\":[{\"sampler\":0,\"target\":"
    "{\"node\":1,\"path\":\"translation\"}},{\"sampler\":1,\"target\":{\"node\":1,\"path\":\"weights\"}}]}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":32},"
    "{\"buffer\":0,\"byteOffset\":80,\"byteLength\":24}],"
    "\"buffers\":[{\"byteLength\":104,\"uri\":\"numbers.bin\"}]}";

static vtResult loadModel(const char* text, vtError* error)
{
    vtScene scene;
    const vtModelDef def = {
        .bytes = text, .size = strlen(text), .name = "x.gltf", .directory = "d", .readFile = readFile};
    vtModel* opened;
    vtResult result = vtOpenModel(&def, &opened, &scene, error);
    assert_true((result == vt_ok) == (opened != NULL));
    assert_true(result != vt_ok ||
                (scene.objectCount == 2 && scene.imageCount == 1 && scene.cameraCount == 1));
    assert_true(result == vt_ok || (scene.meshes == NULL && scene.meshCount == 0));
    if (result == vt_ok) {
        result = vtModel_SetTime(opened, 0, 1.0, NULL, &scene, error);
    }
    vtCloseModel(opened);
    vtDestroyScene(&scene);
    return result;
}

static vtResult models(vtError* error)
{
    return loadModel(json, error);
}

// ------------------------------------------------------------------------------------------------- tests

typedef vtResult Call(vtError* error);

/// Whether the call got as far as the allocation that fails.
static bool attempt(Call* call, long failing, bool lasting, vtResult* result)
{
    vtError error = {0};
    const long before = memory.live;
    failFrom(failing, lasting);
    *result = call(&error);
    failNone();
    if (*result != error.result || memory.live != before) {
        fail_msg("allocation %ld: result %d, error %d '%s', %ld blocks are left", failing, *result,
                 error.result, error.message, memory.live - before);
    }
    return memory.calls > failing;
}

/// How many allocations the call makes, each of which has failed.
static long failEach(Call* call)
{
    long most = 0;
    for (int lasting = 0; lasting < 2; ++lasting) {
        vtResult result;
        long failing = 0;
        for (; attempt(call, failing, lasting, &result); ++failing) {
            if (result != vt_ok && result != vt_errorMemory) {
                fail_msg("allocation %ld fails: the result is %d, not vt_errorMemory", failing, result);
            }
            assert_true(!lasting || result == vt_errorMemory);
        }
        assert_int_equal(result, vt_ok);
        most = failing > most ? failing : most;
    }
    return most;
}

static void memoryThatIsOutIsAResult(void** state)
{
    (void)state;
    Call* const calls[] = {shapes,        reliefs, environments, pictures, writing,
                           writingFloats, append,  update,       trace,    models};
    long all = 0;
    for (size_t i = 0; i < sizeof calls / sizeof calls[0]; ++i) {
        const long points = failEach(calls[i]);
        assert_true(points > 0);
        all += points;
    }
    printf("%ld allocations failed\n", all);
    assert_true(all > 500);
}

/// What is deeper than any glTF file is destroyed without memory and without a call for each level.
static void deepModelsNeedNoMemoryToGo(void** state)
{
    (void)state;
    enum { depth = 30000 };
    char* text = malloc(2 * depth + 64);
    strcpy(text, "{\"a\":{\"b\":");
    memset(text + 10, '[', depth);
    strcpy(text + 10 + depth, "1");
    vtResult result = vt_ok;
    // Broken at its end, so that all is destroyed; by then few allocations are missing.
    long calls = 0;
    vtError error;
    vtScene scene;
    const vtModelDef def = {.bytes = text, .size = strlen(text), .name = "x.gltf"};
    memory.calls = 0;
    assert_int_equal(vtLoadScene(&def, &scene, &error), vt_errorFormat);
    calls = memory.calls;
    for (long failing = calls - 10; failing < calls; ++failing) {
        failFrom(failing, true);
        result = vtLoadScene(&def, &scene, &error);
        failNone();
        assert_true(result == vt_errorFormat || result == vt_errorMemory);
    }
    free(text);
}

static void blocksAreNeverTooSmall(void** state)
{
    (void)state;
    assert_null(vtAllocate(SIZE_MAX / 2, 3));
    assert_null(vtAllocateZeroed(SIZE_MAX / 2, 3));
    assert_null(vtReallocate(NULL, SIZE_MAX / 2, 3));
    uint8_t* block = vtAllocateZeroed(3, 5);
    for (int i = 0; i < 15; ++i) {
        assert_int_equal(block[i], 0);
        block[i] = (uint8_t)i;
    }
    block = vtReallocate(block, 100, 5);
    assert_int_equal(block[14], 14);
    assert_null(vtReallocate(block, SIZE_MAX / 2, 3));
    vtFree(block);
    vtFree(NULL);
    void* nothing = vtAllocate(0, 5);
    assert_non_null(nothing);
    vtFree(nothing);
}

static void allocatorsAreWhole(void** state)
{
    (void)state;
    vtAllocator partial = counting;
    partial.reallocate = NULL;
    vtError error = {0};
    assert_int_equal(vtSetAllocator(&partial, &error), vt_errorArgument);
    assert_non_null(strstr(error.message, "NULL"));
    void* block = vtAllocate(1, 1); // the one before stays
    assert_int_equal(memory.live > 0, true);
    vtFree(block);
}

static const char hdrBytes[] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n"
                               "\x80\x40\x20\x80\x10\x20\x30\x80\x80\x40\x20\x81\x10\x20\x30\x82";

static int makeFiles(void** state)
{
    (void)state;
    vtError error = {0};
    assert_ok(vtSetAllocator(&counting, &error), error);
    uint8_t pixels[4 * 3 * 3];
    for (size_t i = 0; i < sizeof pixels; ++i) {
        pixels[i] = (uint8_t)(7 * i);
    }
    const float numbers[3 * 4] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    assert_ok(vtEncodePng(pixels, 4, 3, 3, &png8.data, &png8.size, &error), error);
    assert_ok(vtEncodePfm(numbers, 2, 2, &pfm.data, &pfm.size, &error), error);
    static uint8_t png16Bytes[256];
    const uint8_t rows[] = {0, 1, 2, 0, 3, 4, 0, 5, 6, 7, 8}; // three passes
    png16 = (Bytes){png16Bytes, putPng(png16Bytes, &(PngCase){.width = 2,
                                                              .height = 2,
                                                              .bits = 16,
                                                              .interlaced = true,
                                                              .rows = rows,
                                                              .rowsSize = sizeof rows})};
    static ExrBytes exrFile;
    putExr(&exrFile, &(ExrCase){.data = exrBox(0, 0, 3, 2),
                                .display = exrBox(0, 0, 2, 2),
                                .channels = "RGBA",
                                .type = EXR_PIXEL_HALF,
                                .compression = EXR_COMPRESSION_PIZ});
    exr = (Bytes){exrFile.bytes, exrFile.size};
    hdr = (Bytes){(uint8_t*)hdrBytes, sizeof hdrBytes - 1};
    static uint8_t contents[104];
    const float corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const uint16_t indices[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    memcpy(contents, corners, sizeof corners);
    memcpy(contents + 80, indices, sizeof indices);
    model = (Bytes){contents, sizeof contents};
    return 0;
}

static int dropFiles(void** state)
{
    (void)state;
    vtFree(png8.data);
    vtFree(pfm.data);
    assert_int_equal(vtSetAllocator(NULL, NULL), vt_ok);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memoryThatIsOutIsAResult),
        cmocka_unit_test(deepModelsNeedNoMemoryToGo),
        cmocka_unit_test(blocksAreNeverTooSmall),
        cmocka_unit_test(allocatorsAreWhole),
    };
    return cmocka_run_group_tests(tests, makeFiles, dropFiles);
}
