// Radiance pictures (.hdr, .pic): Ward, "Real Pixels", Graphics Gems II, 1991, and the format of Radiance's
// manual, "File Formats". Read whatever the order of rows and columns, as RGB or XYZ, with scan lines that
// are flat, run-length coded as in the first version, or by component as since.
// Departures:
// - A mantissa m stands for m / 256, not for (m + 0.5) / 256, as in most programs but Radiance itself.
// - XYZ becomes RGB by Rec. 709's primaries and white (D65), and is not divided by 179 lumens a watt.
// - PRIMARIES, VIEW, PIXASPECT, GAMMA and what else a header may tell are not looked at.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "image/raster.h"

enum { shortestCoded = 8, longestCoded = 0x7FFF }; // lengths of scan lines that may be coded by component

typedef struct Reader {
    const vtPictureFile* file;
    const uint8_t* at;
    const uint8_t* end;
    bool isXyz;
    float scale[3]; ///< of each component, for EXPOSURE and COLORCORR
    // The resolution line: "-Y 512 +X 1024" has 512 lines of 1024 pixels.
    char axis;         ///< that the lines follow one another along: X or Y
    bool rising[2];    ///< of lines, of pixels in a line
    long count[2];     ///< likewise
    const char* fault; ///< what is wrong, NULL while nothing is
} Reader;

static bool fault(Reader* reader, const char* reason)
{
    reader->fault = reason;
    return false;
}

/// The next line without its end, be it LF or CRLF; what is too long for `line` is cut off.
static bool readLine(Reader* reader, char* line, size_t capacity)
{
    const size_t left = (size_t)(reader->end - reader->at);
    const uint8_t* end = left > 0 ? memchr(reader->at, '\n', left) : NULL;
    if (end == NULL) {
        return fault(reader, "its header is cut off");
    }
    size_t length = (size_t)(end - reader->at);
    length -= length > 0 && reader->at[length - 1] == '\r';
    length = length < capacity ? length : capacity - 1;
    memcpy(line, reader->at, length);
    line[length] = '\0';
    reader->at = end + 1;
    return true;
}

/// `count` positive numbers; each divides one component, or the only one all three.
static bool readScale(Reader* reader, const char* text, int count)
{
    for (int i = 0; i < count; ++i) {
        char* end = NULL;
        const double number = strtod(text, &end);
        if (end == text || !(number >= 1e-30 && number <= 1e30)) {
            return fault(reader, count == 1 ? "its EXPOSURE is not a number from 1e-30 to 1e30"
                                            : "its COLORCORR is not three numbers from 1e-30 to 1e30");
        }
        for (int k = 0; k < 3; ++k) {
            reader->scale[k] /= count == 1 || k == i ? (float)number : 1.0f;
        }
        text = end;
    }
    return true;
}

static bool readHeaderLine(Reader* reader, const char* line)
{
    if (strncmp(line, "EXPOSURE=", 9) == 0) {
        return readScale(reader, line + 9, 1);
    }
    if (strncmp(line, "COLORCORR=", 10) == 0) {
        return readScale(reader, line + 10, 3);
    }
    if (strncmp(line, "FORMAT=", 7) == 0) {
        const char* format = line + 7 + strspn(line + 7, " \t");
        const bool isRgb = strncmp(format, "32-bit_rle_rgbe", 15) == 0;
        reader->isXyz = strncmp(format, "32-bit_rle_xyze", 15) == 0;
        return isRgb || reader->isXyz ||
               fault(reader, "its FORMAT is neither 32-bit_rle_rgbe nor 32-bit_rle_xyze");
    }
    return true;
}

/// Of "-Y 512 +X 1024": two signs, axes and lengths.
static bool readResolution(Reader* reader, const char* line)
{
    char axes[2];
    for (int i = 0; i < 2; ++i) {
        line += strspn(line, " \t");
        const char sign = line[0];
        axes[i] = sign != '\0' ? line[1] : '\0';
        if ((sign != '+' && sign != '-') || (axes[i] != 'X' && axes[i] != 'Y')) {
            return fault(reader, "its line of the resolution is not like -Y 512 +X 1024");
        }
        reader->rising[i] = sign == '+';
        char* end = NULL;
        reader->count[i] = strtol(line + 2, &end, 10);
        if (end == line + 2 || reader->count[i] < 1) {
            return fault(reader, "its line of the resolution is not like -Y 512 +X 1024");
        }
        line = end;
    }
    reader->axis = axes[0];
    return axes[0] != axes[1] || fault(reader, "its line of the resolution has the same axis twice");
}

static bool readHeader(Reader* reader)
{
    char line[256];
    if (!readLine(reader, line, sizeof line)) { // "#?RADIANCE" or another program's name
        return false;
    }
    do {
        if (!readLine(reader, line, sizeof line) || !readHeaderLine(reader, line)) {
            return false;
        }
    } while (line[0] != '\0');
    return readLine(reader, line, sizeof line) && readResolution(reader, line);
}

/// One component of a line, in runs: n above 128: the next byte n - 128 times; n up to 128: n bytes.
static bool readComponent(Reader* reader, uint8_t* to, long length)
{
    for (long i = 0; i < length;) {
        if (reader->end - reader->at < 2) {
            return fault(reader, "its pixels are cut off");
        }
        const long code = *reader->at++;
        const bool repeats = code > 128;
        const long run = repeats ? code - 128 : code;
        if (run == 0 || run > length - i) {
            return fault(reader, "a run of pixels does not fit its line");
        }
        if (!repeats && reader->end - reader->at < run) {
            return fault(reader, "its pixels are cut off");
        }
        for (long k = 0; k < run; ++k, ++i) {
            to[4 * i] = reader->at[repeats ? 0 : k];
        }
        reader->at += repeats ? 1 : run;
    }
    return true;
}

/// Pixels one after the other; 1, 1, 1, n is not one but n of the one before, n * 256 right after another
/// such.
static bool readPixels(Reader* reader, uint8_t* to, long length)
{
    int shift = 0;
    for (long i = 0; i < length;) {
        if (reader->end - reader->at < 4) {
            return fault(reader, "its pixels are cut off");
        }
        const uint8_t* pixel = reader->at;
        reader->at += 4;
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            memcpy(to + 4 * i++, pixel, 4);
            shift = 0;
            continue;
        }
        const long run = shift <= 16 ? (long)pixel[3] << shift : length + 1;
        if (i == 0 || run > length - i) {
            return fault(reader, "a run of pixels does not fit its line");
        }
        for (long k = 0; k < run; ++k, ++i) {
            memcpy(to + 4 * i, to + 4 * (i - 1), 4);
        }
        shift += 8;
    }
    return true;
}

static bool readScanLine(Reader* reader, uint8_t* to, long length)
{
    const uint8_t* at = reader->at;
    const bool isCoded = length >= shortestCoded && length <= longestCoded && reader->end - at >= 4 &&
                         at[0] == 2 && at[1] == 2 && at[2] < 128;
    if (!isCoded) {
        return readPixels(reader, to, length);
    }
    if ((at[2] << 8 | at[3]) != length) {
        return fault(reader, "a line of pixels has not the picture's length");
    }
    reader->at += 4;
    for (int k = 0; k < 4; ++k) {
        if (!readComponent(reader, to + k, length)) {
            return false;
        }
    }
    return true;
}

static void toLight(const Reader* reader, const uint8_t* pixel, float* rgb)
{
    const float unit = pixel[3] != 0 ? ldexpf(1.0f, pixel[3] - 136) : 0.0f;
    float light[3];
    for (int k = 0; k < 3; ++k) {
        light[k] = (float)pixel[k] * unit * reader->scale[k];
    }
    if (reader->isXyz) { // IEC 61966-2-1
        rgb[0] = 3.2406f * light[0] - 1.5372f * light[1] - 0.4986f * light[2];
        rgb[1] = -0.9689f * light[0] + 1.8758f * light[1] + 0.0415f * light[2];
        rgb[2] = 0.0557f * light[0] - 0.2040f * light[1] + 1.0570f * light[2];
    } else {
        memcpy(rgb, light, sizeof light);
    }
}

/// Line `i` to its place: a row or a column, from either end.
static void placeLine(const Reader* reader, const uint8_t* line, long i, vtRaster* raster)
{
    const bool isRow = reader->axis == 'Y';
    float* samples = raster->samples;
    for (long k = 0; k < reader->count[1]; ++k) {
        // Y rises from the bottom, and the top row is the first.
        const long y = isRow ? i : k, x = isRow ? k : i;
        const long row = reader->rising[isRow ? 0 : 1] ? raster->height - 1 - y : y;
        const long column = reader->rising[isRow ? 1 : 0] ? x : raster->width - 1 - x;
        toLight(reader, line + 4 * k, samples + 3 * (row * raster->width + column));
    }
}

static vtResult readLines(Reader* reader, vtRaster* raster, vtError* error)
{
    uint8_t* line = vtAllocate((size_t)reader->count[1], 4);
    if (line == NULL) {
        return vtFailPictureMemory(reader->file, error);
    }
    for (long i = 0; i < reader->count[0] && readScanLine(reader, line, reader->count[1]); ++i) {
        placeLine(reader, line, i, raster);
    }
    vtFree(line);
    return vt_ok;
}

vtResult vtDecodeHdrRaster(const vtPictureFile* file, vtRaster* raster, vtError* error)
{
    Reader reader = {
        .file = file, .at = file->bytes, .end = file->bytes + file->size, .scale = {1.0f, 1.0f, 1.0f}};
    *raster = (vtRaster){0};
    vtResult result = vt_ok;
    if (readHeader(&reader)) {
        const int across = reader.axis == 'Y' ? 1 : 0;
        result = vtBeginRaster(file, reader.count[across], reader.count[1 - across], 3, 32, raster, error);
        result = result == vt_ok ? readLines(&reader, raster, error) : result;
    }
    if (reader.fault != NULL) {
        result = vtFailPicture(file, "Radiance HDR", reader.fault, error);
    }
    if (result != vt_ok) {
        vtDestroyRaster(raster);
    }
    return result;
}
