// This work is based on:
//   Holger Dammertz, Johannes Hanika, Alexander Keller. Shallow Bounding Volume Hierarchies for Fast SIMD Ray Tracing of
//   Incoherent Rays. EGSR 2008: four children a node, one flat loop;
//   Henri Ylitie, Tero Karras, Samuli Laine. Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs.
//   HPG 2017: boxes on a coarse grid, groups of siblings on the stack;
//   Timo Aila, Samuli Laine. Understanding the Efficiency of Ray Traversal on GPUs. 2009: the nearest child first;
//   Tomas Moller, Ben Trumbore. Fast, Minimum Storage Ray/Triangle Intersection. 1997.
// Departures:
// - Nodes and pairs of triangles are records of one kind and size (src/mesh/hierarchy.h), on one grid over the mesh.
// - A child has a cone of normals: a ray inside closed glass can only meet triangles that face along it, one outside
//   only those that face against it. What faces the wrong way is not visited.
// - The stack is shift registers: an array's elements would be chosen by branches on software renderers. The builder
//   keeps every way down short enough for it (VT_HIERARCHY_STACK).
// - A round looks at a record as a node and as a pair at once: software renderers run both sides of a branch anyway.
uniform usampler2D u_records;

// Of an object's mesh: the place of its first record, the grid of its boxes.
struct Hierarchy {
    uint first;
    vec3 low, scale;
    bool bothSides; // opaque of two sides, or glass with open edges or parts that overlap
};

Hierarchy readHierarchy(int object)
{
    uvec4 low = objectBits(object, VT_OBJECT_GRID_LOW), scale = objectBits(object, VT_OBJECT_GRID_SCALE);
    return Hierarchy(low.w, uintBitsToFloat(low.xyz), uintBitsToFloat(scale.xyz), scale.w != 0u);
}

struct RecordHit {
    float distance; // in the world
    uint triangle;  // twice its pair's record, plus one for the second of the pair; VT_NO_TRIANGLE: none
    vec2 at;        // weights of the second and third corner
};

// One texel of u_records in its coordinates. textureLod where texelFetch would do: on software renderers it takes less
// than half the instructions.
vec2 recordTexel()
{
    return 1.0 / vec2(textureSize(u_records, 0));
}

vec2 recordPlace(uint record, vec2 texel)
{
    return (vec2(float((record % uint(VT_RECORDS_A_ROW)) * 4u), float(record / uint(VT_RECORDS_A_ROW))) + 0.5) * texel;
}

float greater(float a, float b) { return a > b ? a : b; } // max and min would mind NaN
float lesser(float a, float b) { return a < b ? a : b; }

// A ray on the grid.
struct GridRay {
    vec3 inverse, nearBias, farBias; // grid steps to parameters
    uvec3 nearShift, farShift;       // the bits where a box's near and far side lie
    vec3 facing;                     // unit direction over 21, the cones' unit; 0: any side
    float first;                     // what lies before that does not count
};

// Where the ray enters a child's box, NOWHERE where it does not before `farthest`, or where nothing below faces it.
float enterChild(uvec4 child, GridRay ray, float farthest)
{
    vec3 a = vec3((child.xyz >> ray.nearShift) & 0xfffu) * ray.inverse + ray.nearBias;
    vec3 b = vec3((child.xyz >> ray.farShift) & 0xfffu) * ray.inverse + ray.farBias;
    float enter = greater(greater(a.x, a.y), greater(a.z, ray.first));
    float leave = lesser(lesser(b.x, b.y), lesser(b.z, farthest));
    vec3 cone = vec3(ivec3(child.xyz) >> 24);
    return enter <= leave && dot(cone, ray.facing) > -1.0 ? enter : NOWHERE;
}

#ifdef ONE_OBJECT // its glass is closed: sides tell the triangles apart
#define NOT_FROM(triangle) true
#else
#define NOT_FROM(triangle) ((triangle) != from)
#endif

// Far more rounds than a search takes: no fault of the data hangs the GPU.
const int MOST_ROUNDS = 65536;

// The first triangle between `nearest` and `farthest` on a ray in an object's own coordinates, whose direction is as
// long as in the world. side: 1: it enters through it, -1: it leaves through it, 0: either. `from`: a triangle that does
// not count; VT_NO_TRIANGLE: all do.
RecordHit searchRecords(Hierarchy tree, vec3 origin, vec3 direction, float side, float nearest, float farthest, uint from)
{
    vec2 texel = recordTexel();
    vec3 d = direction * tree.scale;
    // Nothing is parallel to a box's side.
    float slope = 1e-7 * max(abs(d.x), max(abs(d.y), abs(d.z)));
    d = mix(d, vec3(slope), lessThan(abs(d), vec3(slope)));
    vec3 inverse = 1.0 / d;
    bvec3 down = lessThan(d, vec3(0.0));
    // From where it comes into the grid on, or would: far away, steps would be lost to rounding.
    vec3 low = (tree.low - origin) * tree.scale * inverse, high = low + 4096.0 * inverse;
    vec3 enters = mix(low, high, down);
    float start = min(max(max(enters.x, enters.y), max(enters.z, 0.0)), farthest);
    vec3 o = origin + start * direction;
    vec3 near = (tree.low - o) * tree.scale * inverse;
    GridRay ray = GridRay(inverse, near + mix(vec3(0.0), inverse, down), near + mix(inverse, vec3(0.0), down),
                          uvec3(down) * 12u, 12u - uvec3(down) * 12u,
                          -side / 21.0 * normalize(direction), nearest - start);
    float best = farthest - start;
    vec2 at = vec2(0.0);
    uint found = VT_NO_TRIANGLE;
    uint node = tree.first;
    uint group = 0u; // siblings that wait: number of the first of four, times 16, plus a bit each
    uint s0 = 0u, s1 = 0u, s2 = 0u, s3 = 0u, s4 = 0u, s5 = 0u, s6 = 0u, s7 = 0u, s8 = 0u, s9 = 0u;
    float least = side == 0.0 ? -1.0 : 0.0; // of which determinant times side must be more
    // Left at its end: a test at its beginning costs software renderers a twentieth of the whole.
    for (int round = 0; round < MOST_ROUNDS; ++round) {
        vec2 place = recordPlace(node, texel);
        uvec4 t0 = textureLod(u_records, place, 0.0);
        uvec4 t1 = textureLod(u_records, place + vec2(texel.x, 0.0), 0.0);
        uvec4 t2 = textureLod(u_records, place + vec2(2.0 * texel.x, 0.0), 0.0);
        uvec4 t3 = textureLod(u_records, place + vec2(3.0 * texel.x, 0.0), 0.0);
        bool isLeaf = t3.w != VT_NO_NORMAL;

        // As a node: the children that the ray enters.
        float e0 = enterChild(t0, ray, best), e1 = enterChild(t1, ray, best);
        float e2 = enterChild(t2, ray, best), e3 = enterChild(t3, ray, best);
        uint mask = (e0 < NOWHERE ? 1u : 0u) | (e1 < NOWHERE ? 2u : 0u) | (e2 < NOWHERE ? 4u : 0u) | (e3 < NOWHERE ? 8u : 0u);
        mask = isLeaf ? 0u : mask;
        uint nearestChild = lesser(e0, e1) <= lesser(e2, e3) ? (e0 <= e1 ? 0u : 1u) : (e2 <= e3 ? 2u : 3u);

        // As a pair: triangles 0 1 2 and 0 2 3.
        vec3 A = uintBitsToFloat(t0.xyz), s = o - A;
        vec3 e = uintBitsToFloat(t1.xyz) - A, f = uintBitsToFloat(t2.xyz) - A, g = uintBitsToFloat(t3.xyz) - A;
        vec3 p = cross(direction, f), q = cross(s, e);
        float determinant = dot(e, p), inverted = 1.0 / determinant; // negative where the ray leaves the glass
        float u = dot(s, p) * inverted, v = dot(direction, q) * inverted, t = dot(f, q) * inverted;
        bool faces = determinant * side > least && NOT_FROM(node * 2u);
        bool isMet = isLeaf && faces && u >= -1e-5 && v >= -1e-5 && u + v <= 1.00001 && t > ray.first && t < best;
        best = isMet ? t : best;
        at = isMet ? vec2(u, v) : at;
        found = isMet ? node * 2u : found;
        p = cross(direction, g);
        q = cross(s, f);
        determinant = dot(f, p);
        inverted = 1.0 / determinant;
        u = dot(s, p) * inverted;
        v = dot(direction, q) * inverted;
        t = dot(g, q) * inverted;
        faces = determinant * side > least && NOT_FROM(node * 2u + 1u);
        isMet = isLeaf && faces && u >= -1e-5 && v >= -1e-5 && u + v <= 1.00001 && t > ray.first && t < best;
        best = isMet ? t : best;
        at = isMet ? vec2(u, v) : at;
        found = isMet ? node * 2u + 1u : found;

        // Down to the nearest child, on to a sibling that waits, or back to the group put aside last.
        bool any = mask != 0u, siblings = (group & 15u) != 0u;
        bool push = any && siblings, pop = !any && !siblings;
        uint popped = s0;
        uint n0 = push ? group : pop ? s1 : s0, n1 = push ? s0 : pop ? s2 : s1, n2 = push ? s1 : pop ? s3 : s2;
        uint n3 = push ? s2 : pop ? s4 : s3, n4 = push ? s3 : pop ? s5 : s4, n5 = push ? s4 : pop ? s6 : s5;
        uint n6 = push ? s5 : pop ? s7 : s6, n7 = push ? s6 : pop ? s8 : s7, n8 = push ? s7 : pop ? s9 : s8;
        uint n9 = push ? s8 : pop ? 0u : s9;
        s0 = n0;
        s1 = n1;
        s2 = n2;
        s3 = n3;
        s4 = n4;
        s5 = n5;
        s6 = n6;
        s7 = n7;
        s8 = n8;
        s9 = n9;
        group = any ? (t0.w << 4u) | mask : siblings ? group : popped;
        uint bits = group & 15u;
        uint lowest = (bits & 1u) != 0u ? 0u : (bits & 2u) != 0u ? 1u : (bits & 4u) != 0u ? 2u : 3u;
        uint next = any ? nearestChild : lowest;
        node = tree.first + (group >> 4u) + next;
        group &= ~(1u << next);
        if (bits == 0u) {
            break;
        }
    }
    return RecordHit(found == VT_NO_TRIANGLE ? NOWHERE : start + best, found, at);
}

// The corners of a triangle of a pair, positions in own coordinates, normals packed in w.
struct Corners {
    uvec4 a, b, c;
};

Corners recordCorners(uint triangle)
{
    vec2 texel = recordTexel();
    vec2 place = recordPlace(triangle >> 1u, texel);
    float second = float(triangle & 1u);
    return Corners(textureLod(u_records, place, 0.0), textureLod(u_records, place + vec2((1.0 + second) * texel.x, 0.0), 0.0),
                   textureLod(u_records, place + vec2((2.0 + second) * texel.x, 0.0), 0.0));
}

vec3 cornersArea(Corners corners)
{
    vec3 A = uintBitsToFloat(corners.a.xyz);
    return cross(uintBitsToFloat(corners.b.xyz) - A, uintBitsToFloat(corners.c.xyz) - A);
}

vec3 cornersNormal(Corners corners, vec2 at)
{
    return (1.0 - at.x - at.y) * unpackNormal(corners.a.w) + at.x * unpackNormal(corners.b.w) + at.y * unpackNormal(corners.c.w);
}

#ifdef WITH_FOOTPRINT
// What a step along the triangle, in the world, does to the normal there: du and dv of the step, times what they do.
mat3 cornersTurn(Transform transform, Corners corners, vec2 at)
{
    vec3 A = uintBitsToFloat(corners.a.xyz), e1 = uintBitsToFloat(corners.b.xyz) - A, e2 = uintBitsToFloat(corners.c.xyz) - A;
    vec3 area = cross(e1, e2), n = unpackNormal(corners.a.w);
    mat3 change = outerProduct(unpackNormal(corners.b.w) - n, cross(e2, area)) + outerProduct(unpackNormal(corners.c.w) - n, cross(area, e1));
    return turnToWorld(transform, cornersNormal(corners, at), change / dot(area, area));
}
#endif

// The surface of an object where a ray has met it at this world position.
SurfaceHit recordSurface(int object, Transform transform, RecordHit hit, vec3 position)
{
    Corners corners = recordCorners(hit.triangle);
    return SurfaceHit(position, normalToWorld(transform, cornersNormal(corners, hit.at)),
                      normalToWorld(transform, cornersArea(corners)), object
#ifdef WITH_FOOTPRINT
                      , cornersTurn(transform, corners, hit.at)
#endif
                      );
}
