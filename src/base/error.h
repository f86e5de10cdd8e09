#pragma once

#include "vitrine.h"

#if defined(__GNUC__)
#define VT_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define VT_PRINTF(text, first)
#endif

/// Writes the sentence into *error (if any) and returns `result`, so that `return vtFail(...)` reads well.
vtResult vtFail(vtError* error, vtResult result, const char* format, ...) VT_PRINTF(3, 4);

/// Clears *error and returns vt_ok.
vtResult vtSucceed(vtError* error);
