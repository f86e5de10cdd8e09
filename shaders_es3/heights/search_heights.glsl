// Relief glass by its heights alone (src/mesh/height_field.h): where a ray meets the slab next. It is based on:
//   Zhen-Qian Weng. Direct Rendering of Height Fields: a ray is kept from most cells by the box, by its shadow on the
//   grid, and by the heights that a cell lies between; two triangles a cell, normals interpolated;
//   Art Tevs, Ivo Ihrke, Hans-Peter Seidel. Maximum Mipmaps for Fast, Accurate, and Scalable Dynamic Height Field
//   Rendering. I3D 2008: the third separation for many cells at once;
//   F. Kenton Musgrave. Grid Tracing: Fast Ray Tracing for Height Fields. 1988.
// Departures:
// - Lowest heights stand beside the highest, for rays within the glass.
// - A cell's triangles are met where the ray's height above them changes its sign between the cell's sides and its
//   diagonal: at a side two cells compare the same numbers, so that no ray slips through between them, and coordinates
//   of thousands of cells lose less than in products of them.
// - The walls and the back are met where the ray comes into the box or leaves it, by its height there.
// - The finest level of the pyramid has tiles of two by two cells; a cell is looked at itself.
#define WITH_HEIGHTS
uniform sampler2D u_heights;      // z of the samples, own units
uniform sampler2D u_heightRanges; // lowest and highest z of tiles

// What stands in place of a triangle's number for the walls (low and high x, low and high y) and the back.
const uint WALLS = 0xfffffff0u, BACK = 0xfffffff4u;

// Far more tiles than a ray looks at, so that no fault of the data hangs the GPU.
const int MOST_TILES = 16384;

// Where a path meets a relief.
struct HeightHit {
    float distance; // in the world
    uint triangle;
};

bool isRelief(int object)
{
    return objectBits(object, VT_OBJECT_OWN_LOW).w != 0u;
}

// The relief's box, x and y in cells; its corner and a cell's side in own units.
struct ReliefBox {
    vec3 low, high;
    vec2 corner;
    float cell;
};

ReliefBox readRelief(int object)
{
    vec4 low = objectNumbers(object, VT_OBJECT_OWN_LOW), high = objectNumbers(object, VT_OBJECT_OWN_HIGH);
    // Higher than the highest peak, so that a ray comes to be above it before it leaves the box.
    float above = 1e-3 * (high.z - low.z);
    return ReliefBox(vec3(0.0, 0.0, low.z), vec3(textureSize(u_heights, 0) - 1, high.z + above), low.xy, high.w);
}

float heightAt(ivec2 s)
{
    return readTexel(u_heights, s, textureSize(u_heights, 0)).r;
}

// Heights at a cell's corners: its own sample, the next in x, the next in y, the opposite one.
vec4 cellHeights(ivec2 cell)
{
    return vec4(heightAt(cell), heightAt(cell + ivec2(1, 0)), heightAt(cell + ivec2(0, 1)), heightAt(cell + 1));
}

// Height of the cell's two triangles at a point of it, 0 to 1.
float triangleHeight(vec4 z, vec2 p)
{
    p = clamp(p, 0.0, 1.0);
    return p.x >= p.y ? z.x + p.x * (z.y - z.x) + p.y * (z.w - z.y) : z.x + p.y * (z.z - z.x) + p.x * (z.w - z.z);
}

float surfaceHeight(vec2 p)
{
    ivec2 cell = clamp(ivec2(floor(p)), ivec2(0), textureSize(u_heights, 0) - 2);
    return triangleHeight(cellHeights(cell), p - vec2(cell));
}

// Does the glass contain a point of the world?
bool heightsContain(int object, vec3 point)
{
    ReliefBox box = readRelief(object);
    vec3 p = toObject(readTransform(object), vec4(point, 1.0));
    p.xy = (p.xy - box.corner) / box.cell;
    bool isBeside = any(lessThan(p, box.low)) || any(greaterThan(p, box.high));
    return !isBeside && p.z <= surfaceHeight(p.xy);
}

// A ray in cells and own units of height.
struct HeightRay {
    vec3 origin, direction;
    vec2 inverse;
    ivec2 positive;
    float start, end;
};

// Parameters where it comes into a cell and leaves a tile.
vec3 passCell(HeightRay ray, ivec2 cell, ivec2 tile, int level, out vec2 exits)
{
    exits = (vec2((tile + ray.positive) << level) - ray.origin.xy) * ray.inverse;
    vec2 enters = (vec2(cell + 1 - ray.positive) - ray.origin.xy) * ray.inverse;
    float leave = min(exits.x, exits.y);
    return vec3(max(max(enters.x, enters.y), ray.start), leave, min(leave, ray.end));
}

// From tile to tile to the next cell that the surface may be met in; false where the ray has none before its end.
// Nothing else stands in this loop: software renderers pay for every branch inside a loop at every step.
bool walkHeights(HeightRay ray, inout ivec2 cell, inout int level, inout int tiles)
{
    ivec2 sides = textureSize(u_heightRanges, 0);
    int most = max(sides.x, sides.y);
    while (level > 0 && tiles > 0) {
        ivec2 tile = cell >> level;
        vec2 exits;
        vec3 way = passCell(ray, cell, tile, level, exits);
        vec2 range = texelFetch(u_heightRanges, tile, level - 1).rg;
        vec2 z = ray.origin.z + way.xz * ray.direction.z;
        bool isFree = min(z.x, z.y) > range.y || max(z.x, z.y) < range.x;
        if (isFree && way.y >= ray.end) {
            return false;
        }
        ivec2 next = cellBeyond(ray.origin.xy, ray.direction.xy, ray.inverse, ray.positive, tile, level, exits, way.y);
        // Up only out of the tile above: the way down was there for a reason.
        bool leavesAbove = (next >> (level + 1)) != (cell >> (level + 1));
        int up = leavesAbove && (1 << level) <= most ? level + 1 : level;
        cell = isFree ? next : cell;
        level = isFree ? up : level - 1;
        --tiles;
    }
    return tiles > 0;
}

// Where the ray passes through one of a cell's triangles to the other side, from `a` to `b`, heights above it there
// counted in the direction it goes: parameter, or -1.
float passThrough(float a, float b, float above, float beyond)
{
    return beyond > 0.0 && beyond > above ? mix(a, b, clamp(-above / (beyond - above), 0.0, 1.0)) : -1.0;
}

// The first of the cell's triangles that the ray passes through, upwards where it is inside, else downwards.
bool meetCell(HeightRay ray, ivec2 cell, vec3 way, bool inside, inout HeightHit hit)
{
    vec4 z = cellHeights(cell);
    vec2 o = ray.origin.xy - vec2(cell), d = ray.direction.xy;
    float middle = clamp((o.y - o.x) / (d.x - d.y), way.x, max(way.x, way.z)); // on the diagonal
    middle = d.x == d.y ? way.z : middle;
    vec3 t = vec3(way.x, middle, way.z);
    vec3 above = ray.origin.z + t * ray.direction.z -
                 vec3(triangleHeight(z, o + t.x * d), triangleHeight(z, o + t.y * d), triangleHeight(z, o + t.z * d));
    above = inside ? above : -above;
    float first = passThrough(t.x, t.y, above.x, above.y), second = passThrough(t.y, t.z, above.y, above.z);
    float met = first >= 0.0 ? first : second;
    vec2 p = o + (first >= 0.0 ? 0.5 * (t.x + t.y) : 0.5 * (t.y + t.z)) * d;
    if (met < 0.0) {
        return false;
    }
    int columns = textureSize(u_heights, 0).x - 1;
    hit = HeightHit(met, 2u * uint(cell.y * columns + cell.x) + (p.x >= p.y ? 0u : 1u));
    return true;
}

// Where a path (world) meets the relief next, its triangle VT_NO_TRIANGLE where it does not before `farthest`.
void searchHeights(vec3 origin, vec3 direction, int object, bool inside, float farthest, out HeightHit hit)
{
    hit = HeightHit(NOWHERE, VT_NO_TRIANGLE);
    ReliefBox box = readRelief(object);
    Transform transform = readTransform(object);
    vec3 o = toObject(transform, vec4(origin, 1.0)), d = toObject(transform, vec4(direction, 0.0));
    vec3 extent = vec3(box.high.xy * box.cell, box.high.z - box.low.z);
    float nearest = 1e-5 * length(extent) * inversesqrt(dot(d, d));
    o.xy = (o.xy - box.corner) / box.cell;
    d.xy /= box.cell;
    // Nothing is parallel to a side.
    d = mix(d, vec3(1e-6), lessThan(abs(d), vec3(1e-6)));
    vec3 inverse = 1.0 / d;
    vec3 a = (box.low - o) * inverse, b = (box.high - o) * inverse;
    vec3 enters = min(a, b), leaves = max(a, b);
    float enter = max(max(enters.x, enters.y), enters.z), leave = min(min(leaves.x, leaves.y), leaves.z);
    if (enter > min(leave, farthest) || (leave <= nearest && !inside)) {
        return;
    }
    ivec3 isPositive = ivec3(greaterThan(d, vec3(0.0)));
    if (!inside && enter > nearest) {
        bool isBack = enters.z == enter && isPositive.z == 1;
        bool isSide = enters.z < enter && o.z + enter * d.z <= surfaceHeight(o.xy + enter * d.xy);
        if (isBack || isSide) {
            uint wall = enters.x == enter ? uint(1 - isPositive.x) : uint(3 - isPositive.y);
            hit = HeightHit(enter, isBack ? BACK : WALLS + wall);
            return;
        }
    }
    HeightRay ray = HeightRay(o, d, inverse.xy, isPositive.xy, max(enter, 0.0), min(leave, farthest));
    ivec2 last = textureSize(u_heights, 0) - 2;
    ivec2 cell = clamp(ivec2(floor(o.xy + ray.start * d.xy)), ivec2(0), last);
    int level = 1, tiles = MOST_TILES;
    while (walkHeights(ray, cell, level, tiles)) {
        vec2 exits;
        vec3 way = passCell(ray, cell, cell, 0, exits);
        if (meetCell(ray, cell, way, inside, hit)) {
            return;
        }
        if (way.y >= ray.end) {
            break;
        }
        ivec2 next = cell + (exits.x <= exits.y ? ivec2(2 * ray.positive.x - 1, 0) : ivec2(0, 2 * ray.positive.y - 1));
        level = (next >> 1) != (cell >> 1) ? 1 : 0;
        cell = clamp(next, ivec2(0), last);
        --tiles;
    }
    if (!inside || leave >= farthest || tiles <= 0) {
        return;
    }
    if (leaves.z == leave && isPositive.z == 1) {
        return; // on its way to the box's top it must have met the front
    }
    uint wall = leaves.x == leave ? uint(isPositive.x) : 2u + uint(isPositive.y);
    hit = HeightHit(leave, leaves.z == leave ? BACK : WALLS + wall);
    return;
}

vec3 sampleNormal(ivec2 s, float cell)
{
    ivec2 last = textureSize(u_heights, 0) - 1;
    ivec2 low = max(s - 1, ivec2(0)), high = min(s + 1, last);
    vec2 rise = vec2(heightAt(ivec2(high.x, s.y)) - heightAt(ivec2(low.x, s.y)),
                     heightAt(ivec2(s.x, high.y)) - heightAt(ivec2(s.x, low.y)));
    return normalize(vec3(-rise / (vec2(high - low) * cell), 1.0));
}

// The surface where a path has met the relief, `position` (world) on it.
SurfaceHit heightsSurfaceAt(int object, uint triangle, vec3 position)
{
    ReliefBox box = readRelief(object);
    Transform transform = readTransform(object);
    vec3 normal, flatNormal;
    mat3 change = mat3(0.0); // of the normal, over own coordinates
    if (triangle >= WALLS) {
        uint wall = triangle - WALLS;
        float sign = (wall & 1u) == 0u ? -1.0 : 1.0;
        normal = wall == 4u ? vec3(0.0, 0.0, -1.0) : wall < 2u ? vec3(sign, 0.0, 0.0) : vec3(0.0, sign, 0.0);
        flatNormal = normal;
    } else {
        int columns = textureSize(u_heights, 0).x - 1, number = int(triangle >> 1u);
        ivec2 cell = ivec2(number % columns, number / columns);
        vec4 z = cellHeights(cell);
        vec2 p = (toObject(transform, vec4(position, 1.0)).xy - box.corner) / box.cell - vec2(cell);
        p = clamp(p, 0.0, 1.0);
        bool isAbove = (triangle & 1u) != 0u;
        flatNormal = vec3((isAbove ? vec2(z.z - z.w, z.x - z.z) : vec2(z.x - z.y, z.y - z.w)) / box.cell, 1.0);
        vec3 side = sampleNormal(cell + (isAbove ? ivec2(0, 1) : ivec2(1, 0)), box.cell);
        float most = isAbove ? p.y : p.x, least = isAbove ? p.x : p.y;
        vec3 low = sampleNormal(cell, box.cell), high = sampleNormal(cell + 1, box.cell);
        normal = (1.0 - most) * low + (most - least) * side + least * high;
        vec3 first = (side - low) / box.cell, second = (high - side) / box.cell;
        change = isAbove ? mat3(second, first, vec3(0.0)) : mat3(first, second, vec3(0.0));
    }
    return SurfaceHit(position, normalToWorld(transform, normal), normalToWorld(transform, flatNormal), object
#ifdef WITH_FOOTPRINT
                      , turnToWorld(transform, normal, change)
#endif
                      );
}
