// A text, then the floats, the lowest row first.
#include "image/pfm.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "image/image_checks.h"

/// A float's four bytes, written out so that the machine's own byte order does not matter.
static void storeLittleEndian(uint8_t* to, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 4; ++i) {
        to[i] = (uint8_t)(bits >> (8 * i));
    }
}

static float loadFloat(const uint8_t* from, bool littleEndian)
{
    uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) {
        bits |= (uint32_t)from[i] << (8 * (littleEndian ? i : 3 - i));
    }
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

vtResult vtEncodePfm(const float* rgb, int width, int height, uint8_t** bytes, size_t* size, vtError* error)
{
    assert(rgb != NULL && bytes != NULL && size != NULL);
    *bytes = NULL;
    *size = 0;
    if (vtCheckWritten(width, height, error) != vt_ok) {
        return vt_errorArgument;
    }
    char header[64];
    const size_t headerSize = (size_t)snprintf(header, sizeof header, "PF\n%d %d\n-1.0\n", width, height);
    const size_t rowFloats = (size_t)width * 3;
    uint8_t* encoded = vtAllocate(headerSize + rowFloats * (size_t)height * 4, 1);
    if (encoded == NULL) {
        return vtFail(error, vt_errorMemory, "no memory to write a PFM of %d x %d pixels", width, height);
    }
    memcpy(encoded, header, headerSize);
    uint8_t* to = encoded + headerSize;
    for (int row = height - 1; row >= 0; --row) {
        const float* from = rgb + (size_t)row * rowFloats;
        for (size_t i = 0; i < rowFloats; ++i, to += 4) {
            storeLittleEndian(to, from[i]);
        }
    }
    *bytes = encoded;
    *size = (size_t)(to - encoded);
    return vtSucceed(error);
}

static bool isSpace(uint8_t c)
{
    return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

/// Reads the next word of a PFM header into `word` and leaves *at on the one white space after it.
static bool readWord(const uint8_t* bytes, size_t size, size_t* at, char* word, size_t capacity)
{
    while (*at < size && isSpace(bytes[*at])) {
        ++*at;
    }
    size_t length = 0;
    while (*at < size && !isSpace(bytes[*at])) {
        if (length + 1 == capacity) {
            return false;
        }
        word[length++] = (char)bytes[(*at)++];
    }
    word[length] = '\0';
    return length > 0 && *at < size;
}

typedef struct Header {
    int channels; ///< 1 (Pf) or 3 (PF)
    long columns, rows;
    bool littleEndian;
    size_t offset; ///< of the lowest row
} Header;

bool vtIsPfm(const void* bytes, size_t size)
{
    const uint8_t* octets = bytes;
    return size >= 3 && octets[0] == 'P' && (octets[1] == 'F' || octets[1] == 'f') && isSpace(octets[2]);
}

static vtResult readHeader(const uint8_t* octets, size_t size, const char* name, Header* header,
                           vtError* error)
{
    char magic[4], columnsWord[16], rowsWord[16], scaleWord[32];
    size_t at = 0;
    if (!readWord(octets, size, &at, magic, sizeof magic) ||
        !readWord(octets, size, &at, columnsWord, sizeof columnsWord) ||
        !readWord(octets, size, &at, rowsWord, sizeof rowsWord) ||
        !readWord(octets, size, &at, scaleWord, sizeof scaleWord)) {
        return vtFail(error, vt_errorFormat, "picture '%s' ends within its PFM header; write it again", name);
    }
    const double scale = strtod(scaleWord, NULL);
    *header = (Header){.channels = magic[1] == 'F' ? 3 : 1,
                       .columns = strtol(columnsWord, NULL, 10),
                       .rows = strtol(rowsWord, NULL, 10),
                       .littleEndian = scale < 0.0,
                       .offset = at + 1};
    if (header->columns < 1 || header->rows < 1 || header->columns > VT_MAX_IMAGE_SIDE ||
        header->rows > VT_MAX_IMAGE_SIDE || !(scale != 0.0)) {
        return vtFail(error, vt_errorFormat,
                      "picture '%s' has the PFM header '%s %s %s', but sides must be 1 to %d and the scale "
                      "not 0; write it again",
                      name, columnsWord, rowsWord, scaleWord, VT_MAX_IMAGE_SIDE);
    }
    return vt_ok;
}

/// `channels` of each pixel: those of the header, or 1 for the luma of three. Top row first.
static vtResult readPixels(const uint8_t* octets, size_t size, const char* name, const Header* header,
                           int channels, float** pixels, vtError* error)
{
    const size_t columns = (size_t)header->columns, rows = (size_t)header->rows;
    const size_t stored = (size_t)header->channels, needed = columns * rows * stored * 4;
    if (size - header->offset < needed) {
        return vtFail(error, vt_errorFormat,
                      "picture '%s' holds %zu bytes of pixels where %zu x %zu need %zu; it is "
                      "truncated, so write it again",
                      name, size - header->offset, columns, rows, needed);
    }
    float* values = vtAllocate(columns * rows, (size_t)channels * sizeof *values);
    if (values == NULL) {
        return vtFail(error, vt_errorMemory, "no memory for the %zu x %zu pixels of picture '%s'", columns,
                      rows, name);
    }
    float* to = values;
    for (size_t row = rows; row-- > 0;) {
        const uint8_t* from = octets + header->offset + row * columns * stored * 4;
        for (size_t column = 0; column < columns; ++column, to += channels, from += 4 * stored) {
            float pixel[3];
            for (size_t k = 0; k < stored; ++k) {
                pixel[k] = loadFloat(from + 4 * k, header->littleEndian);
            }
            if (channels == 1) {
                to[0] = stored == 1 ? pixel[0] : vtLuma(pixel);
            } else {
                memcpy(to, pixel, sizeof pixel);
            }
        }
    }
    *pixels = values;
    return vtSucceed(error);
}

vtResult vtDecodePfm(const void* bytes, size_t size, const char* name, float** rgb, int* width, int* height,
                     vtError* error)
{
    assert(rgb != NULL && width != NULL && height != NULL && (bytes != NULL || size == 0));
    *rgb = NULL;
    *width = *height = 0;
    name = name != NULL ? name : "";
    Header header;
    if (!vtIsPfm(bytes, size) || ((const char*)bytes)[1] != 'F') {
        return vtFail(error, vt_errorFormat, "picture '%s' is not a colour PFM (its first word is not PF)",
                      name);
    }
    vtResult result = readHeader(bytes, size, name, &header, error);
    if (result == vt_ok) {
        result = readPixels(bytes, size, name, &header, 3, rgb, error);
    }
    if (result == vt_ok) {
        *width = (int)header.columns;
        *height = (int)header.rows;
    }
    return result;
}

vtResult vtDecodePfmHeights(const void* bytes, size_t size, const char* name, float** heights, int* width,
                            int* height, vtError* error)
{
    Header header;
    vtResult result = readHeader(bytes, size, name, &header, error);
    if (result == vt_ok) {
        result = vtCheckHeightSides(name, header.columns, header.rows, vt_errorFormat, error);
    }
    if (result == vt_ok) {
        result = readPixels(bytes, size, name, &header, 1, heights, error);
    }
    if (result == vt_ok) {
        *width = (int)header.columns;
        *height = (int)header.rows;
    }
    return result;
}
