#include "cli/output_name.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"

bool vtPatternHas(const char* pattern, const char* braces)
{
    return strstr(pattern, braces) != NULL;
}

vtResult vtCheckPattern(const char* pattern, vtError* error)
{
    for (const char* at = strchr(pattern, '{'); at != NULL; at = strchr(at + 1, '{')) {
        if (strncmp(at, "{name}", 6) != 0 && strncmp(at, "{frame}", 7) != 0) {
            return vtFail(error, vt_errorArgument,
                          "-o is '%.200s', where '%.20s' means nothing; there are {name}, the model's, and "
                          "{frame}",
                          pattern, at);
        }
    }
    return vt_ok;
}

void vtNameModel(const char* model, char* name, size_t size)
{
    const char* slash = strrchr(model, '/');
    const char* begin = slash != NULL ? slash + 1 : model;
    const char* dot = strrchr(begin, '.');
    const int length = dot != NULL && dot > begin ? (int)(dot - begin) : (int)strlen(begin);
    snprintf(name, size, "%.*s", length, strcmp(model, "-") == 0 ? "stdin" : begin);
}

/// Where the ending of a file's name begins, or its end.
static const char* findEnding(const char* pattern)
{
    const char *slash = strrchr(pattern, '/'), *dot = strrchr(pattern, '.');
    return dot != NULL && (slash == NULL || dot > slash + 1) ? dot : pattern + strlen(pattern);
}

vtResult vtNameOutput(const char* pattern, const char* model, int frame, char* path, size_t size,
                      vtError* error)
{
    char name[1024], number[24] = "";
    const char* ending = vtPatternHas(pattern, "{frame}") || frame < 0 ? NULL : findEnding(pattern);
    vtNameModel(model, name, sizeof name);
    if (frame >= 0) {
        snprintf(number, sizeof number, "%s%04d", ending != NULL ? "-" : "", frame);
    }
    size_t used = 0;
    const char* at = pattern;
    while (used < size) {
        const bool isName = strncmp(at, "{name}", 6) == 0, isFrame = strncmp(at, "{frame}", 7) == 0;
        if (at == ending) {
            ending = NULL; // once
            used += (size_t)snprintf(path + used, size - used, "%s", number);
        } else if (isName || isFrame) {
            used += (size_t)snprintf(path + used, size - used, "%s", isName ? name : number);
            at += isName ? 6 : 7;
        } else {
            path[used++] = *at;
            if (*at++ == '\0') {
                return vt_ok;
            }
        }
    }
    return vtFail(error, vt_errorArgument, "-o is '%.200s...', which is too long with its names and numbers",
                  pattern);
}
