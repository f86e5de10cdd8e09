// A renderer with its scene and the frame to draw next: the part of a web page that is written in C.
#pragma once

#include "vitrine.h"

typedef struct vtViewer {
    vtRenderer* renderer;
    vtScene scene; ///< on the GPU as well; kept for its numbers
    vtScene next;  ///< being put together
    vtFrame frame; ///< of the canvas; each tick draws one of its samples
    int sample;    ///< the next one
    bool changed;  ///< since the frame drawn last
    int drawCount;
    uint8_t* image; ///< the last one of vtViewer_Image
    vtError error;
    char info[640];
    char path[192 + 128 * VT_MAX_EVENTS]; ///< the last one of vtViewer_Path
} vtViewer;

/// Compiles the shaders in the current context; NULL where memory is out. See vtViewer_Error.
vtViewer* vtViewer_Create(int width, int height);
void vtViewer_Destroy(vtViewer* viewer);

/// Draws the canvas if anything changed, else adds the next sample until all are there. 1: drawn, 0: nothing
/// to do, -1: failed, see vtViewer_Error.
int vtViewer_Tick(vtViewer* viewer);

/// Gives the scene what a technique needs; where that cannot be had, all stays on the GPU as it was.
vtResult vtViewer_PrepareScene(vtViewer* viewer, vtTechnique technique);

/// `heightfield` for a scene with a relief, else `exact`.
vtTechnique vtViewer_UsualTechnique(const vtViewer* viewer);

/// Of the scene's glass.
typedef struct vtSceneFacts {
    uint32_t triangles, openEdges, glassCount;
    float ior; ///< in the picture; 0: not all of it has the same, or there is none
} vtSceneFacts;
vtSceneFacts vtViewer_SceneFacts(const vtViewer* viewer);
