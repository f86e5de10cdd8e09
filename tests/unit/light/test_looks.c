// Materials with all that glTF says of them: the shaders (looks.glsl) against their twins in C (look.c), and
// these against values worked out by hand.
#include "light/look.h"
#include "shading_cases.h"

enum { objects = 16, meshes = 3, images = 3, lights = 5, fields = 8 };

static float between(uint32_t number, float least, float most)
{
    return least + (most - least) * unit(number);
}

static vtVec3 color(uint32_t number, float most)
{
    return (vtVec3){most * unit(number), most * unit(number + 1000u), most * unit(number + 2000u)};
}

static bool chance(uint32_t number, float share)
{
    return unit(number) < share;
}

/// A picture of slow waves, so that the few bits with which a GPU blends do not matter; blue is large, as
/// normal maps have it.
static vtImage waves(int side, uint32_t number)
{
    vtImage image = {.pixels = malloc(4 * (size_t)side * (size_t)side), .width = side, .height = side};
    for (int i = 0; i < side * side; ++i) {
        const float x = (float)(i % side) / (float)side, y = (float)(i / side) / (float)side;
        for (int c = 0; c < 4; ++c) {
            const float turn = 6.2831853f * ((float)(1 + (c + (int)number) % 2) * x + (float)(c % 2) * y);
            const float wave = sinf(turn + (float)number);
            image.pixels[4 * i + c] = (uint8_t)(c == 2 ? 200.0f + 50.0f * wave : 127.5f + 120.0f * wave);
        }
    }
    return image;
}

static vtMaterial randomMaterial(uint32_t n)
{
    static const float indices[] = {0.0f, 1.0f, 1.33f, 1.5f, 2.4f};
    vtMaterial m = vtDefaultMaterial();
    m.opaque = chance(n + 1, 0.4f);
    m.thin = !m.opaque && chance(n + 2, 0.5f);
    m.unlit = m.opaque && chance(n + 3, 0.15f);
    m.ior = indices[hash(n + 4) % 5];
    m.tint = color(n + 5, 1.0f);
    m.baseColor = color(n + 6, 1.0f);
    m.transmission = chance(n + 7, 0.5f) ? 1.0f : unit(n + 8);
    m.metallic = chance(n + 9, 0.3f) ? 0.0f : unit(n + 10);
    m.roughness = unit(n + 11);
    m.emissive = chance(n + 12, 0.5f) ? color(n + 13, 0.5f) : (vtVec3){0.0f, 0.0f, 0.0f};
    m.checker = chance(n + 14, 0.2f) ? 3.0f : 0.0f;
    m.alphaMode = (vtAlpha)(hash(n + 15) % 3);
    m.alpha = between(n + 16, 0.5f, 1.0f);
    m.alphaCutoff = chance(n + 17, 0.2f) ? 0.0f : unit(n + 18);
    m.specular = chance(n + 19, 0.5f) ? 1.0f : unit(n + 20);
    m.specularColor = chance(n + 21, 0.5f) ? (vtVec3){1.0f, 1.0f, 1.0f} : color(n + 22, 3.0f);
    m.iridescence = chance(n + 23, 0.5f) ? unit(n + 24) : 0.0f;
    m.iridescenceIor = between(n + 25, 1.0f, 2.0f);
    m.iridescenceMin = chance(n + 26, 0.3f) ? 0.0f : between(n + 27, 0.0f, 300.0f);
    m.iridescenceMax = between(n + 28, 100.0f, 600.0f);
    m.normalScale = between(n + 29, -1.5f, 1.5f);
    m.occlusionStrength = unit(n + 30);
    for (uint32_t use = 0; use < vt_mapCount; ++use) {
        const uint32_t k = n + 100 + 20 * use;
        vtMap* map = &m.maps[use];
        map->image = chance(k, 0.6f) ? (int)(hash(k + 1) % images) : -1;
        map->texcoords = (int)(hash(k + 2) % 2);
        map->wrapX = (vtWrap)(hash(k + 3) % 3);
        map->wrapY = (vtWrap)(hash(k + 4) % 3);
        map->nearest = chance(k + 5, 0.3f);
        for (uint32_t i = 0; i < 6 && chance(k + 6, 0.6f); ++i) {
            map->rows[i / 3][i % 3] = between(k + 7 + i, -1.5f, 1.5f);
        }
    }
    return m;
}

/// Both sets of texture coordinates, colours, alphas and tangents.
static void dress(vtMesh* mesh)
{
    vtError error;
    mesh->texcoords = malloc(2 * sizeof(float) * mesh->vertexCount);
    mesh->texcoords1 = malloc(2 * sizeof(float) * mesh->vertexCount);
    mesh->colors = malloc(3 * sizeof(float) * mesh->vertexCount);
    mesh->alphas = malloc(sizeof(float) * mesh->vertexCount);
    for (uint32_t i = 0; i < mesh->vertexCount; ++i) {
        const float* p = mesh->positions + 3 * (size_t)i;
        mesh->texcoords[2 * i] = 0.7f * p[0] + 0.2f * p[1];
        mesh->texcoords[2 * i + 1] = 0.8f * p[2] - 0.3f * p[1];
        mesh->texcoords1[2 * i] = 0.5f * p[1] - 0.6f * p[2];
        mesh->texcoords1[2 * i + 1] = 0.9f * p[0];
        for (int k = 0; k < 3; ++k) {
            mesh->colors[3 * i + (uint32_t)k] = 0.5f + 0.5f * sinf(3.0f * p[k]);
        }
        mesh->alphas[i] = 0.7f + 0.3f * sinf(2.0f * p[0] + p[2]);
    }
    assert_ok(vtComputeTangents(mesh, 0, &error), error);
}

static vtScene manyLooks(uint32_t number)
{
    vtScene scene = {.meshes = calloc(meshes, sizeof(vtMesh)),
                     .materials = calloc(objects, sizeof(vtMaterial)),
                     .images = calloc(images, sizeof(vtImage)),
                     .objects = calloc(objects, sizeof(vtObject)),
                     .lights = calloc(lights, sizeof(vtLight)),
                     .meshCount = meshes,
                     .materialCount = objects,
                     .imageCount = images,
                     .objectCount = objects,
                     .lightCount = lights};
    static const char* const shapes[meshes] = {"torus", "sphere", "cube"};
    vtError error;
    for (int i = 0; i < meshes; ++i) {
        assert_ok(vtCreateShape(shapes[i], &scene.meshes[i], &error), error);
    }
    dress(&scene.meshes[0]);
    for (uint32_t i = 0; i < images; ++i) {
        scene.images[i] = waves(64, number + i);
    }
    for (uint32_t i = 0; i < objects; ++i) {
        const uint32_t n = 10000u * (number + 1) + 1000u * i;
        scene.materials[i] = randomMaterial(n);
        vtObject* object = &scene.objects[i];
        *object = (vtObject){.mesh = i % 4 == 3 ? 1u + i / 4 % 2 : 0u, .material = i};
        const vtVec3 x = onSphere(n + 900), y = onSphere(n + 901), z = onSphere(n + 902);
        object->toWorld = (vtTransform){{{x.x, y.x, z.x, 1}, {x.y, y.y, z.y, 2}, {x.z, y.z, z.z, 3}}};
        for (int k = 0; k < 3; ++k) {
            object->toWorld.rows[k][k] += 1.7f;
            object->toWorld.rows[k][0] *= i % 2 == 0 ? -1.5f : 0.4f; // mirrored
        }
    }
    for (uint32_t i = 0; i < lights; ++i) {
        scene.lights[i] =
            (vtLight){.kind = (vtLightKind)(i % 3),
                      .position = vtMulAdd((vtVec3){1.0f, 2.0f, 3.0f}, 6.0f, onSphere(number + i)),
                      .direction = onSphere(number + 50 + i),
                      .color = color(number + 100 + i, i % 3 == 2 ? 1.0f : 30.0f),
                      .range = i < 3 ? 0.0f : 9.0f,
                      .innerCone = 0.3f,
                      .outerCone = 1.2f};
        if (i % 3 == 1) { // the spot shines on the scene
            scene.lights[i].direction =
                vtNormalize(vtSub((vtVec3){1.0f, 2.0f, 3.0f}, scene.lights[i].position));
        }
    }
    return scene;
}

/// What the shader says of each case: fields of four numbers, one block of rows each.
static const char body[] =
    "layout(location = 0) out uvec4 o_result;\n"
    "uniform usampler2D u_cases;\n"
    "uint hash(uint x) { x ^= x >> 16; x *= 0x7feb352du; x ^= x >> 15;\n"
    "  x *= 0x846ca68bu; x ^= x >> 16; return x; }\n"
    "float unit(uint x) { return float(hash(x) >> 8) / 16777216.0; }\n"
    "vec3 onSphere(uint x) { float z = 2.0 * unit(x) - 1.0; float a = 6.2831853 * unit(x + 77777u);\n"
    "  float r = sqrt(1.0 - z * z); return vec3(r * cos(a), z, r * sin(a)); }\n"
    "void main() { uint y = uint(gl_FragCoord.y), i = y % 64u * 64u + uint(gl_FragCoord.x), field = y / "
    "64u;\n"
    "  float v = unit(i + 1000u); float u = (1.0 - v) * unit(i + 20000u); vec2 at = vec2(u, v);\n"
    "  vec3 I = onSphere(i);\n"
    "  uvec4 c = texelFetch(u_cases, ivec2(int(gl_FragCoord.x), int(y % 64u)), 0);\n"
    "  Transform t = readTransform(int(c.x)); Corners k = recordCorners(c.z);\n"
    "  vec3 own = (1.0 - u - v) * uintBitsToFloat(k.a.xyz) + u * uintBitsToFloat(k.b.xyz) + v * "
    "uintBitsToFloat(k.c.xyz);\n"
    "  vec3 position = (own - vec3(t.x.w, t.y.w, t.z.w)) * inverse(mat3(t.x.xyz, t.y.xyz, t.z.xyz));\n"
    "  SurfaceHit hit = recordSurface(int(c.x), t, RecordHit(0.0, c.z, at), position);\n"
    "  Look look = lookAt(Meeting(0.0, c.z, at, int(c.x), -1), hit, 0.0);\n"
    "  float side = dot(look.G, I) > 0.0 ? -1.0 : 1.0; vec3 N = side * look.G; // bent ones differ by their "
    "few bits\n"
    "  float ior = max(look.ior, 1.0), f = (ior - 1.0) / (ior + 1.0), cosine = -dot(N, I);\n"
    "  vec4 result = field == 0u ? vec4(look.N, look.base.a) : field == 1u ? vec4(look.base.rgb, "
    "look.passes)\n"
    "    : field == 2u ? vec4(look.emissive, look.metallic) : field == 3u ? vec4(look.specularColor, "
    "look.specular)\n"
    "    : field == 4u ? vec4(look.film.x, look.film.y, look.film.z / 1000.0, look.roughness) : field == 5u "
    "? vec4(look.G, look.occlusion)\n"
    "    : field == 6u ? vec4(sentLight(look, N, I, Start(position, I, AIR, -1, VT_NO_TRIANGLE, false, "
    "false, false), at), look.ior)\n"
    "    : vec4(lookReflectance(look, cosine, fresnel(cosine, 1.0 / ior), ior, (i & 1u) != 0u), "
    "float(look.flags & 7u));\n"
    "  o_result = floatBitsToUint(result); }\n";

typedef float Fields[fields][4];

/// The same on the CPU.
static void fieldsOf(const vtScene* scene, const vtPlacedObject* object, uint32_t triangle, uint32_t i,
                     const vtIllumination* illumination, float exposure, Fields out)
{
    const float v = unit(i + 1000u), u = (1.0f - v) * unit(i + 20000u);
    const vtVec3 I = onSphere(i);
    vtVec3 p[3];
    vtMesh_Corners(object->mesh, triangle, p);
    const vtVec3 position = vtTransformPoint(&object->toWorld, vtBlend(p, u, v));
    const vtLook look = vtLookAt(scene, object, triangle, u, v, vtMaterial_Index(object->material), -1.0f);
    const float side = vtDot(look.G, I) > 0.0f ? -1.0f : 1.0f;
    const vtVec3 N = vtScale(look.G, side);
    const float ior = fmaxf(look.ior, 1.0f), cosine = -vtDot(N, I);
    const vtVec3 sent = vtLook_SentLight(&look, illumination, NULL, N, I, position, exposure);
    const vtVec3 F = vtLook_Reflectance(&look, cosine, vtFresnel(cosine, 1.0f / ior), ior, (i & 1) != 0);
    const float flags = (float)((look.thin ? VT_LOOK_THIN : 0u) | (look.unlit ? VT_LOOK_UNLIT : 0u) |
                                (look.mirror ? VT_LOOK_MIRROR : 0u));
    const Fields found = {
        {look.N.x, look.N.y, look.N.z, look.coverage},
        {look.base.x, look.base.y, look.base.z, look.passes},
        {look.emissive.x, look.emissive.y, look.emissive.z, look.metallic},
        {look.specularColor.x, look.specularColor.y, look.specularColor.z, look.specular},
        {look.film, look.filmIor, look.filmThickness / 1000.0f, look.roughness},
        {look.G.x, look.G.y, look.G.z, look.occlusion},
        {sent.x, sent.y, sent.z, look.ior},
        {F.x, F.y, F.z, flags},
    };
    memcpy(out, found, sizeof found);
}

static void shadersAreTheSame(void** state)
{
    (void)state;
    static const char* const names[fields] = {
        "normal, coverage", "base, passes",           "emissive, metallic",        "specular",
        "film, roughness",  "flat normal, occlusion", "light that is sent, index", "reflectance, flags"};
    static uint32_t results[fields][caseSide * caseSide][4], cases[caseSide * caseSide][4];
    const vtChunk last = {"body", body};
    const vtChunk* const chunks[] = {&vtChunk_with_looks,  &vtChunk_with_opaque,
                                     &vtChunk_octahedral,  &vtChunk_media,
                                     &vtChunk_environment, &vtChunk_objects,
                                     &vtChunk_optics,      &vtChunk_records,
                                     &vtChunk_object_tree, &vtChunk_search_scene,
                                     &vtChunk_lighting,    &vtChunk_shading,
                                     &vtChunk_looks,       &last};
    Gpu gpu;
    vtError error;
    createGpu(&gpu);
    for (uint32_t round = 0; round < 4; ++round) {
        vtScene scene = manyLooks(round);
        vtPlacedObject* placed;
        uint32_t glassCount;
        assert_ok(vtPlaceObjects(&scene, &placed, &glassCount, &error), error);
        gpu.exposure = round == 0 ? 1.0f : 0.5f;
        uploadScene(&gpu, &scene);
        assert_true(gpu.scene.hasLooks);
        vtEnvironment environment = builtIn(round % 2 == 0 ? "sky" : "studio");
        vtLighting lighting = lightingOf(&environment);
        uploadEnvironment(&gpu, &environment, &lighting);
        uploadCases(&gpu, placed, cases);
        evaluateChunks(&gpu, chunks, sizeof chunks / sizeof chunks[0], fields, &results[0][0][0]);
        const vtIllumination illumination = {&lighting, scene.lights, scene.lightCount, NULL};
        int different[fields] = {0};
        for (uint32_t i = 0; i < caseSide * caseSide; ++i) {
            vtPlacedObject object = placed[i % objects];
            object.mesh = &gpu.leaves[object.meshIndex];
            Fields wanted;
            fieldsOf(&scene, &object, cases[i][1], i, &illumination, gpu.exposure, wanted);
            for (int field = 0; field < fields; ++field) {
                float found[4], apart = 0.0f;
                memcpy(found, results[field][i], sizeof found);
                for (int k = 0; k < 4; ++k) {
                    apart = fmaxf(apart,
                                  fabsf(found[k] - wanted[field][k]) / fmaxf(1.0f, fabsf(wanted[field][k])));
                }
                // Numbers are kept as sRGB in 8 bits, normals are twice as long as them, and stretched.
                different[field] += !(apart < (field == 0 ? 6.0f : 2.5f) / 255.0f);
            }
        }
        for (int field = 0; field < fields; ++field) {
            print_message("round %u, %s: %d of %d differ\n", round, names[field], different[field],
                          caseSide * caseSide);
        }
        for (int field = 0; field < fields;
             ++field) { // at the edge of a texel, a square or a mask rounding decides
            assert_true(different[field] <= caseSide * caseSide / 200);
        }
        free(placed);
        vtDestroyScene(&scene);
        vtDestroyLighting(&lighting);
    }
    destroyGpu(&gpu);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shadersAreTheSame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
