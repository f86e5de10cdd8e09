// How far a picture of directions is from the truth.
#pragma once

#include <stddef.h>

#include "vitrine.h"

typedef struct vtDirectionError {
    size_t pixels;     ///< whose true path exits: what the shares below are shares of
    double within1;    ///< share of them within 1 degree
    double within5;    ///< within 5 degrees
    double lost;       ///< marked lost, counted as wrong in the shares above
    double median;     ///< degrees
    size_t maskErrors; ///< pixels that are glass in one picture and background in the other, of all
} vtDirectionError;

/// Compares two direction images as vtRenderer_ReadDirections gives them; `count` is in pixels.
vtResult vtCompareDirections(const float* directions, const float* truth, size_t count,
                             vtDirectionError* result, vtError* error);
