// How far a picture is from another: PSNR, SSIM, FLIP, and how many pixels differ by how much.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "vitrine.h"

/// 3840 pixels on 0.7 m, seen from 0.7 m: the default of FLIP's authors, 3840 pi / 180.
#define VT_FLIP_PIXELS_PER_DEGREE 67.02064327658226

typedef struct vtPictureError {
    size_t pixels;
    double psnr;             ///< dB over the 8-bit codes of all three channels; INFINITY for equal pictures
    double ssim;             ///< mean over the windows, at most 1, which equal pictures have
    double flip;             ///< mean FLIP, 0 (equal) to 1
    size_t differences[256]; ///< pixels by the largest difference of their three channels, 8-bit codes
    int largest;             ///< largest difference of any channel
} vtPictureError;

/// Compares two pictures as a display would show them: linear RGB, 3 floats a pixel, is clamped to 0..1 (NaN
/// is black) and encoded to 8-bit sRGB first. All numbers are the same with `a` and `b` exchanged.
///
/// SSIM after Wang, Bovik, Sheikh & Simoncelli 2004: on the luma 0.299 R + 0.587 G + 0.114 B of the codes,
/// Gaussian window of 11 x 11 and deviation 1.5, K1 0.01, K2 0.03, L 255, windows that lie wholly inside, no
/// downsampling; a side shorter than 11 pixels shrinks the window to the largest odd size that fits.
///
/// `flipMap` (width * height floats, 0 to 1, top row first) may be NULL.
vtResult vtComparePictures(const float* a, const float* b, int width, int height, vtPictureError* result,
                           float* flipMap, vtError* error);

/// The same for 8-bit sRGB, `channels` (3 or 4, the fourth ignored) bytes a pixel.
vtResult vtComparePictureBytes(const uint8_t* a, const uint8_t* b, int channels, int width, int height,
                               vtPictureError* result, float* flipMap, vtError* error);

/// Pixels with a channel that differs by more than `threshold`, in 8-bit codes.
size_t vtPictureError_CountOver(const vtPictureError* result, int threshold);

/// FLIP alone, on linear RGB without the rounding to 8 bits. `pixelsPerDegree` is 1 to 400, see
/// VT_FLIP_PIXELS_PER_DEGREE; `map` may be NULL.
vtResult vtMeasureFlip(const float* reference, const float* test, int width, int height,
                       double pixelsPerDegree, double* mean, float* map, vtError* error);

/// The same of 8-bit sRGB, `channels` (3 or 4, the fourth ignored) bytes a pixel.
vtResult vtMeasureFlipBytes(const uint8_t* reference, const uint8_t* test, int channels, int width,
                            int height, double pixelsPerDegree, double* mean, float* map, vtError* error);
