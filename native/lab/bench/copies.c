#include "lab/bench/copies.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "scene/camera.h"

/// Copies one behind the other are seen from so much farther away: from close by, each would be far larger
/// than the one before it.
static const float depthZoom = 4.0f;

/// Of the least size at which a copy stays inside the picture, against rounding.
static const float margin = 0.999f;

static const vtVec3 noVector = {0.0f, 0.0f, 0.0f};

static vtVec3 corner(const vtCopies* copies, int index)
{
    return (vtVec3){index & 1 ? copies->high.x : copies->low.x, index & 2 ? copies->high.y : copies->low.y,
                    index & 4 ? copies->high.z : copies->low.z};
}

/// How far the copies' box reaches along the view, from the eye.
static void measureDepth(const vtCopies* copies, float* near, float* far)
{
    const vtCamera camera = vtMakeViewCamera(&copies->view);
    *near = FLT_MAX;
    *far = -FLT_MAX;
    for (int i = 0; i < 8; ++i) {
        const float depth = vtDot(vtSub(corner(copies, i), camera.eye), camera.forward);
        *near = fminf(*near, depth);
        *far = fmaxf(*far, depth);
    }
}

vtResult vtCreateCopies(const vtScene* scene, const vtView* view, float aspect, vtSweep sweep,
                        vtCopies* copies, vtError* error)
{
    const float tangent = tanf(view->fovY * VT_PI / 360.0f);
    *copies = (vtCopies){.objectCount = scene->objectCount,
                         .view = sweep == vt_sweepDepth ? vtView_Zoom(*view, depthZoom) : *view,
                         .tangentX = aspect * tangent,
                         .tangentY = tangent,
                         .sweep = sweep};
    vtScene_Bounds(scene, &copies->low, &copies->high);
    float near, far;
    measureDepth(copies, &near, &far);
    if (!(near > 0.0f)) {
        return vtFail(error, vt_errorArgument,
                      "--sweep %s needs an eye outside the model; move --camera away from it",
                      vtSweepName(sweep));
    }
    copies->growth = 1.02f * far / near;
    copies->objects = malloc(scene->objectCount * sizeof *copies->objects);
    if (copies->objects == NULL) {
        return vtFail(error, vt_errorMemory, "bench: out of memory");
    }
    memcpy(copies->objects, scene->objects, scene->objectCount * sizeof *copies->objects);
    return vt_ok;
}

void vtDestroyCopies(vtCopies* copies)
{
    free(copies->objects);
    *copies = (vtCopies){0};
}

int vtCopies_Count(const vtCopies* copies, int index)
{
    static const int objects[] = {1, 4, 16, 64, 250, 1000, 0}, depth[] = {1, 2, 4, 8, 16, 0};
    const int count = copies->sweep == vt_sweepDepth ? depth[index] : objects[index];
    return (size_t)count * copies->objectCount <= VT_MAX_OBJECTS ? count : 0;
}

/// Columns and rows of the square grid.
static int gridSide(int count)
{
    int side = 1;
    while (side * side < count) {
        ++side;
    }
    return side;
}

/// The middle of a copy's place, from the middle of the grid, where a copy is as large as one alone.
static void findCell(const vtCopies* copies, int index, int side, float* across, float* up)
{
    const float tangent = fminf(copies->tangentX, copies->tangentY);
    const float spacing = 2.0f * tangent * vtLength(vtSub(copies->view.target, copies->view.eye));
    *across = spacing * ((float)(index % side) - 0.5f * (float)(side - 1));
    *up = spacing * (0.5f * (float)(side - 1) - (float)(index / side));
}

/// The factor about the view's target at which the corners of all copies' boxes lie inside the picture.
static float fitGrid(const vtCopies* copies, int count, int side)
{
    const vtCamera camera = vtMakeViewCamera(&copies->view);
    const float distance = vtLength(vtSub(copies->view.target, copies->view.eye));
    float scale = 1.0f / (float)side;
    for (int copy = 0; copy < count; ++copy) {
        float across, up;
        findCell(copies, copy, side, &across, &up);
        for (int i = 0; i < 8; ++i) {
            const vtVec3 p = vtSub(corner(copies, i), copies->view.target);
            const float x = fabsf(vtDot(p, camera.right) + across), y = fabsf(vtDot(p, camera.up) + up);
            const float near = -vtDot(p, camera.forward); // towards the eye
            // Scaled by s a point is inside where s x <= tangent (distance - s near).
            const float reachX = x + copies->tangentX * near, reachY = y + copies->tangentY * near;
            if (reachX * scale > copies->tangentX * distance) {
                scale = margin * copies->tangentX * distance / reachX;
            }
            if (reachY * scale > copies->tangentY * distance) {
                scale = margin * copies->tangentY * distance / reachY;
            }
        }
    }
    return scale;
}

static void moveObject(vtObject* object, float scale, vtVec3 offset)
{
    const float offsets[3] = {offset.x, offset.y, offset.z};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            object->toWorld.rows[row][column] *= scale;
        }
        object->toWorld.rows[row][3] += offsets[row];
    }
}

vtResult vtCopies_Place(const vtCopies* copies, int count, vtScene* scene, vtError* error)
{
    const size_t each = copies->objectCount;
    vtObject* objects = vtReallocate(scene->objects, (size_t)count * each, sizeof *objects);
    if (objects == NULL) {
        return vtFail(error, vt_errorMemory, "bench: out of memory for %d copies", count);
    }
    scene->objects = objects;
    scene->objectCount = (uint32_t)((size_t)count * each);
    const vtCamera camera = vtMakeViewCamera(&copies->view);
    const int side = gridSide(count);
    const float fitted = fitGrid(copies, count, side);
    for (int copy = 0; copy < count; ++copy) {
        float scale = fitted, across, up;
        vtVec3 fixed = copies->view.target, offset = noVector;
        if (copies->sweep == vt_sweepDepth) {
            scale = powf(copies->growth, (float)copy);
            fixed = camera.eye;
        } else {
            findCell(copies, copy, side, &across, &up);
            offset = vtAdd(vtScale(camera.right, scale * across), vtScale(camera.up, scale * up));
        }
        for (size_t i = 0; i < each; ++i) {
            vtObject* object = &objects[(size_t)copy * each + i];
            *object = copies->objects[i];
            moveObject(object, scale, vtAdd(offset, vtScale(fixed, 1.0f - scale)));
        }
    }
    return vt_ok;
}
