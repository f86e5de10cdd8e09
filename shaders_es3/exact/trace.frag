// Techniques `exact` and `heightfield` in one pass: follows each pixel's path through the glass, event by event, until
// it has left all glass for good or ends on something opaque, then the light that left it on the way, and sums up what
// comes back. What is seen first is found by the same search.
uniform int u_branches; // times that light which left a path is followed

layout(location = 0) out uvec4 o_path;     // last direction (bits of three floats), state
layout(location = 1) out uvec4 o_radiance; // bits of floats: linear light after exposure, share of the pixel it covers
#ifdef WITH_DEPTH
layout(location = 2) out uint o_depth; // bits of a float: of what is seen first, in front of the eye; 0: nothing
#endif

// Far more surfaces than paths meet, so that no fault of the data hangs the GPU.
const int MOST_SURFACES = 256;

// What became of a path; where it ends on something opaque, where.
struct End {
    int status;
    Meeting meeting;
#ifdef WITH_SHADE
    Media media; // that it ends in
#endif
#ifdef WITH_PHOTONS
    bool isBent; // it has come through something
#endif
#ifdef SPREADS
    vec3 from, share; // where its last way begins, and the light that there is of it there
    bool isInAir;     // what that leads through
#endif
};

// Light that left a path is followed always where its share is at least this; less of it with a chance, where chance
// chooses.
const float SURE_BRANCH = 0.05;
const int MOST_PATHS = 64; // of a pixel, where chance chooses: they end long before

const Meeting NO_MEETING = Meeting(NOWHERE, VT_NO_TRIANGLE, vec2(0.0), -1, -1);

End noEnd(int status)
{
    End end;
    end.status = status;
    end.meeting = NO_MEETING;
#ifdef WITH_SHADE
    end.media = AIR;
#endif
#ifdef WITH_PHOTONS
    end.isBent = false;
#endif
#ifdef SPREADS
    end.from = vec3(0.0);
    end.share = vec3(0.0);
    end.isInAir = false;
#endif
    return end;
}

// Where the host draws what is opaque, seen directly it covers nothing of the pixel; glass that lets nothing through is not
// drawn by the host.
int leftToHost(bool isEye, int status)
{
#if defined(WITH_HOST) && defined(WITH_OPAQUE)
    return isEye && status == VT_PATH_OPAQUE && (u_host.w & 16) != 0 ? VT_PATH_BACKGROUND : status;
#else
    return status;
#endif
}

// isFresh: the path begins at the eye. isDirect: glass does not count, only what is opaque.
End followPath(inout Path p, Media media, bool isFresh, bool isDirect)
{
    End end = noEnd(VT_PATH_LOST);
#ifdef WITH_DEPTH
    float depth = 0.0;
#endif
    Start start = Start(p.position, p.direction, media, -1, VT_NO_TRIANGLE, isFresh, false, isDirect);
    // What is read after the loop is kept from round to round: software renderers (Mesa 22.3) spoil it otherwise.
    for (int surface = 0; surface < MOST_SURFACES; ++surface) {
        Meeting met = searchScene(start);
        bool isMet = met.triangle != VT_NO_TRIANGLE;
#ifdef WITH_LOOKS
        const bool isOpaque = false; // crossLook says how much of it is
#elif defined(WITH_OPAQUE)
        bool isOpaque = isMet && met.object >= u_scene.x;
#else
        const bool isOpaque = false;
#endif
        bool isLast = p.events >= u_search.w;
        bool isOut = !isMet && (start.media == AIR || isDirect);
        end.status = isOut ? (start.isEye ? VT_PATH_BACKGROUND : VT_PATH_EXITED) : isOpaque ? VT_PATH_OPAQUE : end.status;
        end.status = leftToHost(start.isEye, end.status);
#ifdef WITH_LOOKS
        bool more = isMet;
#else
        bool more = isMet && !isOpaque && !isLast;
#endif
#ifdef WITH_PHOTONS
        more = more && p.events < 1000; // a shade ray ends at the first surface
#endif
#ifdef WITH_DEPTH
        depth = isMet && start.isEye ? met.distance * (mat3(u_worldToCamera) * p.direction).z : depth;
#endif
#if defined(WITH_OPAQUE) && !defined(WITH_LOOKS) // WebGL has no ?: of structures
        end.meeting.triangle = isOpaque ? met.triangle : end.meeting.triangle;
        end.meeting.at = isOpaque ? met.at : end.meeting.at;
        end.meeting.object = isOpaque ? met.object : end.meeting.object;
#ifdef WITH_PHOTONS
        end.isBent = surface > 0;
#endif
#endif
#ifdef WITH_SHADE
        end.media = start.media;
#endif
#ifdef SPREADS
        end.from = p.position;
        end.share = p.transmittance;
        end.isInAir = start.media == AIR;
#endif
        if (isOpaque) {
            absorb(p, start.media, met.distance);
#ifdef SPREADS
            p.lobe = lobeAfter(p.lobe, met.distance);
#endif
        }
        p.position += isMet ? met.distance * p.direction : vec3(0.0);
#ifdef WITH_FOOTPRINT
        p.footprint.place += (isMet ? met.distance : 0.0) * p.footprint.direction;
#endif
#ifdef WITH_LOOKS
        if (more) {
            absorb(p, start.media, met.distance);
#ifdef WITH_ROUGH
            p.lobe = lobeAfter(p.lobe, met.distance);
#endif
            media = start.media;
            SurfaceHit hit = meetingSurface(met, p.position);
#ifdef WITH_FOOTPRINT
            float width = footprintWidth(p.footprint.place - outerProduct(p.direction, p.direction * p.footprint.place));
#ifdef WITH_ROUGH
            width = lobeWidth(width, p.lobe.x);
#endif
#else
            const float width = 0.0; // there are no pictures
#endif
            Look look = lookAt(met, hit, width);
#ifdef WITH_PHOTONS
            end.isBent = surface > 0;
            vec3 arriving = look.base.a * p.transmittance;
#endif
            more = crossLook(p, media, look, hit, met, isLast, end.status);
            end.status = leftToHost(start.isEye && met.object >= u_scene.x, end.status);
            more = more && (p.events < u_search.w || media == AIR);
#ifdef WITH_PHOTONS
            bool isLanding = end.status == VT_PATH_OPAQUE;
            p.transmittance = mix(p.transmittance, arriving, bvec3(isLanding));
            end.meeting.triangle = isLanding ? met.triangle : end.meeting.triangle;
            end.meeting.at = isLanding ? met.at : end.meeting.at;
            end.meeting.object = isLanding ? met.object : end.meeting.object;
#endif
            bool isBehind = met.object < u_scene.x && dot(p.direction, look.G) * dot(start.direction, look.G) > 0.0;
            start = Start(p.position, p.direction, media, met.object, met.triangle, false, isBehind, isDirect);
        }
#else
        if (more) {
            SurfaceHit hit = meetingSurface(met, p.position);
            Media before = start.media;
#ifdef ONE_OBJECT
            if (start.isEye) { // the first surface tells what the eye is within
                before = dot(hit.flatNormal, p.direction) > 0.0 ? toggle(AIR, uint(met.object + 1)) : AIR;
            }
#endif
            media = before;
            crossSurface(p, media, met.distance, hit, met.also);
            more = p.events < u_search.w || media == AIR;
            start = Start(p.position, p.direction, media, met.object, met.triangle, false, media != before, false);
        }
#endif
        if (!more) {
            break;
        }
    }
#ifdef WITH_DEPTH
    o_depth = isFresh ? floatBitsToUint(depth) : o_depth;
#endif
    return end;
}

#ifdef WITH_FAN
// Light from beyond the scene along a path: of the first sample at eight wavelengths, whose paths lie beside it.
vec3 spectralSurroundings(Path p, float width, vec3 lobe)
{
    vec3 turn = p.footprint.direction[2], place = p.footprint.place[2], light = vec3(0.0);
    bool isFan = u_sample.y == 0 && dot(turn, turn) > 1e-8;
    for (int i = 0; i < 8; ++i) {
        vec4 part = mix(vec4(1.0, 1.0, 1.0, g_spread), FAN[i], bvec4(isFan));
        float step = part.a - g_spread;
        vec3 position = p.position + step * place;
        vec3 direction = mix(p.direction, normalize(p.direction + step * turn), bvec3(isFan));
#ifdef WITH_BACKDROP
        light += part.rgb * surroundings(position, direction, width, lobe, p.footprint);
#else
        light += part.rgb * surroundings(position, direction, width, lobe);
#endif
        if (!isFan) {
            break;
        }
    }
    return light;
}
#endif

// Light that a ray brings from its end; what is opaque there, if anything.
vec3 lightAlong(Path p, End end)
{
    float width = 0.0; // of what the pixel covers: only pictures ask for it
    Meeting opaque = end.meeting;
#ifdef WITH_FOOTPRINT
    width = footprintWidth(p.footprint.direction);
#endif
#ifdef WITH_ROUGH
    vec3 lobe = p.lobe;
#else
    const vec3 lobe = vec3(0.0);
#endif
#if defined(WITH_FAN)
    vec3 light = spectralSurroundings(p, width, lobe);
#elif defined(WITH_BACKDROP)
    vec3 light = surroundings(p.position, p.direction, width, lobe, p.footprint); // a lost path sees it, too
#else
    vec3 light = surroundings(p.position, p.direction, width, lobe);
#endif
#if defined(WITH_OPAQUE) && !defined(WITH_LOOKS)
    if (opaque.triangle != VT_NO_TRIANGLE) {
#if defined(ONLY_HEIGHTS)
        OpaqueSurface at = opaqueHeights(opaque.object, opaque.triangle, p.position);
#else
        OpaqueSurface at;
#ifdef WITH_HEIGHTS
        if (isRelief(opaque.object)) {
            at = opaqueHeights(opaque.object, opaque.triangle, p.position);
        } else
#endif
        {
            at = opaqueSurface(opaque.object, RecordHit(0.0, opaque.triangle, opaque.at));
        }
#endif
#ifdef WITH_SHADE
        at.from = Start(p.position, p.direction, end.media, opaque.object, opaque.triangle, false, false, false);
        at.corner = opaque.at;
#endif
#ifdef WITH_FOOTPRINT
#ifdef WITH_ROUGH
        p.footprint = lobeFootprint(p.footprint, p.direction, p.lobe);
#endif
        light = shadeOpaque(opaque.object, at, p.direction, p.footprint);
#else
        light = shadeOpaque(opaque.object, at, p.direction, 0.0); // no picture is seen
#endif
#ifdef WITH_HOST
        light = asHostShows(p.position, light);
#endif
    }
#endif
    return light;
}

vec3 lightOfEnd(Path p, End end)
{
#ifdef WITH_LOOKS
    p.transmittance *= end.status == VT_PATH_OPAQUE ? 0.0 : 1.0; // all its light is there
#endif
    vec3 light = p.transmittance * lightAlong(p, end);
#if defined(WITH_LOOKS) && defined(SPREADS)
    light += p.seen;
#endif
    return light;
}

#ifndef WITH_PHOTONS // photons.frag has its own
void writeLight(vec3 light, int status)
{
#ifdef WITH_GROUND
    if (status == VT_PATH_BACKGROUND && u_output.w != 0) {
        vec2 tangent = pictureTangent(gl_FragCoord.xy);
        vec4 seen = groundOverPage(eyePosition(tangent), cameraDirection(tangent), light);
        o_radiance = floatBitsToUint(vec4(seen.rgb * u_optics.z, seen.a));
        return;
    }
#endif
    float share = status == VT_PATH_BACKGROUND && u_output.w != 0 ? 0.0 : 1.0; // the page shows behind the glass
    o_radiance = floatBitsToUint(vec4(light * u_optics.z * share, share));
}

// What a pixel sees; what became of its own path.
vec3 lightOfPixel(out int status)
{
    vec2 tangent = pictureTangent(gl_FragCoord.xy);
    vec3 view = cameraDirection(tangent);
#ifdef WITH_FOOTPRINT
    Footprint footprint = eyeFootprint(tangent, view), firstFootprint = footprint;
#endif
    Path p = startPath(eyePosition(tangent), view AND_FOOTPRINT);
#ifdef STRICT
    End end = followPath(p, AIR, true, false);
    o_path = uvec4(floatBitsToUint(p.direction), pathState(p, end.status));
    status = end.status;
    return lightOfEnd(p, end);
#else
    Media media = AIR;
    vec3 light = vec3(0.0);
    uvec4 path = uvec4(0u);
    int left = u_branches;
    status = VT_PATH_LOST;
#ifdef WITH_ROUGH
    vec3 firstLobe = vec3(0.0);
#endif
    bool isDirect = false, byChance = u_sample.y != 0;
    p.choice = byChance ? chanceOf(0) : p.choice;
    // The pixel's own path, the light that left it and that in turn, what left the last of them, and the first
    // surface's reflection; the last two are not followed through glass.
    vec3 firstPosition = vec3(0.0), firstDirection = vec3(1.0, 0.0, 0.0), firstLight = vec3(0.0);
    for (int i = 0; i < MOST_PATHS; ++i) {
        bool isOwn = i == 0;
        End end = noEnd(VT_PATH_EXITED);
#ifdef SPREADS
        Beam beam = Beam(false, vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
        for (int ray = 0; ray <= LOBE_RAYS; ++ray) {
            End met = followPath(p, media, isOwn && ray == 0, isDirect || ray > 0);
            if (ray == 0) {
                end.status = met.status;
                beam = beamOf(p, met.from, met.share, !byChance && met.isInAir);
                p.lobe *= beam.isSpread ? LOBE_PART : 1.0;
            }
            light += lightOfEnd(p, met) / (beam.isSpread ? float(LOBE_RAYS + 1) : 1.0);
            if (!beam.isSpread) {
                break;
            }
            turnAside(p, beam, ray + 1);
        }
        p.direction = beam.ahead;
#else
#ifndef WITH_OPAQUE // a direct ray meets nothing
        if (!isDirect)
#endif
        {
            end = followPath(p, media, isOwn, isDirect);
        }
        light += lightOfEnd(p, end);
#endif
#ifdef WITH_LOOKS
        light += p.light;
#endif
        if (isOwn) {
            status = end.status;
            path = uvec4(floatBitsToUint(p.direction), pathState(p, status));
            firstPosition = p.firstPosition;
            firstDirection = p.firstDirection;
#ifdef WITH_FOOTPRINT
            firstFootprint = p.firstFootprint;
#endif
            firstLight = vec3(p.firstShare);
#ifdef WITH_ROUGH
            firstLobe = p.firstLobe;
#endif
        }
        float share = strongest(p.aside), chance = byChance ? min(share / SURE_BRANCH, 1.0) : 1.0;
        bool isAside = share > 0.0 && p.choice < chance; // without chance the choice is below 0
        vec3 next = isAside ? p.aside / chance : firstLight;
        isDirect = !byChance && (!isAside || left == 0 || strongest(next) < VT_LEAST_BRANCH);
        --left;
        int events = byChance && isAside ? p.asideEvents : 1;
        media = p.asideMedia;
#ifdef WITH_ROUGH
        vec3 lobe = isAside ? p.asideLobe : firstLobe;
#endif
#ifdef WITH_FOOTPRINT
        footprint.place = isAside ? p.asideFootprint.place : firstFootprint.place;
        footprint.direction = isAside ? p.asideFootprint.direction : firstFootprint.direction;
#endif
        p = startPath(isAside ? p.asidePosition : firstPosition, isAside ? p.asideDirection : firstDirection AND_FOOTPRINT);
        p.transmittance = next;
#ifdef WITH_ROUGH
        p.lobe = lobe;
        p.facets = 64 * (i + 1);
#endif
        p.choice = byChance ? chanceOf(i + 1) : -1.0;
        p.events = events; // it met the surface that it left the path at
        firstLight = isAside ? firstLight : vec3(0.0);
        if (strongest(next) <= 0.0) { // asked here: software renderers run a loop asked at its beginning once more
            break;
        }
    }
    o_path = path;
    return light;
#endif
}

void main()
{
#ifdef ONE_OBJECT
    readObject();
#endif
    int status;
#ifdef WITH_SPECTRAL
    vec3 light = vec3(0.0);
    for (int part = 0; part < 3; ++part) {
        vec3 color = startWavelength(part);
        vec3 seen = lightOfPixel(status);
        if (g_isDispersed) {
            seen *= color;
        }
        light += seen;
        if (part + 1 >= wavelengthCount() || !g_isDispersed) {
            break;
        }
    }
#else
    vec3 light = lightOfPixel(status);
#endif
    writeLight(light, status);
}
#endif
