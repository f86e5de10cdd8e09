// Shapes with closed formulas for position and normal: sphere, torus and knot.
#include "base/math.h"
#include "base/memory.h"
#include "shapes/shapes.h"

#include <string.h>

// ------------------------------------------------------------------------------------------------ sphere

enum {
    sphereLevels = 5,                                        // of subdivision, each into four
    sphereTriangles = 20 << (2 * sphereLevels),              // 20480
    sphereVertices = sphereTriangles / 2 + 2,                // Euler: V = F / 2 + 2
    sphereCoarse = (20 << (2 * (sphereLevels - 1))) / 2 + 2, // vertices before the last level
    sphereValence = 6,                                       // most edges at a vertex, on every level
};

/// The vertex halfway between a vertex and a neighbour of a higher number; 0: none yet.
typedef struct Midpoint {
    uint32_t neighbour, vertex;
} Midpoint;

static void addIcosahedron(vtShapeData* shape)
{
    const float g = 1.61803398875f; // golden ratio: (0, +-1, +-g) and its rotations are the corners
    const vtVec3 corners[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    static const uint8_t faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                         {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                         {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                         {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int i = 0; i < 12; ++i) {
        vtVec3 p = vtNormalize(corners[i]);
        vtShape_AddVertex(shape, p, p);
    }
    for (int i = 0; i < 20; ++i) {
        vtShape_AddTriangle(shape, faces[i][0], faces[i][1], faces[i][2]);
    }
}

static uint32_t findMidpoint(vtShapeData* shape, Midpoint (*midpoints)[sphereValence], uint32_t a, uint32_t b)
{
    uint32_t low = a < b ? a : b;
    uint32_t high = a < b ? b : a;
    Midpoint* midpoint = midpoints[low];
    while (midpoint->vertex != 0 && midpoint->neighbour != high) {
        ++midpoint;
    }
    if (midpoint->vertex == 0) {
        vtVec3 sum = vtAdd(vtMakeVec3(shape->positions + 3 * a), vtMakeVec3(shape->positions + 3 * b));
        vtVec3 p = vtNormalize(sum);
        *midpoint = (Midpoint){high, vtShape_AddVertex(shape, p, p)};
    }
    return midpoint->vertex;
}

/// Cuts every triangle in four. From the last to the first, so that the four can take their final place
/// without overwriting a triangle still to be cut.
static void subdivide(vtShapeData* shape, Midpoint (*midpoints)[sphereValence])
{
    uint32_t triangleCount = shape->indexCount / 3;
    shape->indexCount *= 4;
    for (uint32_t i = triangleCount; i-- > 0;) {
        uint32_t a = shape->indices[3 * i];
        uint32_t b = shape->indices[3 * i + 1];
        uint32_t c = shape->indices[3 * i + 2];
        uint32_t ab = findMidpoint(shape, midpoints, a, b);
        uint32_t bc = findMidpoint(shape, midpoints, b, c);
        uint32_t ca = findMidpoint(shape, midpoints, c, a);
        const uint32_t four[12] = {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca};
        memcpy(shape->indices + 12 * i, four, sizeof four);
    }
}

/// A subdivided icosahedron: no poles, and nearly equal triangles all over.
bool vtBuildSphere(vtShapeData* shape)
{
    Midpoint(*midpoints)[sphereValence] = vtAllocateZeroed(sphereCoarse, sizeof *midpoints);
    bool built = midpoints != NULL && vtShape_Reserve(shape, sphereVertices, sphereTriangles);
    if (built) {
        addIcosahedron(shape);
        for (int level = 0; level < sphereLevels; ++level) {
            memset(midpoints, 0, sphereCoarse * sizeof *midpoints);
            subdivide(shape, midpoints);
        }
    }
    vtFree(midpoints);
    return built;
}

// ------------------------------------------------------------------------------------------------- torus

static uint32_t divide(int divisions, const vtShapeData* shape)
{
    return (uint32_t)((float)divisions * shape->fineness + 0.5f);
}

bool vtBuildTorus(vtShapeData* shape)
{
    const uint32_t rings = divide(96, shape), columns = divide(192, shape);
    const float major = 1.0f;
    const float minor = 0.4f;
    if (!vtShape_Reserve(shape, rings * columns, 2 * rings * columns)) {
        return false;
    }
    for (uint32_t ring = 0; ring < rings; ++ring) {
        float v = 2.0f * VT_PI * (float)ring / (float)rings;
        for (uint32_t column = 0; column < columns; ++column) {
            float u = 2.0f * VT_PI * (float)column / (float)columns;
            vtVec3 spoke = {cosf(u), 0.0f, sinf(u)};
            vtVec3 normal = vtNormalize((vtVec3){cosf(v) * spoke.x, sinf(v), cosf(v) * spoke.z});
            vtShape_AddVertex(shape, vtMulAdd(vtScale(spoke, major), minor, normal), normal);
        }
    }
    for (uint32_t ring = 0; ring < rings; ++ring) {
        vtShape_AddBand(shape, ring * columns, (ring + 1) % rings * columns, columns);
    }
    return true;
}

// -------------------------------------------------------------------------------------------------- knot

typedef struct KnotFrame {
    vtVec3 centre, normal, side; ///< normal and side span the tube's cross section
} KnotFrame;

/// The curve winds 2 times about the axis of a torus and 3 times through it. It lies on that torus, so
/// the torus's normal is at right angles to it everywhere and closes up after a turn by itself: no
/// transported frame with a twist to correct is needed.
static KnotFrame getKnotFrame(float t)
{
    const float major = 1.0f;
    const float minor = 0.48f;
    float reach = major + minor * cosf(3.0f * t);
    float reachSlope = -3.0f * minor * sinf(3.0f * t);
    vtVec3 spoke = {cosf(2.0f * t), sinf(2.0f * t), 0.0f};
    vtVec3 spokeSlope = {-2.0f * spoke.y, 2.0f * spoke.x, 0.0f};
    vtVec3 tangent = vtMulAdd(vtScale(spoke, reachSlope), reach, spokeSlope);
    tangent.z = 3.0f * minor * cosf(3.0f * t);
    KnotFrame frame;
    frame.centre = vtScale(spoke, reach);
    frame.centre.z = minor * sinf(3.0f * t);
    frame.normal = (vtVec3){cosf(3.0f * t) * spoke.x, cosf(3.0f * t) * spoke.y, sinf(3.0f * t)};
    frame.side = vtNormalize(vtCross(frame.normal, tangent));
    return frame;
}

bool vtBuildKnot(vtShapeData* shape)
{
    const uint32_t rings = divide(480, shape), columns = divide(48, shape);
    // Strands' centre lines come no nearer than 0.858 to each other and bend with radii of 0.72 and more
    // (measured), so a tube below 0.43 cannot meet itself; this leaves gaps of half its width.
    const float tube = 0.28f;
    if (!vtShape_Reserve(shape, rings * columns, 2 * rings * columns)) {
        return false;
    }
    for (uint32_t ring = 0; ring < rings; ++ring) {
        KnotFrame frame = getKnotFrame(2.0f * VT_PI * (float)ring / (float)rings);
        for (uint32_t column = 0; column < columns; ++column) {
            float s = 2.0f * VT_PI * (float)column / (float)columns;
            vtVec3 normal = vtNormalize(vtMulAdd(vtScale(frame.normal, cosf(s)), sinf(s), frame.side));
            vtShape_AddVertex(shape, vtMulAdd(frame.centre, tube, normal), normal);
        }
    }
    for (uint32_t ring = 0; ring < rings; ++ring) {
        vtShape_AddBand(shape, ring * columns, (ring + 1) % rings * columns, columns);
    }
    vtShape_Fit(shape, 2.0f);
    return true;
}
