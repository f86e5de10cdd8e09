// The surface that each pixel of the picture sees first.
layout(location = 0) out uvec2 o_normals;
#ifdef INNER_DISTANCE
in float v_innerDistance;
layout(location = 1) out uint o_distance;
#endif

void main()
{
    o_normals = surfaceNormals();
#ifdef INNER_DISTANCE
    o_distance = uint(clamp(v_innerDistance, 0.0, 1.0) * VT_DEPTH_SCALE + 0.5);
#endif
}
