// Reading the merged layers along a ray.
uniform usampler2DArray u_mergedDepths; // four layers a texel
uniform usampler2DArray u_layerNormals; // interpolated, of the triangle; not merged

// Slices of the merged depths that a set of layers takes.
int layerGroups()
{
    return (u_search.x + 3) / 4;
}

uint layerDepth(Layers layers, int layer, ivec2 texel)
{
    return texelFetch(u_mergedDepths, ivec3(texel, layers.slot * layerGroups() + layer / 4), 0)[layer % 4];
}

// Normals of a merged layer: those of the layer that its depth came from.
uvec2 layerNormals(Layers layers, int layer, ivec2 texel)
{
    int first = layers.slot * u_search.x;
    uvec2 normals = texelFetch(u_layerNormals, ivec3(texel, first + layer), 0).rg;
    while (normals.x == VT_NO_NORMAL && layer >= 2) {
        layer -= 2;
        normals = texelFetch(u_layerNormals, ivec3(texel, first + layer), 0).rg;
    }
    return normals;
}

// One flag a layer: set where the point lies behind it (the paper's "-").
int layersInFront(Layers layers, vec3 point)
{
    ivec2 texel = layerTexel(point.xy);
    int flags = 0, first = layers.slot * layerGroups();
    for (int group = 0; 4 * group < u_search.x; ++group) {
        vec4 depths = vec4(texelFetch(u_mergedDepths, ivec3(texel, first + group), 0));
        ivec4 behind = ivec4(lessThan(depths, vec4(point.z)));
        flags += (behind.x + 2 * behind.y + 4 * behind.z + 8 * behind.w) << (4 * group);
    }
    return flags;
}

// The column of layers at a texel, cut at a depth.
struct Column {
    bool inside; // the depth lies within the glass: an odd number of surfaces before it
    int before;  // layer of the last surface before the depth, -1: none
    int after;   // layer of the first surface behind it, -1: none
    float beforeDepth, afterDepth;
};

Column readColumn(Layers layers, ivec2 texel, float depth)
{
    Column column = Column(false, -1, -1, 0.0, 0.0);
    vec2 lower = vec2(-1.0); // of the two layers before: a merged layer repeats it where it is empty
    for (int layer = 0; layer < u_search.x; ++layer) {
        float stored = float(layerDepth(layers, layer, texel));
        bool isNew = stored != lower.x && stored <= VT_DEPTH_SCALE;
        if (isNew && stored < depth) {
            column.inside = !column.inside;
            column.before = layer;
            column.beforeDepth = stored;
        } else if (isNew && column.after < 0) {
            column.after = layer;
            column.afterDepth = stored;
        }
        lower = vec2(lower.y, stored);
    }
    return column;
}
