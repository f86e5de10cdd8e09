// What happens to paths at surfaces.
#pragma once

#include "lab/reference/reference_place.h"

/// Paths that branch off from one at one place: what is mirrored, what passes beside, two channels.
typedef struct vtBranches {
    vtReferencePath paths[4];
    int count;
} vtBranches;

/// Indices where a path meets glass.
typedef struct vtIndices {
    float eta[3];     ///< of the channels: before over the one behind; 1: it bends nothing
    bool isInterface; ///< the materials differ
    bool whiteMirror; ///< only what is mirrored is asked for: the rest goes on by wavelength
} vtIndices;

/// The index for the path's light of what has that number in its media; 0 is air.
float vtIndexOf(const vtReference* reference, const vtPathRules* rules, const vtReferencePath* path,
                uint32_t id);

/// Ends the path, and is false.
bool vtEndPath(vtReferencePath* path, uint8_t state);

/// Meets what is opaque: ends there, unless some of its light passes beside it.
bool vtMeetOpaque(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                  const vtSurfaceHit* opaque);

/// Parts the light that meets a surface of glass into what passes through it, what it mirrors and what passes
/// beside it: one of them is the path, the others branch off. False where the path has ended.
bool vtMeetGlass(const vtReference* reference, const vtPathRules* rules, vtReferencePath* path,
                 const vtPlace* place, const vtIndices* indices, vtBranches* branches);

/// Does the path have light of all wavelengths still, and the place glass that bends each differently?
bool vtParts(const vtReference* reference, const vtPathRules* rules, const vtReferencePath* path,
             const vtPlace* place);
/// Indices at the mean of each channel; whiteMirror where none is reflected totally.
vtIndices vtWhiteIndices(const vtReference* reference, const vtPathRules* rules, const vtPlace* place);
/// Makes the path one of a single wavelength, or of three, a channel each, the others branching off from what
/// it was `before`.
void vtPartLight(const vtPathRules* rules, vtReferencePath* path, const vtReferencePath* before,
                 vtBranches* branches);
