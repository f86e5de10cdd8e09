// The table of built-in shapes.
#include "shapes/shapes.h"

#include "base/about.h"
#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"

#include <assert.h>
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
#if VT_IS_FULL
    {"panel", VT_ABOUT("pane with rounded corners and edges, see the keys width to thickness"), vtBuildPanel,
     0},
#endif
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

/// The mesh of a shape that was built, which goes with it; not `built`: memory is short.
static vtResult finishShape(vtShapeData* shape, bool built, const char* name, vtMesh* mesh, vtError* error)
{
    vtResult result;
    if (built) {
        vtMeshDef def = {
            .positions = shape->positions,
            .normals = shape->normals,
            .indices = shape->indices,
            .vertexCount = shape->vertexCount,
            .indexCount = shape->indexCount,
            .texcoords = shape->texcoords,
        };
        result = vtCreateMesh(&def, name, mesh, error);
    } else {
        result = vtFail(error, vt_errorMemory, "shape '%s': out of memory; close other programs", name);
    }
    vtShape_Free(shape);
    return result;
}

static vtResult createShape(const ShapeRow* row, float fineness, vtMesh* mesh, vtError* error)
{
    vtShapeData shape = {.fineness = fineness};
    return finishShape(&shape, row->build(&shape), row->name, mesh, error);
}

vtResult vtCreatePanel(const vtPanelDef* def, vtMesh* mesh, vtError* error)
{
    if (mesh == NULL || def == NULL) {
        return vtFailMissing(error, "vtCreatePanel", mesh == NULL ? "mesh" : "def");
    }
    *mesh = (vtMesh){0};
    vtShapeData shape = {0};
    const vtResult result = vtCheckPanel(def, error);
    return result == vt_ok ? finishShape(&shape, vtBuildPanelOf(&shape, def), "panel", mesh, error) : result;
}

vtResult vtCreateShape(const char* name, vtMesh* mesh, vtError* error)
{
    if (mesh == NULL) {
        return vtFailMissing(error, "vtCreateShape", "mesh");
    }
    *mesh = (vtMesh){0};
    if (name == NULL) {
        return vtFailMissing(error, "vtCreateShape", "name");
    }
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
