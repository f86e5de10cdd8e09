// What every decoder of pictures must pass: cut files and damaged ones.
#pragma once

#include "image/image.h"
#include "testing.h"

/// A file of tests/cases; the caller frees it.
static inline uint8_t* loadCase(const char* name, size_t* size)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", VT_CASES, name);
    FILE* stream = fopen(path, "rb");
    if (stream == NULL) {
        fail_msg("%s cannot be opened", path);
    }
    uint8_t* bytes = malloc(1 << 20);
    *size = fread(bytes, 1, 1 << 20, stream);
    fclose(stream);
    return bytes;
}

/// In its own allocation, so that a sanitizer sees every byte too far.
static inline uint8_t* copyOf(const uint8_t* bytes, size_t size)
{
    uint8_t* copy = malloc(size > 0 ? size : 1);
    if (size > 0) {
        memcpy(copy, bytes, size);
    }
    return copy;
}

/// Decodes as light, as a texture and as heights; each is a picture or a sentence. The result as light.
static inline vtResult decodeAll(const uint8_t* bytes, size_t size, vtError* error)
{
    uint8_t* copy = copyOf(bytes, size);
    float *light = NULL, *heights = NULL;
    int width = 0, height = 0, bits = 0;
    vtImage image;
    vtError other = {0};
    vtResult result = vtDecodeImage(copy, size, "file", &image, &other);
    assert_true((result == vt_ok) == (image.pixels != NULL) &&
                (result == vt_ok) == (other.message[0] == '\0'));
    result = vtDecodeHeights(copy, size, "file", &heights, &width, &height, &bits, &other);
    assert_true((result == vt_ok) == (heights != NULL) && (result == vt_ok) == (other.message[0] == '\0'));
    result = vtDecodeImageLinear(copy, size, "file", &light, &width, &height, error);
    assert_true((result == vt_ok) == (light != NULL) && (result == vt_ok) == (error->message[0] == '\0'));
    vtFree(image.pixels);
    vtFree(heights);
    vtFree(light);
    free(copy);
    return result;
}

/// However much of its end is missing, the file is refused by its name. `enough` bytes hold all of the
/// picture.
static inline void refusesCuts(const uint8_t* bytes, size_t enough)
{
    for (size_t length = 0; length < enough; ++length) {
        vtError error = {0};
        if (decodeAll(bytes, length, &error) != vt_errorFormat || strstr(error.message, "'file'") == NULL) {
            fail_msg("the first %zu of %zu bytes are taken: '%s'", length, enough, error.message);
        }
    }
}

/// `count` files, each with some bits or bytes changed.
static inline void survivesDamage(const uint8_t* bytes, size_t size, int count)
{
    uint8_t* damaged = malloc(size);
    uint32_t random = 12345;
    for (int i = 0; i < count; ++i) {
        memcpy(damaged, bytes, size);
        for (int k = 0; k <= i % 3; ++k) {
            random = 1664525u * random + 1013904223u;
            const size_t at = (random >> 8) % size;
            random = 1664525u * random + 1013904223u;
            damaged[at] = (random >> 31) != 0 ? (uint8_t)(random >> 16)
                                              : (uint8_t)(damaged[at] ^ 1u << (random >> 28 & 7));
        }
        vtError error = {0};
        decodeAll(damaged, size, &error);
    }
    free(damaged);
}

static inline void expectSentence(const uint8_t* bytes, size_t size, const char* words)
{
    vtError error = {0};
    assert_int_equal(decodeAll(bytes, size, &error), vt_errorFormat);
    if (strstr(error.message, words) == NULL || strstr(error.message, "'file'") == NULL) {
        fail_msg("'%s' does not say '%s'", error.message, words);
    }
}

/// As light, of those sides.
static inline float* expectLight(const uint8_t* bytes, size_t size, int width, int height)
{
    float* light = NULL;
    int columns = 0, rows = 0;
    vtError error = {0};
    assert_ok(vtDecodeImageLinear(bytes, size, "file", &light, &columns, &rows, &error), error);
    assert_int_equal(columns, width);
    assert_int_equal(rows, height);
    return light;
}

/// As a texture: RGBA.
static inline void expectRgba(const uint8_t* bytes, size_t size, int width, int height, const uint8_t* rgba)
{
    vtImage image;
    vtError error = {0};
    assert_ok(vtDecodeImage(bytes, size, "file", &image, &error), error);
    assert_int_equal(image.width, width);
    assert_int_equal(image.height, height);
    assert_memory_equal(image.pixels, rgba, 4 * (size_t)width * (size_t)height);
    vtFree(image.pixels);
}
