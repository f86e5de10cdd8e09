// Meshes that change: what is drawn after vtRenderer_UpdateGeometry is what a scene of the new vertices
// shows.
#include <math.h>
#include <string.h>

#include "base/math.h"
#include "mesh/hierarchy.h"
#include "rendering.h"

/// Bends the shape and moves it, so that bounds, grid and normals change.
static void bend(const vtMesh* mesh, float amount, float* positions)
{
    for (uint32_t i = 0; i < mesh->vertexCount; ++i) {
        const float* p = mesh->positions + 3 * (size_t)i;
        positions[3 * i] = p[0] + amount * sinf(3.0f * p[1]);
        positions[3 * i + 1] = p[1] * (1.0f + 0.3f * amount);
        positions[3 * i + 2] = p[2] + 0.1f * amount;
    }
}

static void drawStrict(vtRenderer* renderer, vtTechnique technique, float* directions, uint8_t* pixels)
{
    vtError error;
    vtFrame frame = vtDefaultFrame();
    frame.width = frame.height = side;
    frame.technique = technique;
    frame.fresnel = false;
    assert_ok(vtRenderer_DrawImage(renderer, &frame, pixels, &error), error);
    assert_ok(vtRenderer_ReadDirections(renderer, directions, &error), error);
}

/// Draws the scene as it was updated and as it is when it is set anew; pixels whose directions differ by more
/// than rounding.
static int compare(vtRenderer* renderer, const vtScene* scene, vtTechnique technique)
{
    static float updated[3 * side * side], fresh[3 * side * side];
    static uint8_t pixels[4 * side * side];
    vtError error;
    int differing = 0;
    drawStrict(renderer, technique, updated, pixels);
    assert_ok(vtRenderer_SetScene(renderer, scene, &error), error);
    drawStrict(renderer, technique, fresh, pixels);
    for (int i = 0; i < side * side; ++i) {
        float most = 0.0f;
        for (int k = 0; k < 3; ++k) {
            most = fmaxf(most, fabsf(updated[3 * i + k] - fresh[3 * i + k]));
        }
        differing += most > 1e-3f;
    }
    return differing;
}

static void prepare(vtScene* scene)
{
    vtError error;
    vtPreparation* preparation = vtBeginPreparation(scene);
    assert_non_null(preparation);
    int slices = 1;
    while (!vtPreparation_Step(preparation, 2000)) {
        ++slices;
    }
    assert_true(slices > 3);
    assert_ok(vtEndPreparation(preparation, &error), error);
    assert_non_null(scene->meshes[0].hierarchy);
}

static void movedVerticesAreDrawn(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtMesh mesh;
    vtScene scene;
    const vtMaterial glass = vtDefaultMaterial();
    assert_ok(vtCreateShape("torus", &mesh, &error), error);
    assert_ok(vtCreateMeshScene(&mesh, &glass, &scene, &error), error);
    prepare(&scene);
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    vtMesh* moved = &scene.meshes[0];
    float* positions = malloc(3 * sizeof(float) * moved->vertexCount);
    for (int step = 1; step <= 3; ++step) {
        bend(moved, 0.1f, positions);
        const uint32_t* records = moved->hierarchy->records;
        assert_ok(vtMesh_Update(moved, positions, NULL, &error), error);
        assert_ptr_equal(records, moved->hierarchy->records); // refitted, not built
        assert_ok(vtRenderer_UpdateGeometry(fixture->renderer, vtRenderer_SceneGeometry(fixture->renderer, 0),
                                            moved, &error),
                  error);
        assert_true(compare(fixture->renderer, &scene, vt_techniqueExact) <= side * side / 1000);
        assert_ok(vtRenderer_UpdateGeometry(fixture->renderer, vtRenderer_SceneGeometry(fixture->renderer, 0),
                                            moved, &error),
                  error);
        assert_int_equal(compare(fixture->renderer, &scene, vt_techniqueLayered), 0);
    }
    free(positions);
    vtDestroyScene(&scene);
}

static void wornHierarchiesAreBuiltAnew(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtMesh mesh;
    vtScene scene;
    const vtMaterial glass = vtDefaultMaterial();
    assert_ok(vtCreateShape("knot", &mesh, &error), error);
    assert_ok(vtCreateMeshScene(&mesh, &glass, &scene, &error), error);
    prepare(&scene);
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    vtMesh* moved = &scene.meshes[0];
    float* positions = malloc(3 * sizeof(float) * moved->vertexCount);
    for (uint32_t i = 0; i < moved->vertexCount;
         ++i) { // wound up about its axis: neighbours stay, boxes do not
        const float* p = moved->positions + 3 * (size_t)i;
        const float angle = 9.0f * p[2] + 5.0f * p[0];
        positions[3 * i] = cosf(angle) * p[0] - sinf(angle) * p[1];
        positions[3 * i + 1] = sinf(angle) * p[0] + cosf(angle) * p[1];
        positions[3 * i + 2] = p[2];
    }
    assert_ok(vtMesh_Update(moved, positions, NULL, &error), error);
    assert_true(moved->hierarchy->refitCost == moved->hierarchy->cost);
    assert_ok(vtRenderer_UpdateGeometry(fixture->renderer, vtRenderer_SceneGeometry(fixture->renderer, 0),
                                        moved, &error),
              error);
    assert_true(compare(fixture->renderer, &scene, vt_techniqueExact) <= side * side / 1000);
    free(positions);
    vtDestroyScene(&scene);
}

/// Two spheres of one mesh, apart.
static void createSpheres(vtMesh* mesh)
{
    vtError error;
    vtMesh sphere;
    assert_ok(vtCreateShape("sphere", &sphere, &error), error);
    const uint32_t vertices = sphere.vertexCount, indices = sphere.indexCount;
    float* positions = malloc(6 * sizeof(float) * vertices);
    uint32_t* corners = malloc(2 * sizeof(uint32_t) * indices);
    for (uint32_t i = 0; i < 2 * vertices; ++i) {
        memcpy(positions + 3 * i, sphere.positions + 3 * (i % vertices), 3 * sizeof(float));
        positions[3 * i] += i < vertices ? -1.1f : 1.1f;
    }
    for (uint32_t i = 0; i < 2 * indices; ++i) {
        corners[i] = sphere.indices[i % indices] + (i < indices ? 0 : vertices);
    }
    const vtMeshDef def = {
        .positions = positions, .indices = corners, .vertexCount = 2 * vertices, .indexCount = 2 * indices};
    assert_ok(vtCreateMesh(&def, "spheres", mesh, &error), error);
    free(positions);
    free(corners);
    vtDestroyMesh(&sphere);
}

static void partsMovedIntoEachOtherAreDrawn(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtMesh mesh;
    vtScene scene;
    const vtMaterial glass = vtDefaultMaterial();
    createSpheres(&mesh);
    assert_ok(vtCreateMeshScene(&mesh, &glass, &scene, &error), error);
    prepare(&scene);
    assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
    vtMesh* moved = &scene.meshes[0];
    float* positions = malloc(3 * sizeof(float) * moved->vertexCount);
    for (uint32_t i = 0; i < moved->vertexCount; ++i) {
        memcpy(positions + 3 * i, moved->positions + 3 * i, 3 * sizeof(float));
        positions[3 * i] += positions[3 * i] < 0.0f ? 0.6f : -0.6f;
    }
    assert_ok(vtMesh_Update(moved, positions, NULL, &error), error);
    assert_ok(vtRenderer_UpdateGeometry(fixture->renderer, vtRenderer_SceneGeometry(fixture->renderer, 0),
                                        moved, &error),
              error);
    assert_true(compare(fixture->renderer, &scene, vt_techniqueExact) <= side * side / 1000);
    free(positions);
    vtDestroyScene(&scene);
}

static void badVerticesChangeNothing(void** state)
{
    (void)state;
    vtError error;
    vtMesh mesh;
    assert_ok(vtCreateShape("cube", &mesh, &error), error);
    const size_t count = 3 * (size_t)mesh.vertexCount;
    float* positions = malloc(count * sizeof *positions);
    float* before = malloc(count * sizeof *before);
    memcpy(positions, mesh.positions, count * sizeof *positions);
    memcpy(before, mesh.positions, count * sizeof *before);
    positions[4] = NAN;
    assert_int_equal(vtMesh_Update(&mesh, positions, NULL, &error), vt_errorGeometry);
    assert_non_null(strstr(error.message, "not a finite number"));
    assert_memory_equal(before, mesh.positions, count * sizeof *before);
    free(positions);
    free(before);
    vtDestroyMesh(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(movedVerticesAreDrawn),
        cmocka_unit_test(wornHierarchiesAreBuiltAnew),
        cmocka_unit_test(partsMovedIntoEachOtherAreDrawn),
        cmocka_unit_test(badVerticesChangeNothing),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
