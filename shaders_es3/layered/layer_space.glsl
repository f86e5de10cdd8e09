// Where world points lie in layers.

// A set of layers: of all glass (layers_of_all.glsl) or of one object (layers_of_object.glsl).
struct Layers {
    vec4 frustum; // left, bottom, right, top: tangents
    vec3 depths;  // near, far, 1 / (far - near)
    vec3 low, high; // box of what they show, world
    int slot;     // among the sets in the textures
};

// A ray as the layers see it: (column * depth, row * depth, depth) is linear in the ray's parameter.
struct LayerRay {
    vec3 origin;
    vec3 direction;
};

vec3 layerCoordinates(Layers layers, vec3 camera)
{
    vec2 scale = vec2(u_size.zw) / (layers.frustum.zw - layers.frustum.xy);
    return vec3((camera.xy - layers.frustum.xy * camera.z) * scale, camera.z);
}

LayerRay makeLayerRay(Layers layers, vec3 origin, vec3 direction)
{
    return LayerRay(layerCoordinates(layers, (u_worldToCamera * vec4(origin, 1.0)).xyz),
                    layerCoordinates(layers, mat3(u_worldToCamera) * direction));
}

// (column, row, stored depth) of the ray's point at t.
vec3 layerPoint(Layers layers, LayerRay ray, float t)
{
    vec3 p = ray.origin + t * ray.direction;
    return vec3(p.xy / p.z, (p.z - layers.depths.x) * layers.depths.z * VT_DEPTH_SCALE);
}

ivec2 layerTexel(vec2 position)
{
    return clamp(ivec2(floor(position)), ivec2(0), u_size.zw - 1);
}

// The world point of a layer's texel centre at a stored depth.
vec3 layerWorldPoint(Layers layers, ivec2 texel, float stored)
{
    vec2 tangent = mix(layers.frustum.xy, layers.frustum.zw, (vec2(texel) + 0.5) / vec2(u_size.zw));
    float depth = layers.depths.x + stored / (VT_DEPTH_SCALE * layers.depths.z);
    return u_eye.xyz + vec3(tangent * depth, depth) * mat3(u_worldToCamera);
}
