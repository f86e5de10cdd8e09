#pragma once

#include "gl/environment_buffer.h"
#include "gl/ground_buffer.h"
#include "gl/host_picture.h"
#include "gl/program.h"
#include "gl/scene_buffer.h"
#include "light/backdrop.h"

/// What a scene asks of the program; bits.
typedef enum vtTraceVariant {
    vt_traceOneObject = 1,   ///< there is one object, of closed glass
    vt_traceOpaque = 2,      ///< there is something opaque
    vt_traceHeights = 4,     ///< a relief is met by its heights
    vt_traceOnlyHeights = 8, ///< there is nothing else
    vt_traceStrict = 16,     ///< without Fresnel reflection
    vt_traceCounted = 32,    ///< texture reads are counted
    vt_traceHost = 64,       ///< over or before the host's picture
    vt_traceFootprint =
        128,              ///< pictures are seen, the environment's or of opaque things: averaged over a pixel
    vt_traceLooks = 256,  ///< some material is not plain
    vt_traceGround = 512, ///< it stands on a ground
    vt_traceRough = 1024, ///< some glass is rough
    vt_traceSpectral = 2048, ///< some glass disperses
    vt_traceBackdrop = 8192, ///< a backdrop stands behind it; with vt_traceFootprint
    vt_traceShade = 4096,    ///< opaque things are lit by the sun, or by lights of files
    vt_traceFan = 16384,     ///< colours share paths that disperse
} vtTraceVariant;

/// Do programs of materials that are not plain look for shadows? Chromium's SwiftShader compiles them for
/// more than eight minutes then, so a page has none there.
#ifdef __EMSCRIPTEN__
#define VT_SHADES_LOOKS 0
#else
#define VT_SHADES_LOOKS 1
#endif

/// The techniques that need no image of the scene: from the eye to the light in one drawing (trace.frag).
typedef struct vtTracePass {
    const vtProgram* program; ///< of the frame
    GLuint framebuffers[2];   ///< the second with depths
    vtTexture paths;          ///< RGBA32UI: bits of the last direction (three floats), state (VT_PATH_...)
    vtTexture
        radiance;     ///< RGBA32UI, bits of floats: linear light after exposure, share of the pixel it covers
    vtTexture depths; ///< R32UI, bits of a float: of what is seen first, in front of the eye; 0: nothing
} vtTracePass;

/// For a variant with vt_traceHost also `depths`.
typedef struct vtTraceInputs {
    const vtSceneBuffer* scene;
    const vtEnvironmentBuffer* environment;
    const vtHostPicture* host;
    const vtGroundBuffer* ground; ///< for a variant with vt_traceGround
    const vtTexture* backdrop;    ///< for a variant with vt_traceBackdrop: the picture
    const vtBackdropPlace* backdropPlace;
    float sun[16];   ///< for a variant with vt_traceShade: shade.glsl's
    int branches;    ///< 0 to VT_MAX_BRANCHES, times that light which left a path is followed
    int wavelengths; ///< 1 to VT_MAX_WAVELENGTHS, that the first sample follows through glass that disperses
} vtTraceInputs;

/// Is some glass rough, and drawn so? Then the first sample counts as several, and light is blurred.
bool vtTrace_IsRough(const vtSceneBuffer* scene, const vtFrame* frame);
/// Does some glass disperse, and is drawn so?
bool vtTrace_Disperses(const vtSceneBuffer* scene, const vtFrame* frame);
/// The variant for a frame, but for what a ground asks for.
vtTraceVariant vtChooseTraceVariant(const vtSceneBuffer* scene, const vtEnvironmentBuffer* environment,
                                    const vtFrame* frame);
/// The program of a variant for rays of the ground's lights (shaders_es3/ground/photons.frag); of the
/// variant's bits those count that say what the scene is made of.
vtProgramDef vtTracePhotons(vtTraceVariant variant);
/// Textures of scene and environment.
void vtBindTraced(const vtGL* gl, const vtSceneBuffer* scene, const vtEnvironmentBuffer* environment);
void vtTracePass_Start(vtTracePass* pass, const vtGL* gl, vtTraceVariant variant, vtProgramList* programs);
vtResult vtTracePass_Resize(vtTracePass* pass, const vtGL* gl, vtTraceVariant variant, int width, int height,
                            vtError* error);
void vtTracePass_Draw(const vtTracePass* pass, const vtGL* gl, vtTraceVariant variant,
                      const vtTraceInputs* inputs);
void vtTracePass_Destroy(vtTracePass* pass, const vtGL* gl);
size_t vtTracePass_Bytes(const vtTracePass* pass);
