#include "gl/geometry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"
#include "base/octahedral.h"
#include "mesh/height_field.h"
#include "mesh/hierarchy.h"

// ------------------------------------------------------------------------------------------------- room

/// Records that a texture of this GPU holds.
static uint64_t mostRecords(const vtGL* gl)
{
    GLint largest = 0;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    return (uint64_t)largest * VT_RECORDS_A_ROW;
}

static vtResult failTooMany(const vtGL* gl, const vtMesh* mesh, uint64_t triangles, vtError* error)
{
    return vtFail(error, vt_errorContext,
                  "scene: %llu triangles are more than this GPU can hold (about %llu); %s",
                  (unsigned long long)triangles, (unsigned long long)mostRecords(gl) * 4 / 3,
                  mesh->heights != NULL ? "draw its reliefs with technique heightfield, which needs none"
                                        : "simplify its meshes");
}

static uint64_t trianglesOf(const vtGeometryStore* store)
{
    uint64_t triangles = 0;
    for (uint32_t i = 0; i < store->count; ++i) {
        triangles += store->items[i].isThere ? store->shapes[i].indexCount / 3 : 0;
    }
    return triangles;
}

/// Copies what `from` holds into the first rows of `to`, of the same width.
static vtResult copyRows(const vtGL* gl, const vtTexture* from, const vtTexture* to, vtError* error)
{
    GLuint framebuffer = 0;
    const vtResult result =
        vtMakeFramebuffer(gl, "records", &(vtAttachment){from, 0}, 1, NULL, &framebuffer, error);
    if (result == vt_ok) {
        vtTexture_Bind(to, gl, 0);
        gl->CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, from->width, from->height);
    }
    vtDestroyFramebuffers(gl, &framebuffer, 1);
    return result;
}

/// A texture of at least so many records that holds what the one before held. It grows by half of itself at
/// least. On failure it is as before.
static vtResult growTexture(vtTexture* texture, const vtGL* gl, uint64_t records, vtError* error)
{
    const uint64_t rows = (records + VT_RECORDS_A_ROW - 1) / VT_RECORDS_A_ROW;
    if (texture->name != 0 && rows <= (uint64_t)texture->height) {
        return vt_ok;
    }
    vtTexture before = *texture;
    *texture = (vtTexture){0};
    uint64_t wanted = before.name != 0 ? (uint64_t)before.height * 3 / 2 : rows;
    wanted = wanted > rows ? wanted : rows;
    wanted = wanted * VT_RECORDS_A_ROW > mostRecords(gl) ? rows : wanted;
    vtTexture_SizeRecords(texture, gl, (uint32_t)(wanted * VT_RECORDS_A_ROW));
    vtResult result = before.name != 0 ? copyRows(gl, &before, texture, error) : vt_ok;
    result = result == vt_ok ? vtCheckGL(gl, "making room for triangles", error) : result;
    vtTexture_Destroy(result == vt_ok ? &before : texture, gl);
    *texture = result == vt_ok ? *texture : before;
    return result;
}

static vtRecordRange rangeOf(const vtGeometryBuffer* item, bool attributes)
{
    return attributes ? item->attributes : item->records;
}

static int compareRanges(const void* left, const void* right)
{
    const vtRecordRange *a = left, *b = right;
    return (a->first > b->first) - (a->first < b->first);
}

/// Where `count` records find room: the first gap that is large enough, or behind the last range. UINT64_MAX
/// where memory is out.
static uint64_t findRoom(const vtGeometryStore* store, bool attributes, uint32_t count)
{
    uint64_t end = 0, used = 0;
    uint32_t ranges = 0;
    for (uint32_t i = 0; i < store->count; ++i) {
        const vtRecordRange range = rangeOf(&store->items[i], attributes);
        const uint64_t behind = (uint64_t)range.first + range.count;
        end = range.count > 0 && behind > end ? behind : end;
        used += range.count;
        ranges += range.count > 0;
    }
    if (end - used < count) { // no gap can be large enough
        return end;
    }
    vtRecordRange* sorted = vtAllocate(ranges, sizeof *sorted);
    if (sorted == NULL) {
        return UINT64_MAX;
    }
    uint32_t filled = 0;
    for (uint32_t i = 0; i < store->count; ++i) {
        const vtRecordRange range = rangeOf(&store->items[i], attributes);
        if (range.count > 0) {
            sorted[filled++] = range;
        }
    }
    qsort(sorted, ranges, sizeof *sorted, compareRanges);
    uint64_t at = 0;
    for (uint32_t i = 0; i < ranges && sorted[i].first - at < count; ++i) {
        at = (uint64_t)sorted[i].first + sorted[i].count;
    }
    vtFree(sorted);
    return at;
}

/// Finds room for `count` records, in a texture that grows where it has to.
static vtResult takeRange(vtGeometryStore* store, const vtGL* gl, const vtMesh* mesh, bool attributes,
                          uint32_t count, vtRecordRange* range, vtError* error)
{
    *range = (vtRecordRange){0};
    if (count == 0) {
        return vt_ok;
    }
    const uint64_t at = findRoom(store, attributes, count);
    if (at == UINT64_MAX) {
        return vtFail(error, vt_errorMemory, "scene: out of memory");
    }
    if (at + count > mostRecords(gl)) {
        return failTooMany(gl, mesh, trianglesOf(store) + mesh->indexCount / 3, error);
    }
    const vtResult result =
        growTexture(attributes ? &store->attributes : &store->records, gl, at + count, error);
    *range = (vtRecordRange){(uint32_t)at, result == vt_ok ? count : 0};
    return result;
}

// ----------------------------------------------------------------------------------------------- upload

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
        float at[2];
        if (mesh->heights != NULL) {
            vtHeightField_Texcoord(mesh->heights, vtMakeVec3(mesh->positions + 3 * vertex), at);
            memcpy(words, at, sizeof at);
        } else if (mesh->texcoords != NULL) {
            memcpy(words, mesh->texcoords + 2 * vertex, 2 * sizeof(float));
        }
        const float white[3] = {1.0f, 1.0f, 1.0f};
        const float* color = mesh->colors != NULL ? mesh->colors + 3 * vertex : white;
        const float alpha = mesh->alphas != NULL ? mesh->alphas[vertex] : 1.0f;
        words[2] = packHalf(color[0]) | packHalf(color[1]) << 16;
        words[3] = packHalf(color[2]) | packHalf(alpha) << 16;
    }
}

/// Those of more attributes.
static void writeMore(const vtMesh* mesh, const vtHierarchy* hierarchy, uint32_t* words)
{
    for (uint32_t i = 0; i < 4 * hierarchy->recordCount; ++i, words += 4) {
        const size_t vertex = hierarchy->corners[i];
        if (hierarchy->corners[i / 4 * 4] == VT_NO_TRIANGLE) { // no leaf
            continue;
        }
        if (mesh->texcoords1 != NULL) {
            memcpy(words, mesh->texcoords1 + 2 * vertex, 2 * sizeof(float));
        }
        if (mesh->tangents != NULL) {
            words[2] = vtPackNormal(mesh->tangents + 4 * vertex);
            words[3] = mesh->tangents[4 * vertex + 3] < 0.0f;
        }
    }
}

static bool hasMore(const vtMesh* mesh)
{
    return mesh->texcoords1 != NULL || mesh->tangents != NULL;
}

static vtResult uploadAttributes(vtGeometryStore* store, const vtGL* gl, const vtMesh* mesh,
                                 const vtHierarchy* hierarchy, vtRecordRange range, vtError* error)
{
    if (range.count == 0) {
        return vt_ok;
    }
    uint32_t* words = vtAllocateZeroed(range.count, VT_RECORD_WORDS * sizeof *words);
    if (words == NULL) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for the attributes of %u triangles",
                      mesh->indexCount / 3);
    }
    writeAttributes(mesh, hierarchy, words);
    if (range.count > hierarchy->recordCount) {
        writeMore(mesh, hierarchy, words + (size_t)hierarchy->recordCount * VT_RECORD_WORDS);
    }
    vtTexture_SetRecords(&store->attributes, gl, range.first, range.count, words);
    vtFree(words);
    return vt_ok;
}

static void copyPlan(vtGeometryBuffer* item, const vtHierarchy* hierarchy)
{
    item->space = hierarchy->space;
    item->gridLow = hierarchy->gridLow;
    item->gridScale = hierarchy->gridScale;
    item->builds = hierarchy->builds;
}

/// What there is to know of a mesh without its data.
static vtMesh shapeOf(const vtMesh* mesh)
{
    return (vtMesh){.vertexCount = mesh->vertexCount,
                    .indexCount = mesh->indexCount,
                    .boundsMin = mesh->boundsMin,
                    .boundsMax = mesh->boundsMax,
                    .volume = mesh->volume,
                    .openEdgeCount = mesh->openEdgeCount,
                    .updates = mesh->updates};
}

static bool usesAttributes(const vtMesh* mesh, vtGeometryUse use)
{
    return use.attributes &&
           (mesh->texcoords != NULL || mesh->colors != NULL || mesh->heights != NULL || hasMore(mesh));
}

/// `item` has nothing yet; on failure it holds what is to be freed.
static vtResult uploadTriangles(vtGeometryStore* store, const vtGL* gl, const vtMesh* mesh,
                                const vtHierarchy* hierarchy, vtGeometryUse use, vtGeometryBuffer* item,
                                vtError* error)
{
    const bool attributes = usesAttributes(mesh, use);
    copyPlan(item, hierarchy);
    item->colored = mesh->colors != NULL;
    item->overlaps = use.glass && vtHierarchy_Overlaps(hierarchy);
    vtResult result = takeRange(store, gl, mesh, false, hierarchy->recordCount, &item->records, error);
    if (result == vt_ok && attributes) {
        const uint64_t count = (uint64_t)hierarchy->recordCount * (hasMore(mesh) ? 2 : 1);
        result = count <= UINT32_MAX
                     ? takeRange(store, gl, mesh, true, (uint32_t)count, &item->attributes, error)
                     : failTooMany(gl, mesh, mesh->indexCount / 3, error);
    }
    if (result == vt_ok) {
        result = uploadAttributes(store, gl, mesh, hierarchy, item->attributes, error);
    }
    if (result == vt_ok) {
        result = vtMeshBuffer_Create(&item->vertices, gl, mesh, &item->space, error);
    }
    if (result == vt_ok) {
        vtTexture_SetRecords(&store->records, gl, item->records.first, item->records.count,
                             hierarchy->records);
    }
    return result;
}

/// The mesh's own hierarchy, or one that is built into *built.
static vtResult findHierarchy(const vtGL* gl, const vtMesh* mesh, vtHierarchy* built,
                              const vtHierarchy** found, vtError* error)
{
    *built = (vtHierarchy){0};
    *found = mesh->hierarchy;
    if (mesh->hierarchy != NULL) {
        return vt_ok;
    }
    *found = built;
    if (mesh->indexCount / 6 > mostRecords(gl)) { // a record holds two triangles at best
        return failTooMany(gl, mesh, mesh->indexCount / 3, error);
    }
    const vtResult result = vtCreateHierarchy(mesh, built, error);
    if (result == vt_errorGeometry && mesh->heights != NULL) {
        vtFail(error, result,
               "scene: %u triangles are more than a hierarchy can hold; draw its reliefs with technique "
               "heightfield, which needs none",
               mesh->indexCount / 3);
    }
    return result;
}

static void freeItem(vtGeometryBuffer* item, const vtGL* gl)
{
    vtMeshBuffer_Destroy(&item->vertices, gl);
    vtHeightTexture_Destroy(&item->heights, gl);
    *item = (vtGeometryBuffer){0};
}

static vtResult upload(vtGeometryStore* store, const vtGL* gl, const vtMesh* mesh, vtGeometryUse use,
                       vtGeometryBuffer* item, vtError* error)
{
    *item = (vtGeometryBuffer){.isThere = true, .space = vtOuterSpace()};
    vtResult result =
        growTexture(&store->records, gl, 0, error); // shaders may read a texel whatever there is
    result = result == vt_ok ? growTexture(&store->attributes, gl, 0, error) : result;
    if (result == vt_ok && use.any && mesh->indexCount > 0) {
        vtHierarchy built;
        const vtHierarchy* hierarchy;
        result = findHierarchy(gl, mesh, &built, &hierarchy, error);
        if (result == vt_ok) {
            result = uploadTriangles(store, gl, mesh, hierarchy, use, item, error);
        }
        vtDestroyHierarchy(&built);
    }
    if (result == vt_ok && use.any && use.heights && mesh->heights != NULL) {
        result = vtHeightTexture_Create(&item->heights, gl, mesh->heights, error);
    }
    if (result != vt_ok) {
        freeItem(item, gl);
    }
    return result;
}

/// A free place; false where memory is out.
static bool findPlace(vtGeometryStore* store, uint32_t* index)
{
    for (*index = 0; *index < store->count && store->items[*index].isThere; ++*index) {
    }
    if (*index < store->capacity) {
        return true;
    }
    const uint32_t capacity = store->capacity > 0 ? 2 * store->capacity : 8;
    vtGeometryBuffer* items = vtReallocate(store->items, capacity, sizeof *items);
    store->items = items != NULL ? items : store->items;
    vtMesh* shapes = vtReallocate(store->shapes, capacity, sizeof *shapes);
    store->shapes = shapes != NULL ? shapes : store->shapes;
    store->capacity = items != NULL && shapes != NULL ? capacity : store->capacity;
    return store->capacity == capacity;
}

vtResult vtGeometryStore_Add(vtGeometryStore* store, const vtGL* gl, const vtMesh* mesh, vtGeometryUse use,
                             uint32_t* index, vtError* error)
{
    if (!findPlace(store, index)) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for a mesh more");
    }
    vtGeometryBuffer item;
    const vtResult result = upload(store, gl, mesh, use, &item, error);
    if (result != vt_ok) {
        return result;
    }
    store->items[*index] = item;
    store->shapes[*index] = shapeOf(mesh);
    store->count = *index < store->count ? store->count : *index + 1;
    return vt_ok;
}

/// The hierarchies of meshes that lack one, `built`; and textures for all of them.
static vtResult prepareAll(vtGeometryStore* store, const vtGL* gl, const vtMesh* meshes, uint32_t count,
                           const vtGeometryUse* uses, vtHierarchy* built, vtError* error)
{
    uint64_t records = 0, attributes = 0, triangles = 0;
    vtResult result = vt_ok;
    for (uint32_t i = 0; i < count && result == vt_ok; ++i) {
        const vtHierarchy* found;
        if (!uses[i].any || meshes[i].indexCount == 0) {
            continue;
        }
        triangles += meshes[i].indexCount / 3;
        result = findHierarchy(gl, &meshes[i], &built[i], &found, error);
        if (result == vt_ok) {
            records += found->recordCount;
            attributes += usesAttributes(&meshes[i], uses[i])
                              ? (hasMore(&meshes[i]) ? 2ull : 1ull) * found->recordCount
                              : 0;
            result = records <= mostRecords(gl) ? vt_ok : failTooMany(gl, &meshes[i], triangles, error);
        }
    }
    result = result == vt_ok ? growTexture(&store->records, gl, records, error) : result;
    return result == vt_ok ? growTexture(&store->attributes, gl, attributes, error) : result;
}

vtResult vtGeometryStore_AddAll(vtGeometryStore* store, const vtGL* gl, const vtMesh* meshes, uint32_t count,
                                const vtGeometryUse* uses, vtError* error)
{
    vtHierarchy* built = vtAllocateZeroed(count, sizeof *built);
    if (built == NULL) {
        return vtFail(error, vt_errorMemory, "scene: out of memory for %u meshes", count);
    }
    vtResult result = prepareAll(store, gl, meshes, count, uses, built, error);
    for (uint32_t i = 0; i < count && result == vt_ok; ++i) {
        vtMesh mesh = meshes[i];
        uint32_t index;
        mesh.hierarchy = mesh.hierarchy == NULL && built[i].records != NULL ? &built[i] : mesh.hierarchy;
        result = vtGeometryStore_Add(store, gl, &mesh, uses[i], &index, error);
        vtDestroyHierarchy(&built[i]);
    }
    for (uint32_t i = 0; i < count; ++i) {
        vtDestroyHierarchy(&built[i]);
    }
    vtFree(built);
    return result;
}

vtResult vtGeometryStore_Update(vtGeometryStore* store, const vtGL* gl, uint32_t index, const vtMesh* mesh,
                                vtError* error)
{
    vtGeometryBuffer* item = &store->items[index];
    const vtHierarchy* hierarchy = mesh->hierarchy;
    const bool hadHeights = item->heights.cell > 0.0f;
    const bool fits = hierarchy != NULL && hierarchy->recordCount == item->records.count &&
                      store->shapes[index].indexCount == mesh->indexCount &&
                      hadHeights == (mesh->heights != NULL) && mesh->tangents == NULL &&
                      (item->attributes.count == 0 || item->builds == hierarchy->builds) &&
                      vtMeshBuffer_Update(&item->vertices, gl, mesh, &hierarchy->space);
    if (fits) {
        copyPlan(item, hierarchy);
        item->overlaps = vtHierarchy_Overlaps(hierarchy);
        vtTexture_SetRecords(&store->records, gl, item->records.first, item->records.count,
                             hierarchy->records);
        store->shapes[index] = shapeOf(mesh);
        return vt_ok;
    }
    const vtGeometryUse use = {true, true, item->attributes.count > 0, hadHeights};
    vtGeometryBuffer fresh;
    const vtResult result = upload(store, gl, mesh, use, &fresh, error);
    if (result == vt_ok) {
        freeItem(item, gl);
        *item = fresh;
        store->shapes[index] = shapeOf(mesh);
    }
    return result;
}

void vtGeometryStore_Remove(vtGeometryStore* store, const vtGL* gl, uint32_t index)
{
    if (index < store->count) {
        freeItem(&store->items[index], gl);
        store->shapes[index] = (vtMesh){0};
    }
}

void vtGeometryStore_Destroy(vtGeometryStore* store, const vtGL* gl)
{
    for (uint32_t i = 0; i < store->count; ++i) {
        freeItem(&store->items[i], gl);
    }
    vtFree(store->items);
    vtFree(store->shapes);
    vtTexture_Destroy(&store->records, gl);
    vtTexture_Destroy(&store->attributes, gl);
    *store = (vtGeometryStore){0};
}

size_t vtGeometryStore_MeshBytes(const vtGeometryStore* store)
{
    size_t bytes = vtTexture_Bytes(&store->records);
    for (uint32_t i = 0; i < store->count; ++i) {
        bytes += store->items[i].vertices.bytes;
    }
    return bytes;
}

size_t vtGeometryStore_HeightBytes(const vtGeometryStore* store)
{
    size_t bytes = 0;
    for (uint32_t i = 0; i < store->count; ++i) {
        bytes += vtHeightTexture_Bytes(&store->items[i].heights);
    }
    return bytes;
}
