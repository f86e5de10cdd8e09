// One interface, then the environment: what most renderers of the web do.
void main()
{
    vec3 direction;
    SurfaceHit hit = firstSurface(direction);
    Path p = startPath(hit.position, direction);
    uvec4 media = mediaAtEye(hit, direction);
    crossSurface(p, media, 0.0, hit, -1);
    writePath(p, VT_PATH_EXITED);
}
