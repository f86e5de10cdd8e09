// A ray's way over a grid of cells in tiles of 2^level cells.

// The cell that it comes to beyond a tile, which it leaves at parameter `leave`, the lesser of `exits` (across columns,
// across rows). Along the side that is crossed, it is the cell that a walk from cell to cell would come to, by the same
// numbers, columns before rows where they tie. positive: 1 where the ray's direction is.
ivec2 cellBeyond(vec2 origin, vec2 direction, vec2 inverse, ivec2 positive, ivec2 tile, int level, vec2 exits, float leave)
{
    bool across = exits.x <= exits.y;
    vec3 other = across ? vec3(origin.y, direction.y, inverse.y) : vec3(origin.x, direction.x, inverse.x);
    int ahead = across ? positive.y : positive.x;
    float side = floor(other.x + leave * other.y);
    float before = (side + float(1 - ahead) - other.x) * other.z, behind = (side + float(ahead) - other.x) * other.z;
    float back = (across ? before >= leave : before > leave) ? 1.0 : 0.0;
    float on = (across ? behind < leave : behind <= leave) ? 1.0 : 0.0;
    int along = int(side) + int(on - back) * (2 * ahead - 1);
    ivec2 corner = tile << level;
    ivec2 next = clamp(ivec2(along), corner, corner + (1 << level) - 1);
    ivec2 beyond = ((tile + positive) << level) - 1 + positive;
    return across ? ivec2(beyond.x, next.y) : ivec2(next.x, beyond.y);
}
