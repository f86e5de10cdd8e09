// The hierarchy that the technique `bvh` walks: every triangle lies in one leaf and in the boxes above it,
// whatever the mesh.
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "scene/bvh_records.h"
#include "scene/shapes.h"
#include "scene/triangles.h"
#include "testing.h"

typedef struct Check {
    const vtBvhRecords* records;
    vtVec3 low, extent; // of the object's box, as the shader takes it
    uint8_t* seen;      // a triangle
    int deepest;
} Check;

static float steps(float value, float low, float extent)
{
    return (value - low) * (VT_BVH_STEPS - 2.0f) / extent + 1.0f;
}

/// The triangle's corners lie in the box.
static void checkTriangle(Check* check, uint32_t index, const uint32_t* box)
{
    const uint32_t* texels = check->records->triangles + 12 * (size_t)index;
    float words[9];
    memcpy(words, texels, 3 * sizeof(float));
    memcpy(words + 3, texels + 4, 3 * sizeof(float));
    memcpy(words + 6, texels + 8, 3 * sizeof(float));
    ++check->seen[texels[3]];
    const float low[3] = {check->low.x, check->low.y, check->low.z};
    const float extent[3] = {check->extent.x, check->extent.y, check->extent.z};
    for (int corner = 0; corner < 3; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
            float value = words[axis] + (corner > 0 ? words[3 * corner + axis] : 0.0f);
            float at = steps(value, low[axis], extent[axis]);
            assert_true((float)box[axis] <= at && at <= (float)box[axis + 3]);
        }
    }
}

/// `child`: a texel of the nodes. `outer`: the boxes above it cut with each other.
static void checkChild(Check* check, const uint32_t* child, const uint32_t* outer, int depth)
{
    const uint32_t box[6] = {child[0] & 0xffffu, child[0] >> 16,     child[1] & 0xffffu,
                             child[1] >> 16,     child[2] & 0xffffu, child[2] >> 16};
    uint32_t inner[6];
    for (int axis = 0; axis < 3; ++axis) {
        inner[axis] = box[axis] > outer[axis] ? box[axis] : outer[axis];
        inner[axis + 3] = box[axis + 3] < outer[axis + 3] ? box[axis + 3] : outer[axis + 3];
    }
    check->deepest = depth > check->deepest ? depth : check->deepest;
    if (child[3] >> 31 == 0) {
        assert_true(child[3] < check->records->nodeCount);
        checkChild(check, check->records->nodes + 8 * (size_t)child[3], inner, depth + 1);
        checkChild(check, check->records->nodes + 8 * (size_t)child[3] + 4, inner, depth + 1);
        return;
    }
    const uint32_t first = child[3] & ((1u << VT_BVH_COUNT_SHIFT) - 1u);
    for (uint32_t i = 0; i < (child[3] >> VT_BVH_COUNT_SHIFT & 7u); ++i) {
        checkTriangle(check, first + i, inner);
    }
}

static void checkMesh(const vtMesh* mesh)
{
    const uint32_t count = mesh->indexCount / 3, all[6] = {0, 0, 0, 65535, 65535, 65535};
    uint32_t* triangles = vtCreateTriangleRecords(mesh);
    vtBvhRecords records;
    assert_non_null(triangles);
    assert_true(vtCreateBvhRecords(triangles, count, mesh->boundsMin, mesh->boundsMax, &records));
    assert_int_equal(records.triangleCount, count);
    vtVec3 extent = vtSub(mesh->boundsMax, mesh->boundsMin);
    const float least = 1e-4f * vtLength(extent);
    extent = (vtVec3){fmaxf(extent.x, least), fmaxf(extent.y, least), fmaxf(extent.z, least)};
    Check check = {&records, mesh->boundsMin, extent, calloc(count, 1), 0};
    checkChild(&check, records.nodes, all, 1);
    checkChild(&check, records.nodes + 4, all, 1);
    for (uint32_t i = 0; i < count; ++i) {
        assert_int_equal(check.seen[i], 1);
    }
    assert_true(check.deepest <= VT_BVH_STACK);
    free(check.seen);
    free(triangles);
    vtDestroyBvhRecords(&records);
}

static void shapes(void** state)
{
    (void)state;
    for (int i = 0; vtShapeName(i) != NULL; ++i) {
        vtMesh mesh;
        vtError error;
        assert_ok(vtCreateShape(vtShapeName(i), &mesh, &error), error);
        checkMesh(&mesh);
        vtDestroyMesh(&mesh);
    }
}

static void checkTriangles(const float* positions, uint32_t count)
{
    vtMesh mesh;
    vtError error;
    const vtMeshDef def = {.positions = positions, .vertexCount = 3 * count, .indexCount = 3 * count};
    assert_ok(vtCreateMesh(&def, "triangles", &mesh, &error), error);
    checkMesh(&mesh);
    vtDestroyMesh(&mesh);
}

static void unusualMeshes(void** state)
{
    (void)state;
    enum { most = 3000 };
    static const float one[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    float* many = malloc(9 * most * sizeof *many);
    checkTriangles(one, 1); // also flat
    for (int i = 0; i < most; ++i) {
        memcpy(many + 9 * i, one, sizeof one);
    }
    checkTriangles(many, most); // all at one place
    float size = 1.0f;
    for (int i = 0; i < 100; ++i, size *= 0.5f) { // ever smaller: the heuristic alone would make a list of it
        for (int k = 0; k < 9; ++k) {
            many[9 * i + k] = size * (one[k] + 1.0f);
        }
    }
    checkTriangles(many, 100);
    free(many);
}

static void fineShapes(void** state)
{
    (void)state;
    vtMesh mesh;
    vtError error;
    for (int i = 0; i < 2; ++i) {
        assert_ok(vtCreateFineShape(i == 0 ? "knot" : "torus", 10000, &mesh, &error), error);
        assert_true(abs((int)(mesh.indexCount / 3) - 10000) < 300);
        assert_int_equal(mesh.openEdgeCount, 0);
        checkMesh(&mesh);
        vtDestroyMesh(&mesh);
    }
    assert_int_equal(vtCreateFineShape("goblet", 10000, &mesh, &error), vt_errorArgument);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes),
        cmocka_unit_test(unusualMeshes),
        cmocka_unit_test(fineShapes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
