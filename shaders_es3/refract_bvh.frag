// Follows the path of each pixel that sees glass, event by event, until it has left the one object for good. The
// hierarchy's triangles, and so the search, are in the object's coordinates.
void main()
{
    vec3 view;
    SurfaceHit hit = firstSurface(view);
    Path p = startPath(hit.position, view);
    uvec4 media = mediaAtEye(hit, view);
    float distance = length(hit.position - u_eye.xyz);
    Transform transform = readTransform(0);
    float nearest = 1e-5 * objectNumbers(0, VT_OBJECT_LOW).w;
    int status = VT_PATH_EXITED;
    while (true) {
        crossSurface(p, media, distance, hit, -1);
        bool inside = holds(media, 1u);
        bool last = p.events >= u_search.w;
        TriangleHit meeting;
        bool found = !(inside && last) && searchBvh(toObject(transform, vec4(p.position, 1.0)), toObject(transform, vec4(p.direction, 0.0)),
                                                    inside, nearest, meeting);
        if (!found || last) {
            status = inside || found ? VT_PATH_LOST : VT_PATH_EXITED;
            break;
        }
        distance = meeting.distance;
        p.position += meeting.distance * p.direction;
        hit = surfaceAt(meeting, p.position, transform);
    }
    writePath(p, status);
}
