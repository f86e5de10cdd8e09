// The built-in shapes: closed, outward, smooth, of the documented size and topology.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h> // needs those above

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "vitrine.h"

static vtMesh createShape(const char* name)
{
    vtMesh mesh;
    vtError error;
    assert_int_equal(vtCreateShape(name, &mesh, &error), vt_ok);
    return mesh;
}

static vtVec3 getPosition(const vtMesh* mesh, size_t index)
{
    return vtMakeVec3(mesh->positions + 3 * (size_t)mesh->indices[index]);
}

static vtVec3 getNormal(const vtMesh* mesh, size_t index)
{
    return vtMakeVec3(mesh->normals + 3 * (size_t)mesh->indices[index]);
}

/// Cross product of two sides of the triangle at `first`: twice its area along its normal.
static vtVec3 getArea(const vtMesh* mesh, size_t first)
{
    vtVec3 a = getPosition(mesh, first);
    return vtCross(vtSub(getPosition(mesh, first + 1), a), vtSub(getPosition(mesh, first + 2), a));
}

static double measureVolume(const vtMesh* mesh)
{
    double volume = 0.0;
    for (size_t i = 0; i < mesh->indexCount; i += 3) {
        volume += (double)vtDot(getPosition(mesh, i), getArea(mesh, i)) / 6.0;
    }
    return volume;
}

static int comparePositions(const void* a, const void* b)
{
    const float* p = a;
    const float* q = b;
    for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] != q[axis]) {
            return p[axis] < q[axis] ? -1 : 1;
        }
    }
    return 0;
}

/// V - E + F over welded positions, for a closed mesh, where E = 3 F / 2. Every vertex must be used.
static int measureEuler(const vtMesh* mesh)
{
    float* sorted = malloc(mesh->vertexCount * 3 * sizeof(float));
    assert_non_null(sorted);
    memcpy(sorted, mesh->positions, mesh->vertexCount * 3 * sizeof(float));
    qsort(sorted, mesh->vertexCount, 3 * sizeof(float), comparePositions);
    int vertices = 1;
    for (size_t i = 1; i < mesh->vertexCount; ++i) {
        vertices += comparePositions(sorted + 3 * (i - 1), sorted + 3 * i) != 0;
    }
    free(sorted);
    int triangles = (int)(mesh->indexCount / 3);
    return vertices - 3 * triangles / 2 + triangles;
}

static int compareFloats(const void* a, const void* b)
{
    float x = *(const float*)a;
    float y = *(const float*)b;
    return (x > y) - (x < y);
}

/// Where the line through (0, height, depth) along +X meets the surface: sorted x, at most `room`.
static int intersectLine(const vtMesh* mesh, float height, float depth, float* hits, int room)
{
    int count = 0;
    for (size_t i = 0; i < mesh->indexCount; i += 3) {
        vtVec3 p[3];
        double side[3];
        for (size_t k = 0; k < 3; ++k) {
            p[k] = getPosition(mesh, i + k);
        }
        for (int k = 0; k < 3; ++k) {
            vtVec3 a = p[(k + 1) % 3];
            vtVec3 b = p[(k + 2) % 3];
            side[k] = ((double)a.y - height) * ((double)b.z - depth) -
                      ((double)a.z - depth) * ((double)b.y - height);
        }
        bool inside =
            (side[0] > 0 && side[1] > 0 && side[2] > 0) || (side[0] < 0 && side[1] < 0 && side[2] < 0);
        if (inside) {
            double sum = side[0] + side[1] + side[2];
            assert_true(count < room);
            hits[count++] = (float)((side[0] * p[0].x + side[1] * p[1].x + side[2] * p[2].x) / sum);
        }
    }
    qsort(hits, (size_t)count, sizeof *hits, compareFloats);
    return count;
}

// ------------------------------------------------------------------------------------------------ table

static void testNames(void** state)
{
    (void)state;
    const char* const names[] = {"sphere", "torus", "knot",    "goblet", "bottle", "diamond",
                                 "cube",   "plane", "tumbler", "water",  "panel"};
    for (int i = 0; i < 11; ++i) {
        assert_string_equal(vtShapeName(i), names[i]);
        assert_true(strlen(vtShapeSummary(i)) > 10);
    }
    assert_null(vtShapeName(11));
    assert_null(vtShapeName(-1));
    assert_null(vtShapeSummary(11));
    assert_null(vtShapeSummary(-1));
}

static void testUnknownName(void** state)
{
    (void)state;
    vtMesh mesh;
    memset(&mesh, 0x5a, sizeof mesh);
    vtError error;
    assert_int_equal(vtCreateShape("teapot", &mesh, &error), vt_errorArgument);
    assert_int_equal(error.result, vt_errorArgument);
    assert_string_equal(error.message,
                        "shape 'teapot' is unknown; the shapes are sphere, torus, knot, goblet, bottle, "
                        "diamond, cube, plane, tumbler, water and panel");
    assert_null(mesh.positions);
    assert_int_equal(mesh.indexCount, 0);
    assert_int_equal(vtCreateShape("", &mesh, NULL), vt_errorArgument);
}

// -------------------------------------------------------------------------------------------- all shapes

static void testClosedAndOutward(void** state)
{
    (void)state;
    for (int i = 0; vtShapeName(i) != NULL; ++i) {
        vtMesh mesh = createShape(vtShapeName(i));
        const bool open = strcmp(vtShapeName(i), "plane") == 0; // by design
        assert_int_equal(mesh.openEdgeCount, open ? 4 : 0);
        assert_int_equal(mesh.degenerateCount, 0);
        assert_false(mesh.normalsComputed);
        assert_true(open || measureVolume(&mesh) > 0.0);
        assert_true(mesh.indexCount / 3 <= 60000);
        vtDestroyMesh(&mesh);
    }
}

static void testNormals(void** state)
{
    (void)state;
    for (int i = 0; vtShapeName(i) != NULL; ++i) {
        vtMesh mesh = createShape(vtShapeName(i));
        for (size_t k = 0; k < mesh.indexCount; ++k) {
            vtVec3 area = getArea(&mesh, k - k % 3);
            vtVec3 normal = getNormal(&mesh, k);
            assert_true(vtLength(area) > 0.0f);
            assert_float_equal(vtLength(normal), 1.0f, 1e-5f);
            // Smooth shapes are cut so finely that no triangle turns more than 8 degrees from the surface.
            assert_true(vtDot(vtNormalize(area), normal) > 0.99f);
        }
        vtDestroyMesh(&mesh);
    }
}

static void testExtents(void** state)
{
    (void)state;
    for (int i = 0; vtShapeName(i) != NULL; ++i) {
        vtMesh mesh = createShape(vtShapeName(i));
        vtVec3 size = vtSub(mesh.boundsMax, mesh.boundsMin);
        vtVec3 sum = vtAdd(mesh.boundsMax, mesh.boundsMin);
        const char* name = vtShapeName(i);
        const float extent = strcmp(name, "torus") == 0     ? 2.8f
                             : strcmp(name, "cube") == 0    ? 1.2f
                             : strcmp(name, "plane") == 0   ? 4.0f
                             : strcmp(name, "tumbler") == 0 ? 1.8f
                             : strcmp(name, "water") == 0   ? 1.12f
                                                            : 2.0f;
        // No ring of the tumbler lies right on top of its rim.
        assert_float_equal(fmaxf(size.x, fmaxf(size.y, size.z)), extent, extent == 1.8f ? 1e-4f : 1e-5f);
        assert_float_equal(vtLength(sum), strcmp(name, "water") == 0 ? 0.39f : 0.0f, 1e-4f);
        vtDestroyMesh(&mesh);
    }
}

static void testTopology(void** state)
{
    (void)state;
    const int euler[] = {2, 0, 0, 2, 2, 2, 2, 0, 2, 2, 2}; // 2 - 2 * holes
    for (int i = 0; vtShapeName(i) != NULL; ++i) {
        vtMesh mesh = createShape(vtShapeName(i));
        assert_true(mesh.openEdgeCount > 0 || measureEuler(&mesh) == euler[i]);
        vtDestroyMesh(&mesh);
    }
}

// --------------------------------------------------------------------------------------------- each shape

/// A slice's area is a rectangle's less its corners', summed over the thickness in fine steps.
static double volumeOfPanel(const vtPanelDef* def)
{
    const double most = 0.5 * fmin((double)def->width, (double)def->height),
                 half = 0.5 * (double)def->thickness;
    const double radius = fmin((double)def->radius, most), bevel = fmin((double)def->bevel, most);
    const double drop = fmin(bevel, half);
    double volume = 0.0;
    const int steps = 20000;
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) / steps * half, above = fmax(z - (half - drop), 0.0);
        const double inset =
            drop > 0.0 ? bevel * (1.0 - sqrt(fmax(1.0 - above * above / (drop * drop), 0.0))) : 0.0;
        const double round = fmax(radius - inset, 0.0);
        const double area = ((double)def->width - 2.0 * inset) * ((double)def->height - 2.0 * inset) -
                            (4.0 - (double)VT_PI) * round * round;
        volume += 2.0 * area * half / steps;
    }
    return volume;
}

static void testPanel(void** state)
{
    (void)state;
    const vtPanelDef defs[] = {
        vtDefaultPanelDef(),
        {.width = 320, .height = 200, .radius = 24, .bevel = 12, .thickness = 20},
        {.width = 1, .height = 3, .radius = 0, .bevel = 0, .thickness = 0.1f},    // a slab
        {.width = 1, .height = 3, .radius = 0.2f, .bevel = 0, .thickness = 0.1f}, // sharp edges
        {.width = 1, .height = 1, .radius = 9, .bevel = 0.2f, .thickness = 2},    // round
        {.width = 2, .height = 1, .radius = 0.1f, .bevel = 0.3f, .thickness = 0.2f},
        {.width = 2, .height = 1, .radius = 0.5f, .bevel = 5, .thickness = 0.2f}, // no flat middle
        {.width = 1, .height = 1, .radius = 0, .bevel = 5, .thickness = 5},
    };
    for (size_t i = 0; i < sizeof defs / sizeof defs[0]; ++i) {
        vtMesh mesh;
        vtError error;
        assert_int_equal(vtCreatePanel(&defs[i], &mesh, &error), vt_ok);
        assert_int_equal(mesh.openEdgeCount, 0);
        assert_false(mesh.normalsComputed);
        const vtVec3 size = vtSub(mesh.boundsMax, mesh.boundsMin);
        assert_float_equal(size.x, defs[i].width, 1e-5f * defs[i].width);
        assert_float_equal(size.y, defs[i].height, 1e-5f * defs[i].height);
        assert_float_equal(size.z, defs[i].thickness, 1e-5f * defs[i].thickness);
        const double volume = measureVolume(&mesh), exact = volumeOfPanel(&defs[i]);
        assert_true(volume < 1.0001 * exact && volume > 0.95 * exact); // its facets lie within
        for (size_t k = 0; k < mesh.indexCount; ++k) {
            const vtVec3 area = getArea(&mesh, k - k % 3), normal = getNormal(&mesh, k);
            assert_float_equal(vtLength(normal), 1.0f, 1e-5f);
            assert_true(vtLength(area) == 0.0f || vtDot(vtNormalize(area), normal) > 0.99f);
        }
        vtDestroyMesh(&mesh);
    }
}

static void testPanelNumbers(void** state)
{
    (void)state;
    vtMesh mesh;
    vtError error;
    const vtPanelDef bad[] = {
        {.width = 0, .height = 1, .radius = 0, .bevel = 0, .thickness = 1},
        {.width = 1, .height = NAN, .radius = 0, .bevel = 0, .thickness = 1},
        {.width = 1, .height = 1, .radius = -1, .bevel = 0, .thickness = 1},
        {.width = 1, .height = 1, .radius = 0, .bevel = INFINITY, .thickness = 1},
        {.width = 1, .height = 1, .radius = 0, .bevel = 0, .thickness = 1e7f},
    };
    const char* const names[] = {"width", "height", "radius", "bevel", "thickness"};
    for (size_t i = 0; i < 5; ++i) {
        assert_int_equal(vtCreatePanel(&bad[i], &mesh, &error), vt_errorArgument);
        assert_non_null(strstr(error.message, names[i]));
        assert_null(mesh.positions);
    }
    assert_int_equal(vtCreatePanel(NULL, &mesh, &error), vt_errorArgument);
    assert_int_equal(vtCreatePanel(&bad[0], NULL, &error), vt_errorArgument);
}

static void testSphere(void** state)
{
    (void)state;
    vtMesh mesh = createShape("sphere");
    double exact = 4.0 / 3.0 * (double)VT_PI;
    assert_true(fabs(measureVolume(&mesh) / exact - 1.0) < 0.01);
    for (size_t i = 0; i < mesh.indexCount; ++i) {
        assert_float_equal(vtLength(getPosition(&mesh, i)), 1.0f, 1e-6f);
        assert_true(vtLength(vtSub(getPosition(&mesh, i), getNormal(&mesh, i))) < 1e-6f);
    }
    vtDestroyMesh(&mesh);
}

static void testTorus(void** state)
{
    (void)state;
    vtMesh mesh = createShape("torus");
    double exact = 2.0 * (double)VT_PI * (double)VT_PI * 1.0 * 0.4 * 0.4;
    assert_true(fabs(measureVolume(&mesh) / exact - 1.0) < 0.01);
    for (size_t i = 0; i < mesh.indexCount; ++i) {
        vtVec3 p = getPosition(&mesh, i);
        vtVec3 spoke = vtNormalize((vtVec3){p.x, 0.0f, p.z});
        vtVec3 offset = vtSub(p, spoke);
        assert_float_equal(vtLength(offset), 0.4f, 1e-6f);
        assert_true(vtLength(vtSub(vtNormalize(offset), getNormal(&mesh, i))) < 1e-5f);
    }
    vtDestroyMesh(&mesh);
}

/// The tube does not run into itself: a ball of radius 0.08 laid on it from outside, anywhere, holds no other
/// part of it. (Samples: each 37th triangle against each 5th.)
static void testKnot(void** state)
{
    (void)state;
    vtMesh mesh = createShape("knot");
    const float radius = 0.08f; // strands are 0.17 apart
    for (size_t i = 0; i < mesh.indexCount; i += 3 * 37) {
        vtVec3 centre = vtMulAdd(getPosition(&mesh, i), radius, getNormal(&mesh, i));
        for (size_t k = 0; k < mesh.indexCount; k += 3 * 5) {
            assert_true(vtLength(vtSub(getPosition(&mesh, k), centre)) > 0.999f * radius);
        }
    }
    vtDestroyMesh(&mesh);
}

static void assertHollow(const char* name, float height)
{
    vtMesh mesh = createShape(name);
    float x[8];
    int count = intersectLine(&mesh, height, 0.0013f, x, 8);
    assert_int_equal(count, 4);
    assert_true(x[1] - x[0] >= 0.02f && x[1] - x[0] <= 0.06f);
    assert_true(x[3] - x[2] >= 0.02f && x[3] - x[2] <= 0.06f);
    assert_true(x[2] - x[1] > 0.4f);
    vtDestroyMesh(&mesh);
}

static void testVesselsAreHollow(void** state)
{
    (void)state;
    assertHollow("goblet", 0.4f);
    assertHollow("goblet", 0.8f);
    assertHollow("bottle", -0.3f);
    assertHollow("bottle", 0.0f);
    // The goblet's stem is solid; the bottle's neck is not.
    vtMesh mesh = createShape("goblet");
    float x[8];
    assert_int_equal(intersectLine(&mesh, -0.4567f, 0.0013f, x, 8), 2);
    vtDestroyMesh(&mesh);
    mesh = createShape("bottle");
    assert_int_equal(intersectLine(&mesh, 0.7654f, 0.0013f, x, 8), 4);
    assert_true(x[1] - x[0] >= 0.02f);
    vtDestroyMesh(&mesh);
}

/// Wherever a line crosses glass, it crosses at least 0.02 of it.
static void testVesselWalls(void** state)
{
    (void)state;
    const char* const names[] = {"goblet", "bottle"};
    for (int i = 0; i < 2; ++i) {
        vtMesh mesh = createShape(names[i]);
        for (float height = -0.95f; height < 0.96f; height += 0.0371f) {
            float x[16];
            int count = intersectLine(&mesh, height, 0.0013f, x, 16);
            assert_true(count >= 2 && count % 2 == 0);
            for (int k = 0; k < count; k += 2) {
                assert_true(x[k + 1] - x[k] >= 0.02f);
            }
        }
        vtDestroyMesh(&mesh);
    }
}

/// Counts the flat faces by their directions, and checks the angles of the cut.
static void testDiamond(void** state)
{
    (void)state;
    vtMesh mesh = createShape("diamond");
    const float degree = VT_PI / 180.0f;
    vtVec3 faces[256];
    int faceCount = 0, tables = 0, bezels = 0, mains = 0, girdle = 0;
    for (size_t i = 0; i < mesh.indexCount; i += 3) {
        vtVec3 normal = getNormal(&mesh, i);
        assert_true(vtLength(vtSub(normal, getNormal(&mesh, i + 1))) == 0.0f);
        assert_true(vtDot(normal, vtNormalize(getArea(&mesh, i))) > 0.999999f);
        int face = 0;
        while (face < faceCount && vtDot(faces[face], normal) < 0.99999f) {
            ++face;
        }
        if (face < faceCount) {
            continue;
        }
        assert_true(faceCount < 256);
        faces[faceCount++] = normal;
        float slope = acosf(vtClamp(normal.y, -1.0f, 1.0f)) / degree;
        tables += slope < 0.01f;
        bezels += fabsf(slope - 34.5f) < 0.02f;
        mains += fabsf(slope - (180.0f - 40.75f)) < 0.02f;
        girdle += fabsf(slope - 90.0f) < 0.05f;
    }
    assert_int_equal(tables, 1);
    assert_int_equal(bezels, 8);
    assert_int_equal(mains, 8);
    assert_int_equal(girdle, 96);
    assert_int_equal(faceCount - girdle, 57);
    // Table 57 % of the diameter; total depth = crown + girdle + pavilion.
    float tableRadius = 0.0f;
    for (size_t i = 0; i < mesh.indexCount; ++i) {
        vtVec3 p = getPosition(&mesh, i);
        if (p.y > mesh.boundsMax.y - 1e-5f) {
            tableRadius = fmaxf(tableRadius, hypotf(p.x, p.z));
        }
    }
    assert_float_equal(tableRadius, 0.57f, 1e-5f);
    float depth = 0.43f * tanf(34.5f * degree) + 0.06f + tanf(40.75f * degree);
    assert_float_equal(mesh.boundsMax.y - mesh.boundsMin.y, depth, 1e-5f);
    vtDestroyMesh(&mesh);
}

static void testCube(void** state)
{
    (void)state;
    vtMesh mesh = createShape("cube");
    assert_int_equal(mesh.indexCount, 36);
    assert_non_null(mesh.texcoords);
    assert_float_equal(measureVolume(&mesh), 1.2 * 1.2 * 1.2, 1e-5);
    for (size_t i = 0; i < mesh.indexCount; ++i) {
        assert_true(vtDot(vtNormalize(getArea(&mesh, i - i % 3)), getNormal(&mesh, i)) > 0.999999f);
        assert_float_equal(vtDot(getPosition(&mesh, i), getNormal(&mesh, i)), 0.6f, 1e-6f);
    }
    vtDestroyMesh(&mesh);
    mesh = createShape("sphere");
    assert_null(mesh.texcoords);
    vtDestroyMesh(&mesh);
}

static void testPlane(void** state)
{
    (void)state;
    vtMesh mesh = createShape("plane");
    assert_non_null(mesh.texcoords);
    for (size_t i = 0; i < mesh.vertexCount; ++i) {
        vtVec3 p = vtMakeVec3(mesh.positions + 3 * i);
        assert_true(fabsf(p.x) == 2.0f && fabsf(p.y) == 2.0f && p.z == 0.0f);
        assert_true(mesh.normals[3 * i + 2] == 1.0f);
        assert_float_equal(mesh.texcoords[2 * i], (p.x + 2.0f) / 4.0f, 1e-6f);
        assert_float_equal(mesh.texcoords[2 * i + 1], (2.0f - p.y) / 4.0f, 1e-6f);
    }
    for (size_t i = 0; i < mesh.indexCount; i += 3) {
        assert_true(getArea(&mesh, i).z > 0.0f);
    }
    vtDestroyMesh(&mesh);
}

/// Wherever a line crosses the water, it enters and leaves it within the tumbler's glass.
static void testWaterFillsTumbler(void** state)
{
    (void)state;
    vtMesh tumbler = createShape("tumbler");
    vtMesh water = createShape("water");
    int walls = 0, base = 0;
    for (float height = -0.668f; height < 0.27f; height += 0.0037f) {
        float glass[8], wet[8];
        const int count = intersectLine(&tumbler, height, 0.0013f, glass, 8);
        assert_true(count == 2 || count == 4);
        assert_int_equal(intersectLine(&water, height, 0.0013f, wet, 8), 2);
        assert_true(wet[0] > glass[0] + 0.01f && wet[1] < glass[count - 1] - 0.01f);
        if (count == 4) {
            assert_true(wet[0] < glass[1] - 0.01f && wet[1] > glass[2] + 0.01f);
        }
        walls += count == 4;
        base += count == 2;
    }
    assert_true(walls > 200 && base > 2);
    float x[8];
    assert_int_equal(intersectLine(&tumbler, 0.1f, 0.0013f, x, 8), 4);
    assert_float_equal(x[1] - x[0], 0.06f, 1e-3f);
    assert_float_equal(x[3], 0.6f, 1e-3f);
    // Its surface is flat all over the inside, and lies 60 % up.
    const double pi = (double)VT_PI, inside = pi * 0.54 * 0.54 * (0.9 + 0.65);
    assert_true(fabs(measureVolume(&water) / (0.6 * inside) - 1.0) < 0.12); // it overlaps the glass
    assert_true(measureVolume(&tumbler) < measureVolume(&water)); // where they overlap there is glass
    assert_float_equal(water.boundsMax.y, 0.28f, 1e-6f);
    for (size_t i = 0; i < water.vertexCount; ++i) {
        const vtVec3 p = vtMakeVec3(water.positions + 3 * i);
        if (hypotf(p.x, p.z) < 0.545f && p.y > 0.0f) {
            assert_float_equal(p.y, 0.28f, 1e-6f);
            assert_true(water.normals[3 * i + 1] > 0.99999f);
        }
    }
    vtDestroyMesh(&tumbler);
    vtDestroyMesh(&water);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(testNames),
        cmocka_unit_test(testUnknownName),
        cmocka_unit_test(testClosedAndOutward),
        cmocka_unit_test(testNormals),
        cmocka_unit_test(testExtents),
        cmocka_unit_test(testTopology),
        cmocka_unit_test(testPanel),
        cmocka_unit_test(testPanelNumbers),
        cmocka_unit_test(testSphere),
        cmocka_unit_test(testTorus),
        cmocka_unit_test(testKnot),
        cmocka_unit_test(testVesselsAreHollow),
        cmocka_unit_test(testVesselWalls),
        cmocka_unit_test(testDiamond),
        cmocka_unit_test(testCube),
        cmocka_unit_test(testPlane),
        cmocka_unit_test(testWaterFillsTumbler),
    };
    return cmocka_run_group_tests_name("shapes", tests, NULL, NULL);
}
