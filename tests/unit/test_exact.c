// Technique `exact`: its triangle records, its pyramid and its hits.
#include <math.h>

#include "base/math.h"
#include "metrics.h"
#include "rendering.h"
#include "scene/triangles.h"

static const char* const shapes[] = {"sphere", "torus", "knot", "goblet", "bottle", "diamond"};
enum { shapeCount = sizeof shapes / sizeof shapes[0] };

// Across an edge and back again; a record holds its own corners.
static void neighboursAreMutual(void** state)
{
    (void)state;
    for (int shape = 0; shape < shapeCount; ++shape) {
        vtMesh mesh;
        vtError error;
        assert_ok(vtCreateShape(shapes[shape], &mesh, &error), error);
        uint32_t* records = vtCreateTriangleRecords(&mesh);
        assert_non_null(records);
        const uint32_t count = mesh.indexCount / 3;
        for (uint32_t i = 0; i < count; ++i) {
            for (int k = 0; k < 3; ++k) {
                const uint32_t* corner = records + VT_TRIANGLE_WORDS * (size_t)i + 4 * k;
                const float* position = mesh.positions + 3 * (size_t)mesh.indices[3 * i + (uint32_t)k];
                assert_memory_equal(corner, position, 3 * sizeof(float));
                uint32_t other = corner[3];
                if (other == VT_NO_TRIANGLE) {
                    assert_int_not_equal(mesh.openEdgeCount + mesh.degenerateCount, 0);
                    continue;
                }
                assert_true(other < count && other != i);
                const uint32_t* back = records + VT_TRIANGLE_WORDS * (size_t)other;
                assert_true(back[3] == i || back[7] == i || back[11] == i);
            }
        }
        free(records);
        vtDestroyMesh(&mesh);
    }
}

static void drawDirections(Fixture* fixture, const vtFrame* frame, float* directions)
{
    draw(fixture, frame);
    memcpy(directions, fixture->directions, sizeof fixture->directions);
}

// The pyramid only skips: a walk from texel to texel comes to the same hits, bit for bit.
static void pyramidChangesNoHit(void** state)
{
    Fixture* fixture = *state;
    float* walked = malloc(sizeof fixture->directions);
    for (int shape = 0; shape < shapeCount; ++shape) {
        setShape(fixture->renderer, shapes[shape]);
        for (int source = vt_layersFromCube; source <= vt_layersFromEye; ++source) {
            vtFrame frame = smallFrame(vt_techniqueExact);
            frame.view = vtView_Orbit(frame.view, 0.7f * (float)shape, 0.3f);
            frame.layerSource = (vtLayerSource)source;
            frame.steps = VT_MAX_STEPS;
            frame.topLevel = 0;
            drawDirections(fixture, &frame, walked);
            for (int level = 2; level <= 7; level += 5) {
                frame.topLevel = level;
                draw(fixture, &frame);
                assert_memory_equal(walked, fixture->directions, sizeof fixture->directions);
            }
        }
    }
    free(walked);
}

// Against the reference tracer: paths of no more than four events.
static void hitsAreThoseOfATracer(void** state)
{
    Fixture* fixture = *state;
    const double least[] = {[vt_layersFromCube] = 0.985, [vt_layersFromEye] = 0.90};
    for (int shape = 0; shape < shapeCount; ++shape) {
        vtMesh mesh;
        vtError error;
        vtReferenceImage truth;
        vtFrame frame = smallFrame(vt_techniqueExact);
        assert_ok(vtCreateShape(shapes[shape], &mesh, &error), error);
        frame.view = vtView_Orbit(vtFrameMesh(&mesh, 45.0f, 1.0f), 0.9f, 0.2f);
        frame.preset = vt_presetHigh;
        traceMesh(&mesh, &frame, &truth);
        assert_ok(vtRenderer_SetMesh(fixture->renderer, &mesh, &error), error);
        for (int source = vt_layersFromCube; source <= vt_layersFromEye; ++source) {
            frame.layerSource = (vtLayerSource)source;
            draw(fixture, &frame);
            int compared = 0, agreeing = 0;
            for (int i = 0; i < side * side; ++i) {
                if (truth.states[i] == VT_PATH_EXITED && truth.events[i] <= 4) {
                    ++compared;
                    agreeing +=
                        vtDirectionAngle(fixture->directions + 3 * i, truth.directions + 3 * i) < 1.0f;
                }
            }
            print_message("  %s, %s: %d of %d within 1 degree\n", shapes[shape],
                          source == vt_layersFromCube ? "cube" : "eye", agreeing, compared);
            assert_true(compared > 500);
            assert_true(agreeing >= least[source] * compared);
        }
        vtDestroyReferenceImage(&truth);
        vtDestroyMesh(&mesh);
    }
}

// A cube belongs to its mesh and its settings.
static void cubeFollowsTheMesh(void** state)
{
    Fixture* fixture = *state;
    float* first = malloc(sizeof fixture->directions);
    vtFrame frame = smallFrame(vt_techniqueExact);
    setShape(fixture->renderer, "knot");
    drawDirections(fixture, &frame, first);
    setShape(fixture->renderer, "torus");
    draw(fixture, &frame);
    assert_memory_not_equal(first, fixture->directions, sizeof fixture->directions);
    setShape(fixture->renderer, "knot");
    vtFrame other = frame;
    other.preset = vt_presetLow;
    draw(fixture, &other);
    other.layerSource = vt_layersFromEye;
    draw(fixture, &other);
    draw(fixture, &frame);
    assert_memory_equal(first, fixture->directions, sizeof fixture->directions);
    free(first);
}

static void checkDirections(const Fixture* fixture, int count)
{
    for (int i = 0; i < count; ++i) {
        const float* d = fixture->directions + 3 * i;
        float length = sqrtf(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        assert_true(length == 0.0f || fabsf(length - 1.0f) < 1e-4f || fabsf(length - sqrtf(12.0f)) < 1e-4f);
    }
}

static void extremeSettingsAreDrawn(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "goblet");
    const struct {
        int width, height, layers, steps, events, cubeSize, topLevel;
        float ior;
    } cases[] = {{1, 1, 1, 1, 1, 32, 0, 1.5f},
                 {128, 1, 16, 1000, 64, 32, 9, 4.0f},
                 {1, 128, 3, 7, 2, 512, 1, 1.0f},
                 {64, 64, 2, 50, 64, 32, 9, 2.4f},
                 {37, 91, 5, 1000, 8, 1024, 9, 1.1f}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        for (int source = vt_layersFromCube; source <= vt_layersFromEye; ++source) {
            vtFrame frame = smallFrame(vt_techniqueExact);
            frame.width = cases[i].width;
            frame.height = cases[i].height;
            frame.layers = cases[i].layers;
            frame.steps = cases[i].steps;
            frame.maxEvents = cases[i].events;
            frame.cubeSize = cases[i].cubeSize;
            frame.topLevel = cases[i].topLevel;
            frame.ior = cases[i].ior;
            frame.layerSource = (vtLayerSource)source;
            draw(fixture, &frame);
            checkDirections(fixture, frame.width * frame.height);
        }
    }
}

// Sheets, slivers, two triangles on one edge twice over, an object as flat as a disc: drawn, without a NaN.
static void strangeMeshesAreDrawn(void** state)
{
    Fixture* fixture = *state;
    static const float positions[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 0, 0, 0, 1};
    static const uint32_t sheet[] = {0, 1, 2, 0, 2, 3};
    static const uint32_t closed[] = {0, 1, 2, 0, 2, 3, 2, 1, 0, 3, 2, 0};
    static const uint32_t slivers[] = {0, 1, 2, 0, 4, 2, 0, 2, 2, 1, 1, 1};
    static const uint32_t fan[] = {0, 2, 5, 0, 2, 1, 0, 2, 3, 2, 0, 5};
    const struct {
        const uint32_t* indices;
        uint32_t count;
    } cases[] = {{sheet, 6}, {closed, 12}, {slivers, 12}, {fan, 12}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        vtMesh mesh;
        vtError error;
        vtMeshDef def = {.positions = positions,
                         .vertexCount = 6,
                         .indices = cases[i].indices,
                         .indexCount = cases[i].count};
        assert_ok(vtCreateMesh(&def, "strange", &mesh, &error), error);
        assert_ok(vtRenderer_SetMesh(fixture->renderer, &mesh, &error), error);
        for (int source = vt_layersFromCube; source <= vt_layersFromEye; ++source) {
            vtFrame frame = smallFrame(vt_techniqueExact);
            frame.layerSource = (vtLayerSource)source;
            draw(fixture, &frame);
            checkDirections(fixture, side * side);
        }
        vtDestroyMesh(&mesh);
    }
}

// What a preset's layers take is known before they are made.
static void memoryIsForetold(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    size_t before = 0, foretold = 0;
    for (int preset = 0; preset < vt_presetCount; ++preset) {
        vtFrame frame = smallFrame(vt_techniqueExact);
        frame.preset = (vtPreset)preset;
        draw(fixture, &frame);
        size_t bytes = vtRenderer_Info(fixture->renderer).textureBytes;
        if (preset > 0) {
            assert_int_equal(bytes - before, vtFrame_CubeBytes(&frame) - foretold);
        }
        before = bytes;
        foretold = vtFrame_CubeBytes(&frame);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighboursAreMutual),   cmocka_unit_test(pyramidChangesNoHit),
        cmocka_unit_test(hitsAreThoseOfATracer), cmocka_unit_test(cubeFollowsTheMesh),
        cmocka_unit_test(memoryIsForetold),      cmocka_unit_test(extremeSettingsAreDrawn),
        cmocka_unit_test(strangeMeshesAreDrawn),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
