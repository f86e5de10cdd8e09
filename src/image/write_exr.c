// OpenEXR written through the C library OpenEXRCore: scan lines of floats, ZIP compression, into memory.
#include <openexr.h>

#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "image/image.h"
#include "image/image_checks.h"

typedef struct Writer {
    uint8_t* bytes;
    size_t size, capacity;
    exr_context_t context;
} Writer;

static int64_t writeBytes(exr_const_context_t context, void* data, const void* from, uint64_t size,
                          uint64_t offset, exr_stream_error_func_ptr_t tell)
{
    (void)context, (void)tell;
    Writer* writer = data;
    const size_t end = (size_t)(offset + size);
    if (end > writer->capacity) {
        uint8_t* bytes = vtReallocate(writer->bytes, 2 * end, 1);
        if (bytes == NULL) {
            return -1;
        }
        writer->bytes = bytes;
        writer->capacity = 2 * end;
    }
    memcpy(writer->bytes + offset, from, (size_t)size);
    writer->size = end > writer->size ? end : writer->size;
    return (int64_t)size;
}

static exr_result_t writeHeader(const Writer* writer, int channels, int width, int height,
                                const char* comment)
{
    int part = 0;
    exr_context_t context = writer->context;
    exr_result_t code = exr_add_part(context, "picture", EXR_STORAGE_SCANLINE, &part);
    if (code == EXR_ERR_SUCCESS) {
        code = exr_initialize_required_attr_simple(context, part, width, height, EXR_COMPRESSION_ZIP);
    }
    const char* names = channels == 4 ? "ABGR" : "BGR"; // by the alphabet, as the file has them
    for (const char* at = names; *at != '\0' && code == EXR_ERR_SUCCESS; ++at) {
        code = exr_add_channel(context, part, (const char[2]){*at, '\0'}, EXR_PIXEL_FLOAT,
                               EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    }
    if (comment != NULL && code == EXR_ERR_SUCCESS) {
        code = exr_attr_set_string(context, part, "comments", comment);
    }
    return code == EXR_ERR_SUCCESS ? exr_write_header(context) : code;
}

/// The lines of a chunk, from `row` on.
static exr_result_t writeChunk(const Writer* writer, const float* pixels, int channels, int width, int row)
{
    exr_chunk_info_t chunk;
    exr_encode_pipeline_t pipeline = {0};
    exr_result_t code = exr_write_scanline_chunk_info(writer->context, 0, row, &chunk);
    code = code == EXR_ERR_SUCCESS ? exr_encoding_initialize(writer->context, 0, &chunk, &pipeline) : code;
    for (int i = 0; i < pipeline.channel_count && code == EXR_ERR_SUCCESS; ++i) {
        exr_coding_channel_info_t* channel = &pipeline.channels[i];
        const char* place = strchr("RGBA", channel->channel_name[0]);
        const float* from = pixels + (size_t)channels * (size_t)width * (size_t)row;
        channel->encode_from_ptr = (const uint8_t*)(from + (place - "RGBA"));
        channel->user_pixel_stride = channels * (int)sizeof(float);
        channel->user_line_stride = width * channel->user_pixel_stride;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
    }
    code =
        code == EXR_ERR_SUCCESS ? exr_encoding_choose_default_routines(writer->context, 0, &pipeline) : code;
    code = code == EXR_ERR_SUCCESS ? exr_encoding_run(writer->context, 0, &pipeline) : code;
    exr_encoding_destroy(writer->context, &pipeline);
    return code;
}

static void* allocate(size_t size)
{
    return vtAllocate(1, size);
}

/// OpenEXR's own words, which are meant for standard error; vtEncodeExr has a sentence.
static void drop(exr_const_context_t context, exr_result_t code, const char* message)
{
    (void)context, (void)code, (void)message;
}

static exr_result_t writeExr(Writer* writer, const float* pixels, int channels, int width, int height,
                             const char* comment)
{
    exr_context_initializer_t start = {.size = sizeof start,
                                       .error_handler_fn = drop,
                                       .alloc_fn = allocate,
                                       .free_fn = vtFree,
                                       .user_data = writer,
                                       .write_fn = writeBytes,
                                       .zip_level = -2,
                                       .dwa_quality = -1.0f};
    exr_result_t code = exr_start_write(&writer->context, "memory", EXR_WRITE_FILE_DIRECTLY, &start);
    code = code == EXR_ERR_SUCCESS ? writeHeader(writer, channels, width, height, comment) : code;
    int32_t lines = 1;
    code = code == EXR_ERR_SUCCESS ? exr_get_scanlines_per_chunk(writer->context, 0, &lines) : code;
    for (int row = 0; row < height && code == EXR_ERR_SUCCESS; row += lines) {
        code = writeChunk(writer, pixels, channels, width, row);
    }
    return code;
}

vtResult vtEncodeExr(const float* pixels, int channels, int width, int height, const char* comment,
                     uint8_t** bytes, size_t* size, vtError* error)
{
    *bytes = NULL;
    *size = 0;
    if (vtCheckWritten(width, height, error) != vt_ok) {
        return vt_errorArgument;
    }
    Writer writer = {0};
    exr_result_t code = writeExr(&writer, pixels, channels, width, height, comment);
    if (writer.context != NULL) {
        const exr_result_t ended = exr_finish(&writer.context);
        code = code == EXR_ERR_SUCCESS ? ended : code;
    }
    if (code != EXR_ERR_SUCCESS) { // nothing else can fail
        vtFree(writer.bytes);
        return vtFail(error, vt_errorMemory, "no memory to write an OpenEXR of %d x %d pixels", width,
                      height);
    }
    *bytes = writer.bytes;
    *size = writer.size;
    return vtSucceed(error);
}
