// This work is based on:
//   Zhen-Qian Weng. Direct rendering of height fields [in Chinese: Height Field 直接 Rendering 方法]: the
//   change of the smooth normal, dN = dN/du du + dN/dv dv. Homan Igehy. Tracing Ray Differentials. 1999: du
//   and dv from a ray to its neighbour.
// Departures: u and v are the weights of the corners, so dN/du is N1 - N0; whatever else lies at corners
// follows them.
#include "base/math.h"
#include "relief/height_trace.h"

vtFootprint vtHeightField_Footprint(const vtHeightField* field, const vtHeightHit* hit, vtVec3 direction,
                                    vtVec3 originStep, vtVec3 directionStep)
{
    const vtReliefTriangle triangle = vtHeightField_Triangle(field, hit->triangle);
    const vtVec3 e1 = vtSub(triangle.corners[1], triangle.corners[0]);
    const vtVec3 e2 = vtSub(triangle.corners[2], triangle.corners[0]);
    // The neighbour's point at the same distance, and from there along the ray back into the plane.
    const vtVec3 G = vtCross(e1, e2), aside = vtMulAdd(originStep, hit->distance, directionStep);
    vtFootprint footprint = {.position = vtMulAdd(aside, -vtDot(aside, G) / vtDot(direction, G), direction)};
    const float a = vtDot(e1, e1), b = vtDot(e1, e2), c = vtDot(e2, e2), determinant = a * c - b * b;
    const float p = vtDot(e1, footprint.position), q = vtDot(e2, footprint.position);
    footprint.u = (c * p - b * q) / determinant;
    footprint.v = (a * q - b * p) / determinant;

    const vtVec3* normals = triangle.normals;
    const vtVec3 n1 = vtSub(normals[1], normals[0]), n2 = vtSub(normals[2], normals[0]);
    const vtVec3 N = vtMulAdd(vtMulAdd(normals[0], hit->u, n1), hit->v, n2);
    const vtVec3 dN = vtMulAdd(vtScale(n1, footprint.u), footprint.v, n2);
    // Of N / |N|: what is across N.
    const float square = vtDot(N, N);
    footprint.normal = vtScale(vtMulAdd(dN, -vtDot(N, dN) / square, N), 1.0f / sqrtf(square));
    return footprint;
}
