// The shaders' functions against their twins in C, on the same inputs.
#include "base/math.h"
#include "base/optics.h"
#include "cases.h"
#include "context/context.h"
#include "gl/program.h"
#include "gl/target.h"
#include "scene/media.h"
#include "shaders.h"
#include "shaders_es3/common/constants.h"
#include "testing.h"

enum { size = 64 }; // size * size cases

typedef struct Fixture {
    vtContext context;
    vtGL gl;
    GLuint vertexArray;
} Fixture;

static int setUp(void** state)
{
    Fixture* fixture = calloc(1, sizeof *fixture);
    vtError error;
    assert_ok(vtCreateContext(vt_backendAuto, &fixture->context, &error), error);
    assert_ok(vtLoadGL(fixture->context.getProcAddress, &fixture->gl, &error), error);
    fixture->gl.GenVertexArrays(1, &fixture->vertexArray);
    *state = fixture;
    return 0;
}

static int tearDown(void** state)
{
    Fixture* fixture = *state;
    fixture->gl.DeleteVertexArrays(1, &fixture->vertexArray);
    vtDestroyContext(&fixture->context);
    free(fixture);
    return 0;
}

// Cases are made from the pixel by the same arithmetic on both sides: a hash, then points on the sphere.
static const vtChunk cases = {
    "cases", "uint hash(uint x) { x ^= x >> 16; x *= 0x7feb352du; x ^= x >> 15;"
             "  x *= 0x846ca68bu; x ^= x >> 16; return x; }\n"
             "float unit(uint x) { return float(hash(x) >> 8) / 16777216.0; }\n"
             "vec3 onSphere(uint x) { float z = 2.0 * unit(x) - 1.0;\n"
             "  float a = 6.2831853 * unit(x + 77777u);\n"
             "  float r = sqrt(1.0 - z * z); return vec3(r * cos(a), z, r * sin(a)); }\n"
             "uint caseIndex() { return uint(gl_FragCoord.y) * 64u + uint(gl_FragCoord.x); }\n"};

/// Runs a fragment shader over size x size cases and reads its uvec4 back.
static void evaluate(Fixture* fixture, const vtChunk* const* chunks, uint32_t* results)
{
    const vtGL* gl = &fixture->gl;
    vtError error;
    vtProgramDef def = {.name = "test", .vertex = {&vtChunk_screen_vert}};
    def.fragment[0] = &cases;
    for (int i = 0; chunks[i] != NULL; ++i) {
        def.fragment[i + 1] = chunks[i];
    }
    GLuint framebuffer = 0;
    vtProgram program = {0};
    vtTexture target = {0};
    vtTexture_Resize(&target, gl, GL_RGBA32UI, size, size, 0);
    vtAttachment color = {&target, 0};
    vtProgram_Start(&program, gl, &def);
    assert_ok(vtProgram_Finish(&program, gl, &error), error);
    assert_ok(vtMakeFramebuffer(gl, "test", &color, 1, NULL, &framebuffer, &error), error);
    vtBindFramebuffer(gl, framebuffer, size, size);
    gl->UseProgram(program.name);
    gl->BindVertexArray(fixture->vertexArray);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->ReadPixels(0, 0, size, size, GL_RGBA_INTEGER, GL_UNSIGNED_INT, results);
    assert_ok(vtCheckGL(gl, "evaluating", &error), error);
    vtProgram_Destroy(&program, gl);
    vtDestroyFramebuffers(gl, &framebuffer, 1);
    vtTexture_Destroy(&target, gl);
}

static void opticsAreTheSame(void** state)
{
    static const vtChunk body = {
        "body", "layout(location = 0) out uvec4 o_result;\n"
                "void main() { uint i = caseIndex();\n"
                "  vec3 I = onSphere(i); vec3 G = onSphere(i + 10000u);\n"
                "  vec3 N = normalize(G + 0.6 * onSphere(i + 20000u));\n"
                "  bool inside = (i & 1u) == 1u; bool reflected;\n"
                "  if ((dot(I, G) > 0.0) != inside) I = -I;\n"
                "  float ior = 1.0 + 1.5 * unit(i + 30000u);\n"
                "  if (inside) { N = -N; G = -G; }\n"
                "  vec3 T = meetInterface(I, N, G, inside ? ior : 1.0 / ior, reflected);\n"
                "  inside = inside == reflected;\n"
                "  o_result = uvec4(floatBitsToUint(T), (inside ? 1u : 0u) + (reflected ? 2u : 0u)); }\n"};
    static uint32_t results[4 * size * size];
    evaluate(*state, (const vtChunk* const[]){&vtChunk_optics, &body, NULL}, results);

    int different = 0, reflections = 0;
    for (uint32_t i = 0; i < size * size; ++i) {
        vtVec3 I = onSphere(i), G = onSphere(i + 10000u);
        vtVec3 N = vtNormalize(vtMulAdd(G, 0.6f, onSphere(i + 20000u)));
        bool inside = (i & 1u) == 1u, reflected;
        if ((vtDot(I, G) > 0.0f) != inside) {
            I = vtScale(I, -1.0f);
        }
        vtVec3 T = vtMeetSurface(I, N, G, 1.0f + 1.5f * unit(i + 30000u), &inside, &reflected);
        float gpu[3];
        memcpy(gpu, results + 4 * i, sizeof gpu);
        bool same = vtLength(vtSub(T, vtMakeVec3(gpu))) < 2e-3f &&
                    results[4 * i + 3] == (uint32_t)inside + 2u * (uint32_t)reflected;
        different += !same;
        reflections += reflected;
        assert_near(vtLength(vtMakeVec3(gpu)), 1.0f, 1e-5);
    }
    // At the critical angle and where the triangle's normal takes over, rounding may decide either way.
    assert_true(different <= size * size / 1000);
    assert_true(reflections > 100);
}

static void fresnelIsTheSame(void** state)
{
    static const vtChunk body = {
        "body",
        "layout(location = 0) out uvec4 o_result;\n"
        "void main() { uint i = caseIndex(); float eta = 0.4 + 2.1 * unit(i + 7u);\n"
        "  o_result = floatBitsToUint(vec4(fresnel(unit(i), eta), fresnel(1.0, eta), 0.0, 0.0)); }\n"};
    static uint32_t results[4 * size * size];
    evaluate(*state, (const vtChunk* const[]){&vtChunk_optics, &body, NULL}, results);
    int different = 0;
    for (uint32_t i = 0; i < size * size; ++i) {
        float gpu[2];
        memcpy(gpu, results + 4 * i, sizeof gpu);
        const float eta = 0.4f + 2.1f * unit(i + 7u), once = (eta - 1.0f) / (eta + 1.0f);
        different += fabsf(gpu[0] - vtFresnel(unit(i), eta)) > 1e-3f; // steep near the critical angle
        assert_near(gpu[1], once * once, 1e-5);
    }
    assert_true(different <= size * size / 1000);
}

static void mediaAreTheSame(void** state)
{
    static const vtChunk body = {
        "body", "layout(location = 0) out uvec4 o_result;\n"
                "void main() { uint i = caseIndex(); uvec4 m = uvec4(0u);\n"
                "  for (uint k = 0u; k < 12u; ++k) { m = toggle(m, 1u + uint(5.0 * unit(16u * i + k))); }\n"
                "  o_result = m + (topOf(m) << 8u) + (holds(m, 3u) ? 65536u : 0u); }\n"};
    static uint32_t results[4 * size * size];
    evaluate(*state, (const vtChunk* const[]){&vtChunk_media, &body, NULL}, results);
    for (uint32_t i = 0; i < size * size; ++i) {
        vtMedia media = {{0}};
        for (uint32_t k = 0; k < 12; ++k) {
            vtMedia_Toggle(&media, 1u + (uint32_t)(5.0f * unit(16 * i + k)));
        }
        const uint32_t rest = (vtMedia_Top(&media) << 8) + (vtMedia_Holds(&media, 3) ? 65536u : 0u);
        for (int k = 0; k < 4; ++k) {
            assert_int_equal(results[4 * i + (uint32_t)k], media.ids[k] + rest);
        }
    }
}

static void transparencyIsTheSame(void** state)
{
    static const vtChunk body = {
        "body", "layout(location = 0) out uvec4 o_result;\n"
                "void main() { uint i = caseIndex(); vec3 N = onSphere(i); N.z = -abs(N.z);\n"
                "  vec2 shift; float path = wallPath(N, 1.0 + unit(i + 5u), shift);\n"
                "  float t = nonlinearTransmittance(-N.z, 0.9, 0.2, 1.0 + 4.0 * unit(i + 9u));\n"
                "  o_result = floatBitsToUint(vec4(path, shift, t)); }\n"};
    static uint32_t results[4 * size * size];
    evaluate(*state, (const vtChunk* const[]){&vtChunk_transparency, &body, NULL}, results);
    for (uint32_t i = 0; i < size * size; ++i) {
        vtVec3 N = onSphere(i);
        N.z = -fabsf(N.z);
        float shift[2], gpu[4];
        float path = vtWallPath(N, 1.0f + unit(i + 5u), shift);
        float t = vtNonlinearTransmittance(-N.z, 0.9f, 0.2f, 1.0f + 4.0f * unit(i + 9u));
        memcpy(gpu, results + 4 * i, sizeof gpu);
        assert_near(gpu[0], path, 1e-3f * path);
        assert_near(gpu[1], shift[0], 1e-3f * path);
        assert_near(gpu[2], shift[1], 1e-3f * path);
        assert_near(gpu[3], t, 1e-4f);
    }
}

static void packedNormalsComeBack(void** state)
{
    static const vtChunk body = {"body",
                                 "layout(location = 0) out uvec4 o_result;\n"
                                 "void main() { vec3 n = onSphere(caseIndex());\n"
                                 "  if (caseIndex() < 6u) { n = vec3(0.0);\n"
                                 "    n[int(caseIndex()) / 2] = caseIndex() % 2u == 0u ? 1.0 : -1.0; }\n"
                                 "  uint bits = packNormal(n);\n"
                                 "  vec3 c = cross(n, unpackNormal(bits));\n"
                                 "  o_result = uvec4(floatBitsToUint(length(c)), bits,\n"
                                 "    dot(n, unpackNormal(bits)) > 0.0 ? 1u : 0u, 0u); }\n"};
    static uint32_t results[4 * size * size];
    evaluate(*state, (const vtChunk* const[]){&vtChunk_octahedral, &body, NULL}, results);
    for (int i = 0; i < size * size; ++i) {
        float sine;
        memcpy(&sine, results + 4 * i, sizeof sine);
        assert_true(sine < 7e-5f); // 0.004 degrees
        assert_int_equal(results[4 * i + 2], 1);
        assert_true(results[4 * i + 1] != VT_NO_NORMAL);
    }
}

static void builtInEnvironmentsAreTheSame(void** state)
{
    static uint32_t results[4 * size * size];
    for (int kind = 0; vtEnvironmentName(kind) != NULL; ++kind) {
        char source[400];
        snprintf(source, sizeof source,
                 "uniform sampler2D u_image;\nlayout(location = 0) out uvec4 o_result;\n"
                 "void main() { vec3 d = onSphere(caseIndex());\n"
                 "  o_result = uvec4(floatBitsToUint(environmentRadiance(%d, u_image, d, 0.0)), 0u); }\n",
                 kind);
        vtChunk body = {"body", source};
        evaluate(*state, (const vtChunk* const[]){&vtChunk_environment, &body, NULL}, results);
        vtEnvironment environment;
        vtError error;
        assert_ok(vtCreateEnvironment(vtEnvironmentName(kind), &environment, &error), error);
        assert_int_equal(environment.kind, kind);
        int different = 0;
        for (uint32_t i = 0; i < size * size; ++i) {
            float gpu[3];
            memcpy(gpu, results + 4 * i, sizeof gpu);
            vtVec3 cpu = vtEnvironment_Sample(&environment, onSphere(i));
            different += vtLength(vtSub(cpu, vtMakeVec3(gpu))) > 2e-3f * (1.0f + vtLength(cpu));
        }
        assert_true(different <= 12); // cells' edges, where rounding decides
    }
}

/// A step of the ray and of the normal, and what it does to the ray behind the surface: half a difference.
static void footprintsAreDerivatives(void** state)
{
    static uint32_t results[4 * size * size];
    const vtChunk body = {
        "body", "layout(location = 0) out uvec4 o_result;\n"
                "vec3 bent(vec3 I, vec3 N, float eta, out bool reflected) {\n"
                "  return bend(normalize(I), normalize(N), eta, reflected); }\n"
                "void main() { uint i = caseIndex(); vec3 I = onSphere(i), N = onSphere(i + 90000u);\n"
                "  N = dot(N, I) < 0.0 ? N : -N;\n"
                "  float eta = i % 2u == 0u ? 1.0 / 1.5 : 1.5, h = 1e-3;\n"
                "  vec3 dI = onSphere(i + 40000u), dN = onSphere(i + 60000u);\n"
                "  dI -= dot(dI, I) * I; dN -= dot(dN, N) * N;\n"
                "  bool reflected, r0, r1;\n"
                "  bend(I, N, eta, reflected);\n"
                "  vec3 change = (bent(I + h * dI, N + h * dN, eta, r1) - bent(I - h * dI, N - h * dN, eta, "
                "r0)) / (2.0 * h);\n"
                "  vec3 found = bendFootprint(mat2x3(dI, dI), I, N, mat2x3(dN, dN), eta, reflected)[1];\n"
                "  vec3 place = alongSurface(mat2x3(dI, dN), I, N)[0];\n"
                "  float c = dot(N, I), k = 1.0 - eta * eta * (1.0 - c * c);\n"
                "  bool counts = r0 == r1 && r0 == reflected && abs(k) > 0.05 && c < -0.1;\n"
                "  o_result = uvec4(floatBitsToUint(length(found - change) / (1.0 + length(change))),\n"
                "    floatBitsToUint(abs(dot(place, N)) + length(cross(place - dI, I))), counts ? 1u : 0u, "
                "reflected ? 1u : 0u); }\n"};
    evaluate(*state, (const vtChunk* const[]){&vtChunk_optics, &vtChunk_footprint, &body, NULL}, results);
    int counted[2] = {0, 0};
    for (uint32_t i = 0; i < size * size; ++i) {
        float errors[2];
        memcpy(errors, results + 4 * (size_t)i, sizeof errors);
        if (results[4 * (size_t)i + 2] != 0) {
            assert_true(errors[0] < 0.01f);
            assert_true(errors[1] < 1e-3f); // on the surface, and moved along the ray
            ++counted[results[4 * (size_t)i + 3]];
        }
    }
    assert_true(counted[0] > size * size / 3 && counted[1] > size * size / 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(opticsAreTheSame),         cmocka_unit_test(fresnelIsTheSame),
        cmocka_unit_test(mediaAreTheSame),          cmocka_unit_test(transparencyIsTheSame),
        cmocka_unit_test(packedNormalsComeBack),    cmocka_unit_test(builtInEnvironmentsAreTheSame),
        cmocka_unit_test(footprintsAreDerivatives),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
