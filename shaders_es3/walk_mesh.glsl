// From a triangle near a ray to the one that the ray meets.

struct TriangleHit {
    vec3 weights; // barycentric
    uint triangle;
};

// Crosses the edge beyond which the ray's point in the triangle's plane lies, again and again. False where the
// walk turns back, or ends at a triangle that the ray meets from the wrong side (inside the glass it leaves
// through triangles, outside it enters), no farther than `nearest` or beyond `farthest`.
bool walkToHit(uint triangle, vec3 origin, vec3 direction, bool inside, float nearest, float farthest,
               out TriangleHit hit)
{
    const int MOST_TRIANGLES = 16;
    uint previous = VT_NO_TRIANGLE;
    for (int i = 0; i < MOST_TRIANGLES; ++i) {
        uvec4 a = triangleTexel(triangle, 0), b = triangleTexel(triangle, 1), c = triangleTexel(triangle, 2);
        vec3 A = uintBitsToFloat(a.xyz) - origin, B = uintBitsToFloat(b.xyz) - origin;
        vec3 C = uintBitsToFloat(c.xyz) - origin;
        // Volumes that the ray spans with the edges: two triangles agree on their common edge to the last bit,
        // so that no ray slips through between them. Their sum has the sign of normal . direction.
        vec3 w = vec3(dot(cross(B, C), direction), dot(cross(C, A), direction), dot(cross(A, B), direction));
        float sum = w.x + w.y + w.z;
        vec3 s = sum < 0.0 ? -w : w;
        float least = min(s.x, min(s.y, s.z));
        if (least >= 0.0) {
            hit = TriangleHit(w / sum, triangle);
            float t = dot(w.x * A + w.y * B + w.z * C, direction) / sum;
            return (sum > 0.0) == inside && sum != 0.0 && t > nearest && t < farthest;
        }
        uint next = s.x == least ? a.w : s.y == least ? b.w : c.w;
        if (next == previous || next == VT_NO_TRIANGLE) {
            return false;
        }
        previous = triangle;
        triangle = next;
    }
    return false;
}

SurfaceHit surfaceAt(TriangleHit found)
{
    uvec4 a = triangleTexel(found.triangle, 0), b = triangleTexel(found.triangle, 1);
    uvec4 c = triangleTexel(found.triangle, 2), n = triangleTexel(found.triangle, 3);
    vec3 A = uintBitsToFloat(a.xyz), B = uintBitsToFloat(b.xyz), C = uintBitsToFloat(c.xyz);
    vec3 w = found.weights;
    SurfaceHit hit;
    hit.position = w.x * A + w.y * B + w.z * C;
    hit.normal = normalize(w.x * unpackNormal(n.x) + w.y * unpackNormal(n.y) + w.z * unpackNormal(n.z));
    hit.flatNormal = normalize(cross(B - A, C - A));
    return hit;
}
