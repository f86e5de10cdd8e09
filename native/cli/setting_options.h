// A frame's settings as options: their text, their help, and the table itself for other programs.
#pragma once

#include "technique/settings.h"

/// How a line of help is printed: option, meaning, range.
#define VT_OPTION_LINE "  %-36s %s%s\n"

typedef struct vtRange {
    double least, most;
    bool isWhole;
} vtRange;

vtRange vtRangeOfSetting(const vtSetting* setting);

/// Reads an option's `count` numbers, 1 to 3, separated by commas; NULL: of any size. The sentence names
/// option and range.
vtResult vtReadOption(const char* option, const char* text, const vtRange* range, int count, double* numbers,
                      vtError* error);

/// Puts the text of the option of that name into the frame.
vtResult vtReadSetting(const vtSetting* setting, const char* text, vtFrame* frame, vtError* error);

/// A line of help.
void vtPrintSetting(const vtSetting* setting);

/// The table as JSON, for programs (`vitrine list --settings`).
void vtPrintSettings(void);
