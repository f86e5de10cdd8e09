// Scenes: put together, placed in the order that decides overlaps, checked, framed; and the media of a path.
#include <math.h>

#include "base/math.h"
#include "scene/media.h"
#include "scene/objects.h"
#include "testing.h"

static vtMesh createShape(const char* name)
{
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateShape(name, &mesh, &error), error);
    return mesh;
}

static vtMaterial glassOf(float ior)
{
    vtMaterial material = vtDefaultMaterial();
    material.ior = ior;
    return material;
}

static vtMaterial paint(void)
{
    vtMaterial material = vtDefaultMaterial();
    material.opaque = true;
    return material;
}

static vtTransform place(float x, float y, float z, float scale)
{
    return (vtTransform){{{scale, 0, 0, x}, {0, scale, 0, y}, {0, 0, scale, z}}};
}

/// Adds an object and names it.
static vtObject* add(vtScene* scene, const char* shape, vtMaterial material, vtTransform toWorld,
                     const char* name)
{
    vtMesh mesh = createShape(shape);
    vtScene one;
    vtError error;
    assert_ok(vtCreateMeshScene(&mesh, &material, &one, &error), error);
    snprintf(one.objects[0].name, sizeof one.objects[0].name, "%s", name);
    assert_ok(vtScene_Append(scene, &one, &toWorld, &error), error);
    return &scene->objects[scene->objectCount - 1];
}

static vtPlacedObject* placeAll(const vtScene* scene, uint32_t* glassCount)
{
    vtPlacedObject* placed;
    vtError error;
    assert_ok(vtPlaceObjects(scene, &placed, glassCount, &error), error);
    return placed;
}

static void assertVector(vtVec3 v, float x, float y, float z, float tolerance)
{
    assert_near(v.x, x, tolerance);
    assert_near(v.y, y, tolerance);
    assert_near(v.z, z, tolerance);
}

// ------------------------------------------------------------------------------------------ put together

static void aMeshMakesASceneOfOneObject(void** state)
{
    (void)state;
    vtMesh mesh = createShape("torus");
    const float* positions = mesh.positions;
    const vtMaterial material = glassOf(1.7f);
    vtScene scene;
    vtError error;
    assert_ok(vtCreateMeshScene(&mesh, &material, &scene, &error), error);
    assert_null(mesh.positions); // taken over
    assert_int_equal(mesh.vertexCount, 0);
    assert_ptr_equal(scene.meshes[0].positions, positions);
    assert_int_equal(scene.meshCount, 1);
    assert_int_equal(scene.materialCount, 1);
    assert_int_equal(scene.objectCount, 1);
    assert_int_equal(scene.imageCount + scene.cameraCount, 0);
    assert_near(scene.materials[0].ior, 1.7f, 0.0f);
    const vtTransform identity = vtIdentityTransform();
    assert_memory_equal(&scene.objects[0].toWorld, &identity, sizeof identity);
    assert_int_equal(scene.objects[0].priority, 0);
    vtDestroyMesh(&mesh);
    vtDestroyScene(&scene);
    assert_null(scene.objects);
    vtDestroyScene(&scene); // once more is safe
}

static void appendedIndicesMoveOn(void** state)
{
    (void)state;
    vtScene scene = {0}, other = {0};
    add(&scene, "sphere", glassOf(1.5f), vtIdentityTransform(), "first");
    add(&other, "cube", glassOf(1.6f), vtIdentityTransform(), "second");
    add(&other, "plane", paint(), vtIdentityTransform(), "third");
    free(scene.images); // room without a picture
    scene.images = calloc(2, sizeof *scene.images);
    scene.imageCount = 2;
    free(other.images);
    other.images = calloc(2, sizeof *other.images);
    other.imageCount = 2;
    other.images[1].pixels = calloc(4, 1);
    other.images[1].width = other.images[1].height = 1;
    other.materials[1].maps[vt_mapBaseColor].image = 1;
    other.materials[1].maps[vt_mapMetallicRoughness].image = 0;
    free(other.cameras);
    other.cameras = calloc(1, sizeof *other.cameras);
    other.cameras[0].view = (vtView){{1, 2, 3}, {0, 0, 0}, 30};
    other.cameraCount = 1;
    other.objects[1].priority = 5;
    const vtTransform away = place(7, 0, 0, 2);
    vtError error;
    assert_ok(vtScene_Append(&scene, &other, &away, &error), error);
    assert_null(other.objects);
    assert_int_equal(other.objectCount + other.meshCount + other.cameraCount, 0);
    assert_int_equal(scene.objectCount, 3);
    assert_int_equal(scene.meshCount, 3);
    assert_int_equal(scene.imageCount, 4);
    for (uint32_t i = 0; i < 3; ++i) {
        assert_int_equal(scene.objects[i].mesh, i);
        assert_int_equal(scene.objects[i].material, i);
    }
    assert_string_equal(scene.objects[2].name, "third");
    assert_int_equal(scene.objects[2].priority, 5);
    assert_int_equal(scene.materials[1].maps[vt_mapBaseColor].image, -1); // none stays none
    assert_int_equal(scene.materials[1].maps[vt_mapMetallicRoughness].image, -1);
    assert_int_equal(scene.materials[2].maps[vt_mapBaseColor].image, 3);
    assert_int_equal(scene.materials[2].maps[vt_mapMetallicRoughness].image, 2);
    assert_non_null(scene.images[3].pixels);
    assertVector(scene.cameras[0].view.eye, 1, 2, 3, 0.0f); // cameras stay where they are
    vtScene nothing = {0};
    assert_ok(vtScene_Append(&scene, &nothing, &away, &error), error);
    assert_int_equal(scene.objectCount, 3);
    vtDestroyScene(&scene);
}

static void appendedTransformsMultiply(void** state)
{
    (void)state;
    const vtTransform inner = {{{0, -2, 0, 1}, {2, 0, 0, 2}, {0, 0, 3, -1}}};
    const vtTransform outer = {{{1, 0.5f, 0, 4}, {0, 1, 0, 5}, {-1, 0, 2, 6}}};
    vtScene scene = {0}, other = {0};
    add(&other, "cube", glassOf(1.5f), inner, "");
    vtError error;
    assert_ok(vtScene_Append(&scene, &other, &outer, &error), error);
    const vtVec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-3, 0.5f, 2}};
    for (size_t i = 0; i < sizeof points / sizeof points[0]; ++i) {
        const vtVec3 wanted = vtTransformPoint(&outer, vtTransformPoint(&inner, points[i]));
        const vtVec3 p = vtTransformPoint(&scene.objects[0].toWorld, points[i]);
        assertVector(p, wanted.x, wanted.y, wanted.z, 1e-5f);
    }
    vtDestroyScene(&scene);
}

// ----------------------------------------------------------------------------------------------- order

static const char* nameOf(const vtScene* scene, const vtPlacedObject* placed)
{
    return scene->objects[placed->object].name;
}

static void priorityThenVolumeThenOpaque(void** state)
{
    (void)state;
    vtScene scene = {0};
    add(&scene, "plane", paint(), vtIdentityTransform(), "floor")->priority = 100;
    add(&scene, "sphere", glassOf(1.5f), place(0, 0, 0, 1.0f), "outer");
    add(&scene, "sphere", glassOf(1.3f), place(0, 0, 0, 0.5f), "inner");
    add(&scene, "sphere", glassOf(1.4f), place(9, 0, 0, 3.0f), "chosen")->priority = 2;
    add(&scene, "sphere", glassOf(1.4f), place(0, 0, 0, 0.1f), "last")->priority = -1;
    add(&scene, "sphere", glassOf(1.4f), place(0, 0, 0, -0.4f), "turned inside out");
    static const char* const order[] = {"chosen", "turned inside out", "inner", "outer", "last", "floor"};
    uint32_t glassCount;
    vtPlacedObject* placed = placeAll(&scene, &glassCount);
    assert_int_equal(glassCount, 5);
    for (int i = 0; i < 6; ++i) {
        assert_string_equal(nameOf(&scene, &placed[i]), order[i]);
        const vtObject* object = &scene.objects[placed[i].object];
        assert_ptr_equal(placed[i].mesh, &scene.meshes[object->mesh]);
        assert_ptr_equal(placed[i].material, &scene.materials[object->material]);
        assert_int_equal(placed[i].meshIndex, object->mesh);
        assert_int_equal(placed[i].mirrored, i == 1);
    }
    free(placed);
    vtDestroyScene(&scene);
}

/// Goes on to the next permutation of 0 to count - 1; false after the last.
static bool permute(uint32_t* order, int count)
{
    int i = count - 2;
    while (i >= 0 && order[i] > order[i + 1]) {
        --i;
    }
    if (i < 0) {
        return false;
    }
    int k = count - 1;
    while (order[k] < order[i]) {
        --k;
    }
    uint32_t kept = order[i];
    order[i] = order[k];
    order[k] = kept;
    for (int a = i + 1, b = count - 1; a < b; ++a, --b) {
        kept = order[a];
        order[a] = order[b];
        order[b] = kept;
    }
    return true;
}

/// Whatever the order of the scene's objects, they are placed as at first. The scene is given back changed.
static void assertOrderFree(vtScene* scene)
{
    enum { most = 7 };
    const int count = (int)scene->objectCount;
    assert_true(count <= most);
    uint32_t order[most], glassCount;
    vtObject objects[most];
    char wanted[most][64];
    memcpy(objects, scene->objects, (size_t)count * sizeof *objects);
    vtPlacedObject* placed = placeAll(scene, &glassCount);
    for (int i = 0; i < count; ++i) {
        order[i] = (uint32_t)i;
        strcpy(wanted[i], nameOf(scene, &placed[i]));
    }
    free(placed);
    do {
        for (int i = 0; i < count; ++i) {
            scene->objects[i] = objects[order[i]];
        }
        placed = placeAll(scene, &glassCount);
        for (int i = 0; i < count; ++i) {
            assert_string_equal(nameOf(scene, &placed[i]), wanted[i]);
        }
        free(placed);
    } while (permute(order, count));
}

static void orderOfObjectsDoesNotMatter(void** state)
{
    (void)state;
    vtScene scene = {0};
    add(&scene, "sphere", glassOf(1.5f), place(0, 0, 0, 1.0f), "a");
    add(&scene, "sphere", glassOf(1.5f), place(2, 0, 0, 1.0f), "b"); // of the same volume
    add(&scene, "sphere", glassOf(1.5f), place(2, 1, 0, 1.0f), "c");
    add(&scene, "sphere", glassOf(1.6f), place(2, 1, 0, 1.0f), "d"); // at one place
    add(&scene, "cube", glassOf(1.5f), place(0, 0, 0, 0.5f), "e");
    add(&scene, "plane", paint(), place(0, 0, -2, 1.0f), "f");
    assertOrderFree(&scene);
    vtDestroyScene(&scene);
}

// Volumes so near to one another that neighbours count as equal, but not the first and the last.
static void nearVolumesKeepAnOrder(void** state)
{
    (void)state;
    vtScene scene = {0};
    static const char* const names[] = {"a", "b", "c", "d", "e"};
    for (int i = 0; i < 5; ++i) {
        add(&scene, "cube", glassOf(1.5f), place(-3.0f * (float)i, 0, 0, 1.0f + 5e-5f * (float)i), names[i]);
    }
    assertOrderFree(&scene);
    vtDestroyScene(&scene);
}

// ------------------------------------------------------------------------------------------ transforms

static void inverseTransformsLeadBack(void** state)
{
    (void)state;
    static const vtTransform transforms[] = {
        {{{1, 0, 0, 5}, {0, 1, 0, -6}, {0, 0, 1, 7}}},
        {{{0, 0, 40, 1}, {30, 0, 0, 2}, {0, 20, 0, 3}}},
        {{{-1, 0, 0, 0}, {0, 2, 0.5f, 0}, {0, 0, 0.1f, 0}}},
        {{{1e-3f, 0, 0, 1}, {0, 1e-3f, 2e-4f, 1}, {0, 0, -1e-3f, 1}}},
        {{{1e4f, 0, 0, 0}, {0, 1e-3f, 0, 0}, {0, 0, 1, 0}}},
    };
    for (size_t i = 0; i < sizeof transforms / sizeof transforms[0]; ++i) {
        vtScene scene = {0};
        add(&scene, "cube", glassOf(1.5f), transforms[i], "");
        uint32_t glassCount;
        vtPlacedObject* placed = placeAll(&scene, &glassCount);
        const vtVec3 points[] = {{0, 0, 0}, {1, 2, 3}, {-0.5f, 0.25f, -1}};
        for (int k = 0; k < 3; ++k) {
            const vtVec3 there = vtTransformPoint(&placed[0].toWorld, points[k]);
            const vtVec3 back = vtTransformPoint(&placed[0].toObject, there);
            assertVector(back, points[k].x, points[k].y, points[k].z, 2e-3f);
        }
        assert_int_equal(placed[0].mirrored, i == 2 || i == 3);
        free(placed);
        vtDestroyScene(&scene);
    }
}

// The normal of a mirrored, unevenly scaled and sheared triangle is that of its corners in the world.
static void normalsStayUpright(void** state)
{
    (void)state;
    const vtTransform t = {{{-2, 0, 0.3f, 1}, {0.2f, 0.5f, 0, 2}, {0, 0.1f, 3, 3}}};
    vtScene scene = {0};
    add(&scene, "sphere", glassOf(1.5f), t, "");
    uint32_t glassCount;
    vtPlacedObject* placed = placeAll(&scene, &glassCount);
    assert_true(placed[0].mirrored);
    const vtMesh* mesh = placed[0].mesh;
    for (uint32_t i = 0; i < mesh->indexCount; i += 3 * 37) {
        vtVec3 own[3], world[3];
        for (int k = 0; k < 3; ++k) {
            own[k] = vtMakeVec3(mesh->positions + 3 * (size_t)mesh->indices[i + (uint32_t)k]);
            world[k] = vtTransformPoint(&t, own[k]);
        }
        const vtVec3 G = vtCross(vtSub(own[1], own[0]), vtSub(own[2], own[0]));
        const vtVec3 wanted = vtCross(vtSub(world[1], world[0]), vtSub(world[2], world[0]));
        if (vtLength(G) < 1e-6f) {
            continue; // at a pole
        }
        const vtVec3 turned = vtNormalize(vtTransformNormal(&placed[0].toObject, G));
        assert_near(vtDot(turned, vtNormalize(wanted)), -1.0f, 1e-3f); // clockwise now
        // And it points away from the middle.
        assert_true(vtDot(turned, vtSub(world[0], (vtVec3){1, 2, 3})) > 0.0f);
    }
    free(placed);
    vtDestroyScene(&scene);
}

static void absorptionIsALogarithm(void** state)
{
    (void)state;
    vtScene scene = {0};
    vtMaterial material = glassOf(1.5f);
    material.attenuationColor = (vtVec3){1.0f, 0.5f, 0.0f};
    material.attenuationDistance = 2.0f;
    add(&scene, "cube", material, place(0, 0, 0, 10.0f), ""); // a world unit, whatever the scale
    uint32_t glassCount;
    vtPlacedObject* placed = placeAll(&scene, &glassCount);
    const vtVec3 a = placed[0].absorption;
    assertVector(a, 0.0f, 0.34657f, 6.9078f, 1e-4f); // ln 2 / 2; black takes no more than a million's part
    assert_near(expf(-2.0f * a.y), 0.5f, 1e-5f);
    free(placed);
    scene.materials[0].attenuationDistance = 0.0f;
    placed = placeAll(&scene, &glassCount);
    assertVector(placed[0].absorption, 0.0f, 0.0f, 0.0f, 0.0f);
    free(placed);
    vtDestroyScene(&scene);
}

/// Numbers that are floats, while their squares and products are not.
static void whatIsTooFarIsRefused(void** state)
{
    (void)state;
    const float corners[] = {0.0f, 0.0f, 0.0f, 1e30f, 0.0f, 0.0f, 0.0f, 1e30f, 1e30f};
    const vtMeshDef def = {.positions = corners, .vertexCount = 3, .indexCount = 3};
    const vtMaterial material = vtDefaultMaterial();
    vtMesh mesh;
    vtScene scene;
    vtError error;
    assert_int_equal(vtCreateMesh(&def, "far", &mesh, &error), vt_ok);
    assert_true(isfinite(mesh.volume));
    assert_int_equal(vtCreateMeshScene(&mesh, &material, &scene, &error), vt_ok);
    assert_int_equal(vtValidateScene(&scene, &error), vt_errorGeometry);
    assert_non_null(strstr(error.message, "reaches 1e+30 from the origin"));
    vtDestroyScene(&scene);
}

static void boxesHoldTheirObjects(void** state)
{
    (void)state;
    const vtTransform t = {{{0.6f, -0.8f, 0, 3}, {0.8f, 0.6f, 0, 0}, {0, 0, -2, 1}}};
    vtScene scene = {0};
    add(&scene, "knot", glassOf(1.5f), t, "");
    uint32_t glassCount;
    vtPlacedObject* placed = placeAll(&scene, &glassCount);
    const vtMesh* mesh = placed[0].mesh;
    for (uint32_t i = 0; i < mesh->vertexCount; ++i) {
        const vtVec3 p = vtTransformPoint(&t, vtMakeVec3(mesh->positions + 3 * (size_t)i));
        assert_true(p.x >= placed[0].low.x - 1e-5f && p.y >= placed[0].low.y - 1e-5f);
        assert_true(p.z >= placed[0].low.z - 1e-5f && p.z <= placed[0].high.z + 1e-5f);
        assert_true(p.x <= placed[0].high.x + 1e-5f && p.y <= placed[0].high.y + 1e-5f);
    }
    free(placed);
    vtDestroyScene(&scene);
}

static void pointsLieWithin(void** state)
{
    (void)state;
    vtScene scene = {0};
    add(&scene, "torus", glassOf(1.5f), (vtTransform){{{-2, 0, 0, 5}, {0, 2, 0, 0}, {0, 0, 2, 0}}}, "");
    uint32_t glassCount;
    vtPlacedObject* placed = placeAll(&scene, &glassCount);
    // Radii 2 and 0.8 about (5, 0, 0); mirrored.
    const struct {
        vtVec3 point;
        bool within;
    } cases[] = {
        {{7, 0, 0}, true},        {{5, 0, 0}, false},    {{3, 0, 0}, true},     {{5, 0, 2.5f}, true},
        {{5, 0.7f, 2}, true},     {{5, 0.9f, 2}, false}, {{7.75f, 0, 0}, true}, {{7.9f, 0, 0}, false},
        {{7.4f, 0, 1.9f}, false}, {{5, 0, 1.1f}, false}, {{5, 0, 1.25f}, true}, {{100, 0, 0}, false},
        {{0, 0, 0}, false},       {{5, 100, 2}, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        const float x = cases[i].point.x - 5.0f, z = cases[i].point.z;
        const float ring = sqrtf(x * x + z * z) - 2.0f, y = cases[i].point.y;
        const bool wanted = ring * ring + y * y < 0.64f; // the closed form agrees with the table
        if (wanted != cases[i].within || vtPlacedObject_Contains(&placed[0], cases[i].point) != wanted) {
            fail_msg("point %zu: %d, table %d", i, wanted, cases[i].within);
        }
    }
    free(placed);
    vtDestroyScene(&scene);
}

// ----------------------------------------------------------------------------------------------- errors

/// The sentence of a scene that cannot be drawn holds the words.
static void assertRefused(const vtScene* scene, vtResult result, const char* words)
{
    vtPlacedObject* placed = (vtPlacedObject*)1;
    uint32_t glassCount;
    vtError error;
    assert_int_equal(vtPlaceObjects(scene, &placed, &glassCount, &error), result);
    assert_null(placed);
    assert_int_equal(error.result, result);
    if (strstr(error.message, words) == NULL) {
        fail_msg("'%s' is not in: %s", words, error.message);
    }
    assert_int_equal(vtValidateScene(scene, &error), result);
    assert_int_equal(vtValidateScene(scene, NULL), result);
}

static void emptyScenesAreRefused(void** state)
{
    (void)state;
    const vtScene scene = {0};
    assertRefused(&scene, vt_errorGeometry, "it has 0 objects; it must have 1 to 4096");
}

static void tooManyObjectsAreRefused(void** state)
{
    (void)state;
    vtScene scene = {0};
    add(&scene, "cube", glassOf(1.5f), vtIdentityTransform(), "");
    const vtObject object = scene.objects[0];
    free(scene.objects);
    scene.objects = calloc(VT_MAX_OBJECTS + 1, sizeof *scene.objects);
    for (uint32_t i = 0; i <= VT_MAX_OBJECTS; ++i) {
        scene.objects[i] = object;
        scene.objects[i].toWorld = place(2.0f * (float)i, 0, 0, 1);
    }
    vtError error;
    scene.objectCount = VT_MAX_OBJECTS;
    assert_ok(vtValidateScene(&scene, &error), error);
    scene.objectCount = VT_MAX_OBJECTS + 1;
    assertRefused(&scene, vt_errorGeometry, "it has 4097 objects; it must have 1 to 4096");
    vtDestroyScene(&scene);
}

static void badTransformsAreRefused(void** state)
{
    (void)state;
    vtScene scene = {0};
    add(&scene, "cube", glassOf(1.5f), vtIdentityTransform(), "");
    add(&scene, "cube", glassOf(1.5f), vtIdentityTransform(), "lid");
    static const vtTransform bad[] = {
        {{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}},
        {{{1, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}}},
        {{{1, 1, 0, 0}, {1, 1, 0, 0}, {0, 0, 1, 0}}}, // two axes on one line
        {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, NAN, 0}}},
        {{{1, 0, 0, NAN}, {0, 1, 0, 0}, {0, 0, 1, 0}}},
        {{{1, 0, 0, 0}, {0, 1, 0, INFINITY}, {0, 0, 1, 0}}},
        {{{1e-20f, 0, 0, 0}, {0, 1e-20f, 0, 0}, {0, 0, 1e-20f, 0}}},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        scene.objects[1].toWorld = bad[i];
        assertRefused(&scene, vt_errorGeometry, "object 1 ('lid')");
        scene.objects[1].toWorld = vtIdentityTransform();
        scene.objects[0].toWorld = bad[i];
        assertRefused(&scene, vt_errorGeometry, "scene: object 0 is scaled to nothing along an axis");
        scene.objects[0].toWorld = vtIdentityTransform();
    }
    scene.objects[1].toWorld = (vtTransform){{{1e30f, 0, 0, 0}, {0, 1e30f, 0, 0}, {0, 0, 1e30f, 0}}};
    assertRefused(&scene, vt_errorGeometry, "scene: object 1 ('lid') reaches ");
    vtDestroyScene(&scene);
}

static void badNumbersAreRefused(void** state)
{
    (void)state;
    vtScene scene = {0};
    add(&scene, "cube", glassOf(1.5f), vtIdentityTransform(), "die");
    scene.objects[0].mesh = 1;
    assertRefused(&scene, vt_errorGeometry,
                  "object 0 ('die') has mesh 1 and material 0, but there are 1 and 1");
    scene.objects[0].mesh = 0;
    scene.objects[0].material = 7;
    assertRefused(&scene, vt_errorGeometry, "has mesh 0 and material 7");
    scene.objects[0].material = 0;
    const float bad[] = {0.24f, 4.01f, -1.5f, NAN, INFINITY};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        scene.materials[0].opaque = false;
        scene.materials[0].ior = bad[i];
        assertRefused(&scene, vt_errorArgument, "it must be from 0.25 to 4");
        scene.materials[0].opaque = true; // its index does not matter
        vtError error;
        assert_ok(vtValidateScene(&scene, &error), error);
    }
    vtDestroyScene(&scene);
}

static bool isThin(const vtScene* scene, uint32_t object)
{
    vtPlacedObject* placed;
    uint32_t glassCount;
    vtError error;
    bool thin = false;
    assert_ok(vtPlaceObjects(scene, &placed, &glassCount, &error), error);
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        thin = thin || (placed[i].object == object && placed[i].thin);
    }
    vtFree(placed);
    return thin;
}

/// Nothing says what is on either side of a sheet inside other glass.
static void openGlassInGlassIsAThinWall(void** state)
{
    (void)state;
    vtScene scene = {0};
    add(&scene, "cube", glassOf(1.5f), place(0, 0, 0, 4), "block");
    add(&scene, "plane", glassOf(1.5f), vtIdentityTransform(), "sheet");
    assert_true(isThin(&scene, 1) && !isThin(&scene, 0));
    scene.materials[1].opaque = true;
    assert_false(isThin(&scene, 1));
    scene.materials[1].opaque = false;
    scene.objects[1].toWorld = place(0, 0, 8, 1); // beside it
    assert_false(isThin(&scene, 1));
    scene.objects[1].toWorld = vtIdentityTransform();
    scene.materials[0].thin = true; // which encloses nothing
    assert_false(isThin(&scene, 1));
    scene.materials[0].thin = false;
    scene.objects[0].body = scene.objects[1].body = 1; // it bounds the block
    assert_false(isThin(&scene, 1));
    vtDestroyScene(&scene);
}

// ------------------------------------------------------------------------------------------------ framing

static void boundsAreThoseOfTheGlass(void** state)
{
    (void)state;
    vtScene scene = {0};
    vtVec3 low, high;
    add(&scene, "plane", paint(), place(0, 0, -2, 10), "floor");
    vtScene_Bounds(&scene, &low, &high); // nothing else there
    assertVector(low, -20, -20, -2, 1e-4f);
    assertVector(high, 20, 20, -2, 1e-4f);
    add(&scene, "cube", glassOf(1.5f), place(1, 0, 0, 1), "");
    add(&scene, "cube", glassOf(1.5f), place(0, 3, 0, -2), "");
    vtScene_Bounds(&scene, &low, &high);
    assertVector(low, -1.2f, -0.6f, -1.2f, 1e-4f);
    assertVector(high, 1.6f, 4.2f, 1.2f, 1e-4f);
    vtDestroyScene(&scene);
}

static void opaqueFloorsDoNotPushTheCameraAway(void** state)
{
    (void)state;
    vtScene scene = {0};
    add(&scene, "sphere", glassOf(1.5f), place(1, 0, 0, 1), "");
    const vtView alone = vtViewOfScene(&scene, 45.0f, 1.0f);
    const vtView ofMesh = vtViewOfMesh(&scene.meshes[0], 45.0f, 1.0f);
    const vtVec3 moved = vtSub(alone.eye, ofMesh.eye);
    assertVector(moved, 1, 0, 0, 1e-4f);
    assertVector(alone.target, 1, 0, 0, 1e-4f);
    add(&scene, "plane", paint(), place(0, 0, -2, 10), "floor");
    const vtView view = vtViewOfScene(&scene, 45.0f, 1.0f);
    assert_memory_equal(&view, &alone, sizeof view);
    scene.materials[0].opaque = true;
    const vtView all = vtViewOfScene(&scene, 45.0f, 1.0f);
    assert_true(vtLength(vtSub(all.eye, all.target)) > 5.0f * vtLength(vtSub(view.eye, view.target)));
    scene.materials[0].opaque = false;
    scene.objects[0].toWorld = place(0, 0, 0, 3); // three times as large, so three times as far
    const vtView large = vtViewOfScene(&scene, 45.0f, 1.0f);
    assert_near(vtLength(vtSub(large.eye, large.target)), 3.0f * vtLength(vtSub(view.eye, view.target)),
                1e-3f);
    vtDestroyScene(&scene);
}

// ------------------------------------------------------------------------------------------------- media

static void mediaHoldFour(void** state)
{
    (void)state;
    vtMedia media = {{0}};
    assert_int_equal(vtMedia_Top(&media), 0);
    const uint32_t ids[VT_MAX_NESTED] = {7, 1000, 3, 5};
    const uint32_t tops[VT_MAX_NESTED] = {7, 7, 3, 3};
    for (int i = 0; i < VT_MAX_NESTED; ++i) {
        assert_false(vtMedia_Holds(&media, ids[i]));
        assert_true(vtMedia_Toggle(&media, ids[i]));
        assert_true(vtMedia_Holds(&media, ids[i]));
        assert_int_equal(vtMedia_Top(&media), tops[i]);
    }
    const vtMedia full = media;
    assert_false(vtMedia_Toggle(&media, 1)); // no room: nothing changes
    assert_memory_equal(&media, &full, sizeof media);
    assert_int_equal(vtMedia_Top(&media), 3);
    assert_true(vtMedia_Toggle(&media, 3)); // out
    assert_int_equal(vtMedia_Top(&media), 5);
    assert_true(vtMedia_Toggle(&media, 1)); // now there is room
    assert_int_equal(vtMedia_Top(&media), 1);
    assert_true(vtMedia_Toggle(&media, 1) && vtMedia_Toggle(&media, 5) && vtMedia_Toggle(&media, 7));
    assert_int_equal(vtMedia_Top(&media), 1000);
    assert_true(vtMedia_Toggle(&media, 1000));
    assert_int_equal(vtMedia_Top(&media), 0);
}

/// How far from the target the eye of the default view stands, of a ball of glass and something opaque beside
/// it.
static float standsAt(const char* shape, vtTransform toWorld, vtVec3* target)
{
    vtScene scene = {0};
    add(&scene, "sphere", glassOf(1.5f), place(0, 0, 0, 1), "");
    if (shape != NULL) {
        add(&scene, shape, paint(), toWorld, "");
    }
    const vtView view = vtViewOfScene(&scene, 45.0f, 1.0f);
    *target = view.target;
    vtDestroyScene(&scene);
    return vtLength(vtSub(view.eye, view.target));
}

/// A lamp is seen whole; a floor, however it lies, a wall, a room and a hill are not framed.
static void whatBelongsToTheGlassIsFramed(void** state)
{
    (void)state;
    vtVec3 at;
    const float alone = standsAt(NULL, place(0, 0, 0, 1), &at);
    const vtTransform post = {{{0.5f, 0, 0, 0}, {0, 8, 0, -9}, {0, 0, 0.5f, 0}}};
    assert_true(standsAt("cube", post, &at) > 4.0f * alone);
    assert_near(at.y, -6.4f, 0.1f); // from -13.8 to 1
    const vtTransform floor = {{{25, 0, 0, 0}, {0, 0, 25, -1}, {0, 25, 0, 0}}};
    const vtTransform slanted = {{{3, 0, 0, 0}, {0, 2, 2, -4}, {0, -2, 2, 0}}};
    const vtTransform label = {{{0.4f, 0, 0, 1.5f}, {0, 0.4f, 0, 0}, {0, 0, 0.4f, 0}}};
    assert_near(standsAt("plane", floor, &at), alone, 1e-4f);
    assert_near(standsAt("plane", slanted, &at), alone, 1e-4f);
    assert_near(standsAt("cube", place(0, 0, 0, 12), &at), alone, 1e-4f);     // a room
    assert_near(standsAt("sphere", place(0, -25, 0, 24), &at), alone, 1e-4f); // a hill
    assert_near(at.x, 0.0f, 1e-5f);
    assert_true(standsAt("plane", label, &at) > alone);                   // a small thing that is flat
    assert_true(standsAt("cube", place(0, 0, 0, 3), &at) > 1.5f * alone); // a shade
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(aMeshMakesASceneOfOneObject),
        cmocka_unit_test(appendedIndicesMoveOn),
        cmocka_unit_test(appendedTransformsMultiply),
        cmocka_unit_test(priorityThenVolumeThenOpaque),
        cmocka_unit_test(orderOfObjectsDoesNotMatter),
        cmocka_unit_test(nearVolumesKeepAnOrder),
        cmocka_unit_test(inverseTransformsLeadBack),
        cmocka_unit_test(normalsStayUpright),
        cmocka_unit_test(absorptionIsALogarithm),
        cmocka_unit_test(whatIsTooFarIsRefused),
        cmocka_unit_test(boxesHoldTheirObjects),
        cmocka_unit_test(pointsLieWithin),
        cmocka_unit_test(emptyScenesAreRefused),
        cmocka_unit_test(tooManyObjectsAreRefused),
        cmocka_unit_test(badTransformsAreRefused),
        cmocka_unit_test(badNumbersAreRefused),
        cmocka_unit_test(openGlassInGlassIsAThinWall),
        cmocka_unit_test(boundsAreThoseOfTheGlass),
        cmocka_unit_test(opaqueFloorsDoNotPushTheCameraAway),
        cmocka_unit_test(mediaHoldFour),
        cmocka_unit_test(whatBelongsToTheGlassIsFramed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
