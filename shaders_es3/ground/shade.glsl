// What the sun and the lights of files bring to a surface, and what is in their way: rays from the surface towards the
// light through the scene's hierarchy. Opaque things stop them; glass lets pass what it lets pass straight on. The twin of
// src/light/sun.c, which names the sources, and of native/lab/reference/reference_shade.c. WITH_GROUND: glass stops rays as
// well, what it lets pass is photons' (caustics.glsl). Needs chance, cross_surface, search_scene and lighting; WITH_LOOKS:
// looks.glsl defines passedByLook.
uniform vec4 u_sun[4]; // direction, radius; irradiance; the same of the one that the lighting is without

const int MOST_SHADES = 64; // surfaces on a ray: what lies behind more is dark

#ifdef WITH_LOOKS
vec3 passedByLook(Meeting met, SurfaceHit hit, vec3 L, inout Media media);
#endif

// Radiance about a direction that a surface of that roughness reflects to, over the sun's irradiance.
float sunGlare(vec4 sun, vec3 direction, float roughness)
{
    float seen = clamp(0.5 * (sqrt(9.0 + 160.0 * roughness) - 5.0) + 1.0, 0.0, 1.0);
    float r = max(roughness, 0.1), a = min(r * r * r * r + 0.125 * sun.w * sun.w, 0.9), k = 1.0 - a;
    float whole = 1.0 / k - 2.0 * a / (k * k) * log((1.0 + a) / (2.0 * a));
    float cosine = dot(direction, sun.xyz), spread = 1.0 - 0.5 * (1.0 + cosine) * k;
    return seen * max(cosine, 0.0) * a / (4.0 * 3.14159265 * spread * spread * whole);
}

// Towards the sun: its middle in the first sample, in the others a point of its disc.
vec3 towardsSun()
{
    vec2 steps = float(u_sample.x % 4096) * vec2(0.75487767, 0.56984029); // of the root of x^3 = x + 1
    vec2 chance = fract(mixedNumbers(uvec3(gl_FragCoord.xy, 0x30000)).xy + steps);
    float radius = u_sample.y != 0 ? tan(u_sun[0].w) * sqrt(chance.x) : 0.0, angle = 6.2831853 * chance.y;
    vec3 d = u_sun[0].xyz, right = normalize(cross(d, mix(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), step(abs(d.y), 0.9))));
    return normalize(d + radius * (cos(angle) * right + sin(angle) * cross(d, right)));
}

// Does light that glass bends reach the ray's start as photons? Those on reliefs that are met by their heights are not
// gathered.
bool hasPhotons(Start from)
{
#ifdef WITH_GROUND
#ifdef WITH_HEIGHTS
    return !isRelief(from.object);
#else
    return true;
#endif
#else
    return false;
#endif
}

#if defined(WITH_GROUND) && !defined(WITH_HEIGHTS)
// Share of light that comes to the ray's start from the direction L, from so far away: one search tells.
vec3 lightArriving(Start ray, vec3 L, float farthest)
{
    ray.direction = L;
    Meeting met = searchScene(ray);
    float isFree = step(farthest, met.distance);
    return isFree * exp(-min(met.distance, farthest) * glassOf(topOf(ray.media)).yzw);
}
#else
// What an object's surface lets pass straight on. Takes the ray to its other side.
vec3 passedBy(Meeting met, SurfaceHit hit, vec3 L, inout Media media)
{
#ifdef WITH_LOOKS
    return passedByLook(met, hit, L, media);
#else
    uint id = uint(met.object + 1);
    bool leaving = dot(hit.flatNormal, L) > 0.0;
    media = leaving != holds(media, id) ? toggle(media, id) : media;
    uint from = topOf(media);
    media = toggle(media, id);
    media = met.also >= 0 ? toggle(media, uint(met.also + 1)) : media;
    float eta = glassOf(from).x / glassOf(topOf(media)).x;
    float reflected = eta == 1.0 || u_scene.z == 0 ? 0.0 : fresnel(abs(dot(hit.normal, L)), min(eta, 1.0 / eta));
    return (1.0 - reflected) * (from != topOf(media) ? readTint(met.object) : vec3(1.0));
#endif
}

// Share of light that comes to the ray's start from the direction L, from so far away.
vec3 lightArriving(Start ray, vec3 L, float farthest)
{
    vec3 share = vec3(1.0);
    float left = farthest;
    bool stops = hasPhotons(ray);
    ray.direction = L;
    for (int i = 0; i < MOST_SHADES; ++i) {
        Meeting met = searchScene(ray);
        bool isMet = met.triangle != VT_NO_TRIANGLE && met.distance < left;
        share *= exp(-min(met.distance, left) * glassOf(topOf(ray.media)).yzw);
        left -= met.distance;
#ifdef WITH_LOOKS
        bool goesOn = isMet && !stops;
#else
        bool goesOn = isMet && !stops && met.object < u_scene.x;
#endif
        share *= isMet && !goesOn ? 0.0 : 1.0;
        if (goesOn) {
            vec3 at = ray.position + met.distance * L;
            SurfaceHit hit = meetingSurface(met, at);
            Media media = ray.media;
            share *= passedBy(met, hit, L, media);
            ray = Start(at, L, media, met.object, met.triangle, false, met.object < u_scene.x, false);
        }
        share *= i == MOST_SHADES - 1 && goesOn ? 0.0 : 1.0;
        if (!goesOn || strongest(share) < 1e-4) {
            break;
        }
    }
    return share;
}
#endif

// Radiance that a surface sends of the sun's light, if nothing is in the way; L: the direction towards it. R: mirrored
// direction of sight; matt: its colour; glossy: share that it reflects about R.
vec3 sunLight(vec3 N, vec3 R, vec3 matt, vec3 glossy, float roughness, out vec3 L)
{
    L = towardsSun();
    return u_sun[1].rgb * (matt * max(dot(N, L), 0.0) / 3.14159265 + glossy * sunGlare(u_sun[0], R, roughness));
}

// What is left of light from a direction where things are in the way. G: of the triangle, on the viewer's side.
vec3 withShadows(Start from, vec3 G, vec3 L, float distance, vec3 light)
{
    light *= step(1e-4, dot(G, L));
    if (strongest(light) > 1e-5) {
        light *= lightArriving(from, L, distance);
    }
    return light;
}

// Radiance of a matt white surface by photons. `at`: weights of the second and third corner; behind: its triangle faces
// away from the viewer.
vec3 photonLight(Start from, vec2 at, bool behind)
{
    vec3 light = vec3(0.0);
#ifdef WITH_GROUND
    if (hasPhotons(from)) {
        light = causticLight(from.object, from.triangle, at, behind) / 3.14159265;
    }
#endif
    return light;
}
