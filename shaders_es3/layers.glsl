// Reading the merged layers along a ray.
uniform usampler2DArray u_mergedDepths; // four layers a texel
uniform usampler2DArray u_layerNormals; // interpolated, of the triangle; not merged

// A ray as the layers see it: (column * depth, row * depth, depth) is linear in the ray's parameter.
struct LayerRay {
    vec3 origin;
    vec3 direction;
};

vec3 layerCoordinates(vec3 camera)
{
    vec2 scale = vec2(u_size.zw) / (u_layerFrustum.zw - u_layerFrustum.xy);
    return vec3((camera.xy - u_layerFrustum.xy * camera.z) * scale, camera.z);
}

LayerRay makeLayerRay(vec3 origin, vec3 direction)
{
    return LayerRay(layerCoordinates((u_worldToCamera * vec4(origin, 1.0)).xyz),
                    layerCoordinates(mat3(u_worldToCamera) * direction));
}

// (column, row, stored depth) of the ray's point at t.
vec3 layerPoint(LayerRay ray, float t)
{
    vec3 p = ray.origin + t * ray.direction;
    return vec3(p.xy / p.z, (p.z - u_layerDepth.x) * u_layerDepth.z * VT_DEPTH_SCALE);
}

ivec2 layerTexel(vec2 position)
{
    return clamp(ivec2(floor(position)), ivec2(0), u_size.zw - 1);
}

uint layerDepth(int layer, ivec2 texel)
{
    return texelFetch(u_mergedDepths, ivec3(texel, layer / 4), 0)[layer % 4];
}

// The world point of a layer's texel centre at a stored depth.
vec3 layerWorldPoint(ivec2 texel, float stored)
{
    vec2 tangent = mix(u_layerFrustum.xy, u_layerFrustum.zw, (vec2(texel) + 0.5) / vec2(u_size.zw));
    float depth = u_layerDepth.x + stored / (VT_DEPTH_SCALE * u_layerDepth.z);
    return u_eye.xyz + vec3(tangent * depth, depth) * mat3(u_worldToCamera);
}

// Normals of a merged layer: those of the layer that its depth came from.
uvec2 layerNormals(int layer, ivec2 texel)
{
    uvec2 normals = texelFetch(u_layerNormals, ivec3(texel, layer), 0).rg;
    while (normals.x == VT_NO_NORMAL && layer >= 2) {
        layer -= 2;
        normals = texelFetch(u_layerNormals, ivec3(texel, layer), 0).rg;
    }
    return normals;
}

// One flag a layer: set where the point lies behind it (the paper's "-").
int layersInFront(vec3 point)
{
    ivec2 texel = layerTexel(point.xy);
    int flags = 0;
    for (int group = 0; 4 * group < u_search.x; ++group) {
        vec4 depths = vec4(texelFetch(u_mergedDepths, ivec3(texel, group), 0));
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

Column readColumn(ivec2 texel, float depth)
{
    Column column = Column(false, -1, -1, 0.0, 0.0);
    vec2 lower = vec2(-1.0); // of the two layers before: a merged layer repeats it where it is empty
    for (int layer = 0; layer < u_search.x; ++layer) {
        float stored = float(layerDepth(layer, texel));
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
