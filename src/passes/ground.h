// What a scene does to the light on the ground below it, found by rays of its lights on the GPU
// (photons.frag) and added up on the CPU (light/ground.h), so that no device has to blend floats. Made when
// it is first asked for and kept: it is the same from every eye.
#pragma once

#include "passes/trace.h"

typedef struct vtGroundPass {
    vtGround ground;
    bool isThere;  ///< there is a ground
    bool isStale;  ///< what is in `buffer` is of another ground, scene or light
    bool isFresh;  ///< it was made for the frame drawn last: if it has to be made again, things move
    bool isCoarse; ///< of fewer rays, as things moved: once they do not, it is made anew
    vtFrame frame; ///< that it was made for
    const vtProgram* program;
    float mostLight; ///< that a photon of it can have, of what it has to bring
    bool hasChance;  ///< photons leave something to chance
    vtGroundBuffer buffer;
} vtGroundPass;

/// Does the map have to be made anew for the frame? (Where it does not, the caller unsets isFresh.) One of
/// more events stays: a page that draws with fewer while things move would make it again and again.
bool vtGroundPass_IsStale(const vtGroundPass* pass, const vtFrame* frame);
void vtGroundPass_Start(vtGroundPass* pass, const vtGL* gl, vtTraceVariant variant, vtProgramList* programs);

/// Makes the map; the frame's uniform block and the table of objects are uploaded, an empty vertex array is
/// bound. Fails as vtPlanGround does.
vtResult vtGroundPass_Draw(vtGroundPass* pass, const vtGL* gl, const vtSceneBuffer* scene,
                           const vtEnvironmentBuffer* environment, const vtFrame* frame, vtError* error);
/// The maps by themselves, of the ground and of opaque things, which vtGroundPass_Draw uploads. Both are to
/// be destroyed.
vtResult vtGroundPass_MakeMap(vtGroundPass* pass, const vtGL* gl, const vtSceneBuffer* scene,
                              const vtEnvironmentBuffer* environment, vtGroundMap* map,
                              vtCausticMap* caustics, vtError* error);
void vtGroundPass_Destroy(vtGroundPass* pass, const vtGL* gl);
