// The heights of a relief: a slab of glass whose front is a height field, and what is asked of it where it
// has no triangles. A mesh (vtMesh.heights) owns one.
//
// The front lies over a grid of samples and faces +z. A cell between four samples is two triangles, its
// diagonal from the corner of least column and row to the opposite one. Walls stand along the border down to
// the flat back.
//
// Triangles have the numbers that vtTriangulateRelief gives them: first two a cell, row after row, the one
// below the diagonal first; then two for each segment of the border, counter-clockwise from column 0, row 0;
// then the back's, of which there are two here and more in the mesh, where they must fit the border.
#pragma once

#include "vitrine.h"

typedef struct vtHeightRange {
    float low, high;
} vtHeightRange;

#define VT_MAX_HEIGHT_LEVELS 12

struct vtHeightField {
    int width, height;  ///< samples
    float cell;         ///< side of a cell
    float left, bottom; ///< x of column 0, y of row 0
    float back;         ///< z of the back
    float low, high;    ///< of all z
    float* z;           ///< width * height, row 0 the lowest
    /// Lowest and highest z of tiles of cells, level after level, rows of tiles. Tiles of level l, 1 to
    /// levelCount, are 2^l cells a side; their numbers are powers of two, so that the levels are those of a
    /// mipmapped texture. Tiles without cells have low > high.
    vtHeightRange* ranges;
    size_t starts[VT_MAX_HEIGHT_LEVELS +
                  2]; ///< of level l in ranges; the last but one of these levels ends them
    int levelCount;
    int tileColumns, tileRows; ///< of level 1
};

typedef struct vtReliefTriangle {
    vtVec3 corners[3]; ///< counter-clockwise seen from outside
    vtVec3 normals[3]; ///< unit, outward
} vtReliefTriangle;

/// Tiles in a row and in a column of a level.
static inline int vtHeightField_TileColumns(const vtHeightField* field, int level)
{
    const int columns = field->tileColumns >> (level - 1);
    return columns > 1 ? columns : 1;
}

static inline int vtHeightField_TileRows(const vtHeightField* field, int level)
{
    const int rows = field->tileRows >> (level - 1);
    return rows > 1 ? rows : 1;
}

static inline vtHeightRange vtHeightField_Tile(const vtHeightField* field, int level, int column, int row)
{
    const size_t columns = (size_t)vtHeightField_TileColumns(field, level);
    return field->ranges[field->starts[level] + columns * (size_t)row + (size_t)column];
}

static inline float vtHeightField_Z(const vtHeightField* field, int column, int row)
{
    return field->z[(size_t)field->width * (size_t)row + (size_t)column];
}

static inline vtVec3 vtHeightField_Corner(const vtHeightField* field, int column, int row)
{
    return (vtVec3){field->left + (float)column * field->cell, field->bottom + (float)row * field->cell,
                    vtHeightField_Z(field, column, row)};
}

/// Texture coordinates over a point: a picture covers the rectangle, its top row at the greatest y.
static inline void vtHeightField_Texcoord(const vtHeightField* field, vtVec3 point, float at[2])
{
    at[0] = (point.x - field->left) / ((float)(field->width - 1) * field->cell);
    at[1] = 1.0f - (point.y - field->bottom) / ((float)(field->height - 1) * field->cell);
}

/// Smooth normal at a sample: that of central differences, at the border of one-sided ones.
vtVec3 vtHeightField_Normal(const vtHeightField* field, int column, int row);

/// Number of segments of the border, and the sample that segment `segment` starts at; the next one starts
/// where it ends.
uint32_t vtHeightField_SegmentCount(const vtHeightField* field);
void vtHeightField_BorderSample(const vtHeightField* field, uint32_t segment, int* column, int* row);

/// Numbers of the first triangle of the walls and of the back.
uint32_t vtHeightField_FirstWall(const vtHeightField* field);
uint32_t vtHeightField_FirstBack(const vtHeightField* field);

/// `number`: up to the second triangle of the back.
vtReliefTriangle vtHeightField_Triangle(const vtHeightField* field, uint32_t number);

/// Whether the point lies within the glass.
bool vtHeightField_Contains(const vtHeightField* field, vtVec3 point);

/// What the surface encloses.
double vtHeightField_Volume(const vtHeightField* field);

/// Memory that it takes.
size_t vtHeightField_Bytes(const vtHeightField* field);

/// Safe on NULL.
void vtDestroyHeightField(vtHeightField* field);
