// Shapes of flat squares with texture coordinates: cube and plane.
#include "base/math.h"
#include "shapes/shapes.h"

/// Adds the square of half side `half` about the centre whose normal is right x up, the picture's upper left
/// corner at its left and up.
static void addSquare(vtShapeData* shape, vtVec3 centre, vtVec3 right, vtVec3 up, float half)
{
    const uint32_t first = shape->vertexCount;
    for (int corner = 0; corner < 4; ++corner) {
        const float u = corner == 1 || corner == 2 ? 1.0f : 0.0f, v = corner < 2 ? 1.0f : 0.0f;
        const vtVec3 across = vtScale(right, half * (2.0f * u - 1.0f));
        const vtVec3 p = vtAdd(vtAdd(centre, across), vtScale(up, half * (1.0f - 2.0f * v)));
        const uint32_t vertex = vtShape_AddVertex(shape, p, vtCross(right, up));
        shape->texcoords[2 * vertex] = u;
        shape->texcoords[2 * vertex + 1] = v;
    }
    vtShape_AddTriangle(shape, first, first + 1, first + 2);
    vtShape_AddTriangle(shape, first, first + 2, first + 3);
}

bool vtBuildCube(vtShapeData* shape)
{
    const float half = 0.6f;
    if (!vtShape_ReserveTextured(shape, 6 * 4, 6 * 2)) {
        return false;
    }
    const vtVec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1};
    const vtVec3 left = {-1, 0, 0}, down = {0, -1, 0}, back = {0, 0, -1};
    addSquare(shape, vtScale(z, half), x, y, half);
    addSquare(shape, vtScale(back, half), left, y, half);
    addSquare(shape, vtScale(x, half), back, y, half);
    addSquare(shape, vtScale(left, half), z, y, half);
    addSquare(shape, vtScale(y, half), x, back, half);
    addSquare(shape, vtScale(down, half), x, z, half);
    return true;
}

bool vtBuildPlane(vtShapeData* shape)
{
    if (!vtShape_ReserveTextured(shape, 4, 2)) {
        return false;
    }
    addSquare(shape, (vtVec3){0, 0, 0}, (vtVec3){1, 0, 0}, (vtVec3){0, 1, 0}, 2.0f);
    return true;
}
