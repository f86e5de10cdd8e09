// The surface of glass that each pixel of the picture sees first.
uniform int u_object;

layout(location = 0) out uvec4 o_surface; // normals (interpolated, of the triangle), bits of the depth, the
                                          // object's number plus one
#ifdef INNER_DISTANCE
in float v_innerDistance;
layout(location = 1) out uint o_distance;
#endif

void main()
{
    o_surface = uvec4(surfaceNormals(), floatBitsToUint(v_camera.z), uint(u_object + 1));
#ifdef INNER_DISTANCE
    o_distance = uint(clamp(v_innerDistance, 0.0, 1.0) * VT_DEPTH_SCALE + 0.5);
#endif
}
