#include "fuzz.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerInitialize(int* count, char*** words);

void require(bool holds)
{
    if (!holds) {
        abort();
    }
}

void requireSentence(vtResult result, const vtError* error)
{
    require(result == vt_ok || error->message[0] != '\0');
}

void requireFinite(const float* numbers, size_t count)
{
    for (size_t i = 0; numbers != NULL && i < count; ++i) {
        require(isfinite(numbers[i]));
    }
}

static void requireVector(vtVec3 v)
{
    require(isfinite(v.x) && isfinite(v.y) && isfinite(v.z));
}

static void requireMesh(const vtMesh* mesh)
{
    const size_t count = mesh->vertexCount;
    requireFinite(mesh->positions, 3 * count);
    requireFinite(mesh->normals, 3 * count);
    requireFinite(mesh->texcoords, 2 * count);
    requireFinite(mesh->texcoords1, 2 * count);
    requireFinite(mesh->colors, 3 * count);
    requireFinite(mesh->alphas, count);
    requireFinite(mesh->tangents, 4 * count);
    requireVector(mesh->boundsMin);
    requireVector(mesh->boundsMax);
    require(isfinite(mesh->volume));
    for (uint32_t i = 0; i < mesh->indexCount; ++i) {
        require(mesh->indices[i] < count);
    }
}

static void requireMaterial(const vtMaterial* material, uint32_t imageCount)
{
    const float numbers[] = {material->ior,
                             material->transmission,
                             material->attenuationDistance,
                             material->metallic,
                             material->roughness,
                             material->alpha,
                             material->alphaCutoff,
                             material->specular,
                             material->iridescence,
                             material->iridescenceIor,
                             material->iridescenceMin,
                             material->iridescenceMax,
                             material->dispersion,
                             material->normalScale,
                             material->occlusionStrength,
                             material->checker};
    requireFinite(numbers, sizeof numbers / sizeof numbers[0]);
    requireVector(material->tint);
    requireVector(material->attenuationColor);
    requireVector(material->baseColor);
    requireVector(material->emissive);
    requireVector(material->specularColor);
    for (int i = 0; i < vt_mapCount; ++i) {
        require(material->maps[i].image < (int)imageCount);
        requireFinite(&material->maps[i].rows[0][0], 6);
    }
}

void requireScene(const vtScene* scene)
{
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        requireMesh(&scene->meshes[i]);
    }
    for (uint32_t i = 0; i < scene->materialCount; ++i) {
        requireMaterial(&scene->materials[i], scene->imageCount);
    }
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtObject* object = &scene->objects[i];
        require(object->mesh < scene->meshCount && object->material < scene->materialCount);
        requireFinite(&object->toWorld.rows[0][0], 12);
    }
    for (uint32_t i = 0; i < scene->lightCount; ++i) {
        requireVector(scene->lights[i].position);
        requireVector(scene->lights[i].direction);
        requireVector(scene->lights[i].color);
    }
    for (uint32_t i = 0; i < scene->cameraCount; ++i) {
        requireVector(scene->cameras[i].view.eye);
        requireVector(scene->cameras[i].view.target);
        require(isfinite(scene->cameras[i].view.fovY) && isfinite(scene->cameras[i].orthographicHeight));
    }
    vtError error;
    if (vtValidateScene(scene, &error) == vt_ok) {
        const vtView view = vtViewOfScene(scene, 45.0f, 1.0f);
        requireVector(view.eye);
        requireVector(view.target);
    }
}

int cutInput(const uint8_t* bytes, size_t size, FuzzFile* files, int most)
{
    static const char mark[] = "\n==\n";
    const size_t length = sizeof mark - 1;
    int count = 0;
    size_t begin = 0;
    for (size_t i = 0; i + length <= size && count < most - 1; ++i) {
        if (memcmp(bytes + i, mark, length) == 0) {
            files[count++] = (FuzzFile){bytes + begin, i - begin};
            begin = i + length;
            i = begin - 1;
        }
    }
    files[count++] = (FuzzFile){bytes + begin, size - begin};
    return count;
}

// ------------------------------------------------------------------------------------------------- memory

/// Larger blocks are refused, as where memory is out: filling those that a few bytes can ask for takes long.
enum { mostBytes = 8 << 20 };

static void* allocate(size_t size, void* userData)
{
    (void)userData;
    return size <= mostBytes ? malloc(size) : NULL;
}

static void* reallocate(void* memory, size_t size, void* userData)
{
    (void)userData;
    return size <= mostBytes ? realloc(memory, size) : NULL;
}

static void release(void* memory, void* userData)
{
    (void)userData;
    free(memory);
}

int LLVMFuzzerInitialize(int* count, char*** words)
{
    (void)count;
    (void)words;
    const vtAllocator allocator = {.allocate = allocate, .reallocate = reallocate, .free = release};
    require(vtSetAllocator(&allocator, NULL) == vt_ok);
    return 0;
}
