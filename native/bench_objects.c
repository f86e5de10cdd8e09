// Sweeps over objects: copies of what a scene has, which share its meshes.
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "bench.h"
#include "scene/camera.h"

// Cells of the grid, from the middle outwards.
enum { side = 4 };
static const int cells[vt_maxCopies][2] = {{1, 1}, {2, 1}, {1, 2}, {2, 2}, {0, 1}, {3, 1}, {0, 2}, {3, 2},
                                           {0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 3}, {1, 3}, {2, 3}, {3, 3}};

/// How far the scene's box reaches along the view, from the eye.
static void measureDepth(const vtScene* scene, const vtCameraFrame* camera, float* near, float* far)
{
    vtVec3 low, high;
    vtScene_Bounds(scene, &low, &high);
    *near = FLT_MAX;
    *far = -FLT_MAX;
    for (int corner = 0; corner < 8; ++corner) {
        const vtVec3 p = {corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                          corner & 4 ? high.z : low.z};
        const float depth = vtDot(vtSub(p, camera->eye), camera->forward);
        *near = fminf(*near, depth);
        *far = fmaxf(*far, depth);
    }
}

vtResult vtCreateCopies(const vtScene* scene, const vtView* view, vtSweep sweep, vtCopies* copies,
                        vtError* error)
{
    const float halfSide =
        vtLength(vtSub(view->target, view->eye)) * tanf(0.5f * view->fovY * VT_PI / 180.0f);
    *copies = (vtCopies){.objectCount = scene->objectCount,
                         .view = vtView_Zoom(*view, side),
                         .spacing = 2.0f * halfSide,
                         .sweep = sweep};
    const vtCameraFrame camera = vtMakeCameraFrame(&copies->view);
    float near, far;
    measureDepth(scene, &camera, &near, &far);
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

/// The factor of a copy's coordinates, and what is added to them.
static float placeCopy(const vtCopies* copies, int index, vtVec3* offset)
{
    const vtCameraFrame camera = vtMakeCameraFrame(&copies->view);
    if (copies->sweep == vt_sweepDepth) {
        const float scale = powf(copies->growth, (float)index);
        *offset = vtScale(camera.eye, 1.0f - scale);
        return scale;
    }
    const float across = copies->spacing * ((float)cells[index][0] - 0.5f * (side - 1));
    const float up = copies->spacing * ((float)cells[index][1] - 0.5f * (side - 1));
    *offset = vtAdd(vtScale(camera.right, across), vtScale(camera.up, up));
    return 1.0f;
}

vtResult vtCopies_Place(const vtCopies* copies, int count, vtScene* scene, vtError* error)
{
    const size_t each = copies->objectCount;
    vtObject* objects = realloc(scene->objects, (size_t)count * each * sizeof *objects);
    if (objects == NULL) {
        return vtFail(error, vt_errorMemory, "bench: out of memory for %d copies", count);
    }
    scene->objects = objects;
    scene->objectCount = (uint32_t)((size_t)count * each);
    for (int copy = 0; copy < count; ++copy) {
        vtVec3 offset;
        const float scale = placeCopy(copies, copy, &offset);
        const float offsets[3] = {offset.x, offset.y, offset.z};
        for (size_t i = 0; i < each; ++i) {
            vtObject* object = &objects[(size_t)copy * each + i];
            *object = copies->objects[i];
            for (int row = 0; row < 3; ++row) {
                for (int column = 0; column < 4; ++column) {
                    object->toWorld.rows[row][column] *= scale;
                }
                object->toWorld.rows[row][3] += offsets[row];
            }
        }
    }
    return vt_ok;
}
