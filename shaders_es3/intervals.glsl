// Depth intervals, two to a texel: (start, end, start, end).
// `inner`: within them every column below is inside the glass; the two longest are kept. None: start > end.
// `outer`: outside them every column below is outside; the widest gap parts them. None: both ends NONE.
const float NONE = 65535.0;
const vec4 NO_INNER = vec4(NONE, 0.0, NONE, 0.0);
const vec4 NO_OUTER = vec4(NONE);

vec4 keepLongest(vec4 kept, vec2 interval)
{
    float size = interval.y - interval.x;
    float first = kept.y - kept.x, second = kept.w - kept.z;
    if (size <= min(first, second) || size < 0.0) {
        return kept;
    }
    return first < second ? vec4(interval, kept.zw) : vec4(kept.xy, interval);
}

vec2 meet(vec2 a, vec2 b)
{
    return vec2(max(a.x, b.x), min(a.y, b.y));
}

vec4 meetInner(vec4 a, vec4 b)
{
    vec4 kept = keepLongest(NO_INNER, meet(a.xy, b.xy));
    kept = keepLongest(kept, meet(a.xy, b.zw));
    kept = keepLongest(kept, meet(a.zw, b.xy));
    kept = keepLongest(kept, meet(a.zw, b.zw));
    return kept.z < kept.x ? kept.zwxy : kept; // the nearer one first
}

// Intervals come in the order of their starts; `gap` parts them where it is widest.
struct Union {
    float start, end;
    vec2 gap;
};

const Union EMPTY = Union(NONE, -1.0, vec2(0.0));

Union addInterval(Union u, vec2 interval)
{
    if (interval.x >= NONE) {
        return u;
    }
    float gap = interval.x - u.end;
    if (u.end >= 0.0 && gap > u.gap.y - u.gap.x) {
        u.gap = vec2(u.end, interval.x);
    }
    u.start = min(u.start, interval.x);
    u.end = max(u.end, interval.y);
    return u;
}

vec4 unionIntervals(Union u)
{
    if (u.end < 0.0) {
        return NO_OUTER;
    }
    return u.gap.y > u.gap.x ? vec4(u.start, u.gap.x, u.gap.y, u.end) : vec4(u.start, u.end, NONE, NONE);
}

vec4 joinOuter(vec4 a, vec4 b)
{
    // Merging two sorted pairs: the lesser of the starts first, the greater of the second starts last.
    bool swap = b.x < a.x;
    vec4 first = swap ? b : a, second = swap ? a : b;
    bool crossed = second.x > first.z; // the whole of `first` lies before `second`
    Union u = addInterval(EMPTY, first.xy);
    u = addInterval(u, crossed ? first.zw : second.xy);
    vec2 third = crossed ? second.xy : (first.z < second.z ? first.zw : second.zw);
    u = addInterval(u, third);
    u = addInterval(u, crossed || first.z < second.z ? second.zw : first.zw);
    return unionIntervals(u);
}

// Both intervals and what lies between them.
vec4 closeGap(vec4 outer)
{
    return outer.z < NONE ? vec4(outer.x, outer.w, NONE, NONE) : outer;
}
