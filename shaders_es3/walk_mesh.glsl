// From a triangle near a ray to the one that the ray meets.

struct Corners {
    vec3 A, B, C; // from the ray's origin
    uvec3 across; // the triangles beyond the edges opposite to them
};

Corners triangleCorners(uint triangle, vec3 origin)
{
    uvec4 a = triangleTexel(triangle, 0), b = triangleTexel(triangle, 1), c = triangleTexel(triangle, 2);
    return Corners(uintBitsToFloat(a.xyz) - origin, uintBitsToFloat(b.xyz) - origin,
                   uintBitsToFloat(c.xyz) - origin, uvec3(a.w, b.w, c.w));
}

// Volumes that the ray spans with the edges: two triangles agree on their common edge to the last bit, so that
// no ray slips through between them. Their sum has the sign of normal . direction.
vec3 edgeVolumes(Corners t, vec3 direction)
{
    return vec3(dot(cross(t.B, t.C), direction), dot(cross(t.C, t.A), direction), dot(cross(t.A, t.B), direction));
}

// The triangle that the ray's line passes through: crosses the edge beyond which the line's point in the
// triangle's plane lies, again and again. VT_NO_TRIANGLE where the walk turns back or takes too long.
uint walkToLine(uint triangle, vec3 origin, vec3 direction)
{
    const int MOST_TRIANGLES = 16;
    uint previous = VT_NO_TRIANGLE;
    for (int i = 0; triangle != VT_NO_TRIANGLE; ++i) {
        Corners t = triangleCorners(triangle, origin);
        vec3 w = edgeVolumes(t, direction);
        w = w.x + w.y + w.z < 0.0 ? -w : w;
        float least = min(w.x, min(w.y, w.z));
        if (least >= 0.0) {
            break;
        }
        uint next = w.x == least ? t.across.x : w.y == least ? t.across.y : t.across.z;
        next = next == previous || i == MOST_TRIANGLES ? VT_NO_TRIANGLE : next;
        previous = triangle;
        triangle = next;
    }
    return triangle;
}

// Does the ray meet the triangle that its line passes through? From the right side (inside the glass it leaves
// through triangles, outside it enters), farther than `nearest` and before `farthest`.
bool meetsTriangle(uint triangle, vec3 direction, bool inside, float nearest, float farthest, inout SurfaceHit hit)
{
    Corners t = triangleCorners(triangle, hit.position);
    vec3 w = edgeVolumes(t, direction);
    float sum = w.x + w.y + w.z;
    w /= sum;
    vec3 way = w.x * t.A + w.y * t.B + w.z * t.C;
    float distance = dot(way, direction);
    if ((sum > 0.0) != inside || sum == 0.0 || distance <= nearest || distance >= farthest) {
        return false;
    }
    uvec3 n = triangleTexel(triangle, 3).xyz;
    hit.position += way;
    hit.normal = normalize(w.x * unpackNormal(n.x) + w.y * unpackNormal(n.y) + w.z * unpackNormal(n.z));
    hit.flatNormal = normalize(cross(t.B - t.A, t.C - t.A));
    return true;
}
