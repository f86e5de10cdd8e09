// This work is based on:
//   Zhen-Qian Weng. Direct rendering of height fields (report): rays and cells are kept apart by the box, by the ray's
//   shadow in two dimensions, then by depth; two triangles a cell; the normal (1 - u - v) N0 + u N1 + v N2. A depth layer
//   is such a height field.
//   F. Kenton Musgrave. Grid tracing: fast ray tracing for height fields. Yale University, 1988: the walk along the shadow.
//   Tomas Möller, Ben Trumbore. Fast, minimum storage ray/triangle intersection. Journal of Graphics Tools, 1997: the
//   weights of the corners.
//   Shi-Hao Wang, Ming-Te Chi. Image Space Real-time Multi-refraction Technology. National Chengchi University, 2014: the
//   layers, and what a fault in them is.
// Departures:
// - The height fields are seen from a point. Where one over the depth (nearness) takes the place of depth, what is straight
//   or flat in the world is so over columns and rows, too. Rays and triangles meet there: one linear equation, not three.
// - A cell is not kept apart by its least and greatest depth, but by the sides that the ray is on where it enters and where
//   it leaves: one layer changed is one triangle met. Each such place lies on the edge between two cells and is asked
//   once for both, so that no ray slips through between them. A ray that goes through a layer and back within a cell
//   does not meet it. This takes half the reads of the depths of all corners, and fewer cells are looked into.
// - All layers are walked at once, four to a texel, and the first triangle met counts.
// - A triangle counts only if the ray leaves the glass (inside) or enters it (outside) through it: layers face the eye in
//   turns. Corners whose depths jump are a fault, not a triangle. There the nearest texel counts, and where columns of
//   layers say that the glass ends the ray has met a wall: a hit, not a loss.
// - Corners beyond an edge of the object have no part in the normal.

const float STEEPEST = 16.0;  // sides of a texel: depths of neighbours farther apart are a fault; 8 and 32 find less
const float EMPTY_DEPTH = 8.0; // far depths: where a layer without a surface lies, behind everything
const float ROUNDING = 2e-6;  // of a nearness: a ray that starts so close to a surface may meet it
const float SAME_SIDE = 0.8;  // cosine between normals on the same side of an edge
const float NOT_MET = 2.0;    // on the walk, which ends at 1

// The part of a ray that is walked: (column, row, nearness), columns and rows counted from the first texel's centre.
// Places on it are numbers from 0 to 1.
struct Walk {
    vec3 start, way;
    ivec2 cell, next;   // by their first texels
    float enter, leave; // the cell
    float end;
    float jump;         // of depths that is a fault, times nearness
    bool stop;          // at the next cell
    int behind;         // a bit a layer: the ray is behind it where it leaves the cell
    int met;            // a bit a layer: the ray changes its side in the cell, the right way
};

float layerScale(Layers layers)
{
    return 1.0 / (VT_DEPTH_SCALE * layers.depths.z);
}

vec4 fourDepths(Layers layers, ivec2 texel, int group)
{
    vec4 stored = groupDepths(layers, texel, group);
    stored *= mix(vec4(1.0), vec4(EMPTY_DEPTH), greaterThan(stored, vec4(VT_DEPTH_SCALE)));
    return layers.depths.x + stored * layerScale(layers);
}

// The layers that a point between two texels lies behind. Both sides are multiplied by the depths of both.
int behindEdge(Layers layers, ivec2 first, ivec2 second, float share, float nearness, float jump)
{
    int behind = 0, group = 0;
    float nearest = step(0.5, share);
    do {
        vec4 a = fourDepths(layers, first, group), b = fourDepths(layers, second, group);
        vec4 shares = mix(vec4(share), vec4(nearest), step(jump, abs(a - b)));
        behind += bitsOf(lessThan(a * b * nearness, mix(b, a, shares)), group);
        ++group;
    } while (4 * group < u_search.x);
    return behind;
}

// Nearness at a point of a cell, of the triangle of its first, third and fourth corner (upper) or its first, second and
// fourth, from those of the corners.
vec4 onTriangle(bool upper, vec2 point, vec4 a, vec4 b, vec4 c, vec4 d)
{
    vec4 x = upper ? d - c : b - a, y = upper ? c - a : d - b;
    return a + point.x * x + point.y * y;
}

float onTriangle(bool upper, vec2 point, vec4 corners)
{
    return onTriangle(upper, point, corners.xxxx, corners.yyyy, corners.zzzz, corners.wwww).x;
}

// The layers that a point of a cell lies behind; `fault`: there is one near it.
int behindTriangles(Layers layers, ivec2 cell, vec3 point, float jump, out bool fault)
{
    int behind = 0, group = 0;
    fault = false;
    float depth = 1.0 / point.z;
    do {
        vec4 a = fourDepths(layers, cell, group), b = fourDepths(layers, cell + ivec2(1, 0), group);
        vec4 c = fourDepths(layers, cell + ivec2(0, 1), group), d = fourDepths(layers, cell + 1, group);
        vec4 least = min(min(a, b), min(c, d)), most = max(max(a, b), max(c, d));
        ivec4 around = ivec4(lessThan(least, vec4(depth))) * ivec4(greaterThan(most, vec4(depth)));
        fault = fault || around * ivec4(greaterThan(most - least, vec4(jump))) != ivec4(0);
        vec4 nearness = onTriangle(point.x < point.y, point.xy, 1.0 / a, 1.0 / b, 1.0 / c, 1.0 / d);
        behind += bitsOf(lessThan(vec4(point.z), nearness), group);
        ++group;
    } while (4 * group < u_search.x);
    return behind;
}

// Goes on to the next cell where the ray passes a layer that faces the right way; false where there is none. A loop with
// nothing else in it, as the linear steps of search_layered.glsl.
bool walkToSurface(Layers layers, inout Walk walk, bool inside, inout int cells)
{
    // Even layers face the eye: from behind them a ray leaves the glass.
    int from = inside ? 0x5555 : 0xaaaa;
    ivec2 ahead = ivec2(greaterThan(walk.way.xy, vec2(0.0)));
    vec2 inverse = 1.0 / walk.way.xy;
    bool found = false;
    while (!found && walk.leave < walk.end && cells > 0) {
        walk.enter = walk.leave;
        walk.cell = walk.next;
        // The nearer of the cell's two sides ahead.
        ivec2 far = walk.cell + ahead;
        vec2 sides = (vec2(far) - walk.start.xy) * inverse;
        bool across = sides.x < sides.y;
        walk.leave = clamp(across ? sides.x : sides.y, walk.enter, walk.end);
        walk.next += (2 * ahead - 1) * ivec2(across, !across);
        vec3 point = walk.start + walk.leave * walk.way;
        ivec2 first = across ? ivec2(far.x, walk.cell.y) : ivec2(walk.cell.x, far.y);
        float share = clamp(across ? point.y - float(first.y) : point.x - float(first.x), 0.0, 1.0);
        int behind = behindEdge(layers, first, first + ivec2(!across, across), share, point.z, walk.jump / point.z);
        walk.met = (walk.behind ^ behind) & ~(walk.behind ^ from);
        walk.behind = behind;
        found = walk.met != 0 || walk.stop;
        walk.stop = false;
        --cells;
    }
    return found;
}

struct Crossing {
    float place; // NOT_MET: none
    int layer;
    bool upper;
};

bool belongTogether(vec3 depths, float jump)
{
    return max(depths.x, max(depths.y, depths.z)) - min(depths.x, min(depths.y, depths.z)) < jump;
}

// The first triangle of the cell that the ray meets from the right side.
Crossing meetTriangles(Layers layers, Walk walk, bool inside)
{
    Crossing crossing = Crossing(NOT_MET, 0, false);
    vec3 cell = vec3(walk.cell, 0.0);
    vec3 a = walk.start + walk.enter * walk.way - cell, b = walk.start + walk.leave * walk.way - cell;
    bool upperA = a.x < a.y, upperB = b.x < b.y;
    // Where it crosses the diagonal, from the triangle where it enters to the one where it leaves.
    float share = upperA == upperB ? 1.0 : clamp((a.x - a.y) / (a.x - a.y - b.x + b.y), 0.0, 1.0);
    vec3 d = mix(a, b, share);
    float middle = mix(walk.enter, walk.leave, share);
    float slack = ROUNDING * a.z, jump = walk.jump / a.z;
    int layer = 0;
    do {
        vec4 stored;
        for (int i = 0; i < 4; ++i) {
            stored[i] = layerDepth(layers, layer, clamp(walk.cell + ivec2(i & 1, i >> 1), ivec2(0), u_size.zw - 1));
        }
        stored *= mix(vec4(1.0), vec4(EMPTY_DEPTH), greaterThan(stored, vec4(VT_DEPTH_SCALE)));
        vec4 depths = layers.depths.x + stored * layerScale(layers), n = 1.0 / depths;
        // On the side that it comes from these are positive.
        float side = (layer % 2 == 0) == inside ? 1.0 : -1.0;
        float atA = side * (onTriangle(upperA, a.xy, n) - a.z);
        float atD = side * (onTriangle(upperA, d.xy, n) - d.z);
        float fromD = side * (onTriangle(upperB, d.xy, n) - d.z);
        float atB = side * (onTriangle(upperB, b.xy, n) - b.z);
        // Where the sides have changed one of the two is met, whatever rounding says.
        bool changed = (walk.met >> layer) % 2 != 0;
        bool isFirst = changed ? atD < 0.0 : atA >= -slack && atD < -slack;
        bool isMet = isFirst || changed || (fromD >= -slack && atB < -slack);
        vec2 ends = isFirst ? vec2(atA, atD) : vec2(fromD, atB);
        vec2 places = isFirst ? vec2(walk.enter, middle) : vec2(middle, walk.leave);
        bool upper = isFirst ? upperA : upperB;
        float place = mix(places.x, places.y, clamp(ends.x / (ends.x - ends.y), 0.0, 1.0));
        if (isMet && place < crossing.place && belongTogether(upper ? depths.xzw : depths.xyw, jump)) {
            crossing.place = place;
            crossing.layer = layer;
            crossing.upper = upper;
        }
        ++layer;
    } while (layer < u_search.x);
    return crossing;
}

SurfaceHit triangleSurface(Layers layers, Walk walk, Crossing crossing, vec3 position, vec3 direction, bool inside)
{
    vec2 point = walk.start.xy + crossing.place * walk.way.xy - vec2(walk.cell);
    float nearer = min(point.x, point.y), farther = max(point.x, point.y);
    vec3 weights = max(vec3(1.0 - farther, farther - nearer, nearer), 0.0);
    vec3 corners[3], normals[3];
    for (int i = 0; i < 3; ++i) {
        ivec2 corner = i == 0 ? ivec2(0) : i == 2 ? ivec2(1) : crossing.upper ? ivec2(0, 1) : ivec2(1, 0);
        ivec2 texel = clamp(walk.cell + corner, ivec2(0), u_size.zw - 1);
        float stored = layerDepth(layers, crossing.layer, texel);
        corners[i] = layerWorldPoint(layers, texel, stored);
        normals[i] = unpackNormal(layerNormals(layers, crossing.layer, texel).x);
        weights[i] /= layers.depths.x + stored * layerScale(layers); // from columns and rows to the world
    }
    float most = max(weights.x, max(weights.y, weights.z));
    vec3 nearest = weights.x == most ? normals[0] : weights.y == most ? normals[1] : normals[2];
    vec3 normal = vec3(0.0);
    for (int i = 0; i < 3; ++i) {
        normal += dot(normals[i], nearest) < SAME_SIDE ? vec3(0.0) : weights[i] * normals[i];
    }
    // The triangle's own: those of the mesh, blended in the same way, find as much, and lose more of the diamond's rays.
    vec3 flatNormal = normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
    flatNormal *= facesRightWay(flatNormal, direction, inside) ? 1.0 : -1.0;
    return SurfaceHit(position, normalize(normal), flatNormal, 0);
}

// (column, row, stored depth) of a place.
vec3 pointAt(Layers layers, Walk walk, float place)
{
    vec3 point = walk.start + place * walk.way;
    return vec3(point.xy + 0.5, (1.0 / point.z - layers.depths.x) / layerScale(layers));
}

// The first surface of the layers that a ray meets before it has gone `farthest`. `start`: whether it starts on one of
// them; else it is searched from where it enters their box. False where it meets none.
bool searchLayers(Layers layers, vec3 origin, vec3 direction, bool inside, bool start, float farthest, out SurfaceHit hit)
{
    vec2 span = boxSpan(layers, origin, direction);
    span.x = start ? 0.0 : span.x;
    span.y = min(span.y, farthest);
    LayerRay ray = makeLayerRay(layers, origin, direction);
    // What lies behind the eye has no column; nothing is nearer than half the nearest depth.
    float nearest = (0.5 * layers.depths.x - ray.origin.z) / ray.direction.z;
    span.x = ray.direction.z > 0.0 ? max(span.x, nearest) : span.x;
    span.y = ray.direction.z < 0.0 ? min(span.y, nearest) : span.y;
    if (!(span.x < span.y)) {
        return false;
    }
    vec3 a = ray.origin + span.x * ray.direction, b = ray.origin + span.y * ray.direction;
    Walk walk;
    walk.start = vec3(a.xy / a.z - 0.5, 1.0 / a.z);
    walk.way = vec3(b.xy / b.z - 0.5, 1.0 / b.z) - walk.start;
    walk.way.x = abs(walk.way.x) < 1e-6 ? 1e-6 : walk.way.x;
    walk.way.y = abs(walk.way.y) < 1e-6 ? 1e-6 : walk.way.y;
    vec2 low = (vec2(-1.0) - walk.start.xy) / walk.way.xy, high = (vec2(u_size.zw) - walk.start.xy) / walk.way.xy;
    vec2 enter = min(low, high), leave = max(low, high);
    walk.leave = max(max(enter.x, enter.y), 0.0);
    walk.end = min(min(leave.x, leave.y), 1.0);
    vec3 first = walk.start + walk.leave * walk.way;
    walk.next = ivec2(floor(first.xy));
    vec2 texel = (layers.frustum.zw - layers.frustum.xy) / vec2(u_size.zw);
    walk.jump = STEEPEST * max(texel.x, texel.y);
    // A ray that starts at a fault may come through it at once.
    bool fault;
    walk.behind = behindTriangles(layers, walk.next, first - vec3(walk.next, 0.0), walk.jump / first.z, fault);
    walk.stop = start && fault;

    int cells = u_size.z + u_size.w + 4; // a straight line crosses no more
    while (walkToSurface(layers, walk, inside, cells)) {
        Crossing crossing = meetTriangles(layers, walk, inside);
        bool isMet = crossing.place < NOT_MET;
        float place = isMet ? crossing.place : 0.5 * (walk.enter + walk.leave);
        // Even steps on the walk are not even in the world.
        float share = place * a.z / mix(b.z, a.z, place);
        vec3 position = origin + mix(span.x, span.y, share) * direction;
        vec3 before = pointAt(layers, walk, walk.enter), after = pointAt(layers, walk, walk.leave);
        Column beforeColumn, afterColumn;
        int continuous;
        readColumns(layers, before, after, 0.0, beforeColumn, afterColumn, continuous);
        vec3 normal;
        bool isWall = inside ? wallBetween(layers, before, beforeColumn, afterColumn, direction, inside, normal)
                             : wallBetween(layers, after, afterColumn, beforeColumn, direction, inside, normal);
        if (isMet || isWall) {
            hit = SurfaceHit(position, normal, normal, 0);
            if (isMet) { // WebGL's ?: takes no structures
                hit = triangleSurface(layers, walk, crossing, position, direction, inside);
            }
            return true;
        }
    }
    return false;
}
