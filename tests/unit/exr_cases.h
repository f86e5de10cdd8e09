// OpenEXR files of any kind, written by OpenEXRCore into memory.
#pragma once

#include <openexr.h>

#include "testing.h"

typedef struct ExrCase {
    exr_attr_box2i_t data, display;
    const char* channels; ///< a letter each
    const char* prefix;   ///< of their names, or NULL
    exr_pixel_type_t type;
    exr_compression_t compression;
    int tile; ///< side of a tile; 0: scan lines
} ExrCase;

static inline exr_attr_box2i_t exrBox(int left, int top, int right, int bottom)
{
    exr_attr_box2i_t box;
    box.min.x = left;
    box.min.y = top;
    box.max.x = right;
    box.max.y = bottom;
    return box;
}

typedef struct ExrBytes {
    uint8_t bytes[1 << 16];
    size_t size;
} ExrBytes;

/// What is written for a channel at that place of the data window; a half, exactly.
static inline float exrValue(char channel, int x, int y)
{
    return (float)(channel - 'A') + (float)x / 8.0f + (float)y / 64.0f;
}

static int64_t exrWrite(exr_const_context_t context, void* data, const void* from, uint64_t size,
                        uint64_t offset, exr_stream_error_func_ptr_t tell)
{
    (void)context, (void)tell;
    ExrBytes* to = data;
    assert_true(offset + size <= sizeof to->bytes);
    memcpy(to->bytes + offset, from, size);
    to->size = offset + size > to->size ? offset + size : to->size;
    return (int64_t)size;
}

static inline void exrChunk(exr_context_t context, const exr_chunk_info_t* chunk, int left, int top)
{
    static float numbers[4][64 * 64];
    exr_encode_pipeline_t pipeline = {0};
    assert_int_equal(exr_encoding_initialize(context, 0, chunk, &pipeline), EXR_ERR_SUCCESS);
    for (int k = 0; k < pipeline.channel_count; ++k) {
        exr_coding_channel_info_t* channel = &pipeline.channels[k];
        const char letter = channel->channel_name[strlen(channel->channel_name) - 1];
        for (int i = 0; i < chunk->width * chunk->height; ++i) {
            numbers[k][i] = exrValue(letter, left + i % chunk->width, top + i / chunk->width);
            if (channel->data_type == EXR_PIXEL_UINT) {
                const uint32_t number = (uint32_t)numbers[k][i];
                memcpy(&numbers[k][i], &number, sizeof number);
            }
        }
        channel->encode_from_ptr = (const uint8_t*)numbers[k];
        channel->user_pixel_stride = channel->user_bytes_per_element = 4;
        channel->user_line_stride = 4 * chunk->width;
        channel->user_data_type = channel->data_type == EXR_PIXEL_UINT ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
    }
    assert_int_equal(exr_encoding_choose_default_routines(context, 0, &pipeline), EXR_ERR_SUCCESS);
    assert_int_equal(exr_encoding_run(context, 0, &pipeline), EXR_ERR_SUCCESS);
    exr_encoding_destroy(context, &pipeline);
}

static inline void exrChunks(exr_context_t context, const ExrCase* file)
{
    const int width = file->data.max.x - file->data.min.x + 1,
              height = file->data.max.y - file->data.min.y + 1;
    exr_chunk_info_t chunk;
    int32_t lines = file->tile;
    if (file->tile == 0) {
        exr_get_scanlines_per_chunk(context, 0, &lines);
    }
    for (int y = 0; y < height; y += lines) {
        if (file->tile == 0) {
            assert_int_equal(exr_write_scanline_chunk_info(context, 0, file->data.min.y + y, &chunk), 0);
            exrChunk(context, &chunk, 0, y);
        }
        for (int x = 0; file->tile != 0 && x < width; x += file->tile) {
            assert_int_equal(
                exr_write_tile_chunk_info(context, 0, x / file->tile, y / file->tile, 0, 0, &chunk), 0);
            exrChunk(context, &chunk, x, y);
        }
    }
}

static inline void putExr(ExrBytes* to, const ExrCase* file)
{
    to->size = 0;
    exr_context_initializer_t start = {
        .size = sizeof start, .user_data = to, .write_fn = exrWrite, .zip_level = -2, .dwa_quality = -1.0f};
    exr_context_t context;
    int part = 0;
    exr_attr_v2f_t centre;
    centre.x = centre.y = 0.0f;
    assert_int_equal(exr_start_write(&context, "memory", EXR_WRITE_FILE_DIRECTLY, &start), EXR_ERR_SUCCESS);
    exr_add_part(context, "picture", file->tile != 0 ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE, &part);
    exr_initialize_required_attr(context, part, &file->display, &file->data, 1.0f, &centre, 1.0f,
                                 EXR_LINEORDER_INCREASING_Y, file->compression);
    for (const char* at = file->channels; *at != '\0'; ++at) {
        char name[32];
        snprintf(name, sizeof name, "%s%c", file->prefix != NULL ? file->prefix : "", *at);
        exr_add_channel(context, part, name, file->type, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    }
    if (file->tile != 0) {
        exr_set_tile_descriptor(context, part, (uint32_t)file->tile, (uint32_t)file->tile, EXR_TILE_ONE_LEVEL,
                                EXR_TILE_ROUND_DOWN);
    }
    assert_int_equal(exr_write_header(context), EXR_ERR_SUCCESS);
    exrChunks(context, file);
    assert_int_equal(exr_finish(&context), EXR_ERR_SUCCESS);
}
