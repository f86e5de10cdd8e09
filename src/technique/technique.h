#pragma once

#include "gl/program.h"
#include "scene/camera.h"
#include "vitrine.h"

#ifndef __EMSCRIPTEN__
#define VT_WITH_CELLS ///< vt_searchCells; web pages search in steps whatever vtFrame.search says
#endif

/// The frustum that a technique's layers lie in.
typedef enum vtLayerSpace {
    vt_layersOfGlass = 0,  ///< one set for all glass, fitted to it: rays do not leave it
    vt_layersOfEachObject, ///< a set for each object of glass, fitted to it
    vt_layersOfPicture,    ///< one set, the picture's own, pixel on pixel
} vtLayerSpace;

/// Number of layers as the frame says.
#define VT_LAYERS_OF_FRAME (-1)

/// Programs that follow paths.
typedef enum vtVariant {
    vt_variantAny = 0, ///< through all glass
    vt_variantOpaque,  ///< the same where the scene has something opaque, if a technique has one of its own
    vt_variantOrdered, ///< through one object, from where the objects before have left the path
                       ///< (vt_multiOrdered)
    vt_variantCells,   ///< those three with vt_searchCells
    vt_variantCellsOpaque,
    vt_variantCellsOrdered,
    vt_variantCount,
} vtVariant;

/// A rung of the ladder: what users read of it, the passes it needs, and what its refract pass is made of.
typedef struct vtTechniqueRow {
    vtTechniqueInfo info;
    bool surface;        ///< the first surface, exact
    bool innerDistances; ///< per-vertex distance inwards, with it
    int layers;          ///< layers peeled: 0, a fixed number or VT_LAYERS_OF_FRAME
    vtLayerSpace layerSpace;
    bool traces;                           ///< drawn by the trace pass alone: nothing above, no refract pass
    bool roughness, dispersion;            ///< of glass: it draws them
    bool heights;                          ///< that meets a relief by its heights
    bool findsOpaque;                      ///< layered: meets what is opaque on its paths
    bool merge;                            ///< layers merged and gathered four to a texel
    vtProgramDef refract[vt_variantCount]; ///< those without a name are not there
} vtTechniqueRow;

const vtTechniqueRow* vtTechnique_Row(vtTechnique technique);

/// The program for the frame; `opaque`: there is something that is. Ordered, and with the search, that the
/// frame says where the technique has them.
vtVariant vtFrame_Variant(const vtFrame* frame, bool opaque);

static inline bool vtVariant_IsOrdered(vtVariant variant)
{
    return variant == vt_variantOrdered || variant == vt_variantCellsOrdered;
}

/// Layers that the frame's technique peels.
int vtFrame_LayerCount(const vtFrame* frame);

/// Is the frame drawn over the host's picture, or does it show it behind the glass? A build for web pages,
/// whose element has its canvas to itself, goes without (vtRenderer_Draw says so).
static inline bool vtFrame_IsOverlay(const vtFrame* frame)
{
    return VT_WITH_HOST && frame->overlay;
}

static inline bool vtFrame_HasHost(const vtFrame* frame)
{
    return VT_WITH_HOST && frame->hostColor != 0;
}

/// Has the frame paths without Fresnel reflection?
static inline bool vtFrame_IsStrict(const vtFrame* frame)
{
    return !frame->fresnel || frame->output != vt_outputPicture;
}

/// Branches that the frame's paths have, 0 to VT_MAX_BRANCHES.
int vtFrame_BranchCount(const vtFrame* frame);
