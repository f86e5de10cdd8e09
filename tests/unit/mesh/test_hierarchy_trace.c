// Rays through the records of hierarchies against all triangles one by one in double.
#include <float.h>

#include "hierarchy_cases.h"

typedef struct Ray {
    vtVec3 origin, direction;
    float start;
    int sides;
} Ray;

/// Where a ray meets a triangle's plane.
typedef struct Meeting {
    double distance, u, v, facing; // facing: cosine between direction and normal
} Meeting;

static double dot(const double* a, const double* b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double* a, const double* b, double* c)
{
    for (int k = 0; k < 3; ++k) {
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

static Meeting meet(const vtMesh* mesh, const uint32_t* vertices, const Ray* ray)
{
    const float o[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const double d[3] = {(double)ray->direction.x, (double)ray->direction.y, (double)ray->direction.z};
    double p[3][3], e1[3], e2[3], s[3], n[3], q[3], r[3];
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            p[i][k] = (double)mesh->positions[3 * (size_t)vertices[i] + (size_t)k];
        }
    }
    for (int k = 0; k < 3; ++k) {
        e1[k] = p[1][k] - p[0][k];
        e2[k] = p[2][k] - p[0][k];
        s[k] = (double)o[k] - p[0][k];
    }
    cross(e1, e2, n);
    cross(d, e2, q);
    cross(s, e1, r);
    const double determinant = dot(e1, q);
    return (Meeting){dot(e2, r) / determinant, dot(s, q) / determinant, dot(d, r) / determinant,
                     dot(n, d) / sqrt(dot(n, n) * dot(d, d))};
}

static bool isWanted(const Meeting* m, const Ray* ray, double least)
{
    return (m->facing < -least && (ray->sides & 1) != 0) || (m->facing > least && (ray->sides & 2) != 0);
}

/// What the walk found is there, and nothing that a ray surely meets is nearer or missed. Gives whether there
/// was a hit. `near`: what distances may differ by.
static bool checkRay(const vtMesh* mesh, const vtHierarchy* hierarchy, const Ray* ray, double near)
{
    vtHierarchyHit hit;
    const bool found =
        vtHierarchy_Trace(hierarchy, ray->origin, ray->direction, ray->start, ray->sides, &hit);
    const double tolerance = near / (double)vtLength(ray->direction);
    if (found) {
        const Meeting m = meet(mesh, hit.vertices, ray);
        assert_true(hit.distance > ray->start);
        assert_true(isWanted(&m, ray, -1e-3));
        if (fabs(m.facing) > 0.02) {
            assert_true(fabs(m.distance - (double)hit.distance) <= tolerance);
        }
    }
    for (uint32_t i = 0; i < mesh->indexCount; i += 3) {
        const Meeting m = meet(mesh, mesh->indices + i, ray);
        const double edge = 1e-3;
        const bool surely = m.u > edge && m.v > edge && m.u + m.v < 1.0 - edge && isWanted(&m, ray, 0.02) &&
                            m.distance > (double)ray->start + tolerance;
        if (surely) {
            assert_true(found && (double)hit.distance <= m.distance + tolerance);
        }
        // The weights are those of the triangle that is named.
        if (found && memcmp(mesh->indices + i, hit.vertices, sizeof hit.vertices) == 0 && surely) {
            assert_true(fabs(m.u - (double)hit.u) < 0.02 && fabs(m.v - (double)hit.v) < 0.02);
        }
    }
    return found;
}

/// From around or within the mesh's box, of any length, at times along an axis.
static Ray makeRay(const vtMesh* mesh, uint32_t seed)
{
    const vtVec3 middle = vtScale(vtAdd(mesh->boundsMin, mesh->boundsMax), 0.5f);
    const float size = vtLength(vtSub(mesh->boundsMax, mesh->boundsMin));
    Ray ray = {.sides = 1 + (int)(seed % 3), .start = seed % 5 == 0 ? 0.1f * size : 0.0f};
    ray.origin = vtMulAdd(middle, size * (seed % 2 == 0 ? 1.0f : 0.3f), onSphere(3 * seed));
    const vtVec3 target = vtMulAdd(middle, 0.3f * size * unit(3 * seed + 1), onSphere(3 * seed + 2));
    ray.direction = vtSub(target, ray.origin);
    if (seed % 16 == 7) {
        ray.direction.y = 0.0f;
        ray.direction.z = seed % 32 == 7 ? 0.0f : ray.direction.z;
    }
    const float length = 0.01f + 10.0f * unit(seed + 99u);
    ray.direction = vtScale(vtNormalize(ray.direction), length);
    ray.start /= length;
    return ray;
}

/// Rays, more of them through smaller meshes; gives the number of hits. `tolerance`: of distances, of the
/// mesh's size.
static uint32_t checkRays(const vtMesh* mesh, const vtHierarchy* hierarchy, double tolerance,
                          uint32_t* rayCount)
{
    const double near = tolerance * (double)vtLength(vtSub(mesh->boundsMax, mesh->boundsMin));
    const uint32_t count = mesh->indexCount > 3000 ? 60 : 2000;
    uint32_t hits = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const Ray ray = makeRay(mesh, i);
        hits += checkRay(mesh, hierarchy, &ray, near) ? 1 : 0;
    }
    *rayCount = count;
    return hits;
}

static void againstAll(void** state)
{
    (void)state;
    for (int i = 0; i < hierarchyCaseCount; ++i) {
        vtMesh mesh;
        vtHierarchy hierarchy;
        vtError error;
        uint32_t rays;
        const char* name = makeHierarchyCase(i, &mesh);
        assert_ok(vtCreateHierarchy(&mesh, &hierarchy, &error), error);
        const uint32_t hits =
            checkRays(&mesh, &hierarchy, i == 14 ? 1e-2 : 1e-4, &rays); // floats are bad at slivers
        print_message("%s: %u of %u rays\n", name, hits, rays);
        assert_true(i == 15 ? hits == 0 : i >= 12 ? true : hits > rays / 20);
        vtDestroyHierarchy(&hierarchy);
        vtDestroyMesh(&mesh);
    }
}

/// Into a sphere and out of it, and which side is asked for.
static void sides(void** state)
{
    (void)state;
    vtMesh mesh;
    vtHierarchy hierarchy;
    vtHierarchyHit hit;
    vtError error;
    assert_ok(vtCreateShape("sphere", &mesh, &error), error);
    assert_ok(vtCreateHierarchy(&mesh, &hierarchy, &error), error);
    for (uint32_t i = 0; i < 1000; ++i) {
        const vtVec3 d = onSphere(i), o = vtScale(d, -3.0f);
        assert_true(vtHierarchy_Trace(&hierarchy, o, d, 0.0f, 1, &hit));
        assert_near(hit.distance, 2.0f, 0.01f);
        assert_true(vtHierarchy_Trace(&hierarchy, o, d, 0.0f, 2, &hit));
        assert_near(hit.distance, 4.0f, 0.01f);
        assert_true(vtHierarchy_Trace(&hierarchy, o, d, 0.0f, 3, &hit));
        assert_near(hit.distance, 2.0f, 0.01f);
        assert_true(vtHierarchy_Trace(&hierarchy, o, d, 2.5f, 3, &hit));
        assert_near(hit.distance, 4.0f, 0.01f);
        assert_false(vtHierarchy_Trace(&hierarchy, o, d, 2.5f, 1, &hit));
        assert_false(vtHierarchy_Trace(&hierarchy, o, d, 4.5f, 3, &hit));
        assert_false(vtHierarchy_Trace(&hierarchy, o, vtScale(d, -1.0f), 0.0f, 3, &hit));
    }
    vtDestroyHierarchy(&hierarchy);
    vtDestroyMesh(&mesh);
}

static void refitOfTheSame(void** state)
{
    (void)state;
    for (int i = 0; i < hierarchyCaseCount; ++i) {
        vtMesh mesh;
        vtHierarchy hierarchy, same;
        vtError error;
        makeHierarchyCase(i, &mesh);
        assert_ok(vtCreateHierarchy(&mesh, &hierarchy, &error), error);
        assert_ok(vtCreateHierarchy(&mesh, &same, &error), error);
        assert_ok(vtHierarchy_Refit(&same, &mesh, &error), error);
        for (uint32_t k = 0; k < (i == 11 ? 30 : 1000); ++k) {
            const Ray ray = makeRay(&mesh, k);
            vtHierarchyHit a, b;
            const bool found =
                vtHierarchy_Trace(&hierarchy, ray.origin, ray.direction, ray.start, ray.sides, &a);
            assert_int_equal(found,
                             vtHierarchy_Trace(&same, ray.origin, ray.direction, ray.start, ray.sides, &b));
            assert_true(!found || a.distance == b.distance); // on an edge either triangle will do
        }
        vtDestroyHierarchy(&hierarchy);
        vtDestroyHierarchy(&same);
        vtDestroyMesh(&mesh);
    }
}

static void refitOfAnother(void** state)
{
    (void)state;
    static const char* const shapes[] = {"torus", "knot", "goblet", "cube"};
    for (int i = 0; i < 4; ++i) {
        vtMesh mesh;
        vtHierarchy hierarchy;
        vtError error;
        uint32_t rays;
        assert_ok(vtCreateShape(shapes[i], &mesh, &error), error);
        assert_ok(vtCreateHierarchy(&mesh, &hierarchy, &error), error);
        for (size_t k = 0; k < mesh.vertexCount; ++k) { // stretched, waved and moved
            float* p = mesh.positions + 3 * k;
            p[0] = 2.0f * p[0] + 0.2f * sinf(5.0f * p[1]) + 3.0f;
            p[1] = p[1] + 0.1f * sinf(4.0f * p[2]) - 7.0f;
        }
        mesh.boundsMin = (vtVec3){3.0f - 2.2f, -8.1f, mesh.boundsMin.z};
        mesh.boundsMax = (vtVec3){3.0f + 2.2f, -5.9f, mesh.boundsMax.z};
        assert_ok(vtHierarchy_Refit(&hierarchy, &mesh, &error), error);
        assert_true(checkRays(&mesh, &hierarchy, 1e-4, &rays) > rays / 20);
        vtDestroyHierarchy(&hierarchy);
        vtDestroyMesh(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(againstAll),
        cmocka_unit_test(sides),
        cmocka_unit_test(refitOfTheSame),
        cmocka_unit_test(refitOfAnother),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
