// Follows the path of each pixel that sees glass, event by event, until it has left the object for good.
void main()
{
    vec3 direction;
    SurfaceHit hit = firstSurface(direction);
    bool inside = dot(hit.flatNormal, direction) > 0.0; // an eye within the glass sees its back faces
    bool anyReflected = false;
    int status = VT_PATH_EXITED;
    int events = 0;
    float nearest = 1e-5 * length(u_boundsMax.xyz - u_boundsMin.xyz);
    while (true) {
        bool reflected;
        direction = meetSurface(direction, hit.normal, hit.flatNormal, u_optics.x, inside, reflected);
        anyReflected = anyReflected || reflected;
        ++events;
        bool last = events >= u_search.w;
        TriangleHit meeting;
        bool found = !(inside && last) && searchBvh(hit.position, direction, inside, nearest, meeting);
        if (!found || last) {
            status = inside || found ? VT_PATH_LOST : VT_PATH_EXITED;
            break;
        }
        hit = surfaceAt(meeting);
    }
    writePath(direction, status, events, anyReflected);
}
