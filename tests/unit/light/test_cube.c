// Environments from six faces: each pixel tells the direction in which it is to be seen.
#include <math.h>

#include "cases.h"
#include "image/pfm.h"
#include "testing.h"

enum { side = 32 };

/// What is seen by who looks along `forward`: the picture's right and its top.
typedef struct Face {
    vtVec3 forward, right, up;
} Face;

static const Face front = {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}, back = {{0, 0, 1}, {-1, 0, 0}, {0, 1, 0}};
static const Face right = {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, left = {{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
static const Face above = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}}, below = {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}};
static const Face turned = {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}}; // back, upside down

/// The faces of a picture in rows; NULL where there is none.
typedef struct Picture {
    int across, down;
    const Face* faces[12];
} Picture;

static const Picture pictures[] = {
    {4, 3, {NULL, &above, NULL, NULL, &left, &front, &right, &back, NULL, &below}},
    {3, 4, {NULL, &above, NULL, &left, &front, &right, NULL, &below, NULL, NULL, &turned, NULL}},
    {6, 1, {&right, &left, &above, &below, &front, &back}},
    {1, 6, {&right, &left, &above, &below, &front, &back}},
};

static vtVec3 lookAt(const Face* face, float s, float t)
{
    return vtNormalize(vtMulAdd(vtMulAdd(face->forward, s, face->right), -t, face->up));
}

/// The direction as a colour, 1 to 3; 0.25 where there is no face.
static float* draw(const Picture* picture)
{
    float* pixels = malloc(sizeof(float) * 3 * side * side * 12);
    for (int y = 0; y < side * picture->down; ++y) {
        for (int x = 0; x < side * picture->across; ++x) {
            const Face* face = picture->faces[y / side * picture->across + x / side];
            float* to = pixels + 3 * (y * side * picture->across + x);
            to[0] = to[1] = to[2] = 0.25f;
            if (face != NULL) {
                const vtVec3 d = lookAt(face, ((float)(x % side) + 0.5f) / (side / 2) - 1.0f,
                                        ((float)(y % side) + 0.5f) / (side / 2) - 1.0f);
                to[0] = 2.0f + d.x;
                to[1] = 2.0f + d.y;
                to[2] = 2.0f + d.z;
            }
        }
    }
    return pixels;
}

static void load(const float* pixels, int width, int height, vtEnvironment* environment)
{
    uint8_t* bytes = NULL;
    size_t size = 0;
    vtError error = {0};
    assert_ok(vtEncodePfm(pixels, width, height, &bytes, &size, &error), error);
    assert_ok(vtLoadEnvironment(bytes, size, "cube.pfm", environment, &error), error);
    vtFree(bytes);
}

static void facesAreSeenWhereTheyShould(void** state)
{
    (void)state;
    for (size_t i = 0; i < sizeof pictures / sizeof pictures[0]; ++i) {
        float* pixels = draw(&pictures[i]);
        vtEnvironment environment;
        load(pixels, side * pictures[i].across, side * pictures[i].down, &environment);
        assert_true(environment.width == 4 * side && environment.height == 2 * side);
        for (uint32_t k = 0; k < 2000; ++k) {
            const vtVec3 d = onSphere(k), light = vtEnvironment_Sample(&environment, d);
            assert_near(light.x - 2.0f, d.x, 0.06f); // a texel is 0.05
            assert_near(light.y - 2.0f, d.y, 0.06f);
            assert_near(light.z - 2.0f, d.z, 0.06f);
        }
        vtDestroyEnvironment(&environment);
        free(pixels);
    }
}

/// A photograph of 4:3 is no cross, nor is what only nearly has its sides.
static void othersStayAsTheyAre(void** state)
{
    (void)state;
    float* pixels = draw(&pictures[0]);
    vtEnvironment environment;
    pixels[3 * (side / 2 * 4 * side + side / 2)] = 0.5f; // within the upper left square
    load(pixels, 4 * side, 3 * side, &environment);
    assert_true(environment.width == 4 * side && environment.height == 3 * side);
    vtDestroyEnvironment(&environment);
    load(pixels, 4 * side - 1, 3 * side, &environment);
    assert_true(environment.width == 4 * side - 1);
    vtDestroyEnvironment(&environment);
    free(pixels);
}

/// What a JPEG does to black: some noise, and more along an edge.
static void crossesMayBeUneven(void** state)
{
    (void)state;
    float* pixels = draw(&pictures[0]);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            float* to = pixels + 3 * (y * 4 * side + x);
            to[0] = to[1] = to[2] = x >= side - 3 ? 0.3f : 0.25f + 0.001f * (float)((x + y) % 2);
        }
    }
    vtEnvironment environment;
    load(pixels, 4 * side, 3 * side, &environment);
    assert_true(environment.height == 2 * side);
    vtDestroyEnvironment(&environment);
    free(pixels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facesAreSeenWhereTheyShould),
        cmocka_unit_test(othersStayAsTheyAre),
        cmocka_unit_test(crossesMayBeUneven),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
