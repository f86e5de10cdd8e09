// `vitrine inspect`: what is in a glTF file, and what of it is drawn.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/files.h"
#include "cli/json.h"
#include "gltf/model_facts.h"

/// Of a scene's objects.
typedef struct Sums {
    unsigned long long triangles; ///< each as often as it is placed
    vtVec3 low, high;
    size_t bytes; ///< of meshes and pictures in memory
} Sums;

static Sums sumUp(const vtScene* scene)
{
    vtScene all = *scene; // with every object, not the glass alone
    vtMaterial opaque = vtDefaultMaterial();
    opaque.opaque = true;
    all.materials = &opaque;
    all.materialCount = 1;
    all.objects = malloc(scene->objectCount * sizeof *all.objects);
    Sums sums = {0};
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        sums.triangles += scene->meshes[scene->objects[i].mesh].indexCount / 3;
        if (all.objects != NULL) {
            all.objects[i] = scene->objects[i];
            all.objects[i].material = 0;
        }
    }
    vtScene_Bounds(&all, &sums.low, &sums.high);
    free(all.objects);
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        const vtMesh* mesh = &scene->meshes[i];
        const size_t floats = 6 + (mesh->texcoords != NULL ? 2 : 0) + (mesh->colors != NULL ? 3 : 0);
        sums.bytes += 4 * (floats * mesh->vertexCount + mesh->indexCount);
    }
    for (uint32_t i = 0; i < scene->imageCount; ++i) {
        sums.bytes += 4 * (size_t)scene->images[i].width * (size_t)scene->images[i].height;
    }
    return sums;
}

// ------------------------------------------------------------------------------------------------- text

/// A text of lines as one, ", " between them.
static void printLines(const char* title, const char* lines)
{
    if (lines == NULL) {
        return;
    }
    printf("%-12s", title);
    for (const char* line = lines; *line != '\0';) {
        const size_t length = strcspn(line, "\n");
        printf("%s%.*s", line == lines ? "" : ", ", (int)length, line);
        line += length + (line[length] != '\0');
    }
    printf("\n");
}

static void printObjects(const vtScene* scene)
{
    printf("\n%8s %10s %9s  %-6s %-6s  %s\n", "object", "triangles", "vertices", "solid", "made", "name");
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtObject* object = &scene->objects[i];
        const vtMesh* mesh = &scene->meshes[object->mesh];
        printf("%8u %10u %9u  %-6s %-6s  %s\n", i, mesh->indexCount / 3, mesh->vertexCount,
               mesh->openEdgeCount > 0 ? "open" : "closed",
               scene->materials[object->material].opaque ? "opaque" : "glass", object->name);
    }
}

static void printMaterials(const vtModelFacts* facts)
{
    printf("\n%8s  %s\n", "material", "name");
    for (uint32_t i = 0; i < facts->usedMaterialCount; ++i) {
        const vtMaterialFacts* material = &facts->materials[i];
        if (material->index < 0) {
            printf("%8s  %s\n", "-", "(glTF's default)");
            continue;
        }
        printf("%8d  %s\n", material->index, material->name);
        if (material->drawn[0] != '\0') {
            printf("%8s  drawn: %s\n", "", material->drawn);
        }
        if (material->ignored[0] != '\0') {
            printf("%8s  ignored: %s\n", "", material->ignored);
        }
    }
}

static void printCameras(const vtScene* scene)
{
    if (scene->cameraCount > 0) {
        printf("\n%8s  %-13s %-24s %s\n", "camera", "kind", "eye", "name");
    }
    for (uint32_t i = 0; i < scene->cameraCount; ++i) {
        const vtSceneCamera* camera = &scene->cameras[i];
        char eye[64];
        snprintf(eye, sizeof eye, "%.4g, %.4g, %.4g", (double)camera->view.eye.x, (double)camera->view.eye.y,
                 (double)camera->view.eye.z);
        printf("%8u  %-13s %-24s %s\n", i, camera->orthographicHeight > 0.0f ? "orthographic" : "perspective",
               eye, camera->name);
    }
}

static void printAnimations(const vtModelFacts* facts)
{
    if (facts->animationCount > 0) {
        printf("\n%8s %10s  %s\n", "animation", "seconds", "name");
    }
    for (uint32_t i = 0; i < facts->animationCount; ++i) {
        printf("%9u %10.4g  %s\n", i, facts->animations[i].duration, facts->animations[i].name);
    }
}

static void printText(const char* name, const vtScene* scene, const vtModelFacts* facts)
{
    const Sums sums = sumUp(scene);
    printf("%-12s%s\n", "file", name);
    printf("%-12s%u, %llu triangles, %u meshes%s\n", "objects", scene->objectCount, sums.triangles,
           scene->meshCount, scene->allGlass ? "; no material is glass, so all are taken for glass" : "");
    printf("%-12s%g %g %g to %g %g %g\n", "box", (double)sums.low.x, (double)sums.low.y, (double)sums.low.z,
           (double)sums.high.x, (double)sums.high.y, (double)sums.high.z);
    printf("%-12s%.1f MB of meshes and pictures\n", "memory", (double)sums.bytes / 1e6);
    printf("%-12s%u nodes, %u meshes, %u materials, %u textures, %u images, %u skins, %u animations, %u "
           "lights\n",
           "in the file", facts->nodeCount, facts->meshCount, facts->materialCount, facts->textureCount,
           facts->imageCount, facts->skinCount, facts->animationCount, facts->lightCount);
    printLines("variants", facts->variants);
    printLines("used", facts->used);
    printLines("required", facts->required);
    printLines("notes", scene->notes);
    printObjects(scene);
    printMaterials(facts);
    printCameras(scene);
    printAnimations(facts);
}

// ------------------------------------------------------------------------------------------------- JSON

static void writeLines(vtJson* json, const char* name, const char* lines)
{
    vtJson_BeginArray(json, name);
    for (const char* line = lines; line != NULL && *line != '\0';) {
        const size_t length = strcspn(line, "\n");
        char text[1024];
        snprintf(text, sizeof text, "%.*s", (int)length, line);
        vtJson_Text(json, NULL, text);
        line += length + (line[length] != '\0');
    }
    vtJson_EndArray(json);
}

static void writeVector(vtJson* json, const char* name, vtVec3 v)
{
    vtJson_BeginArray(json, name);
    vtJson_Float(json, NULL, v.x);
    vtJson_Float(json, NULL, v.y);
    vtJson_Float(json, NULL, v.z);
    vtJson_EndArray(json);
}

static void writeObjects(vtJson* json, const vtScene* scene)
{
    vtJson_BeginArray(json, "objects");
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtObject* object = &scene->objects[i];
        const vtMesh* mesh = &scene->meshes[object->mesh];
        vtJson_BeginObject(json, NULL);
        vtJson_Text(json, "name", object->name);
        vtJson_Text(json, "made", scene->materials[object->material].opaque ? "opaque" : "glass");
        vtJson_Integer(json, "mesh", object->mesh);
        vtJson_Integer(json, "triangles", mesh->indexCount / 3);
        vtJson_Integer(json, "vertices", mesh->vertexCount);
        vtJson_Integer(json, "openEdges", mesh->openEdgeCount);
        vtJson_EndObject(json);
    }
    vtJson_EndArray(json);
}

static void writeMaterials(vtJson* json, const vtModelFacts* facts)
{
    vtJson_BeginArray(json, "materials");
    for (uint32_t i = 0; i < facts->usedMaterialCount; ++i) {
        const vtMaterialFacts* material = &facts->materials[i];
        vtJson_BeginObject(json, NULL);
        vtJson_Integer(json, "index", material->index);
        vtJson_Text(json, "name", material->name);
        vtJson_Text(json, "drawn", material->drawn);
        vtJson_Text(json, "ignored", material->ignored);
        vtJson_EndObject(json);
    }
    vtJson_EndArray(json);
}

static void writeCameras(vtJson* json, const vtScene* scene)
{
    vtJson_BeginArray(json, "cameras");
    for (uint32_t i = 0; i < scene->cameraCount; ++i) {
        const vtSceneCamera* camera = &scene->cameras[i];
        vtJson_BeginObject(json, NULL);
        vtJson_Text(json, "name", camera->name);
        writeVector(json, "eye", camera->view.eye);
        writeVector(json, "target", camera->view.target);
        vtJson_Number(json, "fov", (double)camera->view.fovY, 4);
        vtJson_Float(json, "orthographicHeight", camera->orthographicHeight);
        vtJson_EndObject(json);
    }
    vtJson_EndArray(json);
}

static void writeAnimations(vtJson* json, const vtModelFacts* facts)
{
    vtJson_BeginArray(json, "animations");
    for (uint32_t i = 0; i < facts->animationCount; ++i) {
        vtJson_BeginObject(json, NULL);
        vtJson_Text(json, "name", facts->animations[i].name);
        vtJson_Number(json, "duration", facts->animations[i].duration, 6);
        vtJson_EndObject(json);
    }
    vtJson_EndArray(json);
}

static void printJson(const char* name, const vtScene* scene, const vtModelFacts* facts)
{
    const Sums sums = sumUp(scene);
    const struct {
        const char* name;
        long long count;
    } counts[] = {
        {"nodes", facts->nodeCount},
        {"meshesInFile", facts->meshCount},
        {"materialsInFile", facts->materialCount},
        {"textures", facts->textureCount},
        {"images", facts->imageCount},
        {"skins", facts->skinCount},
        {"lights", facts->lightCount},
    };
    vtJson json = {.out = stdout};
    vtJson_BeginObject(&json, NULL);
    vtJson_Text(&json, "file", name);
    vtJson_Integer(&json, "triangles", (long long)sums.triangles);
    vtJson_Integer(&json, "meshes", scene->meshCount);
    vtJson_Integer(&json, "allGlass", scene->allGlass);
    vtJson_Integer(&json, "bytes", (long long)sums.bytes);
    writeVector(&json, "boundsMin", sums.low);
    writeVector(&json, "boundsMax", sums.high);
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; ++i) {
        vtJson_Integer(&json, counts[i].name, counts[i].count);
    }
    writeLines(&json, "variants", facts->variants);
    writeLines(&json, "extensionsUsed", facts->used);
    writeLines(&json, "extensionsRequired", facts->required);
    writeLines(&json, "notes", scene->notes);
    writeObjects(&json, scene);
    writeMaterials(&json, facts);
    writeCameras(&json, scene);
    writeAnimations(&json, facts);
    vtJson_EndObject(&json);
    printf("\n");
}

vtResult vtRunInspect(const vtOptions* options, vtError* error)
{
    if (options->model == NULL) {
        return vtFail(error, vt_errorArgument, "no file given; name a .glb or .gltf file");
    }
    uint8_t* bytes;
    size_t size;
    vtModelFolders folders;
    vtResult result = vtReadInput(options->model, &options->limits, &bytes, &size, error);
    if (result != vt_ok) {
        return result;
    }
    result = vtFindModelFolders(options->model, options->root, &folders, error);
    const vtModelDef def = {.bytes = bytes,
                            .size = size,
                            .name = options->model,
                            .directory = folders.directory,
                            .root = folders.root[0] != '\0' ? folders.root : NULL,
                            .readFile = vtReadFileForModel,
                            .userData = &folders,
                            .limits = options->limits};
    vtScene scene;
    vtModelFacts facts;
    if (result == vt_ok) {
        result = vtInspectModel(&def, &scene, &facts, error);
    }
    vtFree(bytes);
    if (result == vt_ok) {
        (options->json ? printJson : printText)(options->model, &scene, &facts);
        vtDestroyModelFacts(&facts);
        vtDestroyScene(&scene);
    }
    return result;
}
