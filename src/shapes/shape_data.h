// What the built-in shapes are made with.
#pragma once

#include "vitrine.h"

/// Triangles under construction. The room is reserved once, so adding cannot fail.
typedef struct vtShapeData {
    float* positions;
    float* normals;
    float* texcoords; ///< 2 a vertex, or NULL
    uint32_t* indices;
    uint32_t vertexCount, vertexRoom;
    uint32_t indexCount, indexRoom;
    float fineness; ///< of the round shapes' divisions, 1: the built-in ones
} vtShapeData;

/// Makes room in an empty shape; false where memory is short, and then the shape stays safe to free.
bool vtShape_Reserve(vtShapeData* shape, uint32_t vertexRoom, uint32_t triangleRoom);
/// The same with texture coordinates for every vertex, at first 0.
bool vtShape_ReserveTextured(vtShapeData* shape, uint32_t vertexRoom, uint32_t triangleRoom);
void vtShape_Free(vtShapeData* shape);

/// Returns the new vertex's number. The normal has unit length.
uint32_t vtShape_AddVertex(vtShapeData* shape, vtVec3 position, vtVec3 normal);

/// Corners counter-clockwise seen from outside.
void vtShape_AddTriangle(vtShapeData* shape, uint32_t a, uint32_t b, uint32_t c);

/// Joins two rings of `columns` consecutive vertices each. The outside is where the cross product of the
/// step from ring to ring and the step along the ring points.
void vtShape_AddBand(vtShapeData* shape, uint32_t firstRing, uint32_t secondRing, uint32_t columns);

/// Moves the centre of the bounds to the origin and scales the largest extent to `extent`.
void vtShape_Fit(vtShapeData* shape, float extent);
