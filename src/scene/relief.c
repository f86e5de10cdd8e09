// Reliefs of pictures.
#include "scene/relief.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "base/image.h"

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
    assert(def != NULL && mesh != NULL && bits != NULL);
    *mesh = (vtMesh){0};
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
    free(heights);
    return result;
}

vtResult vtCreateReliefOfPixels(const uint8_t* pixels, int width, int height, const char* name,
                                const vtReliefDef* def, vtMesh* mesh, vtError* error)
{
    assert(def != NULL && mesh != NULL);
    *mesh = (vtMesh){0};
    name = name != NULL ? name : "unnamed";
    vtResult result = vtCheckHeightSides(name, width, height, error);
    if (result != vt_ok) {
        return result;
    }
    const size_t count = (size_t)width * (size_t)height;
    float* heights = malloc(count * sizeof *heights);
    if (heights == NULL) {
        return vtFail(error, vt_errorMemory,
                      "relief '%.300s': out of memory for %d x %d samples; scale it down", name, width,
                      height);
    }
    for (size_t i = 0; i < count; ++i, pixels += 4) {
        // The luma of stb_image, so that the same file has the same heights everywhere.
        heights[i] = (float)((77 * pixels[0] + 150 * pixels[1] + 29 * pixels[2]) >> 8) / 255.0f;
    }
    vtReliefDef own = *def;
    own.heights = heights;
    own.width = width;
    own.height = height;
    own.smoothing = def->smoothing != -1.0f ? def->smoothing : smoothingOf8Bits;
    result = vtCreateRelief(&own, name, mesh, error);
    free(heights);
    return result;
}

vtResult vtLoadRelief(const void* bytes, size_t size, const char* name, const vtReliefDef* def, vtMesh* mesh,
                      vtError* error)
{
    int bits;
    return vtLoadReliefOfBits(bytes, size, name, def, mesh, &bits, error);
}
