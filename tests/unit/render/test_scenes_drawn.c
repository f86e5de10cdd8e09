// Scenes of several objects, drawn by `exact`: against the reference tracer, and against what must hold
// whatever they show.
#include <math.h>

#include "base/math.h"
#include "image/image.h"
#include "lab/metrics/metrics.h"
#include "lab/metrics/metrics_image.h"
#include "lab/reference/reference.h"
#include "rendering.h"
#include "scene/objects.h"
#include "shaders_es3/common/constants.h"

// Sanitizers make the tracer some ten times slower.
#ifdef __SANITIZE_ADDRESS__
enum { pictureSide = 32, pictureSamples = 4, isSlow = 1 };
#else
enum { pictureSide = 64, pictureSamples = 16, isSlow = 0 };
#endif

/// An object of a scene; what is 0 is as vtDefaultMaterial has it.
typedef struct Part {
    const char* shape;
    vtVec3 at;
    float scale;
    float ior;
    vtVec3 absorb; // what is left after half a unit
    vtVec3 tint;
    vtVec3 color; // opaque
    float roughness;
    float checker; // opaque
} Part;

enum { mostParts = 4 };

typedef struct Case {
    const char* name;
    Part parts[mostParts];
    double within1, lost; // shares of pixels of at most 6 events: at least, at most
    double flip[2];       // checker, studio: at most
} Case;

#define BACKDROP                                                                                             \
    {                                                                                                        \
        .shape = "plane", .at = {0, 0, -4}, .scale = 2, .checker = 8                                         \
    }

// Thresholds lie a little above and below what was measured.
static const Case cases[] = {
    {"two spheres",
     {{.shape = "sphere", .at = {-0.5f, 0, 0.6f}}, {.shape = "sphere", .at = {0.6f, 0.1f, -2}}},
     0.995,
     0.005,
     {0.009, 0.014}},
    {"knot behind cube",
     {{.shape = "cube", .at = {0, 0, 0.6f}}, {.shape = "knot", .at = {0, 0, -2}}},
     0.985,
     0.005,
     {0.02, 0.032}},
    {"three",
     {{.shape = "sphere", .at = {-0.5f, 0, 1}},
      {.shape = "cube", .at = {0.5f, 0, -1}},
      {.shape = "torus", .at = {0, 0, -3.2f}, .ior = 1.4f}},
     0.985,
     0.005,
     {0.01, 0.016}},
    {"sphere in sphere",
     {{.shape = "sphere"}, {.shape = "sphere", .scale = 0.5f, .ior = 2}},
     0.98,
     0.005,
     {0.028, 0.042}},
    {"bubble",
     {{.shape = "sphere"}, {.shape = "sphere", .scale = 0.6f, .ior = 1}},
     0.98,
     0.005,
     {0.025, 0.047}},
    {"touching cubes",
     {{.shape = "cube", .at = {-0.6f, 0, 0}}, {.shape = "cube", .at = {0.6f, 0, 0}, .ior = 1.7f}},
     0.99,
     0.005,
     {0.007, 0.006}},
    {"water in tumbler",
     {{.shape = "tumbler"}, {.shape = "water", .ior = 1.33f}, BACKDROP},
     0.985,
     0.005,
     {0.017, 0.041}},
    {"goblet", {{.shape = "goblet"}, BACKDROP}, 0.985, 0.005, {0.012, 0.025}},
    {"ball in glass",
     {{.shape = "sphere"},
      {.shape = "sphere", .scale = 0.4f, .color = {0.9f, 0.3f, 0.1f}, .roughness = 0.4f}},
     0.995,
     0.005,
     {0.013, 0.026}},
    {"absorbing knot",
     {{.shape = "knot", .absorb = {0.2f, 0.7f, 0.5f}},
      {.shape = "sphere", .at = {0, 0, -2.5f}, .tint = {0.9f, 0.8f, 1}},
      BACKDROP},
     0.985,
     0.005,
     {0.022, 0.046}},
};
enum { caseCount = sizeof cases / sizeof cases[0] };

static vtMaterial materialOf(const Part* part)
{
    vtMaterial material = vtDefaultMaterial();
    material.ior = part->ior > 0.0f ? part->ior : material.ior;
    material.opaque = part->color.x > 0.0f || part->checker > 0.0f;
    material.baseColor = part->color.x > 0.0f ? part->color : material.baseColor;
    material.roughness = part->roughness > 0.0f ? part->roughness : material.roughness;
    material.checker = part->checker;
    material.tint = part->tint.x > 0.0f ? part->tint : material.tint;
    if (part->absorb.x > 0.0f) {
        material.attenuationColor = part->absorb;
        material.attenuationDistance = 0.5f;
    }
    return material;
}

static vtTransform place(vtVec3 at, float scale)
{
    return (vtTransform){{{scale, 0, 0, at.x}, {0, scale, 0, at.y}, {0, 0, scale, at.z}}};
}

static void addPart(vtScene* scene, const Part* part)
{
    vtMesh mesh;
    vtScene one;
    vtError error;
    const vtMaterial material = materialOf(part);
    const vtTransform toWorld = place(part->at, part->scale > 0.0f ? part->scale : 1.0f);
    assert_ok(vtCreateShape(part->shape, &mesh, &error), error);
    assert_ok(vtCreateMeshScene(&mesh, &material, &one, &error), error);
    assert_ok(vtScene_Append(scene, &one, &toWorld, &error), error);
}

/// The parts in their order or, reversed, in the other.
static vtScene makeScene(const Part* parts, bool reversed)
{
    vtScene scene = {0};
    for (int i = 0; i < mostParts; ++i) {
        const Part* part = &parts[reversed ? mostParts - 1 - i : i];
        if (part->shape != NULL) {
            addPart(&scene, part);
        }
    }
    return scene;
}

static void setScene(vtRenderer* renderer, const vtScene* scene)
{
    vtError error;
    assert_ok(vtRenderer_SetScene(renderer, scene, &error), error);
}

static void setParts(vtRenderer* renderer, const Part* parts)
{
    vtScene scene = makeScene(parts, false);
    setScene(renderer, &scene);
    vtDestroyScene(&scene);
}

/// Every object's own index, no Fresnel reflection.
static vtFrame sceneFrame(const vtScene* scene)
{
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.ior = 0.0f;
    frame.view = vtViewOfScene(scene, 45.0f, 1.0f);
    return frame;
}

/// A picture with all that light does, small enough to trace.
static vtFrame pictureFrame(const vtScene* scene)
{
    vtFrame frame = sceneFrame(scene);
    frame.width = frame.height = pictureSide;
    frame.samples = pictureSamples;
    frame.fresnel = true;
    frame.branches = 2;
    return frame;
}

/// A copy of what was drawn.
static void* keep(const void* bytes, size_t size)
{
    void* copy = malloc(size);
    assert_non_null(copy);
    return memcpy(copy, bytes, size);
}

// ---------------------------------------------------------------------------------------------- order

static void orderOfObjectsDoesNotMatter(void** state)
{
    Fixture* fixture = *state;
    setEnvironment(fixture->renderer, "checker");
    for (int i = 0; i < caseCount; ++i) {
        vtScene scene = makeScene(cases[i].parts, false), reversed = makeScene(cases[i].parts, true);
        vtFrame frame = sceneFrame(&scene);
        setScene(fixture->renderer, &scene);
        draw(fixture, &frame);
        uint8_t* pixels = keep(fixture->pixels, sizeof fixture->pixels);
        float* directions = keep(fixture->directions, sizeof fixture->directions);
        setScene(fixture->renderer, &reversed);
        draw(fixture, &frame);
        print_message("  %s\n", cases[i].name);
        assert_memory_equal(pixels, fixture->pixels, sizeof fixture->pixels);
        assert_memory_equal(directions, fixture->directions, sizeof fixture->directions);
        free(pixels);
        free(directions);
        vtDestroyScene(&scene);
        vtDestroyScene(&reversed);
    }
}

// ------------------------------------------------------------------------------------ against the tracer

/// NULL, with a note, in a build without it.
static vtReference* createReference(const vtScene* scene)
{
    vtReference* reference;
    vtError error;
    if (vtCreateReference(scene, &reference, &error) != vt_ok) {
        print_message("skipped: %s\n", error.message);
        return NULL;
    }
    return reference;
}

static void directionsAreThoseOfTheTracer(void** state)
{
    Fixture* fixture = *state;
    for (int i = 0; i < caseCount; ++i) {
        vtScene scene = makeScene(cases[i].parts, false);
        vtReference* reference = createReference(&scene);
        if (reference == NULL) {
            vtDestroyScene(&scene);
            skip();
        }
        vtReferenceImage truth;
        vtError error;
        vtFrame frame = sceneFrame(&scene);
        frame.maxEvents = 16;
        assert_ok(vtReference_Trace(reference, &(vtReferenceDef){.frame = &frame}, &truth, &error), error);
        setScene(fixture->renderer, &scene);
        draw(fixture, &frame);
        int exiting = 0, close = 0, lost = 0, mask = 0;
        for (int p = 0; p < side * side; ++p) {
            const float* d = fixture->directions + 3 * p;
            const float* t = truth.directions + 3 * p;
            const bool isGlass = d[0] != 0.0f || d[1] != 0.0f || d[2] != 0.0f;
            mask += isGlass != (truth.events[p] > 0);
            if (truth.events[p] > 0 && truth.events[p] <= 6 && truth.states[p] != VT_PATH_LOST) {
                ++exiting;
                close += vtDirectionAngle(d, t) < 1.0f;
                lost += d[0] == 2.0f;
            }
        }
        print_message("  %s: %d pixels, %.2f %% within 1 degree, %.2f %% lost, mask %d\n", cases[i].name,
                      exiting, 100.0 * close / exiting, 100.0 * lost / exiting, mask);
        assert_true(exiting > side * side / 20);
        assert_true(close >= cases[i].within1 * exiting);
        assert_true(lost <= cases[i].lost * exiting);
        assert_true(mask <= side * side / 200);
        vtDestroyReferenceImage(&truth);
        vtDestroyReference(reference);
        vtDestroyScene(&scene);
    }
}

static uint8_t* traceBytes(const vtReference* reference, const vtFrame* frame, const char* name)
{
    vtEnvironment environment;
    vtReferenceImage image;
    vtError error;
    assert_ok(vtCreateEnvironment(name, &environment, &error), error);
    const vtReferenceDef def = {
        .frame = frame, .environment = &environment, .samples = frame->samples, .fresnel = frame->fresnel};
    assert_ok(vtReference_Trace(reference, &def, &image, &error), error);
    uint8_t* rgba = malloc(4 * (size_t)frame->width * (size_t)frame->height);
    vtReference_ToSrgb(&image, rgba);
    vtDestroyReferenceImage(&image);
    vtDestroyEnvironment(&environment);
    return rgba;
}

static double flipTo(const Fixture* fixture, const uint8_t* truth)
{
    vtPictureError result;
    vtError error;
    assert_ok(
        vtComparePictureBytes(fixture->pixels, truth, 4, pictureSide, pictureSide, &result, NULL, &error),
        error);
    return result.flip;
}

static void picturesAreThoseOfTheTracer(void** state)
{
    Fixture* fixture = *state;
    static const char* const environments[2] = {"checker", "studio"};
    for (int i = 0; i < caseCount; i += isSlow ? 4 : 1) {
        vtScene scene = makeScene(cases[i].parts, false);
        vtReference* reference = createReference(&scene);
        if (reference == NULL) {
            vtDestroyScene(&scene);
            skip();
        }
        const vtFrame frame = pictureFrame(&scene);
        setScene(fixture->renderer, &scene);
        for (int k = 0; k < 2; ++k) {
            uint8_t* truth = traceBytes(reference, &frame, environments[k]);
            setEnvironment(fixture->renderer, environments[k]);
            draw(fixture, &frame);
            const double flip = flipTo(fixture, truth);
            print_message("  %s, %s: FLIP %.4f\n", cases[i].name, environments[k], flip);
            assert_true(isSlow || flip <= cases[i].flip[k]);
            free(truth);
        }
        vtDestroyReference(reference);
        vtDestroyScene(&scene);
    }
}

// The oftener light that left a path is followed, the nearer the picture comes to the truth.
static void branchesBringThePictureNearer(void** state)
{
    Fixture* fixture = *state;
    static const int named[] = {3, 7};
    for (int i = 0; i < (isSlow ? 1 : 2); ++i) {
        const Case* entry = &cases[named[i]];
        vtScene scene = makeScene(entry->parts, false);
        vtReference* reference = createReference(&scene);
        if (reference == NULL) {
            vtDestroyScene(&scene);
            skip();
        }
        vtFrame frame = pictureFrame(&scene);
        uint8_t* truth = traceBytes(reference, &frame, "studio");
        setScene(fixture->renderer, &scene);
        setEnvironment(fixture->renderer, "studio");
        static const int branches[3] = {-1, 1, 2};
        double flip[3];
        for (int k = 0; k < 3; ++k) {
            frame.branches = branches[k];
            draw(fixture, &frame);
            flip[k] = flipTo(fixture, truth);
        }
        print_message("  %s: FLIP without branches %.4f, one %.4f, two %.4f\n", entry->name, flip[0], flip[1],
                      flip[2]);
        assert_true(flip[0] > flip[1] && flip[1] > flip[2]);
        free(truth);
        vtDestroyReference(reference);
        vtDestroyScene(&scene);
    }
}

// --------------------------------------------------------------------------------------- scene after scene

/// A renderer of its own draws the scene into fixture->pixels and ->directions.
static void drawAfresh(Fixture* fixture, const vtScene* scene, const char* environment, const vtFrame* frame)
{
    vtRenderer* used = fixture->renderer;
    fixture->renderer = createRenderer(fixture);
    setScene(fixture->renderer, scene);
    setEnvironment(fixture->renderer, environment);
    draw(fixture, frame);
    vtDestroyRenderer(fixture->renderer);
    fixture->renderer = used;
}

static void scenesLeaveNoTrace(void** state)
{
    Fixture* fixture = *state;
    setEnvironment(fixture->renderer, "checker");
    size_t textures[caseCount] = {0}, meshes[caseCount] = {0};
    for (int round = 0; round < 2; ++round) {
        static const int order[] = {6, 1, 3, 8}; // light on opaque things is made once
        for (int i = 0; i < 4; ++i) {
            vtScene scene = makeScene(cases[order[i]].parts, false);
            vtFrame frame = sceneFrame(&scene);
            setScene(fixture->renderer, &scene);
            draw(fixture, &frame);
            const vtRendererInfo info = vtRenderer_Info(fixture->renderer);
            if (round == 0) {
                textures[i] = info.textureBytes;
                meshes[i] = info.meshBytes;
                uint8_t* pixels = keep(fixture->pixels, sizeof fixture->pixels);
                float* directions = keep(fixture->directions, sizeof fixture->directions);
                drawAfresh(fixture, &scene, "checker", &frame);
                assert_memory_equal(pixels, fixture->pixels, sizeof fixture->pixels);
                assert_memory_equal(directions, fixture->directions, sizeof fixture->directions);
                free(pixels);
                free(directions);
            } else {
                assert_int_equal(info.textureBytes, textures[i]);
                assert_int_equal(info.meshBytes, meshes[i]);
            }
            vtDestroyScene(&scene);
        }
    }
}

static void movedObjectsAreDrawnWhereTheyAre(void** state)
{
    Fixture* fixture = *state;
    setEnvironment(fixture->renderer, "studio");
    vtScene scene = makeScene(cases[1].parts, false);
    vtFrame frame = sceneFrame(&scene);
    frame.fresnel = true;
    setScene(fixture->renderer, &scene);
    draw(fixture, &frame);
    uint8_t* before = keep(fixture->pixels, sizeof fixture->pixels);
    for (int i = 1; i <= 3; ++i) {
        // The knot comes forward, to the other side of the cube.
        scene.objects[1].toWorld = place((vtVec3){0.1f, 0, -2.0f + 1.5f * (float)i}, 0.6f);
        setScene(fixture->renderer, &scene);
        draw(fixture, &frame);
        uint8_t* pixels = keep(fixture->pixels, sizeof fixture->pixels);
        assert_memory_not_equal(pixels, before, sizeof fixture->pixels);
        drawAfresh(fixture, &scene, "studio", &frame);
        assert_memory_equal(pixels, fixture->pixels, sizeof fixture->pixels);
        free(before);
        before = pixels;
    }
    free(before);
    vtDestroyScene(&scene);
}

// A scene that cannot be drawn leaves the one before.
static void badScenesAreNotTaken(void** state)
{
    Fixture* fixture = *state;
    setEnvironment(fixture->renderer, "sky");
    vtScene scene = makeScene(cases[0].parts, false);
    const vtFrame frame = sceneFrame(&scene);
    setScene(fixture->renderer, &scene);
    draw(fixture, &frame);
    uint8_t* before = keep(fixture->pixels, sizeof fixture->pixels);
    vtError error;
    scene.objects[1].toWorld.rows[1][1] = 0.0f;
    assert_int_equal(vtRenderer_SetScene(fixture->renderer, &scene, &error), vt_errorGeometry);
    assert_non_null(strstr(error.message, "object 1"));
    draw(fixture, &frame);
    assert_memory_equal(before, fixture->pixels, sizeof fixture->pixels);
    free(before);
    vtDestroyScene(&scene);
}

// -------------------------------------------------------------------------------------------- instances

/// `count` objects of one mesh side by side.
static vtScene makeInstances(const char* shape, uint32_t count)
{
    vtScene scene = makeScene((const Part[mostParts]){{.shape = shape}}, false);
    scene.objects = realloc(scene.objects, count * sizeof *scene.objects);
    assert_non_null(scene.objects);
    for (uint32_t i = 1; i < count; ++i) {
        scene.objects[i] = scene.objects[0];
        scene.objects[i].toWorld = place((vtVec3){3.0f * (float)i, 0, 0}, 1.0f + 0.1f * (float)i);
    }
    scene.objectCount = count;
    return scene;
}

static void instancesShareAllMemory(void** state)
{
    Fixture* fixture = *state;
    vtRendererInfo infos[2];
    for (int i = 0; i < 2; ++i) {
        vtScene scene = makeInstances("knot", i == 0 ? 1 : 8);
        vtFrame frame = sceneFrame(&scene);
        frame.fresnel = true;
        setScene(fixture->renderer, &scene);
        draw(fixture, &frame);
        infos[i] = vtRenderer_Info(fixture->renderer);
        vtDestroyScene(&scene);
    }
    assert_int_equal(infos[1].meshBytes, infos[0].meshBytes);
    assert_int_equal(infos[1].textureBytes - infos[0].textureBytes, 7 * 16 * VT_OBJECT_TEXELS);
}

/// The mesh where the transform puts it, in a scene of its own.
static vtScene bake(const char* shape, const vtTransform* t)
{
    vtScene scene = makeScene((const Part[mostParts]){{.shape = shape}}, false);
    vtMesh* mesh = &scene.meshes[0];
    for (size_t i = 0; i < 3 * (size_t)mesh->vertexCount; i += 3) {
        const vtVec3 p = vtTransformPoint(t, vtMakeVec3(mesh->positions + i));
        const vtVec3 n = vtTransformVector(t, vtMakeVec3(mesh->normals + i)); // a rotation
        memcpy(mesh->positions + i, &p, sizeof p);
        memcpy(mesh->normals + i, &n, sizeof n);
    }
    const vtMeshDef def = {.positions = mesh->positions,
                           .normals = mesh->normals,
                           .indices = mesh->indices,
                           .vertexCount = mesh->vertexCount,
                           .indexCount = mesh->indexCount};
    vtMesh baked;
    vtError error;
    assert_ok(vtCreateMesh(&def, "baked", &baked, &error), error);
    vtDestroyMesh(mesh);
    *mesh = baked;
    return scene;
}

static void instancesAreAsTheirMeshesBaked(void** state)
{
    Fixture* fixture = *state;
    const vtTransform turned = {
        {{0.6f, -0.8f, 0, 0.3f}, {0.48f, 0.36f, -0.8f, -0.2f}, {0.64f, 0.48f, 0.6f, 0.1f}}};
    static const char* const shapes[] = {"torus", "goblet", "diamond"};
    for (int i = 0; i < 3; ++i) {
        vtScene baked = bake(shapes[i], &turned);
        vtScene instance = makeScene((const Part[mostParts]){{.shape = shapes[i]}}, false);
        instance.objects[0].toWorld = turned;
        const vtFrame frame = sceneFrame(&baked);
        setScene(fixture->renderer, &baked);
        draw(fixture, &frame);
        float* directions = keep(fixture->directions, sizeof fixture->directions);
        setScene(fixture->renderer, &instance);
        draw(fixture, &frame);
        int glass = 0, different = 0;
        for (int p = 0; p < side * side; ++p) {
            const float* a = directions + 3 * p;
            const float* b = fixture->directions + 3 * p;
            const bool isMarked = a[0] == 2.0f || (a[0] == 0.0f && a[1] == 0.0f && a[2] == 0.0f);
            glass += a[0] != 0.0f || a[1] != 0.0f || a[2] != 0.0f;
            different += isMarked ? memcmp(a, b, 3 * sizeof *a) != 0 : vtDirectionAngle(b, a) > 1.0f;
        }
        print_message("  %s: %d of %d pixels differ\n", shapes[i], different, glass);
        assert_true(glass > 500);
        assert_true(different <= 0.03 * glass);
        free(directions);
        vtDestroyScene(&baked);
        vtDestroyScene(&instance);
    }
}

// ------------------------------------------------------------------------------------------ what is drawn

static void theFramesIndexIsThatOfAll(void** state)
{
    Fixture* fixture = *state;
    setEnvironment(fixture->renderer, "checker");
    const Part unlike[mostParts] = {{.shape = "sphere", .at = {-0.5f, 0, 0.6f}, .ior = 1.3f},
                                    {.shape = "cube", .at = {0.6f, 0, -2}, .ior = 2}};
    const Part alike[mostParts] = {{.shape = "sphere", .at = {-0.5f, 0, 0.6f}, .ior = 1.7f},
                                   {.shape = "cube", .at = {0.6f, 0, -2}, .ior = 1.7f}};
    vtScene scene = makeScene(unlike, false);
    vtFrame frame = sceneFrame(&scene);
    frame.fresnel = true;
    setScene(fixture->renderer, &scene);
    draw(fixture, &frame);
    uint8_t* own = keep(fixture->pixels, sizeof fixture->pixels);
    frame.ior = 1.7f;
    draw(fixture, &frame);
    uint8_t* all = keep(fixture->pixels, sizeof fixture->pixels);
    assert_memory_not_equal(own, all, sizeof fixture->pixels);
    frame.ior = 0.0f;
    draw(fixture, &frame); // and back
    assert_memory_equal(own, fixture->pixels, sizeof fixture->pixels);
    setParts(fixture->renderer, alike);
    draw(fixture, &frame);
    assert_memory_equal(all, fixture->pixels, sizeof fixture->pixels);
    free(own);
    free(all);
    vtDestroyScene(&scene);
}

static int countDifferent(const Fixture* fixture, const uint8_t* pixels, int tolerance)
{
    int different = 0;
    for (int p = 0; p < side * side; ++p) {
        bool same = true;
        for (int c = 4 * p; c < 4 * p + 4; ++c) {
            same = same && abs((int)fixture->pixels[c] - (int)pixels[c]) <= tolerance;
        }
        different += !same;
    }
    return different;
}

static int countGlass(const Fixture* fixture)
{
    int glass = 0;
    for (int p = 0; p < side * side; ++p) {
        const float* d = fixture->directions + 3 * p;
        glass += d[0] != 0.0f || d[1] != 0.0f || d[2] != 0.0f;
    }
    return glass;
}

// A plane alone is drawn; glass behind it does not show, glass before it does, and before both.
static void opaquePlanesHideWhatLiesBehind(void** state)
{
    Fixture* fixture = *state;
    setEnvironment(fixture->renderer, "sky");
    const Part plane = {.shape = "plane", .checker = 4};
    const Part alone[mostParts] = {plane},
               nothing[mostParts] = {{.shape = "sphere", .at = {0, 0, 50}, .scale = 0.1f}};
    const Part behind[mostParts] = {plane, {.shape = "sphere", .at = {0, 0, -1.5f}}};
    const Part before[mostParts] = {plane, {.shape = "sphere", .at = {0, 0, 1.5f}}};
    const Part both[mostParts] = {plane,
                                  {.shape = "sphere", .at = {0, 0, -1.5f}},
                                  {.shape = "sphere", .at = {0, 0, 1.5f}, .scale = 0.5f}};
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.view = (vtView){{0, 0, 4}, {0, 0, 0}, 45};
    frame.ior = 0.0f;
    for (int fresnel = 0; fresnel < 2; ++fresnel) {
        frame.fresnel = fresnel == 1;
        setParts(fixture->renderer, nothing);
        draw(fixture, &frame);
        assert_int_equal(countGlass(fixture), 0);
        uint8_t* sky = keep(fixture->pixels, sizeof fixture->pixels);
        setParts(fixture->renderer, alone);
        draw(fixture, &frame);
        assert_int_equal(countGlass(fixture), 0);
        assert_true(countDifferent(fixture, sky, 1) > side * side * 9 / 10);
        uint8_t* bare = keep(fixture->pixels, sizeof fixture->pixels);
        setParts(fixture->renderer, behind);
        draw(fixture, &frame);
        assert_int_equal(countGlass(fixture), 0);
        assert_true(countDifferent(fixture, bare, 2) <= side * side / 500);
        setParts(fixture->renderer, before);
        draw(fixture, &frame);
        const int glass = countGlass(fixture), different = countDifferent(fixture, bare, 2);
        print_message("  before the plane: %d pixels of glass, %d changed\n", glass, different);
        assert_true(glass > side * side / 10 && different > glass / 4 &&
                    different <= glass + side * side / 500);
        setParts(fixture->renderer, both);
        draw(fixture, &frame);
        assert_in_range(countGlass(fixture), 200, glass / 2);
        free(sky);
        free(bare);
    }
}

static void opaqueScenesAreDrawn(void** state)
{
    Fixture* fixture = *state;
    float grey[3] = {0.25f, 0.25f, 0.25f};
    const vtEnvironment environment = {vt_environmentImage, grey, 1, 1};
    vtError error;
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
    const Part parts[mostParts] = {{.shape = "sphere", .color = {1, 0.2f, 0.2f}},
                                   {.shape = "cube", .at = {1.5f, 0, -1}, .color = {0.2f, 1, 0.2f}}};
    vtScene scene = makeScene(parts, false);
    vtFrame frame = sceneFrame(&scene);
    setScene(fixture->renderer, &scene);
    for (int fresnel = 0; fresnel < 2; ++fresnel) {
        frame.fresnel = fresnel == 1;
        draw(fixture, &frame);
        int red = 0, green = 0, bare = 0;
        for (int p = 0; p < side * side; ++p) {
            const uint8_t* c = fixture->pixels + 4 * p;
            red += c[0] > c[1] + 20;
            green += c[1] > c[0] + 20;
            bare += c[0] == c[1] && c[1] == c[2];
        }
        assert_int_equal(countGlass(fixture), 0);
        assert_true(red > 1000 && green > 300 && bare > 1000);
        assert_int_equal(red + green + bare, side * side);
    }
    vtDestroyScene(&scene);
}

// -------------------------------------------------------------------------------------------- samples

enum { sampleCount = 6 };

// One call, one sample a call: bit for bit the same.
static void samplesAddUpOverCalls(void** state)
{
    Fixture* fixture = *state;
    static const int named[] = {6, 9};
    for (int i = 0; i < 2; ++i) {
        vtScene scene = makeScene(cases[named[i]].parts, false);
        vtFrame frame = sceneFrame(&scene);
        frame.fresnel = true;
        frame.samples = sampleCount;
        setScene(fixture->renderer, &scene);
        setEnvironment(fixture->renderer, "studio");
        draw(fixture, &frame);
        uint8_t* wanted = keep(fixture->pixels, sizeof fixture->pixels);
        frame.samples = 1;
        for (frame.firstSample = 0; frame.firstSample < sampleCount; ++frame.firstSample) {
            draw(fixture, &frame);
        }
        assert_memory_equal(fixture->pixels, wanted, sizeof fixture->pixels);
        free(wanted);
        vtDestroyScene(&scene);
    }
}

// Which part of the light that left a path is followed depends on the sample alone, not on those before it.
static void severalSamplesAreTheMeanOfEach(void** state)
{
    Fixture* fixture = *state;
    vtScene scene = makeScene(cases[3].parts, false);
    vtFrame frame = sceneFrame(&scene);
    frame.fresnel = true;
    frame.exposure = -5.0f; // nothing is brighter than white
    setScene(fixture->renderer, &scene);
    setEnvironment(fixture->renderer, "studio");
    float* sum = calloc(sizeof fixture->pixels, sizeof *sum);
    for (int k = 0; k < sampleCount; ++k) {
        vtFrame other = frame;
        other.exposure = 1.0f; // so that nothing is gone on with
        draw(fixture, &other);
        other.exposure = frame.exposure;
        other.firstSample = k;
        draw(fixture, &other);
        for (size_t p = 0; p < sizeof fixture->pixels; ++p) {
            sum[p] += vtSrgbToLinear((float)fixture->pixels[p] / 255.0f);
        }
    }
    frame.samples = sampleCount;
    draw(fixture, &frame);
    for (size_t p = 0; p < sizeof fixture->pixels; ++p) {
        assert_near((float)fixture->pixels[p], 255.0f * vtLinearToSrgb(sum[p] / sampleCount), 1.6f);
    }
    free(sum);
    vtDestroyScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orderOfObjectsDoesNotMatter),
        cmocka_unit_test(directionsAreThoseOfTheTracer),
        cmocka_unit_test(picturesAreThoseOfTheTracer),
        cmocka_unit_test(branchesBringThePictureNearer),
        cmocka_unit_test(scenesLeaveNoTrace),
        cmocka_unit_test(movedObjectsAreDrawnWhereTheyAre),
        cmocka_unit_test(badScenesAreNotTaken),
        cmocka_unit_test(instancesShareAllMemory),
        cmocka_unit_test(instancesAreAsTheirMeshesBaked),
        cmocka_unit_test(theFramesIndexIsThatOfAll),
        cmocka_unit_test(opaquePlanesHideWhatLiesBehind),
        cmocka_unit_test(opaqueScenesAreDrawn),
        cmocka_unit_test(samplesAddUpOverCalls),
        cmocka_unit_test(severalSamplesAreTheMeanOfEach),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
