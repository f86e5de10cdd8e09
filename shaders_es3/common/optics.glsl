// Geometric optics at one surface. The same names and numbers in src/base/optics.h.

// Snell's law in vector form. I: unit direction of travel; N: unit normal against it (N.I < 0); eta: index
// of refraction behind the ray over the one ahead. Where there is total internal reflection the mirrored
// direction is given instead, and `reflected` is set.
vec3 bend(vec3 I, vec3 N, float eta, out bool reflected)
{
    float c = dot(N, I);
    float k = 1.0 - eta * eta * (1.0 - c * c);
    reflected = k < 0.0;
    vec3 T = reflected ? I - 2.0 * c * N : eta * I - (eta * c + sqrt(max(k, 0.0))) * N;
    return normalize(T);
}

// Reflectance of a smooth dielectric for unpolarised light (Born & Wolf, Principles of Optics, 1.5.2).
// c: cosine of incidence; eta: index of refraction behind the ray over the one ahead.
float fresnel(float c, float eta)
{
    float k = 1.0 - eta * eta * (1.0 - c * c);
    float t = sqrt(max(k, 0.0));
    float s = (eta * c - t) / (eta * c + t), p = (eta * t - c) / (eta * t + c);
    return k <= 0.0 ? 1.0 : 0.5 * (s * s + p * p);
}

// A path of direction I meets an interface of normals N (interpolated) and G (of the triangle), both against it.
// Where the interpolated normal would send the ray through the wrong side, the triangle's is taken, and N is it.
vec3 meetInterface(vec3 I, inout vec3 N, vec3 G, float eta, out bool reflected)
{
    vec3 T = bend(I, N, eta, reflected);
    float side = dot(T, G);
    if (dot(N, I) >= 0.0 || (reflected ? side <= 0.0 : side >= 0.0)) {
        T = bend(I, G, eta, reflected);
        N = G;
    }
    return T;
}
