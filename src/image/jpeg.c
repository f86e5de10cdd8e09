// JPEG through libjpeg-turbo, whose own memory comes from malloc. It leaves by longjmp where it fails. What
// it only warns of is an error, too, where it then makes up pixels: a part of the picture is missing.
#include <setjmp.h>
#include <stdio.h>
#include <string.h>

// jpeglib.h asks for what stdio.h declares.
#include <jpeglib.h>
// jerror.h asks for what jpeglib.h declares.
#include <jerror.h>

#include "base/error.h"
#include "image/raster.h"

/// Each scan of a progressive picture goes through all its pixels: one of a few kilobytes could take minutes.
/// Encoders write about ten.
static int mostScans(const struct jpeg_decompress_struct* jpeg)
{
    const uint64_t pixels = (uint64_t)jpeg->image_width * jpeg->image_height, most = 1 << 28;
    return pixels * 100 <= most ? 100 : pixels * 20 >= most ? 20 : (int)(most / pixels);
}

typedef struct Reader {
    struct jpeg_error_mgr errors; // first, so that libjpeg's pointer to it is one to Reader
    struct jpeg_progress_mgr progress;
    struct jpeg_decompress_struct jpeg;
    jmp_buf escape;
    const vtPictureFile* file;
    bool memoryWasOut;
    char reason[JMSG_LENGTH_MAX];
} Reader;

static void leave(j_common_ptr jpeg)
{
    Reader* reader = (Reader*)jpeg->err;
    reader->memoryWasOut = jpeg->err->msg_code == JERR_OUT_OF_MEMORY;
    if (reader->reason[0] == '\0') {
        jpeg->err->format_message(jpeg, reader->reason);
    }
    longjmp(reader->escape, 1);
}

static void hear(j_common_ptr jpeg, int level)
{
    if (level >= 0) {
        return; // told for information
    }
    switch (jpeg->err->msg_code) {
    case JWRN_ARITH_BAD_CODE:
    case JWRN_HIT_MARKER:
    case JWRN_HUFF_BAD_CODE:
    case JWRN_JPEG_EOF:
    case JWRN_MUST_RESYNC:
        leave(jpeg);
        break;
    default: // bytes too many, odd versions
        break;
    }
}

static void watch(j_common_ptr jpeg)
{
    Reader* reader = (Reader*)jpeg->err;
    if (reader->jpeg.input_scan_number > mostScans(&reader->jpeg)) {
        snprintf(reader->reason, sizeof reader->reason, "it has more than %d scans",
                 mostScans(&reader->jpeg));
        leave(jpeg);
    }
}

/// Of ink: 255 is none of it if Adobe wrote it, all of it otherwise.
static void inkToLight(const Reader* reader, const uint8_t* cmyk, uint8_t* rgb)
{
    const int flip = reader->jpeg.saw_Adobe_marker ? 0 : 255;
    const int key = cmyk[3] ^ flip;
    for (int k = 0; k < 3; ++k) {
        rgb[k] = (uint8_t)(((cmyk[k] ^ flip) * key + 127) / 255);
    }
}

static void readRows(Reader* reader, const vtRaster* raster)
{
    struct jpeg_decompress_struct* jpeg = &reader->jpeg;
    const size_t width = (size_t)raster->width, stride = width * (size_t)raster->channels;
    const bool isInk = jpeg->out_color_space == JCS_CMYK;
    JSAMPROW ink = isInk ? jpeg->mem->alloc_large((j_common_ptr)jpeg, JPOOL_IMAGE, 4 * width) : NULL;
    while (jpeg->output_scanline < jpeg->output_height) {
        uint8_t* row = (uint8_t*)raster->samples + (size_t)jpeg->output_scanline * stride;
        JSAMPROW to = isInk ? ink : row;
        jpeg_read_scanlines(jpeg, &to, 1);
        for (size_t i = 0; isInk && i < width; ++i) {
            inkToLight(reader, ink + 4 * i, row + 3 * i);
        }
    }
    jpeg_finish_decompress(jpeg); // whether there is an end
}

static vtResult readJpeg(Reader* reader, vtRaster* raster, vtError* error)
{
    if (setjmp(reader->escape) != 0) {
        return reader->memoryWasOut ? vtFailPictureMemory(reader->file, error)
                                    : vtFailPicture(reader->file, "JPEG", reader->reason, error);
    }
    struct jpeg_decompress_struct* jpeg = &reader->jpeg;
    jpeg_create_decompress(jpeg);
    jpeg->progress = &reader->progress;
    jpeg_mem_src(jpeg, reader->file->bytes, (unsigned long)reader->file->size);
    jpeg_read_header(jpeg, TRUE);
    const J_COLOR_SPACE space = jpeg->jpeg_color_space;
    jpeg->out_color_space = space == JCS_GRAYSCALE                   ? JCS_GRAYSCALE
                            : space == JCS_CMYK || space == JCS_YCCK ? JCS_CMYK
                                                                     : JCS_RGB;
    const vtResult result = vtBeginRaster(reader->file, (long)jpeg->image_width, (long)jpeg->image_height,
                                          space == JCS_GRAYSCALE ? 1 : 3, 8, raster, error);
    if (result == vt_ok) {
        jpeg_start_decompress(jpeg);
        readRows(reader, raster);
    }
    return result;
}

vtResult vtDecodeJpegRaster(const vtPictureFile* file, vtRaster* raster, vtError* error)
{
    Reader reader = {.file = file, .progress.progress_monitor = watch};
    *raster = (vtRaster){0};
    reader.jpeg.err = jpeg_std_error(&reader.errors);
    reader.errors.error_exit = leave;
    reader.errors.emit_message = hear;
    const vtResult result = readJpeg(&reader, raster, error);
    jpeg_destroy_decompress(&reader.jpeg);
    if (result != vt_ok) {
        vtDestroyRaster(raster);
    }
    return result;
}
