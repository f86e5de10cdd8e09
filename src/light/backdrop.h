// Where the picture behind the scene stands (vtBackdrop), and what a ray sees of it.
#pragma once

#include "scene/camera.h"

/// As shaders_es3/shade/backdrop.glsl has it.
typedef struct vtBackdropPlace {
    float plane[4]; ///< its normal, away from the eye; what the normal times a point of it comes to
    /// The picture's u from its left and v from its top, 0 to 1, of a point: its x, y, z and 1 times these.
    float across[4], down[4];
} vtBackdropPlace;

/// Of a picture of that size in a valid frame, whose glass lies in the box from `low` to `high`; camera and
/// box in the scene's own space, whose unit is `unit` (base/space.h).
vtBackdropPlace vtPlaceBackdrop(const vtBackdrop* backdrop, int width, int height, const vtFrame* frame,
                                const vtCamera* camera, vtVec3 low, vtVec3 high, float unit);

/// Light along a ray: the picture's where the ray meets it from the front, else `beyond`. Bilinear between
/// texel centres; beyond its sides the picture is mirrored.
vtVec3 vtBackdrop_Light(const vtBackdropPlace* place, const vtImage* picture, vtVec3 position,
                        vtVec3 direction, vtVec3 beyond);
