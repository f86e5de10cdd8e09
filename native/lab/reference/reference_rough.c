// This work is based on:
//   Eric Heitz, Johannes Hanika, Eugene d'Eon, Carsten Dachsbacher. Multiple-Scattering Microfacet BSDFs with
//   the Smith Model. 2016: a ray goes from facet to facet until it leaves, so that nothing is lost;
//   Eric Heitz. Sampling the GGX Distribution of Visible Normals. 2018;
//   Bruce Walter, Stephen Marschner, Hongsong Li, Kenneth Torrance. Microfacet Models for Refraction through
//   Rough Surfaces. 2007: GGX, Smith's shadowing, refraction by facets.
// Departures: heights are uniform and written as the share of the surface below them, which is all that the
// result depends on.
#include "lab/reference/reference_rough.h"

/// Smith's Lambda of GGX for a unit direction; below the surface it is -1 less that of the direction's mirror
/// image.
static float lambda(vtVec3 w, float alpha)
{
    const float across = alpha * alpha * (w.x * w.x + w.y * w.y), along = w.z * w.z;
    const float root = sqrtf(1.0f + across / fmaxf(along, 1e-12f));
    return 0.5f * (w.z < 0.0f ? -1.0f - root : -1.0f + root);
}

bool vtFacetRay_Advance(vtFacetRay* ray, float alpha, float chance)
{
    const float slope = lambda(ray->direction, alpha), left = 1.0f - chance;
    if (ray->direction.z >= 0.0f && left <= powf(ray->height, slope)) {
        return false;
    }
    // Down: the height falls to its product with a power of the chance; up: it rises.
    ray->height = vtClamp(ray->height * powf(fmaxf(left, 1e-12f), -1.0f / slope), 0.0f, 1.0f);
    return true;
}

vtVec3 vtFacetRay_Normal(const vtFacetRay* ray, float alpha, const float chances[2])
{
    const vtVec3 d = ray->direction;
    const vtVec3 V = vtNormalize((vtVec3){-alpha * d.x, -alpha * d.y, -d.z}); // as on a hemisphere
    const float flat = V.x * V.x + V.y * V.y;
    const vtVec3 A =
        flat > 1e-12f ? vtScale((vtVec3){-V.y, V.x, 0.0f}, 1.0f / sqrtf(flat)) : (vtVec3){1.0f, 0.0f, 0.0f};
    const vtVec3 B = vtCross(V, A);
    const float radius = sqrtf(chances[0]), angle = 2.0f * VT_PI * chances[1], share = 0.5f * (1.0f + V.z);
    const float a = radius * cosf(angle);
    const float b = (1.0f - share) * sqrtf(fmaxf(1.0f - a * a, 0.0f)) + share * radius * sinf(angle);
    const float v = sqrtf(fmaxf(1.0f - a * a - b * b, 0.0f));
    const vtVec3 N = vtAdd(vtAdd(vtScale(A, a), vtScale(B, b)), vtScale(V, v));
    return vtNormalize((vtVec3){alpha * N.x, alpha * N.y, fmaxf(N.z, 1e-6f)});
}

void vtFacetRay_Mirror(vtFacetRay* ray, vtVec3 normal)
{
    ray->direction = vtNormalize(vtMulAdd(ray->direction, -2.0f * vtDot(ray->direction, normal), normal));
}

bool vtFacetRay_Refract(vtFacetRay* ray, vtVec3 normal)
{
    const float c = vtDot(normal, ray->direction), k = 1.0f - ray->eta * ray->eta * (1.0f - c * c);
    if (k <= 0.0f) {
        return false;
    }
    const vtVec3 T =
        vtNormalize(vtMulAdd(vtScale(ray->direction, ray->eta), -(ray->eta * c + sqrtf(k)), normal));
    // As seen from the other side.
    *ray = (vtFacetRay){{T.x, T.y, -T.z}, 1.0f - ray->height, 1.0f / ray->eta, !ray->through};
    return true;
}
