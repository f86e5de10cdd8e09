#include "image/image_checks.h"

#include "base/error.h"

vtResult vtCheckHeightSides(const char* name, long width, long height, vtResult failure, vtError* error)
{
    if (width < 2 || height < 2 || width > VT_MAX_RELIEF_SIDE || height > VT_MAX_RELIEF_SIDE) {
        return vtFail(error, failure,
                      "relief '%.300s' is %ld x %ld samples, but a side must be 2 to %d; scale it", name,
                      width, height, VT_MAX_RELIEF_SIDE);
    }
    return vtSucceed(error);
}

vtResult vtCheckPictureSides(const char* name, long width, long height, vtError* error)
{
    if (width < 1 || height < 1 || width > VT_MAX_IMAGE_SIDE || height > VT_MAX_IMAGE_SIDE) {
        return vtFail(error, vt_errorFormat,
                      "picture '%.300s' is %ld x %ld pixels, but a side must be 1 to %d; scale it down", name,
                      width, height, VT_MAX_IMAGE_SIDE);
    }
    if (width * height > VT_MAX_IMAGE_PIXELS) {
        return vtFail(error, vt_errorFormat,
                      "picture '%.300s' is %ld x %ld pixels, but at most %ld are read; scale it down", name,
                      width, height, VT_MAX_IMAGE_PIXELS);
    }
    return vtSucceed(error);
}

vtResult vtCheckWritten(int width, int height, vtError* error)
{
    if (width < 1 || height < 1 || width > VT_MAX_IMAGE_SIDE || height > VT_MAX_IMAGE_SIDE) {
        return vtFail(error, vt_errorArgument,
                      "a picture of %d x %d pixels cannot be written; a side must be 1 to %d", width, height,
                      VT_MAX_IMAGE_SIDE);
    }
    return vt_ok;
}
