#include "render/object_table.h"

#include <string.h>

#include "base/math.h"
#include "gl/material_table.h"
#include "scene/camera.h"
#include "scene/material.h"
#include "shaders_es3/common/constants.h"
#include "technique/technique.h"

static void writeNumbers(uint32_t* words, int part, float x, float y, float z, float w)
{
    const float numbers[4] = {x, y, z, w};
    memcpy(words + 4 * part, numbers, sizeof numbers);
}

/// `share`: of its diagonal, by which the box is wider.
static void writeBox(const vtPlacedObject* placed, float share, uint32_t* words)
{
    const float diagonal = vtLength(vtSub(placed->high, placed->low)), margin = share * diagonal;
    const vtVec3 low = placed->low, high = placed->high;
    writeNumbers(words, VT_OBJECT_LOW, low.x - margin, low.y - margin, low.z - margin, diagonal);
    writeNumbers(words, VT_OBJECT_HIGH, high.x + margin, high.y + margin, high.z + margin, 0.0f);
}

/// `row`: of the table of materials.
static void writeMaterial(const vtObjectBuffer* object, const vtFrame* frame, uint32_t row, uint32_t* words)
{
    const float ior = frame->ior;
    const vtMaterial* material = &object->material;
    const vtVec3 absorption = object->placed.absorption, emissive = material->emissive;
    const vtVec3 color = material->opaque ? material->baseColor : material->tint;
    const float own =
        material->ior > 0.0f ? material->ior : 1.0f; // one that reflects everything bends nothing
    writeNumbers(words, VT_OBJECT_GLASS, ior > 0.0f && !material->opaque ? ior : own, absorption.x,
                 absorption.y, absorption.z);
    writeNumbers(words, VT_OBJECT_COLOR, color.x, color.y, color.z, 0.0f);
    words[4 * VT_OBJECT_COLOR + 3] = object->firstAttribute;
    writeNumbers(words, VT_OBJECT_SURFACE, material->metallic,
                 vtMaterial_Roughness(material, frame->roughness), material->checker,
                 (float)object->placed.body);
    writeNumbers(words, VT_OBJECT_EMISSIVE, emissive.x, emissive.y, emissive.z, 0.0f);
    words[4 * VT_OBJECT_EMISSIVE + 3] = row;
    writeNumbers(words, VT_OBJECT_IMAGES, 0.0f, 0.0f, 0.0f,
                 vtMaterial_Dispersion(material, frame->dispersion));
    words[4 * VT_OBJECT_IMAGES] = object->colorLayer;
    words[4 * VT_OBJECT_IMAGES + 1] = object->roughLayer;
    words[4 * VT_OBJECT_IMAGES + 2] = object->firstMore;
}

/// `space`: what the shader's coordinates of the object are in. A relief's heights are in those of its mesh.
static void writeTransform(const vtObjectBuffer* object, const vtSpace* space, uint32_t* words)
{
    const float move[3] = {space->origin.x, space->origin.y, space->origin.z}, size = 1.0f / space->unit;
    for (int row = 0; row < 3; ++row) {
        const float* r = object->placed.toObject.rows[row];
        writeNumbers(words, VT_OBJECT_TRANSFORM + row, r[0] * size, r[1] * size, r[2] * size,
                     r[3] * size + move[row]);
    }
    const vtVec3 low = vtSpace_Leave(space, object->ownMin), high = vtSpace_Leave(space, object->ownMax);
    writeNumbers(words, VT_OBJECT_OWN_LOW, low.x, low.y, low.z, 0.0f);
    writeNumbers(words, VT_OBJECT_OWN_HIGH, high.x, high.y, high.z, 0.0f);
}

static void writeRecords(const vtGeometryBuffer* geometry, bool bothSides, uint32_t* words)
{
    const vtVec3 low = geometry->gridLow, scale = geometry->gridScale;
    writeNumbers(words, VT_OBJECT_GRID_LOW, low.x, low.y, low.z, 0.0f);
    writeNumbers(words, VT_OBJECT_GRID_SCALE, scale.x, scale.y, scale.z, 0.0f);
    words[4 * VT_OBJECT_GRID_LOW + 3] = geometry->records.first;
    words[4 * VT_OBJECT_GRID_SCALE + 3] = bothSides;
}

/// The frustum of the layers that an object has to itself, and their number among those of all.
static void writeLayers(const vtCamera* camera, const vtPlacedObject* placed, uint32_t set, uint32_t* words)
{
    const vtFrustum f = vtMakeLayerFrustum(camera, placed->low, placed->high);
    writeNumbers(words, VT_OBJECT_FRUSTUM, f.left, f.bottom, f.right, f.top);
    writeNumbers(words, VT_OBJECT_DEPTHS, f.near, f.far, 1.0f / (f.far - f.near), 0.0f);
    words[4 * VT_OBJECT_HIGH + 3] = set;
}

void vtWriteObjectTable(const vtSceneBuffer* scene, const vtFrame* frame, const vtCamera* camera)
{
    const vtTechniqueRow* row = vtTechnique_Row(frame->technique);
    const vtSpace none = vtOuterSpace();
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        uint32_t* words = scene->fresh + 4 * VT_OBJECT_TEXELS * (size_t)i;
        const vtObjectBuffer* object = &scene->objects[i];
        const vtGeometryBuffer* geometry = &scene->geometry.items[object->geometry];
        const bool byHeights = row->heights && vtSceneBuffer_HasHeights(scene, i);
        const bool peeled = row->layerSpace == vt_layersOfEachObject && !object->material.opaque;
        memset(words, 0, VT_OBJECT_TEXELS * 4 * sizeof *words);
        writeTransform(object, byHeights ? &geometry->space : &none, words);
        // A little more than the box: a ray that starts on its side is within it. Layers are widened by whole
        // texels (search_layered.glsl).
        writeBox(&object->placed, peeled ? 0.0f : 1e-5f, words);
        writeMaterial(object, frame, vtMaterialTable_First(scene->lightCount) + i, words);
        writeRecords(geometry, object->bothSides, words);
        if (byHeights) {
            const float cell = geometry->heights.cell;
            words[4 * VT_OBJECT_OWN_LOW + 3] = 1;
            memcpy(words + 4 * VT_OBJECT_OWN_HIGH + 3, &cell, sizeof cell);
        }
        if (peeled) {
            writeLayers(camera, &object->placed, i, words);
        }
    }
}
