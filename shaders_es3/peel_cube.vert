// An object's mesh as seen along one axis of its layers, from its triangle records.
uniform vec4 u_layers[4]; // rows of the matrix from the mesh's coordinates to the layers', which run from 0 to 1
uniform vec4 u_from;      // direction of view in the mesh's coordinates, 0; or the eye, 1
uniform int u_axis;
uniform int u_firstTriangle;

flat out uint v_triangle;
flat out uint v_leaving; // 1 where the outward normal points along the view

vec3 corner(uint triangle, int index)
{
    return uintBitsToFloat(triangleTexel(triangle, index).xyz);
}

void main()
{
    v_triangle = uint(u_firstTriangle + gl_VertexID / 3);
    int index = gl_VertexID % 3;
    vec3 a = corner(v_triangle, 0), b = corner(v_triangle, 1), c = corner(v_triangle, 2);
    vec4 p = vec4(index == 0 ? a : index == 1 ? b : c, 1.0);
    vec3 view = u_from.w != 0.0 ? a - u_from.xyz : u_from.xyz;
    v_leaving = dot(cross(b - a, c - a), view) > 0.0 ? 1u : 0u;
    vec4 q = p * mat4(u_layers[0], u_layers[1], u_layers[2], u_layers[3]);
    gl_Position = vec4(2.0 * alongAxis(q.xyz, u_axis) - q.w, q.w);
}
