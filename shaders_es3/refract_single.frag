// One interface, then the environment: what most renderers of the web do.
void main()
{
    vec3 direction;
    SurfaceHit hit = firstSurface(direction);
    bool inside = dot(hit.flatNormal, direction) > 0.0, reflected;
    direction = meetSurface(direction, hit.normal, hit.flatNormal, u_optics.x, inside, reflected);
    writePath(direction, VT_PATH_EXITED, 1, reflected);
}
