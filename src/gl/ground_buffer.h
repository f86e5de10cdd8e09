// The ground's map on the GPU, for programs with ground.glsl.
#pragma once

#include "gl/target.h"
#include "light/caustics.h"
#include "light/ground_map.h"

typedef struct vtGroundBuffer {
    vtTexture map;      ///< RGBA16F, filtered
    vtTexture caustics; ///< RGBA32UI: vtCausticMap; one texel where there are none
    float place[4];     ///< height, the map's corner, 1 / its side; the world of vtSceneBuffer
    float matt[8];      ///< its colour, 1: it is matt; irradiance, but for lights of files; 0
} vtGroundBuffer;

/// Fails with vt_errorMemory.
vtResult vtGroundBuffer_Set(vtGroundBuffer* buffer, const vtGL* gl, const vtGroundMap* map, vtError* error);
/// The light on opaque things. Fails with vt_errorContext where the GPU has no texture of that size.
vtResult vtGroundBuffer_SetCaustics(vtGroundBuffer* buffer, const vtGL* gl, const vtCausticMap* map,
                                    vtError* error);
void vtGroundBuffer_Destroy(vtGroundBuffer* buffer, const vtGL* gl);
