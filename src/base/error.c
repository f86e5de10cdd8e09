#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>

vtResult vtFail(vtError* error, vtResult result, const char* format, ...)
{
    if (error != NULL) {
        va_list arguments;
        va_start(arguments, format);
        error->result = result;
        vsnprintf(error->message, sizeof error->message, format, arguments);
        va_end(arguments);
    }
    return result;
}

vtResult(vtFailMissing)(vtError* error, const char* call, const char* what)
{
    return vtFail(error, vt_errorArgument, "%s: %s is NULL; give one", call, what);
}

vtResult vtSucceed(vtError* error)
{
    if (error != NULL) {
        *error = (vtError){0};
    }
    return vt_ok;
}
