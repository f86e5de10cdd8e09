// A path meets a surface whose material has more to it than an index and a tint (looks.glsl): it may not be there, be a
// thin wall, or send light of its own. What light meets it parts into what passes beside it, what passes through it and
// what it mirrors: the path follows the strongest, the others are set aside. Takes the place of crossSurface. Needs
// looks, media, objects, optics and path; of rough glass rough.

#ifdef WITH_HOST
vec3 asHostShows(vec3 position, vec3 light); // host_picture.glsl
#endif

// Takes the path through; `isLast`: it has no event left. False where it ends, `status` says how.
bool crossLook(inout Path p, inout Media media, Look look, SurfaceHit hit, Meeting met, bool isLast, inout int status)
{
    vec3 I = p.direction;
    int object = hit.object, also = met.also;
    bool leaving = dot(look.G, I) > 0.0;
    vec3 N = leaving ? -look.N : look.N, G = leaving ? -look.G : look.G;
    Start from = Start(p.position, I, media, object, met.triangle, false, false, false);
    vec3 covered = p.transmittance * look.base.a, beside = p.transmittance - covered;
    vec3 sent = sentLight(look, dot(N, I) < 0.0 ? N : G, I, from, met.at);
#ifdef WITH_HOST
    sent = mix(sent, asHostShows(p.position, sent), bvec3(object >= u_scene.x));
#endif
    sent *= covered;
#ifdef WITH_ROUGH
    bool isOpaque = object >= u_scene.x; // it ends the path, whose lobe is what it was
    p.seen += isOpaque ? sent : vec3(0.0);
    sent = isOpaque ? vec3(0.0) : sent;
#endif
    p.light += sent;
    vec3 share = covered * look.passes;

    // What is on either side.
    bool isThin = (look.flags & VT_LOOK_THIN) != 0u || object >= u_scene.x;
    Media before = media, next = media;
    float eta = 1.0 / look.ior;
    bool isInterface = true;
    if (!isThin) {
        uint id = mediumOf(object);
        before = leaving != holds(before, id) ? toggle(before, id) : before;
        next = toggle(before, id);
        next = also >= 0 ? toggle(next, mediumOf(also)) : next;
        uint from = topOf(before), to = topOf(next);
        eta = glassOf(from).x / glassOf(to).x;
        isInterface = from != to;
    }
    bool reflected = false, isStraight = isThin || !isInterface || eta == 1.0;
#ifdef WITH_ROUGH
    bool isMirror = (look.flags & VT_LOOK_MIRROR) != 0u, isBent = isThin ? look.ior != 1.0 : isInterface && (eta != 1.0 || isMirror);
    float alpha = isBent && !isOpaque ? look.roughness * look.roughness : 0.0;
    bool isFacet = BY_CHANCE && alpha > 0.0;
    vec3 smoothN = dot(N, I) < 0.0 ? N : G, chance = chanceOfFacet(p.facets);
    vec3 n = isFacet ? facetNormal(smoothN, I, alpha, chance) : N;
    vec3 T = isStraight ? I : meetInterface(I, n, isFacet ? n : G, eta, reflected);
    n = dot(n, I) < 0.0 ? n : G;
    vec3 R = reflect(I, n);
    if (isFacet) {
        float beyond = reflected ? 1.0 : -1.0;
        R = leaveFacets(R, smoothN, G, alpha, chance);
        // A thin wall sends through what it would mirror, turned to its other side.
        T = isThin ? R - 2.0 * dot(R, G) * G : isStraight ? T : leaveFacets(T, beyond * smoothN, beyond * G, alpha, chance);
        p.facets += 1;
    }
#else
    vec3 n = N, T = isStraight ? I : meetInterface(I, n, G, eta, reflected);
    n = dot(n, I) < 0.0 ? n : G;
    vec3 R = reflect(I, n);
#endif
    R = dot(R, G) > 0.0 ? R : reflect(I, G);
    vec3 F = vec3(reflected ? 1.0 : 0.0);
    if (u_scene.z != 0 && isInterface && !reflected) {
        float cosine = -dot(n, I), smoothIor = isThin ? look.ior : max(eta, 1.0 / eta);
        F = lookReflectance(look, cosine, fresnel(cosine, eta), smoothIor, leaving && !isThin);
    }
    vec3 through = isInterface ? share * (1.0 - F) * look.base.rgb : share, mirrored = share * F;
#ifdef WITH_ROUGH
    bool isScattered = alpha > 0.0;
#else
    const bool isScattered = false;
#endif
    if (isThin && !isScattered) { // the same way as what passes beside it
        through += beside;
        beside = vec3(0.0);
    }
    bool isEvent = !isStraight && strongest(share) > 0.0;
    p.isThroughWall = p.isThroughWall || (isThin && strongest(share) > 0.0);
    if (isEvent && isLast) {
        through = mirrored = vec3(0.0);
        status = VT_PATH_LOST;
    }
#ifdef WITH_ROUGH
    alpha = isFacet ? 0.0 : alpha;
    float c = clamp(-dot(n, I), 0.0, 1.0);
    float curvature = n == G ? 0.0 : 0.5 * (leaving ? -1.0 : 1.0) * (hit.turn[0].x + hit.turn[1].y + hit.turn[2].z);
    vec3 lobe = p.lobe, lobeTurned = lobeMirrored(lobe, c, curvature, alpha), lobePassed = lobe;
    if (isThin) {
        lobePassed = lobeMirrored(lobe, c, 0.0, alpha);
    } else if (!isStraight) {
        lobePassed = reflected ? lobeTurned : lobeThrough(lobe, c, eta, curvature, alpha);
    }
#endif
#ifdef WITH_FOOTPRINT
    STEPS steps = p.footprint.direction;
    p.footprint.place = isStraight ? p.footprint.place : alongSurface(p.footprint.place, I, G);
    STEPS turn = (n == G ? 0.0 : leaving ? -1.0 : 1.0) * (hit.turn * p.footprint.place);
    STEPS passed = isStraight ? steps : bendFootprint(steps, I, n, turn, eta, reflected);
    STEPS turned = bendFootprint(steps, I, n, turn, 1.0, true);
#ifdef WITH_FAN
    float isBentNow = (1.0 - float(isStraight)) * (1.0 - float(reflected));
    passed[2] += isBentNow * bentByIndex(I, n, eta, etaChange(topOf(before), topOf(next), eta));
#endif
#endif
    // What the first surface reflects towards the eye is kept apart, as crossSurface does; nothing lies before it that took
    // light away.
    if (p.events == 0 && !leaving && !reflected && p.transmittance == vec3(1.0)) {
        p.firstPosition = p.position;
        p.firstDirection = R;
        p.firstShare = mirrored;
        mirrored = vec3(0.0);
#ifdef WITH_ROUGH
        p.firstLobe = lobeTurned;
#endif
#ifdef WITH_FOOTPRINT
        p.firstFootprint = Footprint(p.footprint.place, turned);
#endif
    }
    float t = strongest(through), m = strongest(mirrored), b = strongest(beside);
    bool goesThrough = t >= m && t >= b, isMirrored = !goesThrough && m >= b;
    bool keptThrough = !goesThrough && t > 0.0 && setLightAside(p, T, through, next);
    bool keptMirrored = !isMirrored && m > 0.0 && setLightAside(p, R, mirrored, before);
    bool keptBeside = (goesThrough || isMirrored) && b > 0.0 && setLightAside(p, I, beside, before);
#ifdef WITH_FOOTPRINT
    if (keptThrough || keptMirrored || keptBeside) {
        p.asideFootprint.place = p.footprint.place;
        p.asideFootprint.direction = keptBeside ? steps : keptMirrored ? turned : passed;
    }
    p.footprint.direction = goesThrough ? passed : isMirrored ? turned : steps;
#endif
#ifdef WITH_ROUGH
    if (keptThrough || keptMirrored || keptBeside) {
        p.asideLobe = keptBeside ? lobe : keptMirrored ? lobeTurned : lobePassed;
    }
    p.lobe = goesThrough ? lobePassed : isMirrored ? lobeTurned : lobe;
#endif
    p.transmittance = goesThrough ? through : isMirrored ? mirrored : beside;
    p.direction = goesThrough ? T : isMirrored ? R : I;
    media = goesThrough ? next : before;
    p.events += (goesThrough && isEvent) || isMirrored ? 1 : 0;
    p.reflected = p.reflected || (reflected && isMirrored);
    bool goesOn = strongest(p.transmittance) > 1e-4;
    status = goesOn || (isEvent && isLast) ? status : VT_PATH_OPAQUE;
    return goesOn;
}
