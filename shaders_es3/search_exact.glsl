// The search of technique `exact` through one side of the layered depth cube (src/passes/cube.h). It is based
// on:
//   Art Tevs, Ivo Ihrke, Hans-Peter Seidel. Maximum Mipmaps for Fast, Accurate, and Scalable Dynamic Height
//   Field Rendering. I3D 2008; and Nikolai Hofmann, Phillip Bogendoerfer, Marc Stamminger, Kai Selgrad.
//   Hierarchical Multi-Layer Screen-Space Ray Tracing. HPG 2017: a ray's way over pixels in steps as wide as
//   a pyramid allows;
//   Sven Widmer et al. An Adaptive Acceleration Structure for Screen-space Ray Tracing. HPG 2015, and
//   Konstantinos Vardis, Andreas Vasilakis, Georgios Papaioannou. DIRT: Deferred Image-based Ray Tracing.
//   HPG 2016: images whose pixels know primitives;
//   Manuel M. Oliveira, Maicon Brauwers 2007 and Wang & Chi 2014 (search_layered.glsl): what is searched for.
// Departures:
// - The pyramid holds intervals of depth rather than extremes of each layer: `inner` ones, within which every
//   column is inside the glass, for rays inside; `outer` ones, beyond which every column is outside, for rays
//   outside. A surface that changes its layer from pixel to pixel does not matter to them.
// - A cell lies between four columns, as in a height field; the surfaces between the samples lie between
//   theirs.
// - The triangle of a pixel only starts a walk over the mesh (walk_mesh.glsl), which ends at the triangle that
//   the ray meets. A cube of 64 texels a side finds nearly as many hits as one of 512.
// - One loop follows the whole path; a round of it ends at the next cell with a surface. A pixel that is ready
//   for its next event does not wait for its neighbours', which software renderers and GPUs would make it do.
#define WITH_LAYERS
uniform usampler2DArray u_cubeSurfaces;  // four layers a texel
uniform usampler2DArray u_cubeTriangles; // of those surfaces
uniform usampler2DArray u_cubeColumns;   // for each cell a column about it that has a surface
uniform usampler2DArray u_intervals;     // of each side three slices, below

const int INNER = 0, OUTER = 1; // pyramids
const int NEAR = 2;             // cells only: the outer intervals of their own four columns

// In cells; from trials with the bunny, the cow, the knot and the torus at 64 to 512 texels a side.
// Depth within which a surface may be the one that the ray starts on; outside, where intervals are wider, more.
const float START_INSIDE = 4.0, START_OUTSIDE = 8.0;
const float WINDOW = 4.0; // depth about the ray within which a cell's surface is tried
const float REACH = 8.0;  // depth beyond the cell up to which a walk may end

// Of the mesh's size: distance from which surfaces count.
const float START = 1e-5;

// A ray as one side sees it: (column, row, depth), in cells between texel centres and steps of stored depth.
// Depth grows along it: mirrored where it would not.
struct CubeRay {
    vec2 origin, direction, inverse;
    float originZ, slopeZ;
    float start, end;  // parameters where it comes into the side and leaves it
    float perspective; // a distance t in the world is the parameter t / (1 + perspective t)
    bool mirrored;
    bool isCut; // it ends before it leaves the side
};

// The axis that a direction (cube's coordinates) is nearest to.
int mainAxis(vec3 direction, vec3 extent)
{
    vec3 d = abs(direction * extent);
    return u_cube.z == 1 ? 0 : d.x > d.y && d.x > d.z ? 0 : d.y > d.z ? 1 : 2;
}

// A projective map keeps lines straight, so that one formula serves the cube and layers from the eye. a, b: origin and
// direction in the layers' coordinates.
CubeRay makeCubeRay(vec4 a, vec4 b, int axis, float farthest)
{
    vec3 scale = vec3(vec2(u_cube.x), VT_CUBE_DEPTH);
    vec3 o = alongAxis(a.xyz / a.w, axis) * scale - vec3(0.5, 0.5, 0.0);
    vec3 d = alongAxis((b.xyz * a.w - a.xyz * b.w) / (a.w * a.w), axis) * scale;
    // Nothing is quite parallel to the side of a cell.
    vec3 least = 1e-6 * scale;
    d = mix(d, least, lessThan(abs(d), 0.01 * least));
    vec3 inverse = 1.0 / d;
    vec3 far = vec3(vec2(u_cube.x - 1), VT_CUBE_DEPTH);
    bvec3 grows = greaterThan(d, vec3(0.0));
    vec3 enter = (mix(far, vec3(0.0), grows) - o) * inverse, leave = (mix(vec3(0.0), far, grows) - o) * inverse;
    float perspective = b.w / a.w;
    float end = min(leave.x, min(leave.y, leave.z));
    // Nothing beyond a surface that has been met is looked for.
    float stretch = 1.0 + perspective * farthest;
    float limit = stretch > 0.0 ? farthest / stretch : end;
    bool mirrored = d.z < 0.0;
    return CubeRay(o.xy, d.xy, inverse.xy, mirrored ? VT_CUBE_DEPTH - o.z : o.z, abs(d.z),
                   max(max(enter.x, max(enter.y, enter.z)), 0.0), min(end, limit), perspective, mirrored, limit < end);
}

// Where a search stands.
struct Search {
    CubeRay ray;
    vec3 origin, direction; // in the object's coordinates; as long as in the world
    ivec2 positive; // 1 where columns, rows grow along the ray
    int side; // of all: three (or one) for each set of layers
    bool isOpaque;
    float nearest; // distance from which surfaces count
    int level; // of the pyramid
    int steps; // left
    ivec2 cell;
    bool isOver; // no surface to the side's end
};

// A tile's part of the ray. It follows from the cell alone, so that every way to the cell gives the same numbers.
struct Passage {
    vec2 exits;         // parameters at the tile's far sides
    float enter, leave; // parameters where the ray comes into the cell and leaves the tile
    float low, high;    // depths there
};

Passage passTile(Search s, ivec2 tile, int level)
{
    Passage p;
    p.exits = (vec2((tile + s.positive) << level) - s.ray.origin) * s.ray.inverse;
    vec2 enters = (vec2(s.cell + 1 - s.positive) - s.ray.origin) * s.ray.inverse;
    p.enter = max(max(enters.x, enters.y), s.ray.start);
    p.leave = min(p.exits.x, p.exits.y);
    p.low = s.ray.originZ + p.enter * s.ray.slopeZ;
    p.high = s.ray.originZ + min(p.leave, s.ray.end) * s.ray.slopeZ;
    return p;
}

// `axis`: -1: the one nearest to the direction. `farthest`: distance in the world beyond which nothing is looked for.
Search startSearch(vec3 origin, vec3 direction, int object, inout int axis, float farthest, int steps)
{
    mat4 rows = mat4(objectNumbers(object, VT_OBJECT_LAYERS), objectNumbers(object, VT_OBJECT_LAYERS + 1),
                     objectNumbers(object, VT_OBJECT_LAYERS + 2), objectNumbers(object, VT_OBJECT_LAYERS + 3));
    uvec4 extent = objectBits(object, VT_OBJECT_EXTENT);
    Transform transform = readTransform(object);
    vec4 b = vec4(direction, 0.0) * rows;
    axis = axis < 0 ? mainAxis(b.xyz, uintBitsToFloat(extent.xyz)) : axis;
    Search s;
    s.ray = makeCubeRay(vec4(origin, 1.0) * rows, b, axis, farthest);
    s.origin = toObject(transform, vec4(origin, 1.0));
    s.direction = toObject(transform, vec4(direction, 0.0));
    s.positive = ivec2(greaterThan(s.ray.direction, vec2(0.0)));
    s.side = u_cube.z * int(extent.w >> 1u) + axis;
    s.isOpaque = (extent.w & 1u) != 0u;
    s.nearest = START * length(uintBitsToFloat(extent.xyz)) * inversesqrt(dot(s.direction, s.direction));
    s.level = 0;
    s.steps = steps;
    s.cell = clamp(ivec2(floor(s.ray.origin + s.ray.start * s.ray.direction)), ivec2(0), ivec2(u_cube.x - 2));
    s.isOver = s.ray.start >= s.ray.end;
    return s;
}

vec4 readIntervals(Search s, ivec2 tile, int level, int slice)
{
    vec4 b = vec4(texelFetch(u_intervals, ivec3(tileTexel(tile, level), 3 * s.side + slice), 0));
    return s.ray.mirrored ? VT_CUBE_DEPTH - b.wzyx : b;
}

// May the ray go from depth `low` to `high` between these intervals? `start`: depth up to which an interval
// that begins (inside) or ends (outside) behind the ray is that of the surface which it has just left.
bool fits(vec4 b, float low, float high, float start, bool inside)
{
    float late = max(low, start);
    bool within = (high <= b.y && late >= b.x) || (high <= b.w && (low > b.y ? late : low) >= b.z);
    bool between = high < b.x || (high < b.z && (low > b.x ? late : low) > b.y) || (low > b.z ? late : low) > b.w;
    return inside ? within : between;
}

// From tile to tile to the next cell that is not free, or to the side's end. Nothing else stands in this loop:
// software renderers pay for every branch inside a loop at every step.
void walkTiles(inout Search s, bool inside)
{
    float start = s.ray.originZ + (inside ? START_INSIDE : START_OUTSIDE) * VT_CUBE_DEPTH / float(u_cube.x);
    while (!s.isOver) {
        ivec2 tile = s.cell >> s.level;
        vec4 b = readIntervals(s, tile, s.level, inside ? INNER : OUTER);
        Passage p = passTile(s, tile, s.level);
        // Only cells let a ray off the surface it starts on: what a tile allows, all cells below must allow.
        bool isFree = fits(b, p.low, p.high, s.level == 0 ? start : 0.0, inside);
        s.isOver = isFree && p.leave >= s.ray.end;
        if (s.isOver || (!isFree && s.level == 0) || --s.steps < 0) {
            return;
        }
        // Into the next tile, or down.
        ivec2 next = cellBeyond(s.ray.origin, s.ray.direction, s.ray.inverse, s.positive, tile, s.level, p.exits, p.leave);
        // Up only out of the tile above: the way down was there for a reason.
        bool leavesAbove = (next >> (s.level + 1)) != (s.cell >> (s.level + 1));
        int up = leavesAbove ? min(s.level + 1, u_cube.w) : s.level;
        s.cell = isFree ? next : s.cell;
        s.level = isFree ? up : s.level - 1;
    }
}

const uint ENTERING = 0u, LEAVING = 1u, ANY = 2u;
const int NO_SURFACE = -1, NO_GLASS = -2;

// The column's surface of a kind whose depth is nearest to where the ray enters the cell, from `window` before
// that to `window` beyond the cell. NO_SURFACE: none of these; NO_GLASS: the column has none at all.
int nearestSurface(Search s, Passage p, ivec2 texel, float window, uint kind)
{
    int groups = (u_cube.y + 3) / 4;
    float nearest = 1e9;
    int best = NO_SURFACE;
    for (int group = 0; group < groups; ++group) {
        uvec4 surfaces = texelFetch(u_cubeSurfaces, ivec3(texel, s.side * groups + group), 0);
        best = surfaces.x == VT_CUBE_NONE && group == 0 ? NO_GLASS : best;
        vec4 depths = vec4(surfaces >> 1u);
        vec4 along = (s.ray.mirrored ? VT_CUBE_DEPTH - depths : depths) - p.low;
        bvec4 isKind = equal(surfaces & 1u, uvec4(kind));
        for (int i = 0; i < 4; ++i) {
            bool candidate = (isKind[i] || kind == ANY) && surfaces[i] != VT_CUBE_NONE;
            bool better = candidate && along[i] > -window && along[i] < p.high - p.low + window && abs(along[i]) < nearest;
            nearest = better ? abs(along[i]) : nearest;
            best = better ? 4 * group + i : best;
        }
    }
    return best;
}

// Does a triangle near the cell lie in the ray's way? attempt 0: one of the column nearest to the ray, of the
// kind that the ray looks for; 1: one of the nearest column that has any; 2 to 5: of any kind in the cell's
// four columns. `meeting` changes only where it does.
bool tryCell(Search s, Passage p, bool inside, int attempt, inout Meeting meeting, out bool isEmpty)
{
    float cellDepth = VT_CUBE_DEPTH / float(u_cube.x);
    bool wide = attempt > 1;
    vec2 middle = s.ray.origin + 0.5 * (p.enter + min(p.leave, s.ray.end)) * s.ray.direction;
    int column = int(texelFetch(u_cubeColumns, ivec3(s.cell, s.side), 0).r);
    ivec2 texel = attempt == 0 ? ivec2(floor(middle + 0.5)) : s.cell + ivec2(column & 3, column >> 2) - 1;
    texel = wide ? s.cell + ivec2(attempt & 1, (attempt >> 1) - 1) : texel;
    uint kind = wide || s.isOpaque ? ANY : inside != s.ray.mirrored ? LEAVING : ENTERING;
    int surface = nearestSurface(s, p, texel, wide ? 1e9 : WINDOW * cellDepth, kind);
    isEmpty = surface == NO_GLASS;
    if (surface < 0) {
        return false;
    }
    int groups = (u_cube.y + 3) / 4;
    uint triangle = texelFetch(u_cubeTriangles, ivec3(texel, s.side * groups + surface / 4), 0)[surface % 4];
    triangle = walkToLine(triangle, s.origin, s.direction);
    if (triangle == VT_NO_TRIANGLE) {
        return false;
    }
    float farthest = min(p.leave, s.ray.end) + REACH * cellDepth / s.ray.slopeZ;
    // From the parameter back to the world; where it has no end there, neither has the walk.
    float stretch = 1.0 - s.ray.perspective * farthest;
    farthest = stretch > 0.0 ? farthest / stretch : 1e30;
    float distance = distanceTo(triangle, s.origin, s.direction, inside, s.isOpaque);
    bool isMet = distance > s.nearest && distance < farthest;
    meeting.distance = isMet ? distance : meeting.distance;
    meeting.triangle = isMet ? triangle : meeting.triangle;
    return isMet;
}

// Far more rounds than a search takes, so that no fault of the data hangs the GPU.
const int MOST_ROUNDS = 1024;

// Where a path meets an object next, its triangle VT_NO_TRIANGLE where it does not before `farthest`. False where it
// must have met it, unnoticed. isOther: the path is not on its surface now. `steps`: texels of the pyramid read.
bool searchCube(vec3 origin, vec3 direction, int object, bool inside, bool isOther, float farthest, int steps,
                  out Meeting meeting)
{
    meeting = Meeting(NOWHERE, VT_NO_TRIANGLE);
    int axis = -1;
    for (int tried = 0; tried < u_cube.z; ++tried) {
        Search s = startSearch(origin, direction, object, axis, farthest, steps);
        int attempt = 0;
        for (int round = 0; round < MOST_ROUNDS; ++round) {
            walkTiles(s, inside);
            if (s.steps < 0) {
                return false;
            }
            Passage passage = passTile(s, s.cell >> s.level, s.level);
            bool isEmpty = false;
            if (!s.isOver && tryCell(s, passage, inside, attempt, meeting, isEmpty)) {
                return true;
            }
            // A ray that has come out of the glass, or into it, without a surface has missed a wall too steep for
            // this side: more of the cell's surfaces are tried, then the next side.
            bool isOver = s.isOver || passage.leave >= s.ray.end;
            bool crossed = !s.isOver && !s.isOpaque &&
                           fits(readIntervals(s, s.cell, 0, inside ? NEAR : INNER), passage.low, passage.high, 0.0, !inside);
            if (isOver && !crossed && (!inside || s.ray.isCut)) {
                return true;
            }
            // Layers from the eye have no next side to ask; and of a ray that only grazes an object nothing tells
            // afterwards.
            bool isLast = crossed && !isOver && u_cube.z == 1;
            int attempts = isLast || (isOther && !inside) ? 5 : isEmpty && !inside ? 1 : 0;
            if (attempt < attempts) {
                ++attempt;
                continue;
            }
            if (crossed || isOver) {
                break;
            }
            attempt = 0;
            s.cell += passage.exits.x <= passage.exits.y ? ivec2(2 * s.positive.x - 1, 0) : ivec2(0, 2 * s.positive.y - 1);
        }
        axis = axis == 2 ? 0 : axis + 1;
    }
    return false;
}
