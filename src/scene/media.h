// Which objects of glass a path is within. The twin of shaders_es3/common/media.glsl. This work is based on:
//   Charles Schmidt, Brian Budge. Simple Nested Dielectrics in Ray Traced Images. Journal of Graphics Tools
//   7(2), 2002: where objects overlap, the one of highest priority counts, and surfaces within it are passed
//   by.
// Departure: the objects come sorted (scene/objects.h), so that an object's number is its rank.
#pragma once

#include <stdbool.h>
#include <stdint.h>

/// Most objects that may lie one in the other about a point.
#define VT_MAX_NESTED 4

/// Numbers of objects plus one, in any order; 0: free.
typedef struct vtMedia {
    uint32_t ids[VT_MAX_NESTED];
} vtMedia;

static inline bool vtMedia_Holds(const vtMedia* media, uint32_t id)
{
    bool holds = false;
    for (int i = 0; i < VT_MAX_NESTED; ++i) {
        holds |= media->ids[i] == id;
    }
    return holds;
}

/// Takes the object out if it is in, else puts it in. False where there is no more room.
static inline bool vtMedia_Toggle(vtMedia* media, uint32_t id)
{
    const uint32_t from = vtMedia_Holds(media, id) ? id : 0;
    for (int i = 0; i < VT_MAX_NESTED; ++i) {
        if (media->ids[i] == from) {
            media->ids[i] = from == 0 ? id : 0;
            return true;
        }
    }
    return false;
}

/// The object whose material there is, its number plus one; 0: air.
static inline uint32_t vtMedia_Top(const vtMedia* media)
{
    uint32_t top = 0;
    for (int i = 0; i < VT_MAX_NESTED; ++i) {
        const uint32_t id = media->ids[i];
        top = id != 0 && (top == 0 || id < top) ? id : top;
    }
    return top;
}
