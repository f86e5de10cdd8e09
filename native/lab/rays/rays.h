// What `vitrine rays` measures: rays against a relief's heights, and against triangles made of them.
#pragma once

#include <stddef.h>

#include "vitrine.h"

/// Rays of a picture, of which neighbours go much the same way, and random ones from all around.
typedef enum vtRaySet { vt_raysOfCamera, vt_raysRandom, vt_raySets } vtRaySet;

typedef enum vtRayWay {
    vt_wayDirect,       ///< heights, all separations
    vt_wayPrimitive,    ///< the same through Embree, as the reference has it
    vt_waySingle,       ///< Embree's triangles, a ray at a time
    vt_wayPackets,      ///< Embree's triangles, 8 rays at a time
    vt_wayThree,        ///< heights without tiles: the source's three separations
    vt_wayWithoutCells, ///< of these without the third, ...
    vt_wayWithoutShadow,
    vt_wayWithoutBox,
    vt_rayWays,
} vtRayWay;

enum { vt_rayCount = 1000000, vt_mostRayRounds = 99 };

/// Processor time, milliseconds; medians over the rounds.
typedef struct vtRayFigures {
    int width, height, rounds; ///< samples
    size_t triangles;
    double heightsBuild;                         ///< heights and tiles of an array of numbers
    double trianglesMade, trianglesBuild;        ///< arrays; Embree's tree
    size_t heightsBytes, meshBytes, embreeBytes; ///< the arrays and, beside them, all that Embree holds
    size_t embreePeak;                           ///< while it builds
    double times[vt_raySets][vt_rayWays];        ///< of vt_rayCount rays
    size_t hits[vt_raySets],
        differing[vt_raySets]; ///< rays that meet triangles; those for which heights say otherwise
} vtRayFigures;

/// Measures on one processor. `view`: of vt_raysOfCamera. The mesh is a relief. Fails with vt_errorMemory,
/// and with vt_errorArgument where this vitrine was built without Embree.
vtResult vtMeasureRays(const vtMesh* mesh, const vtView* view, int rounds, vtRayFigures* figures,
                       vtError* error);
