// What is between a surface of the reference's scene and a light. The twin of shaders_es3/ground/shade.glsl.
#pragma once

#include "lab/reference/reference_place.h"

/// Rays from a surface to lights.
typedef struct vtShadeRays {
    vtShadows shadows;
    const vtReference* reference;
    const vtPathRules* rules;
    vtReferencePath start; ///< a path on the surface
} vtShadeRays;

/// Those from what the path has met; its own chances say which point of the sun they go to.
vtShadeRays vtMakeShadeRays(const vtReference* reference, const vtPathRules* rules,
                            const vtReferencePath* path, const vtSurfaceHit* hit);
