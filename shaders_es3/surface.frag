// The surface that each pixel of the picture sees first.
layout(location = 0) out uvec2 o_normals;

void main()
{
    o_normals = surfaceNormals();
}
