// A path meets a surface of glass. Needs media, objects, optics and path.

// Index of refraction and absorption of a medium by its number plus one; 0 is air.
vec4 glassOf(uint id)
{
    return id == 0u ? vec4(1.0, 0.0, 0.0, 0.0) : objectNumbers(int(id) - 1, VT_OBJECT_GLASS);
}

// What is left of the path's light after a distance in the medium it is in.
void absorb(inout Path p, uvec4 media, float distance)
{
    p.transmittance *= exp(-distance * glassOf(topOf(media)).yzw);
}

// Takes the path, which has come `distance` and met an object's surface, through it: an event, where indices differ, or
// straight on. `also`: another object whose surface is at the same place, or -1. True where it was an event.
bool crossSurface(inout Path p, inout uvec4 media, float distance, SurfaceHit hit, int also)
{
    vec4 before = glassOf(topOf(media));
    p.transmittance *= exp(-distance * before.yzw);
    // The surface says on which side of it the path is.
    uint id = uint(hit.object + 1);
    bool leaving = dot(hit.flatNormal, p.direction) > 0.0;
    if (leaving != holds(media, id)) {
        media = toggle(media, id);
        before = glassOf(topOf(media));
    }
    uvec4 next = toggle(media, id);
    next = also >= 0 ? toggle(next, uint(also + 1)) : next;
    float eta = before.x / glassOf(topOf(next)).x;
    if (eta == 1.0) {
        media = next;
        return false;
    }
    vec3 N = leaving ? -hit.normal : hit.normal, G = leaving ? -hit.flatNormal : hit.flatNormal;
    vec3 I = p.direction;
    bool reflected;
    p.direction = meetInterface(I, N, G, eta, reflected);
    p.reflected = p.reflected || reflected;
    ++p.events;
    if (reflected) {
        return true;
    }
    vec3 tint = objectNumbers(hit.object, VT_OBJECT_COLOR).rgb;
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
