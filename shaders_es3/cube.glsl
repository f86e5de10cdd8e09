// Coordinates of the layered depth cube. A side of it is looked at along one axis; the two others, in cyclic
// order, are its columns and rows.

vec3 alongAxis(vec3 q, int axis)
{
    return axis == 0 ? q.yzx : axis == 1 ? q.zxy : q;
}

// Where a tile of a level of the interval pyramid lies in its texture: level 0 at the origin, the others side
// by side above it. (Mip levels would do, but software renderers are slow to tell them apart.)
ivec2 tileTexel(ivec2 tile, int level)
{
    return level == 0 ? tile : tile + ivec2(u_cube.x - ((2 * u_cube.x) >> level), u_cube.x);
}
