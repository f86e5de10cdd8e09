// Rough glass. One sample: the path is that of smooth glass and carries a lobe, so that a picture of one sample has no
// noise. Further samples meet facets by chance. This work is based on:
//   Eric Heitz. Sampling the GGX Distribution of Visible Normals. JCGT 2018;
//   Bruce Walter, Stephen Marschner, Hongsong Li, Kenneth Torrance. Microfacet Models for Refraction through Rough
//   Surfaces. EGSR 2007;
//   Laurent Belcour, Cyril Soler, Kartic Subr, Nicolas Holzschuch, Fredo Durand. 5D Covariance Tracing for Efficient
//   Defocus and Motion Blur. 2013: variances that are carried along a path.
// Departures:
// - The lobe is round: one variance of place, one of direction, and what they share.
// - Nothing is lost between facets: light that one would send into the surface goes out mirrored at it, where facets
//   would send it on to others (Heitz, Hanika, d'Eon & Dachsbacher 2016).
// Needs chance, objects and path.

float roughnessOf(int object)
{
    return objectNumbers(object, VT_OBJECT_SURFACE).y;
}

// A facet's normal that a ray of direction I sees, about N against it.
vec3 facetNormal(vec3 N, vec3 I, float alpha, vec2 chance)
{
    vec3 across = mix(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), step(0.7, abs(N.x)));
    vec3 X = normalize(cross(across, N)), Y = cross(N, X);
    vec3 V = normalize(vec3(-alpha * dot(I, X), -alpha * dot(I, Y), max(-dot(I, N), 1e-4))); // as on a hemisphere
    float flatness = dot(V.xy, V.xy);
    vec3 A = mix(vec3(1.0, 0.0, 0.0), vec3(-V.y, V.x, 0.0) * inversesqrt(max(flatness, 1e-12)), step(1e-12, flatness));
    vec3 B = cross(V, A);
    float radius = sqrt(chance.x), angle = 6.2831853 * chance.y, a = radius * cos(angle);
    float b = mix(sqrt(max(1.0 - a * a, 0.0)), radius * sin(angle), 0.5 * (1.0 + V.z));
    vec3 H = a * A + b * B + sqrt(max(1.0 - a * a - b * b, 0.0)) * V;
    H = normalize(vec3(alpha * H.xy, max(H.z, 1e-6)));
    return H.x * X + H.y * Y + H.z * N;
}

// Variances across a lobe: of place, of both together, of direction. After a distance:
vec3 lobeAfter(vec3 lobe, float distance)
{
    return vec3(lobe.x + distance * (2.0 * lobe.y + distance * lobe.z), lobe.y + distance * lobe.z, lobe.z);
}

// Refracted at a surface of that alpha. `curvature`: half the divergence of the normal against the ray; c: cosine of
// incidence.
vec3 lobeThrough(vec3 lobe, float c, float eta, float curvature, float alpha)
{
    float ci = max(c, 0.05), ct = max(sqrt(max(1.0 - eta * eta * (1.0 - c * c), 0.0)), 0.05);
    float bent = eta * ci - ct, g = bent * curvature * inversesqrt(ci * ct), e = eta * sqrt(ci / ct), r = sqrt(ct / ci);
    return vec3(r * r * lobe.x, r * (e * lobe.y + g * lobe.x),
                e * e * lobe.z + 2.0 * e * g * lobe.y + g * g * lobe.x + alpha * alpha * bent * bent / ct);
}

// Mirrored there.
vec3 lobeMirrored(vec3 lobe, float c, float curvature, float alpha)
{
    return vec3(lobe.x, lobe.y + 2.0 * curvature * lobe.x,
                lobe.z + 4.0 * curvature * (lobe.y + curvature * lobe.x) + 4.0 * c * alpha * alpha);
}

// The roughness of a surface whose reflection is as wide.
float lobeRoughness(vec3 lobe)
{
    return min(sqrt(0.5 * sqrt(max(lobe.z, 0.0))), 1.0);
}
