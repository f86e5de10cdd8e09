// The table of built-in reliefs: patterns as architectural glass has them. Each is a function of the place
// alone, so that more samples show the same relief more finely.
#include "relief/relief.h"

#include <math.h>
#include <string.h>

#include "base/about.h"
#include "base/error.h"

static const float pi = 3.14159265f;

/// Rings of a circular wave about (x, y), `length` from crest to crest, that fade with the distance. Smooth
/// at the source, too, as it is a function of the squared distance.
static float rings(float x, float y, float length)
{
    const float square = x * x + y * y;
    return cosf(2.0f * pi / length * sqrtf(square)) / (1.0f + 2.0f * square);
}

/// Three drops have fallen into water.
static float ripples(float x, float y)
{
    const float sum = rings(x + 0.35f, y - 0.25f, 0.24f) + 0.6f * rings(x - 0.55f, y + 0.4f, 0.2f) +
                      0.4f * rings(x - 0.5f, y - 0.7f, 0.3f);
    return 0.5f + 0.25f * sum; // the weights' sum is 2
}

/// Random bits of a cell: multiply and shift, as C. Wellons's lowbias32.
static uint32_t scatter(int column, int row)
{
    uint32_t bits = (uint32_t)column * 0x9E3779B1u ^ (uint32_t)row * 0x85EBCA77u;
    bits = (bits ^ bits >> 16) * 0x7FEB352Du;
    bits = (bits ^ bits >> 15) * 0x846CA68Bu;
    return bits ^ bits >> 16;
}

/// Ten of them, from 0 to 1.
static float share(uint32_t bits, int first)
{
    return (float)(bits >> first & 1023) / 1023.0f;
}

/// Dimples about the points of a jittered hexagonal grid: the squared distance to the nearest one (Worley,
/// A Cellular Texture Basis Function, 1996), here a soft minimum, so that the ridges between the dimples are
/// round.
static float hammered(float x, float y)
{
    const float cells = 6.0f, sharpness = 7.0f, jitter = 0.6f; // cells along half the longer side
    const float rowHeight = 0.8660254f;
    const float u = cells * x, v = cells * y / rowHeight;
    const int row = (int)floorf(v);
    float sum = 0.0f;
    for (int j = row - 2; j <= row + 2; ++j) {
        const float shift = (j & 1) != 0 ? 0.5f : 0.0f;
        const int column = (int)floorf(u - shift);
        for (int i = column - 2; i <= column + 2; ++i) {
            const uint32_t bits = scatter(i, j);
            const float across = (float)i + shift + 0.5f + jitter * (share(bits, 0) - 0.5f) - u;
            const float up = ((float)j + 0.5f + jitter * (share(bits, 10) - 0.5f) - v) * rowHeight;
            const float square = across * across + up * up;
            if (square < 2.6f) { // what is farther away adds less than a float's last bit
                sum += expf(-sharpness * (square + 0.1f * share(bits, 20)));
            }
        }
    }
    return 0.15f - logf(sum) / sharpness;
}

/// Reeds side by side, parabolas that meet in creases.
static float fluted(float x, float y)
{
    (void)y;
    const float reeds = 6.0f, u = reeds * x;
    const float across = u - floorf(u) - 0.5f;
    return 1.0f - 4.0f * across * across;
}

/// Lenses in a square array, paraboloids.
static float lensArray(float x, float y)
{
    const float lenses = 3.0f, u = lenses * x, v = lenses * y;
    const float across = u - floorf(u) - 0.5f, up = v - floorf(v) - 0.5f;
    return 1.0f - 2.0f * (across * across + up * up);
}

static const struct {
    const char* name;
    const char* summary;
    float (*height)(float x, float y); // the longer side goes from -1 to 1, y upwards; 0 to 1
    float depth;
} patterns[] = {
    {"ripples", VT_ABOUT("rings of three drops in water"), ripples, 0.05f},
    {"hammered", VT_ABOUT("dimples of hammered cathedral glass"), hammered, 0.05f},
    {"fluted", VT_ABOUT("twelve reeds along y"), fluted, 0.04f},
    {"lens-array", VT_ABOUT("six by six lenses"), lensArray, 0.1f},
};
enum { patternCount = sizeof patterns / sizeof patterns[0], defaultSide = 512 };

const char* vtReliefPatternName(int index)
{
    return index >= 0 && index < patternCount ? patterns[index].name : NULL;
}

const char* vtReliefPatternSummary(int index)
{
    return index >= 0 && index < patternCount ? patterns[index].summary : NULL;
}

float vtReliefPatternDepth(int index)
{
    return index >= 0 && index < patternCount ? patterns[index].depth : vtDefaultRelief().depth;
}

int vtFindReliefPattern(const char* name)
{
    int index = patternCount - 1;
    while (index >= 0 && strcmp(patterns[index].name, name) != 0) {
        --index;
    }
    return index;
}

static void fill(int pattern, int width, int height, float* heights)
{
    const float longer = (float)((width > height ? width : height) - 1);
    for (int row = 0; row < height; ++row) {
        // Whole numbers before the division: samples at the same place have the same height, however many
        // there are.
        const float y = (float)(height - 1 - 2 * row) / longer;
        for (int column = 0; column < width; ++column) {
            const float x = (float)(2 * column - (width - 1)) / longer;
            *heights++ = patterns[pattern].height(x, y);
        }
    }
}

vtResult vtCreateReliefPattern(const char* name, const vtReliefDef* def, vtMesh* mesh, vtError* error)
{
    if (mesh == NULL) {
        return vtFailMissing(error, "vtCreateReliefPattern", "mesh");
    }
    *mesh = (vtMesh){0};
    if (name == NULL || def == NULL) {
        return vtFailMissing(error, "vtCreateReliefPattern", name == NULL ? "name" : "def");
    }
    const int pattern = vtFindReliefPattern(name);
    if (pattern < 0) {
        return vtFail(
            error, vt_errorArgument,
            "relief '%.100s' is unknown; the built-in ones are ripples, hammered, fluted and lens-array",
            name);
    }
    vtReliefDef own = *def;
    own.width = def->width != 0 ? def->width : defaultSide;
    own.height = def->height != 0 ? def->height : defaultSide;
    if (own.width < 2 || own.height < 2 || own.width > VT_MAX_RELIEF_SIDE ||
        own.height > VT_MAX_RELIEF_SIDE) {
        return vtFail(error, vt_errorArgument,
                      "relief '%s' is asked for in %d x %d samples; a side must be 2 to %d", name, own.width,
                      own.height, VT_MAX_RELIEF_SIDE);
    }
    float* heights = vtAllocate((size_t)own.width * (size_t)own.height, sizeof *heights);
    if (heights == NULL) {
        return vtFail(error, vt_errorMemory, "relief '%s': out of memory for %d x %d samples; ask for fewer",
                      name, own.width, own.height);
    }
    fill(pattern, own.width, own.height, heights);
    own.heights = heights;
    const vtResult result = vtCreateRelief(&own, name, mesh, error);
    vtFree(heights);
    return result;
}
