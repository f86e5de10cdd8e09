// Follows the path of each pixel that sees glass, event by event, until it has left the object for good.
void main()
{
    SurfaceHit hit;
    vec3 direction;
    if (!firstSurface(hit, direction)) {
        writeBackground();
        return;
    }
    int status, events;
    bool anyReflected;
    direction = tracePath(hit, direction, status, events, anyReflected);
    writePath(direction, status, events, anyReflected);
}
