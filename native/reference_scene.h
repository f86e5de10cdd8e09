// What the files of the reference share: the scene, and paths through it.
#pragma once

#include <embree3/rtcore.h>

#include "base/math.h"
#include "reference.h"

struct vtReference {
    RTCDevice device;
    RTCScene scene;
    const float* positions; ///< owned by the scene, as are the indices
    const uint32_t* indices;
    float* normals;
    uint32_t vertexCount;
    float extent; ///< of the coordinates: what small distances are measured by
};

/// A point of the surface on a ray.
typedef struct vtSurfaceHit {
    float distance;
    uint32_t triangle; ///< VT_NO_TRIANGLE: the ray met nothing
    float u, v;        ///< weights of the triangle's second and third corner
} vtSurfaceHit;

/// A path between two events.
typedef struct vtReferencePath {
    vtVec3 origin, direction;
    float near;        ///< distance from which surfaces count
    uint32_t triangle; ///< where it starts, or VT_NO_TRIANGLE at the eye
    uint32_t random;   ///< state of its random numbers
    uint8_t events;
    uint8_t state; ///< VT_PATH_..., once it has ended
    bool inside, reflected;
    bool nudged; ///< see vtNudge
} vtReferencePath;

typedef struct vtPathRules {
    float ior;
    int maxEvents;
    bool fresnel;
} vtPathRules;

/// Most paths that vtFollowPaths takes at a time.
#define VT_PATH_BATCH 256

/// Follows paths from the eye (only origin, direction and random need be set) until each has ended.
void vtFollowPaths(const vtReference* reference, const vtPathRules* rules, vtReferencePath* paths, int count);

/// A path that starts at the eye.
static inline vtReferencePath vtMakePath(vtVec3 origin, vtVec3 direction, uint32_t random)
{
    return (vtReferencePath){
        .origin = origin, .direction = direction, .triangle = VT_NO_TRIANGLE, .random = random};
}

/// The triangle's own outward normal, not of unit length.
vtVec3 vtReference_TriangleArea(const vtReference* reference, uint32_t triangle);

/// Where to look on after a surface at `distance` that does not count.
static inline float vtStepBeyond(const vtReference* reference, float distance)
{
    return distance * 1.000001f + 1e-7f * reference->extent;
}

/// A direction 1e-5 (0.0006 degrees) beside this one. Embree can miss a surface where a ray meets a vertex
/// exactly, its robust mode included (its issues 174 and 181), and vertices do face vertices in regular
/// shapes: a ray inside closed glass that meets nothing asks once more this way.
static inline vtVec3 vtNudge(vtVec3 direction)
{
    const vtVec3 axis = fabsf(direction.x) < 0.5f ? (vtVec3){1.0f, 0.0f, 0.0f} : (vtVec3){0.0f, 1.0f, 0.0f};
    return vtNormalize(vtMulAdd(direction, 1e-5f, vtCross(direction, axis)));
}

/// PCG-RXS-M-XS (O'Neill 2014), used both as a hash and as the step of a generator.
static inline uint32_t vtHash(uint32_t x)
{
    x = x * 747796405u + 2891336453u;
    x = ((x >> ((x >> 28) + 4u)) ^ x) * 277803737u;
    return (x >> 22) ^ x;
}

/// The next random number, 0 <= number < 1.
static inline float vtNextRandom(uint32_t* state)
{
    *state = vtHash(*state);
    return (float)(*state >> 8) * 0x1p-24f;
}
