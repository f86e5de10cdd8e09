// This work is based on: see src/passes/cube.c.
uniform usampler2DArray u_cubeSurfaces;  // four layers a texel
uniform usampler2DArray u_cubeTriangles; // of those surfaces
uniform usampler2DArray u_intervals;     // pyramid of inner (even) and outer (odd) intervals of each side

const int MOST_WALK = 16; // triangles
const float SLACK = 4.0; // cells
const float WINDOW = 4.0; // cells
const float REACH = 8.0; // cells

// A ray as one side of the cube sees it: (column, row, depth), in cells between texel centres and steps of
// stored depth.
struct CubeRay {
    vec3 origin;
    vec3 direction;
    vec3 inverse;
    float end; // parameter where it leaves the side
    float perspective; // a world distance t is the parameter t / (1 + perspective t)
    int axis;
};

CubeRay makeCubeRay(vec3 origin, vec3 direction, int axis)
{
    // A projective map keeps lines straight, so one formula serves both kinds of layers.
    vec4 a = u_cubeMatrix * vec4(origin, 1.0);
    vec4 b = u_cubeMatrix * vec4(direction, 0.0);
    vec3 scale = vec3(vec2(u_cube.x), VT_CUBE_DEPTH);
    CubeRay ray;
    ray.axis = axis;
    ray.perspective = b.w / a.w;
    ray.origin = alongAxis(a.xyz / a.w, axis) * scale - vec3(0.5, 0.5, 0.0);
    ray.direction = alongAxis((b.xyz * a.w - a.xyz * b.w) / (a.w * a.w), axis) * scale;
    // Nothing is parallel to a cell's side: a million times the cube's size away is far enough.
    vec3 least = 1e-6 * scale;
    ray.direction = mix(ray.direction, least, lessThan(abs(ray.direction), least * 1e-2));
    ray.inverse = 1.0 / ray.direction;
    vec3 far = vec3(vec2(u_cube.x - 1), VT_CUBE_DEPTH);
    vec3 leave = (mix(vec3(0.0), far, greaterThan(ray.direction, vec3(0.0))) - ray.origin) * ray.inverse;
    ray.end = min(leave.x, min(leave.y, leave.z));
    return ray;
}

struct TriangleHit {
    vec3 weights;
    uint triangle;
};

// From a triangle near the ray over its neighbours to the one that the ray meets: across the edge beyond
// which the ray's point in the triangle's plane lies. False where the walk turns back, or ends at a triangle
// that the ray meets from the wrong side or behind its origin.
bool walkToHit(uint triangle, vec3 origin, vec3 direction, bool inside, float nearest, float farthest, float perspective, out TriangleHit hit)
{
    uint previous = VT_NO_TRIANGLE;
    for (int i = 0; i < MOST_WALK; ++i) {
        uvec4 a = triangleTexel(triangle, 0), b = triangleTexel(triangle, 1), c = triangleTexel(triangle, 2);
        vec3 A = uintBitsToFloat(a.xyz) - origin, B = uintBitsToFloat(b.xyz) - origin;
        vec3 C = uintBitsToFloat(c.xyz) - origin;
        // Volumes that the ray spans with the edges; their sum has the sign of normal . direction.
        vec3 w = vec3(dot(cross(B, C), direction), dot(cross(C, A), direction), dot(cross(A, B), direction));
        float sum = w.x + w.y + w.z;
        vec3 s = sum < 0.0 ? -w : w;
        float least = min(s.x, min(s.y, s.z));
        if (least >= 0.0) {
            hit = TriangleHit(w / sum, triangle);
            float t = dot(w.x * A + w.y * B + w.z * C, direction) / sum;
            return (sum > 0.0) == inside && sum != 0.0 && t > nearest && t < farthest * (1.0 + perspective * t);
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

// The column's surface nearest to depth z0, not farther than `before` ahead of it or `behind`, among those that
// a ray meets on its way out of (wanted = 1) or into the glass (0), or among all (2). -1: none.
int nearestSurface(ivec2 texel, int axis, float z0, float before, float behind, bool mirrored, uint wanted)
{
    int groups = (u_cube.y + 3) / 4;
    float nearest = 1e9;
    int best = -1;
    for (int group = 0; group < groups; ++group) {
        uvec4 surfaces = texelFetch(u_cubeSurfaces, ivec3(texel, axis * groups + group), 0);
        vec4 depths = vec4(surfaces >> 1u);
        vec4 along = (mirrored ? VT_CUBE_DEPTH - depths : depths) - z0;
        bvec4 kind = equal(surfaces & 1u, uvec4(wanted));
        for (int i = 0; i < 4; ++i) {
            bool fits = (kind[i] || wanted == 2u) && surfaces[i] != VT_CUBE_NONE;
            bool better = fits && along[i] > -before && along[i] < behind && abs(along[i]) < nearest;
            nearest = better ? abs(along[i]) : nearest;
            best = better ? 4 * group + i : best;
        }
    }
    return best;
}

// Intervals as a ray sees them whose depth grows.
vec4 orient(vec4 b, bool mirrored)
{
    return mirrored ? VT_CUBE_DEPTH - b.wzyx : b;
}

// The surface that a ray starts on is no obstacle: `start` is a depth up to which intervals may begin (inside),
// or end (outside), behind the ray's.
bool isFree(vec4 b, float low, float high, float start, bool inside)
{
    float relaxed = max(low, start);
    bool inner = (high <= b.y && relaxed >= b.x) || (high <= b.w && (low > b.y ? relaxed : low) >= b.z);
    bool outer = high < b.x || (high < b.z && (low > b.x ? relaxed : low) > b.y) || (low > b.z ? relaxed : low) > b.w;
    return inside ? inner : outer;
}

// Where a search stands on one side of the cube.
struct Search {
    CubeRay ray;
    bool mirrored; // depth falls along the ray; all depths below are turned to grow
    float originZ, slopeZ;
    float start; // a surface up to this depth may be the one that the ray starts on
    ivec2 positive;
    int slice;
    ivec2 cell;
    int level;
};

Search startSearch(vec3 origin, vec3 direction, bool inside, int axis)
{
    Search s;
    s.ray = makeCubeRay(origin, direction, axis);
    s.mirrored = s.ray.direction.z < 0.0;
    s.originZ = s.mirrored ? VT_CUBE_DEPTH - s.ray.origin.z : s.ray.origin.z;
    s.slopeZ = abs(s.ray.direction.z);
    s.start = s.originZ + SLACK * VT_CUBE_DEPTH / float(u_cube.x);
    s.positive = ivec2(greaterThan(s.ray.direction.xy, vec2(0.0)));
    s.slice = 2 * axis + (inside ? 0 : 1);
    s.cell = clamp(ivec2(floor(s.ray.origin.xy)), ivec2(0), ivec2(u_cube.x - 2));
    s.level = 0;
    return s;
}

int mainAxis(vec3 direction)
{
    vec3 d = abs(mat3(u_cubeMatrix) * direction * u_cubeExtent.xyz);
    return u_cube.z == 1 ? 0 : d.x > d.y && d.x > d.z ? 0 : d.y > d.z ? 1 : 2;
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

// Follows the path from the first surface on. Gives the last direction.
vec3 tracePath(SurfaceHit hit, vec3 direction, out int status, out int events, out bool anyReflected)
{
    bool inside = dot(hit.flatNormal, direction) > 0.0; // an eye within the glass sees its back faces
    float nearest = 1e-5 * u_cubeExtent.w;
    float cellDepth = VT_CUBE_DEPTH / float(u_cube.x);
    int groups = (u_cube.y + 3) / 4;
    int rescue = 0;
    int axis = 0, tried = 0, steps = 0;
    bool met = true, restart = true;
    Search s;
    events = 0;
    anyReflected = false;
    status = VT_PATH_LOST;
    for (int leaf = 0; leaf < 256; ++leaf) {
        if (met) {
            bool reflected;
            bool last = events >= u_search.w;
            if (last) {
                break;
            }
            direction = meetSurface(direction, hit.normal, hit.flatNormal, u_optics.x, inside, reflected);
            anyReflected = anyReflected || reflected;
            ++events;
            if (inside && events >= u_search.w) {
                break;
            }
            axis = mainAxis(direction);
            tried = 0;
            met = false;
            restart = true;
        }
        if (restart) {
            s = startSearch(hit.position, direction, inside, axis);
            restart = false;
            steps = u_search.y;
        }
        float t0, t1, z0, z1;
        vec2 bounds, exits;
        bool free;
        while (true) {
            // The tile's far sides, and where the ray came into the cell: from the cell alone, so that every
            // way here gives the same numbers.
            ivec2 tile = s.cell >> s.level;
            vec4 b = orient(vec4(texelFetch(u_intervals, ivec3(tileTexel(tile, s.level), s.slice), 0)), s.mirrored);
            bounds = vec2((tile + s.positive) << s.level);
            exits = (bounds - s.ray.origin.xy) * s.ray.inverse.xy;
            vec2 enters = (vec2(s.cell + 1 - s.positive) - s.ray.origin.xy) * s.ray.inverse.xy;
            t0 = max(max(enters.x, enters.y), 0.0);
            t1 = min(exits.x, exits.y);
            z0 = s.originZ + t0 * s.slopeZ;
            z1 = s.originZ + min(t1, s.ray.end) * s.slopeZ;
            // Only cells let a ray off the surface it starts on: what a tile allows, all cells below must allow.
            free = isFree(b, z0, z1, s.level == 0 ? s.start : 0.0, inside);
            if ((free ? t1 >= s.ray.end : s.level == 0) || --steps < 0) {
                break;
            }
            // Into the next tile, or down. Along the side that is crossed, the cell is the one that a walk
            // from cell to cell would come to, by the same numbers, columns before rows where they tie.
            bool across = exits.x <= exits.y;
            vec3 other = across ? vec3(s.ray.origin.y, s.ray.direction.y, s.ray.inverse.y)
                                : vec3(s.ray.origin.x, s.ray.direction.x, s.ray.inverse.x);
            int ahead = across ? s.positive.y : s.positive.x;
            float side = floor(other.x + t1 * other.y);
            float enter = (side + float(1 - ahead) - other.x) * other.z, leave = (side + float(ahead) - other.x) * other.z;
            float back = (across ? enter >= t1 : enter > t1) ? 1.0 : 0.0;
            float on = (across ? leave < t1 : leave <= t1) ? 1.0 : 0.0;
            int along = int(side) + int(on - back) * (2 * ahead - 1);
            ivec2 corner = tile << s.level;
            ivec2 next = clamp(ivec2(along), corner, corner + (1 << s.level) - 1);
            ivec2 beyond = ivec2(bounds) - 1 + s.positive;
            next = across ? ivec2(beyond.x, next.y) : ivec2(next.x, beyond.y);
            // Up only out of the tile above: the way down was there for a reason.
            int up = (next >> (s.level + 1)) == (s.cell >> (s.level + 1)) ? s.level : min(s.level + 1, u_cube.w);
            s.cell = free ? next : s.cell;
            s.level = free ? up : s.level - 1;
        }
        if (steps < 0) {
            break;
        }
        bool found = false;
        TriangleHit meeting;
        if (!free) {
            // A rescue tries the cell's four columns and all their surfaces.
            bool wide = rescue > 0;
            vec2 middle = s.ray.origin.xy + 0.5 * (t0 + min(t1, s.ray.end)) * s.ray.direction.xy;
            ivec2 corner = s.cell + ivec2((rescue - 1) & 1, (rescue - 1) >> 1);
            ivec2 texel = wide ? corner : ivec2(floor(middle + 0.5));
            uint wanted = wide ? 2u : inside != s.mirrored ? 1u : 0u;
            float window = wide ? 1e9 : WINDOW * cellDepth;
            int surface = nearestSurface(texel, s.ray.axis, z0, window, z1 - z0 + window, s.mirrored, wanted);
            if (surface >= 0) {
                uint triangle = texelFetch(u_cubeTriangles, ivec3(texel, s.ray.axis * groups + surface / 4), 0)[surface % 4];
                float farthest = min(t1, s.ray.end) + REACH * cellDepth / s.slopeZ;
                found = walkToHit(triangle, hit.position, direction, inside, nearest, farthest, s.ray.perspective, meeting);
            }
        }
        if (found) {
            hit = surfaceAt(meeting);
            met = true;
            rescue = 0;
            continue;
        }
        // Has it come out, or in, unnoticed?
        bool over = t1 >= s.ray.end;
        vec4 b = orient(vec4(texelFetch(u_intervals, ivec3(s.cell, s.slice ^ 1), 0)), s.mirrored);
        bool doubtful = inside && over || !free && isFree(b, z0, z1, 0.0, !inside);
        if (over && !doubtful) {
            status = VT_PATH_EXITED;
            break;
        }
        if (doubtful && !over && rescue < (u_cube.z == 1 ? 4 : 0)) {
            ++rescue;
            continue;
        }
        rescue = 0;
        if (doubtful) {
            if (++tried == u_cube.z) {
                break;
            }
            axis = axis == 2 ? 0 : axis + 1;
            restart = true;
        }
        s.cell += exits.x <= exits.y ? ivec2(2 * s.positive.x - 1, 0) : ivec2(0, 2 * s.positive.y - 1);
    }
    return direction;
}
