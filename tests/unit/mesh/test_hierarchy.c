// The records of hierarchies: every triangle lies in one leaf and in all boxes and cones above it, whatever
// the mesh, and no way down is longer than the walk's stack allows.
#include "base/octahedral.h"
#include "hierarchy_cases.h"
#include "mesh/hierarchy_record.h"
#include "shaders_es3/common/constants.h"

typedef struct Key {
    float numbers[11]; // all that a vertex has
    uint32_t vertex;
} Key;

typedef struct Corners {
    uint32_t vertices[3]; // the least first
} Corners;

typedef struct Check {
    const vtMesh* mesh;
    const vtHierarchy* hierarchy;
    uint32_t* equal; // vertices: the one that stands for it
    uint8_t* seen;   // records
    Corners* found;  // triangles of leaves, in the order of the walk
    uint32_t foundCount, coneCount, childCount;
    int deepest;
} Check;

static int compareKeys(const void* a, const void* b)
{
    return memcmp(((const Key*)a)->numbers, ((const Key*)b)->numbers, sizeof((const Key*)a)->numbers);
}

static int compareCorners(const void* a, const void* b)
{
    return memcmp(a, b, sizeof(Corners));
}

/// Which vertices are equal in all they have.
static uint32_t* findEqual(const vtMesh* mesh)
{
    Key* keys = calloc(mesh->vertexCount, sizeof *keys);
    uint32_t* equal = malloc(mesh->vertexCount * sizeof *equal);
    for (uint32_t i = 0; i < mesh->vertexCount; ++i) {
        keys[i].vertex = i;
        memcpy(keys[i].numbers, mesh->positions + 3 * (size_t)i, 3 * sizeof(float));
        memcpy(keys[i].numbers + 3, mesh->normals + 3 * (size_t)i, 3 * sizeof(float));
        if (mesh->texcoords != NULL) {
            memcpy(keys[i].numbers + 6, mesh->texcoords + 2 * (size_t)i, 2 * sizeof(float));
        }
        if (mesh->colors != NULL) {
            memcpy(keys[i].numbers + 8, mesh->colors + 3 * (size_t)i, 3 * sizeof(float));
        }
    }
    qsort(keys, mesh->vertexCount, sizeof *keys, compareKeys);
    for (uint32_t i = 0; i < mesh->vertexCount; ++i) {
        const bool isNew = i == 0 || compareKeys(&keys[i - 1], &keys[i]) != 0;
        equal[keys[i].vertex] = isNew ? keys[i].vertex : equal[keys[i - 1].vertex];
    }
    free(keys);
    return equal;
}

static Corners makeCorners(const Check* check, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t v[3] = {check->equal[a], check->equal[b], check->equal[c]};
    const int first = v[0] <= v[1] && v[0] <= v[2] ? 0 : v[1] <= v[2] ? 1 : 2;
    return (Corners){{v[first], v[(first + 1) % 3], v[(first + 2) % 3]}};
}

/// The unit normal in double; false where there is none. `corners`: vertices.
static bool findNormal(const Check* check, const uint32_t* corners, double n[3])
{
    double p[3][3], e[2][3];
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            const vtVec3 o = check->hierarchy->space.origin;
            const float origin[3] = {o.x, o.y, o.z};
            p[i][k] = (double)(check->mesh->positions[3 * (size_t)corners[i] + (size_t)k] - origin[k]);
        }
    }
    for (int k = 0; k < 3; ++k) {
        e[0][k] = p[1][k] - p[0][k];
        e[1][k] = p[2][k] - p[0][k];
    }
    for (int k = 0; k < 3; ++k) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        n[k] = e[0][x] * e[1][y] - e[0][y] * e[1][x];
    }
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; ++k) {
        n[k] /= length > 0.0 ? length : 1.0;
    }
    return length > 0.0;
}

// -------------------------------------------------------------------------------------------------- walk

/// The corners lie in the box above, as the mesh has them.
static void checkLeaf(Check* check, uint32_t number, const uint32_t box[6])
{
    const vtHierarchy* h = check->hierarchy;
    const uint32_t* record = h->records + VT_RECORD_WORDS * (size_t)number;
    const uint32_t* corners = h->corners + 4 * (size_t)number;
    const vtVec3 o = h->space.origin;
    const float origin[3] = {o.x, o.y, o.z}, unit = h->space.unit;
    const float low[3] = {h->gridLow.x, h->gridLow.y, h->gridLow.z};
    const float scale[3] = {h->gridScale.x, h->gridScale.y, h->gridScale.z};
    for (int i = 0; i < 4; ++i) {
        assert_true(corners[i] < check->mesh->vertexCount);
        const float* position = check->mesh->positions + 3 * (size_t)corners[i];
        for (int k = 0; k < 3; ++k) {
            float p;
            memcpy(&p, record + 4 * i + k, sizeof p);
            assert_true(p == (position[k] - origin[k]) * unit);
            const double step = ((double)p - (double)low[k]) * (double)scale[k];
            assert_true(step >= box[k] + 0.01 && step <= box[k + 3] + 1 - 0.01); // with margin
            assert_true(step >= 0.99 && step <= 4095.01);
        }
        const uint32_t packed = vtPackNormal(check->mesh->normals + 3 * (size_t)corners[i]);
        assert_int_equal(record[4 * i + 3], packed);
    }
    check->found[check->foundCount++] = makeCorners(check, corners[0], corners[1], corners[2]);
    if (corners[3] != corners[2]) {
        check->found[check->foundCount++] = makeCorners(check, corners[0], corners[2], corners[3]);
    }
}

/// No triangle below faces a direction that the cone rules out. `count` triangles from `first` on.
static void checkCone(Check* check, const uint32_t* texel, uint32_t first)
{
    float m[3], square = 0.0f;
    for (int k = 0; k < 3; ++k) {
        const int byte = (int)(texel[k] >> 24);
        m[k] = (float)(byte < 128 ? byte : byte - 256) / 21.0f;
        square += m[k] * m[k];
    }
    ++check->childCount;
    if (square <= 1.0f) {
        return;
    }
    ++check->coneCount;
    const float length = sqrtf(square);
    for (uint32_t trial = 0; trial < 8; ++trial) {
        // Against the cone, up to where m . d = -1.
        const float seedling = unit(check->childCount * 8 + trial);
        const float along = trial == 0 ? 1.0f / length : 1.0f / length + (1.0f - 1.0f / length) * seedling;
        const vtVec3 axis = vtScale((vtVec3){m[0], m[1], m[2]}, -1.0f / length);
        const vtVec3 side = vtNormalize(vtCross(axis, onSphere(check->childCount * 8 + trial)));
        const vtVec3 d = vtMulAdd(vtScale(axis, along), sqrtf(fmaxf(1.0f - along * along, 0.0f)), side);
        for (uint32_t i = first; i < check->foundCount; ++i) {
            double n[3];
            if (findNormal(check, check->found[i].vertices, n)) {
                assert_true(n[0] * (double)d.x + n[1] * (double)d.y + n[2] * (double)d.z <= 1e-6);
            }
        }
    }
}

static void readBox(const uint32_t* texel, uint32_t box[6])
{
    for (int k = 0; k < 3; ++k) {
        box[k] = texel[k] & 0xfffu;
        box[k + 3] = texel[k] >> 12 & 0xfffu;
    }
}

/// `level`: of inner nodes, 1 for the root. `box`: low and high steps of what is above.
static void checkRecord(Check* check, uint32_t number, const uint32_t outer[6], int level)
{
    const uint32_t* record = check->hierarchy->records + VT_RECORD_WORDS * (size_t)number;
    assert_true(number < check->hierarchy->recordCount);
    assert_int_equal(check->seen[number]++, 0);
    if (vtRecord_IsLeaf(record)) {
        checkLeaf(check, number, outer);
        return;
    }
    check->deepest = level > check->deepest ? level : check->deepest;
    assert_int_equal(check->hierarchy->corners[4 * (size_t)number], VT_NO_TRIANGLE);
    assert_true(record[3] > number);
    bool isLast = false;
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t* texel = record + 4 * i;
        if (texel[0] == 4095u) { // absent, and so are those that follow
            assert_true(texel[1] == 4095u && texel[2] == 4095u);
            isLast = true;
            continue;
        }
        uint32_t box[6];
        const uint32_t first = check->foundCount;
        assert_false(isLast);
        readBox(texel, box);
        for (int k = 0; k < 3; ++k) {
            assert_true(box[k] >= outer[k] && box[k + 3] <= outer[k + 3] && box[k] <= box[k + 3]);
        }
        checkRecord(check, record[3] + i, box, level + 1);
        checkCone(check, texel, first);
    }
}

/// The triangles that leaves hold are those of the mesh that have an area.
static void checkTriangles(Check* check)
{
    const uint32_t count = check->mesh->indexCount / 3;
    Corners* all = malloc((size_t)count * sizeof *all);
    uint32_t allCount = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t* v = check->mesh->indices + 3 * (size_t)i;
        double n[3];
        if (findNormal(check, v, n)) {
            all[allCount++] = makeCorners(check, v[0], v[1], v[2]);
        }
    }
    assert_int_equal(check->foundCount, allCount);
    qsort(all, allCount, sizeof *all, compareCorners);
    qsort(check->found, allCount, sizeof *all, compareCorners);
    assert_memory_equal(check->found, all, allCount * sizeof *all);
    free(all);
}

/// Fills the counts of *check, whose mesh and hierarchy are given.
static void checkHierarchy(Check* check)
{
    static const uint32_t all[6] = {0, 0, 0, 4095, 4095, 4095};
    check->equal = findEqual(check->mesh);
    check->seen = calloc(check->hierarchy->recordCount, 1);
    check->found = malloc((size_t)check->mesh->indexCount * sizeof *check->found);
    checkRecord(check, 0, all, 1);
    for (uint32_t i = 0; i < check->hierarchy->recordCount; ++i) {
        assert_int_equal(check->seen[i], 1);
    }
    assert_true(check->deepest <= VT_HIERARCHY_STACK + 1);
    checkTriangles(check);
    free(check->equal);
    free(check->seen);
    free(check->found);
}

// ------------------------------------------------------------------------------------------------- tests

static void records(void** state)
{
    (void)state;
    for (int i = 0; i < hierarchyCaseCount; ++i) {
        vtMesh mesh;
        vtHierarchy hierarchy;
        vtError error;
        print_message("%s\n", makeHierarchyCase(i, &mesh));
        assert_ok(vtCreateHierarchy(&mesh, &hierarchy, &error), error);
        Check check = {.mesh = &mesh, .hierarchy = &hierarchy};
        checkHierarchy(&check);
        assert_true(hierarchy.cost >= 1.0f && hierarchy.cost == hierarchy.refitCost);
        vtDestroyHierarchy(&hierarchy);
        vtDestroyMesh(&mesh);
    }
}

/// Whatever size a mesh has that floats can have, up to where its box is wider than any float; refitted, too.
static void sizes(void** state)
{
    (void)state;
    vtMesh plain;
    vtError error;
    assert_ok(vtCreateShape("torus", &plain, &error), error);
    const float reach = fmaxf(plain.boundsMax.x, fmaxf(plain.boundsMax.y, plain.boundsMax.z));
    for (int i = 0; i < 6; ++i) {
        vtMesh mesh;
        vtHierarchy hierarchy;
        const float size = (float[]){1e-37f, 1e-20f, 1.0f, 1e20f, 1.6e38f, 3.4e38f}[i] / reach;
        const uint32_t count = 3 * plain.vertexCount;
        float* positions = malloc(count * sizeof *positions);
        for (uint32_t k = 0; k < count; ++k) {
            positions[k] = plain.positions[k] * size;
        }
        const vtMeshDef def = {.positions = positions,
                               .vertexCount = plain.vertexCount,
                               .indices = plain.indices,
                               .indexCount = plain.indexCount};
        assert_ok(vtCreateMesh(&def, "torus", &mesh, &error), error);
        assert_ok(vtCreateHierarchy(&mesh, &hierarchy, &error), error);
        assert_ok(vtHierarchy_Refit(&hierarchy, &mesh, &error), error);
        Check check = {.mesh = &mesh, .hierarchy = &hierarchy};
        checkHierarchy(&check);
        assert_true(hierarchy.space.unit > 0.0f && isfinite(1.0f / hierarchy.space.unit));
        vtDestroyHierarchy(&hierarchy);
        vtDestroyMesh(&mesh);
        free(positions);
    }
    vtDestroyMesh(&plain);
}

/// A mesh as thick as floats are apart, along one axis, and less along the others.
static void thinAsARounding(void** state)
{
    (void)state;
    const float under = nextafterf(0x1p-29f, 0.0f), high = 0x1p-29f, little = 0x1.fcp-128f;
    const float positions[12] = {-little, 0.0f,   high, little, 0.0f,   high,
                                 -little, little, high, little, little, under};
    const uint32_t indices[6] = {0, 1, 2, 2, 1, 3};
    const vtMeshDef def = {.positions = positions, .vertexCount = 4, .indices = indices, .indexCount = 6};
    vtMesh mesh;
    vtHierarchy hierarchy;
    vtError error;
    assert_ok(vtCreateMesh(&def, "thin", &mesh, &error), error);
    assert_ok(vtCreateHierarchy(&mesh, &hierarchy, &error), error);
    const vtVec3 low = hierarchy.gridLow, scale = hierarchy.gridScale;
    assert_true(isfinite(low.x) && isfinite(low.y) && isfinite(low.z));
    assert_true(isfinite(scale.x) && isfinite(scale.y) && isfinite(scale.z));
    vtDestroyHierarchy(&hierarchy);
    vtDestroyMesh(&mesh);
}

/// Of round things most children have cones, and most leaves two triangles.
static void quality(void** state)
{
    (void)state;
    static const char* const shapes[] = {"sphere", "torus", "knot", "goblet"};
    for (int i = 0; i < 5; ++i) {
        vtMesh mesh;
        vtHierarchy hierarchy;
        vtError error;
        if (i < 4) {
            assert_ok(vtCreateShape(shapes[i], &mesh, &error), error);
        } else {
            makeUnindexed("torus", &mesh);
        }
        assert_ok(vtCreateHierarchy(&mesh, &hierarchy, &error), error);
        Check check = {.mesh = &mesh, .hierarchy = &hierarchy};
        checkHierarchy(&check);
        assert_true(check.coneCount > 9 * (uint64_t)check.childCount / 10);
        assert_true(VT_RECORD_WORDS * sizeof(uint32_t) * hierarchy.recordCount < 48 * (mesh.indexCount / 3));
        assert_true(hierarchy.cost < 30.0f);
        vtDestroyHierarchy(&hierarchy);
        vtDestroyMesh(&mesh);
    }
}

static void slices(void** state)
{
    (void)state;
    static const uint32_t works[] = {1, 50, 1000};
    for (int i = 0; i < hierarchyCaseCount; ++i) {
        vtMesh mesh;
        vtHierarchy atOnce, sliced;
        vtError error;
        makeHierarchyCase(i, &mesh);
        assert_ok(vtCreateHierarchy(&mesh, &atOnce, &error), error);
        const uint32_t work = works[mesh.indexCount > 100000 ? 2 : i % 3];
        vtHierarchyBuild* build = vtBeginHierarchy(&mesh, &error);
        uint32_t steps = 1;
        for (float last = 0.0f; !vtHierarchyBuild_Step(build, work); ++steps) {
            const float progress = vtHierarchyBuild_Progress(build);
            assert_true(progress >= last && progress <= 1.0f);
            last = progress;
        }
        assert_true(steps >= mesh.indexCount / 3 / work);
        assert_true(vtHierarchyBuild_Progress(build) == 1.0f);
        assert_ok(vtFinishHierarchy(build, &sliced, &error), error);
        assert_int_equal(sliced.recordCount, atOnce.recordCount);
        assert_memory_equal(sliced.records, atOnce.records,
                            VT_RECORD_WORDS * sizeof(uint32_t) * (size_t)atOnce.recordCount);
        assert_memory_equal(sliced.corners, atOnce.corners,
                            4 * sizeof(uint32_t) * (size_t)atOnce.recordCount);
        vtDestroyHierarchy(&sliced);
        vtDestroyHierarchy(&atOnce);
        vtDestroyMesh(&mesh);
    }
}

/// At whatever step it is given up, or finished at once, all is freed.
static void leavingEarly(void** state)
{
    (void)state;
    vtMesh mesh;
    vtHierarchy hierarchy;
    vtError error;
    makeUnindexed("diamond", &mesh);
    bool isDone = false;
    for (int steps = 0; !isDone; ++steps) {
        vtHierarchyBuild* build = vtBeginHierarchy(&mesh, &error);
        for (int i = 0; i < steps && !isDone; ++i) {
            isDone = vtHierarchyBuild_Step(build, 60);
        }
        if (steps % 2 == 0) {
            vtAbandonHierarchy(build);
        } else {
            assert_ok(vtFinishHierarchy(build, &hierarchy, &error), error);
            vtDestroyHierarchy(&hierarchy);
        }
    }
    vtAbandonHierarchy(NULL);
    vtDestroyMesh(&mesh);
}

/// Bends the mesh: turns it about the y axis, more the higher.
static void twist(vtMesh* mesh, float turns)
{
    for (uint32_t i = 0; i < mesh->vertexCount; ++i) {
        float* vectors[2] = {mesh->positions + 3 * (size_t)i, mesh->normals + 3 * (size_t)i};
        const float angle = turns * 6.2831853f * vectors[0][1], c = cosf(angle), s = sinf(angle);
        for (int k = 0; k < 2; ++k) {
            const float x = vectors[k][0], z = vectors[k][2];
            vectors[k][0] = c * x + s * z;
            vectors[k][2] = c * z - s * x;
        }
    }
}

static void refit(void** state)
{
    (void)state;
    for (int i = 0; i < hierarchyCaseCount; ++i) {
        vtMesh mesh;
        vtHierarchy hierarchy;
        vtError error;
        makeHierarchyCase(i, &mesh);
        assert_ok(vtCreateHierarchy(&mesh, &hierarchy, &error), error);
        for (int round = 0; round < 2; ++round) {
            assert_ok(vtHierarchy_Refit(&hierarchy, &mesh, &error), error);
            assert_true(round == 1 || fabsf(hierarchy.refitCost / hierarchy.cost - 1.0f) < 1e-3f);
            assert_true(round == 1 || !vtHierarchy_IsWorn(&hierarchy));
            Check check = {.mesh = &mesh, .hierarchy = &hierarchy};
            checkHierarchy(&check);
            assert_true(i > 2 || check.coneCount > check.childCount / 2);
            if (i == 9 || i >= 11) { // where a twist could take an area away or a far one's precision
                break;
            }
            twist(&mesh, 0.05f);
        }
        vtDestroyHierarchy(&hierarchy);
        vtDestroyMesh(&mesh);
    }
}

/// Vertices in other places: what lay together no longer does.
static void wear(void** state)
{
    (void)state;
    vtMesh mesh;
    vtHierarchy hierarchy;
    vtError error;
    assert_ok(vtCreateShape("torus", &mesh, &error), error);
    assert_ok(vtCreateHierarchy(&mesh, &hierarchy, &error), error);
    for (uint32_t i = 0; i < 3 * mesh.vertexCount; ++i) {
        mesh.positions[i] = unit(i);
    }
    assert_ok(vtHierarchy_Refit(&hierarchy, &mesh, &error), error);
    assert_true(vtHierarchy_IsWorn(&hierarchy));
    vtDestroyHierarchy(&hierarchy);
    vtDestroyMesh(&mesh);
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
        vtDestroyMesh(&mesh);
    }
    assert_int_equal(vtCreateFineShape("goblet", 10000, &mesh, &error), vt_errorArgument);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(records),      cmocka_unit_test(quality), cmocka_unit_test(slices),
        cmocka_unit_test(leavingEarly), cmocka_unit_test(refit),   cmocka_unit_test(wear),
        cmocka_unit_test(fineShapes),   cmocka_unit_test(sizes),   cmocka_unit_test(thinAsARounding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
