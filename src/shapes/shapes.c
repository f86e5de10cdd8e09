// The table of built-in shapes, and the few operations they are made with.
#include "shapes/shapes.h"

#include "base/about.h"
#include "base/error.h"
#include "base/math.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

typedef struct ShapeRow {
    const char* name;
    const char* summary;
    bool (*build)(vtShapeData* shape);
    uint32_t triangles; // where it can be built of others: how many it has
} ShapeRow;

static const ShapeRow shapeTable[] = {
    {"sphere", VT_ABOUT("solid ball of radius 1"), vtBuildSphere, 0},
    {"torus", VT_ABOUT("solid ring, radii 1 and 0.4, about the vertical axis"), vtBuildTorus, 2 * 96 * 192},
    {"knot", VT_ABOUT("trefoil knot of a round rod, the (2, 3) torus knot"), vtBuildKnot, 2 * 480 * 48},
    {"goblet", VT_ABOUT("hollow wine glass with stem and foot"), vtBuildGoblet, 0},
    {"bottle", VT_ABOUT("hollow wine bottle with lip and punt"), vtBuildBottle, 0},
    {"diamond", VT_ABOUT("round brilliant cut with 57 facets and a faceted girdle"), vtBuildDiamond, 0},
    {"cube", VT_ABOUT("cube of side 1.2 with flat faces"), vtBuildCube, 0},
    {"plane", VT_ABOUT("square of side 4 that faces +z, open: a ground or a backdrop"), vtBuildPlane, 0},
    {"tumbler", VT_ABOUT("hollow drinking glass with a thick base"), vtBuildTumbler, 0},
    {"water", VT_ABOUT("what fills the tumbler to 60 %, its sides inside the tumbler's walls"), vtBuildWater,
     0},
};
enum { shapeCount = sizeof shapeTable / sizeof shapeTable[0] };

const char* vtShapeName(int index)
{
    return index >= 0 && index < shapeCount ? shapeTable[index].name : NULL;
}

const char* vtShapeSummary(int index)
{
    return index >= 0 && index < shapeCount ? shapeTable[index].summary : NULL;
}

static const ShapeRow* findShape(const char* name)
{
    for (int i = 0; i < shapeCount; ++i) {
        if (strcmp(shapeTable[i].name, name) == 0) {
            return &shapeTable[i];
        }
    }
    return NULL;
}

static vtResult failUnknown(const char* name, vtError* error)
{
    char names[256] = "";
    for (int i = 0; i < shapeCount; ++i) {
        const char* separator = i == 0 ? "" : i < shapeCount - 1 ? ", " : " and ";
        size_t used = strlen(names);
        assert(used + strlen(separator) + strlen(shapeTable[i].name) < sizeof names);
        strcpy(names + used, separator);
        strcat(names, shapeTable[i].name);
    }
    return vtFail(error, vt_errorArgument, "shape '%.100s' is unknown; the shapes are %s", name, names);
}

static vtResult createShape(const ShapeRow* row, float fineness, vtMesh* mesh, vtError* error)
{
    const char* name = row->name;
    vtShapeData shape = {.fineness = fineness};
    vtResult result;
    if (row->build(&shape)) {
        vtMeshDef def = {
            .positions = shape.positions,
            .normals = shape.normals,
            .indices = shape.indices,
            .vertexCount = shape.vertexCount,
            .indexCount = shape.indexCount,
            .texcoords = shape.texcoords,
        };
        result = vtCreateMesh(&def, name, mesh, error);
    } else {
        result = vtFail(error, vt_errorMemory, "shape '%s': out of memory; close other programs", name);
    }
    vtShape_Free(&shape);
    return result;
}

vtResult vtCreateShape(const char* name, vtMesh* mesh, vtError* error)
{
    assert(name != NULL && mesh != NULL);
    *mesh = (vtMesh){0};
    const ShapeRow* row = findShape(name);
    return row != NULL ? createShape(row, 1.0f, mesh, error) : failUnknown(name, error);
}

bool vtHasFineShape(const char* name)
{
    const ShapeRow* row = findShape(name);
    return row != NULL && row->triangles > 0;
}

vtResult vtCreateFineShape(const char* name, uint32_t triangles, vtMesh* mesh, vtError* error)
{
    *mesh = (vtMesh){0};
    const ShapeRow* row = findShape(name);
    if (!vtHasFineShape(name)) {
        return vtFail(error, vt_errorArgument,
                      "'%.100s' cannot be built of another number of triangles; the knot and the torus can",
                      name);
    }
    return createShape(row, sqrtf((float)triangles / (float)row->triangles), mesh, error);
}

// -------------------------------------------------------------------------------------------- operations

bool vtShape_Reserve(vtShapeData* shape, uint32_t vertexRoom, uint32_t triangleRoom)
{
    assert(shape->positions == NULL);
    shape->positions = calloc(vertexRoom, 3 * sizeof(float));
    shape->normals = calloc(vertexRoom, 3 * sizeof(float));
    shape->indices = calloc(triangleRoom, 3 * sizeof(uint32_t));
    shape->vertexRoom = vertexRoom;
    shape->indexRoom = 3 * triangleRoom;
    return shape->positions != NULL && shape->normals != NULL && shape->indices != NULL;
}

bool vtShape_ReserveTextured(vtShapeData* shape, uint32_t vertexRoom, uint32_t triangleRoom)
{
    shape->texcoords = calloc(vertexRoom, 2 * sizeof(float));
    return vtShape_Reserve(shape, vertexRoom, triangleRoom) && shape->texcoords != NULL;
}

void vtShape_Free(vtShapeData* shape)
{
    free(shape->positions);
    free(shape->normals);
    free(shape->texcoords);
    free(shape->indices);
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
