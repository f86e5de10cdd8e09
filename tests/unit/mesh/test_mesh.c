// Mesh validation, normals, open edges and bounds, against answers known by hand.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h> // needs those above

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "vitrine.h"

// The unit cube about the origin: corner i has x, y, z from its bits 0, 1, 2.
static const float cubePositions[24] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                        -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
static const uint32_t cubeIndices[36] = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                         2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};

static const float trianglePositions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static vtMeshDef makeTriangle(void)
{
    return (vtMeshDef){.positions = trianglePositions, .vertexCount = 3, .indexCount = 3};
}

static vtMeshDef makeCube(void)
{
    return (vtMeshDef){
        .positions = cubePositions, .indices = cubeIndices, .vertexCount = 8, .indexCount = 36};
}

static void assertFails(const vtMeshDef* def, vtResult result, const char* sentence)
{
    vtMesh mesh;
    memset(&mesh, 0x5a, sizeof mesh);
    vtError error = {0};
    assert_int_equal(vtCreateMesh(def, "x.glb", &mesh, &error), result);
    assert_int_equal(error.result, result);
    assert_string_equal(error.message, sentence);
    assert_null(mesh.positions);
    assert_null(mesh.normals);
    assert_null(mesh.indices);
    assert_int_equal(mesh.vertexCount, 0);
    assert_int_equal(mesh.indexCount, 0);
    assert_int_equal(vtCreateMesh(def, "x.glb", &mesh, NULL), result);
}

static vtMesh createMesh(const vtMeshDef* def)
{
    vtMesh mesh;
    vtError error = {.result = vt_errorFile, .message = "stale"};
    assert_int_equal(vtCreateMesh(def, "test", &mesh, &error), vt_ok);
    assert_int_equal(error.result, vt_ok);
    assert_string_equal(error.message, "");
    return mesh;
}

static void assertNormal(const vtMesh* mesh, uint32_t vertex, float x, float y, float z)
{
    const float* n = mesh->normals + 3 * vertex;
    assert_float_equal(n[0], x, 1e-6f);
    assert_float_equal(n[1], y, 1e-6f);
    assert_float_equal(n[2], z, 1e-6f);
}

// ------------------------------------------------------------------------------------------- validation

static void testNoVertices(void** state)
{
    (void)state;
    vtMeshDef def = makeTriangle();
    def.vertexCount = 0;
    assertFails(&def, vt_errorGeometry, "mesh 'x.glb': it has no vertices; export it with geometry");
}

static void testNoTriangles(void** state)
{
    (void)state;
    vtMeshDef def = makeTriangle();
    def.indexCount = 0;
    assertFails(&def, vt_errorGeometry, "mesh 'x.glb': it has no triangles; export it with faces");
}

static void testNotTriangles(void** state)
{
    (void)state;
    vtMeshDef def = makeCube();
    def.indexCount = 35;
    assertFails(&def, vt_errorGeometry,
                "mesh 'x.glb': its 35 indices are not a multiple of 3; export it as triangles");
}

static void testPositionNotFinite(void** state)
{
    (void)state;
    float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    vtMeshDef def = makeTriangle();
    def.positions = positions;
    positions[6] = NAN;
    assertFails(&def, vt_errorGeometry,
                "mesh 'x.glb': vertex 2 has a position that is not finite (nan, 1, 0); export it again");
    positions[6] = 0.0f;
    positions[4] = INFINITY;
    assertFails(&def, vt_errorGeometry,
                "mesh 'x.glb': vertex 1 has a position that is not finite (1, inf, 0); export it again");
    positions[4] = 0.0f;
    positions[2] = -INFINITY;
    assertFails(&def, vt_errorGeometry,
                "mesh 'x.glb': vertex 0 has a position that is not finite (0, 0, -inf); export it again");
}

static void testNormalNotFinite(void** state)
{
    (void)state;
    const float normals[9] = {0, 0, 1, 0, NAN, 1, 0, 0, 1};
    vtMeshDef def = makeTriangle();
    def.normals = normals;
    assertFails(&def, vt_errorGeometry,
                "mesh 'x.glb': vertex 1 has a normal that is not finite (0, nan, 1); export it again");
}

static void testIndexOutOfRange(void** state)
{
    (void)state;
    uint32_t indices[36];
    memcpy(indices, cubeIndices, sizeof indices);
    indices[31] = 8;
    vtMeshDef def = makeCube();
    def.indices = indices;
    assertFails(&def, vt_errorGeometry,
                "mesh 'x.glb': index 31 (triangle 10) is 8, but there are only 8 vertices; export it again");
    indices[31] = UINT32_MAX;
    assertFails(&def, vt_errorGeometry,
                "mesh 'x.glb': index 31 (triangle 10) is 4294967295, but there are only 8 vertices; "
                "export it again");
}

static void testTooFewVerticesWithoutIndices(void** state)
{
    (void)state;
    vtMeshDef def = makeTriangle();
    def.indexCount = 6;
    assertFails(&def, vt_errorGeometry,
                "mesh 'x.glb': it has no index list, and 6 triangle corners but only 3 vertices; give three "
                "vertices for each triangle");
}

static void testNameMissingOrLong(void** state)
{
    (void)state;
    vtMeshDef def = makeTriangle();
    def.indexCount = 0;
    vtMesh mesh;
    vtError error;
    assert_int_equal(vtCreateMesh(&def, NULL, &mesh, &error), vt_errorGeometry);
    assert_string_equal(error.message, "mesh 'unnamed': it has no triangles; export it with faces");
    char name[2000];
    memset(name, 'a', sizeof name);
    name[sizeof name - 1] = '\0';
    assert_int_equal(vtCreateMesh(&def, name, &mesh, &error), vt_errorGeometry);
    assert_non_null(strstr(error.message, "it has no triangles; export it with faces"));
}

static void testDestroyZeroed(void** state)
{
    (void)state;
    vtMesh mesh = {0};
    vtDestroyMesh(&mesh);
    vtMeshDef def = makeTriangle();
    mesh = createMesh(&def);
    vtDestroyMesh(&mesh);
    const vtMesh zero = {0};
    assert_null(mesh.positions);
    assert_int_equal(mesh.indexCount, zero.indexCount);
    vtDestroyMesh(&mesh);
}

// ---------------------------------------------------------------------------------------------- normals

static void testCubeNormals(void** state)
{
    (void)state;
    vtMeshDef def = makeCube();
    vtMesh mesh = createMesh(&def);
    assert_true(mesh.normalsComputed);
    assert_int_equal(mesh.openEdgeCount, 0);
    assert_int_equal(mesh.degenerateCount, 0);
    const float third = 1.0f / sqrtf(3.0f);
    for (uint32_t i = 0; i < 8; ++i) {
        // Angle weights: the corner with one triangle on a face counts that face as much as two halves.
        assertNormal(&mesh, i, cubePositions[3 * i] * third, cubePositions[3 * i + 1] * third,
                     cubePositions[3 * i + 2] * third);
    }
    assert_memory_equal(mesh.positions, cubePositions, sizeof cubePositions);
    assert_memory_equal(mesh.indices, cubeIndices, sizeof cubeIndices);
    assert_float_equal(mesh.boundsMin.x, -1.0f, 0.0f);
    assert_float_equal(mesh.boundsMax.z, 1.0f, 0.0f);
    vtDestroyMesh(&mesh);
}

static void testSplitCubeNormals(void** state)
{
    (void)state;
    float positions[36 * 3];
    for (int i = 0; i < 36; ++i) {
        memcpy(positions + 3 * i, cubePositions + 3 * cubeIndices[i], 3 * sizeof(float));
    }
    vtMeshDef def = {.positions = positions, .vertexCount = 36, .indexCount = 36};
    vtMesh mesh = createMesh(&def);
    assert_int_equal(mesh.vertexCount, 36);
    assert_int_equal(mesh.openEdgeCount, 0);
    const float third = 1.0f / sqrtf(3.0f);
    for (uint32_t i = 0; i < 36; ++i) {
        assert_int_equal(mesh.indices[i], i);
        assertNormal(&mesh, i, positions[3 * i] * third, positions[3 * i + 1] * third,
                     positions[3 * i + 2] * third);
    }
    vtDestroyMesh(&mesh);
}

static void testNegativeZeroWelds(void** state)
{
    (void)state;
    // A tetrahedron cut into four loose triangles; one copy of the origin is written with -0.
    float positions[36] = {-0.0f, 0, -0.0f, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0,
                           0,     0, 0,     1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    vtMeshDef def = {.positions = positions, .vertexCount = 12, .indexCount = 12};
    vtMesh mesh = createMesh(&def);
    assert_int_equal(mesh.openEdgeCount, 0);
    const float third = 1.0f / sqrtf(3.0f);
    assertNormal(&mesh, 0, -third, -third, -third);
    assertNormal(&mesh, 3, -third, -third, -third);
    vtDestroyMesh(&mesh);
}

static void testGivenNormalsAreNormalized(void** state)
{
    (void)state;
    const float normals[9] = {0, 0, 5, 3, 0, 4, 0, 1e-30f, 0};
    vtMeshDef def = makeTriangle();
    def.normals = normals;
    vtMesh mesh = createMesh(&def);
    assert_false(mesh.normalsComputed);
    assertNormal(&mesh, 0, 0.0f, 0.0f, 1.0f);
    assertNormal(&mesh, 1, 0.6f, 0.0f, 0.8f);
    assertNormal(&mesh, 2, 0.0f, 1.0f, 0.0f);
    vtDestroyMesh(&mesh);
}

static void testZeroNormalsAreComputed(void** state)
{
    (void)state;
    const float normals[9] = {0, 2, 0, 0, 0, 0, 1, 0, 0};
    vtMeshDef def = makeTriangle();
    def.normals = normals;
    vtMesh mesh = createMesh(&def);
    assert_true(mesh.normalsComputed);
    assertNormal(&mesh, 0, 0.0f, 1.0f, 0.0f); // kept
    assertNormal(&mesh, 1, 0.0f, 0.0f, 1.0f); // computed
    assertNormal(&mesh, 2, 1.0f, 0.0f, 0.0f); // kept
    vtDestroyMesh(&mesh);
}

static void testTwoSidedSheet(void** state)
{
    (void)state;
    // Both sides of one triangle: the sums cancel, so each side keeps its own direction.
    const float positions[18] = {0, 0, 0, 1, 0, 0, 0.3f, 1, 0, 0, 0, 0, 0.3f, 1, 0, 1, 0, 0};
    vtMeshDef def = {.positions = positions, .vertexCount = 6, .indexCount = 6};
    vtMesh mesh = createMesh(&def);
    assert_int_equal(mesh.openEdgeCount, 0);
    for (uint32_t i = 0; i < 6; ++i) {
        assertNormal(&mesh, i, 0.0f, 0.0f, i < 3 ? 1.0f : -1.0f);
    }
    vtDestroyMesh(&mesh);
}

static void testExtremeSizes(void** state)
{
    (void)state;
    const float sizes[] = {1e-42f, 1e-25f, 1e25f, 1e38f};
    for (int i = 0; i < 4; ++i) {
        float positions[24];
        for (int k = 0; k < 24; ++k) {
            positions[k] = cubePositions[k] * sizes[i];
        }
        vtMeshDef def = makeCube();
        def.positions = positions;
        vtMesh mesh = createMesh(&def);
        const float third = 1.0f / sqrtf(3.0f);
        assert_int_equal(mesh.degenerateCount, 0);
        assertNormal(&mesh, 7, third, third, third);
        vtDestroyMesh(&mesh);
    }
}

// ------------------------------------------------------------------------------------- edges and triangles

static void testOpenBox(void** state)
{
    (void)state;
    vtMeshDef def = makeCube();
    def.indexCount = 30; // without the face z = 1
    vtMesh mesh = createMesh(&def);
    assert_int_equal(mesh.openEdgeCount, 4);
    vtDestroyMesh(&mesh);
}

static void testOneTriangle(void** state)
{
    (void)state;
    vtMeshDef def = makeTriangle();
    vtMesh mesh = createMesh(&def);
    assert_int_equal(mesh.openEdgeCount, 3);
    assert_int_equal(mesh.degenerateCount, 0);
    vtDestroyMesh(&mesh);
}

static void testFlippedFace(void** state)
{
    (void)state;
    uint32_t indices[36];
    memcpy(indices, cubeIndices, sizeof indices);
    indices[0] = cubeIndices[1];
    indices[1] = cubeIndices[0];
    vtMeshDef def = makeCube();
    def.indices = indices;
    vtMesh mesh = createMesh(&def);
    assert_int_equal(mesh.openEdgeCount, 6); // three edges, each run twice the same way
    vtDestroyMesh(&mesh);
}

static void testSharedEdgeOfTwoBodies(void** state)
{
    (void)state;
    // Two tetrahedra that touch along an edge: four triangles meet there, two each way.
    const float positions[18] = {0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
    const uint32_t indices[24] = {0, 2, 1, 0, 3, 2, 1, 2, 3, 0, 1, 3, 0, 4, 1, 0, 5, 4, 1, 4, 5, 0, 1, 5};
    vtMeshDef def = {.positions = positions, .indices = indices, .vertexCount = 6, .indexCount = 24};
    vtMesh mesh = createMesh(&def);
    assert_int_equal(mesh.openEdgeCount, 0);
    vtDestroyMesh(&mesh);
}

static void testDegenerateTriangles(void** state)
{
    (void)state;
    // After the cube: a point, a repeated index, two vertices at one place, and an unused stray vertex.
    float positions[30];
    memcpy(positions, cubePositions, sizeof cubePositions);
    memcpy(positions + 24, cubePositions, 3 * sizeof(float)); // vertex 8 lies on vertex 0
    const float stray[3] = {100, 100, 100};
    memcpy(positions + 27, stray, sizeof stray);
    uint32_t indices[45];
    memcpy(indices, cubeIndices, sizeof cubeIndices);
    const uint32_t extra[9] = {3, 3, 3, 1, 1, 2, 0, 8, 5};
    memcpy(indices + 36, extra, sizeof extra);
    vtMeshDef def = {.positions = positions, .indices = indices, .vertexCount = 10, .indexCount = 45};
    vtMesh mesh = createMesh(&def);
    assert_int_equal(mesh.degenerateCount, 3);
    assert_int_equal(mesh.openEdgeCount, 0);
    assert_int_equal(mesh.indexCount, 45);
    assert_float_equal(mesh.boundsMax.x, 1.0f, 0.0f);
    const float third = 1.0f / sqrtf(3.0f);
    assertNormal(&mesh, 5, third, -third, third);
    assertNormal(&mesh, 8, -third, -third, -third);
    assertNormal(&mesh, 9, 0.0f, 1.0f, 0.0f);
    vtDestroyMesh(&mesh);
}

static void testFilledTJunction(void** state)
{
    (void)state;
    // A tetrahedron whose edge 1-2 is cut at 4 on one side only; the flat triangle 1 4 2 closes the seam.
    const float positions[15] = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 1, 1, 0};
    const uint32_t indices[18] = {0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 4, 3, 4, 2, 3, 1, 2, 4};
    vtMeshDef def = {.positions = positions, .indices = indices, .vertexCount = 5, .indexCount = 18};
    vtMesh mesh = createMesh(&def);
    assert_int_equal(mesh.degenerateCount, 1);
    assert_int_equal(mesh.openEdgeCount, 0);
    vtDestroyMesh(&mesh);
    def.indexCount = 15;
    mesh = createMesh(&def);
    assert_int_equal(mesh.openEdgeCount, 3);
    vtDestroyMesh(&mesh);
}

static void testAllDegenerate(void** state)
{
    (void)state;
    const uint32_t indices[3] = {1, 1, 1};
    vtMeshDef def = makeTriangle();
    def.indices = indices;
    vtMesh mesh = createMesh(&def);
    assert_int_equal(mesh.degenerateCount, 1);
    assert_int_equal(mesh.openEdgeCount, 0);
    assertNormal(&mesh, 1, 0.0f, 1.0f, 0.0f);
    vtDestroyMesh(&mesh);
}

/// A height field of 2 * side * side triangles: large enough to grow tables, borders counted exactly.
static void testGrid(void** state)
{
    (void)state;
    const uint32_t side = 100;
    const uint32_t stride = side + 1;
    float* positions = calloc((size_t)stride * stride, 3 * sizeof(float));
    uint32_t* indices = calloc((size_t)side * side, 6 * sizeof(uint32_t));
    assert_non_null(positions);
    assert_non_null(indices);
    for (uint32_t i = 0; i < stride * stride; ++i) {
        positions[3 * i] = (float)(i % stride) * 0.01f;
        positions[3 * i + 2] = -(float)(i / stride) * 0.01f;
    }
    for (uint32_t i = 0; i < side * side; ++i) {
        uint32_t corner = i / side * stride + i % side;
        const uint32_t two[6] = {corner, corner + 1,          corner + stride + 1,
                                 corner, corner + stride + 1, corner + stride};
        memcpy(indices + 6 * (size_t)i, two, sizeof two);
    }
    vtMeshDef def = {.positions = positions,
                     .indices = indices,
                     .vertexCount = stride * stride,
                     .indexCount = 6 * side * side};
    vtMesh mesh = createMesh(&def);
    assert_int_equal(mesh.openEdgeCount, 4 * side);
    for (uint32_t i = 0; i < mesh.vertexCount; ++i) {
        assertNormal(&mesh, i, 0.0f, 1.0f, 0.0f);
    }
    vtDestroyMesh(&mesh);
    free(positions);
    free(indices);
}

/// A vertex as an engine's buffer has it.
typedef struct Vertex {
    float position[3], texcoord[2], normal[3];
    uint8_t other[4];
    float color[3];
} Vertex;

// Interleaved and with 16-bit indices, the cube is what it is from arrays of their own.
static void testStridesAndShortIndices(void** state)
{
    (void)state;
    float texcoords[16], colors[24];
    uint16_t shortIndices[36];
    Vertex vertices[8];
    memset(vertices, 0xff, sizeof vertices); // NaN, wherever too much is read
    for (size_t i = 0; i < 8; ++i) {
        for (size_t k = 0; k < 3; ++k) {
            vertices[i].position[k] = cubePositions[3 * i + k];
            vertices[i].normal[k] = 2.0f * cubePositions[3 * i + k];
            vertices[i].color[k] = colors[3 * i + k] = 0.01f * (float)(3 * i + k);
        }
        for (size_t k = 0; k < 2; ++k) {
            vertices[i].texcoord[k] = texcoords[2 * i + k] = 0.1f * (float)(2 * i + k);
        }
    }
    for (size_t i = 0; i < 36; ++i) {
        shortIndices[i] = (uint16_t)cubeIndices[i];
    }
    vtMeshDef tight = makeCube(), loose = makeCube();
    tight.normals = cubePositions;
    tight.texcoords = texcoords;
    tight.colors = colors;
    loose.positions = vertices[0].position;
    loose.normals = vertices[0].normal;
    loose.texcoords = vertices[0].texcoord;
    loose.colors = vertices[0].color;
    loose.positionStride = loose.normalStride = loose.texcoordStride = loose.colorStride = sizeof *vertices;
    loose.indices = NULL;
    loose.indices16 = shortIndices;
    vtMesh a = createMesh(&tight), b = createMesh(&loose);
    assert_memory_equal(a.positions, b.positions, sizeof cubePositions);
    assert_memory_equal(a.normals, b.normals, sizeof cubePositions);
    assert_memory_equal(a.indices, b.indices, sizeof cubeIndices);
    assert_memory_equal(a.texcoords, b.texcoords, sizeof texcoords);
    assert_memory_equal(a.colors, b.colors, sizeof colors);
    assert_int_equal(b.openEdgeCount, 0);
    vtDestroyMesh(&a);
    vtDestroyMesh(&b);

    vertices[7].position[1] = NAN;
    assertFails(&loose, vt_errorGeometry,
                "mesh 'x.glb': vertex 7 has a position that is not finite (1, nan, 1); export it again");
    vertices[7].position[1] = 1.0f;
    shortIndices[4] = 8;
    assertFails(&loose, vt_errorGeometry,
                "mesh 'x.glb': index 4 (triangle 1) is 8, but there are only 8 vertices; export it again");
    loose.indices = cubeIndices;
    assertFails(&loose, vt_errorArgument, "mesh 'x.glb': it has indices of 32 and of 16 bits; give one kind");
    loose.indices16 = NULL;
    loose.texcoordStride = 4;
    assertFails(&loose, vt_errorArgument,
                "mesh 'x.glb': a stride is 4 bytes; it must be a multiple of 4 and 8 or more");
    loose.texcoordStride = 0;
    loose.positionStride = 14;
    assertFails(&loose, vt_errorArgument,
                "mesh 'x.glb': a stride is 14 bytes; it must be a multiple of 4 and 12 or more");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(testNoVertices),
        cmocka_unit_test(testNoTriangles),
        cmocka_unit_test(testNotTriangles),
        cmocka_unit_test(testPositionNotFinite),
        cmocka_unit_test(testNormalNotFinite),
        cmocka_unit_test(testIndexOutOfRange),
        cmocka_unit_test(testTooFewVerticesWithoutIndices),
        cmocka_unit_test(testNameMissingOrLong),
        cmocka_unit_test(testDestroyZeroed),
        cmocka_unit_test(testCubeNormals),
        cmocka_unit_test(testSplitCubeNormals),
        cmocka_unit_test(testNegativeZeroWelds),
        cmocka_unit_test(testGivenNormalsAreNormalized),
        cmocka_unit_test(testZeroNormalsAreComputed),
        cmocka_unit_test(testTwoSidedSheet),
        cmocka_unit_test(testExtremeSizes),
        cmocka_unit_test(testOpenBox),
        cmocka_unit_test(testOneTriangle),
        cmocka_unit_test(testFlippedFace),
        cmocka_unit_test(testSharedEdgeOfTwoBodies),
        cmocka_unit_test(testDegenerateTriangles),
        cmocka_unit_test(testFilledTJunction),
        cmocka_unit_test(testAllDegenerate),
        cmocka_unit_test(testGrid),
        cmocka_unit_test(testStridesAndShortIndices),
    };
    return cmocka_run_group_tests_name("mesh", tests, NULL, NULL);
}
