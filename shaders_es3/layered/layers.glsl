// Reading the merged layers along a ray. Loops ask at their end whether they go on: software renderers run what stands
// in a loop once more, for no pixel, where it is asked before. What is read after a loop that some pixels leave sooner
// is carried on in every round (x = condition ? fresh : x): Mesa 22.3 goes on computing it for those that have left.
uniform usampler2DArray u_mergedDepths; // four layers a texel
uniform usampler2DArray u_layerNormals; // interpolated, of the triangle; not merged

// Slices of the merged depths that a set of layers takes.
int layerGroups()
{
    return (u_search.x + 3) / 4;
}

// The depths of four layers at a texel.
vec4 groupDepths(Layers layers, ivec2 texel, int group)
{
    return vec4(ivec4(readLayer(u_mergedDepths, texel, layers.slot * layerGroups() + group, u_size.zw)));
}

float layerDepth(Layers layers, int layer, ivec2 texel)
{
    return groupDepths(layers, texel, layer / 4)[layer % 4];
}

// Normals of a merged layer: those of the layer that its depth came from.
uvec2 layerNormals(Layers layers, int layer, ivec2 texel)
{
    int first = layers.slot * u_search.x;
    uvec2 normals = uvec2(VT_NO_NORMAL);
    do {
        uvec2 there = readLayer(u_layerNormals, texel, first + layer, u_size.zw).rg;
        normals = normals.x == VT_NO_NORMAL ? there : normals;
        layer -= 2;
    } while (normals.x == VT_NO_NORMAL && layer >= 0);
    return normals;
}

// One bit a layer, of one of the groups.
int bitsOf(bvec4 flags, int group)
{
    ivec4 bits = ivec4(flags);
    return (bits.x + 2 * bits.y + 4 * bits.z + 8 * bits.w) << (4 * group);
}

// The number of the highest bit that is set, 0 where none is. As many bits as there are layers are exact as a float.
int highestBit(int bits)
{
    return max((floatBitsToInt(float(bits)) >> 23) - 127, 0);
}

int lowestBit(int bits)
{
    return highestBit(bits & -bits);
}

// One flag a layer: set where the point lies behind it (the paper's "-").
int layersInFront(Layers layers, vec3 point)
{
    ivec2 texel = layerTexel(point.xy);
    int flags = 0, group = 0;
    do {
        flags += bitsOf(lessThan(groupDepths(layers, texel, group), vec4(point.z)), group);
        ++group;
    } while (4 * group < u_search.x);
    return flags;
}

// The column of layers at a texel, cut at a depth.
struct Column {
    int before, after; // a bit a layer: the surfaces before the depth and those behind it
    float beforeDepth, afterDepth; // the nearest of them
};

// The depth lies within the glass: an odd number of surfaces before it.
bool isInside(Column column)
{
    int bits = column.before;
    bits ^= bits >> 8;
    bits ^= bits >> 4;
    return ((0x6996 >> (bits & 15)) & 1) != 0;
}

// Takes four layers more into a column; `lower`: the depths of the two before them.
void addGroup(inout Column column, vec4 depths, vec2 lower, float depth, int group)
{
    bvec4 isBefore = lessThan(depths, vec4(depth));
    int fresh = bitsOf(notEqual(depths, vec4(lower, depths.xy)), group);
    fresh &= bitsOf(lessThanEqual(depths, vec4(VT_DEPTH_SCALE)), group);
    int before = bitsOf(isBefore, group);
    column.before |= fresh & before;
    column.after |= fresh & ~before;
    // Surfaces follow one another by their depth, and a repeated one is among them.
    vec4 nearer = mix(vec4(0.0), depths, isBefore), farther = mix(depths, vec4(VT_DEPTH_SCALE), isBefore);
    column.beforeDepth = max(column.beforeDepth, max(max(nearer.x, nearer.y), max(nearer.z, nearer.w)));
    column.afterDepth = min(column.afterDepth, min(min(farther.x, farther.y), min(farther.z, farther.w)));
}

// The columns on both sides of a place. `continuous`: a bit a layer, its depths there differ by less than `jump`.
void readColumns(Layers layers, vec3 pointA, vec3 pointB, float jump, out Column a, out Column b, out int continuous)
{
    ivec2 texelA = layerTexel(pointA.xy), texelB = layerTexel(pointB.xy);
    a = Column(0, 0, 0.0, VT_DEPTH_SCALE);
    b = a;
    continuous = 0;
    vec4 lower = vec4(-1.0); // of the two layers before: a merged layer repeats it where it is empty
    int group = 0;
    do {
        vec4 depthsA = groupDepths(layers, texelA, group), depthsB = groupDepths(layers, texelB, group);
        addGroup(a, depthsA, lower.xy, pointA.z, group);
        addGroup(b, depthsB, lower.zw, pointB.z, group);
        int near = bitsOf(lessThanEqual(abs(depthsA - depthsB), vec4(jump)), group);
        continuous |= near & bitsOf(lessThanEqual(max(depthsA, depthsB), vec4(VT_DEPTH_SCALE)), group);
        lower = vec4(depthsA.zw, depthsB.zw);
        ++group;
    } while (4 * group < u_search.x);
}
