#include "scene/camera.h"

#include <float.h>

#include "base/error.h"
#include "base/math.h"
#include "scene/boxes.h"
#include "scene/objects.h"

// How far the default view looks down, and round to the right; that of the truth images.
static const vtVec3 defaultDirection = {0.1167f, 0.0972f, 0.9884f};

/// In double: of squares of lengths floats hold only those between 1e-19 and 1e19.
static vtVec3 directionTo(vtVec3 from, vtVec3 to)
{
    const double x = (double)to.x - (double)from.x, y = (double)to.y - (double)from.y,
                 z = (double)to.z - (double)from.z, length = sqrt(x * x + y * y + z * z);
    const double scale = length > 0.0 ? 1.0 / length : 0.0;
    return (vtVec3){(float)(x * scale), (float)(y * scale), (float)(z * scale)};
}

vtCamera vtMakeViewCamera(const vtView* view)
{
    vtVec3 forward = directionTo(view->eye, view->target);
    vtVec3 worldUp = {0.0f, 1.0f, 0.0f};
    // Looking straight up or down leaves the roll open: let -Z be up then, as on a map.
    if (fabsf(forward.y) > 0.99999f) {
        worldUp = (vtVec3){0.0f, 0.0f, forward.y < 0.0f ? -1.0f : 1.0f};
    }
    vtVec3 right = vtNormalize(vtCross(forward, worldUp));
    return (vtCamera){.eye = view->eye, .right = right, .up = vtCross(right, forward), .forward = forward};
}

static bool areFinite(const float* matrix)
{
    bool finite = true;
    for (int i = 0; i < 16; ++i) {
        finite = finite && isfinite(matrix[i]);
    }
    return finite;
}

/// Rows of unit length, at right angles, right-handed.
static bool isRigid(const float* m)
{
    const vtVec3 x = {m[0], m[4], m[8]}, y = {m[1], m[5], m[9]}, z = {m[2], m[6], m[10]};
    const float tolerance = 1e-3f;
    return fabsf(vtDot(x, x) - 1.0f) < tolerance && fabsf(vtDot(y, y) - 1.0f) < tolerance &&
           vtLength(vtSub(vtCross(x, y), z)) < tolerance &&
           fabsf(m[3]) + fabsf(m[7]) + fabsf(m[11]) < tolerance && fabsf(m[15] - 1.0f) < tolerance;
}

static bool isOrthographic(const float* projection)
{
    return projection[11] == 0.0f;
}

static bool isProjection(const float* p)
{
    const float w = isOrthographic(p) ? 1.0f : 0.0f;
    const float* other = w == 1.0f ? p + 8 : p + 12; // where the other kind has its shift
    const float skew = fabsf(p[1]) + fabsf(p[4]) + fabsf(p[2]) + fabsf(p[6]) + fabsf(p[3]) + fabsf(p[7]) +
                       fabsf(other[0]) + fabsf(other[1]);
    return skew == 0.0f && p[0] > 0.0f && p[5] > 0.0f && p[15] == w && (w == 1.0f || p[11] == -1.0f) &&
           p[14 - 4 * (int)w] != 0.0f;
}

vtResult vtCheckMatrices(const vtFrame* frame, vtError* error)
{
    const float *view = frame->viewMatrix, *projection = frame->projectionMatrix;
    if (!VT_WITH_HOST) {
        return vt_ok;
    }
    if ((view == NULL) != (projection == NULL)) {
        return vtFail(error, vt_errorArgument,
                      "the view matrix is %s and the projection matrix %s; give both or none",
                      view != NULL ? "given" : "NULL", projection != NULL ? "given" : "NULL");
    }
    if (view == NULL) {
        return vt_ok;
    }
    if (!areFinite(view) || !isRigid(view)) {
        return vtFail(error, vt_errorArgument,
                      "the view matrix is no rotation and shift; leave scales to the objects' transforms");
    }
    if (!areFinite(projection) || !isProjection(projection)) {
        return vtFail(error, vt_errorArgument,
                      "the projection matrix is neither a perspective nor an orthographic one, column-major, "
                      "that looks "
                      "along -z");
    }
    return vt_ok;
}

/// Depth of a z of clip coordinates over w.
static float depthOf(const vtCamera* camera, float z)
{
    return camera->orthographic ? (camera->clip[1] - z) / camera->clip[0]
                                : camera->clip[1] / (z + camera->clip[0]);
}

/// Eye coordinates look along -z, ours along their depth.
static vtCamera cameraOfMatrices(const float* m, const float* p)
{
    vtCamera camera = {.right = {m[0], m[4], m[8]},
                       .up = {m[1], m[5], m[9]},
                       .forward = {-m[2], -m[6], -m[10]},
                       .orthographic = isOrthographic(p),
                       .clip = {p[10], p[14]}};
    camera.eye = vtScale(camera.right, -m[12]);
    camera.eye = vtMulAdd(camera.eye, -m[13], camera.up);
    camera.eye = vtMulAdd(camera.eye, m[14], camera.forward);
    for (int axis = 0; axis < 2; ++axis) {
        const float scale = p[5 * axis], shift = camera.orthographic ? -p[12 + axis] : p[8 + axis];
        camera.low[axis] = (-1.0f + shift) / scale;
        camera.high[axis] = (1.0f + shift) / scale;
    }
    const float a = depthOf(&camera, 1.0f), b = depthOf(&camera, -1.0f), farther = fmaxf(a, b);
    camera.farthest = farther > 0.0f && farther < 3e38f ? farther : 3e38f;
    return camera;
}

vtCamera vtMakeCamera(const vtFrame* frame)
{
    if (VT_WITH_HOST && frame->viewMatrix != NULL) {
        return cameraOfMatrices(frame->viewMatrix, frame->projectionMatrix);
    }
    const float aspect = (float)frame->width / (float)frame->height;
    const float tangent = tanf(frame->view.fovY * VT_PI / 360.0f);
    vtCamera camera = vtMakeViewCamera(&frame->view);
    const float half = frame->orthographicHeight > 0.0f ? 0.5f * frame->orthographicHeight : tangent;
    camera.orthographic = frame->orthographicHeight > 0.0f;
    camera.low[0] = -half * aspect;
    camera.low[1] = -half;
    camera.high[0] = half * aspect;
    camera.high[1] = half;
    camera.clip[0] = -1.0f; // no plane is given, and nothing is far
    camera.clip[1] = -1.0f;
    camera.farthest = 3e38f;
    return camera;
}

void vtCamera_Enter(vtCamera* camera, const vtSpace* space)
{
    const float unit = space->unit;
    camera->eye = vtSpace_Enter(space, camera->eye);
    camera->farthest *= camera->farthest < 3e38f ? unit : 1.0f;
    for (int axis = 0; axis < 2 && camera->orthographic; ++axis) {
        camera->low[axis] *= unit;
        camera->high[axis] *= unit;
    }
    if (camera->orthographic) { // clip coordinates stay as they are
        camera->clip[0] /= unit;
    } else {
        camera->clip[1] *= unit;
    }
}

void vtPixelSample(int index, float* x, float* y)
{
    // The sequence's steps 1 / g and 1 / g^2, g^3 = g + 1, as parts of 2^32: adding wraps round by itself.
    const uint32_t stepX = 3242174889u, stepY = 2447445414u;
    *x = (float)(((uint32_t)index * stepX + 0x80000000u) >> 8) * 0x1p-24f - 0.5f;
    *y = (float)(((uint32_t)index * stepY + 0x80000000u) >> 8) * 0x1p-24f - 0.5f;
}

static vtVec3 boxCorner(vtVec3 low, vtVec3 high, int corner)
{
    return (vtVec3){corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z};
}

static vtVec3 toCamera(const vtCamera* camera, vtVec3 point)
{
    vtVec3 offset = vtSub(point, camera->eye);
    return (vtVec3){vtDot(offset, camera->right), vtDot(offset, camera->up), vtDot(offset, camera->forward)};
}

static void fitDepthRange(const vtCamera* camera, vtVec3 low, vtVec3 high, vtFrustum* frustum)
{
    float nearest = FLT_MAX, farthest = -FLT_MAX;
    for (int corner = 0; corner < 8; ++corner) {
        float depth = toCamera(camera, boxCorner(low, high, corner)).z;
        nearest = fminf(nearest, depth);
        farthest = fmaxf(farthest, depth);
    }
    // One part in a thousand of the extent keeps the outermost surfaces inside the range, and the near
    // plane in front of an eye that stands inside the box.
    float extent = fmaxf(vtLength(vtSub(high, low)), FLT_MIN * 1e6f);
    float margin = 1e-3f * extent;
    frustum->near = fmaxf(nearest - margin, margin);
    frustum->far = fmaxf(farthest + margin, frustum->near + margin);
}

vtFrustum vtMakePictureFrustum(const vtCamera* camera, vtVec3 boundsMin, vtVec3 boundsMax)
{
    vtFrustum frustum = {camera->low[0], camera->low[1], camera->high[0], camera->high[1], 0.0f, 0.0f};
    fitDepthRange(camera, boundsMin, boundsMax, &frustum);
    return frustum;
}

vtFrustum vtMakeLayerFrustum(const vtCamera* camera, vtVec3 boundsMin, vtVec3 boundsMax)
{
    vtFrustum frustum = {FLT_MAX, FLT_MAX, -FLT_MAX, -FLT_MAX, 0.0f, 0.0f};
    fitDepthRange(camera, boundsMin, boundsMax, &frustum);

    for (int corner = 0; corner < 8; ++corner) {
        vtVec3 point = toCamera(camera, boxCorner(boundsMin, boundsMax, corner));
        // A corner at or behind the near plane projects nowhere useful: it opens that side fully.
        float depth = fmaxf(point.z, frustum.near);
        float x = point.x / depth, y = point.y / depth;
        frustum.left = fminf(frustum.left, x);
        frustum.right = fmaxf(frustum.right, x);
        frustum.bottom = fminf(frustum.bottom, y);
        frustum.top = fmaxf(frustum.top, y);
    }

    // A border of 1 % leaves whole texels of background around the silhouette.
    float borderX = 0.01f * (frustum.right - frustum.left) + 1e-6f;
    float borderY = 0.01f * (frustum.top - frustum.bottom) + 1e-6f;
    frustum.left = vtClamp(frustum.left - borderX, -VT_MAX_LAYER_TANGENT, VT_MAX_LAYER_TANGENT - borderX);
    frustum.right = vtClamp(frustum.right + borderX, frustum.left + borderX, VT_MAX_LAYER_TANGENT);
    frustum.bottom = vtClamp(frustum.bottom - borderY, -VT_MAX_LAYER_TANGENT, VT_MAX_LAYER_TANGENT - borderY);
    frustum.top = vtClamp(frustum.top + borderY, frustum.bottom + borderY, VT_MAX_LAYER_TANGENT);
    return frustum;
}

/// How far along `direction` from the centre an eye must stand so that the vertices, of a relief its box's
/// corners, lie inside 90 % of the frame.
static float distanceToShow(const vtMesh* mesh, const vtTransform* toWorld, vtVec3 centre,
                            const vtCamera* camera, float tangentX, float tangentY)
{
    const vtVec3 low = mesh->boundsMin, high = mesh->boundsMax;
    const bool isRelief = mesh->heights != NULL;
    float distance = 0.0f;
    for (uint32_t i = 0; i < (isRelief ? 8 : mesh->indexCount); ++i) {
        const vtVec3 corner = {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z};
        const vtVec3 p = isRelief ? corner : vtMakeVec3(mesh->positions + 3 * (size_t)mesh->indices[i]);
        const vtVec3 offset = vtSub(vtTransformPoint(toWorld, p), centre);
        const float x = fabsf(vtDot(offset, camera->right)), y = fabsf(vtDot(offset, camera->up));
        distance = fmaxf(distance, fmaxf(x / tangentX, y / tangentY) - vtDot(offset, camera->forward));
    }
    return distance;
}

/// An opaque object that is no part of what is looked at: a floor, a wall, a room.
static bool isBackdrop(const vtScene* scene, const vtObject* object, vtVec3 glassLow, vtVec3 glassHigh)
{
    const vtMesh* mesh = &scene->meshes[object->mesh];
    const vtVec3 size = vtSub(mesh->boundsMax, mesh->boundsMin);
    const float(*r)[4] = object->toWorld.rows;
    const float x = size.x * vtLength((vtVec3){r[0][0], r[1][0], r[2][0]}),
                y = size.y * vtLength((vtVec3){r[0][1], r[1][1], r[2][1]}),
                z = size.z * vtLength((vtVec3){r[0][2], r[1][2], r[2][2]});
    const float diagonal = vtLength((vtVec3){x, y, z}), glass = vtLength(vtSub(glassHigh, glassLow));
    const bool isFlat = fminf(x, fminf(y, z)) < 0.02f * diagonal;
    vtVec3 low, high;
    vtBoundBox(&object->toWorld, mesh->boundsMin, mesh->boundsMax, &low, &high);
    const bool isAround = low.x <= glassLow.x && low.y <= glassLow.y && low.z <= glassLow.z &&
                          high.x >= glassHigh.x && high.y >= glassHigh.y && high.z >= glassHigh.z;
    return diagonal > glass * (isFlat ? 1.0f : isAround ? 6.0f : 16.0f);
}

vtView vtViewOfScene(const vtScene* scene, float fovY, float aspect)
{
    vtVec3 glassLow, glassHigh;
    vtScene_Bounds(scene, &glassLow, &glassHigh);
    vtVec3 low = glassLow, high = glassHigh;
    const bool anyGlass = scene != NULL && vtScene_HasGlass(scene);
    const uint32_t count = scene != NULL ? scene->objectCount : 0;
    for (uint32_t i = 0; i < count; ++i) {
        const vtObject* object = vtScene_Object(scene, i);
        vtVec3 a, b;
        if (object != NULL && !isBackdrop(scene, object, glassLow, glassHigh)) {
            const vtMesh* mesh = &scene->meshes[object->mesh];
            vtBoundBox(&object->toWorld, mesh->boundsMin, mesh->boundsMax, &a, &b);
            low = (vtVec3){fminf(low.x, a.x), fminf(low.y, a.y), fminf(low.z, a.z)};
            high = (vtVec3){fmaxf(high.x, b.x), fmaxf(high.y, b.y), fmaxf(high.z, b.z)};
        }
    }
    const vtVec3 centre = vtScale(vtAdd(low, high), 0.5f), direction = vtNormalize(defaultDirection);
    vtView view = {direction, {0.0f, 0.0f, 0.0f}, fovY}; // far from the origin a unit is nothing
    const vtCamera camera = vtMakeViewCamera(&view);
    view.target = centre;
    const float tangentY = 0.9f * tanf(view.fovY * VT_PI / 360.0f), tangentX = tangentY * aspect;
    float distance = 0.0f;
    for (uint32_t i = 0; i < count; ++i) {
        const vtObject* object = vtScene_Object(scene, i);
        if (object != NULL && (!anyGlass || !scene->materials[object->material].opaque ||
                               !isBackdrop(scene, object, glassLow, glassHigh))) {
            distance = fmaxf(distance, distanceToShow(&scene->meshes[object->mesh], &object->toWorld, centre,
                                                      &camera, tangentX, tangentY));
        }
    }
    view.eye = vtMulAdd(centre, distance > 0.0f ? distance : 1.0f, direction);
    return view;
}

vtView vtJoinViews(const vtView* views, int count, float aspect)
{
    vtView joined = views[0];
    const vtCamera camera = vtMakeViewCamera(&joined);
    const float tangentY = 0.9f * tanf(joined.fovY * VT_PI / 360.0f), tangentX = tangentY * aspect;
    vtVec3 low = joined.target, high = low;
    for (int i = 1; i < count; ++i) {
        const vtVec3 p = views[i].target;
        low = (vtVec3){fminf(low.x, p.x), fminf(low.y, p.y), fminf(low.z, p.z)};
        high = (vtVec3){fmaxf(high.x, p.x), fmaxf(high.y, p.y), fmaxf(high.z, p.z)};
    }
    joined.target = vtScale(vtAdd(low, high), 0.5f);
    float distance = 0.0f;
    for (int i = 0; i < count; ++i) { // what is in a view's frame is beside its target by so much more here
        const vtVec3 beside = vtSub(views[i].target, joined.target);
        const float x = fabsf(vtDot(beside, camera.right)), y = fabsf(vtDot(beside, camera.up));
        distance = fmaxf(distance, vtLength(vtSub(views[i].eye, views[i].target)) +
                                       fmaxf(x / tangentX, y / tangentY) - vtDot(beside, camera.forward));
    }
    joined.eye = vtMulAdd(joined.target, -distance, camera.forward);
    return joined;
}

vtView vtViewOfMesh(const vtMesh* mesh, float fovY, float aspect)
{
    vtBorrowedMesh borrowed;
    return mesh == NULL ? vtViewOfScene(NULL, fovY, aspect)
                        : vtViewOfScene(vtBorrowMesh(mesh, &borrowed), fovY, aspect);
}

vtView vtView_Orbit(vtView view, float yaw, float pitch)
{
    vtVec3 offset = vtSub(view.eye, view.target);
    float radius = vtLength(offset);
    if (radius <= 0.0f) {
        return view;
    }
    const float steepest = 0.49f * VT_PI;
    float azimuth = atan2f(offset.x, offset.z) + yaw;
    float elevation = vtClamp(asinf(vtClamp(offset.y / radius, -1.0f, 1.0f)) + pitch, -steepest, steepest);
    vtVec3 direction = {cosf(elevation) * sinf(azimuth), sinf(elevation), cosf(elevation) * cosf(azimuth)};
    view.eye = vtMulAdd(view.target, radius, direction);
    return view;
}

vtView vtView_Zoom(vtView view, float factor)
{
    view.eye = vtMulAdd(view.target, factor, vtSub(view.eye, view.target));
    return view;
}
