// The CPU reference: the same scene and view as the renderer, by exact ray tracing. Slow, and right.
#pragma once

#include "vitrine.h"

/// A scene prepared for tracing.
typedef struct vtReference vtReference;

/// Builds the search structures, one a mesh (about 0.1 s for 70 000 triangles). The scene must outlive it,
/// unchanged. Fails as vtValidateScene does, and with vt_errorMemory.
vtResult vtCreateReference(const vtScene* scene, vtReference** reference, vtError* error);
/// Safe on NULL.
void vtDestroyReference(vtReference* reference);

#define VT_MAX_TRACED_SAMPLES 65536 ///< per pixel
#define VT_MAX_THREADS 1024

typedef struct vtReferenceDef {
    const vtFrame* frame; ///< view, ior, roughness, dispersion, maxEvents, exposure, width, height are used
    /// NULL: directions, events, states and reflections only.
    const vtEnvironment* environment;
    /// A pixel for the radiance, 1 to VT_MAX_TRACED_SAMPLES; 0 and 1: one through the pixel's centre, more:
    /// spread over the pixel as vtFrame.samples are. Each samples rough surfaces anew, and has one wavelength
    /// where glass disperses (a single one has three paths, at the channels' mean indices).
    int samples;
    /// Unpolarised Fresnel reflection at every event, the first surface's included: both what reflects and
    /// what refracts is followed; a path of less than 0.002 of the light by chance, with the light of those
    /// that are not. Concerns the radiance only.
    bool fresnel;
    const vtGround* ground;         ///< that the scene stands on; NULL: none. Concerns the radiance only
    const vtBackdrop* backdrop;     ///< that stands behind the scene; NULL: none. Concerns the radiance only
    const vtImage* backdropPicture; ///< of it, decoded
    /// The radiance only, as fast as it goes: directions, events, states and reflections stay NULL. Needs an
    /// environment.
    bool onlyPicture;
    int threads; ///< 1 to VT_MAX_THREADS; 0: as many as there are processors. The picture is the same.
    /// Called now and then from the calling thread with the share done, 0 to 1; NULL: not at all.
    void (*progress)(float share, void* userData);
    void* userData; ///< passed to progress
} vtReferenceDef;

/// What was traced; rows from the top. All but the radiance is that of the pixel's centre without Fresnel
/// reflection: the path that the real-time techniques imitate.
typedef struct vtReferenceImage {
    int width, height;
    float* directions;    ///< 3 a pixel: unit direction at the path's end, (2,2,2) lost, (0,0,0) where
                          ///< vtRenderer_ReadDirections has it
    uint8_t* events;      ///< surfaces where paths refract or reflect; 0: nothing but background or opaque
    uint8_t* states;      ///< VT_PATH_BACKGROUND, VT_PATH_EXITED, VT_PATH_LOST or VT_PATH_OPAQUE
    uint8_t* reflections; ///< 1 where total internal reflection took part
    float* radiance;      ///< 3 a pixel, linear, after exposure, mean over the samples; a lost path shows
                          ///< the environment in its last direction. NULL without an environment. Where
                          ///< frame->background is not the environment, of what covers the pixel alone
    float* covered; ///< share of the pixel that things and the ground's shadow cover, mean over the samples;
                    ///< NULL: the background is the environment
} vtReferenceImage;

/// Traces a picture. Fails with vt_errorArgument for a value out of range and with vt_errorMemory; then
/// *image is zeroed.
vtResult vtReference_Trace(const vtReference* reference, const vtReferenceDef* def, vtReferenceImage* image,
                           vtError* error);
/// Frees what the image holds and zeroes it. Safe on a zeroed image.
void vtDestroyReferenceImage(vtReferenceImage* image);

/// The radiance as 4 * width * height bytes, sRGB clamped to 0..1, alpha 255. The image must have radiance.
void vtReference_ToSrgb(const vtReferenceImage* image, uint8_t* rgba);
