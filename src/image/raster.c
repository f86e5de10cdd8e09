#include "image/raster.h"

#include "base/error.h"
#include "base/memory.h"
#include "image/image_checks.h"

vtResult vtBeginRaster(const vtPictureFile* file, long width, long height, int channels, int bits,
                       vtRaster* raster, vtError* error)
{
    *raster = (vtRaster){0};
    if (file->header != NULL) {
        *file->header = (vtPictureHeader){width, height, channels * bits / 8};
        return vt_errorFormat;
    }
    const vtResult result = file->isRelief
                                ? vtCheckHeightSides(file->name, width, height, vt_errorFormat, error)
                                : vtCheckPictureSides(file->name, width, height, error);
    if (result != vt_ok) {
        return result;
    }
    const size_t count = (size_t)width * (size_t)height * (size_t)channels;
    void* samples = vtAllocateZeroed(count, (size_t)bits / 8);
    if (samples == NULL) {
        return vtFailPictureMemory(file, error);
    }
    *raster = (vtRaster){samples, (int)width, (int)height, channels, bits};
    return vtSucceed(error);
}

void vtDestroyRaster(vtRaster* raster)
{
    vtFree(raster->samples);
    *raster = (vtRaster){0};
}

vtResult vtFailPicture(const vtPictureFile* file, const char* format, const char* reason, vtError* error)
{
    return vtFail(
        error, vt_errorFormat,
        "picture '%.300s' cannot be decoded as %s (%.300s); it is damaged or of a kind that is not read, "
        "so save it again",
        file->name, format, reason);
}

vtResult vtFailPictureMemory(const vtPictureFile* file, vtError* error)
{
    return vtFail(error, vt_errorMemory, "no memory to decode picture '%.300s'; scale it down", file->name);
}
