// Triangle records: src/scene/triangles.h.
uniform usampler2D u_triangles;

// Parts 0 to 2: the corners (bits of the position, neighbour across the opposite edge); 3: their normals.
uvec4 triangleTexel(uint triangle, int part)
{
    uint row = triangle / uint(VT_TRIANGLES_A_ROW);
    uint column = triangle - row * uint(VT_TRIANGLES_A_ROW);
    return texelFetch(u_triangles, ivec2(4 * int(column) + part, int(row)), 0);
}
