// Vessels turned on a lathe: a profile in the half plane right of the axis, revolved about +Y.
//
// The profile is a uniform cubic B-spline (C. de Boor. A Practical Guide to Splines. 1978): its curvature
// is continuous, so refractions and highlights run over it without kinks, and it stays inside the hull of
// its control points, so walls do not bulge into each other. It starts on the axis below the vessel, runs
// up the outside, over the lip and down the inside to the axis: one closed surface of genus 0.
#include "base/math.h"
#include "shapes/shapes.h"

#include <assert.h>

/// Distance from the axis and height.
typedef struct ProfilePoint {
    double radius, height;
} ProfilePoint;

typedef struct Profile {
    const ProfilePoint* points; ///< control points; the first and the last lie on the axis
    int pointCount;
} Profile;

/// A place on the profile. The slope is the derivative by the spline's parameter.
typedef struct ProfileSample {
    ProfilePoint position, slope;
} ProfileSample;

enum {
    latheColumns = 160,
    latheRings = 184, // the two poles among them: 2 * 160 * (184 - 2) = 58240 triangles
    latheSteps = 64,  // integration steps for each span of the spline
};

/// Control point `index`; those past the ends mirror the profile at the axis, so that the surface passes
/// over its poles as smoothly as elsewhere.
static ProfilePoint getControl(const Profile* profile, int index)
{
    int last = profile->pointCount - 1;
    int inside = index < 0 ? -index : index > last ? 2 * last - index : index;
    ProfilePoint point = profile->points[inside];
    point.radius = inside == index ? point.radius : -point.radius;
    return point;
}

/// parameter: 0 at the first control point to pointCount - 1 at the last.
static ProfileSample sampleProfile(const Profile* profile, double parameter)
{
    int span = (int)parameter;
    span = span > profile->pointCount - 2 ? profile->pointCount - 2 : span;
    double t = parameter - span;
    double s = 1.0 - t;
    const double weights[4] = {s * s * s / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
                               (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0, t * t * t / 6.0};
    const double slopes[4] = {-s * s / 2.0, (3.0 * t * t - 4.0 * t) / 2.0, (4.0 * s - 3.0 * s * s) / 2.0,
                              t * t / 2.0};
    ProfileSample sample = {0};
    for (int i = 0; i < 4; ++i) {
        ProfilePoint point = getControl(profile, span - 1 + i);
        sample.position.radius += weights[i] * point.radius;
        sample.position.height += weights[i] * point.height;
        sample.slope.radius += slopes[i] * point.radius;
        sample.slope.height += slopes[i] * point.height;
    }
    return sample;
}

/// How many rings the way from a to b deserves, up to a factor: its length, and 0.2 for each radian that
/// it turns, which puts about 16 rings over a lip as thin as 0.03.
static double measureStep(ProfileSample a, ProfileSample b)
{
    double length = hypot(b.position.radius - a.position.radius, b.position.height - a.position.height);
    double turn = atan2(a.slope.radius * b.slope.height - a.slope.height * b.slope.radius,
                        a.slope.radius * b.slope.radius + a.slope.height * b.slope.height);
    return length + 0.2 * fabs(turn);
}

/// Chooses the parameters of the rings, at equal measure from each other.
static void placeRings(const Profile* profile, double* parameters)
{
    int stepCount = (profile->pointCount - 1) * latheSteps;
    double total = 0.0;
    for (int i = 0; i < stepCount; ++i) {
        total += measureStep(sampleProfile(profile, (double)i / latheSteps),
                             sampleProfile(profile, (double)(i + 1) / latheSteps));
    }
    double measure = 0.0;
    int ring = 0;
    for (int i = 0; i < stepCount; ++i) {
        double step = measureStep(sampleProfile(profile, (double)i / latheSteps),
                                  sampleProfile(profile, (double)(i + 1) / latheSteps));
        for (; ring < latheRings - 1 && total * ring / (latheRings - 1) < measure + step; ++ring) {
            double part = (total * ring / (latheRings - 1) - measure) / step;
            parameters[ring] = (i + part) / latheSteps;
        }
        measure += step;
    }
    parameters[latheRings - 1] = profile->pointCount - 1;
}

/// Adds the vertices of one ring, or the one vertex of a pole.
static void addRing(vtShapeData* shape, ProfileSample sample, uint32_t columns)
{
    // The outside lies to the right of the way along the profile.
    double length = hypot(sample.slope.radius, sample.slope.height);
    double normalRadius = sample.slope.height / length;
    double normalHeight = -sample.slope.radius / length;
    for (uint32_t column = 0; column < columns; ++column) {
        double angle = 2.0 * 3.14159265358979323846 * column / columns;
        double x = cos(angle);
        double z = sin(angle);
        double radius = columns == 1 ? 0.0 : sample.position.radius;
        vtShape_AddVertex(
            shape, (vtVec3){(float)(radius * x), (float)sample.position.height, (float)(radius * z)},
            (vtVec3){(float)(normalRadius * x), (float)normalHeight, (float)(normalRadius * z)});
    }
}

static bool revolve(vtShapeData* shape, const Profile* profile)
{
    assert(profile->points[0].radius == 0.0 && profile->points[profile->pointCount - 1].radius == 0.0);
    const uint32_t columns = latheColumns;
    if (!vtShape_Reserve(shape, 2 + columns * (latheRings - 2), 2 * columns * (latheRings - 2))) {
        return false;
    }
    double parameters[latheRings];
    placeRings(profile, parameters);
    for (int ring = 0; ring < latheRings; ++ring) {
        bool pole = ring == 0 || ring == latheRings - 1;
        addRing(shape, sampleProfile(profile, parameters[ring]), pole ? 1 : columns);
    }
    uint32_t lastRing = 1 + columns * (latheRings - 3);
    uint32_t lastPole = shape->vertexCount - 1;
    for (uint32_t ring = 1; ring < lastRing; ring += columns) {
        vtShape_AddBand(shape, ring, ring + columns, columns);
    }
    for (uint32_t column = 0; column < columns; ++column) {
        uint32_t next = (column + 1) % columns;
        vtShape_AddTriangle(shape, 0, 1 + column, 1 + next);
        vtShape_AddTriangle(shape, lastRing + column, lastPole, lastRing + next);
    }
    return true;
}

static bool revolveFitted(vtShapeData* shape, const Profile* profile)
{
    const bool built = revolve(shape, profile);
    if (built) {
        vtShape_Fit(shape, 2.0f);
    }
    return built;
}

bool vtBuildGoblet(vtShapeData* shape)
{
    static const ProfilePoint points[] = {
        // foot, hollow below, resting on its rim
        {0.0, 0.045},
        {0.13, 0.040},
        {0.26, 0.016},
        {0.345, 0.0},
        {0.392, 0.0},
        {0.410, 0.012},
        {0.402, 0.028},
        {0.34, 0.046},
        {0.22, 0.066},
        {0.11, 0.100},
        // stem
        {0.054, 0.165},
        {0.038, 0.28},
        {0.033, 0.42},
        {0.031, 0.56},
        {0.033, 0.69},
        {0.042, 0.79},
        // bowl, outside
        {0.082, 0.862},
        {0.19, 0.905},
        {0.325, 0.99},
        {0.416, 1.15},
        {0.447, 1.35},
        {0.434, 1.56},
        {0.396, 1.76},
        {0.362, 1.91},
        // lip
        {0.352, 1.965},
        {0.349, 1.990},
        {0.342, 2.002},
        {0.331, 2.002},
        {0.323, 1.990},
        {0.320, 1.965},
        // bowl, inside
        {0.328, 1.91},
        {0.361, 1.76},
        {0.399, 1.56},
        {0.412, 1.36},
        {0.382, 1.175},
        {0.296, 1.025},
        {0.16, 0.950},
        {0.0, 0.930},
    };
    const Profile profile = {points, sizeof points / sizeof points[0]};
    return revolveFitted(shape, &profile);
}

bool vtBuildBottle(vtShapeData* shape)
{
    static const ProfilePoint points[] = {
        // punt and the ring it stands on
        {0.0, 0.16},
        {0.07, 0.15},
        {0.14, 0.105},
        {0.20, 0.04},
        {0.245, 0.004},
        {0.285, 0.0},
        {0.315, 0.025},
        {0.325, 0.075},
        // body, outside
        {0.327, 0.20},
        {0.328, 0.40},
        {0.328, 0.60},
        {0.328, 0.78},
        {0.324, 0.92},
        // shoulder and neck, outside
        {0.300, 1.07},
        {0.245, 1.22},
        {0.180, 1.36},
        {0.135, 1.49},
        {0.115, 1.62},
        {0.107, 1.75},
        {0.104, 1.84},
        // string ring and lip
        {0.104, 1.872},
        {0.108, 1.886},
        {0.124, 1.892},
        {0.131, 1.905},
        {0.131, 1.935},
        {0.124, 1.950},
        {0.112, 1.958},
        {0.109, 1.972},
        {0.106, 1.992},
        {0.097, 2.002},
        {0.084, 2.002},
        {0.075, 1.992},
        {0.072, 1.965},
        // neck and shoulder, inside
        {0.071, 1.90},
        {0.071, 1.80},
        {0.074, 1.70},
        {0.082, 1.59},
        {0.103, 1.47},
        {0.147, 1.345},
        {0.211, 1.205},
        {0.262, 1.065},
        // body, inside
        {0.285, 0.91},
        {0.289, 0.78},
        {0.289, 0.60},
        {0.289, 0.40},
        {0.288, 0.24},
        {0.284, 0.135},
        // floor over the punt
        {0.266, 0.085},
        {0.236, 0.078},
        {0.205, 0.110},
        {0.155, 0.175},
        {0.08, 0.225},
        {0.0, 0.235},
    };
    const Profile profile = {points, sizeof points / sizeof points[0]};
    return revolveFitted(shape, &profile);
}

// The tumbler's outside: radius 0.6, from -0.9 up to 0.9. Its wall is 0.06 thick, its base 0.25, so the
// inside has radius 0.54 and begins at -0.65. The water goes 0.02, a third of the wall, into wall and base,
// and ends at 0.28, which is 60 % of the inside.

bool vtBuildTumbler(vtShapeData* shape)
{
    static const ProfilePoint points[] = {
        // base
        {0.0, -0.9},
        {0.28, -0.9},
        {0.52, -0.9},
        {0.565, -0.9},
        {0.592, -0.892},
        {0.6, -0.865},
        {0.6, -0.82},
        // outside
        {0.6, -0.6},
        {0.6, 0.0},
        {0.6, 0.6},
        {0.6, 0.82},
        {0.6, 0.872},
        // rim
        {0.597, 0.894},
        {0.583, 0.9},
        {0.57, 0.9},
        {0.557, 0.9},
        {0.543, 0.894},
        // inside
        {0.54, 0.872},
        {0.54, 0.82},
        {0.54, 0.6},
        {0.54, 0.0},
        {0.54, -0.4},
        {0.54, -0.56},
        // floor
        {0.54, -0.6},
        {0.528, -0.638},
        {0.49, -0.65},
        {0.45, -0.65},
        {0.24, -0.65},
        {0.0, -0.65},
    };
    const Profile profile = {points, sizeof points / sizeof points[0]};
    return revolve(shape, &profile);
}

bool vtBuildWater(vtShapeData* shape)
{
    static const ProfilePoint points[] = {
        // in the tumbler's base and along its floor's curve
        {0.0, -0.67},
        {0.24, -0.67},
        {0.45, -0.67},
        {0.49, -0.67},
        {0.543, -0.653},
        {0.56, -0.6},
        {0.56, -0.56},
        // in its wall
        {0.56, -0.4},
        {0.56, 0.0},
        {0.56, 0.24},
        {0.56, 0.272},
        // the edge, inside the wall; from there the surface is flat
        {0.56, 0.28},
        {0.553, 0.28},
        {0.52, 0.28},
        {0.26, 0.28},
        {0.0, 0.28},
    };
    const Profile profile = {points, sizeof points / sizeof points[0]};
    return revolve(shape, &profile);
}
