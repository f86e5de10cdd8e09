// See height_trace.c for what this is based on.
#include "relief/height_walk.h"

#include <math.h>
#include <string.h>

/// A cell and the ray over it: it comes in through one edge and goes out through another.
typedef struct Crossing {
    int column, row;
    float in, out;
    bool inX, outX; ///< through an edge between columns
} Crossing;

// ---------------------------------------------------------------------------------------------- triangles

/// Where the ray comes over the cell and leaves it, as far as rounding may move that.
static float firstOverCell(const vtHeightRay* ray, const Crossing* crossing)
{
    const float x = ((float)(crossing->column + 1 - ray->forwardX) - ray->x) * ray->inverseX;
    const float y = ((float)(crossing->row + 1 - ray->forwardY) - ray->y) * ray->inverseY;
    return vtGreater(x - ray->slackX, y - ray->slackY);
}

static float lastOverCell(const vtHeightRay* ray, const Crossing* crossing)
{
    const float x = ((float)(crossing->column + ray->forwardX) - ray->x) * ray->inverseX;
    const float y = ((float)(crossing->row + ray->forwardY) - ray->y) * ray->inverseY;
    return vtLesser(x + ray->slackX, y + ray->slackY);
}

/// Takes the surface of one of the cell's triangles, which the ray crosses over the cell between two
/// distances. False where it is not one that is asked for.
static bool meetTriangle(const vtHeightField* field, const vtHeightRay* ray, const Crossing* crossing,
                         bool above, bool entering, float from, float to, vtHeightHit* hit)
{
    if ((ray->sides & (entering ? 1 : 2)) == 0) {
        return false;
    }
    const int width = field->width;
    const float* z = field->z + (size_t)width * (size_t)crossing->row + (size_t)crossing->column;
    const float* across = z + above * width; // the triangle's edges along x and along y
    const float* up = z + !above;
    const float slopeX = across[1] - across[0], slopeY = up[width] - up[0];
    // From a point near the surface, along a steep ray edges may be far off; the same one whatever limits the
    // ray has, so that it is met at the same distance.
    const float base = vtWithin(crossing->in, ray->boxFirst, ray->boxLast);
    const float x = vtHeightRay_X(ray, base) - (float)crossing->column;
    const float y = vtHeightRay_Y(ray, base) - (float)crossing->row;
    const float height = vtHeightRay_Z(ray, base) - (z[0] + slopeX * x + slopeY * y);
    const float t =
        vtWithin(vtWithin(base - height / (ray->dz - slopeX * ray->dx - slopeY * ray->dy), from, to),
                 firstOverCell(ray, crossing), lastOverCell(ray, crossing));
    if (!(t > ray->near && t < ray->far)) {
        return false;
    }
    const float u = vtWithin(vtHeightRay_X(ray, t) - (float)crossing->column, 0.0f, 1.0f);
    const float v = vtWithin(vtHeightRay_Y(ray, t) - (float)crossing->row, 0.0f, 1.0f);
    const float both = vtLesser(u, v), one = vtGreater(u, v) - both;
    const uint32_t cell = (uint32_t)crossing->row * (uint32_t)(width - 1) + (uint32_t)crossing->column;
    *hit = (vtHeightHit){t, 2 * cell + above, above ? both : one, above ? one : both};
    return true;
}

/// Whether the ray passes above the cell's diagonal, and where.
static bool passesDiagonal(const float* z, int width, const vtHeightRay* ray, const Crossing* crossing,
                           float* at)
{
    const float t = ((float)(crossing->column - crossing->row) - (ray->x - ray->y)) * ray->inverseDiagonal;
    *at = vtWithin(t, crossing->in, crossing->out);
    const float height = vtEdgeHeight(z[0], z[width + 1], vtHeightRay_X(ray, *at) - (float)crossing->column);
    return vtHeightRay_Z(ray, *at) > height;
}

/// Tests the cell's triangles by whether the ray passes above or below their edges. Neighbours compute that
/// of their common edge from the same numbers, so no ray slips through between them.
static inline bool meetCell(const vtHeightField* field, const vtHeightRay* ray, const Crossing* crossing,
                            vtHeightHit* hit)
{
    const int width = field->width;
    const float* z = field->z + (size_t)width * (size_t)crossing->row + (size_t)crossing->column;
    const float* in = crossing->inX ? z + 1 - ray->forwardX : z + (1 - ray->forwardY) * width;
    const float* out = crossing->outX ? z + ray->forwardX : z + ray->forwardY * width;
    const float inAt = crossing->inX ? vtHeightRay_Y(ray, crossing->in) - (float)crossing->row
                                     : vtHeightRay_X(ray, crossing->in) - (float)crossing->column;
    const float outAt = crossing->outX ? vtHeightRay_Y(ray, crossing->out) - (float)crossing->row
                                       : vtHeightRay_X(ray, crossing->out) - (float)crossing->column;
    const bool inside =
        !(vtHeightRay_Z(ray, crossing->in) > vtEdgeHeight(in[0], in[crossing->inX ? width : 1], inAt));
    const bool ends =
        !(vtHeightRay_Z(ray, crossing->out) > vtEdgeHeight(out[0], out[crossing->outX ? width : 1], outAt));
    // The triangle above the diagonal has the cell's left and upper edge.
    const bool above = crossing->inX ? ray->forwardX != 0 : ray->forwardY == 0;
    const bool endsAbove = crossing->outX ? ray->forwardX == 0 : ray->forwardY != 0;
    if (above == endsAbove) {
        return inside != ends && meetTriangle(field, ray, crossing, above, ends, -INFINITY, INFINITY, hit);
    }
    float middle;
    const bool crosses = !passesDiagonal(z, width, ray, crossing, &middle);
    const float slack = ray->slackDiagonal;
    return (inside != crosses &&
            meetTriangle(field, ray, crossing, above, crosses, -INFINITY, middle + slack, hit)) ||
           (crosses != ends &&
            meetTriangle(field, ray, crossing, endsAbove, ends, middle - slack, INFINITY, hit));
}

// -------------------------------------------------------------------------------------------------- walks

/// Whether heights in the range may meet the ray between two distances.
static inline bool mayMeet(const vtHeightRay* ray, vtHeightRange range, float from, float to)
{
    const float a = vtHeightRay_Z(ray, from), b = vtHeightRay_Z(ray, to);
    return vtLesser(a, b) - ray->margin <= range.high && vtGreater(a, b) + ray->margin >= range.low;
}

static inline vtHeightRange rangeOfCell(const vtHeightField* field, int column, int row)
{
    const float* z = field->z + (size_t)field->width * (size_t)row + (size_t)column;
    const float* next = z + field->width;
    return (vtHeightRange){vtLesser(vtLesser(z[0], z[1]), vtLesser(next[0], next[1])),
                           vtGreater(vtGreater(z[0], z[1]), vtGreater(next[0], next[1]))};
}

vtHeightWalk vtEnterCell(const vtHeightField* field, const vtHeightRay* ray, float t)
{
    const int column = (int)vtWithin(vtHeightRay_X(ray, t), 0.0f, (float)(field->width - 2));
    const int row = (int)vtWithin(vtHeightRay_Y(ray, t), 0.0f, (float)(field->height - 2));
    const float inX =
        ray->dx != 0.0f ? ((float)(column + 1 - ray->forwardX) - ray->x) * ray->inverseX : -INFINITY;
    const float inY =
        ray->dy != 0.0f ? ((float)(row + 1 - ray->forwardY) - ray->y) * ray->inverseY : -INFINITY;
    return (vtHeightWalk){inX >= inY ? inX : inY, column, row, inX >= inY, true};
}

/// The level whose tiles are half as long as what is left of the ray's shadow, or a little longer.
static int firstLevel(const vtHeightRay* ray, float from, int top)
{
    const float across = vtGreater(fabsf(ray->dx), fabsf(ray->dy));
    const float cells = vtWithin((ray->last - from) * across, 2.0f, 8192.0f);
    uint32_t bits; // of which the exponent is the logarithm
    memcpy(&bits, &cells, sizeof bits);
    const int level = (int)(bits >> 23) - 128;
    return level < top ? level : top;
}

bool vtHeightWalk_Find(vtHeightWalk* walk, const vtHeightField* field, const vtHeightRay* ray,
                       unsigned separations, vtHeightHit* hit)
{
    const int top = (separations & vt_separateTiles) != 0 ? field->levelCount : 0;
    const bool testsCells = (separations & vt_separateCells) != 0;
    const int forwardX = ray->forwardX, forwardY = ray->forwardY;
    const float last = ray->last;
    int column = walk->column, row = walk->row;
    bool crossedX = walk->crossedX;
    float t = walk->t;
    float from = vtGreater(t, ray->first);
    int level = top > 0 ? firstLevel(ray, from, top) : 0;
    for (;;) {
        const int tileX = column >> level, tileY = row >> level;
        const int edgeX = (tileX + forwardX) << level, edgeY = (tileY + forwardY) << level;
        const float outX = ((float)edgeX - ray->x) * ray->inverseX;
        const float outY = ((float)edgeY - ray->y) * ray->inverseY;
        const bool byX = outX <= outY;
        const float out = vtLesser(outX, outY);
        if (level > 0) {
            if (mayMeet(ray, vtHeightField_Tile(field, level, tileX, tileY), from, vtLesser(out, last))) {
                --level;
                continue;
            }
        } else if (!testsCells || mayMeet(ray, rangeOfCell(field, column, row), from, vtLesser(out, last))) {
            const Crossing crossing = {column, row, t, out, crossedX, byX};
            if (meetCell(field, ray, &crossing, hit)) {
                return true;
            }
        }
        if (!(out < last)) {
            break;
        }
        // On to the neighbour: across the edge to the cell that the ray is over there.
        from = t = out;
        crossedX = byX;
        const int side = (1 << level) - 1;
        const float firstX = (float)(tileX << level), firstY = (float)(tileY << level);
        const int x = (int)vtWithin(vtHeightRay_X(ray, t), firstX, firstX + (float)side);
        const int y = (int)vtWithin(vtHeightRay_Y(ray, t), firstY, firstY + (float)side);
        column = byX ? edgeX - 1 + forwardX : x;
        row = byX ? y : edgeY - 1 + forwardY;
        // Up where that begins a larger tile.
        const int next = byX ? (column >> level ^ forwardX) : (row >> level ^ forwardY);
        level += (next & 1) != 0 && level < top;
    }
    *walk = (vtHeightWalk){t, column, row, crossedX, level == 0};
    return false;
}

bool vtFindAmongAllCells(const vtHeightField* field, const vtHeightRay* ray, unsigned separations,
                         vtHeightHit* hit)
{
    const bool testsCells = (separations & vt_separateCells) != 0;
    bool found = false;
    for (int row = 0; row + 1 < field->height; ++row) {
        for (int column = 0; column + 1 < field->width; ++column) {
            const int forwardX = ray->forwardX, forwardY = ray->forwardY;
            const float inX = ((float)(column + 1 - forwardX) - ray->x) * ray->inverseX;
            const float inY = ((float)(row + 1 - forwardY) - ray->y) * ray->inverseY;
            const float outX = ((float)(column + forwardX) - ray->x) * ray->inverseX;
            const float outY = ((float)(row + forwardY) - ray->y) * ray->inverseY;
            const Crossing crossing = {
                column, row, inX >= inY ? inX : inY, outX <= outY ? outX : outY, inX >= inY, outX <= outY};
            if (!(crossing.in <= crossing.out) || crossing.in > ray->last || crossing.out < ray->first) {
                continue;
            }
            vtHeightHit here;
            if ((!testsCells || mayMeet(ray, rangeOfCell(field, column, row), crossing.in, crossing.out)) &&
                meetCell(field, ray, &crossing, &here) && (!found || here.distance < hit->distance)) {
                *hit = here;
                found = true;
            }
        }
    }
    return found;
}

bool vtFindAlongZ(const vtHeightField* field, const vtHeightRay* ray, vtHeightHit* hit)
{
    const int column = (int)vtWithin(ray->x, 0.0f, (float)(field->width - 2));
    const int row = (int)vtWithin(ray->y, 0.0f, (float)(field->height - 2));
    const bool above = ray->x - (float)column < ray->y - (float)row;
    const Crossing crossing = {column, row, -INFINITY, INFINITY, false, false};
    return meetTriangle(field, ray, &crossing, above, ray->dz < 0.0f, -INFINITY, INFINITY, hit);
}
