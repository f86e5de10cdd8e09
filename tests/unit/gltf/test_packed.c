// Geometry of glTF files that Draco or meshoptimizer packed: it is as it was, and broken data get a sentence.
#include <meshoptimizer.h>

#include "gltf_builder.h"

size_t packDraco(const float (*corners)[3], const uint8_t* triangles, bool areBooleans, uint8_t* bytes,
                 size_t capacity);

static void assertCube(const vtMesh* mesh)
{
    assert_int_equal(mesh->indexCount, 36);
    assert_int_equal(mesh->openEdgeCount, 0);
    assert_near((float)mesh->volume, 8.0f, 0.01f);
    assert_near(mesh->boundsMin.x + mesh->boundsMax.y, 0.0f, 0.001f);
    assert_near(mesh->boundsMax.z, 1.0f, 0.001f);
}

static const char dracoRest[] = GLASS ",\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"meshes\":[{"
                                      "\"primitives\":[{\"attributes\":{\"POSITION\":0},"
                                      "\"indices\":1,\"material\":0,\"extensions\":{\"KHR_draco_mesh_"
                                      "compression\":{\"bufferView\":0,\"attributes\":{\"POSITION\":0"
                                      "}}}}]}],\"nodes\":[{\"mesh\":0}]";

static Builder beginDraco(bool areBooleans, size_t cut)
{
    Builder b = {0};
    uint8_t packed[2000];
    const size_t size = packDraco(cubeCorners, cubeTriangles, areBooleans, packed, sizeof packed);
    assert_true(size > cut);
    addView(&b, packed, size - cut, "");
    addAccessorOf(&b, -1, glFloat, 8, "VEC3", "");
    addAccessorOf(&b, -1, glUnsignedShort, 36, "SCALAR", "");
    return b;
}

static void dracoLoads(void** state)
{
    (void)state;
    Builder b = beginDraco(false, 0);
    vtScene scene = loadBuilt(&b, dracoRest);
    assertCube(&scene.meshes[0]);
    vtDestroyScene(&scene);
    b = beginDraco(false, 9);
    refuseBuilt(&b, dracoRest, "a packed primitive cannot be unpacked (");
    b = beginDraco(true, 0); // a byte of 237 as a boolean is undefined
    refuseBuilt(&b, dracoRest, "a packed primitive has no POSITION as its accessor");
}

/// Views packed by meshoptimizer, 0 and 1, and their accessors; `cut` bytes of the first are missing.
static Builder beginMeshopt(bool sequence, size_t cut)
{
    Builder b = {0};
    float corners[8][4] = {{0}};
    unsigned int indices[36];
    unsigned char packed[2000];
    for (int i = 0; i < 24; ++i) {
        corners[i / 3][i % 3] = cubeCorners[i / 3][i % 3];
    }
    for (int i = 0; i < 36; ++i) {
        indices[i] = cubeTriangles[i];
    }
    size_t size = meshopt_encodeVertexBuffer(packed, sizeof packed, corners, 8, 16);
    memcpy(b.bin, packed, size);
    const size_t first = (size + 3) / 4 * 4;
    const size_t second = sequence ? meshopt_encodeIndexSequence(packed, sizeof packed, indices, 36)
                                   : meshopt_encodeIndexBuffer(packed, sizeof packed, indices, 36);
    memcpy(b.bin + first, packed, second);
    assert_true(size > 0 && second > 0);
    b.binSize = (first + second + 3) / 4 * 4;
    snprintf(b.views, sizeof b.views,
             "{\"buffer\":7,\"byteLength\":128,\"byteStride\":16,\"extensions\":{\"EXT_meshopt_compression\":"
             "{\"buffer\":0,\"byteOffset\":0,"
             "\"byteLength\":%zu,\"byteStride\":16,\"count\":8,\"mode\":\"ATTRIBUTES\"}}},{\"buffer\":7,"
             "\"byteOffset\":128,\"byteLength\":72,"
             "\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%"
             "zu,\"byteStride\":2,\"count\":36,"
             "\"mode\":\"%s\"}}}",
             size - cut, first, second, sequence ? "INDICES" : "TRIANGLES");
    addAccessorOf(&b, 0, glFloat, 8, "VEC3", "");
    addAccessorOf(&b, 1, glUnsignedShort, 36, "SCALAR", "");
    return b;
}

static const char meshoptRest[] =
    GLASS ",\"extensionsRequired\":[\"EXT_meshopt_compression\"],\"meshes\":[" CUBE_MESH
          "],\"nodes\":[{\"mesh\":0}]";

static void meshoptLoads(void** state)
{
    (void)state;
    for (int sequence = 0; sequence < 2; ++sequence) {
        Builder b = beginMeshopt(sequence == 1, 0);
        vtScene scene = loadBuilt(&b, meshoptRest);
        assertCube(&scene.meshes[0]);
        vtDestroyScene(&scene);
    }
    Builder b = beginMeshopt(false, 20);
    refuseBuilt(&b, meshoptRest,
                "accessor 0 is packed by EXT_meshopt_compression in a way that cannot be unpacked");
    b = beginMeshopt(false, 0);
    memcpy(strstr(b.views, "ATTRIBUTES"), "attributes", 10);
    refuseBuilt(&b, meshoptRest, "in mode 'attributes' with filter '', 8 elements of 16 bytes");
    b = beginMeshopt(true, 0);
    strcpy(strstr(b.views, "\"mode\":\"INDICES\""), "\"mode\":\"INDICES\",\"filter\":\"EXPONENTIAL\"}}}");
    refuseBuilt(&b, meshoptRest, "in mode 'INDICES' with filter 'EXPONENTIAL', 36 elements of 2 bytes");
}

/// Normals by the octahedral filter, in 4 bytes each.
static void meshoptFilters(void** state)
{
    (void)state;
    Builder b = beginMeshopt(false, 0);
    float normals[8][4] = {{0}};
    unsigned char packed[500];
    int8_t encoded[8][4];
    for (int i = 0; i < 8; ++i) {
        normals[i][i % 3] = i < 4 ? 1.0f : -1.0f;
    }
    meshopt_encodeFilterOct(encoded, 8, 4, 8, &normals[0][0]);
    const size_t size = meshopt_encodeVertexBuffer(packed, sizeof packed, encoded, 8, 4);
    char more[300];
    const size_t at = b.binSize;
    memcpy(b.bin + at, packed, size);
    b.binSize += (size + 3) / 4 * 4;
    snprintf(more, sizeof more,
             ",{\"buffer\":7,\"byteOffset\":200,\"byteLength\":32,\"byteStride\":4,\"extensions\":{\"EXT_"
             "meshopt_compression\":{\"buffer\":0,"
             "\"byteOffset\":%zu,\"byteLength\":%zu,\"byteStride\":4,\"count\":8,\"mode\":\"ATTRIBUTES\","
             "\"filter\":\"OCTAHEDRAL\"}}}",
             at, size);
    strcat(b.views, more);
    addAccessorOf(&b, 2, glByte, 8, "VEC3", ",\"normalized\":true");
    vtScene scene = loadBuilt(
        &b, GLASS ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":2},\"indices\":1,"
                  "\"material\":0}]}],\"nodes\":[{\"mesh\":0}]");
    for (int i = 0; i < 24; ++i) {
        assert_near(scene.meshes[0].normals[i], normals[i / 3][i % 3], 0.02f);
    }
    vtDestroyScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dracoLoads),
        cmocka_unit_test(meshoptLoads),
        cmocka_unit_test(meshoptFilters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
