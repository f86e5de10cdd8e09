#include "shapes/shape_data.h"

#include "base/math.h"
#include "base/memory.h"

#include <assert.h>

bool vtShape_Reserve(vtShapeData* shape, uint32_t vertexRoom, uint32_t triangleRoom)
{
    assert(shape->positions == NULL);
    shape->positions = vtAllocateZeroed(vertexRoom, 3 * sizeof(float));
    shape->normals = vtAllocateZeroed(vertexRoom, 3 * sizeof(float));
    shape->indices = vtAllocateZeroed(triangleRoom, 3 * sizeof(uint32_t));
    shape->vertexRoom = vertexRoom;
    shape->indexRoom = 3 * triangleRoom;
    return shape->positions != NULL && shape->normals != NULL && shape->indices != NULL;
}

bool vtShape_ReserveTextured(vtShapeData* shape, uint32_t vertexRoom, uint32_t triangleRoom)
{
    shape->texcoords = vtAllocateZeroed(vertexRoom, 2 * sizeof(float));
    return vtShape_Reserve(shape, vertexRoom, triangleRoom) && shape->texcoords != NULL;
}

void vtShape_Free(vtShapeData* shape)
{
    vtFree(shape->positions);
    vtFree(shape->normals);
    vtFree(shape->texcoords);
    vtFree(shape->indices);
    *shape = (vtShapeData){0};
}

static void writeVector(float* array, uint32_t element, vtVec3 v)
{
    array[3 * element] = v.x;
    array[3 * element + 1] = v.y;
    array[3 * element + 2] = v.z;
}

uint32_t vtShape_AddVertex(vtShapeData* shape, vtVec3 position, vtVec3 normal)
{
    assert(shape->vertexCount < shape->vertexRoom);
    writeVector(shape->positions, shape->vertexCount, position);
    writeVector(shape->normals, shape->vertexCount, normal);
    return shape->vertexCount++;
}

void vtShape_AddTriangle(vtShapeData* shape, uint32_t a, uint32_t b, uint32_t c)
{
    assert(shape->indexCount + 3 <= shape->indexRoom);
    shape->indices[shape->indexCount++] = a;
    shape->indices[shape->indexCount++] = b;
    shape->indices[shape->indexCount++] = c;
}

void vtShape_AddBand(vtShapeData* shape, uint32_t firstRing, uint32_t secondRing, uint32_t columns)
{
    for (uint32_t column = 0; column < columns; ++column) {
        uint32_t next = (column + 1) % columns;
        vtShape_AddTriangle(shape, firstRing + column, secondRing + column, firstRing + next);
        vtShape_AddTriangle(shape, secondRing + column, secondRing + next, firstRing + next);
    }
}

void vtShape_Fit(vtShapeData* shape, float extent)
{
    assert(shape->vertexCount > 0);
    vtVec3 low = vtMakeVec3(shape->positions);
    vtVec3 high = low;
    for (uint32_t i = 1; i < shape->vertexCount; ++i) {
        vtVec3 p = vtMakeVec3(shape->positions + 3 * i);
        low = (vtVec3){fminf(low.x, p.x), fminf(low.y, p.y), fminf(low.z, p.z)};
        high = (vtVec3){fmaxf(high.x, p.x), fmaxf(high.y, p.y), fmaxf(high.z, p.z)};
    }
    vtVec3 size = vtSub(high, low);
    vtVec3 centre = vtScale(vtAdd(low, high), 0.5f);
    float scale = extent / fmaxf(size.x, fmaxf(size.y, size.z));
    for (uint32_t i = 0; i < shape->vertexCount; ++i) {
        vtVec3 p = vtScale(vtSub(vtMakeVec3(shape->positions + 3 * i), centre), scale);
        writeVector(shape->positions, i, p);
    }
}
