// The mesh from the eye, through FRUSTUM and DEPTH_RANGE (the picture's or the layers').
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
#ifdef INNER_DISTANCE
layout(location = 2) in float a_innerDistance;
out float v_innerDistance; // share of the box's diagonal
#endif

out vec3 v_camera; // position in camera coordinates: right, up, depth
out vec3 v_normal; // world

void main()
{
    vec3 p = (u_worldToCamera * vec4(a_position, 1.0)).xyz;
    vec2 xy = (2.0 * p.xy - (FRUSTUM.xy + FRUSTUM.zw) * p.z) / (FRUSTUM.zw - FRUSTUM.xy);
    float z = ((DEPTH_RANGE.x + DEPTH_RANGE.y) * p.z - 2.0 * DEPTH_RANGE.x * DEPTH_RANGE.y) * DEPTH_RANGE.z;
    gl_Position = vec4(xy, z, p.z);
    v_camera = p;
    v_normal = a_normal;
#ifdef INNER_DISTANCE
    v_innerDistance = a_innerDistance / length(u_boundsMax.xyz - u_boundsMin.xyz);
#endif
}
