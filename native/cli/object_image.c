#include "cli/object_image.h"

#include "base/error.h"
#include "base/memory.h"
#include "cli/files.h"
#include "cli/hash.h"
#include "image/image.h"

vtResult vtAddObjectImage(const char* path, const vtLimits* limits, vtScene* scene, uint64_t* contents,
                          vtError* error)
{
    uint8_t* bytes;
    size_t size;
    vtImage image = {0};
    vtResult result = vtReadInput(path, limits, &bytes, &size, error);
    if (result == vt_ok) {
        *contents = vtHash(*contents, bytes, size);
        result = vtCheckPicture(bytes, size, path, limits, 4, NULL, error);
        result = result == vt_ok ? vtDecodeImage(bytes, size, path, &image, error) : result;
        vtFree(bytes);
    }
    if (result != vt_ok) {
        return result;
    }
    vtImage* images = vtReallocate(scene->images, scene->imageCount + 1, sizeof *images);
    if (images == NULL) {
        vtFree(image.pixels);
        return vtFail(error, vt_errorMemory, "'%.200s': out of memory", path);
    }
    images[scene->imageCount] = image;
    scene->images = images;
    for (uint32_t i = 0; i < scene->materialCount; ++i) {
        if (scene->materials[i].opaque) {
            scene->materials[i].maps[vt_mapBaseColor].image = (int)scene->imageCount;
        }
    }
    ++scene->imageCount;
    return vt_ok;
}
