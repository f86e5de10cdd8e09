// Heights on a grid. The two triangles a cell and the smooth normals are those of Weng, Direct Rendering of
// Height Fields; the pyramid of lowest and highest heights that of Tevs, Ihrke, Seidel, Maximum Mipmaps for
// Fast, Accurate, and Scalable Dynamic Height Field Rendering, 2008, with lowest ones beside the highest, as
// rays run on both sides of glass.
#include "mesh/height_field.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "image/image_checks.h"

/// The relief's longer side.
static const float longerSide = 2.0f;

static int clampInt(int x, int low, int high)
{
    return x < low ? low : x > high ? high : x;
}

static int powerOfTwo(int least)
{
    int power = 1;
    while (power < least) {
        power *= 2;
    }
    return power;
}

// ------------------------------------------------------------------------------------------------ creation

static vtResult checkDef(const vtReliefDef* def, const char* name, vtError* error)
{
    if (vtCheckHeightSides(name, def->width, def->height, vt_errorGeometry, error) != vt_ok) {
        return vt_errorGeometry;
    }
    // Written so that NaN fails.
    if (!(def->depth >= 0.0f && def->depth <= 10.0f)) {
        return vtFail(error, vt_errorArgument, "relief '%.300s': its depth is %g; it must be from 0 to 10",
                      name, (double)def->depth);
    }
    if (!(def->thickness >= 0.001f && def->thickness <= 10.0f)) {
        return vtFail(error, vt_errorArgument,
                      "relief '%.300s': the slab's thickness is %g; it must be from 0.001 to 10", name,
                      (double)def->thickness);
    }
    if (def->smoothing != -1.0f && !(def->smoothing >= 0.0f && def->smoothing <= 64.0f)) {
        return vtFail(error, vt_errorArgument, "relief '%.300s': smoothing is %g; it must be from 0 to 64",
                      name, (double)def->smoothing);
    }
    for (int row = 0; row < def->height; ++row) {
        for (int column = 0; column < def->width; ++column) {
            const float height = def->heights[(size_t)row * (size_t)def->width + (size_t)column];
            if (!isfinite(height) || fabsf(height) > 1e6f) {
                return vtFail(
                    error, vt_errorGeometry,
                    "relief '%.300s': the height in column %d, row %d is %g; it must be a number of at most "
                    "1000000",
                    name, column, row, (double)height);
            }
        }
    }
    return vt_ok;
}

/// A Gaussian along a row, samples beyond the border as the one on it.
static void blurAlong(const float* from, float* to, int count, const float* weights, int reach)
{
    for (int i = 0; i < count; ++i) {
        float sum = 0.0f;
        for (int k = -reach; k <= reach; ++k) {
            sum += weights[k + reach] * from[clampInt(i + k, 0, count - 1)];
        }
        to[i] = sum;
    }
}

/// The same across rows, a whole row at a time: a column's samples lie far apart in memory.
static void blurAcross(const float* from, float* to, const vtHeightField* field, int row,
                       const float* weights, int reach)
{
    const size_t width = (size_t)field->width;
    memset(to, 0, width * sizeof *to);
    for (int k = -reach; k <= reach; ++k) {
        const float* other = from + width * (size_t)clampInt(row + k, 0, field->height - 1);
        for (size_t column = 0; column < width; ++column) {
            to[column] += weights[k + reach] * other[column];
        }
    }
}

static bool smooth(vtHeightField* field, float deviation)
{
    enum { mostReach = 192 };
    const size_t count = (size_t)field->width * (size_t)field->height;
    const int reach = (int)ceilf(3.0f * deviation);
    assert(reach <= mostReach);
    float weights[2 * mostReach + 1], total = 0.0f;
    for (int k = -reach; k <= reach; ++k) {
        // Of the middle it is 1, although the square of a tiny deviation is 0.
        weights[k + reach] = k == 0 ? 1.0f : expf(-0.5f * (float)(k * k) / (deviation * deviation));
        total += weights[k + reach];
    }
    for (int k = 0; k <= 2 * reach; ++k) {
        weights[k] /= total;
    }
    float* between = vtAllocate(count, sizeof *between);
    if (between == NULL) {
        return false;
    }
    const size_t width = (size_t)field->width;
    for (int row = 0; row < field->height; ++row) {
        const size_t first = (size_t)row * width;
        blurAlong(field->z + first, between + first, field->width, weights, reach);
    }
    for (int row = 0; row < field->height; ++row) {
        blurAcross(between, field->z + (size_t)row * width, field, row, weights, reach);
    }
    vtFree(between);
    return true;
}

static vtHeightRange join(vtHeightRange a, vtHeightRange b)
{
    return (vtHeightRange){fminf(a.low, b.low), fmaxf(a.high, b.high)};
}

static vtHeightRange rangeOfCells(const vtHeightField* field, int column, int row)
{
    // Two by two cells, three by three samples.
    vtHeightRange range = {INFINITY, -INFINITY};
    for (int y = row; y <= row + 2 && y < field->height; ++y) {
        for (int x = column; x <= column + 2 && x < field->width; ++x) {
            const float z = vtHeightField_Z(field, x, y);
            range = join(range, (vtHeightRange){z, z});
        }
    }
    const bool hasCells = column < field->width - 1 && row < field->height - 1;
    return hasCells ? range : (vtHeightRange){INFINITY, -INFINITY};
}

static void fillLevel(vtHeightField* field, int level)
{
    const int columns = vtHeightField_TileColumns(field, level), rows = vtHeightField_TileRows(field, level);
    vtHeightRange* range = field->ranges + field->starts[level];
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column, ++range) {
            if (level == 1) {
                *range = rangeOfCells(field, 2 * column, 2 * row);
                continue;
            }
            const int lastColumn = vtHeightField_TileColumns(field, level - 1) - 1;
            const int lastRow = vtHeightField_TileRows(field, level - 1) - 1;
            *range = vtHeightField_Tile(field, level - 1, 2 * column, 2 * row);
            for (int i = 1; i < 4; ++i) {
                const int x = 2 * column + (i & 1), y = 2 * row + (i >> 1);
                if (x <= lastColumn && y <= lastRow) {
                    *range = join(*range, vtHeightField_Tile(field, level - 1, x, y));
                }
            }
        }
    }
}

static bool buildRanges(vtHeightField* field)
{
    field->tileColumns = powerOfTwo((field->width - 1 + 1) / 2);
    field->tileRows = powerOfTwo((field->height - 1 + 1) / 2);
    size_t count = 0;
    int level = 0;
    do {
        ++level;
        field->starts[level] = count;
        count +=
            (size_t)vtHeightField_TileColumns(field, level) * (size_t)vtHeightField_TileRows(field, level);
    } while (vtHeightField_TileColumns(field, level) > 1 || vtHeightField_TileRows(field, level) > 1);
    field->levelCount = level;
    field->starts[level + 1] = count;
    field->ranges = vtAllocate(count, sizeof *field->ranges);
    for (int i = 1; i <= level && field->ranges != NULL; ++i) {
        fillLevel(field, i);
    }
    return field->ranges != NULL;
}

static bool fillField(vtHeightField* field, const vtReliefDef* def)
{
    const size_t width = (size_t)def->width, count = width * (size_t)def->height;
    const int longer = def->width > def->height ? def->width : def->height;
    field->width = def->width;
    field->height = def->height;
    field->cell = longerSide / (float)(longer - 1);
    field->left = -0.5f * (float)(def->width - 1) * field->cell;
    field->bottom = -0.5f * (float)(def->height - 1) * field->cell;
    field->z = vtAllocate(count, sizeof *field->z);
    if (field->z == NULL) {
        return false;
    }
    for (size_t row = 0; row < (size_t)def->height; ++row) {
        const float* from = def->heights + width * ((size_t)def->height - 1 - row);
        for (size_t column = 0; column < width; ++column) {
            field->z[width * row + column] = def->depth * from[column];
        }
    }
    if (def->smoothing > 0.0f && !smooth(field, def->smoothing)) {
        return false;
    }
    if (!buildRanges(field)) {
        return false;
    }
    const vtHeightRange all = vtHeightField_Tile(field, field->levelCount, 0, 0);
    field->low = all.low;
    field->high = all.high;
    field->back = fminf(all.low, 0.0f) - def->thickness;
    return true;
}

vtResult vtCreateRelief(const vtReliefDef* def, const char* name, vtMesh* mesh, vtError* error)
{
    if (mesh == NULL) {
        return vtFailMissing(error, "vtCreateRelief", "mesh");
    }
    *mesh = (vtMesh){0};
    if (def == NULL || def->heights == NULL) {
        return vtFailMissing(error, "vtCreateRelief", def == NULL ? "def" : "def->heights");
    }
    name = name != NULL ? name : "unnamed";
    vtResult result = checkDef(def, name, error);
    if (result != vt_ok) {
        return result;
    }
    vtHeightField* field = vtAllocateZeroed(1, sizeof *field);
    if (field == NULL || !fillField(field, def)) {
        vtDestroyHeightField(field);
        return vtFail(error, vt_errorMemory,
                      "relief '%.300s': out of memory for %d x %d samples; scale it down", name, def->width,
                      def->height);
    }
    const vtVec3 last = vtHeightField_Corner(field, field->width - 1, field->height - 1);
    mesh->heights = field;
    mesh->boundsMin = (vtVec3){field->left, field->bottom, field->back};
    mesh->boundsMax = (vtVec3){last.x, last.y, field->high};
    mesh->volume = fabs(vtHeightField_Volume(field));
    return vtSucceed(error);
}

void vtDestroyHeightField(vtHeightField* field)
{
    if (field != NULL) {
        vtFree(field->z);
        vtFree(field->ranges);
        vtFree(field);
    }
}

// ----------------------------------------------------------------------------------------------- questions

vtVec3 vtHeightField_Normal(const vtHeightField* field, int column, int row)
{
    const int left = clampInt(column - 1, 0, field->width - 1),
              right = clampInt(column + 1, 0, field->width - 1);
    const int below = clampInt(row - 1, 0, field->height - 1),
              above = clampInt(row + 1, 0, field->height - 1);
    const float x = vtHeightField_Z(field, right, row) - vtHeightField_Z(field, left, row);
    const float y = vtHeightField_Z(field, column, above) - vtHeightField_Z(field, column, below);
    return vtNormalize((vtVec3){-x / ((float)(right - left) * field->cell),
                                -y / ((float)(above - below) * field->cell), 1.0f});
}

uint32_t vtHeightField_SegmentCount(const vtHeightField* field)
{
    return 2 * (uint32_t)(field->width - 1) + 2 * (uint32_t)(field->height - 1);
}

void vtHeightField_BorderSample(const vtHeightField* field, uint32_t segment, int* column, int* row)
{
    const int across = field->width - 1, up = field->height - 1;
    int i = (int)(segment % vtHeightField_SegmentCount(field));
    if (i < across) {
        *column = i;
        *row = 0;
    } else if ((i -= across) < up) {
        *column = across;
        *row = i;
    } else if ((i -= up) < across) {
        *column = across - i;
        *row = up;
    } else {
        *column = 0;
        *row = up - (i - across);
    }
}

uint32_t vtHeightField_FirstWall(const vtHeightField* field)
{
    return 2 * (uint32_t)(field->width - 1) * (uint32_t)(field->height - 1);
}

uint32_t vtHeightField_FirstBack(const vtHeightField* field)
{
    return vtHeightField_FirstWall(field) + 2 * vtHeightField_SegmentCount(field);
}

static vtReliefTriangle frontTriangle(const vtHeightField* field, uint32_t number)
{
    const int cells = field->width - 1, column = (int)(number / 2) % cells, row = (int)(number / 2) / cells;
    const bool above = (number & 1) != 0;
    const int columns[3] = {column, column + 1, above ? column : column + 1};
    const int rows[3] = {row, above ? row + 1 : row, row + 1};
    vtReliefTriangle triangle;
    for (int i = 0; i < 3; ++i) {
        triangle.corners[i] = vtHeightField_Corner(field, columns[i], rows[i]);
        triangle.normals[i] = vtHeightField_Normal(field, columns[i], rows[i]);
    }
    return triangle;
}

static vtReliefTriangle flatTriangle(vtVec3 a, vtVec3 b, vtVec3 c, vtVec3 normal)
{
    return (vtReliefTriangle){{a, b, c}, {normal, normal, normal}};
}

static vtReliefTriangle wallTriangle(const vtHeightField* field, uint32_t number)
{
    const uint32_t segment = number / 2;
    int columns[2], rows[2];
    vtHeightField_BorderSample(field, segment, &columns[0], &rows[0]);
    vtHeightField_BorderSample(field, segment + 1, &columns[1], &rows[1]);
    const vtVec3 a = vtHeightField_Corner(field, columns[0], rows[0]);
    const vtVec3 b = vtHeightField_Corner(field, columns[1], rows[1]);
    const vtVec3 normal = {(float)(rows[1] - rows[0]), (float)(columns[0] - columns[1]), 0.0f};
    const vtVec3 footA = {a.x, a.y, field->back}, footB = {b.x, b.y, field->back};
    return (number & 1) == 0 ? flatTriangle(footA, footB, b, normal) : flatTriangle(footA, b, a, normal);
}

static vtReliefTriangle backTriangle(const vtHeightField* field, uint32_t number)
{
    const vtVec3 far = vtHeightField_Corner(field, field->width - 1, field->height - 1);
    const vtVec3 a = {field->left, field->bottom, field->back}, b = {far.x, far.y, field->back};
    const vtVec3 up = {a.x, b.y, a.z}, right = {b.x, a.y, a.z}, normal = {0.0f, 0.0f, -1.0f};
    return number == 0 ? flatTriangle(a, up, b, normal) : flatTriangle(a, b, right, normal);
}

vtReliefTriangle vtHeightField_Triangle(const vtHeightField* field, uint32_t number)
{
    const uint32_t wall = vtHeightField_FirstWall(field), back = vtHeightField_FirstBack(field);
    assert(number < back + 2);
    return number < wall   ? frontTriangle(field, number)
           : number < back ? wallTriangle(field, number - wall)
                           : backTriangle(field, number - back);
}

bool vtHeightField_Contains(const vtHeightField* field, vtVec3 point)
{
    const float x = (point.x - field->left) / field->cell, y = (point.y - field->bottom) / field->cell;
    if (!(x >= 0.0f && y >= 0.0f && x <= (float)(field->width - 1) && y <= (float)(field->height - 1) &&
          point.z >= field->back)) {
        return false;
    }
    const int column = clampInt((int)x, 0, field->width - 2), row = clampInt((int)y, 0, field->height - 2);
    const float u = x - (float)column, v = y - (float)row;
    const float corner = vtHeightField_Z(field, column, row);
    const float opposite = vtHeightField_Z(field, column + 1, row + 1);
    const float z =
        u >= v ? vtHeightField_Z(field, column + 1, row) : vtHeightField_Z(field, column, row + 1);
    const float most = fmaxf(u, v), least = fminf(u, v);
    return point.z <= corner + (most - least) * (z - corner) + least * (opposite - corner);
}

double vtHeightField_Volume(const vtHeightField* field)
{
    double sum = 0.0;
    for (int row = 0; row + 1 < field->height; ++row) {
        for (int column = 0; column + 1 < field->width; ++column) {
            // Each triangle's mean height above the back.
            const double twice = 2.0 * (double)(vtHeightField_Z(field, column, row) +
                                                vtHeightField_Z(field, column + 1, row + 1));
            sum += (twice + (double)vtHeightField_Z(field, column + 1, row) +
                    (double)vtHeightField_Z(field, column, row + 1)) /
                       6.0 -
                   (double)field->back;
        }
    }
    return sum * (double)field->cell * (double)field->cell;
}

size_t vtHeightField_Bytes(const vtHeightField* field)
{
    return sizeof *field + (size_t)field->width * (size_t)field->height * sizeof *field->z +
           field->starts[field->levelCount + 1] * sizeof *field->ranges;
}
