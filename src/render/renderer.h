// What the files of the renderer share: its state, and the steps of a frame that progressive sampling
// repeats.
#pragma once

#include "base/slots.h"
#include "gl/environment_buffer.h"
#include "gl/scene_buffer.h"
#include "passes/accumulate.h"
#include "passes/ground.h"
#include "passes/merge.h"
#include "passes/overlay.h"
#include "passes/peel.h"
#include "passes/present.h"
#include "passes/refract.h"
#include "passes/shade.h"
#include "passes/surface.h"
#include "passes/trace.h"
#include "render/uniforms.h"

struct vtRenderer {
    vtGL gl;
    vtLogFcn* log;
    void* logData;
    GLuint uniformBuffer;
    GLuint emptyVertexArray; // for passes that draw the viewport's triangle
    vtSurfacePass surface;
    vtPeelPass peel;
    vtMergePass merge;
    vtRefractPass refract;
    vtShadePass shade;
    vtTracePass trace;
    vtGroundPass ground;
    vtPresentPass present;
    vtAccumulatePass accumulate;
    vtOverlayPass overlay;
    vtHostPicture host; // of the frame
    bool drawsFloats;   // vtRenderer_DrawFloats is at work
    bool nearIsGreater; // in its depth buffer
    bool lacksShaders;  // the last frame asked for does, see vtRenderer_SetLaterShaders
    // What there is to draw, and the handles of its geometry and instances.
    vtSceneBuffer scene;
    vtSlots geometrySlots, instanceSlots;
    vtEnvironmentBuffer environment;
    vtTexture background; // the picture; not there: none
    vtTexture backdropPicture;
    vtBackdrop backdrop;
    bool hasBackdrop;
    vtBackdropPlace backdropPlace; // of the frame
    // What the next frame has to agree with to go on with the samples.
    vtFrame frame;            // the last, as it was drawn
    vtFrameUniforms uniforms; // its own, of the pixel's centre
    int sampleEnd;            // the first sample not drawn yet; 0: nothing to go on with
    int movingEnd;            // the same where what has changed since is motion
    // vtRenderer_DrawImage draws into this.
    GLuint imageFramebuffer;
    vtTexture image; // RGBA8, or RGBA32UI where floats are drawn
};

/// Fails with vt_errorArgument where there is no renderer or no other thing that the call needs.
vtResult vtCheckGiven(const vtRenderer* renderer, const void* thing, const char* what, vtError* error);

/// What was computed of the content before: the samples, and what falls on the ground.
void vtForgetDrawn(vtRenderer* renderer);

/// After a frame that GL had no memory for, or was lost in: whatever frames make for themselves may be half
/// made, so it goes, and the next frame makes it anew.
void vtRenderer_DropTargets(vtRenderer* renderer);

/// As vtCheckGL of what a frame has made, which goes where GL tells of an error. For browsers, where frames
/// do not ask (vtCheckFrame): once the GPU is done.
vtResult vtRenderer_CheckDrawn(vtRenderer* renderer, const char* doing, vtError* error);

/// Of a page, which loads some shaders once a frame lacks them: the file that cmake/EmbedShaders.cmake made,
/// with 0 for each form feed and one more at its end. The caller keeps it. Fails where it is another build's.
vtResult vtRenderer_SetLaterShaders(vtRenderer* renderer, const char* file, vtError* error);

/// The frame as it is drawn: GL's state taken over, objects placed, settings resolved, the camera in the
/// scene buffer's world. Fails with a sentence where it cannot be drawn.
vtResult vtRenderer_ResolveFrame(vtRenderer* renderer, const vtFrame* asked, vtFrame* frame, vtCamera* camera,
                                 vtError* error);

/// Is a ground seen in the frame?
bool vtRenderer_ShowsGround(const vtRenderer* renderer, const vtFrame* frame);

/// Is the backdrop seen in the frame?
bool vtRenderer_ShowsBackdrop(const vtRenderer* renderer, const vtFrame* frame);

/// Of a page, which fills it: the texture of a backdrop's picture of that size, bound. Fails as
/// vtRenderer_SetBackground does.
vtResult vtRenderer_SizeBackdrop(vtRenderer* renderer, int width, int height, vtError* error);

/// Starts the programs that the frame draws with.
void vtRenderer_StartPrograms(vtRenderer* renderer, const vtFrame* frame, vtProgramList* programs);

/// Has this GPU textures as large as the picture? It is not asked again for a size that was drawn last.
vtResult vtRenderer_CheckSize(const vtRenderer* renderer, const vtFrame* frame, vtError* error);

vtResult vtRenderer_ResizeTargets(vtRenderer* renderer, const vtFrame* frame, int layerWidth, int layerHeight,
                                  vtError* error);

/// Everything up to the light, with the uniform block that was uploaded. `layersToo`: layers are peeled, too;
/// else those of the sample before stay.
void vtRenderer_DrawPaths(vtRenderer* renderer, const vtFrame* frame, bool layersToo);

/// Where that has left the paths and the light.
const vtTexture* vtRenderer_Paths(const vtRenderer* renderer);
const vtTexture* vtRenderer_Light(const vtRenderer* renderer);

/// Uploads the uniform block of one sample; `count` samples are in the sum with it.
void vtRenderer_UploadSample(const vtRenderer* renderer, int sample, int count);

/// Does the frame show the mean of several samples?
static inline bool vtFrame_AddsSamples(const vtFrame* frame)
{
    return frame->output == vt_outputPicture && frame->firstSample + frame->samples > 1;
}

/// Keeps what the next frame has to agree with to go on with this one's samples. True where this one agrees
/// with the one before.
bool vtRenderer_KeepFrame(vtRenderer* renderer, const vtFrame* frame, const vtFrameUniforms* uniforms);

/// The last pass of a frame that is drawn over the host's picture.
void vtRenderer_DrawOverlay(const vtRenderer* renderer, const vtFrame* frame, const vtTexture* light);

/// What lies behind the scene, in front of a frame's transparent pixels.
vtBehind vtRenderer_Behind(const vtRenderer* renderer, const vtFrame* frame);

/// Draws the samples that are asked for and not there yet, and shows the mean of all. `sampleEnd`: of the
/// frame before, if this one goes on with it, else 0.
void vtRenderer_DrawSamples(vtRenderer* renderer, const vtFrame* frame, int sampleEnd);

void vtEndStage(const vtFrame* frame, const char* stage);
