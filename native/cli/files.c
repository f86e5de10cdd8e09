#include "cli/files.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "base/memory.h"

static vtResult readStream(FILE* stream, const char* path, uint8_t** bytes, size_t* size, vtError* error)
{
    size_t capacity = 1 << 16, used = 0;
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
        return readStream(stdin, "standard input", bytes, size, error);
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
        result = readStream(stream, path, bytes, size, error);
    }
    fclose(stream);
    return result;
}

bool vtReadFileForModel(const char* path, uint8_t** bytes, size_t* size, void* userData)
{
    (void)userData;
    return vtReadFile(path, bytes, size, NULL) == vt_ok;
}

static bool isRegularOrNew(const char* path)
{
    struct stat status;
    return stat(path, &status) != 0 || S_ISREG(status.st_mode);
}

vtResult vtWriteFile(const char* path, const void* bytes, size_t size, vtError* error)
{
    bool toStdout = strcmp(path, "-") == 0;
    bool direct = toStdout || !isRegularOrNew(path); // a device or a pipe is written as it is
    char part[4096];
    if (snprintf(part, sizeof part, direct ? "%s" : "%s.part", path) >= (int)sizeof part) {
        return vtFail(error, vt_errorFile, "file '%.200s...': the path is too long", path);
    }
    FILE* stream = toStdout ? stdout : fopen(part, "wb");
    if (stream == NULL) {
        return vtFail(error, vt_errorFile, "file '%s' cannot be written: %s", path, strerror(errno));
    }
    bool written = fwrite(bytes, 1, size, stream) == size;
    written = (toStdout ? fflush(stream) : fclose(stream)) == 0 && written;
    if (written && (direct || rename(part, path) == 0)) {
        return vtSucceed(error);
    }
    int reason = errno;
    if (!direct) {
        unlink(part);
    }
    return vtFail(error, vt_errorFile, "file '%s' cannot be written: %s", path, strerror(reason));
}

vtResult vtWritePrinted(const char* path, vtPrintFcn* print, const void* data, vtError* error)
{
    char* text = NULL;
    size_t size = 0;
    FILE* memory = open_memstream(&text, &size);
    if (memory == NULL) {
        return vtFail(error, vt_errorMemory, "file '%s': out of memory", path);
    }
    print(data, memory);
    fclose(memory);
    const vtResult result = vtWriteFile(path, text, size, error);
    free(text);
    return result;
}
