// What a path meets next, of all objects. Needs objects, media and records; WITH_HEIGHTS: reliefs are met by their
// heights (search_heights.glsl); ONLY_HEIGHTS: there is nothing else; ONE_OBJECT: there is one object, of closed glass.
struct Meeting {
    float distance; // in the world; NOWHERE: nothing
    uint triangle;  // records.glsl, or of a relief: search_heights.glsl
    vec2 at;        // weights of its second and third corner
    int object;
    int also; // another object of glass whose surface is at the same place, or -1
};

// Where a search starts.
struct Start {
    vec3 position, direction; // world
    Media media;
    int object;    // that the path is on, or -1
    uint triangle; // of that
    bool isEye;        // nothing is known of what it is within
    bool isBehind;     // it has just come through a surface: what is opaque may lie at the same place
    bool onlyOpaque;
};

const Start NO_START = Start(vec3(0.0), vec3(1.0, 0.0, 0.0), AIR, -1, VT_NO_TRIANGLE, false, false, false);

// Surfaces nearer to one another lie at one place.
float samePlace()
{
    return 1e-5 * length(u_boundsMax.xyz - u_boundsMin.xyz);
}

#ifndef ONLY_HEIGHTS
// What a search of an object's triangles takes; of a single object it is read once.
struct Searched {
    Transform transform;
    Hierarchy tree;
    vec4 low; // its box, and the diagonal
    vec3 high;
};

Searched readSearched(int object)
{
    return Searched(readTransform(object), readHierarchy(object), objectNumbers(object, VT_OBJECT_LOW),
                    objectNumbers(object, VT_OBJECT_HIGH).xyz);
}
#ifdef ONE_OBJECT
Searched g_searched;

void readObject()
{
    g_searched = readSearched(0);
    g_glass = objectNumbers(0, VT_OBJECT_GLASS);
    g_tint = objectNumbers(0, VT_OBJECT_COLOR).rgb;
}
#define readSearched(object) g_searched
#endif
#endif

Meeting meetObject(Start start, int object, float farthest)
{
    bool inside = holds(start.media, mediumOf(object));
#ifdef WITH_HEIGHTS
#ifndef ONLY_HEIGHTS
    if (isRelief(object))
#endif
    {
        HeightHit met;
        inside = start.isEye && object < u_scene.x ? heightsContain(object, start.position) : inside;
        searchHeights(start.position, start.direction, object, inside, farthest, met);
        return Meeting(met.distance, met.triangle, vec2(0.0), object, -1);
    }
#endif
#ifndef ONLY_HEIGHTS
    Searched at = readSearched(object);
    bool isOpaque = object >= u_scene.x;
    // An eye within the box may be within the glass: the first surface then tells.
    bool isAbout = start.isEye && all(greaterThan(start.position, at.low.xyz)) && all(lessThan(start.position, at.high));
    float side = at.tree.bothSides || (isAbout && !isOpaque) ? 0.0 : inside ? -1.0 : 1.0;
    float nearest = start.isEye ? 0.0 : isOpaque ? (start.isBehind ? -samePlace() : samePlace()) : 1e-5 * at.low.w;
    uint from = start.object == object ? start.triangle : VT_NO_TRIANGLE;
    RecordHit hit = searchRecords(at.tree, toObject(at.transform, vec4(start.position, 1.0)),
                                  toObject(at.transform, vec4(start.direction, 0.0)), side, nearest, farthest, from);
    return Meeting(hit.distance, hit.triangle, hit.at, object, -1);
#endif
}

// Of two meetings the nearer; at one place glass comes before what is opaque, and the object of lower number, whose
// material counts, before another of glass.
Meeting nearerOf(Meeting before, Meeting met, float same)
{
    bool isSame = abs(met.distance - before.distance) <= same && met.distance < NOWHERE;
    bool wasGlass = before.object < u_scene.x, isGlass = met.object < u_scene.x;
    bool isNearer = isSame ? isGlass && (!wasGlass || met.object < before.object) : met.distance < before.distance;
    int also = !isSame ? (isNearer ? -1 : before.also) : wasGlass && isGlass ? max(before.object, met.object) : before.also;
    Meeting nearer = before;
    nearer.distance = isNearer ? met.distance : before.distance;
    nearer.triangle = isNearer ? met.triangle : before.triangle;
    nearer.at = isNearer ? met.at : before.at;
    nearer.object = isNearer ? met.object : before.object;
    nearer.also = also;
    return nearer;
}

// Is the eye, which is in its box, within an object of glass whose first surface this is? An open one has no inside.
bool holdsEye(Start start, int object, Meeting met)
{
#ifdef WITH_HEIGHTS
#ifndef ONLY_HEIGHTS
    if (isRelief(object))
#endif
    {
        return heightsContain(object, start.position);
    }
#endif
#ifndef ONLY_HEIGHTS
    vec3 direction = toObject(readTransform(object), vec4(start.direction, 0.0));
    return met.triangle != VT_NO_TRIANGLE && !readHierarchy(object).bothSides &&
           dot(cornersArea(recordCorners(met.triangle)), direction) > 0.0;
#endif
}

// At the eye it finds out what that is within.
Meeting searchScene(inout Start start)
{
#ifdef ONE_OBJECT
    return meetObject(start, 0, NOWHERE);
#else
    float same = samePlace();
    Meeting nearest = Meeting(NOWHERE, VT_NO_TRIANGLE, vec2(0.0), -1, -1);
    vec3 d = mix(start.direction, vec3(1e-12), lessThan(abs(start.direction), vec3(1e-12)));
    vec3 inverse = 1.0 / d;
    vec3 from = start.position - same * start.direction; // also what lies at the same place
    int at = 0;
    for (int i = 0; i < VT_MAX_OBJECTS; ++i) {
        int object = nextObject(at, from, inverse, nearest.distance + 2.0 * same);
        if (object < 0) {
            break;
        }
        bool isGlass = object < u_scene.x;
        if (!isGlass || !start.onlyOpaque) {
            bool isAbout = start.isEye && isGlass && all(greaterThan(start.position, objectNumbers(object, VT_OBJECT_LOW).xyz)) &&
                           all(lessThan(start.position, objectNumbers(object, VT_OBJECT_HIGH).xyz));
            Meeting met = meetObject(start, object, isAbout ? NOWHERE : nearest.distance + same);
            if (isAbout && holdsEye(start, object, met)) {
                start.media = toggle(start.media, mediumOf(object));
            }
            nearest = nearerOf(nearest, met, same);
        }
    }
    return nearest;
#endif
}

// The surface of glass that was met, at that position.
SurfaceHit meetingSurface(Meeting meeting, vec3 position)
{
#ifdef WITH_HEIGHTS
#ifndef ONLY_HEIGHTS
    if (isRelief(meeting.object))
#endif
    {
        return heightsSurfaceAt(meeting.object, meeting.triangle, position);
    }
#endif
#ifndef ONLY_HEIGHTS
    return recordSurface(meeting.object, readSearched(meeting.object).transform,
                         RecordHit(meeting.distance, meeting.triangle, meeting.at), position);
#endif
}
