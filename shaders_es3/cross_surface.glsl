// A path meets a surface of glass. Needs media, objects, optics and path.

// Index of refraction of a medium by its number plus one; 0 is air.
float indexOf(uint id)
{
    return id == 0u ? 1.0 : objectNumbers(int(id) - 1, VT_OBJECT_GLASS).x;
}

// What is left of the path's light after a distance in the medium it is in.
void absorb(inout Path p, uvec4 media, float distance)
{
    uint id = topOf(media);
    if (id != 0u) {
        p.transmittance *= exp(-distance * objectNumbers(int(id) - 1, VT_OBJECT_GLASS).yzw);
    }
}

// Takes the path, which is at the surface of an object, through it: an event, where indices differ, or straight on.
// N and G: the surface's outward normals, interpolated and of the triangle. `also`: another object whose surface is
// at the same place, or -1. True where it was an event.
bool crossSurface(inout Path p, inout uvec4 media, vec3 N, vec3 G, int object, int also)
{
    // The surface says on which side of it the path is.
    uint id = uint(object + 1);
    bool leaving = dot(G, p.direction) > 0.0;
    media = leaving == holds(media, id) ? media : toggle(media, id);
    uvec4 next = toggle(media, id);
    next = also >= 0 ? toggle(next, uint(also + 1)) : next;
    float eta = indexOf(topOf(media)) / indexOf(topOf(next));
    if (eta == 1.0) {
        media = next;
        return false;
    }
    N = leaving ? -N : N;
    G = leaving ? -G : G;
    vec3 I = p.direction;
    bool reflected;
    p.direction = meetInterface(I, N, G, eta, reflected);
    p.reflected = p.reflected || reflected;
    ++p.events;
    if (reflected) {
        return true;
    }
    vec3 tint = objectNumbers(object, VT_OBJECT_COLOR).rgb;
    if (u_scene.z != 0) {
        float F = fresnel(-dot(N, I), eta);
        vec3 R = reflect(I, N);
        R = dot(R, G) > 0.0 ? R : reflect(I, G);
        // What the first surface reflects towards the eye is seen to by shade.frag. Later the path follows the
        // stronger part.
        bool isFirst = p.events == 1 && !leaving;
        if (!isFirst && F > 0.5) {
            setAside(p, p.direction, 1.0 - F, next);
            p.transmittance *= F;
            p.direction = R;
            return true;
        }
        if (!isFirst) {
            setAside(p, R, F, media);
        }
        p.transmittance *= 1.0 - F;
    }
    p.transmittance *= tint;
    media = next;
    return true;
}
