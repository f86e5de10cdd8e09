// This work is based on: Turner Whitted. An Improved Illumination Model for Shaded Display. 1980; of rough
// surfaces see reference_rough.c, of wavelengths reference_spectrum.c; James Arvo, David Kirk. Particle
// Transport and Image Synthesis. 1990 (Russian roulette).
//
// Departures:
//  - A path of little light goes on by chance, and then counts for as much as those that do not; where no
//    light is asked for it is left out.
//  - A rough surface parts light at the first facet that is met, as a smooth one does; what meets facets
//    again goes one way of two by chance.
//  - Light is white until it enters glass that parts it. What is mirrored from outside stays white, each
//    channel by the mean index that it sees.
#include "lab/reference/reference_events.h"

#include <math.h>

#include "base/optics.h"
#include "lab/reference/reference_chance.h"
#include "lab/reference/reference_rough.h"
#include "lab/reference/reference_shade.h"
#include "lab/reference/reference_spectrum.h"
#include "mesh/mesh_triangle.h"
#include "scene/material.h"

/// A path of less than this share of the pixel's light goes on by chance: a fifth of a step of 8 bits near
/// white. Where glass is clear 0.04 reflects, so two reflections in a row are always followed.
static const float leastWeight = 0.002f;

/// Surfaces that a path passes by without an event before it is given up: an endless loop otherwise, should
/// rounding ever make one.
enum { maxPasses = 10000 };

/// Facets of a rough surface that light meets before it leaves as it happens to go. One path of 10^4 gets
/// there where alpha is 1.
enum { maxFacets = 24 };

/// A surface of less alpha is smooth.
static const float leastAlpha = 1e-4f;

/// What a path's parts are told apart by.
enum { partThrough = 1, partMirrored, partBeside, partGreen, partBlue };

static float largest(vtVec3 v)
{
    return fmaxf(fmaxf(fabsf(v.x), fabsf(v.y)), fabsf(v.z)); // light of one wavelength has parts below 0
}

static vtVec3 mirror(vtVec3 I, vtVec3 N)
{
    return vtNormalize(vtMulAdd(I, -2.0f * vtDot(N, I), N));
}

bool vtEndPath(vtReferencePath* path, uint8_t state)
{
    path->state = state;
    path->ended = true;
    return false;
}

/// Does a part of the path of that weight go on? Where there is little of it by chance.
static bool keeps(const vtPathRules* rules, const vtReferencePath* path, uint32_t part, vtVec3* weight)
{
    const float share = largest(*weight);
    if (share >= leastWeight) {
        return true;
    }
    uint32_t row = vtMixWords(vtMixWords(path->key, vt_chanceKeep + 16 * part), rules->sample);
    if (!rules->chance || !(vtChance_Next(&row) * leastWeight < share)) {
        return false;
    }
    *weight = vtScale(*weight, leastWeight / share);
    return true;
}

// ------------------------------------------------------------------------------------------------ glass

static float iorOf(const vtPathRules* rules, const vtPlacedObject* object)
{
    return rules->ior > 0.0f && !object->material->opaque ? rules->ior : vtMaterial_Index(object->material);
}

static float dispersionOf(const vtReference* reference, const vtPathRules* rules, uint32_t id)
{
    return id == 0 ? 0.0f : vtMaterial_Dispersion(reference->objects[id - 1].material, rules->dispersion);
}

/// Of what is within a medium, for light of that spread.
static float indexAt(const vtReference* reference, const vtPathRules* rules, uint32_t id, float spread)
{
    return id == 0 ? 1.0f
                   : vtDispersedIndex(iorOf(rules, &reference->objects[id - 1]),
                                      dispersionOf(reference, rules, id), spread);
}

float vtIndexOf(const vtReference* reference, const vtPathRules* rules, const vtReferencePath* path,
                uint32_t id)
{
    return path->parted ? indexAt(reference, rules, id, path->spread)
           : id == 0    ? 1.0f
                        : iorOf(rules, &reference->objects[id - 1]);
}

/// Of plain glass, which sends nothing by itself: all that meetGlass asks for, and no more, since the time of
/// plain glass is what others are measured by.
static void lookAtPlain(const vtPathRules* rules, const vtPlacedObject* object, const vtSurfaceHit* hit,
                        vtLook* seen)
{
    vtVec3 normals[3];
    vtMesh_Normals(object->mesh, hit->triangle, normals);
    seen->N = vtNormalize(vtTransformNormal(&object->toObject, vtBlend(normals, hit->u, hit->v)));
    seen->base = object->material->tint;
    seen->coverage = seen->passes = seen->specular = 1.0f;
    seen->specularColor = (vtVec3){1.0f, 1.0f, 1.0f};
    seen->film = 0.0f;
    seen->mirror = false;
    seen->ior = iorOf(rules, object);
    seen->roughness = vtMaterial_Roughness(object->material, rules->roughness);
}

/// What the surface is like, and what it sends to the eye by itself.
static void look(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                 const vtSurfaceHit* hit, vtLook* seen)
{
    const vtPlacedObject* object = &reference->objects[hit->object];
    if (object->plain && !object->material->opaque) {
        lookAtPlain(rules, object, hit, seen);
        return;
    }
    *seen = vtLookAt(reference->scene, object, hit->triangle, hit->u, hit->v, iorOf(rules, object),
                     rules->roughness);
    if (rules->illumination != NULL && !path->mirrored) { // else it is there already
        const vtVec3 I = path->direction;
        const float side = vtDot(seen->G, I) > 0.0f ? -1.0f : 1.0f;
        const vtVec3 N = vtScale(vtDot(vtScale(seen->N, side), I) < 0.0f ? seen->N : seen->G, side);
        const bool casts = reference->glassCount < reference->objectCount; // else nothing is dark
        const vtShadeRays rays = vtMakeShadeRays(reference, rules, path, hit);
        const vtVec3 sent = vtLook_SentLight(seen, rules->illumination, casts ? &rays.shadows : NULL, N, I,
                                             rays.start.origin, rules->exposure);
        path->light = vtMulAdd(path->light, seen->coverage, vtMultiply(path->weight, sent));
    }
}

// ----------------------------------------------------------------------------------------------- opaque

bool vtMeetOpaque(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                  const vtSurfaceHit* opaque)
{
    vtLook seen;
    look(reference, rules, path, opaque, &seen);
    vtVec3 beside = vtScale(path->weight, 1.0f - seen.coverage);
    if (!keeps(rules, path, partBeside, &beside)) {
        path->end = *opaque;
        return vtEndPath(path, VT_PATH_OPAQUE);
    }
    path->weight = beside;
    path->key = vtMixWords(path->key, partBeside);
    path->nudged = false;
    path->passed = fmaxf(path->passed, opaque->distance);
    return ++path->passes < maxPasses || vtEndPath(path, VT_PATH_LOST);
}

// ------------------------------------------------------------------------------------------------- ways

/// Lets the path begin anew on the surfaces met; the first says where that is.
static void startAt(const vtReference* reference, vtReferencePath* path, const vtPlace* place)
{
    const vtSurfaceHit* first = place->surfaces[0].hit;
    path->origin = vtSurfacePoint(&reference->objects[first->object], first);
    path->near = VT_START_DISTANCE * reference->extent;
    path->passed = 0.0f;
    path->nudged = false;
    path->startCount = 0;
    for (int i = 0; i <= place->count; ++i) {
        const vtSurfaceHit* hit = i < place->count ? place->surfaces[i].hit : place->opaque;
        if (hit->triangle != VT_NO_TRIANGLE) {
            path->startObjects[path->startCount] = hit->object;
            path->startTriangles[path->startCount++] = hit->triangle;
        }
    }
}

/// Lets the path go straight on from the surfaces met.
static void pass(vtReferencePath* path, const vtPlace* place)
{
    for (int i = 0; i < place->count; ++i) {
        path->passed = fmaxf(path->passed, place->surfaces[i].hit->distance);
    }
    path->nudged = false;
    ++path->passes;
}

/// What part of a path's light goes a way of its own.
typedef struct Way {
    vtVec3 weight, direction;
    vtMedia within;
    uint32_t part;
    bool straight, counts; ///< it goes on as it came; it is an event
    bool through;          ///< it ends up on the other side
} Way;

/// Sends the path on its way from the surfaces met.
static void send(const vtReference* reference, vtReferencePath* path, const vtPlace* place, const Way* way)
{
    path->weight = way->weight;
    path->direction = way->direction;
    path->within = way->within;
    path->key = vtMixWords(path->key, way->part);
    path->mirrored = false;
    if (way->straight) {
        pass(path, place);
    } else {
        startAt(reference, path, place);
        path->passes += !way->counts;
    }
}

/// Counts the event, if it is one; what is opaque and touches the glass comes after it. False where the path
/// ends.
static bool leaveSurface(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                         const vtPlace* place, bool counts, bool goesThrough)
{
    if (counts && ++path->events >= rules->maxEvents && vtMedia_Top(&path->within) != 0) {
        return vtEndPath(path, VT_PATH_LOST);
    }
    if (path->passes >= maxPasses) {
        return vtEndPath(path, VT_PATH_LOST);
    }
    return !goesThrough || place->opaque->triangle == VT_NO_TRIANGLE ||
           vtMeetOpaque(reference, rules, path, place->opaque);
}

/// Lets light that leaves the path branch off, unless there is too little of it.
static void branchOff(const vtReference* reference, const vtPathRules* rules, const vtReferencePath* path,
                      const vtPlace* place, const Way* way, vtBranches* branches)
{
    Way kept = *way;
    if (!keeps(rules, path, way->part, &kept.weight)) {
        return;
    }
    vtReferencePath* branch = &branches->paths[branches->count++];
    *branch = *path;
    branch->light = (vtVec3){0.0f, 0.0f, 0.0f};
    send(reference, branch, place, &kept);
    leaveSurface(reference, rules, branch, place, way->counts, way->through);
}

// ------------------------------------------------------------------------------------------------ glass

/// A path at a surface of glass.
typedef struct Crossing {
    vtLook seen;
    vtVec3 I, N, G; ///< direction; normals against it: the one that counts, the triangle's
    vtVec3 given;   ///< the look's own, turned
    const vtIndices* indices;
    bool behind, thin, reflects; ///< reflects: there is Fresnel reflection
} Crossing;

/// What is reflected at that cosine; `eta`: index on the ray's side over the one beyond.
static vtVec3 reflectanceAt(const Crossing* crossing, float cosine, float eta, bool behind)
{
    return vtLook_Reflectance(&crossing->seen, cosine, vtFresnel(cosine, eta), fmaxf(eta, 1.0f / eta),
                              behind);
}

/// The same where the path comes from, of the three channels. Nothing where that is not asked for, all where
/// nothing gets through.
static vtVec3 reflectance(const Crossing* crossing, float cosine)
{
    const float* eta = crossing->indices->eta;
    const bool behind = crossing->behind && !crossing->thin;
    const float into = crossing->thin ? 1.0f / crossing->seen.ior : eta[0];
    if (!crossing->reflects) {
        return (vtVec3){0.0f, 0.0f, 0.0f};
    }
    vtVec3 F = reflectanceAt(crossing, cosine, into, behind);
    if (!crossing->thin && (eta[1] != eta[0] || eta[2] != eta[0])) {
        F.y = reflectanceAt(crossing, cosine, eta[1], behind).y;
        F.z = reflectanceAt(crossing, cosine, eta[2], behind).z;
    }
    return F;
}

/// The ways that light which meets a surface parts into.
typedef struct Ways {
    Way through, mirrored;
    bool total; ///< nothing goes through
} Ways;

/// At a smooth surface. `share`: the light that there is.
static void crossSmooth(const Crossing* crossing, vtVec3 share, Ways* ways)
{
    const bool straight = ways->through.straight;
    bool reflected = false;
    const vtVec3 I = crossing->I, G = crossing->G;
    const vtVec3 T =
        straight ? I : vtMeetInterface(I, crossing->given, G, crossing->indices->eta[0], &reflected);
    const vtVec3 F = reflected ? (vtVec3){1.0f, 1.0f, 1.0f} : reflectance(crossing, -vtDot(crossing->N, I));
    const vtVec3 R = reflected ? T : mirror(I, crossing->N);
    ways->total = reflected;
    ways->mirrored.weight = vtMultiply(share, F);
    ways->mirrored.direction = reflected || vtDot(R, G) > 0.0f ? R : mirror(I, G);
    ways->through.weight = vtSub(share, ways->mirrored.weight);
    ways->through.direction = T;
}

/// Follows a ray among facets until it leaves them. `left`: the chance that decides whether it does at once.
static void leaveFacets(const Crossing* crossing, float alpha, float left, uint32_t row, vtFacetRay* ray,
                        vtVec3* weight)
{
    for (int i = 0; i < maxFacets && vtFacetRay_Advance(ray, alpha, left); ++i) {
        const float chances[2] = {vtChance_Next(&row), vtChance_Next(&row)};
        const vtVec3 N = vtFacetRay_Normal(ray, alpha, chances);
        vtFacetRay beyond = *ray;
        const bool passes = !crossing->thin && vtFacetRay_Refract(&beyond, N);
        const vtVec3 F = !passes              ? (vtVec3){1.0f, 1.0f, 1.0f}
                         : crossing->reflects ? reflectanceAt(crossing, -vtDot(N, ray->direction), ray->eta,
                                                              crossing->behind != ray->through)
                                              : (vtVec3){0.0f, 0.0f, 0.0f};
        const float share = (F.x + F.y + F.z) / 3.0f;
        if (!passes || vtChance_Next(&row) < share) {
            *weight = vtMultiply(*weight, vtScale(F, 1.0f / share));
            vtFacetRay_Mirror(ray, N);
        } else {
            *weight =
                vtMultiply(*weight, vtScale(vtSub((vtVec3){1.0f, 1.0f, 1.0f}, F), 1.0f / (1.0f - share)));
            *ray = beyond;
        }
        left = vtChance_Next(&row);
    }
    ray->direction.z = fabsf(ray->direction.z);
}

/// A direction that leaves facets, in the world; one that the triangle itself would stop is mirrored at it.
static vtVec3 toWorld(const Crossing* crossing, const vtVec3 axes[2], vtVec3 d, bool through)
{
    const float side = through ? -1.0f : 1.0f;
    const vtVec3 plane = vtMulAdd(vtScale(axes[0], d.x), d.y, axes[1]);
    const vtVec3 out = vtNormalize(vtMulAdd(plane, side * d.z, crossing->N));
    const float height = side * vtDot(out, crossing->G);
    return height > 1e-6f
               ? out
               : vtNormalize(vtMulAdd(out, side * (1e-5f - 2.0f * fminf(height, 0.0f)), crossing->G));
}

/// Lets a ray leave facets, and says where it goes and with what.
static void sendFromFacets(const Crossing* crossing, const vtVec3 axes[2], float left, uint32_t row,
                           vtFacetRay* ray, const vtMedia media[2], Way* way)
{
    const float alpha = crossing->seen.roughness * crossing->seen.roughness;
    leaveFacets(crossing, alpha, left, row, ray, &way->weight);
    // A wall without thickness sends through what it would mirror, turned to the other side.
    way->through = crossing->thin ? way->part == partThrough : ray->through;
    way->within = media[way->through];
    way->direction = toWorld(crossing, axes, ray->direction, way->through);
    way->straight = false;
    if (way->through) {
        way->weight = vtMultiply(way->weight, crossing->seen.base);
    }
}

/// At a rough surface.
static void crossRough(const Crossing* crossing, const vtPathRules* rules, uint32_t key, vtVec3 share,
                       Ways* ways)
{
    const float alpha = crossing->seen.roughness * crossing->seen.roughness;
    const vtVec3 N = crossing->N, I = crossing->I;
    const vtVec3 aside = fabsf(N.x) < 0.5f ? (vtVec3){1.0f, 0.0f, 0.0f} : (vtVec3){0.0f, 1.0f, 0.0f};
    const vtVec3 across = vtNormalize(vtCross(N, aside)), axes[2] = {across, vtCross(N, across)};
    float facet[2], walk[2];
    vtChance_Pair(key, vt_chanceFacet, rules->sample, facet);
    vtChance_Pair(key, vt_chanceWalk, rules->sample, walk);
    const uint32_t row = vtMixWords(vtMixWords(key, vt_chanceMore), rules->sample);
    vtFacetRay ray = {
        {vtDot(I, axes[0]), vtDot(I, axes[1]), vtDot(I, N)}, 1.0f, crossing->indices->eta[0], false};
    vtFacetRay_Advance(&ray, alpha, walk[0]);
    const vtVec3 M = vtFacetRay_Normal(&ray, alpha, facet);
    vtFacetRay beyond = ray;
    ways->total = !crossing->thin && !vtFacetRay_Refract(&beyond, M);
    const vtVec3 F =
        ways->total ? (vtVec3){1.0f, 1.0f, 1.0f} : reflectance(crossing, -vtDot(M, ray.direction));
    vtFacetRay_Mirror(&ray, M);
    ways->mirrored.weight = vtMultiply(share, F);
    ways->through.weight = vtSub(share, ways->mirrored.weight);
    const vtMedia media[2] = {ways->mirrored.within, ways->through.within};
    if (crossing->thin) {
        beyond = ray;
    }
    if (!ways->total) {
        sendFromFacets(crossing, axes, walk[1], vtMixWords(row, 1), &beyond, media, &ways->through);
    }
    sendFromFacets(crossing, axes, walk[1], vtMixWords(row, 2), &ray, media, &ways->mirrored);
}

static bool isRough(const vtPathRules* rules, const Crossing* crossing)
{
    const vtIndices* indices = crossing->indices;
    const float alpha = crossing->seen.roughness * crossing->seen.roughness;
    const bool bends =
        crossing->thin ? crossing->seen.ior != 1.0f : indices->eta[0] != 1.0f || crossing->seen.mirror;
    return rules->chance && indices->isInterface && bends && alpha >= leastAlpha;
}

/// What the path meets, and how it lies to it.
static Crossing lookAtGlass(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                            const vtSurface* surface, const vtIndices* indices)
{
    const float turn = surface->behind ? -1.0f : 1.0f;
    Crossing crossing = {.I = path->direction,
                         .G = vtScale(surface->G, turn),
                         .indices = indices,
                         .behind = surface->behind,
                         .thin = surface->object->thin,
                         .reflects = rules->fresnel && indices->isInterface};
    look(reference, rules, path, surface->hit, &crossing.seen);
    crossing.given = vtScale(crossing.seen.N, turn);
    crossing.N = vtDot(crossing.given, crossing.I) >= 0.0f ? crossing.G : crossing.given;
    return crossing;
}

bool vtMeetGlass(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                 const vtPlace* place, const vtIndices* indices, vtBranches* branches)
{
    const Crossing crossing = lookAtGlass(reference, rules, path, vtPlace_Surface(place), indices);
    const vtLook* seen = &crossing.seen;
    const bool straight = crossing.thin || indices->eta[0] == 1.0f;
    const vtVec3 share = vtScale(path->weight, seen->coverage * seen->passes);
    Ways ways;
    ways.through = (Way){.within = place->after,
                         .part = partThrough,
                         .straight = straight,
                         .counts = !straight,
                         .through = true};
    ways.mirrored = (Way){.within = path->within, .part = partMirrored, .counts = true};
    if (isRough(rules, &crossing)) {
        crossRough(&crossing, rules, path->key, share, &ways);
    } else {
        crossSmooth(&crossing, share, &ways);
        ways.through.weight =
            indices->isInterface ? vtMultiply(ways.through.weight, seen->base) : ways.through.weight;
    }
    Way beside = {.weight = vtScale(path->weight, 1.0f - seen->coverage),
                  .direction = path->direction,
                  .within = path->within,
                  .part = partBeside,
                  .straight = true,
                  .through = true};
    if (indices->whiteMirror) {
        branchOff(reference, rules, path, place, &ways.mirrored, branches);
        path->mirrored = true;
        return true;
    }
    const bool together = crossing.thin && ways.through.straight;
    if (together) { // the same way
        ways.through.weight = vtAdd(ways.through.weight, beside.weight);
        beside.weight = (vtVec3){0.0f, 0.0f, 0.0f};
    }
    path->reflected |= ways.total;
    path->throughWall |= crossing.thin && seen->passes * seen->coverage > 0.0f;
    const bool passes = seen->passes * seen->coverage + (together ? 1.0f - seen->coverage : 0.0f) > 0.0f;
    if (!passes && seen->coverage >= 1.0f) {
        path->end = *vtPlace_Surface(place)->hit;
        return vtEndPath(path, VT_PATH_OPAQUE);
    }
    // The path itself is what goes through, or is totally reflected; else what passes beside.
    const Way* own = !passes ? &beside : ways.total ? &ways.mirrored : &ways.through;
    if (own != &ways.mirrored && rules->fresnel && !path->mirrored) {
        branchOff(reference, rules, path, place, &ways.mirrored, branches);
    }
    if (own != &beside && seen->coverage < 1.0f) {
        branchOff(reference, rules, path, place, &beside, branches);
    }
    send(reference, path, place, own);
    return leaveSurface(reference, rules, path, place, own->counts, own->through);
}

// ------------------------------------------------------------------------------------------------ colours

bool vtParts(const vtReference* reference, const vtPathRules* rules, const vtReferencePath* path,
             const vtPlace* place)
{
    const uint32_t before = vtMedia_Top(&place->before), after = vtMedia_Top(&place->after);
    return rules->chance && !path->parted && before != after && !vtPlace_Surface(place)->object->thin &&
           (dispersionOf(reference, rules, before) > 0.0f || dispersionOf(reference, rules, after) > 0.0f);
}

vtIndices vtWhiteIndices(const vtReference* reference, const vtPathRules* rules, const vtPlace* place)
{
    static const float spreads[3] = {VT_SPREAD_RED, VT_SPREAD_GREEN, VT_SPREAD_BLUE};
    const uint32_t before = vtMedia_Top(&place->before), after = vtMedia_Top(&place->after);
    vtIndices indices = {.isInterface = true, .whiteMirror = true};
    for (int c = 0; c < 3; ++c) {
        const float behind = indexAt(reference, rules, before, spreads[c]);
        indices.eta[c] = behind / indexAt(reference, rules, after, spreads[c]);
        indices.whiteMirror &= indices.eta[c] < 1.0f;
    }
    return indices;
}

/// A third of the path, of one channel.
static vtReferencePath channelOf(const vtReferencePath* path, int channel, float spread)
{
    vtReferencePath part = *path;
    part.parted = true;
    part.spread = spread;
    part.weight = (vtVec3){channel == 0 ? path->weight.x : 0.0f, channel == 1 ? path->weight.y : 0.0f,
                           channel == 2 ? path->weight.z : 0.0f};
    return part;
}

void vtPartLight(const vtPathRules* rules, vtReferencePath* path, const vtReferencePath* before,
                 vtBranches* branches)
{
    if (rules->spectrum != NULL) {
        float at[2];
        vtVec3 color;
        vtChance_Pair(path->key, vt_chanceWave, rules->sample, at);
        path->spread = vtSpectrum_At(rules->spectrum, at[0], &color);
        path->weight = vtMultiply(path->weight, color);
        path->parted = true;
        return;
    }
    // The others meet the surface once more, from where the path last started.
    const float spreads[2] = {VT_SPREAD_GREEN, VT_SPREAD_BLUE};
    for (int c = 1; c < 3; ++c) {
        vtReferencePath part = channelOf(before, c, spreads[c - 1]);
        part.light = (vtVec3){0.0f, 0.0f, 0.0f};
        part.mirrored = path->mirrored;
        part.key = vtMixWords(path->key, (uint32_t)(partGreen + c - 1));
        branches->paths[branches->count++] = part;
    }
    *path = channelOf(path, 0, VT_SPREAD_RED);
}
