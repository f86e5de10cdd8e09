// Triangles of a relief. The front and the walls have them at every sample; the flat back, whose border must
// fit the walls', has rings of triangles that double their size from one to the next inwards, so that it
// costs next to nothing.

#include "base/error.h"
#include "base/math.h"
#include "mesh/height_field.h"

/// A rectangle of the back between the samples, `columns` by `rows` equal parts.
typedef struct Ring {
    int inset; ///< from the border, cells
    int columns, rows;
    uint32_t first; ///< vertex; of all of its grid where it is the innermost one
} Ring;

static void addVertex(vtMesh* mesh, vtVec3 p, vtVec3 n)
{
    float* position = mesh->positions + 3 * (size_t)mesh->vertexCount;
    float* normal = mesh->normals + 3 * (size_t)mesh->vertexCount++;
    position[0] = p.x;
    position[1] = p.y;
    position[2] = p.z;
    normal[0] = n.x;
    normal[1] = n.y;
    normal[2] = n.z;
}

static void addTriangle(vtMesh* mesh, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t* indices = mesh->indices + mesh->indexCount;
    indices[0] = a;
    indices[1] = b;
    indices[2] = c;
    mesh->indexCount += 3;
}

static void addFront(vtMesh* mesh, const vtHeightField* field)
{
    for (int row = 0; row < field->height; ++row) {
        for (int column = 0; column < field->width; ++column) {
            addVertex(mesh, vtHeightField_Corner(field, column, row),
                      vtHeightField_Normal(field, column, row));
        }
    }
    const uint32_t width = (uint32_t)field->width;
    for (uint32_t row = 0; row + 1 < (uint32_t)field->height; ++row) {
        for (uint32_t a = row * width; a + 1 < (row + 1) * width; ++a) {
            addTriangle(mesh, a, a + 1, a + width + 1);
            addTriangle(mesh, a, a + width + 1, a + width);
        }
    }
}

static void addWalls(vtMesh* mesh, const vtHeightField* field)
{
    const uint32_t first = vtHeightField_FirstWall(field), count = vtHeightField_SegmentCount(field);
    // Each side has vertices of its own, since its normal is: a segment's, and the last one's end.
    vtVec3 before = {0.0f, 0.0f, 0.0f};
    for (uint32_t segment = 0; segment < count; ++segment) {
        const vtReliefTriangle wall = vtHeightField_Triangle(field, first + 2 * segment);
        if (vtDot(wall.normals[0], before) < 0.5f) {
            addVertex(mesh, wall.corners[0], wall.normals[0]);
            addVertex(mesh, vtHeightField_Triangle(field, first + 2 * segment + 1).corners[2],
                      wall.normals[0]);
        }
        before = wall.normals[0];
        addVertex(mesh, wall.corners[1], before);
        addVertex(mesh, wall.corners[2], before);
        const uint32_t a = mesh->vertexCount - 4; // foot, head, next foot, next head
        addTriangle(mesh, a, a + 2, a + 3);
        addTriangle(mesh, a, a + 3, a + 1);
    }
}

// -------------------------------------------------------------------------------------------------- back

/// A point of the ring's grid.
static vtVec3 ringPoint(const vtHeightField* field, const Ring* ring, int column, int row)
{
    // Whole numbers while they are: the border's points are the walls' to the last bit.
    const float across = (float)(field->width - 1 - 2 * ring->inset);
    const float up = (float)(field->height - 1 - 2 * ring->inset);
    const float x = (float)ring->inset + across * (float)column / (float)ring->columns;
    const float y = (float)ring->inset + up * (float)row / (float)ring->rows;
    return (vtVec3){field->left + x * field->cell, field->bottom + y * field->cell, field->back};
}

/// Point `i` of one of its sides, counter-clockwise from column 0, row 0.
static void sidePoint(const Ring* ring, int side, int i, int* column, int* row)
{
    *column = side == 0 ? i : side == 1 ? ring->columns : side == 2 ? ring->columns - i : 0;
    *row = side == 0 ? 0 : side == 1 ? i : side == 2 ? ring->rows : ring->rows - i;
}

static int sideLength(const Ring* ring, int side)
{
    return side % 2 == 0 ? ring->columns : ring->rows;
}

static uint32_t sideVertex(const Ring* ring, bool innermost, int side, int i)
{
    if (innermost) {
        int column, row;
        sidePoint(ring, side, i, &column, &row);
        return ring->first + (uint32_t)(row * (ring->columns + 1) + column);
    }
    int before = i;
    for (int k = 0; k < side; ++k) {
        before += sideLength(ring, k);
    }
    return ring->first + (uint32_t)(before % (2 * (ring->columns + ring->rows)));
}

static void addRingVertices(vtMesh* mesh, const vtHeightField* field, Ring* ring)
{
    ring->first = mesh->vertexCount;
    for (int side = 0; side < 4; ++side) {
        for (int i = 0; i < sideLength(ring, side); ++i) {
            int column, row;
            sidePoint(ring, side, i, &column, &row);
            addVertex(mesh, ringPoint(field, ring, column, row), (vtVec3){0.0f, 0.0f, -1.0f});
        }
    }
}

static void addInnermost(vtMesh* mesh, const vtHeightField* field, Ring* ring)
{
    ring->first = mesh->vertexCount;
    for (int row = 0; row <= ring->rows; ++row) {
        for (int column = 0; column <= ring->columns; ++column) {
            addVertex(mesh, ringPoint(field, ring, column, row), (vtVec3){0.0f, 0.0f, -1.0f});
        }
    }
    const uint32_t width = (uint32_t)ring->columns + 1;
    for (uint32_t row = 0; row < (uint32_t)ring->rows; ++row) {
        for (uint32_t column = 0; column + 1 < width; ++column) {
            const uint32_t a = ring->first + row * width + column;
            addTriangle(mesh, a, a + width + 1, a + 1);
            addTriangle(mesh, a, a + width, a + width + 1);
        }
    }
}

/// The band between two rings, a side at a time: along both at once, the one that is behind goes on.
static void joinRings(vtMesh* mesh, const Ring* outer, const Ring* inner, bool innermost)
{
    for (int side = 0; side < 4; ++side) {
        const int outerLength = sideLength(outer, side), innerLength = sideLength(inner, side);
        int i = 0, k = 0;
        while (i < outerLength || k < innerLength) {
            const uint32_t a = sideVertex(outer, false, side, i), b = sideVertex(inner, innermost, side, k);
            const bool goesOuter = k == innerLength || (i < outerLength && (2 * i + 1) * innerLength <=
                                                                               (2 * k + 1) * outerLength);
            addTriangle(mesh, a, b,
                        goesOuter ? sideVertex(outer, false, side, i + 1)
                                  : sideVertex(inner, innermost, side, k + 1));
            i += goesOuter;
            k += !goesOuter;
        }
    }
}

/// The ring whose parts are about `size` cells long; no parts where it does not fit.
static Ring makeRing(const vtHeightField* field, int size)
{
    const int inset = size - 1;
    const int across = field->width - 1 - 2 * inset, up = field->height - 1 - 2 * inset;
    const bool fits = across >= size && up >= size;
    return (Ring){.inset = inset,
                  .columns = fits ? (across + size / 2) / size : 0,
                  .rows = fits ? (up + size / 2) / size : 0};
}

static void addBack(vtMesh* mesh, const vtHeightField* field)
{
    Ring before = {0}, ring = makeRing(field, 1);
    for (int size = 1; ring.columns > 0; size *= 2) {
        const Ring next = makeRing(field, 2 * size);
        const bool innermost = next.columns == 0;
        if (innermost) {
            addInnermost(mesh, field, &ring);
        } else {
            addRingVertices(mesh, field, &ring);
        }
        if (size > 1) {
            joinRings(mesh, &before, &ring, innermost);
        }
        before = ring;
        ring = next;
    }
}

vtResult vtTriangulateRelief(vtMesh* mesh, vtError* error)
{
    if (mesh == NULL) {
        return vtFailMissing(error, "vtTriangulateRelief", "mesh");
    }
    const vtHeightField* field = mesh->heights;
    if (field == NULL || mesh->indexCount > 0) {
        return vtSucceed(error);
    }
    const size_t samples = (size_t)field->width * (size_t)field->height;
    const size_t border = vtHeightField_SegmentCount(field);
    // The back's rings have at most as many vertices as two borders, its innermost grid, at most four parts
    // wide, as many again; a relief that is narrower than that has a grid as its front has.
    const size_t vertices = samples + 2 * (border + 4) + 5 * border + 64;
    const size_t triangles = vtHeightField_FirstBack(field) + 10 * border + 128;
    mesh->positions = vtAllocate(vertices, 3 * sizeof(float));
    mesh->normals = vtAllocate(vertices, 3 * sizeof(float));
    mesh->indices = vtAllocate(triangles, 3 * sizeof(uint32_t));
    if (mesh->positions == NULL || mesh->normals == NULL || mesh->indices == NULL) {
        vtFree(mesh->positions);
        vtFree(mesh->normals);
        vtFree(mesh->indices);
        mesh->positions = mesh->normals = NULL;
        mesh->indices = NULL;
        return vtFail(
            error, vt_errorMemory,
            "relief: out of memory for the %zu triangles of %d x %d samples; draw it with technique "
            "heightfield, which needs none",
            triangles, field->width, field->height);
    }
    mesh->vertexCount = mesh->indexCount = 0;
    addFront(mesh, field);
    addWalls(mesh, field);
    addBack(mesh, field);
    return vtSucceed(error);
}
