// Pictures and directions of plates and balls, which have closed forms: light, events, places.
#include <math.h>

#include "base/math.h"
#include "image/image.h"
#include "rendering.h"
#include "scene/camera.h"

enum { little = 16 };

static const float cubeHalf = 0.6f; // of the built-in cube's side

/// A built-in shape, scaled, turned about z and moved.
typedef struct Part {
    const char* shape;
    vtVec3 scale, at;
    vtMaterial material;
    float turn; // radians
} Part;

static vtVec3 turned(vtVec3 v, float turn)
{
    const float c = cosf(turn), s = sinf(turn);
    return (vtVec3){c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

static vtMaterial glassOf(float ior)
{
    vtMaterial material = vtDefaultMaterial();
    material.ior = ior;
    return material;
}

static void setParts(vtRenderer* renderer, const Part* parts, int count)
{
    vtScene scene = {0};
    vtError error;
    for (int i = 0; i < count; ++i) {
        const Part* part = &parts[i];
        const vtVec3 s = part->scale, at = part->at;
        const vtVec3 x = turned((vtVec3){s.x, 0, 0}, part->turn), y = turned((vtVec3){0, s.y, 0}, part->turn);
        const vtTransform place = {{{x.x, y.x, 0, at.x}, {x.y, y.y, 0, at.y}, {0, 0, s.z, at.z}}};
        vtMesh mesh;
        vtScene one;
        assert_ok(vtCreateShape(part->shape, &mesh, &error), error);
        assert_ok(vtCreateMeshScene(&mesh, &part->material, &one, &error), error);
        assert_ok(vtScene_Append(&scene, &one, &place, &error), error);
    }
    assert_ok(vtRenderer_SetScene(renderer, &scene, &error), error);
    vtDestroyScene(&scene);
}

/// One light from everywhere.
static void setLight(vtRenderer* renderer, float light)
{
    float pixels[2 * 3] = {light, light, light, light, light, light};
    const vtEnvironment environment = {vt_environmentImage, pixels, 2, 1};
    vtError error;
    assert_ok(vtRenderer_SetEnvironment(renderer, &environment, &error), error);
}

/// Straight at the origin from +z, nearly parallel.
static vtFrame frontal(vtTechnique technique)
{
    vtFrame frame = smallFrame(technique);
    frame.width = frame.height = little;
    frame.layerSize = 64;
    frame.ior = 0.0f;
    frame.view = (vtView){{0.0f, 0.0f, 20.0f}, {0.0f, 0.0f, 0.0f}, 1.0f};
    return frame;
}

static void assertLight(const Fixture* fixture, vtVec3 linear)
{
    const float light[3] = {linear.x, linear.y, linear.z};
    for (int p = 0; p < 4 * little * little; ++p) {
        if (p % 4 < 3) {
            assert_near((float)fixture->pixels[p], 255.0f * vtLinearToSrgb(light[p % 4]), 1.1f);
        }
    }
}

static vtVec3 power(vtVec3 base, float exponent)
{
    return (vtVec3){powf(base.x, exponent), powf(base.y, exponent), powf(base.z, exponent)};
}

static vtVec3 times(vtVec3 a, vtVec3 b)
{
    return (vtVec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

// The techniques that follow whole paths.
static const struct {
    vtTechnique technique;
    vtSearch search;
} ways[] = {{vt_techniqueExact, vt_searchSteps},
            {vt_techniqueLayered, vt_searchSteps},
            {vt_techniqueLayered, vt_searchCells}};
enum { wayCount = sizeof ways / sizeof ways[0] };

static vtFrame withWay(vtFrame frame, int way)
{
    frame.technique = ways[way].technique;
    frame.search = ways[way].search;
    return frame;
}

/// Snell's law; N against I. Zero where there is total internal reflection.
static vtVec3 refract(vtVec3 I, vtVec3 N, float eta)
{
    const float c = -vtDot(I, N), k = 1.0f - eta * eta * (1.0f - c * c);
    return k < 0.0f ? (vtVec3){0, 0, 0} : vtMulAdd(vtScale(I, eta), eta * c - sqrtf(k), N);
}

/// Every pixel's path has so many events, goes on as it came, and leaves the glass.
static void assertStraight(Fixture* fixture, const vtFrame* frame, uint32_t events)
{
    static uint32_t states[little * little];
    vtError error;
    draw(fixture, frame);
    assert_ok(vtRenderer_ReadStates(fixture->renderer, states, &error), error);
    for (int p = 0; p < little * little; ++p) {
        const vtVec3 ray = eyeRayAt(frame, (float)(p % little) + 0.5f, (float)(p / little) + 0.5f);
        assert_int_equal(states[p], VT_PATH_EXITED + 256 * events);
        assert_true(degreesBetween(vtMakeVec3(fixture->directions + 3 * p), ray) < 0.05f);
    }
}

// ---------------------------------------------------------------------------------------------- light

// Head on: a tint at each of its faces, absorption over its thickness.
static void plateTintsTwiceAndAbsorbsOnce(void** state)
{
    Fixture* fixture = *state;
    Part plate = {"cube", {3, 3, 1}, {0, 0, 0}, glassOf(1.5f), 0};
    plate.material.tint = (vtVec3){0.9f, 0.8f, 0.7f};
    plate.material.attenuationColor = (vtVec3){0.6f, 0.9f, 0.8f};
    plate.material.attenuationDistance = 2.0f;
    setParts(fixture->renderer, &plate, 1);
    setLight(fixture->renderer, 1.0f);
    const vtVec3 left = power(plate.material.attenuationColor, 2.0f * cubeHalf / 2.0f);
    for (int way = 0; way < wayCount; ++way) {
        const vtFrame frame = withWay(frontal(vt_techniqueExact), way);
        draw(fixture, &frame);
        assertLight(fixture, times(power(plate.material.tint, 2.0f), left));
    }
}

// The same of a light within a plate: one tint, half of the thickness.
static void plateAbsorbsTheLightOfWhatIsInIt(void** state)
{
    Fixture* fixture = *state;
    Part parts[2] = {{"cube", {6, 6, 1}, {0, 0, 0}, glassOf(1.5f), 0},
                     {"plane", {1, 1, 1}, {0, 0, 0}, vtDefaultMaterial(), 0}};
    parts[0].material.tint = (vtVec3){0.9f, 0.8f, 0.7f};
    parts[0].material.attenuationColor = (vtVec3){0.2f, 0.6f, 0.4f};
    parts[0].material.attenuationDistance = 1.0f;
    parts[1].material.opaque = true;
    parts[1].material.baseColor = (vtVec3){0, 0, 0};
    parts[1].material.emissive = (vtVec3){0.8f, 0.6f, 0.7f};
    setParts(fixture->renderer, parts, 2);
    setLight(fixture->renderer, 0.0f);
    const vtVec3 left = times(parts[0].material.tint, power(parts[0].material.attenuationColor, cubeHalf));
    for (int way = 0; way < wayCount; ++way) {
        const vtFrame frame = withWay(frontal(vt_techniqueExact), way);
        draw(fixture, &frame);
        assertLight(fixture, times(parts[1].material.emissive, left));
    }
}

// From within a plate: a tint, and absorption over what lies ahead.
static void plateAbsorbsTheLightThatAnEyeInItSees(void** state)
{
    Fixture* fixture = *state;
    Part parts[2] = {{"cube", {3, 3, 3}, {0, 0, 0}, glassOf(1.5f), 0},
                     {"sphere", {1, 1, 1}, {0, 0, 8}, glassOf(1.3f), 0}};
    parts[0].material.tint = (vtVec3){0.9f, 0.8f, 0.7f};
    parts[0].material.attenuationColor = (vtVec3){0.2f, 0.6f, 0.4f};
    parts[0].material.attenuationDistance = 2.0f;
    setLight(fixture->renderer, 1.0f);
    const float ahead = 3.0f * cubeHalf - 0.2f;
    const vtVec3 left =
        times(parts[0].material.tint, power(parts[0].material.attenuationColor, ahead / 2.0f));
    for (int count = 1; count <= 2; ++count) {
        setParts(fixture->renderer, parts, count);
        vtFrame frame = frontal(vt_techniqueExact);
        frame.view.eye = (vtVec3){0, 0, -0.2f};
        frame.view.target = (vtVec3){0, 0, -1};
        draw(fixture, &frame);
        assertLight(fixture, left);
    }
}

// Clear glass neither takes nor gives: in a grey room it is as grey, whatever is reflected and refracted.
static void clearGlassInGreyStaysGrey(void** state)
{
    Fixture* fixture = *state;
    const Part parts[2] = {{"sphere", {1, 1, 1}, {0, 0, 0}, glassOf(1.5f), 0},
                           {"cube", {1, 1, 1}, {0.3f, 0.2f, -2}, glassOf(1.3f), 0}};
    setLight(fixture->renderer, 0.5f);
    for (int count = 1; count <= 2; ++count) {
        setParts(fixture->renderer, parts, count);
        for (int way = 0; way < wayCount; ++way) {
            vtFrame frame = withWay(frontal(vt_techniqueExact), way);
            frame.fresnel = true;
            frame.view.fovY = 8.0f;
            draw(fixture, &frame);
            assertLight(fixture, (vtVec3){0.5f, 0.5f, 0.5f});
        }
    }
}

// A picture as environment: the CPU's numbers all around, seams and poles included.
static void pictureEnvironmentsAreThoseOfTheCpu(void** state)
{
    Fixture* fixture = *state;
    enum { columns = 8, rows = 4 };
    float pixels[3 * columns * rows];
    for (int i = 0; i < 3 * columns * rows; ++i) {
        pixels[i] = 0.05f + 0.9f * (float)(i * 37 % 97) / 97.0f;
    }
    const vtEnvironment environment = {vt_environmentImage, pixels, columns, rows};
    const Part ball = {"sphere", {0.01f, 0.01f, 0.01f}, {0, 0, 0}, glassOf(1.5f), 0};
    vtError error;
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
    setParts(fixture->renderer, &ball, 1);
    const vtVec3 ahead[] = {{1, 0, 0}, {-1, 0.1f, 0}, {0, 0, 1}, {0, 0, -1}, {0.2f, 1, 0}, {0, -1, 0.2f}};
    for (size_t i = 0; i < sizeof ahead / sizeof ahead[0]; ++i) {
        vtFrame frame = frontal(i % 2 == 0 ? vt_techniqueExact : vt_techniqueLayered);
        frame.view = (vtView){ahead[i], vtScale(ahead[i], 2.0f), 80.0f}; // away from the ball
        draw(fixture, &frame);
        for (int p = 0; p < little * little; ++p) {
            const vtVec3 ray = eyeRayAt(&frame, (float)(p % little) + 0.5f, (float)(p / little) + 0.5f);
            const vtVec3 light = vtEnvironment_Sample(&environment, ray);
            const float linear[3] = {light.x, light.y, light.z};
            for (int c = 0; c < 3; ++c) {
                assert_near((float)fixture->pixels[4 * p + c], 255.0f * vtLinearToSrgb(linear[c]), 2.1f);
            }
        }
    }
}

// ---------------------------------------------------------------------------------------------- events

// Plates side by side keep the direction: an event at each face between different indices.
static void touchingPlatesAreCrossedAtOnce(void** state)
{
    Fixture* fixture = *state;
    const struct {
        float z, scale, ior;
        uint32_t events;
    } seconds[] = {{-2.0f * cubeHalf, 1.0f, 1.3f, 3}, // touches the first, behind it
                   {2.0f * cubeHalf, 1.0f, 1.3f, 3},  // before it
                   {-2.0f * cubeHalf, 1.0f, 1.5f, 2}, // of the same glass
                   {-1.0f * cubeHalf, 1.0f, 1.5f, 2}, // reaches into it, of the same glass
                   {0.0f, 0.5f, 1.5f, 2},             // within it, of the same glass
                   {0.0f, 0.5f, 2.0f, 4},
                   {-4.0f * cubeHalf, 1.0f, 1.3f, 4}}; // apart
    for (size_t i = 0; i < sizeof seconds / sizeof seconds[0]; ++i) {
        const float across = 3.0f * seconds[i].scale;
        const Part parts[2] = {
            {"cube", {3, 3, 1}, {0, 0, 0}, glassOf(1.5f), 0},
            {"cube", {across, across, seconds[i].scale}, {0, 0, seconds[i].z}, glassOf(seconds[i].ior), 0}};
        setParts(fixture->renderer, parts, 2);
        for (int way = 0; way < wayCount; ++way) {
            vtFrame frame = withWay(frontal(vt_techniqueExact), way);
            frame.view.eye = (vtVec3){3.0f, 2.0f, 20.0f};
            assertStraight(fixture, &frame, seconds[i].events);
        }
    }
}

// Two balls take four events: where fewer are allowed every path is lost after them.
static void eventsRunOut(void** state)
{
    Fixture* fixture = *state;
    const Part balls[2] = {{"sphere", {1, 1, 1}, {0, 0, 0}, glassOf(1.5f), 0},
                           {"sphere", {1, 1, 1}, {0, 0, -3}, glassOf(1.3f), 0}};
    static uint32_t states[little * little];
    vtError error;
    setParts(fixture->renderer, balls, 2);
    for (int way = 0; way < wayCount; ++way) {
        for (uint32_t most = 1; most <= 4; ++most) {
            vtFrame frame = withWay(frontal(vt_techniqueExact), way);
            frame.maxEvents = (int)most;
            draw(fixture, &frame);
            assert_ok(vtRenderer_ReadStates(fixture->renderer, states, &error), error);
            for (int p = 0; p < little * little; ++p) {
                assert_int_equal(states[p], (most < 4 ? VT_PATH_LOST : VT_PATH_EXITED) + 256 * most);
            }
        }
    }
}

// From within a block, alone or beside a ball, each ray leaves by the face ahead.
static void eyeWithinGlassSeesOut(void** state)
{
    Fixture* fixture = *state;
    const Part parts[2] = {{"cube", {3, 3, 3}, {0, 0, 0}, glassOf(1.5f), 0},
                           {"sphere", {1, 1, 1}, {0, 0, 8}, glassOf(1.3f), 0}};
    for (int count = 1; count <= 2; ++count) {
        setParts(fixture->renderer, parts, count);
        vtFrame frame = frontal(vt_techniqueExact);
        frame.view = (vtView){{0, 0, 0.3f}, {0.1f, 0.1f, -1}, 30.0f};
        draw(fixture, &frame);
        for (int p = 0; p < little * little; ++p) {
            const vtVec3 ray = eyeRayAt(&frame, (float)(p % little) + 0.5f, (float)(p / little) + 0.5f);
            const vtVec3 out = refract(ray, (vtVec3){0, 0, 1}, 1.5f);
            assert_true(degreesBetween(vtMakeVec3(fixture->directions + 3 * p), out) < 0.02f);
        }
    }
}

// ---------------------------------------------------------------------------------------------- places

/// Where two refractions send a ray from `eye` through the ellipsoid of those half axes about the origin;
/// zero where it passes by.
static vtVec3 throughEllipsoid(vtVec3 eye, vtVec3 I, vtVec3 axes, float ior)
{
    const vtVec3 over = {1.0f / axes.x, 1.0f / axes.y, 1.0f / axes.z};
    vtVec3 P = eye, d = I;
    for (int face = 0; face < 2; ++face) {
        const vtVec3 o = times(P, over), w = times(d, over);
        const float a = vtDot(w, w), b = vtDot(o, w), k = b * b - a * (vtDot(o, o) - 1.0f);
        if (face == 0 && k < 0.01f * a) {
            return (vtVec3){0, 0, 0};
        }
        P = vtMulAdd(P, (face == 0 ? -b - sqrtf(k) : -2.0f * b) / a, d);
        const vtVec3 N = vtNormalize(times(P, times(over, over)));
        d = refract(d, face == 0 ? N : vtScale(N, -1.0f), face == 0 ? 1.0f / ior : ior);
    }
    return d;
}

// A ball stretched, turned, and mirrored on top of that: normals follow the inverse transposed.
static void stretchedBallsFollowTheClosedForm(void** state)
{
    Fixture* fixture = *state;
    enum { pictureSide = 64 };
    for (int mirrored = 0; mirrored < 2; ++mirrored) {
        const vtVec3 axes = {1.0f, 0.5f, 0.7f};
        const float turn = 0.6f;
        const Part ball = {
            "sphere", {mirrored ? -axes.x : axes.x, axes.y, axes.z}, {0, 0, 0}, glassOf(1.5f), turn};
        setParts(fixture->renderer, &ball, 1);
        for (int way = 0; way < wayCount; ++way) {
            vtFrame frame = withWay(frontal(vt_techniqueExact), way);
            frame.width = frame.height = pictureSide;
            frame.layerSize = 256;
            frame.view = (vtView){{1.0f, 1.2f, 4.0f}, {0, 0, 0}, 30.0f};
            draw(fixture, &frame);
            int compared = 0, close = 0;
            for (int p = 0; p < pictureSide * pictureSide; ++p) {
                const vtVec3 ray =
                    eyeRayAt(&frame, (float)(p % pictureSide) + 0.5f, (float)(p / pictureSide) + 0.5f);
                const vtVec3 own =
                    throughEllipsoid(turned(frame.view.eye, -turn), turned(ray, -turn), axes, 1.5f);
                const vtVec3 out = turned(own, turn);
                if (vtDot(out, out) > 0.0f) {
                    ++compared;
                    close += degreesBetween(vtMakeVec3(fixture->directions + 3 * p), out) < 0.5f;
                }
            }
            print_message("  %d of %d\n", close, compared);
            assert_true(compared > pictureSide * pictureSide / 10);
            assert_true(close >= 0.97 * compared);
        }
    }
}

// Each sample's rays go through its own place of the pixels.
static void samplesGoThroughTheirPlaces(void** state)
{
    Fixture* fixture = *state;
    const Part ball = {"sphere", {1, 1, 1}, {0, 0, 0}, glassOf(1.5f), 0};
    setParts(fixture->renderer, &ball, 1);
    for (int way = 0; way < wayCount; ++way) {
        for (int sample = 0; sample < 6; ++sample) {
            vtFrame frame = withWay(frontal(vt_techniqueExact), way);
            float x, y;
            frame.ior = 1.000001f; // all but straight on: at 1 nothing is counted as met
            frame.view = (vtView){{0, 0, 2.0f}, {0, 0, 0}, 30.0f};
            frame.firstSample = sample;
            draw(fixture, &frame);
            vtPixelSample(sample, &x, &y);
            for (int p = 0; p < little * little; ++p) {
                const float column = (float)(p % little) + 0.5f + x, row = (float)(p / little) + 0.5f - y;
                assert_true(degreesBetween(vtMakeVec3(fixture->directions + 3 * p),
                                           eyeRayAt(&frame, column, row)) < 0.02f);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plateTintsTwiceAndAbsorbsOnce),
        cmocka_unit_test(plateAbsorbsTheLightOfWhatIsInIt),
        cmocka_unit_test(plateAbsorbsTheLightThatAnEyeInItSees),
        cmocka_unit_test(clearGlassInGreyStaysGrey),
        cmocka_unit_test(pictureEnvironmentsAreThoseOfTheCpu),
        cmocka_unit_test(touchingPlatesAreCrossedAtOnce),
        cmocka_unit_test(eventsRunOut),
        cmocka_unit_test(eyeWithinGlassSeesOut),
        cmocka_unit_test(stretchedBallsFollowTheClosedForm),
        cmocka_unit_test(samplesGoThroughTheirPlaces),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
