// Which objects of glass a path is within, by their numbers plus one. The twin of src/scene/media.h, which names the
// source.
#ifdef ONE_OBJECT
#define Media uint // 0, or 1: within the only one
const Media AIR = 0u;

bool holds(Media media, uint id)
{
    return media == id;
}

Media toggle(Media media, uint id)
{
    return id - media;
}

uint topOf(Media media)
{
    return media;
}
#else
#define Media uvec4 // up to four, in any order; 0: free
const Media AIR = uvec4(0u);

bool holds(Media media, uint id)
{
    return any(equal(media, uvec4(id)));
}

// Takes the object out if it is in, else puts it in; where there is no more room nothing changes.
Media toggle(Media media, uint id)
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
uint topOf(Media media)
{
    uvec4 m = media - 1u; // free places become the greatest number
    return min(min(m.x, m.y), min(m.z, m.w)) + 1u;
}
#endif
