// Rough glass. One sample: the path is that of smooth glass and carries a lobe, so that a picture of one sample has no
// noise. Further samples meet facets by chance. This work is based on:
//   Eric Heitz. Sampling the GGX Distribution of Visible Normals. JCGT 2018;
//   Bruce Walter, Stephen Marschner, Hongsong Li, Kenneth Torrance. Microfacet Models for Refraction through Rough
//   Surfaces. EGSR 2007;
//   Laurent Belcour, Cyril Soler, Kartic Subr, Nicolas Holzschuch, Fredo Durand. 5D Covariance Tracing for Efficient
//   Defocus and Motion Blur. 2013: variances that are carried along a path.
// Departures:
// - The lobe is round: one variance of place, one of direction, and what they share.
// - Nothing is lost between facets: light that meets others on its way out leaves as from a matt surface, where they would
//   send it on (Heitz, Hanika, d'Eon & Dachsbacher 2016).
// Needs chance, objects and path. WITH_LOOKS: looks.glsl says how rough a surface is.

float roughnessOf(int object)
{
    return objectNumbers(object, VT_OBJECT_SURFACE).y;
}

// A facet's normal that a ray of direction I sees, about N against it.
vec3 facetNormal(vec3 N, vec3 I, float alpha, vec3 chance)
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

// The direction that light leaves by which a facet has sent to d: d itself, unless other facets are in its way (Smith's
// shadowing). N, G: the surface's normals on the side that it leaves on.
vec3 leaveFacets(vec3 d, vec3 N, vec3 G, float alpha, vec3 chance)
{
    float z = max(dot(d, N), 1e-4);
    float free = step(0.0, dot(d, N)) * 2.0 / (1.0 + sqrt(1.0 + alpha * alpha * (1.0 / (z * z) - 1.0)));
    vec2 more = fract(256.0 * chance.xy); // what decides about the facet is in the higher digits
    float up = 2.0 * more.x - 1.0, across = sqrt(max(1.0 - up * up, 0.0)), angle = 6.2831853 * more.y;
    vec3 matt = normalize(1.001 * N + vec3(across * cos(angle), across * sin(angle), up));
    vec3 left = mix(d, matt, step(free, chance.z));
    return left - 2.0 * min(dot(left, G), 0.0) * G;
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

// How much a lobe and a pixel cover together, across: half of a lobe's light is within the root of its variance.
float lobeWidth(float width, float variance)
{
    return sqrt(width * width + 4.0 * max(variance, 0.0));
}

// What neighbouring rays do, widened by the lobe.
Footprint lobeFootprint(Footprint steps, vec3 direction, vec3 lobe)
{
    vec3 across = mix(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), step(0.7, abs(direction.x)));
    vec3 X = normalize(cross(across, direction));
    STEPS plane = STEPS(0.0);
    plane[0] = X;
    plane[1] = cross(direction, X);
    bool isThere = lobe.z > 0.0;
    float place = lobeWidth(footprintWidth(steps.place), lobe.x), turn = lobeWidth(footprintWidth(steps.direction), lobe.z);
    return Footprint(isThere ? place * plane : steps.place, isThere ? turn * plane : steps.direction);
}

// The roughness of a surface whose reflection is as wide.
float lobeRoughness(vec3 lobe)
{
    return min(sqrt(0.5 * sqrt(max(lobe.z, 0.0))), 1.0);
}

#ifdef WITH_OPAQUE
#define SPREADS // several rays of a lobe see it

// The last way of a path whose light is spread, where what is opaque would be seen as sharp as smooth glass shows it.
struct Beam {
    bool isSpread;
    vec3 from, ahead, share, lobe; // where it begins; lobe: there
};

const int LOBE_RAYS = 4;        // beside the path's own
const float LOBE_PART = 0.25;   // of a lobe's variances that each of them has
const float LEAST_SPREAD = 0.2; // share of light that is worth them

// Of a path that has come from there, with that share of the light.
Beam beamOf(Path p, vec3 from, vec3 share, bool isWanted)
{
    bool isSpread = isWanted && p.lobe.z > 0.0 && strongest(share) > LEAST_SPREAD;
    return Beam(isSpread, from, p.direction, share, lobeAfter(p.lobe, -distance(p.position, from)));
}

// Lets the path begin anew as ray `ray` of those beside its own. They lie in rings that have the same share of the light
// each, for GGX's slopes: the square of a slope is alpha's times u / (1 - u).
void turnAside(inout Path p, Beam beam, int ray)
{
    float u = (float(ray) + 0.5) / float(LOBE_RAYS + 1), radius = sqrt(beam.lobe.z * u / (1.0 - u)), angle = 2.4 * float(ray);
    vec3 across = mix(vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), step(0.7, abs(beam.ahead.x)));
    vec3 X = normalize(cross(across, beam.ahead)), Y = cross(beam.ahead, X), turn = radius * (cos(angle) * X + sin(angle) * Y);
    p.position = beam.from + beam.lobe.y / beam.lobe.z * turn;
    p.direction = normalize(beam.ahead + turn);
    p.transmittance = beam.share;
    p.lobe = LOBE_PART * beam.lobe;
#ifdef WITH_LOOKS
    p.seen = vec3(0.0);
#endif
}
#endif
