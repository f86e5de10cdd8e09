// A round brilliant cut.
//
// This work is based on: M. Tolkowsky. Diamond Design. 1919, whose proportions (table 53 %, crown 34.5
// degrees, pavilion 40.75 degrees) gave the modern cut. Its table is small to today's eye: the table of
// 57 %, the star length of 50 % and the lower-half length of 77 % are common values within today's best
// grade (T. Moses et al. A Foundation for Grading the Overall Cut Quality of Round Brilliant Cut Diamonds.
// Gems & Gemology 40(3), 2004).
// Facets: 1 table, 8 stars, 8 bezels, 16 upper girdle, 16 lower girdle, 8 pavilion mains = 57, no culet.
// Departure: the round girdle is made of 96 upright facets, so that every face is flat.
#include "base/math.h"
#include "shapes/shapes.h"

enum {
    fold = 8,                       // symmetry
    girdleSteps = 6,                // upright facets for each of the 16 halves of the girdle
    girdleCount = 16 * girdleSteps, // points around the girdle
    girdleFold = 2 * girdleSteps,   // from one main facet's point to the next
    mostCorners = girdleSteps + 2,  // of a facet: upper and lower girdle; the table has 8 as well
    // corners of all facets: table, stars, bezels, mains, the 32 halves, and the girdle
    diamondVertices = fold + fold * 3 + 2 * fold * 4 + 32 * mostCorners + girdleCount * 4,
    // triangles of a facet: two less than corners
    diamondTriangles = fold - 2 + fold + 2 * fold * 2 + 32 * (mostCorners - 2) + girdleCount * 2,
};

/// The places where facets meet, named by their ring, from the top down. Even eighths (0, 45, ... degrees)
/// are the directions of bezels and mains, the odd ones (22.5, ...) of stars and of the edges between halves.
typedef struct Brilliant {
    vtVec3 table[fold];
    vtVec3 starTips[fold];
    vtVec3 crownEdge[girdleCount];
    vtVec3 pavilionEdge[girdleCount];
    vtVec3 halfTips[fold]; ///< lower ends of the lower girdle facets
    vtVec3 culet;
} Brilliant;

/// `turn` is the part of a full turn. Radius 1 is the girdle.
static vtVec3 placeOnRing(double radius, double turn, double height)
{
    double angle = 2.0 * 3.14159265358979323846 * turn;
    return (vtVec3){(float)(radius * cos(angle)), (float)height, (float)(radius * sin(angle))};
}

/// Height, on the girdle's cylinder, of a half facet: the plane that contains the facet's tip (at odd
/// direction 22.5 degrees, at tipRadius and tipHeight) and the girdle points at 0 and 22.5 degrees, where its
/// height is 0. Between those two the cylinder leaves the chord, which makes the scallops of a real girdle.
static double getScallop(double tipRadius, double tipHeight, double angle)
{
    const double middle = 3.14159265358979323846 / 16.0; // the direction halfway, square to the chord
    double chord = cos(middle);
    double slope = tipHeight / (tipRadius * cos(middle) - chord);
    return slope * (cos(angle - middle) - chord);
}

static Brilliant measureBrilliant(void)
{
    const double radian = 3.14159265358979323846 / 180.0;
    const double crownSlope = tan(34.5 * radian);
    const double pavilionSlope = tan(40.75 * radian);
    const double tableRadius = 0.57;
    const double half = cos(22.5 * radian);
    // Star length 50 %: the tips lie halfway, seen from above, between the table's edge and the girdle.
    const double starRadius = 0.5 * (tableRadius * half + 1.0);
    // Lower halves 77 %: their tips reach that far from the girdle to the culet.
    const double tipRadius = 1.0 - 0.77;
    // Girdle 3 % of the diameter where it is thickest; the scallops leave 1.3 % where it is thinnest.
    const double girdle = 0.06;
    // Crown heights over the crown's edge, pavilion depths under the pavilion's. The tips lie in the planes
    // of the bezels and the mains on both sides of them.
    const double tableHeight = crownSlope * (1.0 - tableRadius);
    const double starHeight = crownSlope * (1.0 - starRadius * half);
    const double tipDepth = pavilionSlope * (1.0 - tipRadius * half);
    Brilliant stone;
    for (int i = 0; i < fold; ++i) {
        stone.table[i] = placeOnRing(tableRadius, i / 8.0, girdle + tableHeight);
        stone.starTips[i] = placeOnRing(starRadius, (i + 0.5) / 8.0, girdle + starHeight);
        stone.halfTips[i] = placeOnRing(tipRadius, (i + 0.5) / 8.0, -tipDepth);
    }
    for (int i = 0; i < girdleCount; ++i) {
        // Halves mirror each other at the even directions.
        int step = i % girdleFold <= girdleSteps ? i % girdleFold : girdleFold - i % girdleFold;
        double angle = 22.5 * radian * step / girdleSteps;
        stone.crownEdge[i] =
            placeOnRing(1.0, (double)i / girdleCount, girdle + getScallop(starRadius, starHeight, angle));
        stone.pavilionEdge[i] =
            placeOnRing(1.0, (double)i / girdleCount, -getScallop(tipRadius, tipDepth, angle));
    }
    stone.culet = (vtVec3){0.0f, (float)-pavilionSlope, 0.0f};
    return stone;
}

/// Adds a flat facet of `count` corners, counter-clockwise seen from outside, as a fan about the first.
static void addFacet(vtShapeData* shape, const vtVec3* corners, int count)
{
    vtVec3 area = {0.0f, 0.0f, 0.0f};
    for (int i = 2; i < count; ++i) {
        area = vtAdd(area, vtCross(vtSub(corners[i - 1], corners[0]), vtSub(corners[i], corners[0])));
    }
    vtVec3 normal = vtNormalize(area);
    uint32_t first = shape->vertexCount;
    for (int i = 0; i < count; ++i) {
        vtShape_AddVertex(shape, corners[i], normal);
    }
    for (int i = 2; i < count; ++i) {
        vtShape_AddTriangle(shape, first, first + (uint32_t)i - 1, first + (uint32_t)i);
    }
}

/// Upper and lower girdle facets on both sides of one edge between halves, at odd direction `side`.
static void addHalves(vtShapeData* shape, const Brilliant* stone, int side)
{
    for (int start = side * girdleFold; start < (side + 1) * girdleFold; start += girdleSteps) {
        vtVec3 upper[mostCorners] = {stone->starTips[side]};
        vtVec3 lower[mostCorners] = {stone->halfTips[side]};
        for (int i = 0; i <= girdleSteps; ++i) {
            upper[1 + i] = stone->crownEdge[(start + girdleSteps - i) % girdleCount];
            lower[1 + i] = stone->pavilionEdge[(start + i) % girdleCount];
        }
        addFacet(shape, upper, mostCorners);
        addFacet(shape, lower, mostCorners);
    }
}

bool vtBuildDiamond(vtShapeData* shape)
{
    if (!vtShape_Reserve(shape, diamondVertices, diamondTriangles)) {
        return false;
    }
    const Brilliant stone = measureBrilliant();
    vtVec3 table[fold];
    for (int i = 0; i < fold; ++i) {
        table[i] = stone.table[fold - 1 - i]; // +X turns towards +Z clockwise seen from above
    }
    addFacet(shape, table, fold);
    for (int i = 0; i < fold; ++i) {
        int next = (i + 1) % fold;
        int before = (i + fold - 1) % fold;
        const vtVec3* crown = &stone.crownEdge[i * girdleFold];
        const vtVec3* pavilion = &stone.pavilionEdge[i * girdleFold];
        addFacet(shape, (vtVec3[]){stone.table[i], stone.table[next], stone.starTips[i]}, 3);
        addFacet(shape, (vtVec3[]){stone.table[i], stone.starTips[i], *crown, stone.starTips[before]}, 4);
        addFacet(shape, (vtVec3[]){stone.culet, stone.halfTips[before], *pavilion, stone.halfTips[i]}, 4);
        addHalves(shape, &stone, i);
    }
    for (int i = 0; i < girdleCount; ++i) {
        int next = (i + 1) % girdleCount;
        addFacet(shape,
                 (vtVec3[]){stone.pavilionEdge[i], stone.crownEdge[i], stone.crownEdge[next],
                            stone.pavilionEdge[next]},
                 4);
    }
    vtShape_Fit(shape, 2.0f);
    return true;
}
