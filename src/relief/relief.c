// Reliefs of pictures.
#include "relief/relief.h"

#include <assert.h>
#include <math.h>

#include "base/error.h"
#include "image/image.h"
#include "image/image_checks.h"
#include "mesh/height_field.h"

/// Steps of 1/256 of the depth, spread over five samples and more, no longer show in a refraction.
static const float smoothingOf8Bits = 2.0f;

vtReliefDef vtDefaultRelief(void)
{
    return (vtReliefDef){.depth = 0.1f, .thickness = 0.1f, .smoothing = -1.0f};
}

/// Measured numbers to 0 to 1.
static vtResult normalise(float* heights, int width, int height, const char* name, vtError* error)
{
    const size_t count = (size_t)width * (size_t)height;
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        if (!isfinite(heights[i])) {
            return vtFail(error, vt_errorFormat,
                          "relief '%.300s': the height in column %d, row %d is %g; it must be finite", name,
                          (int)(i % (size_t)width), (int)(i / (size_t)width), (double)heights[i]);
        }
        low = fmin(low, (double)heights[i]);
        high = fmax(high, (double)heights[i]);
    }
    for (size_t i = 0; i < count; ++i) {
        heights[i] = high > low ? (float)(((double)heights[i] - low) / (high - low)) : 0.0f;
    }
    return vt_ok;
}

vtResult vtLoadReliefOfBits(const void* bytes, size_t size, const char* name, const vtReliefDef* def,
                            vtMesh* mesh, int* bits, vtError* error)
{
    if (mesh == NULL) {
        return vtFailMissing(error, "vtLoadRelief", "mesh");
    }
    *mesh = (vtMesh){0};
    if (def == NULL || (bytes == NULL && size > 0)) {
        return vtFailMissing(error, "vtLoadRelief", def == NULL ? "def" : "bytes");
    }
    float* heights;
    vtReliefDef own = *def;
    vtResult result = vtDecodeHeights(bytes, size, name, &heights, &own.width, &own.height, bits, error);
    if (result == vt_ok && *bits == 32) {
        result = normalise(heights, own.width, own.height, name != NULL ? name : "unnamed", error);
    }
    if (result == vt_ok) {
        own.heights = heights;
        own.smoothing = def->smoothing != -1.0f ? def->smoothing : *bits == 8 ? smoothingOf8Bits : 0.0f;
        result = vtCreateRelief(&own, name, mesh, error);
    }
    vtFree(heights);
    return result;
}

vtResult vtCreateReliefOfPixels(const uint8_t* pixels, int width, int height, const char* name,
                                const vtReliefDef* def, vtMesh* mesh, vtError* error)
{
    assert(def != NULL && mesh != NULL);
    *mesh = (vtMesh){0};
    name = name != NULL ? name : "unnamed";
    vtResult result = vtCheckHeightSides(name, width, height, vt_errorFormat, error);
    if (result != vt_ok) {
        return result;
    }
    const size_t count = (size_t)width * (size_t)height;
    float* heights = vtAllocate(count, sizeof *heights);
    if (heights == NULL) {
        return vtFail(error, vt_errorMemory,
                      "relief '%.300s': out of memory for %d x %d samples; scale it down", name, width,
                      height);
    }
    for (size_t i = 0; i < count; ++i, pixels += 4) {
        heights[i] = (float)vtLumaOfSamples(pixels[0], pixels[1], pixels[2]) / 255.0f;
    }
    vtReliefDef own = *def;
    own.heights = heights;
    own.width = width;
    own.height = height;
    own.smoothing = def->smoothing != -1.0f ? def->smoothing : smoothingOf8Bits;
    result = vtCreateRelief(&own, name, mesh, error);
    vtFree(heights);
    return result;
}

vtResult vtCreateReliefOfDepth(const vtMesh* unit, float depth, float thickness, const char* name,
                               vtMesh* mesh, vtError* error)
{
    const vtHeightField* from = unit->heights;
    const size_t count = (size_t)from->width * (size_t)from->height;
    const size_t rangeCount = from->starts[from->levelCount + 1];
    *mesh = *unit;
    vtHeightField* field = mesh->heights = vtAllocate(1, sizeof *field);
    if (field != NULL) {
        *field = *from;
        field->z = vtAllocate(count, sizeof *field->z);
        field->ranges = vtAllocate(rangeCount, sizeof *field->ranges);
    }
    if (field == NULL || field->z == NULL || field->ranges == NULL) {
        vtDestroyHeightField(field);
        *mesh = (vtMesh){0};
        return vtFail(error, vt_errorMemory,
                      "relief '%.300s': out of memory for %d x %d samples; scale it down", name, from->width,
                      from->height);
    }
    for (size_t i = 0; i < count; ++i) {
        field->z[i] = depth * from->z[i];
    }
    for (size_t i = 0; i < rangeCount; ++i) {
        const vtHeightRange range = from->ranges[i];
        const bool hasCells = range.low <= range.high; // else infinite
        field->ranges[i] = hasCells ? (vtHeightRange){depth * range.low, depth * range.high} : range;
    }
    field->low = depth * from->low;
    field->high = depth * from->high;
    field->back = fminf(field->low, 0.0f) - thickness;
    mesh->boundsMin.z = field->back;
    mesh->boundsMax.z = field->high;
    mesh->volume = fabs(vtHeightField_Volume(field));
    return vtSucceed(error);
}

vtResult vtLoadRelief(const void* bytes, size_t size, const char* name, const vtReliefDef* def, vtMesh* mesh,
                      vtError* error)
{
    int bits;
    return vtLoadReliefOfBits(bytes, size, name, def, mesh, &bits, error);
}
