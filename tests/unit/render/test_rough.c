// Rough glass, and glass that disperses, as `exact` draws them, by what is known of it without another
// renderer.
#include <math.h>
#include <string.h>

#include "rendering.h"

static float linearOf(uint8_t value)
{
    const float x = (float)value / 255.0f;
    return x <= 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
}

static void drawShape(Fixture* fixture, const vtFrame* frame)
{
    vtError error;
    assert_ok(vtRenderer_DrawImage(fixture->renderer, frame, fixture->pixels, &error), error);
}

/// An environment of one colour everywhere.
static void setWhite(Fixture* fixture)
{
    static float white[3 * 64 * 32];
    for (size_t i = 0; i < sizeof white / sizeof white[0]; ++i) {
        white[i] = 1.0f;
    }
    vtError error;
    const vtEnvironment environment = {vt_environmentImage, white, 64, 32};
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
}

// Where light comes alike from everywhere, glass that absorbs nothing is not to be seen, whatever its
// roughness.
static void nothingIsLostInAFurnace(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    setWhite(fixture);
    static const float roughnesses[] = {0.05f, 0.2f, 0.5f, 1.0f};
    for (int samples = 1; samples <= 33; samples += 32) {
        for (size_t i = 0; i < sizeof roughnesses / sizeof roughnesses[0]; ++i) {
            vtFrame frame = smallFrame(vt_techniqueExact);
            frame.width = frame.height = 48;
            frame.fresnel = true;
            frame.exposure = -1.0f;
            frame.maxEvents = 32;
            frame.roughness = roughnesses[i];
            frame.samples = samples;
            drawShape(fixture, &frame);
            double sum = 0.0;
            for (int at = 0; at < 48 * 48; ++at) {
                sum += (double)linearOf(fixture->pixels[4 * at]) / 0.5 / (48 * 48);
            }
            print_message("  roughness %g, %d samples: %.4f\n", (double)roughnesses[i], samples, sum);
            assert_true(fabs(sum - 1.0) < 0.02);
        }
    }
}

// Glass of the index around it bends nothing, and scatters nothing.
static void indexOneIsNoFog(void** state)
{
    Fixture* fixture = *state;
    static uint8_t smooth[sizeof fixture->pixels];
    setShape(fixture->renderer, "knot");
    setEnvironment(fixture->renderer, "checker");
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.fresnel = true;
    frame.ior = 1.0f;
    for (int chance = 0; chance < 2; ++chance) {
        frame.firstSample = chance;
        frame.samples = chance ? 4 : 1;
        frame.roughness = 0.0f;
        drawShape(fixture, &frame);
        memcpy(smooth, fixture->pixels, sizeof smooth);
        frame.roughness = 0.6f;
        drawShape(fixture, &frame);
        for (size_t i = 0; i < sizeof smooth; ++i) {
            assert_true(abs(smooth[i] - fixture->pixels[i]) <= 1);
        }
    }
}

// As glass gets smoother, pictures come to that of smooth glass; roughness 0 is that picture.
static void littleRoughnessIsSmooth(void** state)
{
    Fixture* fixture = *state;
    static uint8_t smooth[sizeof fixture->pixels];
    setShape(fixture->renderer, "sphere");
    setEnvironment(fixture->renderer, "studio");
    for (int chance = 0; chance < 2; ++chance) { // the first sample weighs more where glass is rough
        vtFrame frame = smallFrame(vt_techniqueExact);
        frame.fresnel = true;
        frame.firstSample = chance;
        frame.samples = chance ? 4 : 1;
        drawShape(fixture, &frame);
        memcpy(smooth, fixture->pixels, sizeof smooth);
        frame.roughness = 0.0f;
        drawShape(fixture, &frame);
        assert_memory_equal(smooth, fixture->pixels, sizeof smooth);
        double before = 1e9;
        for (float roughness = 0.3f; roughness > 0.01f; roughness *= 0.2f) {
            frame.roughness = roughness;
            drawShape(fixture, &frame);
            double sum = 0.0;
            for (size_t i = 0; i < sizeof smooth; ++i) {
                sum += abs(smooth[i] - fixture->pixels[i]) / (3.0 * side * side);
            }
            print_message("  roughness %g, %d samples: %.3f of 255 from smooth\n", (double)roughness,
                          frame.samples, sum);
            assert_true(sum < before);
            before = sum;
        }
        assert_true(before < 0.6);
    }
}

// All wavelengths together are white; without dispersion the picture is that of any other glass, and beside
// the glass (the first row) it is with it, too.
static void wavelengthsSumToWhite(void** state)
{
    Fixture* fixture = *state;
    static uint8_t plain[sizeof fixture->pixels];
    setShape(fixture->renderer, "knot");
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.width = frame.height = 48;
    frame.fresnel = true;
    frame.maxEvents = 32;
    for (int samples = 1; samples <= 33; samples += 32) {
        frame.samples = samples;
        setEnvironment(fixture->renderer, "studio");
        frame.exposure = 0.0f;
        frame.dispersion = -1.0f;
        drawShape(fixture, &frame);
        memcpy(plain, fixture->pixels, sizeof plain);
        frame.dispersion = 0.0f;
        drawShape(fixture, &frame);
        assert_memory_equal(plain, fixture->pixels, sizeof plain);
        frame.dispersion = 2.0f;
        drawShape(fixture, &frame);
        assert_memory_not_equal(plain, fixture->pixels, sizeof plain);
        assert_memory_equal(plain, fixture->pixels, 4 * (size_t)frame.width);

        setWhite(fixture);
        frame.exposure = -1.0f;
        drawShape(fixture, &frame);
        double sums[3] = {0.0};
        for (int at = 0; at < 4 * 48 * 48; ++at) {
            if (at % 4 < 3) {
                sums[at % 4] += (double)linearOf(fixture->pixels[at]) / 0.5 / (48 * 48);
            }
        }
        print_message("  %d samples: %.4f %.4f %.4f\n", samples, sums[0], sums[1], sums[2]);
        for (int channel = 0; channel < 3; ++channel) {
            assert_true(fabs(sums[channel] - 1.0) < 0.02);
        }
    }
}

static void addShape(vtScene* scene, const char* shape, const vtMaterial* material, const vtTransform* place)
{
    vtError error;
    vtMesh mesh;
    vtScene one;
    assert_ok(vtCreateShape(shape, &mesh, &error), error);
    assert_ok(vtCreateMeshScene(&mesh, material, &one, &error), error);
    assert_ok(vtScene_Append(scene, &one, place, &error), error);
}

/// Largest step of light between neighbours along a row.
static float largestStep(Fixture* fixture, const vtFrame* frame, int row)
{
    drawShape(fixture, frame);
    float step = 0.0f;
    for (int x = 1; x < frame->width; ++x) {
        const uint8_t* pixel = fixture->pixels + 4 * (row * frame->width + x);
        step = fmaxf(step, fabsf(linearOf(pixel[0]) - linearOf(pixel[-4])));
    }
    return step;
}

// The edge of something black behind a frosted pane, a wall without thickness or a body, has no sharp edge in
// one sample; beside the pane it has.
static void edgesBehindFrostAreSoft(void** state)
{
    Fixture* fixture = *state;
    setWhite(fixture);
    for (int thin = 0; thin < 2; ++thin) {
        vtMaterial black = vtDefaultMaterial(), pane = vtDefaultMaterial();
        black.opaque = true;
        black.baseColor = (vtVec3){0.0f, 0.0f, 0.0f};
        pane.thin = thin != 0;
        const vtTransform right = {{{1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, -1}}};
        const vtTransform flat = {{{2, 0, 0, 0}, {0, 0.3f, 0, 0}, {0, 0, 0.05f, 0}}};
        vtScene scene = {0};
        vtError error;
        addShape(&scene, "cube", &pane, &flat);
        addShape(&scene, "plane", &black, &right);
        assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
        vtDestroyScene(&scene);
        vtFrame frame = smallFrame(vt_techniqueExact);
        frame.width = frame.height = 48;
        frame.exposure = -1.0f;
        frame.view = (vtView){{0.0f, 0.0f, 4.0f}, {0.0f, 0.0f, 0.0f}, 25.0f};
        const float sharp = largestStep(fixture, &frame, 24);
        frame.roughness = 0.3f;
        const float soft = largestStep(fixture, &frame, 24), beside = largestStep(fixture, &frame, 2);
        print_message("  largest step: %.3f, frosted %.3f, beside it %.3f\n", (double)sharp, (double)soft,
                      (double)beside);
        assert_true(sharp > 0.3f && beside > 0.3f && soft < (thin ? 0.3f : 0.5f) * sharp);
    }
}

// ------------------------------------------------------------------------------- beside the reference

enum { small = 32, block = 4, blocks = small / block };

/// Means of linear light over blocks of pixels: noise goes, scattering stays.
typedef struct Means {
    float light[blocks * blocks][3];
} Means;

static void addPixel(Means* means, int at, const float light[3])
{
    float* to = means->light[at / small / block * blocks + at % small / block];
    for (int c = 0; c < 3; ++c) {
        to[c] += fminf(light[c], 1.0f) / (block * block);
    }
}

static float apart(const Means* a, const Means* b)
{
    double sum = 0.0;
    for (int i = 0; i < 3 * blocks * blocks; ++i) {
        sum += fabs((double)a->light[i / 3][i % 3] - (double)b->light[i / 3][i % 3]);
    }
    return (float)(sum / (3 * blocks * blocks));
}

static void traceMeans(vtScene* scene, const vtFrame* frame, Means* means)
{
    vtReference* reference;
    vtReferenceImage image;
    vtEnvironment environment;
    vtError error;
    assert_ok(vtCreateEnvironment("checker", &environment, &error), error);
    if (vtCreateReference(scene, &reference, &error) != vt_ok) {
        print_message("skipped: %s\n", error.message);
        vtDestroyScene(scene);
        skip();
    }
    const vtReferenceDef def = {
        .frame = frame, .environment = &environment, .samples = 128, .fresnel = true, .onlyPicture = true};
    assert_ok(vtReference_Trace(reference, &def, &image, &error), error);
    *means = (Means){{{0.0f}}};
    for (int at = 0; at < small * small; ++at) {
        addPixel(means, at, image.radiance + 3 * at);
    }
    vtDestroyReferenceImage(&image);
    vtDestroyReference(reference);
}

static void drawMeans(Fixture* fixture, const vtFrame* frame, Means* means)
{
    drawShape(fixture, frame);
    *means = (Means){{{0.0f}}};
    for (int at = 0; at < small * small; ++at) {
        const uint8_t* pixel = fixture->pixels + 4 * at;
        addPixel(means, at, (float[]){linearOf(pixel[0]), linearOf(pixel[1]), linearOf(pixel[2])});
    }
}

// What the reference traces by other code: a scattering wall without thickness, one of which a half is not
// there, and a body whose picture makes it smooth on one side and rough on the other.
static void roughLooksAreAsTraced(void** state)
{
    Fixture* fixture = *state;
    setEnvironment(fixture->renderer, "checker");
    for (int kind = 0; kind < 3; ++kind) {
        vtMaterial material = vtDefaultMaterial();
        vtMesh mesh;
        vtError error;
        vtScene scene;
        material.roughness = kind == 0 ? 1.0f : 0.5f;
        material.thin = kind < 2;
        material.alphaMode = kind == 1 ? vt_alphaBlend : vt_alphaOpaque;
        material.alpha = 0.5f;
        material.maps[vt_mapMetallicRoughness].image = kind == 2 ? 0 : -1;
        assert_ok(vtCreateShape(kind == 2 ? "cube" : "sphere", &mesh, &error), error);
        assert_ok(vtCreateMeshScene(&mesh, &material, &scene, &error), error);
        scene.images = calloc(1, sizeof *scene.images);
        scene.imageCount = 1;
        scene.images[0] = (vtImage){.pixels = malloc(8), .width = 2, .height = 1, .linear = true};
        memcpy(scene.images[0].pixels, (const uint8_t[]){255, 0, 0, 255, 255, 255, 0, 255}, 8);
        assert_ok(vtRenderer_SetScene(fixture->renderer, &scene, &error), error);
        assert_ok(vtRenderer_SetImages(fixture->renderer, scene.images, 1, &error), error);
        vtFrame frame = smallFrame(vt_techniqueExact);
        frame.width = frame.height = small;
        frame.fresnel = true;
        frame.ior = 0.0f;
        Means truth, lobe, mean, smooth;
        traceMeans(&scene, &frame, &truth);
        drawMeans(fixture, &frame, &lobe);
        frame.samples = 96;
        drawMeans(fixture, &frame, &mean);
        frame.roughness = 0.0f;
        drawMeans(fixture, &frame, &smooth);
        print_message("  from the reference: lobe %.4f, mean %.4f, smooth %.4f\n",
                      (double)apart(&lobe, &truth), (double)apart(&mean, &truth),
                      (double)apart(&smooth, &truth));
        assert_true(apart(&mean, &truth) < 0.006f && apart(&smooth, &truth) > 0.018f);
        assert_true(apart(&lobe, &truth) < 0.95f * apart(&smooth, &truth));
        vtDestroyScene(&scene);
    }
}

/// Sum of what two pictures' numbers differ by.
static int farApart(const uint8_t* a, const uint8_t* b, size_t count)
{
    int sum = 0;
    for (size_t i = 0; i < count; ++i) {
        sum += abs(a[i] - b[i]);
    }
    return sum;
}

// One path knows what the index does to it: its fringes are those of three paths, nearly. What follows the
// first sample has three paths whatever is asked for.
static void fewerWavelengthsHaveFringes(void** state)
{
    Fixture* fixture = *state;
    static uint8_t seen[sizeof fixture->pixels], fringed[sizeof fixture->pixels],
        plain[sizeof fixture->pixels];
    static const char* const shapes[] = {"sphere", "knot"};
    setEnvironment(fixture->renderer, "studio");
    vtFrame frame = smallFrame(vt_techniqueExact);
    frame.fresnel = true;
    for (int shape = 0; shape < 2; ++shape) {
        setShape(fixture->renderer, shapes[shape]);
        frame.ior = 1.5f;
        frame.dispersion = 2.0f;
        drawShape(fixture, &frame);
        memcpy(fringed, fixture->pixels, sizeof fringed);
        frame.wavelengths = 1;
        drawShape(fixture, &frame);
        memcpy(seen, fixture->pixels, sizeof seen);
        frame.wavelengths = 0;
        frame.dispersion = 0.0f;
        frame.ior = 1.5f + 0.5f * 2.0f / 20.0f * (-0.228f + 0.237f + 1.182f) / 3.0f;
        drawShape(fixture, &frame);
        memcpy(plain, fixture->pixels, sizeof plain);
        const int one = farApart(seen, fringed, sizeof seen), none = farApart(plain, fringed, sizeof plain);
        print_message("  %s: one path %d, no fringes %d\n", shapes[shape], one, none);
        assert_true(none > 0);
        assert_true((float)one < 0.8f * (float)none);
    }
    frame.ior = 1.5f;
    frame.dispersion = 3.0f;
    frame.firstSample = 1;
    frame.samples = 2;
    for (int wavelengths = 1; wavelengths <= 3; wavelengths += 2) {
        frame.wavelengths = wavelengths;
        drawShape(fixture, &frame);
        memcpy(wavelengths == 1 ? seen : fringed, fixture->pixels, sizeof seen);
    }
    assert_int_equal(farApart(seen, fringed, sizeof seen), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothingIsLostInAFurnace),     cmocka_unit_test(indexOneIsNoFog),
        cmocka_unit_test(littleRoughnessIsSmooth),     cmocka_unit_test(wavelengthsSumToWhite),
        cmocka_unit_test(edgesBehindFrostAreSoft),     cmocka_unit_test(roughLooksAreAsTraced),
        cmocka_unit_test(fewerWavelengthsHaveFringes),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
