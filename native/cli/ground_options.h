// The options of a ground, all of them of one struct.
#pragma once

#include "vitrine.h"

typedef struct vtGroundOptions {
    vtGround ground;
    bool isThere;       ///< --ground was given
    const char* needed; ///< the last of those that say nothing without it; NULL: none was given
} vtGroundOptions;

/// Reads one of them by its name; `text`: its value, of --ground alone it may be NULL. Fails with a sentence.
vtResult vtReadGroundOption(const char* option, const char* text, vtGroundOptions* options, vtError* error);

/// Fails where one was given without --ground, and as vtValidateGround does.
vtResult vtCheckGroundOptions(const vtGroundOptions* options, vtError* error);
