#include "image/image.h"
#include "base/about.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/error.h"
#include "base/limits.h"
#include "base/memory.h"
#include "image/image_checks.h"
#include "image/pfm.h"
#include "image/raster.h"

#define VT_LARGEST_HALF 65504.0f

float vtSrgbToLinear(float encoded)
{
    return encoded <= 0.04045f ? encoded / 12.92f : powf((encoded + 0.055f) / 1.055f, 2.4f);
}

float vtLinearToSrgb(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1.0f / 2.4f) - 0.055f;
}

// ----------------------------------------------------------------------------------------------- formats

#ifdef VT_HDR_ONLY // web/CMakeLists.txt: a browser decodes the others itself
#define VT_NATIVE(decoder) NULL
#else
#define VT_NATIVE(decoder) decoder
#endif

typedef struct Format {
    char name[9];
    char beginning[9];
    uint8_t length;   ///< of its beginning
    bool inMaterials; ///< 8 or 16 bits, as glTF has them
    vtDecoder* decode;
} Format;

static const Format formats[] = {
    {"PNG", "\x89PNG\r\n\x1a\n", 8, true, VT_NATIVE(vtDecodePngRaster)},
    {"JPEG", "\xFF\xD8\xFF", 3, true, VT_NATIVE(vtDecodeJpegRaster)},
    {"WebP", "RIFF", 4, true, VT_NATIVE(vtDecodeWebpRaster)},
#ifdef VT_HDR_ONLY
    {"AVIF", "ftyp", 4, true, NULL}, // behind four bytes
    {"KTX 2", "\xABKTX 20\xBB", 8, true, NULL},
#endif
    {"OpenEXR", "\x76\x2f\x31\x01", 4, false, VT_NATIVE(vtDecodeExrRaster)},
    {"HDR", "#?", 2, false, vtDecodeHdrRaster},
    {"PFM", "PF", 2, false, vtDecodePfmRaster},
    {"PFM", "Pf", 2, false, vtDecodePfmRaster},
};
enum { formatCount = sizeof formats / sizeof formats[0] };

/// By how the file begins, whatever its name; NULL: none of them.
static const Format* findFormat(const uint8_t* bytes, size_t size)
{
    for (int i = 0; i < formatCount; ++i) {
        const Format* format = &formats[i];
        const size_t at = format->beginning[0] == 'f' ? 4 : 0;
        const bool begins =
            size >= at + format->length && memcmp(bytes + at, format->beginning, format->length) == 0;
        if (begins && (format->beginning[0] != 'R' || (size >= 12 && memcmp(bytes + 8, "WEBP", 4) == 0)) &&
            (format->beginning[0] != 'P' || vtIsPfm(bytes, size))) {
            return format;
        }
    }
    return NULL;
}

bool vtIsPicture(const void* bytes, size_t size)
{
    return findFormat(bytes, size) != NULL;
}

static vtResult decode(const vtPictureFile* file, vtRaster* raster, vtError* error)
{
    const char* what = file->isRelief ? "relief" : "picture";
    *raster = (vtRaster){0};
    const Format* format = findFormat(file->bytes, file->size);
    if (format == NULL) {
        return vtFail(error, vt_errorFormat,
                      "%s '%.300s' %s; give a PNG, JPEG, WebP, OpenEXR, Radiance HDR or PFM file", what,
                      file->name, file->size == 0 ? "is empty" : "is no picture that can be read");
    }
#ifdef VT_HDR_ONLY
    if (format->decode == NULL) {
        return vtFail(
            error, vt_errorFormat,
            format->inMaterials
                ? "%s '%.300s' is a %s that the browser could not decode; it is damaged, so save it again"
                : "%s '%.300s' is %s that element/exr.js could not decode, or it is missing; save it as "
                  "Radiance HDR",
            what, file->name, format->name);
    }
#endif
    return format->decode(file, raster, error);
}

vtResult vtCheckPictureSize(const char* name, long width, long height, size_t bytesPerPixel,
                            const vtLimits* limits, vtError* error)
{
    const vtLimits most = vtResolveLimits(limits);
    const uint64_t count = (uint64_t)width * (uint64_t)height, needed = count * bytesPerPixel;
    if (count > most.pixels) {
        return vtFail(error, vt_errorFormat,
                      "picture '%.300s' is %ld x %ld pixels, but at most %llu are read; scale it "
                      "down" VT_ALLOW("--max-pixels"),
                      name, width, height, (unsigned long long)most.pixels);
    }
    if (needed > most.memory) {
        return vtFail(
            error, vt_errorMemory,
            "picture '%.300s' of %ld x %ld pixels takes %llu bytes, but a file may take %llu; scale it "
            "down" VT_ALLOW("--max-memory"),
            name, width, height, (unsigned long long)needed, (unsigned long long)most.memory);
    }
    return vtSucceed(error);
}

vtResult vtCheckPicture(const void* bytes, size_t size, const char* name, const vtLimits* limits,
                        size_t bytesPerPixel, uint64_t* pixels, vtError* error)
{
    vtPictureHeader header = {0};
    const vtPictureFile file = {bytes, size, name != NULL ? name : "", false, &header};
    vtRaster raster;
    if (decode(&file, &raster, NULL) == vt_ok) {
        vtDestroyRaster(&raster);
    }
    const bool isKnown = header.width > 0 && header.height > 0 && header.width <= VT_MAX_IMAGE_SIDE &&
                         header.height <= VT_MAX_IMAGE_SIDE;
    const long width = isKnown ? header.width : 0, height = isKnown ? header.height : 0;
    if (pixels != NULL) {
        *pixels = (uint64_t)width * (uint64_t)height;
    }
    return vtCheckPictureSize(file.name, width, height, (size_t)header.bytesPerPixel + bytesPerPixel, limits,
                              error);
}

// ------------------------------------------------------------------------------------------------- light

static void sanitise(float* values, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        float value = values[i];
        values[i] = value > 0.0f ? fminf(value, VT_LARGEST_HALF) : 0.0f; // NaN fails the comparison
    }
}

static size_t pixelsOf(const vtRaster* raster)
{
    return (size_t)raster->width * (size_t)raster->height;
}

/// What of 16 bits is not compiled in where nothing gives them.
static bool isOf16Bits(const vtRaster* raster)
{
#ifdef VT_HDR_ONLY
    (void)raster;
    return false;
#else
    return raster->bits == 16;
#endif
}

/// Three linear floats a pixel. Of floats none is taken as sRGB.
static void linearise(const vtRaster* raster, float* to)
{
    float table[256];
    for (int i = 0; i < 256; ++i) {
        table[i] = vtSrgbToLinear((float)i / 255.0f);
    }
    const size_t channels = (size_t)raster->channels, count = pixelsOf(raster);
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < 3; ++k) {
            const size_t at = channels * i + (channels < 3 ? 0 : k);
            *to++ = raster->bits == 8 ? table[((const uint8_t*)raster->samples)[at]]
                    : isOf16Bits(raster)
                        ? vtSrgbToLinear((float)((const uint16_t*)raster->samples)[at] / 65535.0f)
                        : ((const float*)raster->samples)[at];
        }
    }
}

/// The raster's, which it takes over or gives back.
static vtResult toLinear(const vtPictureFile* file, vtRaster* raster, float** pixels, vtError* error)
{
    float* values = raster->bits == 32 && raster->channels == 3 ? raster->samples : NULL;
    if (values == NULL) {
        values = vtAllocate(pixelsOf(raster), 3 * sizeof *values);
        if (values != NULL) {
            linearise(raster, values);
        }
        vtFree(raster->samples);
    }
    if (values == NULL) {
        return vtFailPictureMemory(file, error);
    }
    sanitise(values, 3 * pixelsOf(raster));
    *pixels = values;
    return vtSucceed(error);
}

vtResult vtLinearise(const uint8_t* samples, int channels, const char* name, int width, int height,
                     float** pixels, vtError* error)
{
    assert(samples != NULL && pixels != NULL && channels >= 3);
    *pixels = NULL;
    const vtPictureFile file = {.name = name != NULL ? name : ""};
    if (vtCheckPictureSides(file.name, width, height, error) != vt_ok) {
        return vt_errorFormat;
    }
    const vtRaster raster = {(uint8_t*)(uintptr_t)samples, width, height, channels, 8};
    *pixels = vtAllocate(pixelsOf(&raster), 3 * sizeof **pixels);
    if (*pixels == NULL) {
        return vtFailPictureMemory(&file, error);
    }
    linearise(&raster, *pixels);
    return vtSucceed(error);
}

vtResult vtDecodeImageLinear(const void* bytes, size_t size, const char* name, float** pixels, int* width,
                             int* height, vtError* error)
{
    assert(pixels != NULL && width != NULL && height != NULL && (bytes != NULL || size == 0));
    *pixels = NULL;
    *width = *height = 0;
    const vtPictureFile file = {bytes, size, name != NULL ? name : "", false, NULL};
    vtRaster raster;
    vtResult result = decode(&file, &raster, error);
    if (result == vt_ok) {
        result = toLinear(&file, &raster, pixels, error);
    }
    if (result == vt_ok) {
        *width = raster.width;
        *height = raster.height;
    }
    return result;
}

// -------------------------------------------------------------------------------------------- materials

#ifdef VT_HDR_ONLY
static vtResult fillImage(const vtPictureFile* file, vtImage* image, vtError* error)
{
    image->bytes = vtAllocate(1, file->size);
    if (image->bytes == NULL) {
        return vtFailPictureMemory(file, error);
    }
    memcpy(image->bytes, file->bytes, file->size);
    image->size = file->size;
    return vtSucceed(error);
}
#else
/// RGBA; of 16 bits the upper 8.
static void toRgba(const vtRaster* raster, uint8_t* to)
{
    const size_t channels = (size_t)raster->channels, count = pixelsOf(raster);
    const bool hasAlpha = channels % 2 == 0;
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < 4; ++k) {
            const size_t at = channels * i + (k == 3 ? channels - 1 : channels < 3 ? 0 : k);
            const uint32_t sample = raster->bits == 8 ? ((const uint8_t*)raster->samples)[at]
                                                      : ((const uint16_t*)raster->samples)[at] >> 8;
            *to++ = k == 3 && !hasAlpha ? 255 : (uint8_t)sample;
        }
    }
}

static vtResult fillImage(const vtPictureFile* file, vtImage* image, vtError* error)
{
    vtRaster raster;
    const vtResult result = decode(file, &raster, error);
    if (result != vt_ok) {
        return result;
    }
    image->width = raster.width;
    image->height = raster.height;
    if (raster.bits == 8 && raster.channels == 4) {
        image->pixels = raster.samples;
        return vtSucceed(error);
    }
    image->pixels = vtAllocate(pixelsOf(&raster), 4);
    if (image->pixels != NULL) {
        toRgba(&raster, image->pixels);
    }
    vtDestroyRaster(&raster);
    return image->pixels != NULL ? vtSucceed(error) : vtFailPictureMemory(file, error);
}
#endif

vtResult vtDecodeImage(const void* bytes, size_t size, const char* name, vtImage* image, vtError* error)
{
    assert(image != NULL && (bytes != NULL || size == 0));
    *image = (vtImage){0};
    const vtPictureFile file = {bytes, size, name != NULL ? name : "", false, NULL};
    const Format* format = findFormat(bytes, size);
    if (format == NULL || !format->inMaterials) {
        return vtFail(
            error, vt_errorFormat,
            "picture '%.300s' is neither PNG, JPEG nor WebP; it is damaged or of another format, so save it "
            "again as one of these",
            file.name);
    }
    const vtResult result = fillImage(&file, image, error);
    if (result != vt_ok) {
        *image = (vtImage){0};
    }
    return result;
}

// ----------------------------------------------------------------------------------------------- heights

/// Numbers as the file has them, which for heights are no colours.
static float heightOf(const vtRaster* raster, size_t pixel)
{
    const size_t at = (size_t)raster->channels * pixel;
    const bool isGrey = raster->channels < 3;
#ifndef VT_HDR_ONLY
    if (raster->bits != 32) {
        uint32_t numbers[3];
        for (size_t k = 0; k < 3; ++k) {
            const size_t from = at + (isGrey ? 0 : k);
            numbers[k] = isOf16Bits(raster) ? ((const uint16_t*)raster->samples)[from]
                                            : ((const uint8_t*)raster->samples)[from];
        }
        return (float)vtLumaOfSamples(numbers[0], numbers[1], numbers[2]) /
               (isOf16Bits(raster) ? 65535.0f : 255.0f);
    }
#endif
    const float* samples = (const float*)raster->samples + at;
    return isGrey ? samples[0] : vtLuma(samples);
}

vtResult vtDecodeHeights(const void* bytes, size_t size, const char* name, float** heights, int* width,
                         int* height, int* bits, vtError* error)
{
    assert(heights != NULL && width != NULL && height != NULL && bits != NULL &&
           (bytes != NULL || size == 0));
    *heights = NULL;
    *width = *height = 0;
    *bits = 32;
    const vtPictureFile file = {bytes, size, name != NULL ? name : "", true, NULL};
    vtRaster raster;
    const vtResult result = decode(&file, &raster, error);
    if (result != vt_ok) {
        return result;
    }
    *heights = vtAllocate(pixelsOf(&raster), sizeof **heights);
    for (size_t i = 0; *heights != NULL && i < pixelsOf(&raster); ++i) {
        (*heights)[i] = heightOf(&raster, i);
    }
    if (*heights != NULL) {
        *width = raster.width;
        *height = raster.height;
        *bits = raster.bits;
    }
    vtDestroyRaster(&raster);
    return *heights != NULL ? vtSucceed(error) : vtFailPictureMemory(&file, error);
}
