// The techniques of Kay & Greenberg 1979 against the paper's own procedure, which this file carries out as it
// is told there: the background first, then surface after surface from the back, each of which maps the image
// made so far onto itself.
#include "image/image.h"
#include "light/environment.h"
#include "rendering.h"

typedef enum Shape { shapeSheet, shapeNearHalf, shapeFarHalf } Shape;

/// A surface that a ray meets at most once: a sheet, or one half of the unit ball about the origin, as the
/// eye sees it.
typedef struct Surface {
    Shape shape;
    Sheet sheet;
} Surface;

enum { pixelCount = side * side };

/// Where the ray from the eye meets it, and its normal turned to the eye.
static bool meets(const Surface* surface, vtVec3 eye, vtVec3 ray, vtVec3* position, vtVec3* normal)
{
    if (surface->shape != shapeSheet) {
        const float b = vtDot(eye, ray), k = b * b - vtDot(eye, eye) + 1.0f;
        const float root = sqrtf(fmaxf(k, 0.0f));
        *position = vtMulAdd(eye, surface->shape == shapeNearHalf ? -b - root : -b + root, ray);
        *normal = vtScale(*position, surface->shape == shapeNearHalf ? 1.0f : -1.0f);
        return k > 0.0f;
    }
    const Sheet* sheet = &surface->sheet;
    *normal = sheetNormal(sheet);
    const vtVec3 away = vtSub(sheet->corner, eye);
    *position = vtMulAdd(eye, vtDot(away, *normal) / vtDot(ray, *normal), ray);
    *normal = vtDot(*normal, ray) > 0.0f ? vtScale(*normal, -1.0f) : *normal;
    const vtVec3 within = vtSub(*position, sheet->corner);
    const float u = vtDot(within, sheet->across) / vtDot(sheet->across, sheet->across);
    const float v = vtDot(within, sheet->up) / vtDot(sheet->up, sheet->up);
    return u >= 0.0f && u <= 1.0f && v >= 0.0f && v <= 1.0f; // its sides are at right angles
}

/// NEW of equation 1, and Phong's highlight, which is added after.
static vtVec3 shade(vtVec3 normal, vtVec3 ray, float* highlight)
{
    const vtVec3 light = {-0.48f, 0.72f, 0.50f}, base = {0.55f, 0.70f, 0.75f};
    const vtVec3 mirrored = vtMulAdd(ray, -2.0f * vtDot(ray, normal), normal);
    *highlight = 0.8f * powf(fmaxf(vtDot(mirrored, light), 0.0f), 60.0f);
    return vtScale(base, 0.2f + 0.8f * fmaxf(vtDot(normal, light), 0.0f));
}

/// Equations 4 to 6 at one surface: its transparency, and the place where old is taken, pixels from the upper
/// left corner.
static float refractWall(const vtFrame* frame, vtVec3 position, vtVec3 normal, float place[2])
{
    const vtVec3 forward = vtNormalize(vtSub(frame->view.target, frame->view.eye));
    const vtVec3 right = vtNormalize(vtCross(forward, (vtVec3){0, 1, 0})), up = vtCross(right, forward);
    vtVec3 N = {vtDot(normal, right), vtDot(normal, up), vtDot(normal, forward)};
    N = N.z > 0.0f ? vtScale(N, -1.0f) : N;
    const vtVec3 I = {0.0f, 0.0f, 1.0f};
    const vtVec3 S = vtScale(vtMulAdd(I, -vtDot(I, N), N), 1.0f / frame->ior); // 4
    const vtVec3 R = vtMulAdd(S, -sqrtf(1.0f - vtDot(S, S)), N);               // 5, N towards the eye
    const float way = -1.0f / vtDot(R, N);                                     // in wall thicknesses
    const float depth = vtDot(vtSub(position, frame->view.eye), forward);
    const float pixels = (float)frame->height / (2.0f * tanf(frame->view.fovY * VT_PI / 360.0f)) / depth;
    place[0] += frame->wallThickness * way * R.x * pixels;
    place[1] -= frame->wallThickness * way * R.y * pixels;
    return powf(frame->transmittance, way); // 6
}

/// The paper's procedure, surfaces from back to front. `places`: where each pixel sees the background.
static void paint(const vtFrame* frame, const vtEnvironment* environment, const Surface* surfaces, int count,
                  vtVec3* image, float (*places)[2])
{
    static vtVec3 before[pixelCount];
    static float placesBefore[pixelCount][2];
    for (int p = 0; p < pixelCount; ++p) {
        image[p] = vtEnvironment_Sample(environment, eyeRay(frame, p % side, p / side));
        places[p][0] = (float)(p % side) + 0.5f;
        places[p][1] = (float)(p / side) + 0.5f;
    }
    for (int s = 0; s < count; ++s) {
        memcpy(before, image, sizeof before); // "stored temporarily until the surface is done"
        memcpy(placesBefore, places, sizeof placesBefore);
        for (int p = 0; p < pixelCount; ++p) {
            const vtVec3 ray = eyeRay(frame, p % side, p / side);
            vtVec3 position, normal;
            if (!meets(&surfaces[s], frame->view.eye, ray, &position, &normal)) {
                continue;
            }
            float highlight, t = frame->transmittance;
            float place[2] = {(float)(p % side) + 0.5f, (float)(p / side) + 0.5f};
            const vtVec3 new = shade(normal, ray, &highlight);
            if (frame->technique == vt_techniqueKayLinear) {
                highlight = 0.0f;
            } else if (frame->technique == vt_techniqueKayNonlinear) { // 2
                t = (frame->maxTransmittance - frame->minTransmittance) *
                        (1.0f - powf(1.0f - fabsf(vtDot(normal, ray)), frame->power)) +
                    frame->minTransmittance;
            } else {
                t = refractWall(frame, position, normal, place);
            }
            const int column = (int)vtClamp(place[0], 0, side - 1), row = (int)vtClamp(place[1], 0, side - 1);
            const int old = row * side + column;
            const vtVec3 sum = vtMulAdd(vtScale(before[old], t), 1.0f - t, new); // 1
            image[p] = vtAdd(sum, (vtVec3){highlight, highlight, highlight});
            for (int k = 0; k < 2;
                 ++k) { // the part of the shift that a pixel is too coarse for is carried on
                places[p][k] = placesBefore[old][k] + place[k] - ((float)(k == 0 ? column : row) + 0.5f);
            }
        }
    }
}

/// A frame in which every number of the three techniques shows.
static vtFrame kayFrame(vtTechnique technique, int layers)
{
    vtFrame frame = smallFrame(technique);
    frame.layers = layers;
    frame.transmittance = 0.45f;
    frame.maxTransmittance = 0.8f;
    frame.minTransmittance = 0.1f;
    frame.power = 3.0f;
    frame.wallThickness = 0.2f;
    frame.view = (vtView){{0.0f, 0.0f, 3.2f}, {0.0f, 0.0f, 0.0f}, 45.0f};
    return frame;
}

/// Draws, and wants the picture that the procedure paints but for a few pixels, where an edge falls into one
/// pixel or the next.
static void assertPainted(Fixture* fixture, const vtFrame* frame, const Surface* surfaces, int count)
{
    // Dark below and bright above, slightly coloured: what is shifted is seen, and nothing is cut at white.
    float gradient[3 * 8];
    for (int i = 0; i < 24; ++i) {
        gradient[i] = 0.45f - 0.055f * (float)(i / 3) + 0.02f * (float)(i % 3);
    }
    const vtEnvironment environment = {vt_environmentImage, gradient, 1, 8};
    vtError error;
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
    draw(fixture, frame);
    static vtVec3 image[pixelCount];
    static float places[pixelCount][2];
    paint(frame, &environment, surfaces, count, image, places);
    int covered = 0, otherColors = 0, otherPlaces = 0;
    for (int p = 0; p < pixelCount; ++p) {
        const float linear[3] = {image[p].x, image[p].y, image[p].z};
        bool same = true;
        for (int c = 0; c < 3; ++c) {
            const float wanted = 255.0f * vtLinearToSrgb(vtClamp(linear[c], 0.0f, 1.0f));
            same = same && fabsf(wanted - (float)fixture->pixels[4 * p + c]) < 3.0f;
        }
        otherColors += !same;
        const vtVec3 direction = vtMakeVec3(fixture->directions + 3 * p);
        if (vtDot(direction, direction) > 0.0f) {
            const vtVec3 wanted = eyeRayAt(frame, places[p][0], places[p][1]);
            ++covered;
            otherPlaces += degreesBetween(direction, wanted) > 0.7f;
        }
    }
    assert_true(covered > pixelCount / 4);
    assert_true(otherColors <= covered / 400);
    assert_true(otherPlaces <= covered / 400);
}

static void ballIsPaintedFromItsBack(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    const Surface halves[2] = {{.shape = shapeFarHalf}, {.shape = shapeNearHalf}};
    const vtTechnique techniques[] = {vt_techniqueKayLinear, vt_techniqueKayNonlinear,
                                      vt_techniqueKayThickness};
    for (int i = 0; i < 3; ++i) {
        vtFrame frame = kayFrame(techniques[i], 2);
        assertPainted(fixture, &frame, halves, 2);
        frame.layers = 1; // its front alone
        assertPainted(fixture, &frame, halves + 1, 1);
    }
}

// Two sheets face the eye, at the back and, before the right half, at the front; the one between them leans,
// covers the left and the middle, and shifts to the right what lies behind it. At its right edge the shifted
// place has one surface fewer, under the front sheet one more than where the ray came from.
static void shiftedPlaceShowsWhatLiesBehind(void** state)
{
    Fixture* fixture = *state;
    const float sine = 0.5f, cosine = 0.8660254f;
    const Surface sheets[3] = {
        {.sheet = {.corner = {-1.3f, -1.2f, -1.2f}, .across = {2.6f, 0, 0}, .up = {0, 2.4f, 0}}},
        {.sheet = {.corner = {-1.2f, -0.8f, -0.9f},
                   .across = {1.6f * cosine, 0, 1.6f * sine},
                   .up = {0, 1.6f, 0}}},
        {.sheet = {.corner = {-0.2f, -0.9f, 0.5f}, .across = {0.3f, 0, 0}, .up = {0, 0.9f, 0}}},
    };
    Sheet mesh[3];
    for (int i = 0; i < 3; ++i) {
        mesh[i] = sheets[i].sheet;
    }
    setSheets(fixture->renderer, mesh, 3);
    vtFrame frame = kayFrame(vt_techniqueKayThickness, 3);
    frame.wallThickness = 0.8f; // shifts by eight pixels
    assertPainted(fixture, &frame, sheets, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ballIsPaintedFromItsBack),
        cmocka_unit_test(shiftedPlaceShowsWhatLiesBehind),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
