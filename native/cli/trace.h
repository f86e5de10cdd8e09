// The reference tracer as the commands use it.
#pragma once

#include "cli/load.h"
#include "lab/reference/reference.h"

/// Traces the frame, if asked to with a progress line on standard error.
vtResult vtTrace(const vtOptions* options, const vtInput* input, const vtFrame* frame, bool showsProgress,
                 vtReferenceImage* image, vtError* error);

/// The frame's output (picture or analysis) of a traced image, before its background: RGBA, allocated by
/// malloc.
vtResult vtTracePixels(const vtReferenceImage* image, const vtInput* input, const vtFrame* frame,
                       uint8_t** pixels, vtError* error);

/// The same as floats, as vtRenderer_DrawFloats has them: linear light, or sRGB after tone mapping, by
/// frame->linear.
vtResult vtTraceFloats(const vtReferenceImage* image, const vtInput* input, const vtFrame* frame,
                       float** rgba, vtError* error);
