// For sweeps over objects: copies of what a scene has, which share its meshes.
#pragma once

#include "lab/bench/figures.h"

/// Fits the eye and the copies of what the session's scene has to a sweep over objects.
typedef struct vtCopies {
    vtObject* objects; ///< of one copy
    uint32_t objectCount;
    vtView view;              ///< of all cases
    vtVec3 low, high;         ///< box of one copy
    float tangentX, tangentY; ///< of half the field of view
    float growth;             ///< one behind the other: of each, about the eye, over the one before it
    vtSweep sweep;
} vtCopies;

/// `aspect`: width over height of the picture.
vtResult vtCreateCopies(const vtScene* scene, const vtView* view, float aspect, vtSweep sweep,
                        vtCopies* copies, vtError* error);
/// Copies in the sweep's case of this index; 0 past the last one.
int vtCopies_Count(const vtCopies* copies, int index);
/// Puts that many in place of the scene's objects; they share its meshes.
vtResult vtCopies_Place(const vtCopies* copies, int count, vtScene* scene, vtError* error);
void vtDestroyCopies(vtCopies* copies);
