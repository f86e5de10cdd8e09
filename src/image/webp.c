// WebP through libwebp, whose own memory comes from malloc.
#include <webp/decode.h>

#include "base/error.h"
#include "image/raster.h"

static const char* reasonOf(VP8StatusCode status)
{
    switch (status) {
    case VP8_STATUS_NOT_ENOUGH_DATA:
        return "it is cut off";
    case VP8_STATUS_UNSUPPORTED_FEATURE:
        return "it has what libwebp does not know";
    default:
        return "its contents are no valid WebP";
    }
}

/// Whether the file is as long as its first chunk tells.
static bool isWhole(const vtPictureFile* file)
{
    const uint8_t* at = file->bytes + 4; // vtDecodeRaster has seen 12 bytes
    const size_t size = (size_t)at[0] | (size_t)at[1] << 8 | (size_t)at[2] << 16 | (size_t)at[3] << 24;
    return size <= file->size - 8;
}

static vtResult readWebp(const vtPictureFile* file, vtRaster* raster, vtError* error)
{
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config)) {
        return vtFailPicture(file, "WebP", "libwebp has another version than that which this was built with",
                             error);
    }
    VP8StatusCode status = WebPGetFeatures(file->bytes, file->size, &config.input);
    if (status == VP8_STATUS_OK && config.input.has_animation) {
        return vtFail(error, vt_errorFormat, "picture '%.300s' is an animated WebP; save one picture of it",
                      file->name);
    }
    if (status == VP8_STATUS_OK && !isWhole(file)) {
        status = VP8_STATUS_NOT_ENOUGH_DATA;
    }
    if (status == VP8_STATUS_OK) {
        const int channels = config.input.has_alpha ? 4 : 3;
        const vtResult result =
            vtBeginRaster(file, config.input.width, config.input.height, channels, 8, raster, error);
        if (result != vt_ok) {
            return result;
        }
        config.output.colorspace = channels == 4 ? MODE_RGBA : MODE_RGB;
        config.output.is_external_memory = 1;
        config.output.u.RGBA.rgba = raster->samples;
        config.output.u.RGBA.stride = channels * raster->width;
        config.output.u.RGBA.size = (size_t)config.output.u.RGBA.stride * (size_t)raster->height;
        status = WebPDecode(file->bytes, file->size, &config);
        WebPFreeDecBuffer(&config.output);
    }
    return status == VP8_STATUS_OK              ? vtSucceed(error)
           : status == VP8_STATUS_OUT_OF_MEMORY ? vtFailPictureMemory(file, error)
                                                : vtFailPicture(file, "WebP", reasonOf(status), error);
}

vtResult vtDecodeWebpRaster(const vtPictureFile* file, vtRaster* raster, vtError* error)
{
    *raster = (vtRaster){0};
    const vtResult result = readWebp(file, raster, error);
    if (result != vt_ok) {
        vtDestroyRaster(raster);
    }
    return result;
}
