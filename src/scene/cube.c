#include "scene/cube.h"

#include <float.h>

#include "base/math.h"

enum {
    rotationCount = 48,
    sampledTriangles = 20000, // of a large mesh: enough to know where its surface faces
};

/// Rotation `index` of a low-discrepancy sequence: Shoemake's uniform quaternions (Graphics Gems III, 1992)
/// over the R3 sequence (the plastic number's generalisation).
static void makeAxes(int index, vtVec3 axes[3])
{
    float u = vtFract(0.5f + 0.8191725f * (float)index);
    float v = vtFract(0.5f + 0.6710436f * (float)index) * 2.0f * VT_PI;
    float w = vtFract(0.5f + 0.5497005f * (float)index) * 2.0f * VT_PI;
    float a = sqrtf(1.0f - u), b = sqrtf(u);
    float x = a * sinf(v), y = a * cosf(v), z = b * sinf(w), s = b * cosf(w);
    axes[0] = (vtVec3){1.0f - 2.0f * (y * y + z * z), 2.0f * (x * y - z * s), 2.0f * (x * z + y * s)};
    axes[1] = (vtVec3){2.0f * (x * y + z * s), 1.0f - 2.0f * (x * x + z * z), 2.0f * (y * z - x * s)};
    axes[2] = (vtVec3){2.0f * (x * z - y * s), 2.0f * (y * z + x * s), 1.0f - 2.0f * (x * x + y * y)};
}

/// Surface seen edge-on along one of the axes, weighted by how nearly.
static float edgeOnArea(const vtMesh* mesh, const vtVec3 axes[3])
{
    const float steep = 0.17f; // cosine of 80 degrees
    uint32_t count = mesh->indexCount / 3;
    uint32_t stride = count / sampledTriangles + 1;
    float sum = 0.0f;
    for (uint32_t i = 0; i < count; i += stride) {
        const uint32_t* corners = mesh->indices + 3 * (size_t)i;
        vtVec3 a = vtMakeVec3(mesh->positions + 3 * (size_t)corners[0]);
        vtVec3 b = vtMakeVec3(mesh->positions + 3 * (size_t)corners[1]);
        vtVec3 c = vtMakeVec3(mesh->positions + 3 * (size_t)corners[2]);
        vtVec3 normal = vtCross(vtSub(b, a), vtSub(c, a));
        float area = vtLength(normal);
        for (int axis = 0; axis < 3; ++axis) {
            sum += fmaxf(steep * area - fabsf(vtDot(normal, axes[axis])), 0.0f);
        }
    }
    return sum;
}

vtCubeFrame vtFitCube(const vtMesh* mesh)
{
    vtCubeFrame frame = {.low = {FLT_MAX, FLT_MAX, FLT_MAX}, .high = {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    float least = FLT_MAX;
    for (int i = 1; i <= rotationCount; ++i) {
        vtVec3 axes[3];
        makeAxes(i, axes);
        float area = edgeOnArea(mesh, axes);
        if (i == 1 || area < least) {
            least = area;
            for (int axis = 0; axis < 3; ++axis) {
                frame.axes[axis] = axes[axis];
            }
        }
    }
    for (uint32_t i = 0; i < mesh->indexCount; ++i) {
        vtVec3 p = vtMakeVec3(mesh->positions + 3 * (size_t)mesh->indices[i]);
        vtVec3 q = {vtDot(p, frame.axes[0]), vtDot(p, frame.axes[1]), vtDot(p, frame.axes[2])};
        frame.low = (vtVec3){fminf(frame.low.x, q.x), fminf(frame.low.y, q.y), fminf(frame.low.z, q.z)};
        frame.high = (vtVec3){fmaxf(frame.high.x, q.x), fmaxf(frame.high.y, q.y), fmaxf(frame.high.z, q.z)};
    }
    return frame;
}
