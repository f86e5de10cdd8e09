// How far a picture of directions is from the truth.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "vitrine.h"

typedef struct vtDirectionError {
    size_t pixels;     ///< whose true path exits: what the shares below are shares of
    double within01;   ///< share of them within 0.1 degrees
    double within1;    ///< within 1 degree
    double within5;    ///< within 5 degrees
    double lost;       ///< marked lost, counted as wrong in the shares above
    double median;     ///< degrees
    double mean;       ///< degrees; a pixel without an answer counts as 90, what a random direction is off
    size_t maskErrors; ///< pixels that are glass in one picture and background in the other, of all
} vtDirectionError;

/// What a pixel of a direction image says.
typedef enum vtDirectionKind { vt_directionBackground, vt_directionLost, vt_directionExit } vtDirectionKind;
vtDirectionKind vtClassifyDirection(const float direction[3]);

/// Degrees between the answer and a true exit direction; 180 where there is no answer (lost, background,
/// NaN).
float vtDirectionAngle(const float direction[3], const float truth[3]);

/// Compares two direction images as vtRenderer_ReadDirections gives them; `count` is in pixels.
vtResult vtCompareDirections(const float* directions, const float* truth, size_t count,
                             vtDirectionError* result, vtError* error);

/// A range of path lengths, both ends included.
typedef struct vtEventRange {
    int low, high;
} vtEventRange;

#define VT_EVENT_GROUPS 4

/// The groups that errors are split into: 1-2, 3-4, 5-8 and 9 to 255 events; `index` below VT_EVENT_GROUPS.
vtEventRange vtEventGroup(int index);

/// As vtCompareDirections, on the pixels whose entry in `events` (the true path's number of events, one byte
/// a pixel) lies in `range`; mask errors too are counted there only.
vtResult vtCompareDirectionsOfEvents(const float* directions, const float* truth, const uint8_t* events,
                                     size_t count, vtEventRange range, vtDirectionError* result,
                                     vtError* error);
