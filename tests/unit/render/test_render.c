// Whole frames against what must hold whatever the search does.
#include "base/math.h"
#include "image/image.h"
#include "rendering.h"

// The glass of index 1 is not there: the bare environment, with every technique, and each direction is its
// pixel's own. (kay-thickness adds its highlights all the same.) This also ties picture, camera and
// environment to their documented formulas.
static void indexOneLeavesTheEnvironmentBare(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "torus");
    for (int kind = 0; vtEnvironmentName(kind) != NULL; ++kind) {
        vtEnvironment environment;
        vtError error;
        assert_ok(vtCreateEnvironment(vtEnvironmentName(kind), &environment, &error), error);
        assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
        for (int technique = 0; technique < vt_techniqueCount; ++technique) {
            if (!vtTechnique_Info((vtTechnique)technique)->refracts) {
                continue; // it only blends, whatever the index
            }
            vtFrame frame = smallFrame(vt_techniqueLayered);
            frame.technique = (vtTechnique)technique;
            frame.transmittance = 1.0f;
            frame.ior = 1.0f;
            frame.maxEvents = 16;
            draw(fixture, &frame);
            int different = 0, glass = 0;
            for (int p = 0; p < side * side; ++p) {
                vtVec3 ray = eyeRay(&frame, p % side, p / side);
                vtVec3 d = vtMakeVec3(fixture->directions + 3 * p);
                if (d.x != 0.0f || d.y != 0.0f || d.z != 0.0f) {
                    ++glass;
                    // A path that is lost goes on straight in the picture, so only its mark differs.
                    assert_true(d.x == 2.0f || degreesBetween(d, ray) < 0.01f);
                }
                vtVec3 light = vtEnvironment_Sample(&environment, ray);
                const float linear[3] = {light.x, light.y, light.z};
                bool same = true;
                for (int c = 0; c < 3; ++c) {
                    float wanted = 255.0f * vtLinearToSrgb(vtClamp(linear[c], 0.0f, 1.0f));
                    float over = (float)fixture->pixels[4 * p + c] - wanted;
                    same = same && over > -1.6f && (over < 1.6f || technique == vt_techniqueKayThickness);
                }
                different += !same;
            }
            assert_true(technique != vt_techniqueExact || glass == 0); // nothing has turned a ray
            assert_true(different <= side * side / 1000);              // edges of cells and lamps
        }
    }
}

static void whiteEnvironmentStaysWhite(void** state)
{
    Fixture* fixture = *state;
    float white[2 * 3] = {1, 1, 1, 1, 1, 1};
    vtEnvironment environment = {vt_environmentImage, white, 2, 1};
    vtError error;
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
    for (int i = 0; vtShapeName(i) != NULL; ++i) {
        setShape(fixture->renderer, vtShapeName(i));
        vtFrame frame = smallFrame(vt_techniqueLayered);
        draw(fixture, &frame);
        for (int p = 0; p < 4 * side * side; ++p) {
            assert_int_equal(fixture->pixels[p], 255);
        }
    }
}

// Two refractions of a ball of radius 1: the exit direction in closed form.
static void sphereFollowsTheClosedForm(Fixture* fixture, vtTechnique technique, vtSearch search)
{
    setShape(fixture->renderer, "sphere");
    setEnvironment(fixture->renderer, "checker");
    vtFrame frame = smallFrame(vt_techniqueLayered);
    frame.technique = technique;
    frame.search = search;
    draw(fixture, &frame);
    int glass = 0, within = 0, lost = 0;
    for (int p = 0; p < side * side; ++p) {
        vtVec3 I = eyeRay(&frame, p % side, p / side), e = frame.view.eye;
        float b = vtDot(e, I), k = b * b - vtDot(e, e) + 1.0f;
        vtVec3 d = vtMakeVec3(fixture->directions + 3 * p);
        bool drawn = d.x != 0.0f || d.y != 0.0f || d.z != 0.0f;
        if (k < 0.002f || !drawn) {
            continue; // the rim's last pixel, where the triangles' edge decides
        }
        vtVec3 P = vtMulAdd(e, -b - sqrtf(k), I);
        float c = -vtDot(P, I), eta = 1.0f / frame.ior;
        vtVec3 T = vtMulAdd(vtScale(I, eta), eta * c - sqrtf(1.0f - eta * eta * (1.0f - c * c)), P);
        vtVec3 Q = vtMulAdd(P, -2.0f * vtDot(P, T), T);
        float s = vtDot(Q, T);
        vtVec3 E =
            vtMulAdd(vtScale(T, frame.ior),
                     sqrtf(fmaxf(0.0f, 1.0f - frame.ior * frame.ior * (1.0f - s * s))) - frame.ior * s, Q);
        ++glass;
        lost += d.x == 2.0f;
        within += d.x != 2.0f && degreesBetween(d, E) < 1.0f;
    }
    assert_true(glass > side * side / 3);
    assert_true(within >= glass * 98 / 100);
    assert_true(lost <= glass / 200);
}

static void layeredSphereFollowsTheClosedForm(void** state)
{
    sphereFollowsTheClosedForm(*state, vt_techniqueLayered, vt_searchSteps);
    sphereFollowsTheClosedForm(*state, vt_techniqueLayered, vt_searchCells);
}

static void oliveirasSphereFollowsTheClosedForm(void** state)
{
    sphereFollowsTheClosedForm(*state, vt_techniqueOliveira, vt_searchSteps);
}

// A thick pane: what leaves by the far face is parallel to what came in.
static void slabKeepsTheDirection(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    float positions[24];
    for (int i = 0; i < 8; ++i) {
        positions[3 * i] = i & 1 ? 3.0f : -3.0f;
        positions[3 * i + 1] = i & 2 ? 3.0f : -3.0f;
        positions[3 * i + 2] = i & 4 ? 0.2f : -0.2f;
    }
    static const uint32_t quads[6][4] = {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7},
                                         {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}};
    float corners[6 * 6 * 3], normals[6 * 6 * 3];
    for (int q = 0, v = 0; q < 6; ++q) {
        static const int order[6] = {0, 1, 2, 0, 2, 3};
        vtVec3 a = vtMakeVec3(positions + 3 * quads[q][0]), b = vtMakeVec3(positions + 3 * quads[q][1]);
        vtVec3 c = vtMakeVec3(positions + 3 * quads[q][2]);
        vtVec3 n = vtNormalize(vtCross(vtSub(b, a), vtSub(c, a)));
        for (int k = 0; k < 6; ++k, ++v) {
            memcpy(corners + 3 * v, positions + 3 * quads[q][order[k]], 12);
            memcpy(normals + 3 * v, &n, 12);
        }
    }
    vtMesh mesh;
    vtMeshDef def = {.positions = corners, .normals = normals, .vertexCount = 36, .indexCount = 36};
    assert_ok(vtCreateMesh(&def, "slab", &mesh, &error), error);
    assert_int_equal(mesh.openEdgeCount, 0);
    assert_ok(vtRenderer_SetMesh(fixture->renderer, &mesh, &error), error);
    vtDestroyMesh(&mesh);
    vtFrame frame = smallFrame(vt_techniqueLayered);
    frame.view = (vtView){{0.7f, 0.5f, 2.0f}, {0, 0, 0}, 45.0f};
    draw(fixture, &frame);
    for (int p = 0; p < side * side; ++p) {
        vtVec3 d = vtMakeVec3(fixture->directions + 3 * p);
        assert_true(degreesBetween(d, eyeRay(&frame, p % side, p / side)) < 0.02f);
    }
}

// A convex body has two layers: more change nothing.
static void convexNeedsTwoLayersOnly(void** state)
{
    Fixture* fixture = *state;
    const char* shapes[] = {"sphere", "diamond"};
    for (int i = 0; i < 2; ++i) {
        setShape(fixture->renderer, shapes[i]);
        vtFrame frame = smallFrame(vt_techniqueLayered);
        frame.layers = 2;
        draw(fixture, &frame);
        float* two = malloc(sizeof fixture->directions);
        memcpy(two, fixture->directions, sizeof fixture->directions);
        frame.layers = 8;
        draw(fixture, &frame);
        int different = 0;
        for (int p = 0; p < side * side; ++p) {
            different += memcmp(two + 3 * p, fixture->directions + 3 * p, 12) != 0;
        }
        free(two);
        assert_true(different <= side * side / 500); // seams where rasterisation finds a sliver of a third
    }
}

static void everyDirectionIsUnitLostOrBackground(void** state)
{
    Fixture* fixture = *state;
    setEnvironment(fixture->renderer, "studio");
    for (int i = 0; vtShapeName(i) != NULL; ++i) {
        setShape(fixture->renderer, vtShapeName(i));
        for (int layers = 1; layers <= VT_MAX_LAYERS; layers += 5) {
            vtFrame frame = smallFrame(vt_techniqueLayered);
            frame.layers = layers;
            draw(fixture, &frame);
            for (int p = 0; p < side * side; ++p) {
                vtVec3 d = vtMakeVec3(fixture->directions + 3 * p);
                float length = vtLength(d);
                bool background = length == 0.0f, isLost = d.x == 2.0f && d.y == 2.0f && d.z == 2.0f;
                assert_true(background || isLost || fabsf(length - 1.0f) < 1e-4f);
            }
        }
    }
}

// Strange cameras draw something, without GL errors and without NaN.
static void strangeCamerasAreDrawn(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "knot");
    const vtView views[] = {
        {{0, 0, 0.01f}, {0, 0, 0}, 45},       // in the middle of it
        {{0.6f, 0.1f, 0.0f}, {0, 0, 0}, 120}, // perhaps inside the glass
        {{0, 0, 9}, {0, 0, 10}, 45},          // looking away
        {{0, 3, 0}, {0, 0, 0}, 45},           // straight down
        {{0, 0, 5000}, {0, 0, 0}, 1},         // very far
        {{0, 0, 3}, {0, 0, 0}, 170},
    };
    for (size_t i = 0; i < sizeof views / sizeof views[0]; ++i) {
        vtFrame frame = smallFrame(vt_techniqueLayered);
        frame.view = views[i];
        draw(fixture, &frame);
        for (int p = 0; p < 3 * side * side; ++p) {
            assert_true(isfinite(fixture->directions[p]));
        }
    }
}

static void extremeSettingsAreDrawn(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "goblet");
    const struct {
        int width, height, layers, steps, refine, events, layerSize;
    } cases[] = {{1, 1, 1, 1, 0, 1, 0},      {128, 1, 16, 1000, 32, 64, 16}, {1, 128, 3, 7, 1, 2, 16},
                 {64, 64, 16, 50, 8, 64, 0}, {37, 91, 5, 50, 8, 8, 1000},    {128, 128, 4, 50, 8, 8, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        vtFrame frame = smallFrame(vt_techniqueLayered);
        frame.width = cases[i].width;
        frame.height = cases[i].height;
        frame.layers = cases[i].layers;
        frame.steps = cases[i].steps;
        frame.refine = cases[i].refine;
        frame.maxEvents = cases[i].events;
        frame.layerSize = cases[i].layerSize;
        draw(fixture, &frame);
    }
}

// Sizes and settings of the frames before leave no trace.
static void pictureDoesNotDependOnTheFramesBefore(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "knot");
    vtFrame frame = smallFrame(vt_techniqueLayered);
    draw(fixture, &frame);
    uint8_t* first = malloc(sizeof fixture->pixels);
    memcpy(first, fixture->pixels, sizeof fixture->pixels);
    vtFrame other = frame;
    other.layers = 9;
    other.width = 50;
    other.view = vtView_Orbit(frame.view, 1.0f, 0.4f);
    draw(fixture, &other);
    draw(fixture, &frame);
    assert_memory_equal(first, fixture->pixels, sizeof fixture->pixels);

    // A technique with a target of its own, which another has seen a size come and go without.
    frame.technique = vt_techniqueWyman;
    draw(fixture, &frame);
    memcpy(first, fixture->pixels, sizeof fixture->pixels);
    draw(fixture, &other);
    other.width = frame.width;
    draw(fixture, &other);
    draw(fixture, &frame);
    assert_memory_equal(first, fixture->pixels, sizeof fixture->pixels);
    free(first);
}

static void twoRenderersLiveSideBySide(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtRenderer* second = createRenderer(fixture);
    setShape(fixture->renderer, "goblet");
    setEnvironment(fixture->renderer, "sky");
    vtFrame frame = smallFrame(vt_techniqueLayered), otherFrame = smallFrame(vt_techniqueLayered);
    otherFrame.layers = 2;
    otherFrame.width = 40;
    draw(fixture, &frame);
    uint8_t* alone = malloc(sizeof fixture->pixels);
    uint8_t* other = malloc(4 * 40 * side);
    memcpy(alone, fixture->pixels, sizeof fixture->pixels);

    setShape(second, "torus");
    setEnvironment(second, "checker");
    assert_ok(vtRenderer_DrawImage(second, &otherFrame, other, &error), error);
    draw(fixture, &frame);
    assert_memory_equal(alone, fixture->pixels, sizeof fixture->pixels);
    vtDestroyRenderer(second);
    draw(fixture, &frame);
    assert_memory_equal(alone, fixture->pixels, sizeof fixture->pixels);
    free(alone);
    free(other);
}

// Where the sheet shows a surface, layers 1, 3, ... face the eye and layers 2, 4, ... face away.
static void layersAlternateBetweenFrontAndBack(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    vtFrame frame = smallFrame(vt_techniqueLayered);
    frame.view = (vtView){{0, 0, 3}, {0, 0, 0}, 45};
    frame.output = vt_outputLayerNormal;
    const int centre = 4 * (side / 2 * side + side / 2);
    frame.layer = 0;
    draw(fixture, &frame);
    assert_true(fixture->pixels[centre + 2] > 250); // normal +Z
    frame.layer = 1;
    draw(fixture, &frame);
    assert_true(fixture->pixels[centre + 2] < 5); // normal -Z
    frame.layer = 2;
    draw(fixture, &frame);
    assert_int_equal(fixture->pixels[centre], 31); // no third layer: the background colour
}

static void transparentBackgroundLeavesTheGlassAsItIs(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "knot");
    setEnvironment(fixture->renderer, "sky");
    vtFrame frame = smallFrame(vt_techniqueLayered);
    draw(fixture, &frame);
    uint8_t* opaque = malloc(sizeof fixture->pixels);
    memcpy(opaque, fixture->pixels, sizeof fixture->pixels);
    frame.background = vt_backgroundTransparent;
    draw(fixture, &frame);
    int glass = 0;
    for (int p = 0; p < side * side; ++p) {
        bool isGlass = fixture->directions[3 * p] != 0.0f || fixture->directions[3 * p + 1] != 0.0f;
        const uint8_t nothing[4] = {0, 0, 0, 0};
        assert_memory_equal(fixture->pixels + 4 * p, isGlass ? opaque + 4 * p : nothing, 4);
        assert_int_equal(opaque[4 * p + 3], 255);
        glass += isGlass;
    }
    assert_true(glass > side);
    free(opaque);
}

static void exposureMultipliesLinearLight(void** state)
{
    Fixture* fixture = *state;
    float grey[3] = {0.1f, 0.2f, 0.3f};
    vtEnvironment environment = {vt_environmentImage, grey, 1, 1};
    vtError error;
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
    setShape(fixture->renderer, "sphere");
    for (int ev = -1; ev <= 2; ++ev) {
        vtFrame frame = smallFrame(vt_techniqueLayered);
        frame.exposure = (float)ev;
        draw(fixture, &frame);
        for (int c = 0; c < 3; ++c) {
            float wanted = 255.0f * vtLinearToSrgb(fminf(1.0f, grey[c] * exp2f((float)ev)));
            assert_near((float)fixture->pixels[c], wanted, 1.1f);
            assert_near((float)fixture->pixels[4 * (side / 2 * side + side / 2) + c], wanted, 1.1f);
        }
    }
}

// ---------------------------------------------------------------------------------------------- samples

enum { sampleCount = 8, pixelBytes = 4 * side * side };

/// Sample `index` alone, whatever was drawn before.
static void drawOneSample(Fixture* fixture, const vtFrame* frame, int index)
{
    vtFrame other = *frame;
    other.ior = frame->ior + 0.01f;
    other.samples = 1;
    other.firstSample = 0;
    draw(fixture, &other);
    other = *frame;
    other.samples = 1;
    other.firstSample = index;
    draw(fixture, &other);
}

/// The mean in linear light, channel by channel, weighted with alpha.
static void addLinear(const uint8_t* pixels, float* sum)
{
    for (int p = 0; p < pixelBytes; ++p) {
        float alpha = (float)pixels[p | 3] / 255.0f;
        sum[p] += p % 4 == 3 ? alpha : alpha * vtSrgbToLinear((float)pixels[p] / 255.0f);
    }
}

static void severalSamplesAreTheMeanOfEach(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "knot");
    setEnvironment(fixture->renderer, "checker"); // nothing is brighter than white: only the mean is cut
    const vtTechnique techniques[] = {vt_techniqueLayered, vt_techniqueKayThickness, vt_techniqueWyman};
    for (int i = 0; i < 6; ++i) {
        vtFrame frame = smallFrame(vt_techniqueLayered);
        frame.technique = techniques[i / 2];
        frame.background = i % 2 == 1 ? vt_backgroundTransparent : vt_backgroundEnvironment;
        frame.exposure = -0.5f;
        float* sum = calloc(pixelBytes, sizeof *sum);
        for (int k = 0; k < sampleCount; ++k) {
            drawOneSample(fixture, &frame, k);
            addLinear(fixture->pixels, sum);
        }
        frame.samples = sampleCount;
        draw(fixture, &frame);
        int partly = 0;
        for (int p = 0; p < pixelBytes; ++p) {
            const float alpha = sum[p | 3];
            partly += p % 4 == 3 && alpha > 0.5f && alpha < (float)sampleCount - 0.5f;
            float wanted = p % 4 == 3     ? alpha / (float)sampleCount
                           : alpha > 0.0f ? vtLinearToSrgb(sum[p] / alpha)
                                          : 0.0f;
            assert_near((float)fixture->pixels[p], 255.0f * wanted, 1.6f);
        }
        assert_true(frame.background == vt_backgroundTransparent ? partly > side : partly == 0);
        free(sum);
    }
}

// One call, one sample a call, and calls that ask again for what is there: bit for bit the same.
static void samplesAddUpOverCalls(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "goblet");
    setEnvironment(fixture->renderer, "sky");
    uint8_t* wanted = malloc(pixelBytes);
    vtFrame frame = smallFrame(vt_techniqueLayered);
    frame.samples = sampleCount;
    draw(fixture, &frame);
    memcpy(wanted, fixture->pixels, pixelBytes);
    frame.samples = 1;
    for (frame.firstSample = 0; frame.firstSample < sampleCount; ++frame.firstSample) {
        draw(fixture, &frame);
    }
    assert_memory_equal(fixture->pixels, wanted, pixelBytes);
    frame.firstSample = 1;
    frame.samples = sampleCount - 1;
    draw(fixture, &frame);
    assert_memory_equal(fixture->pixels, wanted, pixelBytes);
    frame.firstSample = 0;
    frame.samples = 3;
    draw(fixture, &frame);
    frame.firstSample = 1;
    frame.samples = sampleCount - 1;
    draw(fixture, &frame);
    assert_memory_equal(fixture->pixels, wanted, pixelBytes);
    free(wanted);
}

// Two renderers draw a sample each in turns: each picture as alone.
static void samplesOfTwoRenderersAddUpInTurns(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtRenderer* second = createRenderer(fixture);
    setShape(fixture->renderer, "goblet");
    setShape(second, "torus");
    uint8_t *wanted = malloc(pixelBytes), *other = malloc(4 * 40 * 40);
    vtFrame frame = smallFrame(vt_techniqueExact), otherFrame = smallFrame(vt_techniqueExact);
    otherFrame.width = otherFrame.height = 40;
    frame.samples = sampleCount;
    draw(fixture, &frame);
    memcpy(wanted, fixture->pixels, pixelBytes);
    frame.samples = 1;
    for (frame.firstSample = 0; frame.firstSample < sampleCount; ++frame.firstSample) {
        draw(fixture, &frame);
        assert_ok(vtRenderer_DrawImage(second, &otherFrame, other, &error), error);
    }
    assert_memory_equal(fixture->pixels, wanted, pixelBytes);
    vtDestroyRenderer(second);
    free(wanted);
    free(other);
}

static void whateverChangesStartsAnew(void** state)
{
    Fixture* fixture = *state;
    uint8_t* wanted = malloc(pixelBytes);
    enum { changes = 11, first = 5 };
    for (int i = 0; i < changes; ++i) {
        setShape(fixture->renderer, "torus");
        setEnvironment(fixture->renderer, "studio");
        vtFrame before = smallFrame(vt_techniqueLayered), after = smallFrame(vt_techniqueLayered);
        after.backSurface = vt_backFarthest;
        after.technique = before.technique = vt_techniqueWyman;
        before.samples = first;
        switch (i) {
        case 0:
            before.width = side / 2;
            break;
        case 1:
            before.view = vtView_Orbit(before.view, 0.01f, 0.0f);
            break;
        case 2:
            before.technique = vt_techniqueSingle;
            break;
        case 3:
            before.backSurface = vt_backSecond;
            break;
        case 4:
            before.exposure = 1.0f;
            break;
        case 5:
            before.output = vt_outputAnalysis;
            break;
        case 8: // branches are those of `exact`
        case 9:
            after.technique = before.technique = vt_techniqueExact;
            after.fresnel = before.fresnel = true;
            before.branches = i == 8 ? -1 : 1;
            before.ior = i == 8 ? before.ior : 1.6f; // an index of its own is in the objects' table
            break;
        case 10:
            after.technique = before.technique = vt_techniqueLayered;
            before.search = vt_searchCells;
            break;
        default:
            break;
        }
        draw(fixture, &before);
        if (i == 6) {
            setEnvironment(fixture->renderer, "sky");
        }
        if (i == 7) {
            setShape(fixture->renderer, "knot");
        }
        after.firstSample = first;
        draw(fixture, &after);
        memcpy(wanted, fixture->pixels, pixelBytes);
        drawOneSample(fixture, &after, first);
        assert_memory_equal(fixture->pixels, wanted, pixelBytes);
    }
    free(wanted);
}

static void otherOutputsTakeOneSample(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "knot");
    uint8_t* wanted = malloc(pixelBytes);
    for (int output = vt_outputAnalysis; output <= vt_outputLayerNormal; ++output) {
        vtFrame frame = smallFrame(vt_techniqueLayered);
        frame.output = (vtOutput)output;
        draw(fixture, &frame);
        memcpy(wanted, fixture->pixels, pixelBytes);
        frame.samples = 16;
        frame.firstSample = 3;
        draw(fixture, &frame);
        assert_memory_equal(fixture->pixels, wanted, pixelBytes);
    }
    free(wanted);
}

static void badFramesDrawNothing(void** state)
{
    Fixture* fixture = *state;
    vtError error;
    vtFrame frame = smallFrame(vt_techniqueLayered);
    frame.layers = 17;
    memset(fixture->pixels, 7, sizeof fixture->pixels);
    assert_int_equal(vtRenderer_DrawImage(fixture->renderer, &frame, fixture->pixels, &error),
                     vt_errorArgument);
    assert_int_equal(fixture->pixels[0], 7);
    frame = smallFrame(vt_techniqueLayered);
    frame.samples = 0;
    assert_int_equal(vtValidateFrame(&frame, &error), vt_errorArgument);
    assert_string_equal(error.message, "samples is 0; it must be from 1 to 4096");
    frame.samples = VT_MAX_SAMPLES;
    frame.firstSample = -1;
    assert_int_equal(vtValidateFrame(&frame, &error), vt_errorArgument);
    assert_string_equal(error.message, "first-sample is -1; it must be from 0 to 1e+06");
    frame = smallFrame(vt_techniqueExact);
    frame.branches = VT_MAX_BRANCHES + 1;
    assert_int_equal(vtValidateFrame(&frame, &error), vt_errorArgument);
    assert_string_equal(error.message, "branches is 5; it must be from -1 to 4");
    frame.branches = -2;
    assert_int_equal(vtValidateFrame(&frame, &error), vt_errorArgument);
    frame.branches = -1;
    assert_ok(vtValidateFrame(&frame, &error), error);
    frame.multi = (vtMulti)2;
    assert_int_equal(vtValidateFrame(&frame, &error), vt_errorArgument);
    assert_string_equal(error.message, "multi is 2; it must be from 0 to 1");
    frame.multi = vt_multiAny;
    frame.search = (vtSearch)2;
    assert_int_equal(vtValidateFrame(&frame, &error), vt_errorArgument);
    assert_string_equal(error.message, "search is 2; it must be from 0 to 1");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(indexOneLeavesTheEnvironmentBare),
        cmocka_unit_test(whiteEnvironmentStaysWhite),
        cmocka_unit_test(layeredSphereFollowsTheClosedForm),
        cmocka_unit_test(oliveirasSphereFollowsTheClosedForm),
        cmocka_unit_test(slabKeepsTheDirection),
        cmocka_unit_test(convexNeedsTwoLayersOnly),
        cmocka_unit_test(everyDirectionIsUnitLostOrBackground),
        cmocka_unit_test(strangeCamerasAreDrawn),
        cmocka_unit_test(extremeSettingsAreDrawn),
        cmocka_unit_test(pictureDoesNotDependOnTheFramesBefore),
        cmocka_unit_test(twoRenderersLiveSideBySide),
        cmocka_unit_test(layersAlternateBetweenFrontAndBack),
        cmocka_unit_test(transparentBackgroundLeavesTheGlassAsItIs),
        cmocka_unit_test(exposureMultipliesLinearLight),
        cmocka_unit_test(severalSamplesAreTheMeanOfEach),
        cmocka_unit_test(samplesAddUpOverCalls),
        cmocka_unit_test(samplesOfTwoRenderersAddUpInTurns),
        cmocka_unit_test(whateverChangesStartsAnew),
        cmocka_unit_test(otherOutputsTakeOneSample),
        cmocka_unit_test(badFramesDrawNothing),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
