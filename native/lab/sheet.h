// A contact sheet: pictures side by side with words under them.
#pragma once

#include "vitrine.h"

typedef struct vtSheet {
    int width, height;
    uint8_t* pixels; ///< RGBA, top row first
} vtSheet;

/// A sheet filled with one grey. Fails with vt_errorMemory, or vt_errorArgument above 16384 pixels a side.
vtResult vtCreateSheet(int width, int height, uint8_t grey, vtSheet* sheet, vtError* error);
void vtDestroySheet(vtSheet* sheet);

/// Copies a picture (RGBA, top row first) to (x, y), scaled down by a whole factor (box filter). It must fit.
void vtSheet_Paste(vtSheet* sheet, int x, int y, const uint8_t* rgba, int width, int height, int factor);

/// Writes one line, black, with its top left at (x, y); what does not fit is cut off. Letters are
/// 7 * scale pixels high, lines 12 * scale apart. A letter that no caption had yet is a box: see sheet.c.
void vtSheet_Text(vtSheet* sheet, int x, int y, int scale, const char* text);
