#include "layout.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "scene/camera.h"
#include "technique.h"

/// A mesh's coordinates to its cube's, 0 to 1, with a border of whole texels around the mesh. Extents are
/// those of the mesh along the cube's axes.
static void fitCube(const vtCubeFrame* cube, int size, float rows[4][4], float* extents)
{
    const float border = 2.5f / (float)size;
    const float low[3] = {cube->low.x, cube->low.y, cube->low.z};
    const float high[3] = {cube->high.x, cube->high.y, cube->high.z};
    const float diagonal = vtLength(vtSub(cube->high, cube->low));
    for (int axis = 0; axis < 3; ++axis) {
        // A flat mesh has thickness all the same.
        const float extent = fmaxf(high[axis] - low[axis], 1e-4f * diagonal);
        const float scale = (1.0f - 2.0f * border) / extent;
        rows[axis][0] = scale * cube->axes[axis].x;
        rows[axis][1] = scale * cube->axes[axis].y;
        rows[axis][2] = scale * cube->axes[axis].z;
        rows[axis][3] = border - scale * low[axis];
        extents[axis] = extent;
    }
    rows[3][0] = rows[3][1] = rows[3][2] = 0.0f;
    rows[3][3] = 1.0f;
}

/// World coordinates to those of a frustum, 0 to 1: depth first, as a cube's first axis has it.
static void fitFrustum(const vtView* view, const vtFrustum* f, float rows[4][4])
{
    const vtCameraFrame camera = vtMakeCameraFrame(view);
    const vtVec3 axes[3] = {camera.right, camera.up, camera.forward};
    float camera4[3][4];
    for (int row = 0; row < 3; ++row) {
        camera4[row][0] = axes[row].x;
        camera4[row][1] = axes[row].y;
        camera4[row][2] = axes[row].z;
        camera4[row][3] = -vtDot(axes[row], camera.eye);
    }
    const float across = 1.0f / (f->right - f->left), up = 1.0f / (f->top - f->bottom);
    const float depth = f->far / (f->far - f->near);
    for (int column = 0; column < 4; ++column) {
        const float x = camera4[0][column], y = camera4[1][column], z = camera4[2][column];
        rows[0][column] = depth * (z - (column == 3 ? f->near : 0.0f));
        rows[1][column] = across * (x - f->left * z);
        rows[2][column] = up * (y - f->bottom * z);
        rows[3][column] = z;
    }
}

/// out = rows * transform
static void multiply(float rows[4][4], const vtTransform* transform, float out[4][4])
{
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            float sum = column == 3 ? rows[row][3] : 0.0f;
            for (int k = 0; k < 3; ++k) {
                sum += rows[row][k] * transform->rows[k][column];
            }
            out[row][column] = sum;
        }
    }
}

static void writeNumbers(uint32_t* words, int part, float x, float y, float z, float w)
{
    const float numbers[4] = {x, y, z, w};
    memcpy(words + 4 * part, numbers, sizeof numbers);
}

/// `share`: of its diagonal, by which its box is wider.
static void writeObject(const vtSceneBuffer* scene, const vtObjectBuffer* object, float ior, float share,
                        uint32_t* words)
{
    const vtPlacedObject* placed = &object->placed;
    const vtMaterial* material = &object->material;
    const vtMeshBuffer* mesh = &scene->meshes[object->mesh];
    for (int row = 0; row < 3; ++row) {
        const float* r = placed->toObject.rows[row];
        writeNumbers(words, VT_OBJECT_TRANSFORM + row, r[0], r[1], r[2], r[3]);
    }
    const float margin = share * vtLength(vtSub(placed->high, placed->low));
    writeNumbers(words, VT_OBJECT_LOW, placed->low.x - margin, placed->low.y - margin, placed->low.z - margin,
                 vtLength(vtSub(placed->high, placed->low)));
    writeNumbers(words, VT_OBJECT_HIGH, placed->high.x + margin, placed->high.y + margin,
                 placed->high.z + margin, 0.0f);
    words[4 * VT_OBJECT_EXTENT + 3] = material->opaque;
    writeNumbers(words, VT_OBJECT_GLASS, ior > 0.0f ? ior : material->ior, placed->absorption.x,
                 placed->absorption.y, placed->absorption.z);
    const vtVec3 color = material->opaque ? material->baseColor : material->tint;
    writeNumbers(words, VT_OBJECT_COLOR, color.x, color.y, color.z, 0.0f);
    words[4 * VT_OBJECT_COLOR + 3] = object->firstAttribute;
    writeNumbers(words, VT_OBJECT_SURFACE, material->metallic, material->roughness, material->checker, 0.0f);
    writeNumbers(words, VT_OBJECT_EMISSIVE, material->emissive.x, material->emissive.y, material->emissive.z,
                 0.0f);
    words[4 * VT_OBJECT_IMAGES] = (uint32_t)material->baseColorImage; // VT_NO_TRIANGLE for -1
    words[4 * VT_OBJECT_IMAGES + 1] = (uint32_t)material->metallicRoughnessImage;
    words[4 * VT_OBJECT_IMAGES + 2] = mesh->firstTriangle;
    const vtVec3 low = object->ownMin, high = object->ownMax;
    writeNumbers(words, VT_OBJECT_OWN_LOW, low.x, low.y, low.z, 0.0f);
    writeNumbers(words, VT_OBJECT_OWN_HIGH, high.x, high.y, high.z, scene->heights.cell);
}

/// The slot of those there are that holds the same, or a new one.
static int findSlot(vtLayout* layout, const vtCubeSlot* slot)
{
    int found = 0;
    while (found < layout->slotCount && memcmp(&layout->slots[found], slot, sizeof *slot) != 0) {
        ++found;
    }
    layout->slots[found] = *slot;
    layout->slotCount += found == layout->slotCount;
    return found;
}

/// Where an object's layers are and how the world lies in them.
static void placeLayers(const vtSceneBuffer* scene, const vtFrame* frame, const vtObjectBuffer* object,
                        vtLayout* layout, uint32_t* words)
{
    const vtPlacedObject* placed = &object->placed;
    vtCubeSlot slot;
    memset(&slot, 0, sizeof slot); // compared with its padding
    slot.mesh = &scene->meshes[object->mesh];
    slot.opaque = object->material.opaque;
    float toLayers[4][4], extents[3] = {1.0f, 1.0f, 1.0f};
    if (frame->layerSource == vt_layersFromEye) {
        const vtFrustum frustum = vtMakeLayerFrustum(&frame->view, placed->low, placed->high);
        const vtVec3 eye = vtTransformPoint(&placed->toObject, frame->view.eye);
        fitFrustum(&frame->view, &frustum, toLayers);
        multiply(toLayers, &placed->toWorld, slot.layers);
        slot.eye[0] = eye.x;
        slot.eye[1] = eye.y;
        slot.eye[2] = eye.z;
        slot.eye[3] = 1.0f;
    } else {
        fitCube(&scene->cubeFrames[object->mesh], frame->cubeSize, slot.layers, extents);
        multiply(slot.layers, &placed->toObject, toLayers);
    }
    for (int row = 0; row < 4; ++row) {
        const float* r = toLayers[row];
        writeNumbers(words, VT_OBJECT_LAYERS + row, r[0], r[1], r[2], r[3]);
    }
    writeNumbers(words, VT_OBJECT_EXTENT, extents[0], extents[1], extents[2], 0.0f);
    words[4 * VT_OBJECT_EXTENT + 3] = 2 * (uint32_t)findSlot(layout, &slot) + slot.opaque;
}

/// The frustum of the layers that an object has to itself, and their number among those of all.
static void writeFrustum(const vtFrame* frame, const vtPlacedObject* placed, uint32_t slot, uint32_t* words)
{
    const vtFrustum f = vtMakeLayerFrustum(&frame->view, placed->low, placed->high);
    writeNumbers(words, VT_OBJECT_FRUSTUM, f.left, f.bottom, f.right, f.top);
    writeNumbers(words, VT_OBJECT_DEPTHS, f.near, f.far, 1.0f / (f.far - f.near), 0.0f);
    words[4 * VT_OBJECT_LOW + 3] = slot;
}

vtResult vtCreateLayout(const vtSceneBuffer* scene, const vtFrame* frame, vtLayout* layout, vtError* error)
{
    const uint32_t count = scene->objectCount;
    *layout = (vtLayout){
        .slots = calloc(count + 1, sizeof *layout->slots),
        .words = calloc(count, VT_OBJECT_TEXELS * 4 * sizeof *layout->words),
    };
    if (layout->slots == NULL || layout->words == NULL) {
        vtDestroyLayout(layout);
        return vtFail(error, vt_errorMemory, "scene: out of memory for %u objects", count);
    }
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    for (uint32_t i = 0; i < count; ++i) {
        uint32_t* words = layout->words + 4 * VT_OBJECT_TEXELS * (size_t)i;
        const vtObjectBuffer* object = &scene->objects[i];
        const bool peeled = row->layerSpace == vt_layersOfEachObject && !object->material.opaque;
        // A little more than the box: a ray that starts on its side is within it. Layers are widened by whole
        // texels (search_layered.glsl).
        writeObject(scene, object, frame->ior, peeled ? 0.0f : 1e-5f, words);
        if (row->heights && vtSceneBuffer_HasHeights(scene, i)) {
            words[4 * VT_OBJECT_OWN_LOW + 3] = 1;
        } else if (row->cube || object->material.opaque) {
            placeLayers(scene, frame, object, layout, words);
        } else if (peeled) {
            writeFrustum(frame, &object->placed, i, words);
        }
    }
    return vt_ok;
}

bool vtLayout_SameSlots(const vtLayout* a, const vtLayout* b)
{
    return a->slotCount == b->slotCount &&
           (a->slotCount == 0 || memcmp(a->slots, b->slots, (size_t)a->slotCount * sizeof *a->slots) == 0);
}

void vtDestroyLayout(vtLayout* layout)
{
    free(layout->slots);
    free(layout->words);
    *layout = (vtLayout){0};
}
