// An opaque object from the eye, from its triangle records.
uniform vec4 u_toWorld[3]; // rows
uniform int u_firstTriangle;

flat out uint v_triangle;
out float v_depth;

void main()
{
    v_triangle = uint(u_firstTriangle + gl_VertexID / 3);
    vec4 p = vec4(uintBitsToFloat(triangleTexel(v_triangle, gl_VertexID % 3).xyz), 1.0);
    p = u_worldToCamera * vec4(dot(u_toWorld[0], p), dot(u_toWorld[1], p), dot(u_toWorld[2], p), 1.0);
    vec4 f = u_pictureFrustum;
    vec3 d = u_pictureDepth.xyz;
    gl_Position = vec4((2.0 * p.xy - (f.xy + f.zw) * p.z) / (f.zw - f.xy), ((d.x + d.y) * p.z - 2.0 * d.x * d.y) * d.z, p.z);
    v_depth = p.z;
}
