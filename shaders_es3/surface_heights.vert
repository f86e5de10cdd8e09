// The box of a relief, from no vertices: 36 of them.
uniform vec4 u_toWorld[3]; // rows
uniform int u_object;

void main()
{
    // Six faces of two triangles; a face's corners by two bits, the axis across it by its number. Outward, its corners
    // run counter-clockwise: 0 1 2 and 2 1 3.
    int face = gl_VertexID / 6, corner = gl_VertexID % 6, axis = face % 3;
    corner = corner == 3 ? 2 : corner == 4 ? 1 : corner == 5 ? 3 : corner;
    bool isHigh = face >= 3;
    int bits[3];
    bits[axis] = isHigh ? 1 : 0;
    bits[(axis + 1) % 3] = isHigh ? corner & 1 : corner >> 1;
    bits[(axis + 2) % 3] = isHigh ? corner >> 1 : corner & 1;
    vec3 low = objectNumbers(u_object, VT_OBJECT_OWN_LOW).xyz, high = objectNumbers(u_object, VT_OBJECT_OWN_HIGH).xyz;
    // A little larger, so that no pixel of the slab is missed.
    vec3 margin = vec3(1e-3 * length(high - low));
    vec4 p = vec4(mix(low - margin, high + margin, vec3(bits[0], bits[1], bits[2])), 1.0);
    p = u_worldToCamera * vec4(dot(u_toWorld[0], p), dot(u_toWorld[1], p), dot(u_toWorld[2], p), 1.0);
    vec4 f = u_pictureFrustum;
    // Depth is the surface's, not the box's, which may reach beyond what the frustum holds.
    gl_Position = vec4((2.0 * p.xy - (f.xy + f.zw) * p.z) / (f.zw - f.xy), 0.0, p.z);
}
