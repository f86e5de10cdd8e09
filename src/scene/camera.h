#pragma once

#include "base/about.h"
#include "base/space.h"
#include "vitrine.h"

/// Orthonormal axes: `right`, `up` and `forward` are left-handed on purpose: the third
/// coordinate of a point in it is its depth, positive in front of the eye.
typedef struct vtCamera {
    vtVec3 eye, right, up, forward;
    float low[2], high[2]; ///< what it sees at depth 1: left and bottom, right and top tangents
    bool orthographic;     ///< rays are parallel, and these are world units
    /// z of clip coordinates is clip[1] - clip[0] * depth; divided by depth, if not orthographic.
    float clip[2];
    float farthest; ///< depth of the far plane, or of what is beyond all; 3e38: it is infinitely far
} vtCamera;

/// A part of the plane at depth 1 in front of the eye, and the depths that matter.
typedef struct vtFrustum {
    float left, bottom, right, top; ///< tangents
    float near, far;                ///< depths, 0 < near < far
} vtFrustum;

/// Axes only; and all of it, of a valid frame.
vtCamera vtMakeViewCamera(const vtView* view);
vtCamera vtMakeCamera(const vtFrame* frame);
/// Takes it into a space of the world.
void vtCamera_Enter(vtCamera* camera, const vtSpace* space);

/// A view that shows all that these show, which look the same way (vtViewOfScene of a scene at several
/// times).
vtView vtJoinViews(const vtView* views, int count, float aspect);

/// Fails with vt_errorArgument and a sentence for matrices that are none of a camera.
vtResult vtCheckMatrices(const vtFrame* frame, vtError* error);

/// Where sample `index` of a pixel lies, from its centre, pixels: x to the right, y up, -0.5 to 0.5. Sample 0
/// is the centre. Roberts 2018, The Unreasonable Effectiveness of Quasirandom Sequences (his R2): however
/// many of them are taken, they cover the pixel evenly.
void vtPixelSample(int index, float* x, float* y);

/// The picture's own frustum, depth range fitted to the box.
vtFrustum vtMakePictureFrustum(const vtCamera* camera, vtVec3 boundsMin, vtVec3 boundsMax);

/// A frustum from the same eye fitted to the box, so that no part of the object lies outside it and no
/// texel is spent beside it. Where the box reaches behind the eye it is cut to `VT_MAX_LAYER_TANGENT`.
vtFrustum vtMakeLayerFrustum(const vtCamera* camera, vtVec3 boundsMin, vtVec3 boundsMax);

/// Widest tangent of a layer frustum, for an eye close to or inside the box's shadow (about 76 degrees).
#define VT_MAX_LAYER_TANGENT 4.0f
