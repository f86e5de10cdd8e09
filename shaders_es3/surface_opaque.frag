// The triangle of an opaque object that each pixel sees first.
uniform int u_object;

flat in uint v_triangle;
in float v_depth;

layout(location = 0) out uvec4 o_surface; // triangle, 0, bits of the depth, the object's number plus one
#ifdef INNER_DISTANCE
layout(location = 1) out uint o_distance;
#endif

void main()
{
    o_surface = uvec4(v_triangle, 0u, floatBitsToUint(v_depth), uint(u_object + 1));
#ifdef INNER_DISTANCE
    o_distance = 0u;
#endif
}
