// A renderer with its scene and the frame to draw next: the part of a web page that is written in C.
#pragma once

#include "base/about.h"
#include "scene/object_spec.h"
#include "vitrine.h"

/// The relief added last, of depth 1: those of other depths and slabs are made from it.
typedef struct vtKeptRelief {
    vtMesh unit;
    int source; ///< whose contents it has, a number of the caller's; 0: none, below: a pattern
    float smoothing;
    int samples; ///< asked of a pattern
} vtKeptRelief;

/// A model of a scene that has animations, and where in the scene it is.
typedef struct vtMovingModel {
    vtModel* model;
    vtModelPlace place;
} vtMovingModel;

typedef struct vtMotion {
    vtMovingModel* models;
    uint32_t count;
} vtMotion;

typedef struct vtViewer {
    vtRenderer* renderer;
    vtScene scene;               ///< on the GPU as well; kept for its numbers
    vtScene next;                ///< being put together
    vtMotion motion, nextMotion; ///< of `scene` and `next`
    float lowest; ///< y where `scene`, if it moves, stands on a ground: at rest; NAN: wherever it is
    vtPreparation* preparation; ///< of `next`; NULL: not begun
    vtTracer* tracer;           ///< of `scene`, with which it goes; NULL: no path was asked for
    vtKeptRelief kept;
    vtLimits limits;   ///< of files; 0: the defaults, as always without VT_IS_FULL
    vtWalls walls;     ///< of files that are added
    char variant[256]; ///< of their materials; empty: as they are
    vtFrame frame;     ///< of the canvas; each tick draws one of its samples
    vtFrame wanted;    ///< the settings that vtViewer_Set was told, for vtViewer_SetGlass
    int sample;        ///< the next one
    bool changed;      ///< since the frame drawn last
    int drawCount;
    uint8_t* image; ///< the last one of vtViewer_Image
    vtError error;
    char info[864];
    char path[192 + 128 * VT_MAX_EVENTS]; ///< the last one of vtViewer_Path or vtViewer_Material
} vtViewer;

/// In the current context; NULL where memory is out. See vtViewer_Error. `other`: one in the same context,
/// whose programs it shares, or NULL.
vtViewer* vtViewer_Create(int width, int height, const vtViewer* other);
void vtViewer_Destroy(vtViewer* viewer);
/// Begins a scene; what was begun before is dropped.
void vtViewer_Begin(vtViewer* viewer);

/// Draws the canvas if anything changed, else adds the next sample until all are there. 1: drawn, 0: nothing
/// to do, 2: shaders are not compiled or, see vtViewer_LacksShaders, not loaded yet, ask again, -1: failed,
/// see vtViewer_Error.
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

/// An object's line of text about something of that kind; empty: as it is.
vtResult vtViewer_ReadSpec(vtViewer* viewer, const char* text, vtObjectKind kind, vtObjectSpec* spec);

/// What is to be read of a file; NULL: the defaults.
static inline const vtLimits* vtViewer_Limits(const vtViewer* viewer)
{
    return VT_IS_FULL ? &viewer->limits : NULL;
}

/// May a picture of that size that the browser has decoded be used?
vtResult vtViewer_CheckPicture(vtViewer* viewer, const char* name, int width, int height);

void vtMotion_Clear(vtMotion* motion);
/// Takes a model over, whose scene is in the scene that was begun.
vtResult vtViewer_AddMotion(vtViewer* viewer, vtModel* model, const vtModelPlace* place);
/// Of the scene that is shown, at rest.
float vtViewer_Lowest(const vtViewer* viewer);

/// Moves what was made into the scene that was begun.
vtResult vtViewer_Add(vtViewer* viewer, vtScene* made, const vtObjectSpec* spec);

/// Move a mesh, a built-in relief or the contents of a .hdr or .pfm into the scene that was begun.
vtResult vtViewer_AddMesh(vtViewer* viewer, vtMesh* mesh, const char* name, const vtObjectSpec* spec);
vtResult vtViewer_AddPattern(vtViewer* viewer, int pattern, const vtObjectSpec* spec);
const char* vtViewer_AddRelief(vtViewer* viewer, uint8_t* bytes, size_t size, const char* name,
                               const char* text, int source);
