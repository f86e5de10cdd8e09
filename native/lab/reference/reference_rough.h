// Rough surfaces: which way light leaves them.
#pragma once

#include "base/math.h"

/// A ray among the facets of a rough surface. Heights are the share of the surface that lies below, so that 1
/// is above all of it.
typedef struct vtFacetRay {
    vtVec3 direction; ///< unit; z along the surface's normal, on the side that the ray is on
    float height;     ///< 0 to 1
    float eta;        ///< index on that side over the one beyond
    bool through;     ///< it is on the other side than where it came from
} vtFacetRay;

/// Goes on to the facet that is met next. False where none is: the ray has left. `alpha`: of GGX, above 0.
bool vtFacetRay_Advance(vtFacetRay* ray, float alpha, float chance);

/// Unit normal of a facet of those that are seen against the ray's direction.
vtVec3 vtFacetRay_Normal(const vtFacetRay* ray, float alpha, const float chances[2]);

/// Mirrors the ray at the facet, or lets it go through: false where it cannot, as all of it is reflected.
void vtFacetRay_Mirror(vtFacetRay* ray, vtVec3 normal);
bool vtFacetRay_Refract(vtFacetRay* ray, vtVec3 normal);
