// Which objects of glass a path is within: up to four, by their numbers plus one, 0: free. The twin of
// src/scene/media.h, which names the source.

bool holds(uvec4 media, uint id)
{
    return any(equal(media, uvec4(id)));
}

// Takes the object out if it is in, else puts it in; where there is no more room nothing changes.
uvec4 toggle(uvec4 media, uint id)
{
    bool isIn = holds(media, id);
    uint from = isIn ? id : 0u, to = isIn ? 0u : id;
    if (media.x == from) {
        media.x = to;
    } else if (media.y == from) {
        media.y = to;
    } else if (media.z == from) {
        media.z = to;
    } else if (media.w == from) {
        media.w = to;
    }
    return media;
}

// The object whose material there is, its number plus one; 0: air.
uint topOf(uvec4 media)
{
    uvec4 m = media - 1u; // free places become the greatest number
    return min(min(m.x, m.y), min(m.z, m.w)) + 1u;
}
