// libFuzzer target: whatever the bytes of a glTF file and of the files beside it, it becomes a scene of
// finite numbers or a sentence, and nothing outside its folder is asked for. The input is the file, and
// behind "\n==\n" each, what is beside it.
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "gltf/model_facts.h"

#define FOLDER "folder/"

typedef struct Beside {
    FuzzFile files[8];
    int count, read;
} Beside;

/// The path stays below the folder: no part of it leads further up than the parts before it led down.
static void requireInside(const char* path)
{
    require(strncmp(path, FOLDER, strlen(FOLDER)) == 0);
    int depth = 0;
    for (const char* part = path + strlen(FOLDER); part != NULL;) {
        const size_t length = strcspn(part, "/");
        depth += length == 2 && memcmp(part, "..", 2) == 0                   ? -1
                 : length == 0 || (length == 1 && memcmp(part, ".", 1) == 0) ? 0
                                                                             : 1;
        require(depth >= 0);
        part = part[length] == '/' ? part + length + 1 : NULL;
    }
}

/// Whatever is asked for, the next of the files.
static vtResult readBeside(const char* path, size_t limit, uint8_t** bytes, size_t* size, void* userData,
                           vtError* error)
{
    Beside* beside = userData;
    requireInside(path);
    if (beside->count < 2) {
        error->message[0] = '\0';
        return vt_errorFile;
    }
    const FuzzFile file = beside->files[1 + beside->read++ % (beside->count - 1)];
    *size = file.size < limit ? file.size : limit;
    *bytes = vtAllocate(*size, 1);
    require(*bytes != NULL);
    memcpy(*bytes, file.bytes, *size);
    return vt_ok;
}

int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size)
{
    Beside beside = {0};
    beside.count = cutInput(bytes, size, beside.files, 8);
    const vtModelDef def = {.bytes = beside.files[0].bytes,
                            .size = beside.files[0].size,
                            .name = "fuzz",
                            .directory = FOLDER,
                            .readFile = readBeside,
                            .userData = &beside};
    vtScene scene;
    vtModelFacts facts;
    vtError error = {0};
    const vtResult result = vtInspectModel(&def, &scene, &facts, &error);
    require((result == vt_ok) == (scene.objectCount > 0));
    requireSentence(result, &error);
    requireScene(&scene);
    requireSentence(vtValidateScene(&scene, &error), &error);
    vtDestroyModelFacts(&facts);
    vtDestroyScene(&scene);
    return 0;
}
