// Follows the path of each pixel that sees glass, event by event, until it has left the object for good.
void main()
{
    vec3 view;
    SurfaceHit hit = firstSurface(view);
    Path p = startPath(hit.position, view);
    uvec4 media = mediaAtEye(hit, view);
    float distance = length(hit.position - u_eye.xyz);
    int status = VT_PATH_EXITED;
    while (true) {
        crossSurface(p, media, distance, hit, -1);
        bool inside = media != uvec4(0u);
        bool last = p.events >= u_search.w;
        bool found = !(inside && last) && searchLayers(p.position, p.direction, inside, hit);
        if (!found || last) {
            status = inside || found ? VT_PATH_LOST : VT_PATH_EXITED;
            break;
        }
        distance = length(hit.position - p.position);
        p.position = hit.position;
    }
    writePath(p, status);
}
