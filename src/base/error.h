#pragma once

#include "base/about.h"
#include "vitrine.h"

#if defined(__GNUC__)
#define VT_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define VT_PRINTF(text, first)
#endif

/// Writes the sentence into *error (if any) and returns `result`, so that `return vtFail(...)` reads well.
vtResult vtFail(vtError* error, vtResult result, const char* format, ...) VT_PRINTF(3, 4);

/// vt_errorArgument: `what`, an argument of the function `call`, is NULL.
vtResult vtFailMissing(vtError* error, const char* call, const char* what);
#ifndef VT_WITH_ABOUT // a page's element is its only caller: it does without the names
#define vtFailMissing(error, call, what) vtFailMissing(error, "", "")
#endif

/// Clears *error and returns vt_ok.
vtResult vtSucceed(vtError* error);
