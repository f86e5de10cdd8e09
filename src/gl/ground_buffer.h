// The ground's map on the GPU, for programs with ground.glsl.
#pragma once

#include "gl/target.h"
#include "light/ground.h"

typedef struct vtGroundBuffer {
    vtTexture map;     ///< RGBA16F, filtered
    float place[4];    ///< height, the map's corner, 1 / its side; the world of vtSceneBuffer
    float radiance[4]; ///< of a matt ground; 1: it is matt
} vtGroundBuffer;

/// `origin`: of the world that shaders know, in the map's. Fails with vt_errorMemory.
vtResult vtGroundBuffer_Set(vtGroundBuffer* buffer, const vtGL* gl, const vtGroundMap* map, vtVec3 origin,
                            vtError* error);
void vtGroundBuffer_Destroy(vtGroundBuffer* buffer, const vtGL* gl);
