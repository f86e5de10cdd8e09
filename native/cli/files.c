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
#include "base/memory.h"

/// `expected`: bytes, as far as that is known.
static vtResult readStream(FILE* stream, size_t expected, const char* path, uint8_t** bytes, size_t* size,
                           vtError* error)
{
    size_t capacity = expected + (1 << 16), used = 0; // room to see the end without growing
    uint8_t* data = vtAllocate(capacity, 1);
    while (data != NULL) {
        used += fread(data + used, 1, capacity - used, stream);
        if (used < capacity) {
            break;
        }
        capacity *= 2;
        uint8_t* larger = vtReallocate(data, capacity, 1);
        if (larger == NULL) {
            vtFree(data);
        }
        data = larger;
    }
    if (data == NULL) {
        return vtFail(error, vt_errorMemory, "file '%s': out of memory", path);
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

vtResult vtReadFile(const char* path, uint8_t** bytes, size_t* size, vtError* error)
{
    *bytes = NULL;
    *size = 0;
    if (strcmp(path, "-") == 0) {
        return readStream(stdin, 0, "standard input", bytes, size, error);
    }
    struct stat status;
    FILE* stream = fopen(path, "rb");
    if (stream == NULL) {
        return vtFail(error, vt_errorFile, "file '%s' cannot be opened: %s", path, strerror(errno));
    }
    vtResult result;
    if (fstat(fileno(stream), &status) == 0 && S_ISDIR(status.st_mode)) {
        result = vtFail(error, vt_errorFile, "file '%s' is a directory", path);
    } else {
        result = readStream(stream, 0, path, bytes, size, error);
    }
    fclose(stream);
    return result;
}

vtResult vtReadText(const char* path, char** text, vtError* error)
{
    uint8_t* bytes;
    size_t size;
    *text = NULL;
    const vtResult result = vtReadFile(path, &bytes, &size, error);
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
        result = vtFail(error, vt_errorFile, "it has %lld bytes, of which %zu are left to the model",
                        (long long)status.st_size, limit);
    } else if ((stream = fdopen(file, "rb")) == NULL) {
        result = vtFail(error, vt_errorFile, "%s", strerror(errno));
    } else {
        result = readStream(stream, (size_t)status.st_size, path, bytes, size, error);
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
