// PNG files made by hand, of any kind, with right checksums: the encoder under test writes only one kind.
#pragma once

#include "testing.h"

/// Of PNG, section D: CRC-32.
static inline uint32_t pngChecksum(const uint8_t* bytes, size_t size)
{
    uint32_t sum = 0xFFFFFFFFu;
    for (size_t i = 0; i < size; ++i) {
        sum ^= bytes[i];
        for (int k = 0; k < 8; ++k) {
            sum = (sum >> 1) ^ ((sum & 1) != 0 ? 0xEDB88320u : 0);
        }
    }
    return ~sum;
}

static inline uint8_t* putNumber(uint8_t* to, uint32_t number)
{
    for (int i = 0; i < 4; ++i) {
        *to++ = (uint8_t)(number >> (24 - 8 * i));
    }
    return to;
}

static inline uint8_t* putChunk(uint8_t* to, const char* type, const uint8_t* data, size_t size)
{
    uint8_t* at = putNumber(to, (uint32_t)size);
    memcpy(at, type, 4);
    memmove(at + 4, data, size);
    return putNumber(at + 4 + size, pngChecksum(at, size + 4));
}

typedef struct PngCase {
    uint32_t width, height;
    uint8_t bits, type; ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
    bool interlaced;
    const uint8_t *palette, *transparency; ///< PLTE and tRNS, or NULL
    size_t paletteSize, transparencySize;
    const uint8_t* rows; ///< each begins with its filter
    size_t rowsSize;     ///< below 4096
} PngCase;

/// The file's size; its pixels are stored, not compressed.
static inline size_t putPng(uint8_t* to, const PngCase* png)
{
    static const uint8_t signature[8] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10};
    uint8_t header[13] = {[8] = png->bits, png->type, 0, 0, png->interlaced};
    putNumber(putNumber(header, png->width), png->height);
    uint8_t data[4096 + 11] = {0x78, 1, 1, (uint8_t)png->rowsSize, (uint8_t)(png->rowsSize >> 8)};
    assert_true(png->rowsSize <= 4096);
    data[5] = (uint8_t)~data[3];
    data[6] = (uint8_t)~data[4];
    memcpy(data + 7, png->rows, png->rowsSize);
    uint32_t low = 1, high = 0; // of RFC 1950: Adler-32
    for (size_t i = 0; i < png->rowsSize; ++i) {
        low = (low + png->rows[i]) % 65521;
        high = (high + low) % 65521;
    }
    putNumber(data + 7 + png->rowsSize, high << 16 | low);

    memcpy(to, signature, sizeof signature);
    uint8_t* at = putChunk(to + sizeof signature, "IHDR", header, sizeof header);
    if (png->palette != NULL) {
        at = putChunk(at, "PLTE", png->palette, png->paletteSize);
    }
    if (png->transparency != NULL) {
        at = putChunk(at, "tRNS", png->transparency, png->transparencySize);
    }
    at = putChunk(at, "IDAT", data, png->rowsSize + 11);
    return (size_t)(putChunk(at, "IEND", data, 0) - to);
}
