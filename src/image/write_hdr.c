// Radiance pictures written: RGBE, scan lines from the top, run-length coded by component where the format
// has that (widths of 8 to 32767). What the format is based on, and what a mantissa stands for, hdr.c says.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "image/image.h"
#include "image/image_checks.h"

enum {
    shortestCoded = 8,
    longestCoded = 0x7FFF,
    shortestRun = 4,
    longestRun = 127,
    longestLiteral = 128,
    mostOfHeader = 256
};

/// Three mantissas of 1 / 256 and the exponent, excess 128, that they have in common. Negative numbers and
/// NaN become 0, what is too large the largest that there is.
static void toRgbe(const float* rgb, uint8_t* rgbe)
{
    float light[3], most = 0.0f;
    for (int k = 0; k < 3; ++k) {
        light[k] = rgb[k] > 0.0f ? fminf(rgb[k], 1.69e38f) : 0.0f;
        most = fmaxf(most, light[k]);
    }
    memset(rgbe, 0, 4);
    if (most < 1e-38f) {
        return;
    }
    int exponent;
    const float mantissa = frexpf(most, &exponent); // 0.5 to 1
    exponent += mantissa >= 255.5f / 256.0f;        // it would round up to 256
    for (int k = 0; k < 3; ++k) {
        rgbe[k] = (uint8_t)(ldexpf(light[k], 8 - exponent) + 0.5f);
    }
    rgbe[3] = (uint8_t)(exponent + 128);
}

/// Bytes from `at` on that are the same.
static int runAt(const uint8_t* line, int component, int at, int width)
{
    int length = 1;
    while (at + length < width && length < longestRun &&
           line[4 * (at + length) + component] == line[4 * at + component]) {
        ++length;
    }
    return length;
}

/// One component of a line: a run as 128 + its length and the byte, else how many bytes, and they.
static uint8_t* writeComponent(const uint8_t* line, int component, int width, uint8_t* to)
{
    for (int i = 0; i < width;) {
        const int run = runAt(line, component, i, width);
        if (run >= shortestRun) {
            *to++ = (uint8_t)(128 + run);
            *to++ = line[4 * i + component];
            i += run;
            continue;
        }
        uint8_t* count = to++;
        const int begin = i;
        while (i < width && i - begin < longestLiteral && runAt(line, component, i, width) < shortestRun) {
            *to++ = line[4 * i++ + component];
        }
        *count = (uint8_t)(i - begin);
    }
    return to;
}

static uint8_t* writeLine(const uint8_t* line, int width, uint8_t* to)
{
    if (width < shortestCoded || width > longestCoded) {
        memcpy(to, line, 4 * (size_t)width);
        return to + 4 * (size_t)width;
    }
    *to++ = 2;
    *to++ = 2;
    *to++ = (uint8_t)(width >> 8);
    *to++ = (uint8_t)(width & 255);
    for (int component = 0; component < 4; ++component) {
        to = writeComponent(line, component, width, to);
    }
    return to;
}

vtResult vtEncodeHdr(const float* rgb, int width, int height, const char* comment, uint8_t** bytes,
                     size_t* size, vtError* error)
{
    *bytes = NULL;
    *size = 0;
    if (vtCheckWritten(width, height, error) != vt_ok) {
        return vt_errorArgument;
    }
    // Literals take a byte more for each 128; a line begins with four.
    const size_t mostOfLine = 4 * ((size_t)width + (size_t)width / 64 + 2) + 4;
    uint8_t* line = vtAllocate((size_t)width, 4);
    uint8_t* encoded = vtAllocate(mostOfHeader + mostOfLine * (size_t)height, 1);
    if (line == NULL || encoded == NULL) {
        vtFree(line);
        vtFree(encoded);
        return vtFail(error, vt_errorMemory, "no memory to write an HDR of %d x %d pixels", width, height);
    }
    uint8_t* to = encoded + snprintf((char*)encoded, mostOfHeader,
                                     "#?RADIANCE\n%s%.120s%sFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n",
                                     comment != NULL ? "# " : "", comment != NULL ? comment : "",
                                     comment != NULL ? "\n" : "", height, width);
    for (int row = 0; row < height; ++row) {
        for (int i = 0; i < width; ++i) {
            toRgbe(rgb + 3 * ((size_t)row * (size_t)width + (size_t)i), line + 4 * (size_t)i);
        }
        to = writeLine(line, width, to);
    }
    vtFree(line);
    *bytes = encoded;
    *size = (size_t)(to - encoded);
    return vtSucceed(error);
}
