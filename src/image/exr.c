// OpenEXR through the C library OpenEXRCore: scan lines or tiles (of which the finest level is read), of any
// compression, as half, float or integers. The picture is the display window, black where there are no data.
// Departures: of several parts the first counts that has a picture; colours are R, G and B or Y alone, not
// those of a layer with a name, nor Y with chroma (RY, BY); deep pictures are not read.
#include <openexr.h>

#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/memory.h"
#include "image/image_checks.h"
#include "image/raster.h"

typedef struct Reader {
    exr_context_t context;
    const vtPictureFile* file;
    int part;
    bool isTiled;
    int channels; ///< 1: Y; 3: R, G, B
    exr_attr_box2i_t data, display;
    vtRaster* raster; ///< of the data window
    char reason[256]; ///< the first; libraries tell more and more general ones
} Reader;

/// Whether OpenEXRCore lacked memory since decoding began. It does not always say so, and its call for memory
/// knows of no decoder; so this lives with the thread.
static _Thread_local bool memoryWasOut;

static void* allocate(size_t size)
{
    void* memory = vtAllocate(1, size);
    memoryWasOut = memoryWasOut || memory == NULL;
    return memory;
}

static void hear(exr_const_context_t context, exr_result_t code, const char* message)
{
    (void)code;
    void* data = NULL;
    if (context != NULL && exr_get_user_data(context, &data) == EXR_ERR_SUCCESS && data != NULL) {
        Reader* reader = data;
        if (reader->reason[0] == '\0' && message != NULL) {
            snprintf(reader->reason, sizeof reader->reason, "%s", message);
        }
    }
}

static int64_t readBytes(exr_const_context_t context, void* data, void* to, uint64_t size, uint64_t offset,
                         exr_stream_error_func_ptr_t tell)
{
    (void)context, (void)tell;
    const vtPictureFile* file = ((Reader*)data)->file;
    const uint64_t left = offset < file->size ? file->size - offset : 0;
    const uint64_t count = size < left ? size : left;
    if (count > 0) {
        memcpy(to, file->bytes + offset, (size_t)count);
    }
    return (int64_t)count;
}

static int64_t sizeOf(exr_const_context_t context, void* data)
{
    (void)context;
    return (int64_t)((Reader*)data)->file->size;
}

static vtResult fail(const Reader* reader, exr_result_t code, vtError* error)
{
    if (code == EXR_ERR_OUT_OF_MEMORY || memoryWasOut) {
        return vtFailPictureMemory(reader->file, error);
    }
    if (code == EXR_ERR_FEATURE_NOT_IMPLEMENTED) {
        return vtFail(
            error, vt_errorFormat,
            "picture '%.300s' is an OpenEXR file that this version of OpenEXRCore does not read (%s); save "
            "it with ZIP or PIZ compression",
            reader->file->name, reader->reason);
    }
    return vtFailPicture(reader->file, "OpenEXR",
                         reader->reason[0] != '\0' ? reader->reason : exr_get_default_error_message(code),
                         error);
}

// ----------------------------------------------------------------------------------------------- headers

static const exr_attr_chlist_entry_t* findChannel(const exr_attr_chlist_t* list, const char* name)
{
    for (int i = 0; i < list->num_channels; ++i) {
        if (strcmp(list->entries[i].name.str, name) == 0) {
            return &list->entries[i];
        }
    }
    return NULL;
}

/// Whether all of them are there, with a sample for each pixel.
static bool hasChannels(const exr_attr_chlist_t* list, const char* names)
{
    for (; *names != '\0'; ++names) {
        const exr_attr_chlist_entry_t* entry = findChannel(list, (const char[2]){*names, '\0'});
        if (entry == NULL || entry->x_sampling != 1 || entry->y_sampling != 1) {
            return false;
        }
    }
    return true;
}

/// The first part with a picture; 0 channels: there is none.
static exr_result_t choosePart(Reader* reader)
{
    int count = 0;
    exr_result_t code = exr_get_count(reader->context, &count);
    for (int i = 0; i < count && code == EXR_ERR_SUCCESS && reader->channels == 0; ++i) {
        exr_storage_t storage;
        const exr_attr_chlist_t* list = NULL;
        code = exr_get_storage(reader->context, i, &storage);
        code = code == EXR_ERR_SUCCESS ? exr_get_channels(reader->context, i, &list) : code;
        if (code == EXR_ERR_SUCCESS && (storage == EXR_STORAGE_SCANLINE || storage == EXR_STORAGE_TILED)) {
            reader->part = i;
            reader->isTiled = storage == EXR_STORAGE_TILED;
            reader->channels = hasChannels(list, "RGB")                                    ? 3
                               : hasChannels(list, "Y") && findChannel(list, "RY") == NULL ? 1
                                                                                           : 0;
        }
    }
    if (code == EXR_ERR_SUCCESS) {
        code = exr_get_data_window(reader->context, reader->part, &reader->data);
    }
    return code == EXR_ERR_SUCCESS ? exr_get_display_window(reader->context, reader->part, &reader->display)
                                   : code;
}

// ------------------------------------------------------------------------------------------------ pixels

/// Where each channel's samples go: into the raster, as floats.
static void aim(const Reader* reader, exr_decode_pipeline_t* pipeline, int x, int y)
{
    const vtRaster* raster = reader->raster;
    float* to =
        (float*)raster->samples + ((size_t)y * (size_t)raster->width + (size_t)x) * (size_t)raster->channels;
    const char* names = raster->channels == 3 ? "RGB" : "Y";
    for (int i = 0; i < pipeline->channel_count; ++i) {
        exr_coding_channel_info_t* channel = &pipeline->channels[i];
        const char* name = channel->channel_name;
        const char* at = name[0] != '\0' && name[1] == '\0' ? strchr(names, name[0]) : NULL;
        channel->decode_to_ptr = at != NULL ? (uint8_t*)(to + (at - names)) : NULL;
        channel->user_pixel_stride = raster->channels * (int)sizeof(float);
        channel->user_line_stride = raster->width * channel->user_pixel_stride;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
    }
}

/// The chunk whose upper left pixel is x, y of the data window.
static exr_result_t readChunk(const Reader* reader, exr_decode_pipeline_t* pipeline,
                              const exr_chunk_info_t* chunk, int x, int y)
{
    const bool isFirst = pipeline->context == NULL;
    if (chunk->width > reader->raster->width - x || chunk->height > reader->raster->height - y) {
        return EXR_ERR_BAD_CHUNK_LEADER;
    }
    exr_result_t code = isFirst ? exr_decoding_initialize(reader->context, reader->part, chunk, pipeline)
                                : exr_decoding_update(reader->context, reader->part, chunk, pipeline);
    if (code == EXR_ERR_SUCCESS) {
        aim(reader, pipeline, x, y);
        // Anew for each, as the choice depends on where samples go.
        code = exr_decoding_choose_default_routines(reader->context, reader->part, pipeline);
    }
    return code == EXR_ERR_SUCCESS ? exr_decoding_run(reader->context, reader->part, pipeline) : code;
}

static exr_result_t readScanLines(const Reader* reader, exr_decode_pipeline_t* pipeline)
{
    int32_t lines = 0;
    exr_result_t code = exr_get_scanlines_per_chunk(reader->context, reader->part, &lines);
    if (code == EXR_ERR_SUCCESS && lines < 1) {
        code = EXR_ERR_BAD_CHUNK_LEADER;
    }
    for (int y = 0; code == EXR_ERR_SUCCESS && y < reader->raster->height; y += lines) {
        exr_chunk_info_t chunk;
        code = exr_read_scanline_chunk_info(reader->context, reader->part, reader->data.min.y + y, &chunk);
        code = code == EXR_ERR_SUCCESS ? readChunk(reader, pipeline, &chunk, 0, y) : code;
    }
    return code;
}

static exr_result_t readTiles(const Reader* reader, exr_decode_pipeline_t* pipeline)
{
    int32_t width = 0, height = 0;
    exr_result_t code = exr_get_tile_sizes(reader->context, reader->part, 0, 0, &width, &height);
    if (code == EXR_ERR_SUCCESS && (width < 1 || height < 1)) {
        code = EXR_ERR_BAD_CHUNK_LEADER;
    }
    for (int y = 0; code == EXR_ERR_SUCCESS && y < reader->raster->height; y += height) {
        for (int x = 0; code == EXR_ERR_SUCCESS && x < reader->raster->width; x += width) {
            exr_chunk_info_t chunk;
            code =
                exr_read_tile_chunk_info(reader->context, reader->part, x / width, y / height, 0, 0, &chunk);
            code = code == EXR_ERR_SUCCESS ? readChunk(reader, pipeline, &chunk, x, y) : code;
        }
    }
    return code;
}

/// Sides of a box; too large to be true where they do not fit.
static long sideOf(int32_t least, int32_t most)
{
    const int64_t side = (int64_t)most - least + 1;
    return side > 0 && side < INT32_MAX ? (long)side : 0;
}

/// What the display window sees of the data window.
static vtResult crop(const Reader* reader, const vtRaster* data, vtRaster* raster, vtError* error)
{
    const exr_attr_box2i_t display = reader->display;
    const vtResult result =
        vtBeginRaster(reader->file, sideOf(display.min.x, display.max.x),
                      sideOf(display.min.y, display.max.y), data->channels, 32, raster, error);
    for (int row = 0; result == vt_ok && row < raster->height; ++row) {
        const int64_t from = (int64_t)display.min.y + row - reader->data.min.y;
        const int64_t left = (int64_t)display.min.x - reader->data.min.x; // in the data window
        const int64_t begin = left > 0 ? left : 0;
        const int64_t end = left + raster->width < data->width ? left + raster->width : data->width;
        if (from >= 0 && from < data->height && begin < end) {
            const size_t size = (size_t)data->channels * sizeof(float);
            memcpy((uint8_t*)raster->samples +
                       ((size_t)row * (size_t)raster->width + (size_t)(begin - left)) * size,
                   (const uint8_t*)data->samples +
                       ((size_t)from * (size_t)data->width + (size_t)begin) * size,
                   (size_t)(end - begin) * size);
        }
    }
    return result;
}

static vtResult readExr(Reader* reader, vtRaster* raster, vtError* error)
{
    exr_context_initializer_t start = {.size = sizeof start,
                                       .error_handler_fn = hear,
                                       .alloc_fn = allocate,
                                       .free_fn = vtFree,
                                       .user_data = reader,
                                       .read_fn = readBytes,
                                       .size_fn = sizeOf,
                                       .max_image_width = VT_MAX_IMAGE_SIDE,
                                       .max_image_height = VT_MAX_IMAGE_SIDE,
                                       .max_tile_width = VT_MAX_IMAGE_SIDE,
                                       .max_tile_height = VT_MAX_IMAGE_SIDE,
                                       .zip_level = -2,
                                       .dwa_quality = -1.0f,
                                       .flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION};
    exr_result_t code = exr_start_read(&reader->context, "memory", &start);
    code = code == EXR_ERR_SUCCESS ? choosePart(reader) : code;
    if (code != EXR_ERR_SUCCESS) {
        return fail(reader, code, error);
    }
    if (reader->channels == 0) {
        return vtFail(error, vt_errorFormat,
                      "picture '%.300s' is an OpenEXR file without a flat picture in R, G and B or Y at full "
                      "resolution; save it again as such",
                      reader->file->name);
    }
    vtRaster data;
    const exr_attr_box2i_t window = reader->data;
    if (reader->file->header != NULL) { // the larger of both
        const exr_attr_box2i_t shown = reader->display;
        const long width = sideOf(shown.min.x, shown.max.x), height = sideOf(shown.min.y, shown.max.y);
        const long dataWidth = sideOf(window.min.x, window.max.x),
                   dataHeight = sideOf(window.min.y, window.max.y);
        return vtBeginRaster(reader->file, width > dataWidth ? width : dataWidth,
                             height > dataHeight ? height : dataHeight, reader->channels, 32, raster, error);
    }
    vtResult result = vtBeginRaster(reader->file, sideOf(window.min.x, window.max.x),
                                    sideOf(window.min.y, window.max.y), reader->channels, 32, &data, error);
    if (result != vt_ok) {
        return result;
    }
    reader->raster = &data;
    exr_decode_pipeline_t pipeline = {0};
    code = reader->isTiled ? readTiles(reader, &pipeline) : readScanLines(reader, &pipeline);
    exr_decoding_destroy(reader->context, &pipeline);
    if (code != EXR_ERR_SUCCESS) {
        result = fail(reader, code, error);
    } else if (memcmp(&reader->data, &reader->display, sizeof reader->data) == 0) {
        *raster = data;
        return vtSucceed(error);
    } else {
        result = crop(reader, &data, raster, error);
    }
    vtDestroyRaster(&data);
    return result;
}

vtResult vtDecodeExrRaster(const vtPictureFile* file, vtRaster* raster, vtError* error)
{
    Reader reader = {.file = file};
    *raster = (vtRaster){0};
    memoryWasOut = false;
    const vtResult result = readExr(&reader, raster, error);
    exr_finish(&reader.context);
    return result;
}
