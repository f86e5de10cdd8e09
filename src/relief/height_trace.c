// This work is based on:
//   Zhen-Qian Weng. Direct rendering of height fields [in Chinese: Height Field 直接 Rendering 方法]: the
//   three separations, the two triangles of a cell, the smooth normal and its differentials. F. Kenton
//   Musgrave. Grid Tracing: Fast Ray Tracing for Height Fields. 1988: from cell to cell along the shadow. Art
//   Tevs, Ivo Ihrke, Hans-Peter Seidel. Maximum Mipmaps for Fast, Accurate, and Scalable Dynamic Height Field
//   Rendering. 2008: the third separation for larger and larger tiles.
//   Tomas Moller, Ben Trumbore. Fast, Minimum Storage Ray/Triangle Intersection. 1997: t, u and v.
//   Homan Igehy. Tracing Ray Differentials. 1999: footprints.
//
// Departures:
//  - A triangle is met where the ray passes above one of its edges and below another. These heights above
//  edges are
//    Moller and Trumbore's determinants, divided by what they have in common where edges lie over a grid; u
//    and v are then the place in the cell. Neighbours compute them of their common edge alike, to the last
//    bit, and what is left out lies off the ray by more than rounding: no ray slips through, at corners
//    neither.
//  - Tiles have their lowest height beside the highest one, as rays run in the glass, too.
//  - The relief is a slab: the ray is cut to what lies over the rectangle and before the back; where it
//  begins or ends
//    there below the border's height it meets a wall. That is the height the front's cells have there.
#include "relief/height_trace.h"

#include <math.h>

#include "base/math.h"
#include "relief/height_walk.h"

/// What lies over the rectangle and in front of the back, as the ray passes it.
typedef struct Prism {
    float enter, leave;
    bool entersBack, leavesBack;
    bool entersX, leavesX; ///< else: through a side between columns, not rows
} Prism;

static const float farAway = 1e30f;

// ---------------------------------------------------------------------------------------------------- ray

/// A ray that runs along an edge between cells is put on one side of it, by the least that there is.
static float awayFromEdge(float x, float last)
{
    return x == last ? nextafterf(x, 0.0f) : x == 0.0f ? 1e-6f : x == floorf(x) ? nextafterf(x, last) : x;
}

static vtHeightRay makeRay(const vtHeightField* field, vtVec3 origin, vtVec3 direction)
{
    const float scale = 1.0f / field->cell;
    vtHeightRay ray = {.x = (origin.x - field->left) * scale,
                       .y = (origin.y - field->bottom) * scale,
                       .z = origin.z,
                       .dx = direction.x * scale,
                       .dy = direction.y * scale,
                       .dz = direction.z};
    // What changes by less than rounding over the whole relief does not change.
    const float least = 1e-10f * (fabsf(direction.x) + fabsf(direction.y) + fabsf(direction.z));
    ray.dx = fabsf(direction.x) > least ? ray.dx : 0.0f;
    ray.dy = fabsf(direction.y) > least ? ray.dy : 0.0f;
    ray.dz = fabsf(direction.z) > least ? ray.dz : 0.0f;
    ray.forwardX = ray.dx >= 0.0f;
    ray.forwardY = ray.dy >= 0.0f;
    ray.inverseX = ray.dx != 0.0f ? 1.0f / ray.dx : farAway;
    ray.inverseY = ray.dy != 0.0f ? 1.0f / ray.dy : farAway;
    ray.inverseZ = ray.dz != 0.0f ? 1.0f / ray.dz : farAway;
    ray.inverseDiagonal = ray.dx != ray.dy ? 1.0f / (ray.dx - ray.dy) : 0.0f;
    if (ray.dx == 0.0f) {
        ray.x = awayFromEdge(ray.x, (float)(field->width - 1));
    }
    if (ray.dy == 0.0f) {
        ray.y = awayFromEdge(ray.y, (float)(field->height - 1));
    }
    const float slack =
        2e-7f * (fabsf(ray.x) + fabsf(ray.y) + (float)field->width + (float)field->height); // cells
    ray.slackX = slack * fabsf(ray.inverseX);
    ray.slackY = slack * fabsf(ray.inverseY);
    ray.slackDiagonal = slack * fabsf(ray.inverseDiagonal);
    ray.margin = 1e-6f * (fabsf(origin.z) + fabsf(field->low) + fabsf(field->high));
    return ray;
}

/// False where the ray passes it by. Written without choices by direction, which no processor foresees.
static bool cutToPrism(const vtHeightField* field, const vtHeightRay* ray, Prism* prism)
{
    const int columns = field->width - 1, rows = field->height - 1;
    if ((ray->dx == 0.0f && !(ray->x >= 0.0f && ray->x <= (float)columns)) ||
        (ray->dy == 0.0f && !(ray->y >= 0.0f && ray->y <= (float)rows))) {
        return false;
    }
    const float firstX = ((float)(columns * (1 - ray->forwardX)) - ray->x) * ray->inverseX;
    const float firstY = ((float)(rows * (1 - ray->forwardY)) - ray->y) * ray->inverseY;
    const float lastX = ((float)(columns * ray->forwardX) - ray->x) * ray->inverseX;
    const float lastY = ((float)(rows * ray->forwardY) - ray->y) * ray->inverseY;
    const float back = (field->back - ray->z) * ray->inverseZ, front = (farAway - ray->z) * ray->inverseZ;
    const float firstZ = vtLesser(back, front), lastZ = vtGreater(back, front);
    const float enter = vtGreater(firstX, firstY), leave = vtLesser(lastX, lastY);
    *prism = (Prism){vtGreater(enter, firstZ), vtLesser(leave, lastZ), firstZ > enter, lastZ < leave,
                     firstX >= firstY,         lastX <= lastY};
    return prism->enter <= prism->leave;
}

// ------------------------------------------------------------------------------------------ walls and back

/// A segment of the border between two samples.
typedef struct Rim {
    uint32_t number;
    float heights[2]; ///< at its ends, counter-clockwise
    float at;         ///< where the ray passes: share of the way
    float height;     ///< there
} Rim;

/// Where the ray passes the border at `t`, into the cell or out of it. `high`: on the side of greatest column
/// or row.
static Rim findRim(const vtHeightField* field, const vtHeightRay* ray, float t, bool isX, bool high,
                   const vtHeightWalk* cell)
{
    const int across = field->width - 1, up = field->height - 1;
    const int i = isX ? cell->row : cell->column, side = !high ? 0 : isX ? across : up;
    const float at = vtWithin((isX ? vtHeightRay_Y(ray, t) : vtHeightRay_X(ray, t)) - (float)i, 0.0f, 1.0f);
    const float z0 = isX ? vtHeightField_Z(field, side, i) : vtHeightField_Z(field, i, side);
    const float z1 = isX ? vtHeightField_Z(field, side, i + 1) : vtHeightField_Z(field, i + 1, side);
    const int number = isX    ? (high ? across + i : 2 * across + 2 * up - 1 - i)
                       : high ? 2 * across + up - 1 - i
                              : i;
    Rim rim = {(uint32_t)number, {z0, z1}, at, vtEdgeHeight(z0, z1, at)};
    if (isX != high) { // counter-clockwise is towards smaller columns and rows
        rim = (Rim){rim.number, {z1, z0}, 1.0f - at, rim.height};
    }
    return rim;
}

/// The wall where the ray passes the border; false where it passes above it.
static bool meetWall(const vtHeightField* field, const vtHeightRay* ray, float t, const Rim* rim,
                     vtHeightHit* hit)
{
    const float z = vtHeightRay_Z(ray, t);
    if (z > rim->height) {
        return false;
    }
    const float foot = vtGreater(z - field->back, 0.0f);
    const float first = rim->heights[0] - field->back, second = rim->heights[1] - field->back;
    const uint32_t number = vtHeightField_FirstWall(field) + 2 * rim->number;
    const float v = foot / second;
    *hit = v <= rim->at ? (vtHeightHit){t, number, rim->at - v, v}
                        : (vtHeightHit){t, number + 1, rim->at,
                                        vtWithin((foot - rim->at * second) / first, 0.0f, 1.0f - rim->at)};
    return true;
}

static void meetBack(const vtHeightField* field, const vtHeightRay* ray, float t, vtHeightHit* hit)
{
    const float x = vtWithin(vtHeightRay_X(ray, t) / (float)(field->width - 1), 0.0f, 1.0f);
    const float y = vtWithin(vtHeightRay_Y(ray, t) / (float)(field->height - 1), 0.0f, 1.0f);
    const uint32_t number = vtHeightField_FirstBack(field);
    *hit = y >= x ? (vtHeightHit){t, number, y - x, x} : (vtHeightHit){t, number + 1, y, x - y};
}

/// The wall or the back that the ray enters the prism through, or leaves it; false where it is neither.
static bool meetOutside(const vtHeightField* field, const vtHeightRay* ray, const Prism* prism, bool entering,
                        const vtHeightWalk* cell, vtHeightHit* hit)
{
    const float t = entering ? prism->enter : prism->leave;
    if ((ray->sides & (entering ? 1 : 2)) == 0 || !(t > ray->near && t < ray->far)) {
        return false;
    }
    if (entering ? prism->entersBack : prism->leavesBack) {
        meetBack(field, ray, t, hit);
        return true;
    }
    if (vtHeightRay_Z(ray, t) > field->high + ray->margin) {
        return false;
    }
    const bool isX = entering ? prism->entersX : prism->leavesX;
    const bool high = (isX ? ray->forwardX : ray->forwardY) != entering;
    const Rim rim = findRim(field, ray, t, isX, high, cell);
    return meetWall(field, ray, t, &rim, hit);
}

// ------------------------------------------------------------------------------------------------- surface

/// Cuts to where the ray may meet the front.
static void cutToFront(const vtHeightField* field, const Prism* prism, bool box, vtHeightRay* ray)
{
    const float low = (field->low - ray->margin - ray->z) * ray->inverseZ;
    const float high = (field->high + ray->margin - ray->z) * ray->inverseZ;
    ray->boxFirst = vtGreater(prism->enter, vtLesser(low, high));
    ray->boxLast = vtLesser(prism->leave, vtGreater(low, high));
    ray->first = vtGreater(box ? ray->boxFirst : prism->enter, ray->near);
    ray->last = vtLesser(box ? ray->boxLast : prism->leave, ray->far);
}

/// The cell that the ray is over at `t`, where it comes into the prism through a side or goes out of it.
static vtHeightWalk cellAtBorder(const vtHeightField* field, const vtHeightRay* ray, float t, bool isX,
                                 bool high)
{
    vtHeightWalk cell = vtEnterCell(field, ray, t);
    cell.t = t;
    cell.crossedX = isX;
    cell.column = !isX ? cell.column : high ? field->width - 2 : 0;
    cell.row = isX ? cell.row : high ? field->height - 2 : 0;
    return cell;
}

bool vtHeightField_Trace(const vtHeightField* field, vtVec3 origin, vtVec3 direction, float near, float far,
                         int sides, unsigned separations, vtHeightHit* hit)
{
    vtHeightRay ray = makeRay(field, origin, direction);
    ray.near = near;
    ray.far = far;
    ray.sides = sides;
    Prism prism;
    if (!cutToPrism(field, &ray, &prism) || !(prism.leave > near && prism.enter < far)) {
        return false;
    }
    cutToFront(field, &prism, (separations & vt_separateBox) != 0, &ray);
    vtHeightWalk walk = {.atCell = false};
    bool isBorder = false;
    if (prism.enter > near) {
        isBorder = !prism.entersBack;
        if (isBorder) {
            walk = cellAtBorder(field, &ray, prism.enter, prism.entersX,
                                !(prism.entersX ? ray.forwardX : ray.forwardY));
        }
        if (meetOutside(field, &ray, &prism, true, &walk, hit)) {
            return true;
        }
    }
    bool walked = false;
    if (ray.first <= ray.last) {
        const bool isSteep = ray.dx == 0.0f && ray.dy == 0.0f;
        walked = !isSteep && (separations & vt_separateShadow) != 0;
        if (walked && !(isBorder && ray.first == prism.enter)) {
            walk = vtEnterCell(field, &ray, ray.first);
        }
        if (walked    ? vtHeightWalk_Find(&walk, field, &ray, separations, hit)
            : isSteep ? vtFindAlongZ(field, &ray, hit)
                      : vtFindAmongAllCells(field, &ray, separations, hit)) {
            return true;
        }
    }
    if (!prism.leavesBack && !(walked && walk.atCell && ray.last == prism.leave)) {
        walk = cellAtBorder(field, &ray, prism.leave, prism.leavesX,
                            prism.leavesX ? ray.forwardX : ray.forwardY);
    }
    return meetOutside(field, &ray, &prism, false, &walk, hit);
}
