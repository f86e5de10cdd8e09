// glTF files put together in memory: accessors with their data, then the rest of the JSON.
#pragma once

#include "testing.h"

typedef struct Builder {
    char views[4096], accessors[4096];
    uint8_t bin[65536];
    size_t binSize;
    int viewCount, accessorCount;
} Builder;

typedef struct Built {
    uint8_t* bytes;
    size_t size;
} Built;

enum { glByte = 5120, glUnsignedByte, glShort, glUnsignedShort, glUnsignedInt = 5125, glFloat };

/// A view of these bytes; `more`: further members, with a comma before them.
static inline int addView(Builder* b, const void* data, size_t size, const char* more)
{
    const size_t used = strlen(b->views);
    assert_true(b->binSize + size + 4 <= sizeof b->bin && used + strlen(more) + 100 < sizeof b->views);
    memcpy(b->bin + b->binSize, data, size);
    snprintf(b->views + used, sizeof b->views - used,
             "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu%s}", used > 0 ? "," : "", b->binSize,
             size, more);
    b->binSize += (size + 3) / 4 * 4;
    return b->viewCount++;
}

/// An accessor of a view, -1: of none.
static inline int addAccessorOf(Builder* b, int view, int type, int count, const char* shape,
                                const char* more)
{
    const size_t used = strlen(b->accessors);
    char where[32] = "";
    if (view >= 0) {
        snprintf(where, sizeof where, "\"bufferView\":%d,", view);
    }
    assert_true(used + strlen(more) + 150 < sizeof b->accessors);
    snprintf(b->accessors + used, sizeof b->accessors - used,
             "%s{%s\"componentType\":%d,\"count\":%d,\"type\":\"%s\"%s}", used > 0 ? "," : "", where, type,
             count, shape, more);
    return b->accessorCount++;
}

static inline int addAccessor(Builder* b, const void* data, size_t size, int type, int count,
                              const char* shape, const char* more)
{
    return addAccessorOf(b, addView(b, data, size, ""), type, count, shape, more);
}

#define ADD(builder, data, type, count, shape, more)                                                         \
    addAccessor(builder, data, sizeof(data), type, count, shape, more)

/// `rest`: meshes, nodes, ...; the caller frees the bytes.
static inline Built build(const Builder* b, const char* rest)
{
    const size_t capacity = strlen(b->views) + strlen(b->accessors) + strlen(rest) + 300;
    char* json = malloc(capacity);
    snprintf(json, capacity,
             "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%zu}],\"bufferViews\":[%s],"
             "\"accessors\":[%s]%s%s}",
             b->binSize, b->views, b->accessors, *rest != '\0' ? "," : "", rest);
    const uint32_t jsonSize = (uint32_t)(strlen(json) + 3) / 4 * 4, binSize = (uint32_t)b->binSize;
    const uint32_t header[5] = {0x46546c67, 2, 28 + jsonSize + binSize, jsonSize, 0x4e4f534a};
    const uint32_t chunk[2] = {binSize, 0x004e4942};
    Built file = {malloc(28 + jsonSize + binSize), 28 + jsonSize + binSize};
    memset(file.bytes, ' ', file.size);
    memcpy(file.bytes, header, sizeof header);
    memcpy(file.bytes + 20, json, strlen(json));
    memcpy(file.bytes + 20 + jsonSize, chunk, sizeof chunk);
    memcpy(file.bytes + 28 + jsonSize, b->bin, binSize);
    free(json);
    return file;
}

static inline vtScene loadBuilt(const Builder* b, const char* rest)
{
    const Built file = build(b, rest);
    const vtModelDef def = {.bytes = file.bytes, .size = file.size, .name = "x.glb"};
    vtScene scene;
    vtError error = {0};
    assert_ok(vtLoadScene(&def, &scene, &error), error);
    free(file.bytes);
    return scene;
}

/// Fails, and says this.
static inline void refuseBuilt(const Builder* b, const char* rest, const char* reason)
{
    const Built file = build(b, rest);
    const vtModelDef def = {.bytes = file.bytes, .size = file.size, .name = "x.glb"};
    vtScene scene;
    vtError error = {0};
    if (vtLoadScene(&def, &scene, &error) == vt_ok || strstr(error.message, reason) == NULL) {
        fail_msg("'%s' does not say '%s'", error.message, reason);
    }
    free(file.bytes);
}

/// A cube from -1 to 1: positions, accessor 0, and indices, accessor 1.
static const float cubeCorners[8][3] = {{-1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {-1, 1, 1},
                                        {1, -1, -1},  {1, -1, 1},  {1, 1, -1},  {1, 1, 1}};
static const uint8_t cubeTriangles[36] = {0, 6, 4, 0, 2, 6, 1, 7, 3, 1, 5, 7, 0, 5, 1, 0, 4, 5,
                                          2, 7, 6, 2, 3, 7, 0, 3, 2, 0, 1, 3, 4, 7, 5, 4, 6, 7};

static inline Builder beginCube(void)
{
    Builder b = {0};
    ADD(&b, cubeCorners, glFloat, 8, "VEC3", "");
    ADD(&b, cubeTriangles, glUnsignedByte, 36, "SCALAR", "");
    return b;
}

#define GLASS                                                                                                \
    "\"materials\":[{\"pbrMetallicRoughness\":{\"roughnessFactor\":0},\"extensions\":{"                      \
    "\"KHR_materials_transmission\":{\"transmissionFactor\":1},\"KHR_materials_volume\":{"                   \
    "\"thicknessFactor\":1}}},{}]"
#define CUBE_MESH "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0}]}"
