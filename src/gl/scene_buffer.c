#include "gl/scene_buffer.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "gl/image_array.h"
#include "gl/object_tree.h"
#include "mesh/hierarchy.h"

/// A mesh while the scene is uploaded.
typedef struct MeshUse {
    bool used, hasAttributes; ///< at all; by an opaque object
    bool isGlass, bothSides;  ///< by one of glass; whose rays meet its triangles from either side
    uint32_t firstAttribute;
    const vtHierarchy* hierarchy; ///< the mesh's own, or `built`; NULL without triangles
    vtHierarchy built;
} MeshUse;

static const char reliefRemedy[] = "draw its reliefs with technique heightfield, which needs none";

static vtResult checkSize(const vtGL* gl, uint64_t records, uint64_t triangles, bool hasReliefs,
                          vtError* error)
{
    GLint largest = 0;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (records <= (uint64_t)largest * VT_RECORDS_A_ROW) {
        return vt_ok;
    }
    return vtFail(error, vt_errorContext,
                  "scene: %llu triangles are more than this GPU can hold (about %llu); %s",
                  (unsigned long long)triangles, (unsigned long long)largest * VT_RECORDS_A_ROW * 4 / 3,
                  hasReliefs ? reliefRemedy : "simplify its meshes");
}

static uint64_t countTriangles(const vtScene* scene, const MeshUse* uses, bool* hasReliefs)
{
    uint64_t triangles = 0;
    *hasReliefs = false;
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        triangles += uses[i].used ? scene->meshes[i].indexCount / 3 : 0;
        *hasReliefs = *hasReliefs || (uses[i].used && scene->meshes[i].heights != NULL);
    }
    return triangles;
}

/// The hierarchies that the meshes lack, and where all of them lie.
static vtResult findHierarchies(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, MeshUse* uses,
                                uint64_t* records, uint64_t* attributes, vtError* error)
{
    bool hasReliefs;
    const uint64_t triangles = countTriangles(scene, uses, &hasReliefs);
    // A record holds two triangles at best: what cannot fit is not built first.
    vtResult result = checkSize(gl, triangles / 2, triangles, hasReliefs, error);
    for (uint32_t i = 0; i < scene->meshCount && result == vt_ok; ++i) {
        const vtMesh* mesh = &scene->meshes[i];
        if (!uses[i].used || mesh->indexCount == 0) {
            continue;
        }
        uses[i].hierarchy = mesh->hierarchy;
        if (mesh->hierarchy == NULL) {
            result = vtCreateHierarchy(mesh, &uses[i].built, error);
            uses[i].hierarchy = &uses[i].built;
            if (result == vt_errorGeometry && mesh->heights != NULL) {
                vtFail(error, result, "scene: %u triangles are more than a hierarchy can hold; %s",
                       mesh->indexCount / 3, reliefRemedy);
            }
        }
        const vtHierarchy* h = uses[i].hierarchy;
        uses[i].bothSides =
            mesh->openEdgeCount > 0 || (result == vt_ok && uses[i].isGlass && vtHierarchy_Overlaps(h));
        uses[i].firstAttribute = (uint32_t)*attributes;
        buffer->meshRecords[i] =
            (vtMeshRecords){(uint32_t)*records, h->recordCount, h->origin, h->gridLow, h->gridScale};
        *records += h->recordCount;
        *attributes += uses[i].hasAttributes ? h->recordCount : 0;
        result = result == vt_ok ? checkSize(gl, *records, triangles, hasReliefs, error) : result;
    }
    return result;
}

static void uploadRecords(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, const MeshUse* uses,
                          uint32_t count)
{
    vtTexture_SizeRecords(&buffer->records, gl, count);
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        if (uses[i].hierarchy != NULL) {
            vtTexture_SetRecords(&buffer->records, gl, buffer->meshRecords[i].first,
                                 uses[i].hierarchy->recordCount, uses[i].hierarchy->records);
        }
    }
}

/// A half float, rounded to nearest; numbers outside its range are cut.
static uint32_t packHalf(float value)
{
    const float cut = vtClamp(value, 0.0f, 65504.0f);
    int exponent;
    const float mantissa = frexpf(cut, &exponent); // 0.5 <= mantissa < 1
    if (exponent < -13) {
        return (uint32_t)lrintf(ldexpf(cut, 24));
    }
    return cut == 0.0f ? 0 : (uint32_t)(lrintf(mantissa * 2048.0f) + ((exponent + 13) << 10));
}

/// Of the corners of each leaf.
static void writeAttributes(const vtMesh* mesh, const vtHierarchy* hierarchy, uint32_t* words)
{
    for (uint32_t i = 0; i < 4 * hierarchy->recordCount; ++i, words += 4) {
        const size_t vertex = hierarchy->corners[i];
        if (hierarchy->corners[i / 4 * 4] == VT_NO_TRIANGLE) { // no leaf
            continue;
        }
        if (mesh->texcoords != NULL) {
            memcpy(words, mesh->texcoords + 2 * vertex, 2 * sizeof(float));
        }
        const float white[3] = {1.0f, 1.0f, 1.0f};
        const float* color = mesh->colors != NULL ? mesh->colors + 3 * vertex : white;
        words[2] = packHalf(color[0]) | packHalf(color[1]) << 16;
        words[3] = packHalf(color[2]);
    }
}

static vtResult uploadAttributes(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene,
                                 const MeshUse* uses, uint32_t count, vtError* error)
{
    vtTexture_SizeRecords(&buffer->attributes, gl, count);
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        const vtHierarchy* hierarchy = uses[i].hierarchy;
        if (!uses[i].hasAttributes || hierarchy == NULL) {
            continue;
        }
        uint32_t* words = calloc(hierarchy->recordCount, VT_RECORD_WORDS * sizeof *words);
        if (words == NULL) {
            return vtFail(error, vt_errorMemory, "scene: out of memory for the attributes of %u triangles",
                          scene->meshes[i].indexCount / 3);
        }
        writeAttributes(&scene->meshes[i], hierarchy, words);
        vtTexture_SetRecords(&buffer->attributes, gl, uses[i].firstAttribute, hierarchy->recordCount, words);
        free(words);
    }
    return vt_ok;
}

static vtResult uploadMeshes(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, const MeshUse* uses,
                             vtError* error)
{
    vtResult result = vt_ok;
    for (uint32_t i = 0; i < scene->meshCount && result == vt_ok; ++i) {
        if (uses[i].hierarchy != NULL) {
            result = vtMeshBuffer_Create(&buffer->meshes[i], gl, &scene->meshes[i],
                                         buffer->meshRecords[i].origin, error);
            buffer->meshBytes += buffer->meshes[i].bytes;
        }
    }
    return result;
}

static void extend(vtVec3* low, vtVec3* high, const vtPlacedObject* placed)
{
    *low = (vtVec3){fminf(low->x, placed->low.x), fminf(low->y, placed->low.y), fminf(low->z, placed->low.z)};
    *high = (vtVec3){fmaxf(high->x, placed->high.x), fmaxf(high->y, placed->high.y),
                     fmaxf(high->z, placed->high.z)};
}

/// Moves an object's coordinates to the middle of its mesh and of the scene.
static void placeObject(const vtSceneBuffer* buffer, const vtMesh* mesh, vtObjectBuffer* object)
{
    const vtVec3 origin = buffer->meshRecords[object->mesh].origin;
    object->placed.mesh = mesh;
    object->placed.toWorld = object->source;
    vtPlacedObject_Recentre(&object->placed, origin, buffer->origin);
    object->ownMin = vtSub(mesh->boundsMin, origin);
    object->ownMax = vtSub(mesh->boundsMax, origin);
}

static void findBoxes(vtSceneBuffer* buffer)
{
    buffer->low = buffer->glassMin = (vtVec3){FLT_MAX, FLT_MAX, FLT_MAX};
    buffer->high = buffer->glassMax = (vtVec3){-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (uint32_t i = 0; i < buffer->objectCount; ++i) {
        extend(&buffer->low, &buffer->high, &buffer->objects[i].placed);
        if (i < buffer->glassCount || buffer->glassCount == 0) {
            extend(&buffer->glassMin, &buffer->glassMax, &buffer->objects[i].placed);
        }
    }
}

static void keepObjects(vtSceneBuffer* buffer, const vtScene* scene, const vtPlacedObject* placed,
                        const MeshUse* uses)
{
    vtVec3 low = {FLT_MAX, FLT_MAX, FLT_MAX}, high = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        extend(&low, &high, &placed[i]);
    }
    buffer->origin = vtScale(vtAdd(low, high), 0.5f);
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const MeshUse* use = &uses[placed[i].meshIndex];
        const bool opaque = placed[i].material->opaque;
        buffer->objects[i] = (vtObjectBuffer){
            .placed = placed[i],
            .material = *placed[i].material,
            .mesh = placed[i].meshIndex,
            .firstAttribute = opaque && use->hasAttributes ? use->firstAttribute : VT_NO_TRIANGLE,
            .source = placed[i].toWorld,
            .bothSides = opaque || use->bothSides,
        };
        placeObject(buffer, placed[i].mesh, &buffer->objects[i]);
    }
    findBoxes(buffer);
}

static vtResult allocate(vtSceneBuffer* buffer, const vtScene* scene, vtError* error)
{
    const size_t table = VT_OBJECT_TEXELS * 4 * sizeof *buffer->words;
    buffer->objects = calloc(scene->objectCount, sizeof *buffer->objects);
    buffer->words = calloc(scene->objectCount, table);
    buffer->fresh = calloc(scene->objectCount, table);
    buffer->order = calloc(scene->objectCount, sizeof *buffer->order);
    buffer->meshes = calloc(scene->meshCount, sizeof *buffer->meshes);
    buffer->meshRecords = calloc(scene->meshCount, sizeof *buffer->meshRecords);
    if (buffer->objects == NULL || buffer->words == NULL || buffer->fresh == NULL || buffer->order == NULL ||
        buffer->meshes == NULL || buffer->meshRecords == NULL) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for %u objects", scene->objectCount);
    }
    buffer->objectCount = scene->objectCount;
    buffer->meshCount = scene->meshCount;
    return vt_ok;
}

static vtResult createBuffer(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene,
                             const vtPlacedObject* placed, MeshUse* uses, vtError* error)
{
    uint64_t records = 0, attributes = 0;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtMesh* mesh = placed[i].mesh;
        MeshUse* use = &uses[placed[i].meshIndex];
        use->used = true;
        use->isGlass |= !placed[i].material->opaque;
        use->hasAttributes |= placed[i].material->opaque && (mesh->texcoords != NULL || mesh->colors != NULL);
    }
    vtResult result = allocate(buffer, scene, error);
    if (result == vt_ok) {
        result = findHierarchies(buffer, gl, scene, uses, &records, &attributes, error);
    }
    if (result == vt_ok) {
        result = uploadMeshes(buffer, gl, scene, uses, error);
    }
    if (result == vt_ok) {
        uploadRecords(buffer, gl, scene, uses, (uint32_t)records);
        result = uploadAttributes(buffer, gl, scene, uses, (uint32_t)attributes, error);
    }
    if (result == vt_ok && buffer->glassCount < buffer->objectCount) {
        result = vtImageArray_Upload(&buffer->images, gl, scene, error);
    }
    if (result != vt_ok) {
        return result;
    }
    keepObjects(buffer, scene, placed, uses);
    buffer->heightsMesh = vtScene_Relief(scene);
    if (buffer->heightsMesh < scene->meshCount) {
        result =
            vtHeightTexture_Create(&buffer->heights, gl, scene->meshes[buffer->heightsMesh].heights, error);
    }
    if (result == vt_ok) {
        result = vtObjectTree_Upload(&buffer->tree, gl, buffer->objects, scene->objectCount, error);
    }
    buffer->meshBytes += vtTexture_Bytes(&buffer->records);
    return result == vt_ok ? vtCheckGL(gl, "uploading the scene", error) : result;
}

vtResult vtSceneBuffer_Create(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, vtError* error)
{
    *buffer = (vtSceneBuffer){0};
    vtPlacedObject* placed;
    vtResult result = vtPlaceObjects(scene, &placed, &buffer->glassCount, error);
    if (result != vt_ok) {
        return result;
    }
    MeshUse* uses = calloc(scene->meshCount, sizeof *uses);
    result = uses != NULL ? createBuffer(buffer, gl, scene, placed, uses, error)
                          : vtFail(error, vt_errorMemory, "scene: out of memory");
    for (uint32_t i = 0; i < scene->meshCount && uses != NULL; ++i) {
        vtDestroyHierarchy(&uses[i].built);
    }
    free(uses);
    free(placed);
    if (result != vt_ok) {
        vtSceneBuffer_Destroy(buffer, gl);
    }
    return result;
}

bool vtSceneBuffer_UpdateMesh(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, uint32_t mesh)
{
    const vtMesh* from = &scene->meshes[mesh];
    const vtHierarchy* h = from->hierarchy;
    vtMeshRecords* records = &buffer->meshRecords[mesh];
    if (scene->meshCount != buffer->meshCount || h == NULL || h->recordCount != records->count ||
        mesh == buffer->heightsMesh || !vtMeshBuffer_Update(&buffer->meshes[mesh], gl, from, h->origin)) {
        return false;
    }
    *records = (vtMeshRecords){records->first, h->recordCount, h->origin, h->gridLow, h->gridScale};
    vtTexture_SetRecords(&buffer->records, gl, records->first, h->recordCount, h->records);
    const bool bothSides = from->openEdgeCount > 0 || vtHierarchy_Overlaps(h);
    for (uint32_t i = 0; i < buffer->objectCount; ++i) {
        if (buffer->objects[i].mesh == mesh) {
            placeObject(buffer, from, &buffer->objects[i]);
            buffer->objects[i].bothSides = buffer->objects[i].material.opaque || bothSides;
        }
    }
    findBoxes(buffer);
    return vtObjectTree_Upload(&buffer->tree, gl, buffer->objects, buffer->objectCount, NULL) == vt_ok;
}

void vtSceneBuffer_Destroy(vtSceneBuffer* buffer, const vtGL* gl)
{
    for (uint32_t i = 0; i < buffer->meshCount; ++i) {
        vtMeshBuffer_Destroy(&buffer->meshes[i], gl);
    }
    free(buffer->meshes);
    free(buffer->meshRecords);
    free(buffer->objects);
    free(buffer->words);
    free(buffer->fresh);
    free(buffer->order);
    vtTexture_Destroy(&buffer->records, gl);
    vtTexture_Destroy(&buffer->tree, gl);
    vtHeightTexture_Destroy(&buffer->heights, gl);
    vtTexture_Destroy(&buffer->attributes, gl);
    vtTexture_Destroy(&buffer->images, gl);
    vtTexture_Destroy(&buffer->table, gl);
    *buffer = (vtSceneBuffer){0};
}

bool vtSceneBuffer_SetTable(vtSceneBuffer* buffer, const vtGL* gl)
{
    const size_t size = (size_t)buffer->objectCount * VT_OBJECT_TEXELS * 4 * sizeof *buffer->words;
    if (buffer->table.name != 0 && memcmp(buffer->fresh, buffer->words, size) == 0) {
        return false;
    }
    memcpy(buffer->words, buffer->fresh, size);
    vtTexture_Resize(&buffer->table, gl, GL_RGBA32UI, VT_OBJECT_TEXELS, (int)buffer->objectCount, 0);
    vtTexture_Bind(&buffer->table, gl, 0);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, VT_OBJECT_TEXELS, (GLsizei)buffer->objectCount, GL_RGBA_INTEGER,
                      GL_UNSIGNED_INT, buffer->words);
    return true;
}

static float distanceFrom(vtVec3 eye, const vtPlacedObject* placed)
{
    return vtLength(vtSub(vtScale(vtAdd(placed->low, placed->high), 0.5f), eye));
}

void vtSceneBuffer_SortGlass(vtSceneBuffer* buffer, vtVec3 eye)
{
    for (uint32_t i = 0; i < buffer->glassCount; ++i) {
        const float distance = distanceFrom(eye, &buffer->objects[i].placed);
        uint32_t place = i;
        while (place > 0 && distanceFrom(eye, &buffer->objects[buffer->order[place - 1]].placed) > distance) {
            buffer->order[place] = buffer->order[place - 1];
            --place;
        }
        buffer->order[place] = i;
    }
}

void vtSceneBuffer_Draw(const vtSceneBuffer* buffer, const vtGL* gl, const vtProgram* program, uint32_t first,
                        uint32_t last)
{
    for (uint32_t i = first; i < last; ++i) {
        const vtPlacedObject* placed = &buffer->objects[i].placed;
        // In the order of VT_OBJECT_UNIFORMS.
        gl->Uniform4fv(program->uniforms[0], 3, &placed->toWorld.rows[0][0]);
        gl->Uniform4fv(program->uniforms[1], 3, &placed->toObject.rows[0][0]);
        gl->Uniform1i(program->uniforms[2], (GLint)i);
        gl->Uniform1i(program->uniforms[3], placed->mirrored);
        vtMeshBuffer_Draw(&buffer->meshes[buffer->objects[i].mesh], gl);
    }
}

size_t vtSceneBuffer_TextureBytes(const vtSceneBuffer* buffer)
{
    return vtTexture_Bytes(&buffer->attributes) + vtTexture_Bytes(&buffer->images) +
           vtTexture_Bytes(&buffer->table) + vtTexture_Bytes(&buffer->tree) +
           vtHeightTexture_Bytes(&buffer->heights);
}
