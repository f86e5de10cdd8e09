#pragma once

#include "vitrine.h"

/// An orthonormal camera frame. `right`, `up` and `forward` are left-handed on purpose: the third
/// coordinate of a point in it is its depth, positive in front of the eye.
typedef struct vtCameraFrame {
    vtVec3 eye, right, up, forward;
} vtCameraFrame;

/// A part of the plane at depth 1 in front of the eye, and the depths that matter.
typedef struct vtFrustum {
    float left, bottom, right, top; ///< tangents
    float near, far;                ///< depths, 0 < near < far
} vtFrustum;

vtCameraFrame vtMakeCameraFrame(const vtView* view);

/// Where sample `index` of a pixel lies, from its centre, pixels: x to the right, y up, -0.5 to 0.5. Sample 0
/// is the centre. Roberts 2018, The Unreasonable Effectiveness of Quasirandom Sequences (his R2): however
/// many of them are taken, they cover the pixel evenly.
void vtPixelSample(int index, float* x, float* y);

/// The picture's own frustum, depth range fitted to the box.
vtFrustum vtMakePictureFrustum(const vtView* view, float aspect, vtVec3 boundsMin, vtVec3 boundsMax);

/// A frustum from the same eye fitted to the box, so that no part of the object lies outside it and no
/// texel is spent beside it. Where the box reaches behind the eye it is cut to `VT_MAX_LAYER_TANGENT`.
vtFrustum vtMakeLayerFrustum(const vtView* view, vtVec3 boundsMin, vtVec3 boundsMax);

/// Widest tangent of a layer frustum, for an eye close to or inside the box's shadow (about 76 degrees).
#define VT_MAX_LAYER_TANGENT 4.0f
