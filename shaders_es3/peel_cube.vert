// The mesh as seen along one axis of its cube, from its triangle records.
uniform int u_axis;

flat out uint v_triangle;
flat out uint v_leaving; // 1 where the outward normal points along the axis

vec3 corner(uint triangle, int index)
{
    return uintBitsToFloat(triangleTexel(triangle, index).xyz);
}

void main()
{
    v_triangle = uint(gl_VertexID / 3);
    int index = gl_VertexID % 3;
    vec3 a = corner(v_triangle, 0), b = corner(v_triangle, 1), c = corner(v_triangle, 2);
    vec3 p = index == 0 ? a : index == 1 ? b : c;
    vec3 axis = vec3(u_cubeMatrix[0][u_axis], u_cubeMatrix[1][u_axis], u_cubeMatrix[2][u_axis]);
    vec3 view = u_cube.z == 1 ? a - u_eye.xyz : axis;
    v_leaving = dot(cross(b - a, c - a), view) > 0.0 ? 1u : 0u;
    vec4 q = u_cubeMatrix * vec4(p, 1.0);
    gl_Position = vec4(2.0 * alongAxis(q.xyz, u_axis) - q.w, q.w);
}
