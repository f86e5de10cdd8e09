// Geometric optics at one surface on the CPU. The same names and numbers as shaders_es3/common/optics.glsl
// and transparency.glsl; a change here is a change there (tests/unit/test_gpu.c compares them).
#pragma once

#include "base/math.h"

/// Snell's law in vector form. I: unit direction of travel; N: unit normal against it (N.I < 0); eta: index
/// of refraction behind the ray over the one ahead. Where there is total internal reflection the mirrored
/// direction is given instead, and *reflected is set.
static inline vtVec3 vtBend(vtVec3 I, vtVec3 N, float eta, bool* reflected)
{
    float c = vtDot(N, I);
    float k = 1.0f - eta * eta * (1.0f - c * c);
    *reflected = k < 0.0f;
    vtVec3 T = *reflected ? vtMulAdd(I, -2.0f * c, N)
                          : vtMulAdd(vtScale(I, eta), -(eta * c + sqrtf(fmaxf(k, 0.0f))), N);
    return vtNormalize(T);
}

/// Reflectance of a smooth dielectric for unpolarised light (Born & Wolf, Principles of Optics, 1.5.2).
/// c: cosine of incidence; eta: index of refraction behind the ray over the one ahead.
static inline float vtFresnel(float c, float eta)
{
    const float k = 1.0f - eta * eta * (1.0f - c * c);
    if (k <= 0.0f) {
        return 1.0f;
    }
    const float t = sqrtf(k);
    const float s = (eta * c - t) / (eta * c + t), p = (eta * t - c) / (eta * t + c);
    return 0.5f * (s * s + p * p);
}

/// One event of a path: the new direction of a ray of direction I that meets a surface of normals N
/// (interpolated) and G (of the triangle), both turned against the ray. eta: index of refraction behind the
/// ray over the one ahead. Where the interpolated normal would send the ray through the wrong side, the
/// triangle's is taken. *reflected: there is total internal reflection.
static inline vtVec3 vtMeetInterface(vtVec3 I, vtVec3 N, vtVec3 G, float eta, bool* reflected)
{
    vtVec3 T = vtBend(I, N, eta, reflected);
    float side = vtDot(T, G);
    if (vtDot(N, I) >= 0.0f || (*reflected ? side <= 0.0f : side >= 0.0f)) {
        T = vtBend(I, G, eta, reflected);
    }
    return T;
}

/// The same where there is one object, and air around it: N and G are outward normals, and the ray is inside
/// the glass or not. Keeps *inside true to it.
static inline vtVec3 vtMeetSurface(vtVec3 I, vtVec3 N, vtVec3 G, float ior, bool* inside, bool* reflected)
{
    const float turn = *inside ? -1.0f : 1.0f;
    vtVec3 T = vtMeetInterface(I, vtScale(N, turn), vtScale(G, turn), *inside ? ior : 1.0f / ior, reflected);
    if (!*reflected) {
        *inside = !*inside;
    }
    return T;
}

/// Kay & Greenberg 1979, equation 2. cosine: |Nz|, the part of the unit normal along the view.
static inline float vtNonlinearTransmittance(float cosine, float maximum, float minimum, float power)
{
    return (maximum - minimum) * (1.0f - powf(1.0f - vtClamp(cosine, 0.0f, 1.0f), power)) + minimum;
}

/// Kay & Greenberg 1979, equations 4 and 5 and the way through a wall whose thickness along its normal is 1,
/// for a ray along +z that meets the unit normal N (N.z <= 0). Gives the path's length; shift is its x and y.
static inline float vtWallPath(vtVec3 N, float ior, float shift[2])
{
    float cosine = sqrtf(ior * ior - 1.0f + N.z * N.z) / ior;
    float path = 1.0f / fmaxf(cosine, 1e-3f);
    shift[0] = path * (-N.z * N.x / ior - cosine * N.x);
    shift[1] = path * (-N.z * N.y / ior - cosine * N.y);
    return path;
}
