// Follows the path of each pixel that sees glass, event by event, until it has left all glass for good or, WITH_OPAQUE,
// ends on something opaque. (Wang & Chi, section 3.7, take one object after the other: refract_ordered.frag.)

// Far more surfaces than paths meet, so that no fault of the data hangs the GPU.
const int MOST_SURFACES = 256;

// The first surface of glass on the path. `hit`, `also`: where it is, on the surface of that object and, or -1, of a
// second one; then where it comes to. False where it meets no glass.
bool nextSurface(Path p, uvec4 media, inout SurfaceHit hit, inout int also, out float nearest)
{
    int from = hit.object, fromToo = also;
    float same = 0.0; // surfaces nearer to one another than a texel lie at one place
    also = -1;
    nearest = NOWHERE;
    int object = 0;
    do {
        Layers layers = layersOf(object);
        bool start = object == from || object == fromToo;
        SurfaceHit there;
        if (searchLayers(layers, p.position, p.direction, holds(media, uint(object + 1)), start, nearest + same, there)) {
            float distance = length(there.position - p.position);
            float texel = texelSize(layers, length(there.position - u_eye.xyz));
            if (abs(distance - nearest) <= max(same, texel)) {
                also = object;
            } else if (distance < nearest) {
                hit = there;
                hit.object = object;
                also = -1;
                nearest = distance;
                same = texel;
            }
        }
        ++object;
    } while (object < u_scene.x);
    return nearest < NOWHERE;
}

void main()
{
    vec3 view;
    SurfaceHit hit = firstSurface(view);
    Path p = startPath(hit.position, view);
    uvec4 media = mediaAtEye(hit, view);
    float nearest = length(hit.position - u_eye.xyz);
    int status = VT_PATH_LOST, also = -1;
#ifdef WITH_OPAQUE
    OpaqueHit opaque = NOTHING_OPAQUE;
#endif
    for (int i = 0; i < MOST_SURFACES; ++i) {
        crossSurface(p, media, nearest, hit, also);
        bool inside = media != uvec4(0u);
        bool last = p.events >= u_search.w;
        if (inside && last) {
            break;
        }
        bool found = nextSurface(p, media, hit, also, nearest);
#ifdef WITH_OPAQUE
        opaque = searchOpaque(p.position, p.direction, nearest);
        if (opaque.hit.triangle != VT_NO_TRIANGLE) {
            absorb(p, media, opaque.hit.distance);
            p.position += opaque.hit.distance * p.direction;
            status = VT_PATH_OPAQUE;
            break;
        }
#endif
        if (!found || last) {
            status = inside || found ? VT_PATH_LOST : VT_PATH_EXITED;
            break;
        }
        p.position = hit.position;
    }
    writePath(p, status);
#ifdef WITH_OPAQUE
    o_end.w = opaque.hit.triangle;
    o_light.w = uint(opaque.object + 1);
#endif
}
