#define _XOPEN_SOURCE 700 // realpath
#include "cli/files.h"
#include "cli/hash.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/limits.h"
#include "base/memory.h"
#include "image/image.h"

/// What is read of a stream, whose end nobody knows.
typedef struct Reading {
    size_t expected; ///< bytes, as far as that is known
    uint64_t most;   ///< then it fails
    bool isInput;    ///< a model or a picture: what begins as neither is not read to its end
} Reading;

static const size_t firstBytes = 1 << 16;

/// Are these the first bytes of a model or a picture?
static bool begins(const uint8_t* bytes, size_t size)
{
    size_t first = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    while (first < size && memchr(" \t\r\n", bytes[first], 4) != NULL) {
        ++first;
    }
    return vtIsPicture(bytes, size) || (size >= 4 && memcmp(bytes, "glTF", 4) == 0) ||
           (first < size && bytes[first] == '{');
}

static vtResult readStream(FILE* stream, const Reading* how, const char* path, uint8_t** bytes, size_t* size,
                           vtError* error)
{
    size_t capacity = how->expected + firstBytes, used = 0; // room to see the end without growing
    uint8_t* data = vtAllocate(capacity, 1);
    while (data != NULL) {
        used += fread(data + used, 1, capacity - used, stream);
        if (used < capacity || (how->isInput && !begins(data, used))) {
            break;
        }
        if (used > how->most) {
            vtFree(data);
            return vtFail(error, vt_errorMemory, "file '%.300s' has more than %llu bytes; divide it%s", path,
                          (unsigned long long)how->most,
                          how->isInput ? ", or allow more (--max-memory)" : "");
        }
        capacity *= 2;
        uint8_t* larger = vtReallocate(data, capacity, 1);
        if (larger == NULL) {
            vtFree(data);
        }
        data = larger;
    }
    if (data == NULL) {
        return vtFail(error, vt_errorMemory, "file '%.300s': out of memory", path);
    }
    if (ferror(stream)) {
        int reason = errno;
        vtFree(data);
        return vtFail(error, vt_errorFile, "file '%s' cannot be read: %s", path, strerror(reason));
    }
    *bytes = data;
    *size = used;
    return vtSucceed(error);
}

static vtResult readWhole(const char* path, const Reading* how, uint8_t** bytes, size_t* size, vtError* error)
{
    *bytes = NULL;
    *size = 0;
    if (strcmp(path, "-") == 0) {
        return readStream(stdin, how, "standard input", bytes, size, error);
    }
    struct stat status;
    FILE* stream = fopen(path, "rb");
    if (stream == NULL) {
        return vtFail(error, vt_errorFile, "file '%s' cannot be opened: %s", path, strerror(errno));
    }
    vtResult result;
    if (fstat(fileno(stream), &status) == 0 && S_ISDIR(status.st_mode)) {
        result = vtFail(error, vt_errorFile, "file '%s' is a directory", path);
    } else if (S_ISREG(status.st_mode) && (uint64_t)status.st_size > how->most) {
        result = vtFail(error, vt_errorMemory,
                        "file '%.300s' has %lld bytes, but at most %llu are read; divide it%s", path,
                        (long long)status.st_size, (unsigned long long)how->most,
                        how->isInput ? ", or allow more (--max-memory)" : "");
    } else {
        result = readStream(stream, how, path, bytes, size, error);
    }
    fclose(stream);
    return result;
}

vtResult vtReadFile(const char* path, uint8_t** bytes, size_t* size, vtError* error)
{
    const Reading how = {.most = vtDefaultLimits().memory};
    return readWhole(path, &how, bytes, size, error);
}

vtResult vtReadInput(const char* path, const vtLimits* limits, uint8_t** bytes, size_t* size, vtError* error)
{
    const Reading how = {.most = vtResolveLimits(limits).memory, .isInput = true};
    return readWhole(path, &how, bytes, size, error);
}

vtResult vtReadText(const char* path, char** text, vtError* error)
{
    uint8_t* bytes;
    size_t size;
    *text = NULL;
    const Reading how = {.most = 16 << 20}; // no list and no way of a camera is as long
    const vtResult result = readWhole(path, &how, &bytes, &size, error);
    if (result != vt_ok) {
        return result;
    }
    *text = malloc(size + 1);
    if (*text != NULL) {
        memcpy(*text, bytes, size);
        (*text)[size] = '\0';
    }
    vtFree(bytes);
    return *text != NULL ? vt_ok : vtFail(error, vt_errorMemory, "file '%s': out of memory", path);
}

char* vtNextLine(char** at)
{
    char* line = *at;
    if (line == NULL) {
        return NULL;
    }
    char* end = strchr(line, '\n');
    *at = end != NULL ? end + 1 : NULL;
    line[strcspn(line, "\r\n")] = '\0';
    return line;
}

/// Is the resolved path below the resolved folder?
static bool isBelow(const char* path, const char* folder)
{
    const size_t length = strlen(folder);
    return strncmp(path, folder, length) == 0 && (folder[length - 1] == '/' || path[length] == '/');
}

/// A plain file of that size, as it is at this moment.
static vtResult readPlain(const char* path, size_t limit, uint8_t** bytes, size_t* size, vtError* error)
{
    struct stat status;
    // Opening a pipe would wait for its other end; nothing resolved is a link.
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
    if (file < 0 || fstat(file, &status) != 0) {
        const int reason = errno;
        if (file >= 0) {
            close(file);
        }
        return vtFail(error, vt_errorFile, "%s", strerror(reason));
    }
    vtResult result = vt_ok;
    FILE* stream = NULL;
    if (!S_ISREG(status.st_mode)) {
        result = vtFail(error, vt_errorFile, "it is no plain file");
    } else if ((uint64_t)status.st_size > limit) {
        result = vtFail(error, vt_errorMemory, "it has %lld bytes, of which %zu are left to the model",
                        (long long)status.st_size, limit);
    } else if ((stream = fdopen(file, "rb")) == NULL) {
        result = vtFail(error, vt_errorFile, "%s", strerror(errno));
    } else {
        const Reading how = {.expected = (size_t)status.st_size, .most = limit};
        result = readStream(stream, &how, path, bytes, size, error);
    }
    if (stream != NULL) {
        fclose(stream);
    } else {
        close(file);
    }
    return result;
}

vtResult vtReadFileForModel(const char* path, size_t limit, uint8_t** bytes, size_t* size, void* userData,
                            vtError* error)
{
    const vtModelFolders* folders = userData;
    char resolved[PATH_MAX];
    if (realpath(path, resolved) == NULL) {
        return vtFail(error, vt_errorFile, "%s", strerror(errno));
    }
    if (!isBelow(resolved, folders->directory) &&
        (folders->root[0] == '\0' || !isBelow(resolved, folders->root))) {
        return vtFail(error, vt_errorFile,
                      "it is a link to '%.300s', outside the model's folder; name a folder that holds both "
                      "with --root",
                      resolved);
    }
    const vtResult result = readPlain(resolved, limit, bytes, size, error);
    if (result == vt_ok && folders->contents != NULL) {
        *folders->contents = vtHash(*folders->contents, *bytes, *size);
    }
    return result;
}

vtResult vtFindModelFolders(const char* model, const char* root, vtModelFolders* folders, vtError* error)
{
    *folders = (vtModelFolders){0};
    char name[PATH_MAX];
    const char* slash = strrchr(model, '/');
    const int length = slash != NULL ? (int)(slash - model) + 1 : 0;
    snprintf(name, sizeof name, "%.*s", length, model);
    if (realpath(length > 0 ? name : ".", folders->directory) == NULL) {
        return vtFail(error, vt_errorFile, "the folder of '%.200s' cannot be found: %s", model,
                      strerror(errno));
    }
    if (root != NULL && realpath(root, folders->root) == NULL) {
        return vtFail(error, vt_errorFile, "--root '%.200s' cannot be found: %s", root, strerror(errno));
    }
    return vt_ok;
}
