// Files written whole or not at all.
#define _XOPEN_SOURCE 700 // readlink
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/error.h"
#include "cli/files.h"

enum {
    mostLinks = 40,   // as Linux follows
    mostOfName = 200, // bytes of a name that the unfinished file has, too: names have 255 at most
};

static vtResult failWriting(const char* path, int reason, vtError* error)
{
    return vtFail(error, vt_errorFile, "file '%s' cannot be written: %s", path, strerror(reason));
}

/// Where a link leads, and the next one, though there be no file yet; else the path itself.
static vtResult followLinks(const char* path, char* place, vtError* error)
{
    struct stat status;
    if (snprintf(place, PATH_MAX, "%s", path) >= PATH_MAX) {
        return vtFail(error, vt_errorFile, "file '%.200s...': the path is too long", path);
    }
    for (int i = 0; lstat(place, &status) == 0 && S_ISLNK(status.st_mode); ++i) {
        char target[PATH_MAX];
        const ssize_t length = i < mostLinks ? readlink(place, target, sizeof target - 1) : -1;
        if (length < 0) {
            return failWriting(path, i < mostLinks ? errno : ELOOP, error);
        }
        target[length] = '\0';
        char* slash = target[0] == '/' ? NULL : strrchr(place, '/');
        char* name = slash != NULL ? slash + 1 : place; // a relative target begins in the link's folder
        if (snprintf(name, (size_t)(place + PATH_MAX - name), "%s", target) >= place + PATH_MAX - name) {
            return failWriting(path, ENAMETOOLONG, error);
        }
    }
    return vt_ok;
}

vtResult vtBeginFile(const char* path, const char* ending, vtUnfinishedFile* file, vtError* error)
{
    *file = (vtUnfinishedFile){.descriptor = -1};
    vtResult result = followLinks(path, file->place, error);
    struct stat status;
    const bool isThere = result == vt_ok && stat(file->place, &status) == 0;
    if (isThere && access(file->place, W_OK) != 0) { // a new file in its place would go round that
        return failWriting(path, errno, error);
    }
    const char* slash = strrchr(file->place, '/');
    const int folder = slash != NULL ? (int)(slash + 1 - file->place) : 0;
    for (int tries = 0; result == vt_ok && file->descriptor < 0; ++tries) {
        uint64_t number = 0;
        const bool drawn = getrandom(&number, sizeof number, 0) == (ssize_t)sizeof number;
        if (!drawn ||
            snprintf(file->path, sizeof file->path, "%.*s%.*s.%016" PRIx64 "%s", folder, file->place,
                     mostOfName, file->place + folder, number, ending) >= (int)sizeof file->path) {
            return failWriting(path, drawn ? ENAMETOOLONG : errno, error);
        }
        file->descriptor = open(file->path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file->descriptor < 0 && (errno != EEXIST || tries == 10)) {
            result = failWriting(path, errno, error);
        }
    }
    if (result == vt_ok && isThere && fchmod(file->descriptor, status.st_mode & 0777) != 0) {
        result = failWriting(path, errno, error);
        vtDropFile(file);
    }
    return result;
}

void vtDropFile(vtUnfinishedFile* file)
{
    if (file->descriptor >= 0) {
        close(file->descriptor);
        unlink(file->path);
        file->descriptor = -1;
    }
}

/// What a folder has is on the disk, as far as it can say so.
static void syncFolder(const char* path)
{
    char folder[PATH_MAX];
    const char* slash = strrchr(path, '/');
    snprintf(folder, sizeof folder, "%.*s", slash != NULL ? (int)(slash - path) + 1 : 1,
             slash != NULL ? path : ".");
    const int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
        fsync(descriptor);
        close(descriptor);
    }
}

vtResult vtFinishFile(vtUnfinishedFile* file, vtError* error)
{
    // A file system that cannot be asked to is not a fault.
    const bool synced = fsync(file->descriptor) == 0 || errno == EINVAL || errno == ENOTSUP;
    int reason = synced ? 0 : errno;
    if (close(file->descriptor) != 0 && reason == 0) {
        reason = errno;
    }
    file->descriptor = -1;
    if (reason == 0 && rename(file->path, file->place) == 0) {
        syncFolder(file->place);
        return vt_ok;
    }
    reason = reason != 0 ? reason : errno;
    unlink(file->path);
    return failWriting(file->place, reason, error);
}

vtResult vtMakeFolders(const char* path, vtError* error)
{
    char folder[PATH_MAX];
    for (const char* slash = strchr(path + (*path == '/'), '/'); slash != NULL;
         slash = strchr(slash + 1, '/')) {
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - path), path);
        if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
            return vtFail(error, vt_errorFile, "folder '%s' cannot be made: %s", folder, strerror(errno));
        }
    }
    return vt_ok;
}

/// 0, or why not.
static int writeAll(int descriptor, const void* bytes, size_t size)
{
    for (const uint8_t* at = bytes; size > 0;) {
        const ssize_t count = write(descriptor, at, size);
        if (count < 0 && errno != EINTR) {
            return errno;
        }
        at += count > 0 ? count : 0;
        size -= count > 0 ? (size_t)count : 0;
    }
    return 0;
}

/// Standard output, a device, a pipe: written as they are.
static vtResult writeStraight(const char* path, const void* bytes, size_t size, vtError* error)
{
    const bool toStdout = strcmp(path, "-") == 0;
    const int descriptor = toStdout ? STDOUT_FILENO : open(path, O_WRONLY | O_CLOEXEC);
    int reason = descriptor < 0 || (toStdout && fflush(stdout) != 0) ? errno : 0;
    reason = reason == 0 ? writeAll(descriptor, bytes, size) : reason;
    if (!toStdout && descriptor >= 0 && close(descriptor) != 0 && reason == 0) {
        reason = errno;
    }
    return reason == 0 ? vtSucceed(error)
                       : failWriting(toStdout ? "-, standard output," : path, reason, error);
}

vtResult vtWriteFile(const char* path, const void* bytes, size_t size, vtError* error)
{
    struct stat status;
    if (strcmp(path, "-") == 0 || (stat(path, &status) == 0 && !S_ISREG(status.st_mode))) {
        return writeStraight(path, bytes, size, error);
    }
    vtUnfinishedFile file;
    const vtResult result = vtBeginFile(path, "", &file, error);
    if (result != vt_ok) {
        return result;
    }
    const int reason = writeAll(file.descriptor, bytes, size);
    if (reason != 0) {
        vtDropFile(&file);
        return failWriting(path, reason, error);
    }
    return vtFinishFile(&file, error) == vt_ok ? vtSucceed(error) : vt_errorFile;
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
    const bool isWhole = ferror(memory) == 0;
    const bool isThere = fclose(memory) == 0 && isWhole; // it flushes, which takes memory
    const vtResult result = isThere ? vtWriteFile(path, text, size, error)
                                    : vtFail(error, vt_errorMemory, "file '%s': out of memory", path);
    free(text);
    return result;
}
