// The light of opaque surfaces, on the CPU. The twin of shaders_es3/shade/shading.glsl.
#pragma once

#include "light/lighting.h"
#include "scene/objects.h"

/// Radiance that leaves an opaque object's surface against the direction of travel I (world, unit): at the
/// point of `triangle` with weights u and v of its second and third corner. Lit by the environment alone;
/// nothing casts shadows. Both sides of a surface are the same. Pictures are read at full size, bilinear and
/// repeated; the shader reads them averaged over a pixel where its caller says how large that is.
vtVec3 vtShadeSurface(const vtScene* scene, const vtPlacedObject* object, const vtLighting* lighting,
                      uint32_t triangle, float u, float v, vtVec3 I);
