#pragma once

#include "gl/program.h"
#include "vitrine.h"

/// The frustum that a technique's layers lie in.
typedef enum vtLayerSpace {
    vt_layersOfObject,  ///< fitted to the object: rays do not leave it
    vt_layersOfPicture, ///< the picture's own, pixel on pixel
} vtLayerSpace;

/// Number of layers as the frame says.
#define VT_LAYERS_OF_FRAME -1

/// A rung of the ladder: what users read of it, the passes it needs, and what its refract pass is made of.
typedef struct vtTechniqueRow {
    vtTechniqueInfo info;
    bool surface;        ///< the first surface, exact
    bool innerDistances; ///< per-vertex distance inwards, with it
    int layers;          ///< layers peeled: 0, a fixed number or VT_LAYERS_OF_FRAME
    vtLayerSpace layerSpace;
    bool cube;        ///< layered depth cube of all glass, or its like from the eye
    bool branches;    ///< can follow light that left a path
    bool findsOpaque; ///< meets what is opaque on its paths
    bool merge;       ///< layers merged and gathered four to a texel
    bool bvh;         ///< hierarchy over the triangles
    vtProgramDef refract;
} vtTechniqueRow;

const vtTechniqueRow* vtTechnique_Row(vtTechnique technique);

/// Layers that the frame's technique peels.
int vtFrame_LayerCount(const vtFrame* frame);

/// Layers of the cubes: those of the frame, or of its preset where the technique needs none itself.
int vtFrame_CubeLayers(const vtFrame* frame);

/// Branches that the frame's paths have, 0 to VT_MAX_BRANCHES.
int vtFrame_BranchCount(const vtFrame* frame);
