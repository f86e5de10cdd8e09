#include "image/image.h"

#include <assert.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "image/image_checks.h"
#include "image/pfm.h"

/// stb copies nothing to nowhere for an empty chunk of a PNG, which C11 leaves undefined.
static inline void* copyBytes(void* to, const void* from, size_t size)
{
    return size > 0 ? memcpy(to, from, size) : to;
}

/// Whether stb lacked memory since decoding began. As its own reason for a failure it lives with the thread:
/// its macros know of no decoder, and its sentences speak of broken files then.
static _Thread_local bool memoryWasOut;

static void* note(void* memory)
{
    memoryWasOut = memoryWasOut || memory == NULL;
    return memory;
}

// stb's code is not ours to keep free of warnings. Static, so that an embedder's own copy does not clash;
// the declarations of the decoders left out then count as unused to the end of the file.
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#endif
#define STBI_MALLOC(size) note(vtAllocate(1, size))
#define STBI_REALLOC(memory, size) note(vtReallocate(memory, 1, size))
#define STBI_FREE(memory) vtFree(memory)
#define STBIW_MALLOC(size) vtAllocate(1, size)
#define STBIW_REALLOC(memory, size) vtReallocate(memory, 1, size)
#define STBIW_FREE(memory) vtFree(memory)
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
    float* values = vtAllocate(count, 3 * sizeof *values);
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
    if (memoryWasOut) {
        return vtFail(error, vt_errorMemory, "no memory to decode picture '%s'; scale it down", name);
    }
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
    *pixels = vtAllocate(count, sizeof **pixels);
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
    memoryWasOut = false;

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
    image->bytes = vtAllocate(1, (size_t)length);
    if (image->bytes == NULL) {
        return vtFail(error, vt_errorMemory, "no memory for the %d bytes of picture '%s'; scale it down",
                      length, name);
    }
    memcpy(image->bytes, bytes, (size_t)length);
    image->size = (size_t)length;
    return vtSucceed(error);
}
#else
/// RGBA. Of 16 bits the upper 8, as stb takes them, which loses the picture where memory is out.
static uint8_t* loadRgba(const uint8_t* bytes, int length, int* width, int* height)
{
    int channels = 0;
    if (!stbi_is_16_bit_from_memory(bytes, length)) {
        return stbi_load_from_memory(bytes, length, width, height, &channels, 4);
    }
    uint16_t* samples = stbi_load_16_from_memory(bytes, length, width, height, &channels, 4);
    const size_t count = samples != NULL ? 4 * (size_t)*width * (size_t)*height : 0;
    uint8_t* pixels = samples != NULL ? note(vtAllocate(count, 1)) : NULL;
    for (size_t i = 0; pixels != NULL && i < count; ++i) {
        pixels[i] = (uint8_t)(samples[i] >> 8);
    }
    stbi_image_free(samples);
    return pixels;
}

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
    image->pixels = loadRgba(bytes, length, &width, &height);
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
    memoryWasOut = false;
    return fillImage(bytes, (int)size, name, image, error);
}

// --------------------------------------------------------------------------------------------------- heights

bool vtIsPicture(const void* bytes, size_t size)
{
    const char* const beginnings[] = {"\x89PNG\r\n\x1a\n", "\xFF\xD8\xFF", "#?RADIANCE", "#?RGBE"};
    for (size_t i = 0; i < sizeof beginnings / sizeof beginnings[0]; ++i) {
        const size_t length = strlen(beginnings[i]);
        if (size >= length && memcmp(bytes, beginnings[i], length) == 0) {
            return true;
        }
    }
    return vtIsPfm(bytes, size);
}

#ifdef VT_HDR_ONLY
static float* loadHeights(const uint8_t* bytes, int length, int* width, int* height, int* bits)
{
    (void)bytes, (void)length, (void)width, (void)height, (void)bits;
    return NULL;
}
#else
/// PNG or JPEG of 8 or 16 bits: numbers as the file has them, which for heights are no colours.
static float* loadHeights(const uint8_t* bytes, int length, int* width, int* height, int* bits)
{
    int channels = 0;
    *bits = stbi_is_16_bit_from_memory(bytes, length) ? 16 : 8;
    uint8_t* bytes8 = NULL;
    uint16_t* bytes16 = NULL;
    if (*bits == 8) {
        bytes8 = stbi_load_from_memory(bytes, length, width, height, &channels, 1);
    } else {
        bytes16 = stbi_load_16_from_memory(bytes, length, width, height, &channels, 1);
    }
    float* heights = NULL;
    if (bytes8 != NULL || bytes16 != NULL) {
        const size_t count = (size_t)*width * (size_t)*height;
        heights = note(vtAllocate(count, sizeof *heights));
        for (size_t i = 0; heights != NULL && i < count; ++i) {
            heights[i] = bytes8 != NULL ? (float)bytes8[i] / 255.0f : (float)bytes16[i] / 65535.0f;
        }
    }
    stbi_image_free(bytes8);
    stbi_image_free(bytes16);
    return heights;
}
#endif

static float* loadHdrHeights(const uint8_t* bytes, int length, int* width, int* height)
{
    float* heights = loadHdr(bytes, length, width, height);
    const size_t count = heights != NULL ? (size_t)*width * (size_t)*height : 0;
    for (size_t i = 0; i < count; ++i) {
        heights[i] = vtLuma(heights + 3 * i);
    }
    return heights;
}

vtResult vtDecodeHeights(const void* bytes, size_t size, const char* name, float** heights, int* width,
                         int* height, int* bits, vtError* error)
{
    assert(heights != NULL && width != NULL && height != NULL && bits != NULL &&
           (bytes != NULL || size == 0));
    *heights = NULL;
    *width = *height = 0;
    *bits = 32;
    name = name != NULL ? name : "";
    if (vtIsPfm(bytes, size)) {
        return vtDecodePfmHeights(bytes, size, name, heights, width, height, error);
    }
    if (!vtIsPicture(bytes, size) || size > INT_MAX) {
        return vtFail(error, vt_errorFormat,
                      "relief '%.300s' %s; give heights as PNG, JPEG, Radiance HDR or PFM", name,
                      size == 0        ? "is empty"
                      : size > INT_MAX ? "is larger than 2 GB"
                                       : "is no picture that can be read");
    }
    const int length = (int)size;
    memoryWasOut = false;
    const bool isHdr = stbi_is_hdr_from_memory(bytes, length) != 0;
#ifdef VT_HDR_ONLY
    if (!isHdr) {
        return vtFail(error, vt_errorFormat,
                      "relief '%.300s' is a PNG or JPEG that the browser could not decode; it is damaged, so "
                      "save it again",
                      name);
    }
#endif
    int columns = 0, rows = 0, channels = 0;
    if (!stbi_info_from_memory(bytes, length, &columns, &rows, &channels)) {
        return failDecode(name, error);
    }
    if (vtCheckHeightSides(name, columns, rows, vt_errorFormat, error) != vt_ok) {
        return vt_errorFormat;
    }
    *heights = isHdr ? loadHdrHeights(bytes, length, width, height)
                     : loadHeights(bytes, length, width, height, bits);
    return *heights != NULL ? vtSucceed(error) : failDecode(name, error);
}

// ------------------------------------------------------------------------------------------------ writing

vtResult vtEncodePng(const uint8_t* pixels, int channels, int width, int height, uint8_t** bytes,
                     size_t* size, vtError* error)
{
    assert(pixels != NULL && bytes != NULL && size != NULL &&
           (channels == 1 || channels == 3 || channels == 4));
    *bytes = NULL;
    *size = 0;
    if (vtCheckWritten(width, height, error) != vt_ok) {
        return vt_errorArgument;
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
