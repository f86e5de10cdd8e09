// An object's mesh from the eye, through FRUSTUM and DEPTH_RANGE (picture.glsl, layer.glsl, layer_of_object.glsl).
uniform vec4 u_toWorld[3]; // rows
uniform vec4 u_toObject[3];

layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
#ifdef INNER_DISTANCE
layout(location = 2) in float a_innerDistance;
out float v_innerDistance; // share of the diagonal of the glass's box
#endif

out vec3 v_camera; // position in camera coordinates: right, up, depth
out vec3 v_normal; // world

vec3 toWorld(vec4 p)
{
    return vec3(dot(u_toWorld[0], p), dot(u_toWorld[1], p), dot(u_toWorld[2], p));
}

void main()
{
    vec3 p = (u_worldToCamera * vec4(toWorld(vec4(a_position, 1.0)), 1.0)).xyz;
    vec4 f = FRUSTUM, d = DEPTH_RANGE;
    bool parallel = u_clip.w != 0.0; // orthographic
    float w = parallel ? 1.0 : p.z;
    float z = parallel ? 2.0 * p.z - d.x - d.y : (d.x + d.y) * p.z - 2.0 * d.x * d.y;
    gl_Position = vec4((2.0 * p.xy - (f.xy + f.zw) * w) / (f.zw - f.xy), z * d.z, w);
    v_camera = p;
    v_normal = a_normal.x * u_toObject[0].xyz + a_normal.y * u_toObject[1].xyz + a_normal.z * u_toObject[2].xyz;
#ifdef INNER_DISTANCE
    v_innerDistance = a_innerDistance * length(toWorld(vec4(a_normal, 0.0))) / length(u_boundsMax.xyz - u_boundsMin.xyz);
#endif
}
