#include "base/image.h"

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

/// stb copies nothing to nowhere for an empty chunk of a PNG, which C11 leaves undefined.
static inline void* copyBytes(void* to, const void* from, size_t size)
{
    return size > 0 ? memcpy(to, from, size) : to;
}

// stb's code is not ours to keep free of warnings. Static, so that an embedder's own copy does not clash;
// the declarations of the decoders left out then count as unused to the end of the file.
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#endif
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_HDR
#ifndef VT_HDR_ONLY // web/CMakeLists.txt: a browser decodes the others itself
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#endif
#define memcpy copyBytes
#include <stb/stb_image.h>
#undef memcpy
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#define VT_LARGEST_HALF 65504.0f

float vtSrgbToLinear(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : powf((encoded + 0.055f) / 1.055f, 2.4f);
}

float vtLinearToSrgb(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1.0f / 2.4f) - 0.055f;
}

// ---------------------------------------------------------------------------------------- PNG, JPEG, HDR

static void sanitise(float* values, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        float value = values[i];
        values[i] = value > 0.0f ? fminf(value, VT_LARGEST_HALF) : 0.0f; // NaN fails the comparison
    }
}

static vtResult failMemory(const char* name, int width, int height, vtError* error)
{
    return vtFail(error, vt_errorMemory, "no memory for the %d x %d pixels of picture '%s'; scale it down",
                  width, height, name);
}

static vtResult checkSides(const char* name, int width, int height, vtError* error)
{
    if (width < 1 || height < 1 || width > VT_MAX_IMAGE_SIDE || height > VT_MAX_IMAGE_SIDE) {
        return vtFail(error, vt_errorFormat,
                      "picture '%s' is %d x %d pixels, but a side must be 1 to %d; scale it down", name,
                      width, height, VT_MAX_IMAGE_SIDE);
    }
    return vtSucceed(error);
}

vtResult vtLinearise(const uint8_t* samples, int channels, const char* name, int width, int height,
                     float** pixels, vtError* error)
{
    assert(samples != NULL && pixels != NULL && channels >= 3);
    *pixels = NULL;
    name = name != NULL ? name : "";
    if (checkSides(name, width, height, error) != vt_ok) {
        return vt_errorFormat;
    }
    const size_t count = (size_t)width * (size_t)height;
    float* values = malloc(count * 3 * sizeof *values);
    if (values == NULL) {
        return failMemory(name, width, height, error);
    }
    float table[256];
    for (int i = 0; i < 256; ++i) {
        table[i] = vtSrgbToLinear((float)i / 255.0f);
    }
    for (size_t i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) {
            values[3 * i + (size_t)k] = table[samples[(size_t)channels * i + (size_t)k]];
        }
    }
    *pixels = values;
    return vtSucceed(error);
}

static vtResult failDecode(const char* name, vtError* error)
{
    const char* reason = stbi_failure_reason();
    return vtFail(error, vt_errorFormat,
                  "picture '%s' cannot be decoded as PNG, JPEG or Radiance HDR (%s); it is damaged or of "
                  "another format, so save it again as one of these",
                  name, reason != NULL ? reason : "unknown reason");
}

/// As stbi_loadf_from_memory, which would bring all conversions of the other formats: 2 KB of a page's wasm.
static float* loadHdr(const uint8_t* bytes, int length, int* width, int* height)
{
    stbi__context context;
    stbi__result_info info;
    int channels = 0;
    stbi__start_mem(&context, bytes, length);
    return stbi__hdr_load(&context, width, height, &channels, 3, &info);
}

#ifdef VT_HDR_ONLY
static vtResult decodeSrgb(const uint8_t* bytes, int length, const char* name, float** pixels, int* width,
                           int* height, vtError* error)
{
    (void)bytes, (void)length, (void)pixels, (void)width, (void)height;
    return failDecode(name, error);
}
#else
/// PNG or JPEG of 8 or 16 bits.
static vtResult decodeSrgb(const uint8_t* bytes, int length, const char* name, float** pixels, int* width,
                           int* height, vtError* error)
{
    int channels = 0;
    if (!stbi_is_16_bit_from_memory(bytes, length)) {
        uint8_t* samples = stbi_load_from_memory(bytes, length, width, height, &channels, 3);
        if (samples == NULL) {
            return failDecode(name, error);
        }
        const vtResult result = vtLinearise(samples, 3, name, *width, *height, pixels, error);
        stbi_image_free(samples);
        return result;
    }
    uint16_t* samples = stbi_load_16_from_memory(bytes, length, width, height, &channels, 3);
    if (samples == NULL) {
        return failDecode(name, error);
    }
    const size_t count = (size_t)*width * (size_t)*height * 3;
    *pixels = malloc(count * sizeof **pixels);
    for (size_t i = 0; *pixels != NULL && i < count; ++i) {
        (*pixels)[i] = vtSrgbToLinear((float)samples[i] / 65535.0f);
    }
    stbi_image_free(samples);
    return *pixels != NULL ? vt_ok : failMemory(name, *width, *height, error);
}
#endif

vtResult vtDecodeImageLinear(const void* bytes, size_t size, const char* name, float** pixels, int* width,
                             int* height, vtError* error)
{
    assert(pixels != NULL && width != NULL && height != NULL && (bytes != NULL || size == 0));
    *pixels = NULL;
    *width = *height = 0;
    name = name != NULL ? name : "";
    if (size == 0 || size > INT_MAX) {
        return vtFail(error, vt_errorFormat, "picture '%s' %s; give a PNG, JPEG or Radiance HDR file", name,
                      size == 0 ? "is empty" : "is larger than 2 GB");
    }
    const int length = (int)size;

    // The header first, so that a picture that is too large costs no memory.
    int columns = 0, rows = 0, channels = 0;
    if (!stbi_info_from_memory(bytes, length, &columns, &rows, &channels)) {
        return failDecode(name, error);
    }
    if (checkSides(name, columns, rows, error) != vt_ok) {
        return vt_errorFormat;
    }

    float* values = NULL;
    if (stbi_is_hdr_from_memory(bytes, length)) {
        values = loadHdr(bytes, length, &columns, &rows);
        if (values == NULL) {
            return failDecode(name, error);
        }
        sanitise(values, (size_t)columns * (size_t)rows * 3);
    } else {
        const vtResult result = decodeSrgb(bytes, length, name, &values, &columns, &rows, error);
        if (result != vt_ok) {
            return result;
        }
    }
    *pixels = values;
    *width = columns;
    *height = rows;
    return vtSucceed(error);
}

#ifdef VT_HDR_ONLY
static vtResult fillImage(const uint8_t* bytes, int length, const char* name, vtImage* image, vtError* error)
{
    image->bytes = malloc((size_t)length);
    if (image->bytes == NULL) {
        return vtFail(error, vt_errorMemory, "no memory for the %d bytes of picture '%s'; scale it down",
                      length, name);
    }
    memcpy(image->bytes, bytes, (size_t)length);
    image->size = (size_t)length;
    return vtSucceed(error);
}
#else
static vtResult fillImage(const uint8_t* bytes, int length, const char* name, vtImage* image, vtError* error)
{
    // The header first, so that a picture that is too large costs no memory.
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes, length, &width, &height, &channels)) {
        return failDecode(name, error);
    }
    if (checkSides(name, width, height, error) != vt_ok) {
        return vt_errorFormat;
    }
    image->pixels = stbi_load_from_memory(bytes, length, &width, &height, &channels, 4);
    if (image->pixels == NULL) {
        return failDecode(name, error);
    }
    image->width = width;
    image->height = height;
    return vtSucceed(error);
}
#endif

vtResult vtDecodeImage(const void* bytes, size_t size, const char* name, vtImage* image, vtError* error)
{
    assert(image != NULL && (bytes != NULL || size == 0));
    *image = (vtImage){0};
    name = name != NULL ? name : "";
    const bool isPng = size >= 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0;
    const bool isJpeg = size >= 3 && memcmp(bytes, "\xFF\xD8\xFF", 3) == 0;
    if ((!isPng && !isJpeg) || size > INT_MAX) {
        return vtFail(error, vt_errorFormat,
                      "picture '%s' is neither PNG nor JPEG; it is damaged or of another format, so save it "
                      "again as one of these",
                      name);
    }
    return fillImage(bytes, (int)size, name, image, error);
}

/// The range every encoder shares.
static bool sizeIsUsable(int width, int height)
{
    return width >= 1 && height >= 1 && width <= VT_MAX_IMAGE_SIDE && height <= VT_MAX_IMAGE_SIDE;
}

static vtResult failSize(int width, int height, vtError* error)
{
    return vtFail(error, vt_errorArgument,
                  "a picture of %d x %d pixels cannot be written; a side must be 1 to %d", width, height,
                  VT_MAX_IMAGE_SIDE);
}

vtResult vtEncodePng(const uint8_t* pixels, int channels, int width, int height, uint8_t** bytes,
                     size_t* size, vtError* error)
{
    assert(pixels != NULL && bytes != NULL && size != NULL &&
           (channels == 1 || channels == 3 || channels == 4));
    *bytes = NULL;
    *size = 0;
    if (!sizeIsUsable(width, height)) {
        return failSize(width, height, error);
    }
    int length = 0;
    unsigned char* encoded =
        stbi_write_png_to_mem(pixels, width * channels, width, height, channels, &length);
    if (encoded == NULL) {
        return vtFail(error, vt_errorMemory, "no memory to write a PNG of %d x %d pixels", width, height);
    }
    *bytes = encoded;
    *size = (size_t)length;
    return vtSucceed(error);
}

// --------------------------------------------------------------------------------------------------- PFM

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
    if (!sizeIsUsable(width, height)) {
        return failSize(width, height, error);
    }
    char header[64];
    const size_t headerSize = (size_t)snprintf(header, sizeof header, "PF\n%d %d\n-1.0\n", width, height);
    const size_t rowFloats = (size_t)width * 3;
    uint8_t* encoded = malloc(headerSize + rowFloats * (size_t)height * 4);
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

vtResult vtDecodePfm(const void* bytes, size_t size, const char* name, float** rgb, int* width, int* height,
                     vtError* error)
{
    assert(rgb != NULL && width != NULL && height != NULL && (bytes != NULL || size == 0));
    *rgb = NULL;
    *width = *height = 0;
    name = name != NULL ? name : "";
    const uint8_t* octets = bytes;
    char magic[4], columnsWord[16], rowsWord[16], scaleWord[32];
    size_t at = 0;
    if (!readWord(octets, size, &at, magic, sizeof magic) || strcmp(magic, "PF") != 0) {
        return vtFail(error, vt_errorFormat, "picture '%s' is not a colour PFM (its first word is not PF)",
                      name);
    }
    if (!readWord(octets, size, &at, columnsWord, sizeof columnsWord) ||
        !readWord(octets, size, &at, rowsWord, sizeof rowsWord) ||
        !readWord(octets, size, &at, scaleWord, sizeof scaleWord)) {
        return vtFail(error, vt_errorFormat, "picture '%s' ends within its PFM header; write it again", name);
    }
    const long columns = strtol(columnsWord, NULL, 10), rows = strtol(rowsWord, NULL, 10);
    const double scale = strtod(scaleWord, NULL);
    if (columns < 1 || rows < 1 || columns > VT_MAX_IMAGE_SIDE || rows > VT_MAX_IMAGE_SIDE ||
        !(scale != 0.0)) {
        return vtFail(error, vt_errorFormat,
                      "picture '%s' has the PFM header '%s %s %s', but sides must be 1 to %d and the scale "
                      "not 0; write it again",
                      name, columnsWord, rowsWord, scaleWord, VT_MAX_IMAGE_SIDE);
    }
    const size_t offset = at + 1, rowFloats = (size_t)columns * 3, count = rowFloats * (size_t)rows;
    if ((size - offset) / 4 < count) {
        return vtFail(error, vt_errorFormat,
                      "picture '%s' holds %zu bytes of pixels where %ld x %ld need %zu; it is "
                      "truncated, so write it again",
                      name, size - offset, columns, rows, count * 4);
    }
    float* values = malloc(count * sizeof *values);
    if (values == NULL) {
        return vtFail(error, vt_errorMemory, "no memory for the %ld x %ld pixels of picture '%s'", columns,
                      rows, name);
    }
    for (long row = 0; row < rows; ++row) {
        const uint8_t* from = octets + offset + (size_t)(rows - 1 - row) * rowFloats * 4;
        for (size_t i = 0; i < rowFloats; ++i) {
            values[(size_t)row * rowFloats + i] = loadFloat(from + 4 * i, scale < 0.0);
        }
    }
    *rgb = values;
    *width = (int)columns;
    *height = (int)rows;
    return vtSucceed(error);
}
