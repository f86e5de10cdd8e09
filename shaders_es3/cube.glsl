// Coordinates of the layered depth cube. A side of it is looked at along one axis; the two others, in cyclic
// order, are its columns and rows.

vec3 alongAxis(vec3 q, int axis)
{
    return axis == 0 ? q.yzx : axis == 1 ? q.zxy : q;
}
