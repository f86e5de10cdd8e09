// The reference where it decides by chance: rough surfaces, wavelengths, paths of little light; against
// closed forms and integrals.
#include <math.h>

#include "base/math.h"
#include "lab/reference/reference.h"
#include "lab/reference/reference_chance.h"
#include "lab/reference/reference_rough.h"
#include "lab/reference/reference_spectrum.h"
#include "testing.h"

// ---------------------------------------------------------------------------------------------- scenes

static vtScene makeScene(vtMesh mesh, vtMaterial material)
{
    vtScene scene;
    vtError error;
    assert_ok(vtCreateMeshScene(&mesh, &material, &scene, &error), error);
    return scene;
}

static vtScene makeShape(const char* name, vtMaterial material)
{
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateShape(name, &mesh, &error), error);
    return makeScene(mesh, material);
}

static vtMaterial glassOf(float ior, float roughness, float dispersion)
{
    vtMaterial material = vtDefaultMaterial();
    material.ior = ior;
    material.roughness = roughness;
    material.dispersion = dispersion;
    return material;
}

static vtReferenceImage traceScene(const vtScene* scene, const vtFrame* frame,
                                   const vtEnvironment* environment, int samples)
{
    vtReference* reference;
    vtReferenceImage image;
    vtError error;
    const vtReferenceDef def = {.frame = frame,
                                .environment = environment,
                                .samples = samples,
                                .fresnel = frame->fresnel,
                                .threads = 1};
    assert_ok(vtCreateReference(scene, &reference, &error), error);
    assert_ok(vtReference_Trace(reference, &def, &image, &error), error);
    vtDestroyReference(reference);
    return image;
}

/// Mean light of the pixels where paths have events, or of all.
static vtVec3 meanOf(const vtReferenceImage* image, bool all)
{
    double sum[3] = {0.0}, count = 0.0;
    for (int i = 0; i < image->width * image->height; ++i) {
        if (all || image->events[i] > 0) {
            ++count;
            for (int c = 0; c < 3; ++c) {
                sum[c] += (double)image->radiance[3 * i + c];
            }
        }
    }
    assert_true(count > 0.0);
    return (vtVec3){(float)(sum[0] / count), (float)(sum[1] / count), (float)(sum[2] / count)};
}

static vtVec3 meanOfScene(const vtScene* scene, const vtFrame* frame, const vtEnvironment* environment,
                          int samples, bool all)
{
    vtReferenceImage image = traceScene(scene, frame, environment, samples);
    const vtVec3 mean = meanOf(&image, all);
    vtDestroyReferenceImage(&image);
    return mean;
}

static vtFrame makeFrame(int size)
{
    vtFrame frame = vtDefaultFrame();
    frame.width = frame.height = size;
    frame.maxEvents = 16;
    return frame;
}

static float whitePixels[3 * 8] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
static const vtEnvironment whiteRoom = {vt_environmentImage, whitePixels, 4, 2};

// ---------------------------------------------------------------------------------------------- furnace

static void roughGlassKeepsItsLight(void** state)
{
    (void)state;
    static const float roughnesses[] = {0.05f, 0.1f, 0.2f, 0.35f, 0.5f, 0.7f, 0.85f, 1.0f};
    for (size_t i = 0; i < 2 * sizeof roughnesses / sizeof roughnesses[0]; ++i) {
        const float roughness = roughnesses[i / 2];
        vtMaterial material = glassOf(1.5f, roughness, 0.0f);
        material.thin = i % 2 == 1;
        vtScene scene = makeShape("sphere", material);
        const vtFrame frame = makeFrame(24);
        const vtVec3 mean = meanOfScene(&scene, &frame, &whiteRoom, 16, true);
        print_message("roughness %g%s: %.4f\n", (double)roughness, material.thin ? ", thin" : "",
                      (double)mean.x);
        assert_near(mean.x, 1.0f, 0.005f);
        assert_near(mean.y, 1.0f, 0.005f);
        vtDestroyScene(&scene);
    }
}

/// A film on it, which colours what is reflected: what each channel loses there it has more of behind.
static void colouredReflectionKeepsItsLight(void** state)
{
    (void)state;
    vtMaterial material = glassOf(1.5f, 0.6f, 0.0f);
    material.specularColor = (vtVec3){1.0f, 4.0f, 0.2f};
    vtScene scene = makeShape("sphere", material);
    const vtFrame frame = makeFrame(24);
    const vtVec3 mean = meanOfScene(&scene, &frame, &whiteRoom, 64, true);
    print_message("coloured: %.4f %.4f %.4f\n", (double)mean.x, (double)mean.y, (double)mean.z);
    assert_near(mean.x, 1.0f, 0.01f);
    assert_near(mean.y, 1.0f, 0.01f);
    assert_near(mean.z, 1.0f, 0.01f);
    vtDestroyScene(&scene);
}

/// Where indices are equal there is no surface, whatever its roughness.
static void roughIndexOneIsNotThere(void** state)
{
    (void)state;
    vtEnvironment studio;
    vtError error;
    assert_ok(vtCreateEnvironment("checker", &studio, &error), error);
    for (int thin = 0; thin < 2; ++thin) {
        vtReferenceImage images[2];
        for (int rough = 0; rough < 2; ++rough) {
            vtMaterial material = glassOf(1.0f, rough ? 0.7f : 0.0f, 0.0f);
            material.thin = thin != 0;
            vtScene scene = makeShape("cube", material);
            const vtFrame frame = makeFrame(32);
            images[rough] = traceScene(&scene, &frame, &studio, 4);
            vtDestroyScene(&scene);
        }
        assert_memory_equal(images[0].radiance, images[1].radiance, 3 * sizeof(float) * 32 * 32);
        vtDestroyReferenceImage(&images[0]);
        vtDestroyReferenceImage(&images[1]);
    }
    vtDestroyEnvironment(&studio);
}

/// Of light that meets a thin wall about 0.04 comes back, a little more where it is rough, and all else gets
/// to the other side, scattered as what comes back is.
static void thinWallScattersToBothSides(void** state)
{
    (void)state;
    float pixels[2][3 * 512 * 2];
    for (int i = 0; i < 3 * 512 * 2; ++i) { // +z, whence the eye looks, is u > 0.5
        const int column = i / 3 % 512;
        pixels[0][i] = column >= 256 ? 1.0f : 0.0f;
        pixels[1][i] = abs(column - 128) < 20 || abs(column - 384) < 20 ? 1.0f : 0.0f; // about the z axis
    }
    vtFrame frame = makeFrame(16);
    frame.view = (vtView){{0.1f, 0.05f, 3.0f}, {0.1f, 0.05f, 0.0f}, 1.0f};
    vtVec3 light[2][2]; // by roughness, then picture
    for (int i = 0; i < 4; ++i) {
        vtMaterial material = glassOf(1.5f, i < 2 ? 0.2f : 0.7f, 0.0f);
        material.thin = true;
        vtScene scene = makeShape("plane", material);
        const vtEnvironment environment = {vt_environmentImage, pixels[i % 2], 512, 2};
        light[i / 2][i % 2] = meanOfScene(&scene, &frame, &environment, 64, true);
        vtDestroyScene(&scene);
    }
    print_message("mirrored %.4f and %.4f; within 14 degrees %.3f and %.3f\n", (double)light[0][0].x,
                  (double)light[1][0].x, (double)light[0][1].x, (double)light[1][1].x);
    assert_near(light[0][0].x, 0.04f, 0.002f);
    assert_true(light[1][0].x > 0.041f && light[1][0].x < 0.06f);
    assert_true(light[0][1].x > 0.9f && light[1][1].x < 0.4f);
}

/// Green of the picture times roughness: where it is black the surface is smooth.
static void roughnessFollowsItsPicture(void** state)
{
    (void)state;
    vtEnvironment checker;
    vtError error;
    assert_ok(vtCreateEnvironment("checker", &checker, &error), error);
    vtReferenceImage images[3];
    for (int i = 0; i < 3; ++i) { // smooth, its picture black, its picture grey
        vtMaterial material = glassOf(1.5f, i == 0 ? 0.0f : 0.8f, 0.0f);
        material.maps[vt_mapMetallicRoughness].image = i == 0 ? -1 : 0;
        vtScene scene = makeShape("cube", material);
        scene.images = calloc(1, sizeof *scene.images);
        scene.imageCount = 1;
        scene.images[0] = (vtImage){.pixels = malloc(4), .width = 1, .height = 1, .linear = true};
        memcpy(scene.images[0].pixels, (const uint8_t[]){255, i == 2 ? 128 : 0, 0, 255}, 4);
        vtFrame frame = makeFrame(24);
        images[i] = traceScene(&scene, &frame, &checker, 2);
        vtDestroyScene(&scene);
    }
    int glass = 0, same = 0;
    for (int i = 0; i < 3 * 24 * 24; ++i) {
        assert_near(images[0].radiance[i], images[1].radiance[i], 5e-3f);
        glass += images[0].events[i / 3] > 0;
        same += images[0].events[i / 3] > 0 && fabsf(images[0].radiance[i] - images[2].radiance[i]) < 5e-3f;
    }
    assert_true(glass > 300 && same < glass / 4);
    for (int i = 0; i < 3; ++i) {
        vtDestroyReferenceImage(&images[i]);
    }
    vtDestroyEnvironment(&checker);
}

// ----------------------------------------------------------------------------------------------- facets

static double lambdaOf(double cosine, double alpha)
{
    const double tangent2 = (1.0 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (sqrt(1.0 + alpha * alpha * tangent2) - 1.0);
}

static double ggx(double cosine, double alpha)
{
    const double t = cosine * cosine * (alpha * alpha - 1.0) + 1.0;
    return alpha * alpha / (3.14159265358979 * t * t);
}

/// What leaves after one facet: its share, and the mean of its direction, by integrating Walter's BSDF
/// without Fresnel's share. `eta`: index before over the one behind; 0: mirrored.
static void integrate(double sine, double alpha, double eta, double result[3])
{
    enum { rings = 400, sectors = 400 };
    const double cosine = sqrt(1.0 - sine * sine), pi = 3.14159265358979;
    result[0] = result[1] = result[2] = 0.0;
    for (int ring = 0; ring < rings; ++ring) {
        const double t = (ring + 0.5) / rings, z = 1.0 - t * t, radius = sqrt(1.0 - z * z);
        for (int sector = 0; sector < sectors; ++sector) {
            const double angle = 2.0 * pi * (sector + 0.5) / sectors;
            const double x = radius * cos(angle), y = radius * sin(angle), side = eta > 0.0 ? -1.0 : 1.0;
            const double n = eta > 0.0 ? 1.0 / eta : 1.0; // i = (-sine, 0, cosine), o = (x, y, side z)
            const double flip = eta > 0.0 ? -1.0 : 1.0;
            double h[3] = {flip * (-sine + n * x), flip * n * y, flip * (cosine + n * side * z)};
            const double length = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
            const double im = (-sine * h[0] + cosine * h[2]) / length;
            const double om = (x * h[0] + y * h[1] + side * z * h[2]) / length, m = h[2] / length;
            const double li = lambdaOf(cosine, alpha), lo = lambdaOf(z, alpha);
            double density = 0.0;
            if (eta > 0.0 && im > 0.0 && om < 0.0 && m > 0.0) {
                const double G = tgamma(1.0 + li) * tgamma(1.0 + lo) / tgamma(2.0 + li + lo);
                const double both = im + n * om;
                density = im * -om / cosine * n * n * G * ggx(m, alpha) / (both * both);
            } else if (eta <= 0.0) {
                density = ggx(m, alpha) / (1.0 + li + lo) / (4.0 * cosine);
            }
            density *= 4.0 * pi * t / (rings * sectors);
            result[0] += density;
            result[1] += density * x;
            result[2] += density * z;
        }
    }
}

/// The same by rays among facets.
static void gather(double sine, double alpha, double eta, double result[3])
{
    enum { count = 200000 };
    uint32_t row = vtMixWords(7, 9);
    result[0] = result[1] = result[2] = 0.0;
    for (int i = 0; i < count; ++i) {
        vtFacetRay ray = {{(float)sine, 0.0f, -(float)sqrt(1.0 - sine * sine)}, 1.0f, (float)eta, false};
        assert_true(vtFacetRay_Advance(&ray, (float)alpha, vtChance_Next(&row)));
        const float chances[2] = {vtChance_Next(&row), vtChance_Next(&row)};
        const vtVec3 N = vtFacetRay_Normal(&ray, (float)alpha, chances);
        if (eta > 0.0) {
            assert_true(vtFacetRay_Refract(&ray, N));
            assert_true(ray.through);
        } else {
            vtFacetRay_Mirror(&ray, N);
        }
        if (!vtFacetRay_Advance(&ray, (float)alpha, vtChance_Next(&row))) {
            result[0] += 1.0 / count;
            result[1] += (double)ray.direction.x / count;
            result[2] += (double)ray.direction.z / count;
        }
    }
}

static void facetsScatterAsTheirIntegral(void** state)
{
    (void)state;
    static const double alphas[] = {0.15, 0.4, 1.0}, sines[] = {0.1, 0.6, 0.9};
    for (int i = 0; i < 18; ++i) {
        const double alpha = alphas[i / 3 % 3], sine = sines[i % 3], eta = i < 9 ? 0.0 : 1.0 / 1.5;
        double wanted[3], found[3];
        integrate(sine, alpha, eta, wanted);
        gather(sine, alpha, eta, found);
        print_message("%s, alpha %g, sine %g: %.3f %.3f %.3f, integral %.3f %.3f %.3f\n",
                      eta > 0.0 ? "refracted" : "mirrored", alpha, sine, found[0], found[1], found[2],
                      wanted[0], wanted[1], wanted[2]);
        for (int k = 0; k < 3; ++k) {
            assert_near((float)found[k], (float)wanted[k], 0.006f);
        }
    }
}

// ----------------------------------------------------------------------------------------------- chance

static void chancesFillTheSquare(void** state)
{
    (void)state;
    for (uint32_t key = 1; key < 50; ++key) {
        int cells[2][64] = {{0}}; // of 8 x 8, and of 64 x 1
        for (uint32_t sample = 0; sample < 64; ++sample) {
            float pair[2];
            vtChance_Pair(vtMixWords(key, 0), vt_chanceFacet, sample, pair);
            assert_true(pair[0] >= 0.0f && pair[0] < 1.0f && pair[1] >= 0.0f && pair[1] < 1.0f);
            ++cells[0][(int)(pair[0] * 8.0f) * 8 + (int)(pair[1] * 8.0f)];
            ++cells[1][(int)(pair[key % 2] * 64.0f)];
        }
        for (int i = 0; i < 64; ++i) {
            assert_int_equal(cells[0][i], 1);
            assert_int_equal(cells[1][i], 1);
        }
    }
}

/// A plate whose surfaces reflect 0.0006 each mirrors a light that is dark but for what lies behind the eye:
/// 2 R / (1 + R) of it (Hecht, Optics, section 4.6), although each of its paths is below what is always
/// followed. And a sample that is lucky counts for all that it finds.
static void lightIsKeptByChance(void** state)
{
    (void)state;
    float pixels[3 * 8 * 2] = {0};
    for (int i = 0; i < 8 * 2; ++i) { // behind the eye: u > 0.5
        pixels[3 * i] = i % 8 >= 4 ? 10000.0f : 0.0f;
    }
    const vtEnvironment behind = {vt_environmentImage, pixels, 8, 2};
    vtScene scene = makeShape("cube", glassOf(1.05f, 0.0f, 0.0f));
    vtFrame frame = makeFrame(16);
    frame.view = (vtView){{0.1f, 0.05f, 3.0f}, {0.1f, 0.05f, 0.0f}, 1.0f};
    const float R = 0.05f * 0.05f / (2.05f * 2.05f), wanted = 10000.0f * 2.0f * R / (1.0f + R);
    const vtVec3 mean = meanOfScene(&scene, &frame, &behind, 256, true);
    print_message("a glint of %.4f: %.4f\n", (double)wanted, (double)mean.x);
    assert_near(mean.x, wanted, 0.02f * wanted);
    vtDestroyScene(&scene);
}

// ------------------------------------------------------------------------------------------ wavelengths

static void spectrumIsWhite(void** state)
{
    (void)state;
    static vtSpectrum spectrum;
    vtMakeSpectrum(&spectrum);
    double sum[3] = {0.0}, spread[3] = {0.0};
    for (int i = 0; i < vt_spectrumSteps; ++i) {
        const vtVec3 c = spectrum.colors[i];
        const double color[3] = {(double)c.x, (double)c.y, (double)c.z};
        assert_true(i == 0 || spectrum.nanometres[i] > spectrum.nanometres[i - 1]);
        for (int k = 0; k < 3; ++k) {
            sum[k] += color[k] / vt_spectrumSteps;
            spread[k] += color[k] * (double)vtSpread(spectrum.nanometres[i]) / vt_spectrumSteps;
        }
    }
    const float means[3] = {VT_SPREAD_RED, VT_SPREAD_GREEN, VT_SPREAD_BLUE};
    for (int k = 0; k < 3; ++k) {
        assert_near((float)sum[k], 1.0f, 1e-4f);
        assert_near((float)spread[k], means[k], 0.01f); // of what each channel sees
    }
    // By definition of the Abbe number: flint F2 at the lines F, d and C.
    const float D = 20.0f / 36.37f, n = 1.62f;
    const float F = vtDispersedIndex(n, D, vtSpread(486.1f)), C = vtDispersedIndex(n, D, vtSpread(656.3f));
    assert_near((n - 1.0f) / (F - C), 36.37f, 0.2f);
    assert_near(vtDispersedIndex(n, D, vtSpread(587.6f)), n, 1e-4f);
    assert_near(vtDispersedIndex(0.8f, 0.0f, 1.0f), 0.8f, 0.0f);
    assert_near(vtDispersedIndex(1.01f, 20.0f, -2.0f), 1.0f, 0.0f);
}

static void dispersionLeavesWhiteWhite(void** state)
{
    (void)state;
    for (int i = 0; i < 4; ++i) {
        vtScene scene =
            makeShape(i % 2 == 0 ? "sphere" : "diamond", glassOf(1.6f, i == 2 ? 0.3f : 0.0f, 0.6f));
        const vtFrame frame = makeFrame(32);
        const int samples = i < 2 ? 64 : i == 2 ? 128 : 1;
        const vtVec3 mean = meanOfScene(&scene, &frame, &whiteRoom, samples, false);
        print_message("white through dispersing glass, %d samples: %.4f %.4f %.4f\n", samples, (double)mean.x,
                      (double)mean.y, (double)mean.z);
        assert_near(mean.x, 1.0f, 0.01f);
        assert_near(mean.y, 1.0f, 0.01f);
        assert_near(mean.z, 1.0f, 0.01f);
        vtDestroyScene(&scene);
    }
}

/// A prism of 30 degrees, its first face across -z, its edge at x = 1.
static vtMesh createPrism(void)
{
    const float low = -2.0f * tanf(VT_PI / 6.0f);
    const float outline[3][2] = {{1.0f, 0.0f}, {-1.0f, 0.0f}, {-1.0f, low}}; // x and z
    float positions[3 * 18], normals[3 * 18];
    uint32_t indices[24], vertex = 0, index = 0;
    for (int side = 0; side < 3; ++side) {
        const float *a = outline[side], *b = outline[(side + 1) % 3];
        const float x = b[1] - a[1], z = a[0] - b[0], length = sqrtf(x * x + z * z);
        for (int corner = 0; corner < 4; ++corner) {
            const float* p = corner == 1 || corner == 2 ? b : a;
            const float place[3] = {p[0], corner >= 2 ? 1.0f : -1.0f, p[1]},
                        N[3] = {x / length, 0, z / length};
            memcpy(positions + 3 * (vertex + (uint32_t)corner), place, sizeof place);
            memcpy(normals + 3 * (vertex + (uint32_t)corner), N, sizeof N);
        }
        static const uint32_t square[6] = {0, 2, 1, 0, 3, 2};
        for (int i = 0; i < 6; ++i) {
            indices[index++] = vertex + square[i];
        }
        vertex += 4;
    }
    for (int cap = 0; cap < 2; ++cap) {
        for (int corner = 0; corner < 3; ++corner) {
            const float place[3] = {outline[corner][0], cap == 0 ? -1.0f : 1.0f, outline[corner][1]};
            const float N[3] = {0.0f, place[1], 0.0f};
            memcpy(positions + 3 * (vertex + (uint32_t)corner), place, sizeof place);
            memcpy(normals + 3 * (vertex + (uint32_t)corner), N, sizeof N);
        }
        const uint32_t order[2][3] = {{0, 1, 2}, {0, 2, 1}};
        for (int i = 0; i < 3; ++i) {
            indices[index++] = vertex + order[cap][i];
        }
        vertex += 3;
    }
    const vtMeshDef def = {
        .positions = positions, .normals = normals, .indices = indices, .vertexCount = 18, .indexCount = 24};
    vtMesh mesh;
    vtError error;
    assert_ok(vtCreateMesh(&def, "prism", &mesh, &error), error);
    assert_int_equal(mesh.openEdgeCount, 0);
    assert_true(mesh.volume > 0.0f);
    return mesh;
}

/// Light that meets the first face straight leaves the second turned by asin(n sin 30) - 30 degrees, n that
/// of its wavelength. Surroundings that are bright from some direction on show which wavelengths get there.
static void prismBendsByWavelength(void** state)
{
    (void)state;
    static vtSpectrum spectrum;
    vtMakeSpectrum(&spectrum);
    enum { columns = 2048 };
    static float pixels[3 * columns * 2];
    const vtEnvironment environment = {vt_environmentImage, pixels, columns, 2};
    const float ior = 1.62f, dispersion = 20.0f / 36.37f;
    vtScene scene = makeScene(createPrism(), glassOf(ior, 0.0f, dispersion));
    vtFrame frame = makeFrame(4);
    frame.view = (vtView){{0.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, 45.0f};
    frame.orthographicHeight = 0.5f;
    frame.fresnel = false;
    for (int step = 0; step < 6; ++step) {
        const float edge = (23.6f + 0.3f * (float)step) * VT_PI / 180.0f;
        const float u = 0.5f + atan2f(-cosf(edge), -sinf(edge)) / (2.0f * VT_PI);
        for (int i = 0; i < 3 * columns * 2; ++i) {
            pixels[i] = i / 3 % columns < (int)(u * columns) ? 1.0f : 0.0f;
        }
        vtVec3 wanted = {0.0f, 0.0f, 0.0f}, white = {0.0f, 0.0f, 0.0f};
        for (int i = 0; i < vt_spectrumSteps; ++i) {
            const float L = spectrum.nanometres[i];
            const float n = ior + (ior - 1.0f) * dispersion / 20.0f * (523655.0f / (L * L) - 1.5168f);
            const float turn = asinf(n * 0.5f) - VT_PI / 6.0f;
            const vtVec3 found = vtEnvironment_Sample(&environment, (vtVec3){-sinf(turn), 0.0f, -cosf(turn)});
            wanted = vtMulAdd(wanted, found.x / vt_spectrumSteps, spectrum.colors[i]);
        }
        const float spreads[3] = {VT_SPREAD_RED, VT_SPREAD_GREEN, VT_SPREAD_BLUE};
        float* channels[3] = {&white.x, &white.y, &white.z};
        for (int c = 0; c < 3; ++c) {
            const float turn = asinf(0.5f * vtDispersedIndex(ior, dispersion, spreads[c])) - VT_PI / 6.0f;
            *channels[c] = vtEnvironment_Sample(&environment, (vtVec3){-sinf(turn), 0.0f, -cosf(turn)}).x;
        }
        const vtVec3 found = meanOfScene(&scene, &frame, &environment, 256, false);
        const vtVec3 single = meanOfScene(&scene, &frame, &environment, 1, false);
        print_message("beyond %.1f degrees: %.3f %.3f %.3f, closed form %.3f %.3f %.3f\n",
                      (double)(edge * 180.0f / VT_PI), (double)found.x, (double)found.y, (double)found.z,
                      (double)wanted.x, (double)wanted.y, (double)wanted.z);
        assert_near(vtLength(vtSub(found, wanted)), 0.0f, 0.02f);
        assert_near(vtLength(vtSub(single, white)), 0.0f, 0.02f);
    }
    vtDestroyScene(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(roughGlassKeepsItsLight),
        cmocka_unit_test(colouredReflectionKeepsItsLight),
        cmocka_unit_test(roughIndexOneIsNotThere),
        cmocka_unit_test(thinWallScattersToBothSides),
        cmocka_unit_test(roughnessFollowsItsPicture),
        cmocka_unit_test(facetsScatterAsTheirIntegral),
        cmocka_unit_test(chancesFillTheSquare),
        cmocka_unit_test(lightIsKeptByChance),
        cmocka_unit_test(spectrumIsWhite),
        cmocka_unit_test(dispersionLeavesWhiteWhite),
        cmocka_unit_test(prismBendsByWavelength),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
