// A technique's path: where it goes, and what light is lost and put aside on the way. Needs media. STRICT: there is no
// Fresnel reflection, so nothing is put aside.

#ifdef WITH_LOOKS
#define FIRST_SHARE vec3 // surfaces have colours
#else
#define FIRST_SHARE float
#endif

struct Path {
    vec3 position, direction;
    vec3 transmittance;
    int events;
    bool reflected; // total internal reflection took part
#ifdef WITH_ROUGH
    vec3 lobe;  // rough.glsl
    int facets; // that were met by chance, and 64 for each of the pixel's paths before
#endif
#ifdef WITH_FOOTPRINT
    Footprint footprint;
#endif
#ifndef STRICT
    // Light that was reflected off the path, or passed where the path was reflected: all of its share, as if it went
    // the way of one part of it.
    vec3 aside, asidePosition, asideDirection;
    Media asideMedia;
#ifdef WITH_ROUGH
    vec3 asideLobe;
#endif
    int asideEvents;
    float choice; // 0 to 1: decides which part; below 0: the strongest
#ifdef WITH_FOOTPRINT
    Footprint asideFootprint;
#endif
#endif
#ifdef KEEPS_FIRST
    // What the first surface reflects towards the eye; share 0: nothing.
    vec3 firstPosition, firstDirection;
    FIRST_SHARE firstShare;
#ifdef WITH_ROUGH
    vec3 firstLobe;
#endif
#ifdef WITH_FOOTPRINT
    Footprint firstFootprint;
#endif
#endif
#ifdef WITH_LOOKS
    vec3 light; // that surfaces have sent along it
#ifdef WITH_ROUGH
    vec3 seen; // the same of those that are opaque
#endif
    bool isThroughWall; // it has passed a thin wall
#endif
};

#ifdef WITH_ROUGH
#define NO_LOBE , vec3(0.0)
#define NO_FACETS , 0
#else
#define NO_LOBE
#define NO_FACETS
#endif
#ifdef WITH_FOOTPRINT
#define AND_FOOTPRINT , footprint
Path startPath(vec3 position, vec3 direction, Footprint footprint)
#else
#define AND_FOOTPRINT
Path startPath(vec3 position, vec3 direction)
#endif
{
    return Path(position, direction, vec3(1.0), 0, false NO_LOBE NO_FACETS AND_FOOTPRINT
#ifndef STRICT
                , vec3(0.0), position, direction, AIR NO_LOBE, 0, u_eye.w AND_FOOTPRINT
#endif
#ifdef KEEPS_FIRST
                , position, direction, FIRST_SHARE(0.0) NO_LOBE AND_FOOTPRINT
#endif
#ifdef WITH_LOOKS
                , vec3(0.0) NO_LOBE, false
#endif
                );
}

float strongest(vec3 light)
{
    return max(light.r, max(light.g, light.b));
}

#ifndef STRICT
// Light that leaves the path in a direction; it is then in `media`. Of several parts one is kept, with a chance as its
// share is (Chao 1982, weighted sampling in one pass), by a number that is the same for all pixels of a sample: pictures
// of several samples come to the mean of all parts, without noise. True where it is this one.
bool setLightAside(inout Path p, vec3 direction, vec3 light, Media media)
{
    float before = strongest(p.aside), part = strongest(light);
    float chance = part / max(before + part, 1e-9);
    bool isKept = p.choice < 0.0 ? part > before : p.choice < chance;
    p.choice = p.choice < 0.0 ? p.choice : isKept ? p.choice / chance : (p.choice - chance) / (1.0 - chance);
    p.asidePosition = isKept ? p.position : p.asidePosition;
    p.asideDirection = isKept ? direction : p.asideDirection;
    p.asideMedia = isKept ? media : p.asideMedia;
    p.asideEvents = isKept ? p.events : p.asideEvents;
    p.aside += light;
    return isKept;
}

// The same of a share of what is on the path.
bool setAside(inout Path p, vec3 direction, float share, Media media)
{
    return setLightAside(p, direction, share * p.transmittance, media);
}
#endif

// The state of a path, for its target.
uint pathState(Path p, int status)
{
    uint state = uint(status + 256 * p.events + (p.reflected ? VT_PATH_TIR : 0));
#ifdef WITH_LOOKS
    state |= p.isThroughWall ? uint(VT_PATH_WALL) : 0u;
#endif
#ifdef COUNT_READS
    state |= uint(min(g_reads, VT_MAX_READS)) << VT_PATH_READS_SHIFT;
#endif
    return state;
}
