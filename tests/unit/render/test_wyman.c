// Wyman 2005 against closed forms, without Fresnel reflection unless it is what is looked at.
#include "image/image.h"
#include "light/environment.h"
#include "rendering.h"

enum { middle = side / 2, near = 6 }; // pixels about the middle that are looked at

static const vtVec3 lookAt = {0.0f, 0.0f, -1.0f};

static vtFrame frontFrame(float ior, float fovY)
{
    vtFrame frame = smallFrame(vt_techniqueWyman);
    frame.ior = ior;
    frame.view = (vtView){{0.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 0.0f}, fovY};
    return frame;
}

/// Snell's law at a surface of normal N, against I; beyond the critical angle Wyman limits the angle of
/// incidence to it, so that the ray leaves along the surface.
static vtVec3 bendClamped(vtVec3 I, vtVec3 N, float eta, bool* clamped)
{
    const float c = -vtDot(N, I), k = 1.0f - eta * eta * (1.0f - c * c);
    *clamped = k < 0.0f;
    return *clamped ? vtNormalize(vtMulAdd(I, c, N)) : vtMulAdd(vtScale(I, eta), eta * c - sqrtf(k), N);
}

/// Where a pixel's path must leave: in at N1, out at the surface of outward normal N2.
static vtVec3 throughBoth(const vtFrame* frame, int column, int row, vtVec3 N1, vtVec3 N2, bool* clamped)
{
    const vtVec3 T1 = bendClamped(eyeRay(frame, column, row), N1, 1.0f / frame->ior, clamped);
    return bendClamped(T1, vtScale(N2, -1.0f), frame->ior, clamped);
}

static float degreesOff(const Fixture* fixture, int column, int row, vtVec3 wanted)
{
    return degreesBetween(vtMakeVec3(fixture->directions + 3 * (row * side + column)), wanted);
}

// The guess of the distance, in closed form for the unit ball: dV is the chord along the view, dN the
// diameter, P2 lies on neither, and the back side behind its pixel has the normal.
static void ballFollowsTheGuessedDistance(void** state)
{
    Fixture* fixture = *state;
    setShape(fixture->renderer, "sphere");
    vtFrame frame = frontFrame(1.5f, 45.0f);
    draw(fixture, &frame);
    const vtVec3 eye = frame.view.eye;
    int seen = 0, right = 0;
    for (int p = 0; p < side * side; ++p) {
        const vtVec3 V = eyeRay(&frame, p % side, p / side);
        const float b = vtDot(eye, V), k = b * b - vtDot(eye, eye) + 1.0f;
        if (k < 0.02f) {
            continue; // the rim, where triangles have edges
        }
        const vtVec3 N1 = vtMulAdd(eye, -b - sqrtf(k), V); // P1 as well
        bool clamped;
        const vtVec3 T1 = bendClamped(V, N1, 1.0f / frame.ior, &clamped);
        const float incoming = acosf(vtClamp(-vtDot(V, N1), 0.0f, 1.0f));
        const float refracted = asinf(sinf(incoming) / frame.ior);
        const float ratio = incoming > 1e-3f ? refracted / incoming : 1.0f / frame.ior;
        const float distance = ratio * 2.0f * sqrtf(k) + (1.0f - ratio) * 2.0f;
        const vtVec3 ray = vtNormalize(vtSub(vtMulAdd(N1, distance, T1), eye));
        const float b2 = vtDot(eye, ray), k2 = b2 * b2 - vtDot(eye, eye) + 1.0f;
        const vtVec3 N2 = vtMulAdd(eye, -b2 + sqrtf(fmaxf(k2, 0.0f)), ray);
        const float sine = frame.ior * vtLength(vtCross(T1, N2));
        if (k2 < 0.02f || fabsf(sine - 1.0f) < 0.03f) {
            continue; // near the critical angle directions turn without bound
        }
        ++seen;
        const vtVec3 wanted = bendClamped(T1, vtScale(N2, -1.0f), frame.ior, &clamped);
        right += degreesOff(fixture, p % side, p / side, wanted) < 1.0f;
    }
    assert_true(seen > side * side / 3);
    assert_true(right >= seen * 99 / 100);
}

// Behind a front that faces the eye the back side leans by 50 degrees: beyond the critical angle of 41.8.
static void clampedRayLeavesAlongTheSurfaceWithAllLight(void** state)
{
    Fixture* fixture = *state;
    const float sine = 0.7660444f, cosine = 0.6427876f;
    const Sheet sheets[2] = {{.corner = {-2, -2, 0}, .across = {4, 0, 0}, .up = {0, 4, 0}},
                             {.corner = {1, -0.9f * cosine, -1 - 0.9f * sine},
                              .across = {-2, 0, 0},
                              .up = {0, 1.8f * cosine, 1.8f * sine}}};
    setSheets(fixture->renderer, sheets, 2);
    // Light comes from 20 to 60 degrees below the horizon alone: the ray along the surface goes down by 40
    // degrees, the one that is reflected inside by 80, and what the front reflects by none.
    float rows[3 * 180] = {0};
    for (int i = 3 * 110; i < 3 * 150; ++i) {
        rows[i] = 1.0f;
    }
    const vtEnvironment environment = {vt_environmentImage, rows, 1, 180};
    vtError error;
    assert_ok(vtRenderer_SetEnvironment(fixture->renderer, &environment, &error), error);
    const vtTechnique techniques[] = {vt_techniqueWyman, vt_techniqueOliveira};
    for (int i = 0; i < 4; ++i) {
        vtFrame frame = frontFrame(1.5f, 45.0f);
        frame.technique = techniques[i / 2];
        frame.fresnel = i % 2 == 1;
        draw(fixture, &frame);
        for (int p = 0; p < 4 * near * near; ++p) {
            const int column = middle - near + p % (2 * near), row = middle - near + p / (2 * near);
            bool clamped;
            const vtVec3 wanted =
                throughBoth(&frame, column, row, sheetNormal(&sheets[0]), sheetNormal(&sheets[1]), &clamped);
            assert_true(clamped);
            assert_true(degreesOff(fixture, column, row, wanted) < 0.1f);
            // The front lets through 0.96 of the light that comes straight on.
            const float share = frame.fresnel ? 0.96f : 1.0f;
            assert_near((float)fixture->pixels[4 * (row * side + column)], 255.0f * vtLinearToSrgb(share),
                        1.6f);
        }
    }
}

// Where P2 has no back side behind its pixel the normal is N2 = T1 - (L . T1) L.
static void normalFacesTheSideBeyondTheSilhouette(void** state)
{
    Fixture* fixture = *state;
    // A front that bends rays to the right, past a narrow back side: T1 meets N2 at more than the critical
    // angle, and the clamped ray goes along L.
    const vtVec3 leaning = {-0.6f, 0.0f, 0.8f};
    Sheet sheets[2] = {{.corner = {-4, -4, 0}, .across = {8, 0, 0}, .up = {0, 8, 0}, .normal = leaning},
                       {.corner = {0.1f, -1, -2}, .across = {-0.6f, 0, 0}, .up = {0, 2, 0}}};
    setSheets(fixture->renderer, sheets, 2);
    vtFrame frame = frontFrame(1.5f, 45.0f);
    draw(fixture, &frame);
    for (int column = middle - 2; column < middle + 2; ++column) {
        assert_true(degreesOff(fixture, column, middle, lookAt) < 0.1f);
    }
    // A plain front of index 1.1, seen aslant at the picture's right edge: T1 meets N2 at less than it.
    sheets[0].normal = (vtVec3){0, 0, 1};
    setSheets(fixture->renderer, sheets, 2);
    frame = frontFrame(1.1f, 90.0f);
    draw(fixture, &frame);
    for (int column = side - 8; column < side; ++column) {
        bool clamped;
        const vtVec3 T1 =
            bendClamped(eyeRay(&frame, column, middle), sheets[0].normal, 1.0f / frame.ior, &clamped);
        const vtVec3 N2 = vtNormalize(vtMulAdd(T1, -vtDot(lookAt, T1), lookAt));
        const vtVec3 wanted = bendClamped(T1, vtScale(N2, -1.0f), frame.ior, &clamped);
        assert_false(clamped);
        assert_true(degreesOff(fixture, column, middle, wanted) < 0.1f);
    }
}

// Four surfaces, the second and the last with normals of their own.
static void backSideIsTheSecondOrTheFarthestSurface(void** state)
{
    Fixture* fixture = *state;
    const vtVec3 normals[2] = {{0.17f, 0.0f, -0.98f}, {-0.34f, 0.0f, -0.94f}};
    Sheet sheets[4];
    for (int i = 0; i < 4; ++i) {
        const float across = i % 2 == 0 ? 2.0f : -2.0f; // faces the eye, or away from it
        sheets[i] = (Sheet){
            .corner = {-across, -2.0f, -0.5f * (float)i}, .across = {2.0f * across, 0, 0}, .up = {0, 4, 0}};
        sheets[i].normal = i % 2 == 1 ? normals[i / 2] : (vtVec3){0, 0, 0};
    }
    setSheets(fixture->renderer, sheets, 4);
    for (int i = 0; i < 2; ++i) {
        vtFrame frame = frontFrame(1.5f, 45.0f);
        frame.backSurface = i == 0 ? vt_backSecond : vt_backFarthest;
        draw(fixture, &frame);
        for (int column = middle - near; column < middle + near; ++column) {
            bool clamped;
            const vtVec3 wanted = throughBoth(&frame, column, middle, sheetNormal(&sheets[0]),
                                              sheetNormal(&sheets[2 * i + 1]), &clamped);
            assert_false(clamped);
            assert_true(degreesOff(fixture, column, middle, wanted) < 0.1f);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ballFollowsTheGuessedDistance),
        cmocka_unit_test(clampedRayLeavesAlongTheSurfaceWithAllLight),
        cmocka_unit_test(normalFacesTheSideBeyondTheSilhouette),
        cmocka_unit_test(backSideIsTheSecondOrTheFarthestSurface),
    };
    return cmocka_run_group_tests(tests, setUp, tearDown);
}
