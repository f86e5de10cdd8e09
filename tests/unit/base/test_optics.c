// Optics against closed forms.
#include "base/optics.h"
#include "testing.h"

static const float ior = 1.5f;

static vtVec3 incoming(float degrees)
{
    float a = degrees * VT_PI / 180.0f;
    return (vtVec3){sinf(a), -cosf(a), 0.0f}; // down onto a floor whose normal is +Y
}

static const vtVec3 up = {0.0f, 1.0f, 0.0f};

static void refractionFollowsSnell(void** state)
{
    (void)state;
    for (float degrees = 0.0f; degrees < 90.0f; degrees += 5.0f) {
        bool reflected;
        vtVec3 T = vtBend(incoming(degrees), up, 1.0f / ior, &reflected);
        assert_false(reflected);
        assert_near(T.x, sinf(degrees * VT_PI / 180.0f) / ior, 1e-6);
        assert_near(vtLength(T), 1.0f, 1e-6);
        assert_true(T.y < 0.0f);
    }
}

static void totalReflectionBeginsAtTheCriticalAngle(void** state)
{
    (void)state;
    const float critical = asinf(1.0f / ior) * 180.0f / VT_PI; // 41.81 degrees for 1.5
    bool reflected;
    vtBend(incoming(critical - 0.01f), up, ior, &reflected);
    assert_false(reflected);
    vtVec3 R = vtBend(incoming(critical + 0.01f), up, ior, &reflected);
    assert_true(reflected);
    assert_near(R.x, incoming(critical + 0.01f).x, 1e-6);
    assert_near(R.y, -incoming(critical + 0.01f).y, 1e-6);
}

static void sameIndexChangesNothing(void** state)
{
    (void)state;
    for (float degrees = 0.0f; degrees < 89.0f; degrees += 7.0f) {
        bool inside = false, reflected;
        vtVec3 I = incoming(degrees);
        vtVec3 T = vtMeetSurface(I, up, up, 1.0f, &inside, &reflected);
        assert_true(inside);
        assert_near(vtLength(vtSub(T, I)), 0.0f, 1e-6);
    }
}

// A plate of thickness d shifts a ray sideways by d sin(a) (1 - cos(a) / sqrt(n^2 - sin^2(a))) and leaves
// its direction alone (Hecht, Optics, section 4.4).
static void slabShiftsByTheTextbookOffset(void** state)
{
    (void)state;
    const float thickness = 0.7f;
    for (float degrees = 0.0f; degrees < 85.0f; degrees += 5.0f) {
        bool inside = false, reflected;
        vtVec3 I = incoming(degrees), down = {0.0f, -1.0f, 0.0f};
        vtVec3 T = vtMeetSurface(I, up, up, ior, &inside, &reflected);
        vtVec3 leave = vtScale(T, thickness / -T.y);
        vtVec3 E = vtMeetSurface(T, down, down, ior, &inside, &reflected);
        assert_false(inside);
        assert_near(vtLength(vtSub(E, I)), 0.0f, 2e-6);

        float a = degrees * VT_PI / 180.0f;
        float expected = thickness * sinf(a) * (1.0f - cosf(a) / sqrtf(ior * ior - sinf(a) * sinf(a)));
        float offset = vtLength(vtSub(leave, vtScale(I, vtDot(leave, I))));
        assert_near(offset, expected, 1e-5);
    }
}

// An interpolated normal that turns its back to the ray, or sends it through the wrong side, is not used.
static void trianglesNormalDecidesWhereTheOtherFails(void** state)
{
    (void)state;
    const vtVec3 I = vtNormalize((vtVec3){1.0f, -0.05f, 0.0f});
    const vtVec3 turned = vtNormalize((vtVec3){1.0f, 0.3f, 0.0f}); // dot(turned, I) > 0
    bool inside = false, reflected, insideFlat = false;
    vtVec3 T = vtMeetSurface(I, turned, up, ior, &inside, &reflected);
    vtVec3 flat = vtMeetSurface(I, up, up, ior, &insideFlat, &reflected);
    assert_true(inside);
    assert_near(vtLength(vtSub(T, flat)), 0.0f, 1e-6);
    assert_true(T.y < 0.0f);

    // Inside, total reflection about a tilted normal that would lead out through the triangle.
    inside = true;
    const vtVec3 J = vtNormalize((vtVec3){1.0f, 0.1f, 0.0f});
    const vtVec3 tilted = vtNormalize((vtVec3){-0.2f, 1.0f, 0.0f});
    vtVec3 R = vtMeetSurface(J, tilted, up, ior, &inside, &reflected);
    assert_true(reflected);
    assert_true(R.y < 0.0f);
}

// From glass into denser glass and back; the normals are against the ray already.
static void interfacesFollowSnell(void** state)
{
    (void)state;
    const float eta = 1.5f / 2.0f;
    for (float degrees = 0.0f; degrees < 90.0f; degrees += 5.0f) {
        bool reflected;
        const vtVec3 I = incoming(degrees);
        vtVec3 T = vtMeetInterface(I, up, up, eta, &reflected);
        assert_false(reflected);
        assert_near(T.x, I.x * eta, 1e-6);
        vtVec3 E = vtMeetInterface(T, up, up, 1.0f / eta, &reflected);
        assert_false(reflected);
        assert_near(vtLength(vtSub(E, I)), 0.0f, 1e-4); // near the critical angle rounding grows
    }
    bool reflected;
    vtVec3 R = vtMeetInterface(incoming(49.0f), up, up, 1.0f / eta, &reflected); // critical: 48.59 degrees
    assert_true(reflected);
    assert_near(R.y, -incoming(49.0f).y, 1e-6);
}

// Kay & Greenberg's equations, by hand.
static void transparencyFollowsKayAndGreenberg(void** state)
{
    (void)state;
    // Equation 2, max .9, min .1: face on .9; at |Nz| = .5, p = 2: .8 (1 - .25) + .1 = .7, p = 3: .8 (1 -
    // .125) + .1 = .8; edge on .1.
    assert_near(vtNonlinearTransmittance(1.0f, 0.9f, 0.1f, 2.0f), 0.9f, 1e-6);
    assert_near(vtNonlinearTransmittance(0.5f, 0.9f, 0.1f, 2.0f), 0.7f, 1e-6);
    assert_near(vtNonlinearTransmittance(0.5f, 0.9f, 0.1f, 3.0f), 0.8f, 1e-6);
    assert_near(vtNonlinearTransmittance(0.0f, 0.9f, 0.1f, 2.0f), 0.1f, 1e-6);

    // A wall face on: straight through.
    float shift[2];
    assert_near(vtWallPath((vtVec3){0, 0, -1}, 1.5f, shift), 1.0f, 1e-6);
    assert_near(shift[0], 0.0f, 1e-6);
    // Tilted by 30 degrees, n = 1.5: sin r = .5 / 1.5, cos r = .942809; path 1 / .942809 = 1.060660. The ray
    // turns by 30 - 19.4712 degrees towards -N, so the shift is path * sin(10.5288) = .193814, away from N's
    // x.
    vtVec3 N = {sinf(VT_PI / 6.0f), 0.0f, -cosf(VT_PI / 6.0f)};
    assert_near(vtWallPath(N, 1.5f, shift), 1.060660f, 1e-5);
    assert_near(shift[0], -0.193814f, 1e-5);
    assert_near(shift[1], 0.0f, 1e-6);
    // Index 1: no shift at any tilt.
    vtWallPath(N, 1.0f, shift);
    assert_near(shift[0], 0.0f, 1e-7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refractionFollowsSnell),
        cmocka_unit_test(totalReflectionBeginsAtTheCriticalAngle),
        cmocka_unit_test(sameIndexChangesNothing),
        cmocka_unit_test(slabShiftsByTheTextbookOffset),
        cmocka_unit_test(transparencyFollowsKayAndGreenberg),
        cmocka_unit_test(trianglesNormalDecidesWhereTheOtherFails),
        cmocka_unit_test(interfacesFollowSnell),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
