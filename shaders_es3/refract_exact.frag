// Follows the path of each pixel that sees glass, event by event, until it has left all glass for good or ends on
// something opaque. WITH_HEIGHTS: reliefs are met by their heights; WITH_LAYERS: all else by its layers.

// Far more surfaces than paths meet, so that no fault of the data hangs the GPU.
const int MOST_SURFACES = 256;

bool searchObject(vec3 origin, vec3 direction, int object, bool inside, bool isOther, float farthest, out Meeting meeting)
{
#ifndef WITH_LAYERS
    return searchHeights(origin, direction, object, inside, farthest, meeting);
#else
#ifdef WITH_HEIGHTS
    if (isRelief(object)) {
        return searchHeights(origin, direction, object, inside, farthest, meeting);
    }
#endif
    return searchCube(origin, direction, object, inside, isOther, farthest, u_search.y, meeting);
#endif
}

// `from`: where the path came from, `position`: where it has met the object.
SurfaceHit surfaceOf(int object, uint triangle, vec3 from, vec3 position, vec3 direction)
{
#ifndef WITH_LAYERS
    return heightsSurfaceAt(object, triangle, position);
#else
#ifdef WITH_HEIGHTS
    if (isRelief(object)) {
        return heightsSurfaceAt(object, triangle, position);
    }
#endif
    return surfaceAt(object, triangle, from, direction);
#endif
}

void main()
{
#ifdef BRANCH
    uvec4 media;
    Path p = startBranch(media);
    SurfaceHit hit;
    Meeting nearest = Meeting(NOWHERE, VT_NO_TRIANGLE); // of all objects so far
    bool isMet = false;
    int met = -1;
#else
    vec3 view;
    SurfaceHit hit = firstSurface(view);
    Path p = startPath(hit.position, view);
    uvec4 media = mediaAtEye(hit, view);
    Meeting nearest = Meeting(length(hit.position - u_eye.xyz), VT_NO_TRIANGLE); // the first is known from rasterisation
    bool isMet = true;
    int met = hit.object;
#endif
    float same = 1e-5 * length(u_boundsMax.xyz - u_boundsMin.xyz); // surfaces nearer to one another lie at one place
    int also = -1, status = VT_PATH_LOST;
    for (int surface = 0; surface < MOST_SURFACES; ++surface) {
        if (isMet) {
            if (p.events >= u_search.w) {
                break;
            }
            crossSurface(p, media, nearest.distance, hit, also);
            if (p.events >= u_search.w && media != uvec4(0u)) {
                break;
            }
        }
        nearest = Meeting(NOWHERE, VT_NO_TRIANGLE);
        also = -1;
        bool isMissed = false;
        int next = -1;
        for (int object = 0; object < u_scene.y; ++object) {
            bool inside = holds(media, uint(object + 1));
            if (u_scene.y > 1 && !inside && !entersBox(object, p.position, p.direction, nearest.distance)) {
                continue;
            }
            Meeting meeting;
            isMissed = !searchObject(p.position, p.direction, object, inside, object != met, nearest.distance + same, meeting) || isMissed;
            // Touching glass is crossed at once.
            bool isSame = abs(meeting.distance - nearest.distance) <= same && meeting.distance < NOWHERE;
            also = isSame && object < u_scene.x ? object : also;
            if (meeting.distance < nearest.distance - same) {
                nearest = meeting;
                next = object;
                also = -1;
            }
        }
        met = next;
        if (nearest.triangle == VT_NO_TRIANGLE) {
            status = media != uvec4(0u) || isMissed ? VT_PATH_LOST : VT_PATH_EXITED;
            break;
        }
        if (met >= u_scene.x) {
            absorb(p, media, nearest.distance);
            p.position += nearest.distance * p.direction;
            status = VT_PATH_OPAQUE;
            break;
        }
        vec3 from = p.position;
        p.position += nearest.distance * p.direction;
        hit = surfaceOf(met, nearest.triangle, from, p.position, p.direction);
        isMet = true;
    }
    writePathEnd(p, status, nearest.triangle, status == VT_PATH_OPAQUE ? met : -1);
}
