#include "cli/limit_options.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/limits.h"

vtResult vtReadLimit(const char* option, const char* text, vtLimits* limits, vtError* error)
{
    const bool isMemory = strcmp(option, "max-memory") == 0;
    const double unit = isMemory ? 1024.0 : 1000.0;
    const double most = 1e15; // far beyond any machine, and exact as a double
    char* end;
    double amount = strtod(text, &end);
    const char* letters = "KMGT";
    const char* letter = *end != '\0' ? strchr(letters, *end) : NULL;
    for (const char* at = letters; letter != NULL && at <= letter; ++at) {
        amount *= unit;
    }
    if (end == text || end[letter != NULL] != '\0' || !(amount >= 1.0 && amount <= most)) {
        return vtFail(error, vt_errorArgument, "--%s is '%.100s'; it must be a number of %s from 1 on, as %s",
                      option, text, isMemory ? "bytes" : option + strlen("max-"),
                      isMemory ? "512M or 2G" : "20M");
    }
    *(isMemory                               ? &limits->memory
      : strcmp(option, "max-triangles") == 0 ? &limits->triangles
                                             : &limits->pixels) = (uint64_t)amount;
    return vt_ok;
}

vtResult vtCheckDrawn(int width, int height, const vtLimits* limits, vtError* error)
{
    const vtLimits most = vtResolveLimits(limits);
    if ((uint64_t)width * (uint64_t)height > most.pixels) {
        return vtFail(
            error, vt_errorArgument,
            "--resolution is %d,%d, %llu pixels, but at most %llu are drawn; make it smaller, or allow "
            "more with --max-pixels",
            width, height, (unsigned long long)width * (unsigned long long)height,
            (unsigned long long)most.pixels);
    }
    return vt_ok;
}
