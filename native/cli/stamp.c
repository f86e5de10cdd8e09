#define _GNU_SOURCE // memmem
#include "cli/stamp.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/files.h"
#include "image/image.h"

void vtWriteStamp(uint64_t stamp, char* comment, size_t size)
{
    snprintf(comment, size, "vitrine " VT_VERSION " stamp %016" PRIx64, stamp);
}

bool vtIsDrawn(const char* path, const char* comment, int width, int height)
{
    struct stat status;
    uint8_t* bytes;
    size_t size;
    vtError error;
    if (stat(path, &status) != 0 || !S_ISREG(status.st_mode) ||
        vtReadInput(path, NULL, &bytes, &size, &error) != vt_ok) {
        return false;
    }
    float* pixels = NULL;
    int pictureWidth = 0, pictureHeight = 0;
    // The comment stands in the header; all of the picture must decode.
    bool isDrawn = memmem(bytes, size < 4096 ? size : 4096, comment, strlen(comment)) != NULL;
    isDrawn = isDrawn &&
              vtDecodeImageLinear(bytes, size, path, &pixels, &pictureWidth, &pictureHeight, &error) == vt_ok;
    vtFree(pixels);
    vtFree(bytes);
    return isDrawn && pictureWidth == width && pictureHeight == height;
}
