// Reliefs: heights, the triangles made of them, and what is asked of the heights themselves.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "image/image.h"
#include "mesh/height_field.h"
#include "relief/relief.h"
#include "testing.h"

/// A relief of hills that no symmetry makes easy.
static void createHills(int width, int height, vtMesh* mesh)
{
    float* heights = malloc((size_t)width * (size_t)height * sizeof *heights);
    assert_non_null(heights);
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const float x = (float)column / (float)(width - 1), y = (float)row / (float)(height - 1);
            heights[row * width + column] =
                0.5f + 0.3f * sinf(9.0f * x + 2.0f) * cosf(7.0f * y) + 0.2f * x * y;
        }
    }
    const vtReliefDef def = {
        .heights = heights, .width = width, .height = height, .depth = 0.3f, .thickness = 0.2f};
    vtError error;
    assert_int_equal(vtCreateRelief(&def, "hills", mesh, &error), vt_ok);
    free(heights);
}

static const int sizes[][2] = {{2, 2},  {2, 9},   {3, 3},   {4, 4},    {5, 4},    {7, 3},
                               {17, 5}, {64, 64}, {33, 57}, {129, 33}, {200, 11}, {128, 129}};
enum { sizeCount = sizeof sizes / sizeof sizes[0] };

static void testTrianglesAreClosed(void** state)
{
    (void)state;
    for (int i = 0; i < sizeCount; ++i) {
        vtMesh mesh, checked;
        vtError error;
        createHills(sizes[i][0], sizes[i][1], &mesh);
        assert_int_equal(vtTriangulateRelief(&mesh, &error), vt_ok);
        // Through all checks that a caller's triangles meet.
        const vtMeshDef def = {.positions = mesh.positions,
                               .normals = mesh.normals,
                               .indices = mesh.indices,
                               .vertexCount = mesh.vertexCount,
                               .indexCount = mesh.indexCount};
        assert_int_equal(vtCreateMesh(&def, "hills", &checked, &error), vt_ok);
        assert_int_equal(checked.openEdgeCount, 0);
        assert_int_equal(checked.degenerateCount, 0);
        assert_memory_equal(&checked.boundsMin, &mesh.boundsMin, sizeof mesh.boundsMin);
        assert_memory_equal(&checked.boundsMax, &mesh.boundsMax, sizeof mesh.boundsMax);
        // Outward: what they enclose is what the heights enclose.
        double volume = 0.0;
        for (uint32_t k = 0; k < mesh.indexCount; k += 3) {
            vtVec3 p[3];
            for (int c = 0; c < 3; ++c) {
                p[c] = vtMakeVec3(mesh.positions + 3 * (size_t)mesh.indices[k + (uint32_t)c]);
            }
            volume += (double)vtDot(vtCross(p[0], p[1]), p[2]) / 6.0;
        }
        const double wanted = vtHeightField_Volume(mesh.heights);
        assert_true(wanted > 0.0 && fabs(volume - wanted) < 1e-4 * wanted);
        vtDestroyMesh(&checked);
        vtDestroyMesh(&mesh);
    }
}

static void testTrianglesHaveTheirNumbers(void** state)
{
    (void)state;
    for (int i = 0; i < sizeCount; ++i) {
        vtMesh mesh;
        createHills(sizes[i][0], sizes[i][1], &mesh);
        assert_int_equal(vtTriangulateRelief(&mesh, NULL), vt_ok);
        const uint32_t back = vtHeightField_FirstBack(mesh.heights);
        assert_true(back < mesh.indexCount / 3);
        for (uint32_t number = 0; number < back; ++number) {
            const vtReliefTriangle triangle = vtHeightField_Triangle(mesh.heights, number);
            for (uint32_t corner = 0; corner < 3; ++corner) {
                const size_t vertex = mesh.indices[3 * number + corner];
                assert_memory_equal(&triangle.corners[corner], mesh.positions + 3 * vertex, sizeof(vtVec3));
                assert_memory_equal(&triangle.normals[corner], mesh.normals + 3 * vertex, sizeof(vtVec3));
            }
        }
        for (uint32_t number = back; number < mesh.indexCount / 3; ++number) {
            for (uint32_t corner = 0; corner < 3; ++corner) {
                const size_t vertex = mesh.indices[3 * number + corner];
                assert_true(mesh.positions[3 * vertex + 2] == mesh.boundsMin.z);
                assert_true(mesh.normals[3 * vertex + 2] == -1.0f);
            }
        }
        // The back costs little beside the front where that is large.
        assert_true(mesh.indexCount / 3 - back <= 4 * vtHeightField_SegmentCount(mesh.heights) + 8);
        vtDestroyMesh(&mesh);
    }
}

static void testRangesHoldTheirCells(void** state)
{
    (void)state;
    for (int i = 0; i < sizeCount; ++i) {
        vtMesh mesh;
        createHills(sizes[i][0], sizes[i][1], &mesh);
        const vtHeightField* field = mesh.heights;
        assert_int_equal(vtHeightField_TileColumns(field, field->levelCount), 1);
        assert_int_equal(vtHeightField_TileRows(field, field->levelCount), 1);
        for (int level = 1; level <= field->levelCount; ++level) {
            for (int row = 0; row < vtHeightField_TileRows(field, level); ++row) {
                for (int column = 0; column < vtHeightField_TileColumns(field, level); ++column) {
                    float low = INFINITY, high = -INFINITY;
                    for (int y = row << level; y <= (row + 1) << level && y < field->height; ++y) {
                        for (int x = column << level; x <= (column + 1) << level && x < field->width; ++x) {
                            const bool hasCells =
                                column << level < field->width - 1 && row << level < field->height - 1;
                            low = hasCells ? fminf(low, vtHeightField_Z(field, x, y)) : low;
                            high = hasCells ? fmaxf(high, vtHeightField_Z(field, x, y)) : high;
                        }
                    }
                    const vtHeightRange tile = vtHeightField_Tile(field, level, column, row);
                    assert_true(tile.low == low && tile.high == high);
                }
            }
        }
        vtDestroyMesh(&mesh);
    }
}

static void testContainsWhatIsBelow(void** state)
{
    (void)state;
    vtMesh mesh;
    createHills(33, 57, &mesh);
    const vtHeightField* field = mesh.heights;
    for (uint32_t number = 0; number < vtHeightField_FirstWall(field); ++number) {
        const vtReliefTriangle t = vtHeightField_Triangle(field, number);
        const vtVec3 middle = vtScale(vtAdd(vtAdd(t.corners[0], t.corners[1]), t.corners[2]), 1.0f / 3.0f);
        const vtVec3 up = {0.0f, 0.0f, 1e-4f};
        assert_true(vtHeightField_Contains(field, vtSub(middle, up)));
        assert_false(vtHeightField_Contains(field, vtAdd(middle, up)));
    }
    assert_false(vtHeightField_Contains(field, (vtVec3){0.0f, 0.0f, field->back - 1e-4f}));
    assert_true(vtHeightField_Contains(field, (vtVec3){0.0f, 0.0f, field->back + 1e-4f}));
    assert_false(vtHeightField_Contains(field, (vtVec3){1.01f, 0.0f, 0.0f}));
    vtDestroyMesh(&mesh);
}

static void testSmoothingKeepsTheMean(void** state)
{
    (void)state;
    enum { side = 65 };
    float heights[side * side] = {0};
    heights[side * 32 + 32] = 1.0f;
    vtReliefDef def = {.heights = heights,
                       .width = side,
                       .height = side,
                       .depth = 1.0f,
                       .thickness = 0.1f,
                       .smoothing = 3.0f};
    vtMesh mesh;
    assert_int_equal(vtCreateRelief(&def, "point", &mesh, NULL), vt_ok);
    double sum = 0.0, square = 0.0;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            sum += (double)vtHeightField_Z(mesh.heights, column, row);
            square += (double)vtHeightField_Z(mesh.heights, column, row) * (column - 32) * (column - 32);
        }
    }
    assert_true(fabs(sum - 1.0) < 1e-5);
    assert_true(fabs(sqrt(square) - 3.0) < 0.1);
    vtDestroyMesh(&mesh);
}

/// A deviation whose square is 0.
static void testHardlySmoothedIsAsItWas(void** state)
{
    (void)state;
    const float heights[] = {0.0f, 1.0f, 0.5f, 0.25f};
    vtReliefDef def = {
        .heights = heights, .width = 2, .height = 2, .depth = 1.0f, .thickness = 0.1f, .smoothing = 1e-30f};
    vtMesh mesh;
    assert_int_equal(vtCreateRelief(&def, "steps", &mesh, NULL), vt_ok);
    for (int i = 0; i < 4; ++i) {
        assert_true(vtHeightField_Z(mesh.heights, i % 2, 1 - i / 2) == heights[i]);
    }
    vtDestroyMesh(&mesh);
}

// Decoded pixels are the file's own heights.
static void testPixelsAreTheFile(void** state)
{
    (void)state;
    enum { width = 9, height = 6 };
    uint8_t pixels[4 * width * height], *bytes;
    for (int i = 0; i < 4 * width * height; ++i) {
        pixels[i] = (uint8_t)(i * i * 31 + 7 * i);
    }
    size_t size;
    vtMesh read, made;
    vtError error;
    assert_int_equal(vtEncodePng(pixels, 4, width, height, &bytes, &size, &error), vt_ok);
    const vtReliefDef def = vtDefaultRelief();
    assert_int_equal(vtLoadRelief(bytes, size, "noise", &def, &read, &error), vt_ok);
    assert_int_equal(vtCreateReliefOfPixels(pixels, width, height, "noise", &def, &made, &error), vt_ok);
    assert_memory_equal(read.heights->z, made.heights->z, width * height * sizeof(float));
    free(bytes);
    vtDestroyMesh(&read);
    vtDestroyMesh(&made);
    assert_int_equal(vtCreateReliefOfPixels(pixels, 1, 1, "dot.png", &def, &made, &error), vt_errorFormat);
    assert_non_null(strstr(error.message, "dot.png' is 1 x 1 samples"));
    assert_int_equal(vtCreateReliefOfPixels(NULL, 5000, 9, "wide.png", &def, &made, &error), vt_errorFormat);
}

// Another depth is what the heights of that depth are.
static void testDepthIsAFactor(void** state)
{
    (void)state;
    vtError error;
    vtReliefDef def = vtDefaultRelief();
    def.width = 37;
    def.height = 20;
    def.depth = 1.0f;
    vtMesh unit, made, deepened;
    assert_int_equal(vtCreateReliefPattern("ripples", &def, &unit, &error), vt_ok);
    const float depths[] = {0.0f, 0.3f, 2.0f};
    for (int i = 0; i < 3; ++i) {
        def.depth = depths[i];
        def.thickness = 0.2f;
        assert_int_equal(vtCreateReliefPattern("ripples", &def, &made, &error), vt_ok);
        assert_int_equal(vtCreateReliefOfDepth(&unit, depths[i], 0.2f, "ripples", &deepened, &error), vt_ok);
        const vtHeightField *a = made.heights, *b = deepened.heights;
        assert_memory_equal(a->z, b->z, 37 * 20 * sizeof(float));
        assert_memory_equal(a->ranges, b->ranges, a->starts[a->levelCount + 1] * sizeof *a->ranges);
        assert_true(a->low == b->low && a->high == b->high && a->back == b->back);
        assert_memory_equal(&made.boundsMin, &deepened.boundsMin, sizeof made.boundsMin);
        assert_memory_equal(&made.boundsMax, &deepened.boundsMax, sizeof made.boundsMax);
        vtDestroyMesh(&made);
        vtDestroyMesh(&deepened);
    }
    vtDestroyMesh(&unit);
}

static void expectFailure(const vtReliefDef* def, const char* words)
{
    vtMesh mesh;
    vtError error;
    assert_int_not_equal(vtCreateRelief(def, "some.png", &mesh, &error), vt_ok);
    assert_non_null(strstr(error.message, "some.png"));
    if (strstr(error.message, words) == NULL) {
        fail_msg("'%s' does not say '%s'", error.message, words);
    }
    assert_null(mesh.heights);
}

static void testBadReliefs(void** state)
{
    (void)state;
    const float heights[] = {0.0f, 1.0f, NAN, 0.5f, 0.2f, 0.3f};
    const vtReliefDef good = {.heights = heights, .width = 2, .height = 1, .depth = 0.1f, .thickness = 0.1f};
    vtReliefDef def = good;
    expectFailure(&def, "is 2 x 1 samples, but a side must be 2 to 4096");
    def.width = 3;
    def.height = 2;
    expectFailure(&def, "the height in column 2, row 0 is");
    def.depth = -1.0f;
    expectFailure(&def, "its depth is -1; it must be from 0 to 10");
    def.depth = 0.1f;
    def.thickness = 0.0f;
    expectFailure(&def, "thickness is 0; it must be from 0.001 to 10");
    def.thickness = NAN;
    expectFailure(&def, "thickness is");
    def.thickness = 0.1f;
    def.smoothing = 65.0f;
    expectFailure(&def, "smoothing is 65; it must be from 0 to 64");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(testTrianglesAreClosed),
        cmocka_unit_test(testTrianglesHaveTheirNumbers),
        cmocka_unit_test(testRangesHoldTheirCells),
        cmocka_unit_test(testContainsWhatIsBelow),
        cmocka_unit_test(testSmoothingKeepsTheMean),
        cmocka_unit_test(testHardlySmoothedIsAsItWas),
        cmocka_unit_test(testBadReliefs),
        cmocka_unit_test(testPixelsAreTheFile),
        cmocka_unit_test(testDepthIsAFactor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
