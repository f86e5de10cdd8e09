// This work is based on:
//   Henrik Wann Jensen. Global Illumination Using Photon Maps. 1996;
//   Cem Yuksel, John Keyser, Donald House. Mesh Colors. ACM Transactions on Graphics 29(2), 2010: samples on
//   a lattice over each triangle, as fine as it is large, so that no texture coordinates are needed.
// Departures:
//  - Only triangles that photons have come down on have samples, and large ones only about those places. A
//    table by a hash of object and triangle finds them.
//  - Triangles with a side of one sample share those of their corners with neighbours. Others do not: what is
//    gathered there has the area that it was gathered from, up to the triangle's sides.
//  - A photon is spread over the three samples about it, and light between them is read in the same way. So
//  all
//    of its light is there, and as samples become many the blur goes.
#include "light/caustics.h"

#include <string.h>

#include "base/memory.h"

enum {
    mostSamples = 1 << 19,
    mostSides = 8191, // of a lattice, along a triangle's
    columns = VT_CAUSTIC_COLUMNS,
};

bool vtCaustics_Add(vtCaustics* caustics, const vtCausticHit* hit)
{
    if (caustics->count == caustics->capacity) {
        const uint32_t capacity = caustics->capacity > 0 ? 2 * caustics->capacity : 1024;
        vtCausticHit* hits = vtReallocate(caustics->hits, capacity, sizeof *hits);
        if (hits == NULL) {
            return false;
        }
        caustics->hits = hits;
        caustics->capacity = capacity;
    }
    caustics->hits[caustics->count++] = *hit;
    return true;
}

void vtDestroyCaustics(vtCaustics* caustics)
{
    vtFree(caustics->hits);
    *caustics = (vtCaustics){0};
}

// ------------------------------------------------------------------------------------------------- tables

/// A triangle with samples. Those at (i, j) of its lattice, u = i / sides and v = j / sides, lie from the
/// window's first on; of one with one side they are `shared`.
typedef struct Patch {
    uint32_t object, triangle;
    float area, longest;
    uint32_t sides, first;
    int32_t lowI, lowJ, highI, highJ; ///< the window
    uint32_t shared[3];
    vtVec3 corners[3];
} Patch;

typedef struct Gathering {
    Patch* patches;
    uint32_t count;
    uint32_t* slots; ///< of the table: number of a patch plus one; 0: free
    uint32_t slotMask;
    uint32_t sampleCount;
    float* sums;  ///< flux by sample, of both sides: 6
    float* areas; ///< of a sample
} Gathering;

/// The slot of a triangle, or the free one where it belongs. `probes`: how many were looked at.
static uint32_t findSlot(const Gathering* all, uint32_t object, uint32_t triangle, uint32_t* probes)
{
    uint32_t slot = vtCausticHash(object, triangle) & all->slotMask;
    *probes = 1;
    while (all->slots[slot] != 0) {
        const Patch* patch = &all->patches[all->slots[slot] - 1];
        if (patch->object == object && patch->triangle == triangle) {
            break;
        }
        slot = (slot + 1) & all->slotMask;
        ++*probes;
    }
    return slot;
}

/// A table twice as large at least, and so large that no search takes too long.
static bool growTable(Gathering* all)
{
    uint32_t size = all->slots != NULL ? all->slotMask + 1 : 256;
    for (bool fits = false; !fits;) {
        size *= 2;
        vtFree(all->slots);
        all->slots = vtAllocateZeroed(size, sizeof *all->slots);
        Patch* patches = vtReallocate(all->patches, size / 2, sizeof *patches);
        all->patches = patches != NULL ? patches : all->patches;
        if (all->slots == NULL || patches == NULL) {
            return false;
        }
        all->slotMask = size - 1;
        fits = true;
        for (uint32_t i = 0; i < all->count && fits; ++i) {
            uint32_t probes;
            all->slots[findSlot(all, all->patches[i].object, all->patches[i].triangle, &probes)] = i + 1;
            fits = probes <= VT_CAUSTIC_PROBES;
        }
    }
    return true;
}

static Patch* patchOf(Gathering* all, const vtCausticHit* hit, const vtCornersOf* of)
{
    uint32_t probes;
    uint32_t slot = findSlot(all, hit->object, hit->triangle, &probes);
    while (all->slots[slot] == 0 && (probes > VT_CAUSTIC_PROBES || 2 * all->count > all->slotMask)) {
        if (!growTable(all)) {
            return NULL;
        }
        slot = findSlot(all, hit->object, hit->triangle, &probes);
    }
    if (all->slots[slot] == 0) {
        Patch* patch = &all->patches[all->count++];
        all->slots[slot] = all->count;
        *patch = (Patch){.object = hit->object, .triangle = hit->triangle};
        of->corners(of->data, hit->object, hit->triangle, patch->corners);
        const vtVec3* p = patch->corners;
        const vtVec3 a = vtSub(p[1], p[0]), b = vtSub(p[2], p[0]), c = vtSub(p[2], p[1]);
        patch->area = 0.5f * vtLength(vtCross(a, b));
        patch->longest = fmaxf(vtLength(a), fmaxf(vtLength(b), vtLength(c)));
    }
    return &all->patches[all->slots[slot] - 1];
}

// ------------------------------------------------------------------------------------------------ lattice

/// The area that a sample stands for: a third of each small triangle at it.
static float areaOf(const Patch* patch, int32_t i, int32_t j)
{
    const int32_t k = (int32_t)patch->sides - i - j;
    const int outer = (i == 0) + (j == 0) + (k == 0);
    const float small = patch->area / ((float)patch->sides * (float)patch->sides);
    return k < 0 ? 0.0f : small * (outer == 0 ? 2.0f : outer == 1 ? 1.0f : 1.0f / 3.0f);
}

static uint32_t sampleOf(const Patch* patch, const int32_t at[2])
{
    if (patch->sides == 1) {
        return patch->shared[at[0] == 1 ? 1 : at[1] == 1 ? 2 : 0];
    }
    return patch->first +
           (uint32_t)((at[1] - patch->lowJ) * (patch->highI - patch->lowI + 1) + at[0] - patch->lowI);
}

/// Windows about all that has come down, for a spacing. The number of samples, those of corners left out.
static uint64_t placeWindows(Gathering* all, const vtCaustics* caustics, float spacing, const vtCornersOf* of)
{
    for (uint32_t i = 0; i < all->count; ++i) {
        Patch* patch = &all->patches[i];
        patch->sides = (uint32_t)vtClamp(ceilf(patch->longest / spacing), 1.0f, (float)mostSides);
        patch->lowI = patch->lowJ = mostSides + 1;
        patch->highI = patch->highJ = 0;
    }
    for (uint32_t i = 0; i < caustics->count; ++i) {
        Patch* patch = patchOf(all, &caustics->hits[i], of);
        int32_t at[3][2];
        float weights[3];
        vtCausticSamples(patch->sides, caustics->hits[i].u, caustics->hits[i].v, at, weights);
        for (int k = 0; k < 3; ++k) {
            patch->lowI = at[k][0] < patch->lowI ? at[k][0] : patch->lowI;
            patch->lowJ = at[k][1] < patch->lowJ ? at[k][1] : patch->lowJ;
            patch->highI = at[k][0] > patch->highI ? at[k][0] : patch->highI;
            patch->highJ = at[k][1] > patch->highJ ? at[k][1] : patch->highJ;
        }
    }
    uint64_t samples = 0;
    for (uint32_t i = 0; i < all->count; ++i) {
        Patch* patch = &all->patches[i];
        patch->first = (uint32_t)samples;
        samples += patch->sides > 1 ? (uint64_t)(patch->highI - patch->lowI + 1) *
                                          (uint64_t)(patch->highJ - patch->lowJ + 1)
                                    : 0;
    }
    return samples;
}

/// A sample for each corner of triangles of one side, shared where places are the same. False where memory is
/// out.
static bool shareCorners(Gathering* all)
{
    uint32_t size = 16;
    while (size < 8 * all->count) {
        size *= 2;
    }
    vtVec3* places = vtAllocate(size, sizeof *places);
    uint32_t* owners = vtAllocateZeroed(size, 2 * sizeof *owners); // object, sample plus one
    const bool ready = places != NULL && owners != NULL;
    for (uint32_t i = 0; i < all->count && ready; ++i) {
        Patch* patch = &all->patches[i];
        for (int k = 0; k < 3 && patch->sides == 1; ++k) {
            uint32_t bits[3];
            memcpy(bits, &patch->corners[k], sizeof bits);
            uint32_t slot =
                vtCausticHash(bits[0] ^ vtCausticHash(bits[1], bits[2]), patch->object) & (size - 1);
            while (owners[2 * slot + 1] != 0 &&
                   (owners[2 * slot] != patch->object || memcmp(&places[slot], bits, sizeof bits) != 0)) {
                slot = (slot + 1) & (size - 1);
            }
            if (owners[2 * slot + 1] == 0) {
                owners[2 * slot] = patch->object;
                owners[2 * slot + 1] = ++all->sampleCount;
                places[slot] = patch->corners[k];
            }
            patch->shared[k] = owners[2 * slot + 1] - 1;
        }
    }
    vtFree(places);
    vtFree(owners);
    return ready;
}

// -------------------------------------------------------------------------------------------------- gather

static void addAreas(Gathering* all)
{
    for (uint32_t i = 0; i < all->count; ++i) {
        const Patch* patch = &all->patches[i];
        const int32_t lowI = patch->sides > 1 ? patch->lowI : 0, highI = patch->sides > 1 ? patch->highI : 1;
        const int32_t lowJ = patch->sides > 1 ? patch->lowJ : 0, highJ = patch->sides > 1 ? patch->highJ : 1;
        for (int32_t y = lowJ; y <= highJ; ++y) {
            for (int32_t x = lowI; x <= highI; ++x) {
                if (x + y <= (int32_t)patch->sides) {
                    all->areas[sampleOf(patch, (int32_t[2]){x, y})] += areaOf(patch, x, y);
                }
            }
        }
    }
}

static void addHits(Gathering* all, const vtCaustics* caustics, const vtCornersOf* of)
{
    for (uint32_t i = 0; i < caustics->count; ++i) {
        const vtCausticHit* hit = &caustics->hits[i];
        const Patch* patch = patchOf(all, hit, of);
        int32_t at[3][2];
        float weights[3];
        vtCausticSamples(patch->sides, hit->u, hit->v, at, weights);
        for (int k = 0; k < 3; ++k) {
            float* sum = all->sums + 6 * (size_t)sampleOf(patch, at[k]) + (hit->behind ? 3 : 0);
            sum[0] += weights[k] * hit->flux.x;
            sum[1] += weights[k] * hit->flux.y;
            sum[2] += weights[k] * hit->flux.z;
        }
    }
}

/// Head, table, samples.
static bool writeMap(const Gathering* all, vtCausticMap* map)
{
    const uint32_t slots = all->slotMask + 1, firstSample = 1 + 2 * slots;
    map->rows = (firstSample + 2 * all->sampleCount + columns - 1) / columns;
    map->words = vtAllocateZeroed((size_t)map->rows * columns, 4 * sizeof *map->words);
    if (map->words == NULL) {
        return false;
    }
    map->words[0] = slots;
    for (uint32_t i = 0; i < slots; ++i) {
        uint32_t* words = map->words + 4 * (1 + 2 * (size_t)i);
        if (all->slots[i] != 0) {
            const Patch* patch = &all->patches[all->slots[i] - 1];
            const bool shares = patch->sides == 1;
            const uint32_t head[8] = {patch->object + 1,
                                      patch->triangle,
                                      patch->sides,
                                      patch->first,
                                      shares ? patch->shared[0] : (uint32_t)patch->lowI,
                                      shares ? patch->shared[1] : (uint32_t)patch->lowJ,
                                      shares ? patch->shared[2] : (uint32_t)(patch->highI - patch->lowI + 1),
                                      (uint32_t)(patch->highJ - patch->lowJ + 1)};
            memcpy(words, head, sizeof head);
        }
    }
    for (uint32_t i = 0; i < all->sampleCount; ++i) {
        for (int behind = 0; behind < 2; ++behind) {
            const vtVec3 sum = vtMakeVec3(all->sums + 6 * (size_t)i + 3 * behind);
            vtVec3 light = vtScale(sum, all->areas[i] > 0.0f ? 1.0f / all->areas[i] : 0.0f);
            light = (vtVec3){fmaxf(light.x, 0.0f), fmaxf(light.y, 0.0f), fmaxf(light.z, 0.0f)};
            memcpy(map->words + 4 * (firstSample + 2 * (size_t)i + (size_t)behind), &light,
                   3 * sizeof(float));
        }
    }
    return true;
}

bool vtCaustics_Gather(const vtCaustics* caustics, float spacing, const vtCornersOf* of, vtCausticMap* map)
{
    *map = (vtCausticMap){0};
    if (caustics->count == 0) {
        return true;
    }
    Gathering all = {0};
    bool ready = growTable(&all);
    for (uint32_t i = 0; i < caustics->count && ready; ++i) {
        ready = patchOf(&all, &caustics->hits[i], of) != NULL;
    }
    uint64_t samples = ready ? placeWindows(&all, caustics, spacing, of) : 0;
    for (int i = 0; i < 40 && samples > mostSamples; ++i) {
        spacing *= 1.4f;
        samples = placeWindows(&all, caustics, spacing, of);
    }
    all.sampleCount = (uint32_t)samples;
    ready = ready && shareCorners(&all);
    all.sums = ready ? vtAllocateZeroed(all.sampleCount, 6 * sizeof *all.sums) : NULL;
    all.areas = ready ? vtAllocateZeroed(all.sampleCount, sizeof *all.areas) : NULL;
    ready = all.sums != NULL && all.areas != NULL;
    if (ready) {
        addAreas(&all);
        addHits(&all, caustics, of);
        ready = writeMap(&all, map);
    }
    vtFree(all.patches);
    vtFree(all.slots);
    vtFree(all.sums);
    vtFree(all.areas);
    return ready;
}
