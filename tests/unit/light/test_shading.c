// The light of opaque surfaces: against brute force, and the shaders against their twins in C.
#include <math.h>
#include <time.h>

#include "light/shading.h"
#include "shading_cases.h"

// ----------------------------------------------------------------------------------------------- lighting

/// Mean radiance by a kernel about the axis, over 480 x 240 directions: the cosine lobe, or (roughness above
/// 0) GGX with normal, view and axis alike.
static vtVec3 bruteForce(const vtEnvironment* environment, vtVec3 axis, float roughness)
{
    enum { columns = 480, rows = 240 };
    const float alpha2 = powf(roughness, 4.0f);
    double sums[4] = {0};
    for (int row = 0; row < rows; ++row) {
        const float latitude = VT_PI * (0.5f - ((float)row + 0.5f) / (float)rows);
        for (int column = 0; column < columns; ++column) {
            const float azimuth = 2.0f * VT_PI * ((float)column + 0.5f) / (float)columns;
            const vtVec3 L = {cosf(latitude) * cosf(azimuth), sinf(latitude), cosf(latitude) * sinf(azimuth)};
            const float cosine = vtDot(L, axis);
            if (cosine <= 0.0f) {
                continue;
            }
            float weight = cosine * cosf(latitude);
            if (roughness > 0.0f) {
                const float spread = 0.5f * (1.0f + cosine) * (alpha2 - 1.0f) + 1.0f;
                weight /= spread * spread;
            }
            const vtVec3 light = vtEnvironment_Sample(environment, L);
            sums[0] += (double)(weight * light.x);
            sums[1] += (double)(weight * light.y);
            sums[2] += (double)(weight * light.z);
            sums[3] += (double)weight;
        }
    }
    return (vtVec3){(float)(sums[0] / sums[3]), (float)(sums[1] / sums[3]), (float)(sums[2] / sums[3])};
}

/// The largest and the mean error over some directions, of the brightest of the true values.
static void compareToBruteForce(const char* name, float roughness, float largestAllowed, float meanAllowed)
{
    enum { count = 24 };
    const vtEnvironment environment = builtIn(name);
    vtLighting lighting = lightingOf(&environment);
    float largest = 0.0f, sum = 0.0f, brightest = 0.0f;
    for (uint32_t i = 0; i < count; ++i) {
        const vtVec3 axis = i < 2 ? (vtVec3){0.0f, i == 0 ? 1.0f : -1.0f, 0.0f} : onSphere(i);
        const vtVec3 truth = bruteForce(&environment, axis, roughness);
        const vtVec3 found = roughness > 0.0f ? vtLighting_Specular(&lighting, axis, roughness)
                                              : vtLighting_Diffuse(&lighting, axis);
        const float error = difference(truth, found);
        largest = fmaxf(largest, error);
        sum += error;
        brightest = fmaxf(brightest, fmaxf(truth.x, fmaxf(truth.y, truth.z)));
    }
    largest /= brightest;
    const float mean = sum / (float)count / brightest;
    print_message("%s, roughness %g: largest error %.4f, mean %.4f of the brightest\n", name,
                  (double)roughness, (double)largest, (double)mean);
    assert_true(largest <= largestAllowed);
    assert_true(mean <= meanAllowed);
    vtDestroyLighting(&lighting);
}

static void irradianceIsTheCosineIntegral(void** state)
{
    (void)state;
    compareToBruteForce("checker", 0.0f, 0.05f, 0.015f);
    compareToBruteForce("studio", 0.0f, 0.05f, 0.015f);
    compareToBruteForce("sky", 0.0f, 0.05f, 0.015f);
}

static void roughLevelsAreTheGgxIntegral(void** state)
{
    (void)state;
    static const float roughnesses[] = {1.0f, 0.7f, 0.45f, 0.25f};
    for (size_t i = 0; i < sizeof roughnesses / sizeof roughnesses[0]; ++i) {
        compareToBruteForce("checker", roughnesses[i], 0.03f, 0.01f);
        compareToBruteForce("studio", roughnesses[i], 0.03f, 0.01f);
        compareToBruteForce("sky", roughnesses[i], 0.03f, 0.01f);
    }
}

static void aWhiteEnvironmentStaysWhite(void** state)
{
    (void)state;
    const int widths[] = {1, 64, 1024};
    for (int k = 0; k < 3; ++k) {
        vtEnvironment environment = imageEnvironment(widths[k], k == 0 ? 1 : widths[k] / 2, false);
        vtLighting lighting = lightingOf(&environment);
        for (uint32_t i = 0; i < 500; ++i) {
            const vtVec3 white = {1.0f, 1.0f, 1.0f}, d = onSphere(i);
            assert_true(difference(vtLighting_Diffuse(&lighting, d), white) < 2e-3f);
            assert_true(difference(vtLighting_Specular(&lighting, d, unit(i + 999u)), white) < 1e-4f);
        }
        vtDestroyLighting(&lighting);
        vtDestroyEnvironment(&environment);
    }
}

static void roughnessBlendsFromTheEnvironmentOn(void** state)
{
    (void)state;
    const vtEnvironment environment = builtIn("sky");
    vtLighting lighting = lightingOf(&environment);
    for (uint32_t i = 0; i < 200; ++i) {
        const vtVec3 d = onSphere(i);
        assert_true(difference(vtLighting_Specular(&lighting, d, 0.0f),
                               vtEnvironment_Sample(&environment, d)) == 0.0f);
        vtVec3 before = vtLighting_Specular(&lighting, d, 0.0f);
        for (int step = 1; step <= 1000; ++step) { // no jump from level to level
            const vtVec3 next = vtLighting_Specular(&lighting, d, (float)step / 1000.0f);
            assert_true(difference(before, next) <
                        0.03f * (1.0f + vtLength(vtEnvironment_Sample(&environment, d))));
            before = next;
        }
    }
    vtDestroyLighting(&lighting);
}

static void lightingIsQuick(void** state)
{
    (void)state;
    vtEnvironment environments[] = {builtIn("checker"), builtIn("studio"), builtIn("sky"),
                                    imageEnvironment(512, 256, true), imageEnvironment(4096, 2048, true)};
    static const char* const names[] = {"checker", "studio", "sky", "512 x 256", "4096 x 2048"};
    for (int i = 0; i < 5; ++i) {
        struct timespec start, end;
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &start);
        vtLighting lighting = lightingOf(&environments[i]);
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
        vtDestroyLighting(&lighting);
        vtDestroyEnvironment(&environments[i]);
        const double seconds =
            (double)(end.tv_sec - start.tv_sec) + 1e-9 * (double)(end.tv_nsec - start.tv_nsec);
        print_message("lighting of %s: %.0f ms\n", names[i], 1000.0 * seconds);
        assert_true(seconds < 20.0); // sanitizers; 0.15 s in a release build
    }
}

// ------------------------------------------------------------------------------------------------ surfaces

/// The light of the scene's first object.
static vtVec3 shade(const vtScene* scene, const vtLighting* lighting, uint32_t triangle, float u, float v,
                    vtVec3 I)
{
    vtPlacedObject* placed;
    uint32_t glassCount;
    vtError error;
    assert_ok(vtPlaceObjects(scene, &placed, &glassCount, &error), error);
    const vtVec3 light = vtShadeSurface(scene, placed, lighting, triangle, u, v, I);
    free(placed);
    return light;
}

static const vtVec3 towardsBack = {0.0f, 0.0f, -1.0f};

static void whiteLightShowsTheBaseColor(void** state)
{
    (void)state;
    vtEnvironment environment = imageEnvironment(64, 32, false);
    vtLighting lighting = lightingOf(&environment);
    vtMaterial material = opaque(0.0f, 1.0f);
    material.baseColor = (vtVec3){0.2f, 0.5f, 0.9f};
    material.emissive = (vtVec3){0.0f, 0.0f, 2.0f};
    vtScene scene = squareScene(&material, NULL);
    // Dielectrics reflect 1.6 percent of white light straight on where they are fully rough.
    assert_true(difference(shade(&scene, &lighting, 0, 0.2f, 0.3f, towardsBack),
                           (vtVec3){0.216f, 0.516f, 2.916f}) < 3e-3f);
    // Both sides are the same.
    assert_true(difference(shade(&scene, &lighting, 1, 0.2f, 0.3f, (vtVec3){0.0f, 0.0f, 1.0f}),
                           (vtVec3){0.216f, 0.516f, 2.916f}) < 3e-3f);
    // A white metal: the approximation has 1 - 0.55 roughness, for light that is reflected once.
    for (int i = 0; i <= 10; ++i) {
        const float roughness = 0.1f * (float)i;
        scene.materials[0] = opaque(1.0f, roughness);
        scene.materials[0].baseColor = (vtVec3){1.0f, 1.0f, 1.0f};
        for (uint32_t k = 0; k < 20; ++k) {
            const vtVec3 light = shade(&scene, &lighting, 0, 0.2f, 0.3f, onSphere(k));
            assert_near(light.x, 1.0f - 0.55f * roughness, 2e-3f);
        }
    }
    vtDestroyScene(&scene);
    vtDestroyLighting(&lighting);
    vtDestroyEnvironment(&environment);
}

static void aMirrorShowsTheEnvironment(void** state)
{
    (void)state;
    const vtEnvironment environment = builtIn("studio");
    vtLighting lighting = lightingOf(&environment);
    vtMaterial material = opaque(1.0f, 0.0f);
    material.baseColor = (vtVec3){1.0f, 1.0f, 1.0f};
    vtScene scene = squareScene(&material, NULL);
    for (uint32_t i = 0; i < 200; ++i) {
        vtVec3 I = onSphere(i);
        const vtVec3 seen = vtEnvironment_Sample(&environment, (vtVec3){I.x, I.y, -I.z});
        assert_true(difference(shade(&scene, &lighting, 0, 0.2f, 0.3f, I), seen) <
                    1e-3f * (1.0f + vtLength(seen)));
    }
    vtDestroyScene(&scene);
    vtDestroyLighting(&lighting);
}

static void checkerImageAndColorsMultiply(void** state)
{
    (void)state;
    vtEnvironment environment = imageEnvironment(8, 4, false);
    vtLighting lighting = lightingOf(&environment);
    vtMaterial material = opaque(1.0f, 1.0f); // white light gives 0.45 of the base colour
    material.baseColor = (vtVec3){1.0f, 1.0f, 1.0f};
    const float colors[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    vtScene scene = squareScene(&material, colors);
    vtVec3 light = shade(&scene, &lighting, 0, 0.25f, 0.25f, towardsBack);
    assert_true(difference(light, (vtVec3){0.5f * 0.4544f, 0.25f * 0.4544f, 0.25f * 0.4544f}) < 6e-3f);
    vtDestroyScene(&scene);

    // The point (0.25, 0.75) of the picture, then (0.75, 0.25 + 0.5).
    scene = squareScene(&material, NULL);
    scene.materials[0].checker = 2.0f;
    const float light1 = shade(&scene, &lighting, 0, 0.0f, 0.25f, towardsBack).x; // squares (0, 1)
    const float light2 = shade(&scene, &lighting, 0, 0.5f, 0.25f, towardsBack).x; // squares (1, 1)
    assert_near(light1, 0.15f * light2, 6e-3f);
    assert_near(light2, 0.45f, 3e-3f);
    scene.materials[0].checker = 0.0f;

    // Two texels a side: their centres give the bytes, the middle their linear mean.
    scene.images = calloc(2, sizeof *scene.images);
    scene.imageCount = 2;
    scene.materials[0].maps[vt_mapBaseColor].image = 0;
    static const uint8_t picture[16] = {255, 255, 255, 255, 0,   0,   0,   255,
                                        188, 188, 188, 255, 188, 188, 188, 255};
    scene.images[0] = (vtImage){.pixels = malloc(16), .width = 2, .height = 2};
    memcpy(scene.images[0].pixels, picture, 16);
    // Triangle 1 has texture coordinates (0, 1), (1, 0), (0, 0).
    assert_near(shade(&scene, &lighting, 1, 0.25f, 0.5f, towardsBack).x, 0.45f, 3e-3f); // upper left centre
    assert_near(shade(&scene, &lighting, 1, 0.75f, 0.0f, towardsBack).x, 0.0f, 3e-3f);  // upper right centre
    assert_near(shade(&scene, &lighting, 1, 0.5f, 0.25f, towardsBack).x, 0.45f * 0.5f, 3e-3f);
    assert_near(shade(&scene, &lighting, 1, 0.25f, 0.0f, towardsBack).x, 0.45f * 0.5029f,
                3e-3f); // lower left

    // Green is roughness, blue metallic, both as they are.
    scene.materials[0].maps[vt_mapBaseColor].image = -1;
    scene.materials[0].maps[vt_mapMetallicRoughness].image = 1;
    scene.images[1] = (vtImage){.pixels = malloc(4), .width = 1, .height = 1};
    memcpy(scene.images[1].pixels, (const uint8_t[]){0, 51, 255, 255}, 4);
    assert_near(shade(&scene, &lighting, 0, 0.2f, 0.2f, towardsBack).x, 1.0f - 0.55f * 0.2f, 3e-3f);
    // An image that is not decoded is white.
    free(scene.images[1].pixels);
    scene.images[1].pixels = NULL;
    assert_near(shade(&scene, &lighting, 0, 0.2f, 0.2f, towardsBack).x, 0.45f, 3e-3f);
    vtDestroyScene(&scene);
    vtDestroyLighting(&lighting);
    vtDestroyEnvironment(&environment);
}

// ------------------------------------------------------------------------------------------------- the GPU

enum { objects = 6 };

/// A square, four toruses and a sphere of all that materials can be, placed every way.
static vtScene manyObjects(int imageSide)
{
    vtScene scene = {.meshes = calloc(3, sizeof(vtMesh)),
                     .materials = calloc(objects, sizeof(vtMaterial)),
                     .images = calloc(3, sizeof(vtImage)),
                     .objects = calloc(objects, sizeof(vtObject)),
                     .meshCount = 3,
                     .materialCount = objects,
                     .imageCount = 3,
                     .objectCount = objects};
    vtError error;
    vtMaterial plain = opaque(0.0f, 1.0f);
    vtScene square = squareScene(&plain, NULL);
    scene.meshes[0] = square.meshes[0];
    square.meshes[0] = (vtMesh){0};
    vtDestroyScene(&square);
    assert_ok(vtCreateShape("torus", &scene.meshes[1], &error), error);
    assert_ok(vtCreateShape("sphere", &scene.meshes[2], &error), error);
    vtMesh* torus = &scene.meshes[1];
    torus->texcoords = malloc(2 * sizeof(float) * torus->vertexCount);
    torus->colors = malloc(3 * sizeof(float) * torus->vertexCount);
    for (uint32_t i = 0; i < torus->vertexCount; ++i) {
        const float* p = torus->positions + 3 * (size_t)i;
        torus->texcoords[2 * i] = 0.7f * p[0] + 0.2f * p[1];
        torus->texcoords[2 * i + 1] = 0.8f * p[2] - 0.3f * p[1];
        for (int k = 0; k < 3; ++k) {
            torus->colors[3 * i + (uint32_t)k] = 0.5f + 0.5f * sinf(3.0f * p[k]);
        }
    }
    for (int i = 0; i < 2; ++i) {
        vtImage* image = &scene.images[i];
        image->width = i == 0 ? 64 : imageSide;
        image->height = i == 0 ? 64 : imageSide / 2;
        image->height = imageSide == 64 ? 64 : image->height;
        const int count = image->width * image->height;
        image->pixels = malloc(4 * (size_t)count);
        for (int k = 0; k < count; ++k) {
            const float x = (float)(k % image->width) / (float)image->width;
            const float y = (float)(k / image->width) / (float)image->height;
            for (int c = 0; c < 4; ++c) {
                const float wave = sinf(6.2831853f * (x * (float)(c + 1) + y)) * sinf(6.2831853f * y);
                image->pixels[4 * k + c] = (uint8_t)(127.5f + 120.0f * wave);
            }
        }
    }
    scene.images[2] = (vtImage){.width = 512, .height = 512}; // not decoded
    for (int i = 0; i < objects; ++i) {
        vtMaterial* material = &scene.materials[i];
        *material = opaque(unit(40u + (uint32_t)i), unit(50u + (uint32_t)i));
        material->baseColor = (vtVec3){0.9f, 0.6f + 0.05f * (float)i, 0.5f};
        vtObject* object = &scene.objects[i];
        *object = (vtObject){.mesh = i == 0 ? 0u : i == 5 ? 2u : 1u, .material = (uint32_t)i};
        const vtVec3 x = onSphere(60u + (uint32_t)i), y = onSphere(70u + (uint32_t)i),
                     z = onSphere(80u + (uint32_t)i);
        object->toWorld = (vtTransform){{{x.x, y.x, z.x, 1}, {x.y, y.y, z.y, 2}, {x.z, y.z, z.z, 3}}};
        for (int k = 0; k < 3; ++k) {
            object->toWorld.rows[k][k] += 1.7f;
            object->toWorld.rows[k][0] *= i % 2 == 0 ? -1.5f : 0.4f; // mirrored
        }
    }
    scene.materials[0].maps[vt_mapBaseColor].image = 0;
    scene.materials[1].maps[vt_mapBaseColor].image = 2;
    scene.materials[1].checker = 3.0f;
    scene.materials[2].maps[vt_mapMetallicRoughness].image = 1;
    scene.materials[2].metallic = scene.materials[2].roughness = 1.0f;
    scene.materials[3].maps[vt_mapBaseColor].image = 0;
    scene.materials[3].maps[vt_mapMetallicRoughness].image = 1;
    scene.materials[3].emissive = (vtVec3){0.1f, 0.0f, 0.3f};
    scene.materials[4].metallic = 1.0f;
    scene.materials[4].roughness = 0.0f;
    scene.materials[5].checker = 2.0f; // no texture coordinates
    return scene;
}

/// Runs `body`, which fills o_result, over all cases. `first`: a chunk before all others, or NULL.
static void evaluateAfter(Gpu* gpu, const vtChunk* first, const char* source, uint32_t* results)
{
    const vtChunk body = {"body", source};
    const vtChunk* const chunks[] = {first,
                                     &vtChunk_octahedral,
                                     &vtChunk_environment,
                                     &vtChunk_objects,
                                     &vtChunk_records,
                                     &vtChunk_lighting,
                                     &vtChunk_shading,
                                     &body};
    evaluateChunks(gpu, chunks, sizeof chunks / sizeof chunks[0], 1, results);
}

static void evaluate(Gpu* gpu, const char* source, uint32_t* results)
{
    evaluateAfter(gpu, NULL, source, results);
}

static const char shadeBody[] =
    "layout(location = 0) out uvec4 o_result;\n"
    "uniform usampler2D u_cases;\n"
    "uint hash(uint x) { x ^= x >> 16; x *= 0x7feb352du; x ^= x >> 15;\n"
    "  x *= 0x846ca68bu; x ^= x >> 16; return x; }\n"
    "float unit(uint x) { return float(hash(x) >> 8) / 16777216.0; }\n"
    "vec3 onSphere(uint x) { float z = 2.0 * unit(x) - 1.0; float a = 6.2831853 * unit(x + 77777u);\n"
    "  float r = sqrt(1.0 - z * z); return vec3(r * cos(a), z, r * sin(a)); }\n"
    "void main() { uint i = uint(gl_FragCoord.y) * 64u + uint(gl_FragCoord.x);\n"
    "  float v = unit(i + 1000u); float u = (1.0 - v) * unit(i + 20000u);\n"
    "  uvec4 c = texelFetch(u_cases, ivec2(gl_FragCoord.xy), 0);\n"
    "  vec3 light = shadeOpaque(int(c.x), opaqueSurface(int(c.x), RecordHit(0.0, c.z, vec2(u, v))), "
    "onSphere(i), 0.0);\n"
    "  o_result = uvec4(floatBitsToUint(light), 0u); }\n";

/// How many of the cases differ by more than 2/255, of white or of the light itself where that is brighter.
static int countDifferent(Gpu* gpu, const vtScene* scene, const vtPlacedObject* placed,
                          const vtLighting* lighting)
{
    static uint32_t results[4 * caseSide * caseSide], cases[caseSide * caseSide][4];
    uploadCases(gpu, placed, cases);
    evaluate(gpu, shadeBody, results);
    int different = 0;
    float sum = 0.0f;
    for (uint32_t i = 0; i < caseSide * caseSide; ++i) {
        const float v = unit(i + 1000u), u = (1.0f - v) * unit(i + 20000u);
        vtPlacedObject object = placed[i % objects];
        object.mesh = &gpu->leaves[object.meshIndex];
        const vtVec3 cpu = vtShadeSurface(scene, &object, lighting, cases[i][1], u, v, onSphere(i));
        float gpuLight[3];
        memcpy(gpuLight, results + 4 * (size_t)i, sizeof gpuLight);
        const float apart = difference(cpu, vtMakeVec3(gpuLight)) / fmaxf(1.0f, vtLength(cpu));
        different += !(apart < 2.0f / 255.0f);
        sum += fminf(apart, 1.0f);
    }
    print_message("%d of %d differ, mean %.6f\n", different, caseSide * caseSide,
                  (double)sum / (caseSide * caseSide));
    return different;
}

static void shadersAreTheSame(void** state)
{
    (void)state;
    Gpu gpu;
    vtError error;
    createGpu(&gpu);
    for (int k = 0; k < 2; ++k) {
        // Images of one size; then one of another, which the GPU has scaled up.
        vtScene scene = manyObjects(k == 0 ? 64 : 40);
        vtPlacedObject* placed;
        uint32_t glassCount;
        assert_ok(vtPlaceObjects(&scene, &placed, &glassCount, &error), error);
        uploadScene(&gpu, &scene);
        assert_int_equal(gpu.scene.images.texture.width, 64);
        assert_int_equal(gpu.scene.images.texture.layers, 2); // of three, one is not decoded
        assert_int_equal(vtTexture_Bytes(&gpu.scene.images.texture), 4 * 64 * 64 * 2 * 4 / 3);
        vtEnvironment environments[] = {builtIn("checker"), builtIn("studio"), builtIn("sky"),
                                        imageEnvironment(128, 64, true)};
        for (int i = 0; i < 4; ++i) {
            vtLighting lighting = lightingOf(&environments[i]);
            uploadEnvironment(&gpu, &environments[i], &lighting);
            // Where a mirror meets a cell's edge, or a checker's edge, rounding decides.
            assert_true(countDifferent(&gpu, &scene, placed, &lighting) <= caseSide * caseSide / 200);
            vtDestroyLighting(&lighting);
            vtDestroyEnvironment(&environments[i]);
        }
        assert_int_equal(vtTexture_Bytes(&gpu.lighting), 8 * 256 * 257);
        free(placed);
        vtDestroyScene(&scene);
    }
    destroyGpu(&gpu);
}

/// A pixel that covers all of the picture sees its mean.
static void farSurfacesShowTheMeanOfTheImage(void** state)
{
    (void)state;
    Gpu gpu;
    vtError error;
    createGpu(&gpu);
    vtScene scene = manyObjects(64);
    for (int i = 0; i < 64 * 64; ++i) { // a fine checker; its mean is half of white
        memset(scene.images[0].pixels + 4 * i, (i ^ i >> 6) & 1 ? 255 : 0, 4);
    }
    scene.materials[0] = opaque(1.0f, 1.0f);
    scene.materials[0].baseColor = (vtVec3){1.0f, 1.0f, 1.0f};
    scene.materials[0].maps[vt_mapBaseColor].image = 0;
    scene.objects[0].toWorld = vtIdentityTransform();
    scene.objects[0].toWorld.rows[0][0] =
        3.0f; // 64 texels on 6 by 2 units: a texel is 0.054 wide in the mean
    vtPlacedObject* placed;
    uint32_t glassCount;
    assert_ok(vtPlaceObjects(&scene, &placed, &glassCount, &error), error);
    int object = 0;
    while (placed[object].object != 0) {
        ++object;
    }
    uploadScene(&gpu, &scene);
    vtEnvironment environment = imageEnvironment(8, 4, false);
    vtLighting lighting = lightingOf(&environment);
    uploadEnvironment(&gpu, &environment, &lighting);
    static uint32_t results[4 * caseSide * caseSide];
    const uint32_t triangle = 2 * gpu.scene.geometry.items[0].records.first + pickTriangle(&gpu, 0, 0);
    const float footprints[] = {0.05f, 0.12f, 100.0f};
    for (int k = 0; k < 3; ++k) {
        char source[512];
        snprintf(source, sizeof source,
                 "layout(location = 0) out uvec4 o_result;\n"
                 "void main() { vec2 w = 0.5 * (floor(gl_FragCoord.xy) + 0.5) / 64.0;\n"
                 "  vec3 light = shadeOpaque(%d, opaqueSurface(%d, RecordHit(0.0, %uu, w)), vec3(0.0, 0.0, "
                 "-1.0), %f);\n"
                 "  o_result = uvec4(floatBitsToUint(light), 0u); }\n",
                 object, object, triangle, (double)footprints[k]);
        evaluate(&gpu, source, results);
        float least = 1.0f, most = 0.0f;
        for (int i = 0; i < caseSide * caseSide; ++i) {
            float light;
            memcpy(&light, results + 4 * i, sizeof light);
            least = fminf(least, light);
            most = fmaxf(most, light);
        }
        if (k == 0) { // a pixel is less than a texel: black and white
            assert_true(most - least > 0.2f);
        } else { // more than two: grey
            assert_near(least, 0.45f * 0.5f, 6e-3f);
            assert_near(most, 0.45f * 0.5f, 6e-3f);
        }
    }
    free(placed);
    vtDestroyScene(&scene);
    vtDestroyLighting(&lighting);
    vtDestroyEnvironment(&environment);
    destroyGpu(&gpu);
}

/// Half the difference between the normals on either side is what a step along the surface does to it.
static void normalsTurnAsTheyAreInterpolated(void** state)
{
    (void)state;
    Gpu gpu;
    vtError error;
    createGpu(&gpu);
    vtScene scene = manyObjects(64);
    vtPlacedObject* placed;
    uint32_t glassCount;
    assert_ok(vtPlaceObjects(&scene, &placed, &glassCount, &error), error);
    uploadScene(&gpu, &scene);
    vtEnvironment environment = builtIn("checker");
    vtLighting lighting = lightingOf(&environment);
    uploadEnvironment(&gpu, &environment, &lighting);
    static uint32_t results[4 * caseSide * caseSide], cases[caseSide * caseSide][4];
    uploadCases(&gpu, placed, cases);
    evaluateAfter(
        &gpu, &vtChunk_footprint,
        "layout(location = 0) out uvec4 o_result;\n"
        "uniform usampler2D u_cases;\n"
        "void main() { uvec4 c = texelFetch(u_cases, ivec2(gl_FragCoord.xy), 0);\n"
        "  Transform t = readTransform(int(c.x)); Corners k = recordCorners(c.z);\n"
        "  vec2 at = vec2(0.3, 0.25), step = vec2(0.004, -0.002);\n"
        "  vec3 A = uintBitsToFloat(k.a.xyz);\n"
        "  vec3 own = step.x * (uintBitsToFloat(k.b.xyz) - A) + step.y * (uintBitsToFloat(k.c.xyz) - A);\n"
        "  vec3 world = own * inverse(mat3(t.x.xyz, t.y.xyz, t.z.xyz));\n"
        "  vec3 change = 0.5 * (normalToWorld(t, cornersNormal(k, at + step)) - normalToWorld(t, "
        "cornersNormal(k, at - step)));\n"
        "  vec3 found = cornersTurn(t, k, at) * world;\n"
        "  o_result = uvec4(floatBitsToUint(length(found - change)), floatBitsToUint(length(change)), 0u, "
        "0u); }\n",
        results);
    int turning = 0;
    for (int i = 0; i < caseSide * caseSide; ++i) {
        float lengths[2];
        memcpy(lengths, results + 4 * (size_t)i, sizeof lengths);
        assert_true(lengths[0] < 0.02f * lengths[1] + 1e-5f);
        turning += lengths[1] > 2e-4f;
    }
    assert_true(turning > caseSide * caseSide / 10);
    free(placed);
    vtDestroyScene(&scene);
    vtDestroyLighting(&lighting);
    destroyGpu(&gpu);
}

static void noImagesMakeAWhiteTexel(void** state)
{
    (void)state;
    Gpu gpu;
    vtError error;
    createGpu(&gpu);
    const vtScene scene = {0};
    assert_ok(vtImageArray_Upload(&gpu.scene.images, &gpu.gl, &scene, &error), error);
    assert_int_equal(gpu.scene.images.texture.width, 1);
    assert_int_equal(gpu.scene.images.texture.layers, 1);
    destroyGpu(&gpu);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(irradianceIsTheCosineIntegral),
        cmocka_unit_test(roughLevelsAreTheGgxIntegral),
        cmocka_unit_test(aWhiteEnvironmentStaysWhite),
        cmocka_unit_test(roughnessBlendsFromTheEnvironmentOn),
        cmocka_unit_test(lightingIsQuick),
        cmocka_unit_test(whiteLightShowsTheBaseColor),
        cmocka_unit_test(aMirrorShowsTheEnvironment),
        cmocka_unit_test(checkerImageAndColorsMultiply),
        cmocka_unit_test(shadersAreTheSame),
        cmocka_unit_test(farSurfacesShowTheMeanOfTheImage),
        cmocka_unit_test(normalsTurnAsTheyAreInterpolated),
        cmocka_unit_test(noImagesMakeAWhiteTexel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
