// Rays for the light on the ground, in place of those from the eye: from the ground towards a light, to see whether
// something is in its way, or from a light through the glass, to see where it comes down. The twin of src/light/ground.c,
// which names the sources and adds up what is found. A photon's path parts once at its first surface, and once more within
// the glass; each part has a target. Where glass disperses a photon has one wavelength, and where glass is rough it meets one
// facet at each surface; both are spread evenly over photons that lie side by side. Needs what trace.frag needs, and that
// before it.
uniform usampler2D u_groundLights; // directions towards the lights (bits of floats), 64 x 64 texels a list
uniform vec4 u_ground;             // height; the map's corner, x and z; its side
uniform vec4 u_groundRays;         // the list; 1: photons; diagonal of the scene; rays along a side of the target

uniform vec4 u_groundBox[2];       // that photons go through, world
uniform vec4 u_groundLight[2];     // place of a light, 1; or the direction towards it, 2; 0: it is the list. Of one that has
                                   // a place: photons go about this axis, in an angle of that cosine

layout(location = 2) out uvec4 o_third;

uint scramble(uint x)
{
    x ^= x >> 16u;
    x *= 0x7feb352du;
    x ^= x >> 15u;
    x *= 0x846ca68bu;
    return x ^ (x >> 16u);
}

uint sampleOf(uvec2 pixel, uint across)
{
    uint order = 0u;
    for (uint bit = 0u; bit < 3u; ++bit) {
        uvec2 b = (pixel >> bit) & 1u;
        order = 4u * order + 2u * (b.x ^ b.y) + b.y;
    }
    uint seed = uint(u_groundSeed), part = uint(VT_GROUND_SAMPLES / 64);
    order ^= seed; // other strata in each 4 x 4 of them
    return order * part + scramble(pixel.x + pixel.y * across + seed) % part;
}

// The directions of a cone, as evenly as the square.
vec3 inCone(vec2 place)
{
    vec3 axis = u_groundLight[1].xyz, right = normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    float cosine = 1.0 - place.x * (1.0 - u_groundLight[1].w), angle = 6.2831853 * place.y;
    return sqrt(max(1.0 - cosine * cosine, 0.0)) * (cos(angle) * right + sin(angle) * cross(axis, right)) + cosine * axis;
}

#ifdef WITH_SPECTRAL
vec3 g_color; // of its wavelength, linear sRGB over VT_PHOTON_MOST
#else
const vec3 g_color = vec3(1.0);
#endif

Path startPhoton(vec3 position, vec3 direction)
{
#ifdef WITH_FOOTPRINT
    return startPath(position, direction, Footprint(STEPS(0.0), STEPS(0.0))); // pictures are seen as they are
#else
    return startPath(position, direction);
#endif
}

// What is left of its light, which has parts below 0 where it has one wavelength; the rest of the fourth word is free.
uvec2 packLight(vec3 light)
{
    light *= g_color;
    return uvec2(packSnorm2x16(light.rg), packSnorm2x16(vec2(light.b, 0.0)));
}

// Where a photon comes down (bits of floats) and what is left of its light; 0: nothing.
uvec4 landing(Path p, int status)
{
    float down = -p.direction.y, height = max(p.position.y - u_ground.x, 0.0);
    vec2 at = p.position.xz + height / max(down, 1e-6) * p.direction.xz;
    bool isDown = status == VT_PATH_EXITED && down > 1e-6;
    vec3 left = isDown ? p.transmittance : vec3(0.0);
    return uvec4(floatBitsToUint(at), packLight(left));
}

#if defined(WITH_OPAQUE) && !defined(ONLY_HEIGHTS)
// The same of one that comes down on something opaque: triangle, place on it, light; object, and whether it comes from
// behind.
uvec4 landingOnOpaque(Path p, Meeting met)
{
    vec3 area = normalToWorld(readTransform(met.object), cornersArea(recordCorners(met.triangle)));
    uint bits = 4u | (dot(area, p.direction) > 0.0 ? 8u : 0u) | uint(met.object) << 4u;
    return uvec4(met.triangle, packUnorm2x16(met.at), packLight(p.transmittance) | uvec2(0u, bits << 16u));
}
#endif

void main()
{
#ifdef ONE_OBJECT
    readObject();
#endif
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    int index = int(sampleOf(pixel, uint(u_groundRays.w)));
    ivec2 texel = ivec2(index % 64, index / 64 + 64 * int(u_groundRays.x));
    vec3 listed = uintBitsToFloat(readTexel(u_groundLights, texel, textureSize(u_groundLights, 0)).xyz);
    bool isNear = u_groundLight[0].w == 1.0, isPhoton = u_groundRays.y != 0.0;
    // A lattice rather than a grid: light that spreads would show the grid's lines.
    vec2 place = vec2(floor(gl_FragCoord.x) + fract(0.61803399 * float(pixel.y)), gl_FragCoord.y) / u_groundRays.w;

    vec3 ground = vec3(u_ground.y + place.x * u_ground.w, u_ground.x, u_ground.z + place.y * u_ground.w);
    vec3 light = isNear ? isPhoton ? -inCone(place.yx) : normalize(u_groundLight[0].xyz - ground)
                        : mix(listed, u_groundLight[0].xyz, step(1.0, u_groundLight[0].w));
    ground -= VT_GROUND_BELOW * u_groundRays.z / light.y * light;
    vec3 right = normalize(cross(light, abs(light.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    vec3 up = cross(light, right), extent = 0.5 * (u_groundBox[1].xyz - u_groundBox[0].xyz);
    vec2 across = vec2(dot(abs(right), extent), dot(abs(up), extent)) * (2.0 * place - 1.0);
    vec3 above = 0.5 * (u_groundBox[0].xyz + u_groundBox[1].xyz) + across.x * right + across.y * up + 1.5 * u_groundRays.z * light;

    vec3 start = isPhoton ? (isNear ? u_groundLight[0].xyz : above) : ground;
#ifdef WITH_SPECTRAL
    vec4 spectrum = SPECTRUM[wavelengthOfPhoton()];
    g_spread = spectrum.a;
    g_color = spectrum.rgb / VT_PHOTON_MOST;
#endif
    Path p = startPhoton(start, isPhoton ? -light : light);
    p.choice = -1.0; // the stronger part
    p.events = isPhoton ? 0 : 1000; // of a shade ray the first event is one too many
    Media media = AIR, asideMedia = AIR;
    vec3 firstPosition = start, firstDirection = light, firstLight = vec3(0.0);
    vec3 asidePosition = start, asideDirection = light, asideLight = vec3(0.0);
    uvec4 own = uvec4(0u), first = uvec4(0u), third = uvec4(0u);
    for (int i = 0; i < 3; ++i) { // the path itself, what its first surface reflects, what left it later
        End end = followPath(p, media, false, false);
        uvec4 landed = landing(p, end.status);
#if defined(WITH_OPAQUE) && !defined(ONLY_HEIGHTS)
        bool isOnOpaque = isPhoton && end.status == VT_PATH_OPAQUE && end.meeting.triangle != VT_NO_TRIANGLE;
#ifdef WITH_HEIGHTS
        isOnOpaque = isOnOpaque && !isRelief(end.meeting.object);
#endif
        if (isOnOpaque && (i > 0 || end.isBent)) {
            landed = landingOnOpaque(p, end.meeting);
        }
#endif
        bool isOwn = i == 0;
        if (isOwn) {
            // Bits: it is out, wherever it goes; it has met something.
            bool isBeyond = isNear && !isPhoton && distance(p.position, start) > distance(u_groundLight[0].xyz, start);
            landed.w |= (end.status == VT_PATH_EXITED || isBeyond ? 0x10000u : 0u);
            landed.w |= p.position != start && !isBeyond ? 0x20000u : 0u;
            own = landed;
            firstPosition = p.firstPosition;
            firstDirection = p.firstDirection;
            firstLight = vec3(p.firstShare);
            asidePosition = p.asidePosition;
            asideDirection = p.asideDirection;
            asideLight = p.aside;
            asideMedia = p.asideMedia;
        }
        first = i == 1 ? landed : first;
        third = i == 2 ? landed : third;
        p = startPhoton(isOwn ? firstPosition : asidePosition, isOwn ? firstDirection : asideDirection);
        p.transmittance = isOwn ? firstLight : asideLight;
        p.choice = -1.0;
        p.events = 1;
#ifdef WITH_ROUGH
        p.facets = 64 * (i + 1);
#endif
        if (!isOwn) {
            media = asideMedia;
        }
        if (!isPhoton || strongest(isOwn ? max(firstLight, asideLight) : asideLight) < VT_LEAST_BRANCH) {
            break;
        }
    }
    o_path = own;
    o_radiance = first;
    o_third = third;
}
