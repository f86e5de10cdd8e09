// One level of the interval pyramid. Level 0: a texel is the cell between four columns of the cube's side,
// whose surfaces it bounds. Level k: the four texels below it.
#ifdef FIRST_LEVEL
uniform usampler2DArray u_cubeSurfaces;
uniform int u_opaque; // 1: surfaces bound no inside
uniform int u_side; // of all: three (or one) for each set of layers
#else
uniform usampler2DArray u_intervals;
uniform int u_level; // the one below
uniform int u_side; // of all: three (or one) for each set of layers
#endif

layout(location = 0) out uvec4 o_inner;
layout(location = 1) out uvec4 o_outer;
#ifdef FIRST_LEVEL
layout(location = 2) out uvec4 o_near; // `outer` of the cell's own four columns
layout(location = 3) out uint o_column; // of the 4 x 4 about the cell the nearest with a surface
#endif

#ifdef FIRST_LEVEL
// What a surface may bulge between its samples, in steps of stored depth.
const float MARGIN = 2.0;

// The column's surfaces as intervals. A surface that enters the glass while inside, or leaves it while
// outside (meshes that overlap themselves), parts intervals without changing the state.
void readColumn(ivec2 texel, out vec4 inner, out vec4 outer)
{
    inner = NO_INNER;
    Union u = EMPTY;
    bool inside = false;
    float start = 0.0;
    int groups = (u_cube.y + 3) / 4;
    for (int group = 0; group < groups; ++group) {
        uvec4 surfaces = texelFetch(u_cubeSurfaces, ivec3(texel, u_side * groups + group), 0);
        for (int i = 0; i < 4; ++i) {
            if (surfaces[i] == VT_CUBE_NONE) {
                continue;
            }
            float depth = float(surfaces[i] >> 1);
            if (u_opaque != 0) { // a sheet: nothing is known but where its first and last surface lie
                u = addInterval(u, vec2(max(depth - MARGIN, 0.0), depth + MARGIN));
                continue;
            }
            bool leaving = (surfaces[i] & 1u) != 0u;
            if (inside) {
                inner = keepLongest(inner, vec2(start + MARGIN, depth - MARGIN));
            }
            if (leaving) {
                u = addInterval(u, vec2(max((inside ? start : depth) - MARGIN, 0.0), depth + MARGIN));
            } else if (inside) {
                u = addInterval(u, vec2(max(start - MARGIN, 0.0), depth + MARGIN));
            }
            inside = !leaving;
            start = depth;
        }
    }
    if (inside) { // more surfaces than layers
        inner = keepLongest(inner, vec2(start + MARGIN, VT_CUBE_DEPTH));
        u = addInterval(u, vec2(max(start - MARGIN, 0.0), VT_CUBE_DEPTH));
    }
    outer = unionIntervals(u);
}
#endif

#ifdef FIRST_LEVEL
void main()
{
    ivec2 cell = ivec2(gl_FragCoord.xy);
    vec4 inner = vec4(0.0, NONE, NONE, 0.0), outer = NO_OUTER, near = NO_OUTER;
    float nearest = 1e9;
    o_column = 0u;
    // Silhouettes run between columns: what lies one column further may reach into the cell.
    for (int i = 0; i < 16; ++i) {
        ivec2 step = ivec2(i & 3, i >> 2) - 1;
        vec4 nextInner, nextOuter;
        readColumn(clamp(cell + step, ivec2(0), ivec2(u_cube.x - 1)), nextInner, nextOuter);
        outer = joinOuter(outer, nextOuter);
        vec2 apart = vec2(step) - 0.5;
        float distance = dot(apart, apart);
        if (distance < 1.0) {
            inner = meetInner(inner, nextInner);
            near = joinOuter(near, nextOuter);
        }
        if (nextOuter.x < NONE && distance < nearest) {
            nearest = distance;
            o_column = uint(i);
        }
    }
    if (u_opaque != 0) { // what joins the columns' surfaces lies anywhere between them
        outer = closeGap(outer);
        near = closeGap(near);
    }
    o_inner = uvec4(inner);
    o_outer = uvec4(outer);
    o_near = uvec4(near);
}
#else
void main()
{
    vec4 inner = vec4(0.0, NONE, NONE, 0.0), outer = NO_OUTER;
    for (int i = 0; i < 4; ++i) {
        ivec2 below = tileTexel(2 * ivec2(gl_FragCoord.xy) + ivec2(i & 1, i >> 1), u_level);
        inner = meetInner(inner, vec4(texelFetch(u_intervals, ivec3(below, 3 * u_side), 0)));
        outer = joinOuter(outer, vec4(texelFetch(u_intervals, ivec3(below, 3 * u_side + 1), 0)));
    }
    o_inner = uvec4(inner);
    o_outer = uvec4(outer);
}
#endif
