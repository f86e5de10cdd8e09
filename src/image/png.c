// PNG through libpng, which leaves by longjmp where it fails; all that it then leaves behind is in Reader or
// Writer, from where it is given back.
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "image/image.h"
#include "image/image_checks.h"
#include "image/raster.h"

/// What libpng's calls come back with.
typedef struct Outcome {
    jmp_buf escape;
    bool memoryWasOut;
    char reason[128];
} Outcome;

static png_voidp allocate(png_structp png, png_alloc_size_t size)
{
    Outcome* outcome = png_get_mem_ptr(png);
    void* memory = vtAllocate(1, size);
    outcome->memoryWasOut = outcome->memoryWasOut || memory == NULL;
    return memory;
}

static void release(png_structp png, png_voidp memory)
{
    (void)png;
    vtFree(memory);
}

static void leave(png_structp png, png_const_charp reason)
{
    Outcome* outcome = png_get_error_ptr(png);
    strncpy(outcome->reason, reason, sizeof outcome->reason - 1);
    longjmp(outcome->escape, 1);
}

/// Warnings: what they are about is not looked at, or its checksum is wrong, which is an error here.
static void pass(png_structp png, png_const_charp reason)
{
    (void)png, (void)reason;
}

// ------------------------------------------------------------------------------------------------ reading

/// No better ratio of sizes is possible by RFC 1951.
enum { bestDeflate = 1032 };

typedef struct Reader {
    Outcome outcome;
    const vtPictureFile* file;
    size_t at;
    png_structp png;
    png_infop info;
} Reader;

static void readBytes(png_structp png, png_bytep to, size_t size)
{
    Reader* reader = png_get_io_ptr(png);
    if (size > reader->file->size - reader->at) {
        png_error(png, "it is cut off");
    }
    memcpy(to, reader->file->bytes + reader->at, size);
    reader->at += size;
}

/// The header; then to samples of 8 or 16 bits, no palette, transparency as alpha. Colours stay as they are:
/// glTF wants gAMA and iCCP not to be looked at, nor is what else a picture may tell of itself.
static void readHeader(Reader* reader)
{
    png_structp png = reader->png;
    png_set_read_fn(png, reader, readBytes);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX); // vtBeginRaster has a sentence
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, NULL, -1);
    png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_read_info(png, reader->info);
    const size_t packed =
        png_get_rowbytes(png, reader->info) * (size_t)png_get_image_height(png, reader->info);
    if (packed / bestDeflate > reader->file->size) {
        png_error(png, "it is cut off");
    }
    png_set_expand(png);
}

static void readRows(Reader* reader, const vtRaster* raster)
{
    png_structp png = reader->png;
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, reader->info);
    const size_t stride = png_get_rowbytes(png, reader->info);
    if (stride != (size_t)raster->width * (size_t)raster->channels * (size_t)raster->bits / 8) {
        png_error(png, "its rows have an unknown layout");
    }
    for (int i = 0; i < passes; ++i) {
        for (int row = 0; row < raster->height; ++row) {
            png_read_row(png, (png_bytep)raster->samples + (size_t)row * stride, NULL);
        }
    }
    png_read_end(png, NULL); // whether there is an end
}

static vtResult readPng(Reader* reader, vtRaster* raster, vtError* error)
{
    if (setjmp(reader->outcome.escape) != 0) {
        return reader->outcome.memoryWasOut
                   ? vtFailPictureMemory(reader->file, error)
                   : vtFailPicture(reader->file, "PNG", reader->outcome.reason, error);
    }
    readHeader(reader);
    const int type = png_get_color_type(reader->png, reader->info);
    const bool isColor = (type & PNG_COLOR_MASK_COLOR) != 0;
    const bool hasAlpha =
        (type & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(reader->png, reader->info, PNG_INFO_tRNS) != 0;
    const vtResult result =
        vtBeginRaster(reader->file, (long)png_get_image_width(reader->png, reader->info),
                      (long)png_get_image_height(reader->png, reader->info), (isColor ? 3 : 1) + hasAlpha,
                      png_get_bit_depth(reader->png, reader->info) == 16 ? 16 : 8, raster, error);
    if (result == vt_ok) {
        readRows(reader, raster);
    }
    return result;
}

/// A PNG's 16 bits begin with the upper 8.
static void orderBytes(vtRaster* raster)
{
    uint16_t* samples = raster->samples;
    const size_t count = (size_t)raster->width * (size_t)raster->height * (size_t)raster->channels;
    for (size_t i = 0; i < count; ++i) {
        uint8_t bytes[2];
        memcpy(bytes, samples + i, 2);
        samples[i] = (uint16_t)(bytes[0] << 8 | bytes[1]);
    }
}

vtResult vtDecodePngRaster(const vtPictureFile* file, vtRaster* raster, vtError* error)
{
    Reader reader = {.file = file};
    *raster = (vtRaster){0};
    reader.png = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &reader.outcome, leave, pass,
                                          &reader.outcome, allocate, release);
    reader.info = reader.png != NULL ? png_create_info_struct(reader.png) : NULL;
    const vtResult result =
        reader.info != NULL ? readPng(&reader, raster, error) : vtFailPictureMemory(file, error);
    png_destroy_read_struct(&reader.png, &reader.info, NULL);
    if (result != vt_ok) {
        vtDestroyRaster(raster);
    } else if (raster->bits == 16) {
        orderBytes(raster);
    }
    return result;
}

// ------------------------------------------------------------------------------------------------ writing

typedef struct Writer {
    Outcome outcome;
    uint8_t* bytes;
    size_t size, capacity;
    png_structp png;
    png_infop info;
} Writer;

static void writeBytes(png_structp png, png_bytep from, size_t size)
{
    Writer* writer = png_get_io_ptr(png);
    if (size > writer->capacity - writer->size) {
        const size_t capacity = 2 * (writer->capacity + size);
        uint8_t* bytes = vtReallocate(writer->bytes, capacity, 1);
        if (bytes == NULL) {
            png_error(png, "no memory");
        }
        writer->bytes = bytes;
        writer->capacity = capacity;
    }
    memcpy(writer->bytes + writer->size, from, size);
    writer->size += size;
}

static void flushBytes(png_structp png)
{
    (void)png;
}

static bool writePng(Writer* writer, const void* pixels, int channels, int bits, int width, int height,
                     const char* comment)
{
    char key[] = "Comment", text[128];
    if (setjmp(writer->outcome.escape) != 0) {
        return false;
    }
    const int type = channels == 1   ? PNG_COLOR_TYPE_GRAY
                     : channels == 3 ? PNG_COLOR_TYPE_RGB
                                     : PNG_COLOR_TYPE_RGBA;
    png_structp png = writer->png;
    png_set_write_fn(png, writer, writeBytes, flushBytes);
    png_set_IHDR(png, writer->info, (png_uint_32)width, (png_uint_32)height, bits, type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (comment != NULL) {
        snprintf(text, sizeof text, "%s", comment);
        png_set_text(png, writer->info,
                     &(png_text){.compression = PNG_TEXT_COMPRESSION_NONE, .key = key, .text = text}, 1);
    }
    png_write_info(png, writer->info);
    const uint16_t one = 1;
    if (bits == 16 && *(const uint8_t*)&one == 1) {
        png_set_swap(png); // the file begins with the upper byte
    }
    const size_t stride = (size_t)width * (size_t)channels * (size_t)(bits / 8);
    for (int row = 0; row < height; ++row) {
        png_write_row(png, (png_const_bytep)pixels + (size_t)row * stride);
    }
    png_write_end(png, NULL);
    return true;
}

vtResult vtEncodePngOf(const void* pixels, int channels, int bits, int width, int height, const char* comment,
                       uint8_t** bytes, size_t* size, vtError* error)
{
    *bytes = NULL;
    *size = 0;
    if (vtCheckWritten(width, height, error) != vt_ok) {
        return vt_errorArgument;
    }
    Writer writer = {0};
    writer.png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, &writer.outcome, leave, pass,
                                           &writer.outcome, allocate, release);
    writer.info = writer.png != NULL ? png_create_info_struct(writer.png) : NULL;
    const bool written =
        writer.info != NULL && writePng(&writer, pixels, channels, bits, width, height, comment);
    png_destroy_write_struct(&writer.png, &writer.info);
    if (!written) { // nothing else can fail
        vtFree(writer.bytes);
        return vtFail(error, vt_errorMemory, "no memory to write a PNG of %d x %d pixels", width, height);
    }
    *bytes = writer.bytes;
    *size = writer.size;
    return vtSucceed(error);
}

vtResult vtEncodePng(const uint8_t* pixels, int channels, int width, int height, uint8_t** bytes,
                     size_t* size, vtError* error)
{
    return vtEncodePngOf(pixels, channels, 8, width, height, NULL, bytes, size, error);
}
