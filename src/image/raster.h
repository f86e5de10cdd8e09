// What the decoders of pictures share: the file they read, and the samples they give. image.h is what others
// use.
#pragma once

#include "vitrine.h"

/// What a picture's header declares.
typedef struct vtPictureHeader {
    long width, height;
    int bytesPerPixel; ///< of its raster; 0: the header was not reached
} vtPictureHeader;

/// A picture's file in memory.
typedef struct vtPictureFile {
    const uint8_t* bytes;
    size_t size;
    const char* name;        ///< for sentences
    bool isRelief;           ///< its sides must be those of a relief
    vtPictureHeader* header; ///< nothing else is read: vtBeginRaster fills it and fails. NULL: all is read
} vtPictureFile;

/// Samples as the file has them, top row first; the caller frees them by vtFree.
typedef struct vtRaster {
    void* samples; ///< uint8_t, uint16_t or float, by `bits`
    int width, height;
    int channels; ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
    int bits;     ///< of a sample: 8, 16 or 32
} vtRaster;

/// Of one format. Whatever the bytes are, the result is a whole picture, vt_errorFormat or vt_errorMemory; in
/// the last two cases *raster is left zeroed.
typedef vtResult vtDecoder(const vtPictureFile* file, vtRaster* raster, vtError* error);

vtDecoder vtDecodeHdrRaster, vtDecodePfmRaster;                                         // in every build
vtDecoder vtDecodePngRaster, vtDecodeJpegRaster, vtDecodeWebpRaster, vtDecodeExrRaster; // native ones

/// Checks the sides that a file declares, and takes zeroed memory for its samples. Fails with vt_errorFormat
/// or vt_errorMemory; then *raster is zeroed.
vtResult vtBeginRaster(const vtPictureFile* file, long width, long height, int channels, int bits,
                       vtRaster* raster, vtError* error);

void vtDestroyRaster(vtRaster* raster);

/// vt_errorFormat: the file is damaged, or has what its decoder does not know; `reason` tells which.
vtResult vtFailPicture(const vtPictureFile* file, const char* format, const char* reason, vtError* error);

/// vt_errorMemory.
vtResult vtFailPictureMemory(const vtPictureFile* file, vtError* error);
