// A path meets a surface of glass. Needs media, objects, optics and path.

// Index of refraction and absorption of an object's glass, and its tint. Of a single object they are read once.
#ifdef ONE_OBJECT
vec4 g_glass;
vec3 g_tint;
#define readGlass(object) g_glass
#define readTint(object) g_tint
#else
#define readGlass(object) objectNumbers(object, VT_OBJECT_GLASS)
#define readTint(object) objectNumbers(object, VT_OBJECT_COLOR).rgb
#endif

// Of a medium by its number plus one; 0 is air.
vec4 glassOf(uint id)
{
    int object = max(int(id) - 1, 0);
    vec4 glass = readGlass(object);
#ifdef WITH_SPECTRAL
    glass.x = dispersedIndex(object, glass.x, id != 0u);
#endif
    return mix(vec4(1.0, 0.0, 0.0, 0.0), glass, bvec4(id != 0u));
}

#ifdef WITH_FAN
// What a step of the spread does to the index of one medium over another's; eta: that.
float etaChange(uint from, uint to, float eta)
{
    int first = max(int(from) - 1, 0), second = max(int(to) - 1, 0);
    vec2 indices = vec2(readGlass(first).x, readGlass(second).x), there = vec2(from != 0u, to != 0u);
    vec2 steps = there * vec2(indexChange(first, indices.x), indexChange(second, indices.y));
    return (steps.x - eta * steps.y) / mix(1.0, indices.y, there.y); // over the index at 587.6 nm: nearly the same
}
#endif

// What is left of the path's light after a distance in the medium it is in.
void absorb(inout Path p, Media media, float distance)
{
    p.transmittance *= exp(-distance * glassOf(topOf(media)).yzw);
}

// Takes the path, which has come `distance` and met an object's surface, through it: an event, where indices differ, or
// straight on. `also`: another object whose surface is at the same place, or -1. True where it was an event.
bool crossSurface(inout Path p, inout Media media, float distance, SurfaceHit hit, int also)
{
    vec4 before = glassOf(topOf(media));
    p.transmittance *= exp(-distance * before.yzw);
#ifdef WITH_ROUGH
    p.lobe = lobeAfter(p.lobe, distance);
#endif
    // The surface says on which side of it the path is.
    uint id = uint(hit.object + 1);
    bool leaving = dot(hit.flatNormal, p.direction) > 0.0;
    if (leaving != holds(media, id)) {
        media = toggle(media, id);
        before = glassOf(topOf(media));
    }
    Media next = toggle(media, id);
    next = also >= 0 ? toggle(next, uint(also + 1)) : next;
    float eta = before.x / glassOf(topOf(next)).x;
    if (eta == 1.0) { // a surface between two media tints whether it bends or not
        p.transmittance *= topOf(media) != topOf(next) ? readTint(hit.object) : vec3(1.0);
        media = next;
        return false;
    }
    vec3 N = leaving ? -hit.normal : hit.normal, G = leaving ? -hit.flatNormal : hit.flatNormal;
    vec3 I = p.direction;
#ifdef WITH_ROUGH
    float roughness = roughnessOf(hit.object), alpha = roughness * roughness;
    bool isFacet = BY_CHANCE && alpha > 0.0;
    vec3 smoothN = dot(N, I) < 0.0 ? N : G, chance = chanceOfFacet(p.facets);
    N = isFacet ? facetNormal(smoothN, I, alpha, chance) : N;
    p.facets += int(isFacet);
    bool reflected;
    vec3 T = meetInterface(I, N, isFacet ? N : G, eta, reflected);
    float beyond = reflected ? 1.0 : -1.0;
    T = isFacet ? leaveFacets(T, beyond * smoothN, beyond * G, alpha, chance) : T;
#else
    bool reflected;
    vec3 T = meetInterface(I, N, G, eta, reflected);
#endif
#ifdef WITH_ROUGH
    vec3 R = isFacet ? leaveFacets(reflect(I, N), smoothN, G, alpha, chance) : reflect(I, N);
    alpha = isFacet ? 0.0 : alpha;
    float c = clamp(-dot(N, I), 0.0, 1.0), curvature = N == G ? 0.0 : 0.5 * (leaving ? -1.0 : 1.0) * (hit.turn[0].x + hit.turn[1].y + hit.turn[2].z);
    vec3 lobe = p.lobe, lobePassed = lobeThrough(lobe, c, eta, curvature, alpha), lobeTurned = lobeMirrored(lobe, c, curvature, alpha);
    p.lobe = reflected ? lobeTurned : lobePassed;
#endif
    p.direction = T;
    p.reflected = p.reflected || reflected;
    ++p.events;
#ifdef WITH_FOOTPRINT
    p.footprint.place = alongSurface(p.footprint.place, I, G);
    float side = N == G ? 0.0 : leaving ? -1.0 : 1.0;
    STEPS turn = side * (hit.turn * p.footprint.place);
    STEPS steps = p.footprint.direction;
    STEPS passed = bendFootprint(steps, I, N, turn, eta, reflected);
#ifdef WITH_FAN
    passed[2] += (1.0 - float(reflected)) * bentByIndex(I, N, eta, etaChange(topOf(media), topOf(next), eta));
#endif
    p.footprint.direction = passed;
#endif
    if (reflected) {
        return true;
    }
    vec3 tint = readTint(hit.object);
#ifndef STRICT
    if (u_scene.z != 0) {
        float F = fresnel(-dot(N, I), eta);
#ifndef WITH_ROUGH
        vec3 R = reflect(I, N);
#endif
        R = dot(R, G) > 0.0 ? R : reflect(I, G);
        // What the first surface reflects towards the eye is kept apart: it is never too little to be followed. (Of
        // techniques with a shade pass, shade.frag sees to it.) Later the path follows the stronger part.
        bool isFirst = p.events == 1 && !leaving, isMirrored = !isFirst && F > 0.5;
#ifdef KEEPS_FIRST
        p.firstPosition = isFirst ? p.position : p.firstPosition;
        p.firstDirection = isFirst ? R : p.firstDirection;
        p.firstShare = isFirst ? FIRST_SHARE(F * strongest(p.transmittance)) : p.firstShare;
#ifdef WITH_ROUGH
        p.firstLobe = isFirst ? lobeTurned : p.firstLobe;
#endif
#endif
        bool isKept = false;
        if (!isFirst) {
            isKept = setAside(p, isMirrored ? T : R, isMirrored ? 1.0 - F : F, isMirrored ? next : media);
        }
#ifdef WITH_FOOTPRINT
        STEPS mirrored = bendFootprint(steps, I, N, turn, eta, true);
        p.asideFootprint.place = isKept ? p.footprint.place : p.asideFootprint.place;
        p.asideFootprint.direction = isKept ? (isMirrored ? passed : mirrored) : p.asideFootprint.direction;
        p.firstFootprint.place = isFirst ? p.footprint.place : p.firstFootprint.place;
        p.firstFootprint.direction = isFirst ? mirrored : p.firstFootprint.direction;
        p.footprint.direction = isMirrored ? mirrored : passed;
#endif
#ifdef WITH_ROUGH
        p.asideLobe = isKept ? (isMirrored ? lobePassed : lobeTurned) : p.asideLobe;
        p.lobe = isMirrored ? lobeTurned : lobePassed;
#endif
        p.direction = isMirrored ? R : T;
        p.transmittance *= isMirrored ? F : 1.0 - F;
        if (isMirrored) {
            return true;
        }
    }
#endif
    p.transmittance *= tint;
    media = next;
    return true;
}
