// Where a path meets glass: the surfaces there, and what the path is within before and after them.
#pragma once

#include "lab/reference/reference_scene.h"

/// A surface of glass met by a path.
typedef struct vtSurface {
    const vtSurfaceHit* hit;
    const vtPlacedObject* object;
    vtVec3 G;    ///< outward normal of the triangle, world
    bool behind; ///< met from within
} vtSurface;

/// What a path meets at one place.
typedef struct vtPlace {
    vtSurface surfaces[VT_MAX_TOUCHING]; ///< by rank: the normals of the first count
    int count;
    const vtSurfaceHit* opaque; ///< VT_NO_TRIANGLE: there is none
    vtMedia before, after;      ///< what the path is within, if it goes on straight or refracted
} vtPlace;

/// Outward, of the triangle, world.
vtVec3 vtTriangleNormal(const vtPlacedObject* object, const vtSurfaceHit* hit);

vtVec3 vtSurfacePoint(const vtPlacedObject* object, const vtSurfaceHit* hit);

/// The surfaces of glass that the path meets; false where the nearest is the one it starts from.
bool vtFindSurfaces(const vtReference* reference, const vtReferencePath* path, const vtMeeting* meeting,
                    vtPlace* place);

/// What the path is within before the surfaces and after them. False where too much lies one in the other.
bool vtFindMedia(const vtReferencePath* path, vtPlace* place);

/// The surface whose material counts: of a body rather than of a thin wall.
const vtSurface* vtPlace_Surface(const vtPlace* place);
