// This work is based on:
//   Tomas Moller, Ben Trumbore. Fast, Minimum Storage Ray/Triangle Intersection. 1997.
//   Timo Aila, Samuli Laine. Understanding the Efficiency of Ray Traversal on GPUs. 2009: down to a leaf first,
//   then its triangles; the farther child waits on a stack.
// The layout: src/scene/bvh_records.h.
uniform usampler2D u_bvhNodes;
uniform usampler2D u_bvhTriangles;

const uint LEAF = 0x80000000u;
const uint NOTHING = 0xffffffffu;

struct TriangleHit {
    float distance;
    float u, v; // weights of the second and third corner
    uint triangle;
};

uvec4 bvhChild(uint node, int child)
{
    ivec2 texel = ivec2(2 * int(node % uint(VT_BVH_NODES_A_ROW)) + child, int(node / uint(VT_BVH_NODES_A_ROW)));
    return texelFetch(u_bvhNodes, texel, 0);
}

// Where a ray enters a child's box; beyond `farthest` where it does not. Origin and inverse direction in the
// boxes' steps.
float enterBox(uvec4 child, vec3 origin, vec3 inverse, float farthest)
{
    uvec3 lower = child.xyz & 0xffffu, upper = child.xyz >> 16u;
    vec3 a = (vec3(lower.x, upper.x, lower.y) - origin) * inverse;
    vec3 b = (vec3(upper.y, lower.z, upper.z) - origin) * inverse;
    vec3 enters = min(a, b), leaves = max(a, b);
    float enter = max(max(enters.x, enters.y), max(enters.z, 0.0));
    float leave = min(min(leaves.x, leaves.y), min(leaves.z, farthest));
    return enter <= leave ? enter : 3e38;
}

// The triangle of a leaf against the ray; nearer hits replace the one there is.
void meetTriangle(int index, vec3 origin, vec3 direction, bool inside, float nearest, inout TriangleHit hit)
{
    int row = index / VT_BVH_TRIANGLES_A_ROW;
    ivec2 texel = ivec2(3 * (index - row * VT_BVH_TRIANGLES_A_ROW), row);
    uvec4 corner = texelFetch(u_bvhTriangles, texel, 0);
    vec3 A = uintBitsToFloat(corner.xyz);
    vec3 e1 = uintBitsToFloat(texelFetch(u_bvhTriangles, texel + ivec2(1, 0), 0).xyz);
    vec3 e2 = uintBitsToFloat(texelFetch(u_bvhTriangles, texel + ivec2(2, 0), 0).xyz);
    vec3 p = cross(direction, e2), s = origin - A, q = cross(s, e1);
    float determinant = dot(e1, p); // negative where the ray leaves the glass
    float inverse = 1.0 / determinant;
    float u = dot(s, p) * inverse, v = dot(direction, q) * inverse, t = dot(e2, q) * inverse;
    bool faces = inside ? determinant < 0.0 : determinant > 0.0;
    if (faces && u >= -1e-5 && v >= -1e-5 && u + v <= 1.00001 && t > nearest && t < hit.distance) {
        hit = TriangleHit(t, u, v, corner.w);
    }
}

// The first triangle beyond distance `nearest` that the ray leaves the glass through (inside) or enters it
// through. False where there is none.
bool searchBvh(vec3 origin, vec3 direction, bool inside, float nearest, out TriangleHit hit)
{
    vec3 low = objectNumbers(0, VT_OBJECT_OWN_LOW).xyz;
    vec3 extent = objectNumbers(0, VT_OBJECT_OWN_HIGH).xyz - low;
    vec3 scale = (VT_BVH_STEPS - 2.0) / max(extent, 1e-4 * length(extent));
    vec3 boxOrigin = (origin - low) * scale + 1.0;
    // Nothing is parallel to a box's side.
    vec3 boxDirection = direction * scale;
    boxDirection = mix(boxDirection, vec3(1e-6), lessThan(abs(boxDirection), vec3(1e-6)));
    vec3 inverse = 1.0 / boxDirection;

    uint stack[VT_BVH_STACK];
    int depth = 0;
    uint next = 0u;
    hit = TriangleHit(3e38, 0.0, 0.0, NOTHING);
    while (next != NOTHING) {
        while (next < LEAF) {
            uvec4 a = bvhChild(next, 0), b = bvhChild(next, 1);
            float enterA = enterBox(a, boxOrigin, inverse, hit.distance);
            float enterB = enterBox(b, boxOrigin, inverse, hit.distance);
            bool swap = enterB < enterA;
            bool any = min(enterA, enterB) < 3e38, both = max(enterA, enterB) < 3e38;
            next = swap ? b.w : a.w;
            if (both) {
                stack[depth++] = swap ? a.w : b.w;
            } else if (!any) {
                next = depth > 0 ? stack[--depth] : NOTHING;
            }
        }
        if (next != NOTHING) {
            int first = int(next & ((1u << VT_BVH_COUNT_SHIFT) - 1u));
            int end = first + int((next >> VT_BVH_COUNT_SHIFT) & 7u);
            for (int i = first; i < end; ++i) {
                meetTriangle(i, origin, direction, inside, nearest, hit);
            }
            next = depth > 0 ? stack[--depth] : NOTHING;
        }
    }
    return hit.triangle != NOTHING;
}

SurfaceHit surfaceAt(TriangleHit found, vec3 position, Transform transform)
{
    uvec4 a = triangleTexel(found.triangle, 0), b = triangleTexel(found.triangle, 1);
    uvec4 c = triangleTexel(found.triangle, 2), n = triangleTexel(found.triangle, 3);
    vec3 A = uintBitsToFloat(a.xyz), B = uintBitsToFloat(b.xyz), C = uintBitsToFloat(c.xyz);
    vec3 normal = (1.0 - found.u - found.v) * unpackNormal(n.x) + found.u * unpackNormal(n.y) + found.v * unpackNormal(n.z);
    return SurfaceHit(position, normalToWorld(transform, normal), normalToWorld(transform, cross(B - A, C - A)), 0);
}
