#include "render/uniforms.h"

#include <math.h>

#include "base/math.h"
#include "scene/camera.h"
#include "technique/technique.h"

/// Layer textures as long on their longer side as asked, in the shape of their frustum, and not smaller than
/// they are so far.
static void extendLayerSize(const vtFrame* frame, const vtFrustum* frustum, int* width, int* height)
{
    int side = frame->layerSize > 0           ? frame->layerSize
               : frame->width > frame->height ? frame->width
                                              : frame->height;
    side = side < 16 ? 16 : side > 8192 ? 8192 : side;
    float across = frustum->right - frustum->left, down = frustum->top - frustum->bottom;
    float longer = fmaxf(across, down);
    // Rounded up to sixteens: a turning object then rarely makes the textures anew.
    const int columns = ((int)ceilf((float)side * across / longer) + 15) / 16 * 16;
    const int rows = ((int)ceilf((float)side * down / longer) + 15) / 16 * 16;
    *width = columns > *width ? columns : *width;
    *height = rows > *height ? rows : *height;
}

/// The frustum of the one set of layers, if there is one, and the size of all sets.
static vtFrustum chooseLayers(const vtSceneBuffer* scene, const vtFrame* frame, const vtCamera* camera,
                              int* width, int* height)
{
    const vtLayerSpace space = vtTechnique_Row(frame->technique)->layerSpace;
    if (space == vt_layersOfPicture) {
        *width = frame->width;
        *height = frame->height;
        return vtMakePictureFrustum(camera, scene->glassMin, scene->glassMax);
    }
    *width = *height = 0;
    const vtFrustum all = vtMakeLayerFrustum(camera, scene->glassMin, scene->glassMax);
    for (uint32_t i = 0; i < scene->glassCount && space == vt_layersOfEachObject; ++i) {
        const vtPlacedObject* placed = &scene->objects[i].placed;
        const vtFrustum own = vtMakeLayerFrustum(camera, placed->low, placed->high);
        extendLayerSize(frame, &own, width, height);
    }
    if (*width == 0) {
        extendLayerSize(frame, &all, width, height);
    }
    return all;
}

static void setVec4(float* out, float x, float y, float z, float w)
{
    out[0] = x;
    out[1] = y;
    out[2] = z;
    out[3] = w;
}

static void setFrustum(float* tangents, float* depth, const vtFrustum* f)
{
    setVec4(tangents, f->left, f->bottom, f->right, f->top);
    setVec4(depth, f->near, f->far, 1.0f / (f->far - f->near), 0.0f);
}

static void setCamera(vtFrameUniforms* uniforms, const vtCamera* camera)
{
    const vtVec3 rows[3] = {camera->right, camera->up, camera->forward};
    for (int row = 0; row < 3; ++row) {
        uniforms->worldToCamera[0][row] = rows[row].x;
        uniforms->worldToCamera[1][row] = rows[row].y;
        uniforms->worldToCamera[2][row] = rows[row].z;
        uniforms->worldToCamera[3][row] = -vtDot(rows[row], camera->eye);
    }
    uniforms->worldToCamera[3][3] = 1.0f;
    setVec4(uniforms->eye, camera->eye.x, camera->eye.y, camera->eye.z, 1.0f);
    setVec4(uniforms->clip, camera->clip[0], camera->clip[1], 0.9999f * camera->farthest,
            camera->orthographic);
}

void vtMakeUniforms(const vtSceneBuffer* scene, const vtFrame* frame, const vtCamera* camera,
                    vtEnvironmentKind environment, vtFrameUniforms* uniforms)
{
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    const vtVec3 low = scene->glassMin, high = scene->glassMax;
    const vtFrustum picture = vtMakePictureFrustum(camera, scene->low, scene->high);
    int layerWidth, layerHeight;
    const vtFrustum layers = chooseLayers(scene, frame, camera, &layerWidth, &layerHeight);
    const vtVec3 extent = vtSub(high, low);
    const float wall = frame->wallThickness > 0.0f ? frame->wallThickness
                                                   : 0.06f * fmaxf(extent.x, fmaxf(extent.y, extent.z));
    const float ior = frame->ior > 0.0f ? frame->ior : scene->objects[0].material.ior;
    *uniforms = (vtFrameUniforms){
        .optics = {ior, frame->transmittance, exp2f(frame->exposure)},
        .kay = {frame->maxTransmittance, frame->minTransmittance, frame->power, wall},
        .search = {vtFrame_LayerCount(frame), frame->steps, frame->refine, frame->maxEvents},
        .size = {frame->width, frame->height, layerWidth, layerHeight},
        .scene = {(int)scene->glassCount, (int)scene->objectCount, !vtFrame_IsStrict(frame),
                  row->findsOpaque && !vtVariant_IsOrdered(vtFrame_Variant(frame, true))},
        .output = {frame->output, frame->layer, environment, frame->background},
        .host = {frame->x, frame->y, frame->linear,
                 (frame->hostColor != 0) + 2 * (frame->hostDepth != 0) + 4 * frame->hostLinear +
                     8 * frame->hostLevels + 16 * frame->hostOpaque},
    };
    setCamera(uniforms, camera);
    setFrustum(uniforms->pictureFrustum, uniforms->pictureDepth, &picture);
    setFrustum(uniforms->layerFrustum, uniforms->layerDepth, &layers);
    setVec4(uniforms->boundsMin, low.x, low.y, low.z, 0.0f);
    setVec4(uniforms->boundsMax, high.x, high.y, high.z, 0.0f);
}

static void shiftFrustum(float* tangents, float x, float y, const int32_t* size)
{
    const float dx = x * (tangents[2] - tangents[0]) / (float)size[0];
    const float dy = y * (tangents[3] - tangents[1]) / (float)size[1];
    setVec4(tangents, tangents[0] + dx, tangents[1] + dy, tangents[2] + dx, tangents[3] + dy);
}

vtFrameUniforms vtMoveUniforms(const vtFrameUniforms* frame, int sample, int count, bool movesLayers,
                               bool byChance)
{
    vtFrameUniforms uniforms = *frame;
    float x, y;
    vtPixelSample(sample, &x, &y);
    shiftFrustum(uniforms.pictureFrustum, x, y, uniforms.size);
    if (movesLayers) {
        shiftFrustum(uniforms.layerFrustum, x, y, uniforms.size + 2);
    }
    uniforms.optics[3] = (float)count;
    uniforms.sample[0] = sample;
    uniforms.sample[1] = sample > 0 && byChance;
    uniforms.eye[3] = sample == 0 ? -1.0f : vtFract(0.5f + 0.61803399f * (float)sample);
    return uniforms;
}
