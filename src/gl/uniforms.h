// The one uniform block, the same in C and GLSL (shaders_es3/common/frame.glsl): everything a frame's passes
// have to know. Only 16-byte members, so that std140 and C agree without padding.
#pragma once

#include <assert.h>
#include <stdint.h>

#define VT_FRAME_BINDING 0

typedef struct vtFrameUniforms {
    float worldToCamera[4][4]; ///< column-major; (right, up, depth) coordinates of a world point
    float eye[4];              ///< the fourth: path.glsl's choice
    float pictureFrustum[4];   ///< left, bottom, right, top: tangents
    float layerFrustum[4];
    float pictureDepth[4]; ///< near, far, 1 / (far - near), 0
    float layerDepth[4];
    float boundsMin[4]; ///< the box of all glass, world
    float boundsMax[4];
    float optics[4]; ///< index of refraction (kay-thickness), transmittance, exposure factor, samples so far
    float kay[4];    ///< largest and smallest transmittance, power, wall thickness
    int32_t search[4]; ///< layers, linear steps, binary steps, events
    int32_t size[4];   ///< picture width, height, layer width, height
    int32_t scene[4];  ///< objects of glass, objects, Fresnel reflection, the technique finds what is opaque
                       ///< itself
    int32_t output[4]; ///< vtOutput, layer, vtEnvironmentKind, vtBackground
    int32_t host[4];   ///< lower left corner in the framebuffer; linear output; 1: colours, 2: depths, 4:
                       ///< linear colours
    float clip[4];     ///< of the projection: depth's element, constant; depth of nothing; 1: orthographic
    int32_t sample[4]; ///< its number; 1: chance chooses what its paths follow; its weight; weight of
                       ///< all beyond their number
} vtFrameUniforms;

static_assert(sizeof(vtFrameUniforms) == 20 * 16, "vtFrameUniforms must mirror the std140 block");
