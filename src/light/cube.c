// A cube seen from its middle, bilinear within each face, as an equirectangular picture (vitrine.h tells its
// axes) whose equator has as many texels as the four faces around.
//
// The face in front is what is seen along -Z with +Y up; +X is to the right of it, as in the light probes of
// Debevec, http://gl.ict.usc.edu/Data/HighResProbes. A strip has the faces in the order and orientation of
// OpenGL's cube maps, whose axes are left-handed: its +Z is the front.
#include "light/cube.h"

#include <math.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"

enum { faceRight, faceLeft, faceUp, faceDown, faceFront, faceBack, faceCount };

/// Where the faces are, in squares from the upper left corner.
typedef struct Layout {
    uint8_t across, down;
    bool isCross;
    struct {
        uint8_t column, row;
    } face[faceCount];
} Layout;

static const Layout layouts[] = {
    {4, 3, true, {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}},
    {3, 4, true, {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3}}}, // the last one upside down
    {6, 1, false, {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}},
    {1, 6, false, {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}},
};
enum { layoutCount = sizeof layouts / sizeof layouts[0], largestWidth = 16384 };

static const float* pixelAt(const vtEnvironment* picture, int column, int row)
{
    return picture->pixels + 3 * ((size_t)row * (size_t)picture->width + (size_t)column);
}

/// Whether a square without a face has, but for its rim, the colour of the picture's corner: a JPEG's is not
/// quite even, above all at its rim.
static bool isBlank(const vtEnvironment* picture, int side, int column, int row)
{
    const int rim = side / 8;
    for (int y = row * side + rim; y < (row + 1) * side - rim; ++y) {
        for (int x = column * side + rim; x < (column + 1) * side - rim; ++x) {
            for (int k = 0; k < 3; ++k) {
                const float wanted = pixelAt(picture, 0, 0)[k];
                if (fabsf(pixelAt(picture, x, y)[k] - wanted) > 0.002f + 0.03f * wanted) {
                    return false;
                }
            }
        }
    }
    return true;
}

static bool fits(const vtEnvironment* picture, const Layout* layout)
{
    const int side = picture->width / layout->across;
    if (side * layout->across != picture->width || side * layout->down != picture->height) {
        return false;
    }
    for (int i = 0; layout->isCross && i < layout->across * layout->down; ++i) {
        const int column = i % layout->across, row = i / layout->across;
        if (column != 1 && row != 1 && !isBlank(picture, side, column, row)) {
            return false;
        }
    }
    return true;
}

/// Which face a direction meets, and where: -1 to 1 to the right and downwards.
static int meetFace(vtVec3 d, float* s, float* t)
{
    const float x = fabsf(d.x), y = fabsf(d.y), z = fabsf(d.z), most = fmaxf(x, fmaxf(y, z));
    const int face = most == z   ? (d.z < 0.0f ? faceFront : faceBack)
                     : most == x ? (d.x > 0.0f ? faceRight : faceLeft)
                                 : (d.y > 0.0f ? faceUp : faceDown);
    *s = (face == faceRight ? d.z : face == faceLeft ? -d.z : face == faceBack ? -d.x : d.x) / most;
    *t = (face == faceUp ? -d.z : face == faceDown ? d.z : -d.y) / most;
    return face;
}

static void sampleCube(const vtEnvironment* picture, const Layout* layout, vtVec3 d, float* rgb)
{
    float s, t;
    const int side = picture->width / layout->across, face = meetFace(d, &s, &t);
    if (face == faceBack && layout->down == 4) {
        s = -s;
        t = -t;
    }
    const float x = vtClamp(0.5f * (s + 1.0f) * (float)side - 0.5f, 0.0f, (float)(side - 1));
    const float y = vtClamp(0.5f * (t + 1.0f) * (float)side - 0.5f, 0.0f, (float)(side - 1));
    const int column = (int)x, row = (int)y;
    const int right = column + 1 < side, below = row + 1 < side;
    const float* from =
        pixelAt(picture, layout->face[face].column * side + column, layout->face[face].row * side + row);
    const float* under = from + below * 3 * picture->width;
    for (int k = 0; k < 3; ++k) {
        const float top = from[k] + (from[3 * right + k] - from[k]) * vtFract(x);
        const float bottom = under[k] + (under[3 * right + k] - under[k]) * vtFract(x);
        rgb[k] = top + (bottom - top) * vtFract(y);
    }
}

vtResult vtUnfoldCube(vtEnvironment* environment, const char* name, vtError* error)
{
    const Layout* layout = layouts;
    while (layout < layouts + layoutCount && !fits(environment, layout)) {
        ++layout;
    }
    if (layout == layouts + layoutCount) {
        return vtSucceed(error);
    }
    const int side = environment->width / layout->across;
    const int width = 4 * side < largestWidth ? 4 * side : largestWidth, height = width / 2;
    float* pixels = vtAllocate((size_t)width * (size_t)height, 3 * sizeof *pixels);
    if (pixels == NULL) {
        return vtFail(error, vt_errorMemory,
                      "no memory to make %d x %d pixels of the six faces in picture '%.300s'; scale it down",
                      width, height, name != NULL ? name : "");
    }
    for (int row = 0; row < height; ++row) {
        const float upward = VT_PI * (0.5f - ((float)row + 0.5f) / (float)height);
        for (int column = 0; column < width; ++column) {
            const float azimuth = 2.0f * VT_PI * (((float)column + 0.5f) / (float)width - 0.5f);
            const vtVec3 d = {cosf(upward) * cosf(azimuth), sinf(upward), cosf(upward) * sinf(azimuth)};
            sampleCube(environment, layout, d, pixels + 3 * ((size_t)row * (size_t)width + (size_t)column));
        }
    }
    vtFree(environment->pixels);
    environment->pixels = pixels;
    environment->width = width;
    environment->height = height;
    return vtSucceed(error);
}
