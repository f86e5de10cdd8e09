#include "gl/scene_buffer.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "gl/image_array.h"
#include "scene/triangles.h"

/// Which meshes are used at all, and which of them by opaque objects with attributes; number of the first
/// triangle of each among those of all.
typedef struct MeshUse {
    bool used, hasAttributes;
    uint32_t firstTriangle, firstAttribute;
} MeshUse;

static vtResult checkSize(const vtGL* gl, uint64_t triangles, bool hasReliefs, vtError* error)
{
    GLint largest = 0;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    const uint64_t rows = (triangles + VT_TRIANGLES_A_ROW - 1) / VT_TRIANGLES_A_ROW;
    if (rows > (uint64_t)largest) {
        return vtFail(error, vt_errorContext,
                      "scene: %llu triangles are more than this GPU can hold (%llu); %s",
                      (unsigned long long)triangles, (unsigned long long)largest * VT_TRIANGLES_A_ROW,
                      hasReliefs ? "draw its reliefs with technique heightfield, which needs none"
                                 : "simplify its meshes");
    }
    return vt_ok;
}

/// Rows of records are whole: the texture's last one is filled up with nothing.
static uint32_t* allocateRecords(uint32_t count, size_t words)
{
    const size_t rows = ((size_t)count + VT_TRIANGLES_A_ROW - 1) / VT_TRIANGLES_A_ROW;
    return calloc(rows * VT_TRIANGLES_A_ROW + 1, words * sizeof(uint32_t));
}

static vtResult uploadTriangles(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene,
                                const MeshUse* uses, uint32_t count, vtError* error)
{
    uint32_t* records = allocateRecords(count, VT_TRIANGLE_WORDS);
    bool ready = records != NULL;
    for (uint32_t mesh = 0; mesh < scene->meshCount && ready; ++mesh) {
        uint32_t* own = uses[mesh].used ? vtCreateTriangleRecords(&scene->meshes[mesh]) : NULL;
        ready = own != NULL || !uses[mesh].used;
        if (own == NULL) {
            continue;
        }
        const uint32_t first = uses[mesh].firstTriangle, own3 = scene->meshes[mesh].indexCount / 3;
        for (uint32_t i = 0; i < 3 * own3; ++i) { // neighbours
            uint32_t* neighbour = &own[VT_TRIANGLE_WORDS * (size_t)(i / 3) + 4 * (i % 3) + 3];
            *neighbour += *neighbour != VT_NO_TRIANGLE ? first : 0;
        }
        memcpy(records + VT_TRIANGLE_WORDS * (size_t)first, own,
               VT_TRIANGLE_WORDS * sizeof *own * (size_t)own3);
        free(own);
    }
    if (ready) {
        vtTexture_UploadRecords(&buffer->triangles, gl, records, count > 0 ? (int)count : 1,
                                VT_TRIANGLE_WORDS / 4, VT_TRIANGLES_A_ROW);
    }
    free(records);
    return ready ? vt_ok : vtFail(error, vt_errorMemory, "scene: out of memory for %u triangles", count);
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

static void writeAttributes(const vtMesh* mesh, uint32_t* records)
{
    for (uint32_t i = 0; i < mesh->indexCount; ++i) {
        const size_t vertex = mesh->indices[i];
        uint32_t* record = records + 4 * (size_t)i;
        if (mesh->texcoords != NULL) {
            memcpy(record, mesh->texcoords + 2 * vertex, 2 * sizeof(float));
        }
        const float white[3] = {1.0f, 1.0f, 1.0f};
        const float* color = mesh->colors != NULL ? mesh->colors + 3 * vertex : white;
        record[2] = packHalf(color[0]) | packHalf(color[1]) << 16;
        record[3] = packHalf(color[2]);
    }
}

static vtResult uploadAttributes(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene,
                                 const MeshUse* uses, uint32_t count, vtError* error)
{
    uint32_t* records = allocateRecords(count, 12);
    if (records == NULL) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for the attributes of %u triangles",
                      count);
    }
    for (uint32_t mesh = 0; mesh < scene->meshCount; ++mesh) {
        if (uses[mesh].hasAttributes) {
            writeAttributes(&scene->meshes[mesh], records + 12 * (size_t)uses[mesh].firstAttribute);
        }
    }
    vtTexture_UploadRecords(&buffer->attributes, gl, records, count > 0 ? (int)count : 1, 3,
                            VT_TRIANGLES_A_ROW);
    free(records);
    return vt_ok;
}

static vtResult uploadMeshes(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene, const MeshUse* uses,
                             vtError* error)
{
    vtResult result = vt_ok;
    buffer->meshes = calloc(scene->meshCount, sizeof *buffer->meshes);
    buffer->cubeFrames = calloc(scene->meshCount, sizeof *buffer->cubeFrames);
    if (buffer->meshes == NULL || buffer->cubeFrames == NULL) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for %u meshes", scene->meshCount);
    }
    buffer->meshCount = scene->meshCount;
    for (uint32_t i = 0; i < scene->meshCount && result == vt_ok; ++i) {
        if (uses[i].used && scene->meshes[i].indexCount > 0) {
            result =
                vtMeshBuffer_Create(&buffer->meshes[i], gl, &scene->meshes[i], uses[i].firstTriangle, error);
            buffer->cubeFrames[i] = vtFitCube(&scene->meshes[i]);
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

static void keepObjects(vtSceneBuffer* buffer, const vtScene* scene, const vtPlacedObject* placed,
                        const MeshUse* uses)
{
    buffer->low = buffer->glassMin = (vtVec3){FLT_MAX, FLT_MAX, FLT_MAX};
    buffer->high = buffer->glassMax = (vtVec3){-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const MeshUse* use = &uses[placed[i].meshIndex];
        const bool attributes = placed[i].material->opaque && use->hasAttributes;
        buffer->objects[i] = (vtObjectBuffer){placed[i],
                                              *placed[i].material,
                                              placed[i].meshIndex,
                                              attributes ? use->firstAttribute : VT_NO_TRIANGLE,
                                              placed[i].mesh->boundsMin,
                                              placed[i].mesh->boundsMax};
        extend(&buffer->low, &buffer->high, &placed[i]);
        if (i < buffer->glassCount || buffer->glassCount == 0) {
            extend(&buffer->glassMin, &buffer->glassMax, &placed[i]);
        }
    }
}

static vtResult createBuffer(vtSceneBuffer* buffer, const vtGL* gl, const vtScene* scene,
                             const vtPlacedObject* placed, MeshUse* uses, vtError* error)
{
    uint64_t triangles = 0, attributes = 0;
    bool hasReliefs = false;
    for (uint32_t i = 0; i < scene->objectCount; ++i) {
        const vtMesh* mesh = placed[i].mesh;
        MeshUse* use = &uses[placed[i].meshIndex];
        use->used = true;
        hasReliefs = hasReliefs || mesh->heights != NULL;
        use->hasAttributes |= placed[i].material->opaque && (mesh->texcoords != NULL || mesh->colors != NULL);
    }
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        uses[i].firstTriangle = (uint32_t)triangles;
        uses[i].firstAttribute = (uint32_t)attributes;
        triangles += uses[i].used ? scene->meshes[i].indexCount / 3 : 0;
        attributes += uses[i].hasAttributes ? scene->meshes[i].indexCount / 3 : 0;
    }
    buffer->objects = calloc(scene->objectCount, sizeof *buffer->objects);
    buffer->words = calloc(scene->objectCount, VT_OBJECT_TEXELS * 4 * sizeof *buffer->words);
    buffer->order = calloc(scene->objectCount, sizeof *buffer->order);
    if (buffer->objects == NULL || buffer->words == NULL || buffer->order == NULL) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for %u objects", scene->objectCount);
    }
    buffer->objectCount = scene->objectCount;
    vtResult result = checkSize(gl, triangles, hasReliefs, error);
    if (result == vt_ok) {
        result = uploadMeshes(buffer, gl, scene, uses, error);
    }
    if (result == vt_ok) {
        result = uploadTriangles(buffer, gl, scene, uses, (uint32_t)triangles, error);
    }
    if (result == vt_ok) {
        result = uploadAttributes(buffer, gl, scene, uses, (uint32_t)attributes, error);
    }
    if (result == vt_ok && buffer->glassCount < buffer->objectCount) {
        result = vtImageArray_Upload(&buffer->images, gl, scene, error);
    }
    keepObjects(buffer, scene, placed, uses);
    buffer->heightsMesh = vtScene_Relief(scene);
    if (buffer->heightsMesh < scene->meshCount && result == vt_ok) {
        result =
            vtHeightTexture_Create(&buffer->heights, gl, scene->meshes[buffer->heightsMesh].heights, error);
    }
    buffer->meshBytes += vtTexture_Bytes(&buffer->triangles);
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
    free(uses);
    free(placed);
    if (result != vt_ok) {
        vtSceneBuffer_Destroy(buffer, gl);
    }
    return result;
}

void vtSceneBuffer_Destroy(vtSceneBuffer* buffer, const vtGL* gl)
{
    for (uint32_t i = 0; i < buffer->meshCount; ++i) {
        vtMeshBuffer_Destroy(&buffer->meshes[i], gl);
    }
    free(buffer->meshes);
    free(buffer->cubeFrames);
    free(buffer->objects);
    free(buffer->words);
    free(buffer->order);
    vtTexture_Destroy(&buffer->triangles, gl);
    vtHeightTexture_Destroy(&buffer->heights, gl);
    vtTexture_Destroy(&buffer->attributes, gl);
    vtTexture_Destroy(&buffer->images, gl);
    vtTexture_Destroy(&buffer->table, gl);
    *buffer = (vtSceneBuffer){0};
}

bool vtSceneBuffer_SetTable(vtSceneBuffer* buffer, const vtGL* gl, const uint32_t* words)
{
    const size_t size = (size_t)buffer->objectCount * VT_OBJECT_TEXELS * 4 * sizeof *words;
    if (buffer->table.name != 0 && memcmp(words, buffer->words, size) == 0) {
        return false;
    }
    memcpy(buffer->words, words, size);
    vtTexture_Resize(&buffer->table, gl, GL_RGBA32UI, VT_OBJECT_TEXELS, (int)buffer->objectCount, 0);
    gl->ActiveTexture(GL_TEXTURE0);
    gl->BindTexture(GL_TEXTURE_2D, buffer->table.name);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, VT_OBJECT_TEXELS, (GLsizei)buffer->objectCount, GL_RGBA_INTEGER,
                      GL_UNSIGNED_INT, words);
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

// ------------------------------------------------------------------------------------------------ drawing

vtObjectUniforms vtFindObjectUniforms(const vtGL* gl, GLuint program)
{
    return (vtObjectUniforms){
        .toWorld = gl->GetUniformLocation(program, "u_toWorld"),
        .toObject = gl->GetUniformLocation(program, "u_toObject"),
        .object = gl->GetUniformLocation(program, "u_object"),
        .mirrored = gl->GetUniformLocation(program, "u_mirrored"),
        .firstTriangle = gl->GetUniformLocation(program, "u_firstTriangle"),
    };
}

static const vtMeshBuffer* setObject(const vtSceneBuffer* buffer, const vtGL* gl,
                                     const vtObjectUniforms* uniforms, uint32_t index)
{
    const vtObjectBuffer* object = &buffer->objects[index];
    const vtMeshBuffer* mesh = &buffer->meshes[object->mesh];
    gl->Uniform4fv(uniforms->toWorld, 3, &object->placed.toWorld.rows[0][0]);
    gl->Uniform4fv(uniforms->toObject, 3, &object->placed.toObject.rows[0][0]);
    gl->Uniform1i(uniforms->object, (GLint)index);
    gl->Uniform1i(uniforms->mirrored, object->placed.mirrored);
    gl->Uniform1i(uniforms->firstTriangle, (GLint)mesh->firstTriangle);
    return mesh;
}

void vtSceneBuffer_Draw(const vtSceneBuffer* buffer, const vtGL* gl, const vtObjectUniforms* uniforms,
                        uint32_t first, uint32_t last, bool heights)
{
    for (uint32_t i = first; i < last; ++i) {
        if (!heights || !vtSceneBuffer_HasHeights(buffer, i)) {
            vtMeshBuffer_Draw(setObject(buffer, gl, uniforms, i), gl);
        }
    }
}

void vtSceneBuffer_DrawHeights(const vtSceneBuffer* buffer, const vtGL* gl, const vtObjectUniforms* uniforms,
                               uint32_t first, uint32_t last)
{
    for (uint32_t i = first; i < last; ++i) {
        if (vtSceneBuffer_HasHeights(buffer, i)) {
            setObject(buffer, gl, uniforms, i);
            gl->DrawArrays(GL_TRIANGLES, 0, 36);
        }
    }
}

void vtSceneBuffer_DrawTriangles(const vtSceneBuffer* buffer, const vtGL* gl,
                                 const vtObjectUniforms* uniforms, uint32_t first, uint32_t last)
{
    for (uint32_t i = first; i < last; ++i) {
        gl->DrawArrays(GL_TRIANGLES, 0, setObject(buffer, gl, uniforms, i)->indexCount);
    }
}

size_t vtSceneBuffer_TextureBytes(const vtSceneBuffer* buffer)
{
    return vtTexture_Bytes(&buffer->attributes) + vtTexture_Bytes(&buffer->images) +
           vtTexture_Bytes(&buffer->table) + vtHeightTexture_Bytes(&buffer->heights);
}
