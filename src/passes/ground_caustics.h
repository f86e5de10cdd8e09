// Photons on a scene's opaque things, as photons.frag writes them.
#pragma once

#include "gl/scene_buffer.h"
#include "light/caustics.h"

/// Of a photon's four words: does it come down on something opaque?
static inline bool vtLanding_IsOpaque(const uint32_t* words)
{
    return (words[3] & 0x40000u) != 0;
}

/// What is left of its light, of the most that it can have: -1 to 1.
static inline vtVec3 vtLanding_Light(const uint32_t* words)
{
    return vtScale((vtVec3){(int16_t)words[2], (int16_t)(words[2] >> 16), (int16_t)words[3]},
                   1.0f / 32767.0f);
}

/// Keeps one that does. `flux`: what is left of its light. False where memory is out.
bool vtKeepLanding(vtCaustics* caustics, const uint32_t* words, vtVec3 flux);

/// Gathers them on the scene's triangles, which are read back from the GPU, on lattices of that spacing.
/// Fails with vt_errorMemory, and as vtMakeFramebuffer does; then *map is zeroed.
vtResult vtGatherLandings(const vtCaustics* caustics, const vtGL* gl, const vtSceneBuffer* scene,
                          float spacing, vtCausticMap* map, vtError* error);
