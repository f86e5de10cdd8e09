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

// Distance along a ray to the triangle that its line passes through, in units of its direction; -1 where it comes
// from the wrong side: inside the glass it leaves through triangles, outside it enters.
float distanceTo(uint triangle, vec3 origin, vec3 direction, bool inside, bool fromBothSides)
{
    Corners t = triangleCorners(triangle, origin);
    vec3 w = edgeVolumes(t, direction);
    float sum = w.x + w.y + w.z;
    vec3 way = (w.x * t.A + w.y * t.B + w.z * t.C) / sum;
    bool isMet = sum != 0.0 && ((sum > 0.0) == inside || fromBothSides);
    return isMet ? dot(way, direction) / dot(direction, direction) : -1.0;
}

// Weights of the corners where the ray's line passes through the triangle.
vec3 cornerWeights(uint triangle, vec3 origin, vec3 direction)
{
    vec3 w = edgeVolumes(triangleCorners(triangle, origin), direction);
    return w / (w.x + w.y + w.z);
}

// The surface of an object of glass where the ray (world) passes through its triangle.
SurfaceHit surfaceAt(int object, uint triangle, vec3 position, vec3 direction)
{
    Transform transform = readTransform(object);
    Corners t = triangleCorners(triangle, toObject(transform, vec4(position, 1.0)));
    vec3 w = edgeVolumes(t, toObject(transform, vec4(direction, 0.0)));
    w /= w.x + w.y + w.z;
    uvec3 n = triangleTexel(triangle, 3).xyz;
    vec3 normal = w.x * unpackNormal(n.x) + w.y * unpackNormal(n.y) + w.z * unpackNormal(n.z);
    return SurfaceHit(position, normalToWorld(transform, normal), normalToWorld(transform, cross(t.B - t.A, t.C - t.A)), object);
}
