// A text, then the floats, the lowest row first.
#include "image/pfm.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "image/image_checks.h"
#include "image/raster.h"

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

static vtResult readHeader(const vtPictureFile* file, Header* header, vtError* error)
{
    char magic[4], columnsWord[16], rowsWord[16], scaleWord[32];
    size_t at = 0;
    if (!readWord(file->bytes, file->size, &at, magic, sizeof magic) ||
        !readWord(file->bytes, file->size, &at, columnsWord, sizeof columnsWord) ||
        !readWord(file->bytes, file->size, &at, rowsWord, sizeof rowsWord) ||
        !readWord(file->bytes, file->size, &at, scaleWord, sizeof scaleWord)) {
        return vtFail(error, vt_errorFormat, "picture '%s' ends within its PFM header; write it again",
                      file->name);
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
                      file->name, columnsWord, rowsWord, scaleWord, VT_MAX_IMAGE_SIDE);
    }
    return vt_ok;
}

/// Whether all pixels are there, so that a header alone takes no memory.
static vtResult checkLength(const vtPictureFile* file, const Header* header, vtError* error)
{
    const size_t needed = (size_t)header->columns * (size_t)header->rows * (size_t)header->channels * 4;
    if (file->size - header->offset < needed) {
        return vtFail(error, vt_errorFormat,
                      "picture '%s' holds %zu bytes of pixels where %ld x %ld need %zu; it is "
                      "truncated, so write it again",
                      file->name, file->size - header->offset, header->columns, header->rows, needed);
    }
    return vt_ok;
}

/// Top row first.
static void readPixels(const vtPictureFile* file, const Header* header, float* to)
{
    const size_t rowFloats = (size_t)header->columns * (size_t)header->channels;
    for (size_t row = (size_t)header->rows; row-- > 0;) {
        const uint8_t* from = file->bytes + header->offset + row * rowFloats * 4;
        for (size_t i = 0; i < rowFloats; ++i, from += 4) {
            *to++ = loadFloat(from, header->littleEndian);
        }
    }
}

vtResult vtDecodePfmRaster(const vtPictureFile* file, vtRaster* raster, vtError* error)
{
    *raster = (vtRaster){0};
    Header header = {0};
    vtResult result = readHeader(file, &header, error);
    if (result == vt_ok && file->isRelief) {
        result = vtCheckHeightSides(file->name, header.columns, header.rows, vt_errorFormat, error);
    }
    if (result == vt_ok) {
        result = checkLength(file, &header, error);
    }
    if (result == vt_ok) {
        result = vtBeginRaster(file, header.columns, header.rows, header.channels, 32, raster, error);
    }
    if (result == vt_ok) {
        readPixels(file, &header, raster->samples);
    }
    return result;
}

vtResult vtDecodePfm(const void* bytes, size_t size, const char* name, float** rgb, int* width, int* height,
                     vtError* error)
{
    assert(rgb != NULL && width != NULL && height != NULL && (bytes != NULL || size == 0));
    *rgb = NULL;
    *width = *height = 0;
    const vtPictureFile file = {bytes, size, name != NULL ? name : "", false, NULL};
    if (!vtIsPfm(bytes, size) || ((const char*)bytes)[1] != 'F') {
        return vtFail(error, vt_errorFormat, "picture '%s' is not a colour PFM (its first word is not PF)",
                      file.name);
    }
    vtRaster raster;
    const vtResult result = vtDecodePfmRaster(&file, &raster, error);
    *rgb = raster.samples;
    *width = raster.width;
    *height = raster.height;
    return result;
}
