#include "scene/triangles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "scene/weld.h"

/// A directed edge and the triangle it belongs to; unused where from == to.
typedef struct EdgeSlot {
    uint32_t from, to, triangle;
} EdgeSlot;

typedef struct EdgeTable {
    EdgeSlot* slots;
    size_t mask;
} EdgeTable;

/// The slot of an edge, or the unused one where it belongs.
static EdgeSlot* findEdge(const EdgeTable* table, uint32_t from, uint32_t to)
{
    size_t slot = (size_t)vtMixBits(from | (uint64_t)to << 32) & table->mask;
    for (;; slot = (slot + 1) & table->mask) {
        EdgeSlot* edge = &table->slots[slot];
        if (edge->from == edge->to || (edge->from == from && edge->to == to)) {
            return edge;
        }
    }
}

static uint32_t packSnorm16(float value)
{
    return (uint32_t)(int32_t)roundf(vtClamp(value, -1.0f, 1.0f) * 32767.0f) & 0xffffu;
}

/// The twin of packNormal in shaders_es3/octahedral.glsl.
static uint32_t packNormal(const float* normal)
{
    float size = fabsf(normal[0]) + fabsf(normal[1]) + fabsf(normal[2]);
    float x = normal[0] / size, y = normal[1] / size;
    if (normal[2] < 0.0f) {
        float folded = (1.0f - fabsf(y)) * (x >= 0.0f ? 1.0f : -1.0f);
        y = (1.0f - fabsf(x)) * (y >= 0.0f ? 1.0f : -1.0f);
        x = folded;
    }
    return packSnorm16(x) | packSnorm16(y) << 16;
}

static void writeRecord(const vtMesh* mesh, const uint32_t* welded, const EdgeTable* edges, uint32_t triangle,
                        uint32_t* record)
{
    const uint32_t* corners = mesh->indices + 3 * (size_t)triangle;
    for (int i = 0; i < 3; ++i) {
        memcpy(record + 4 * i, mesh->positions + 3 * (size_t)corners[i], 3 * sizeof(float));
        uint32_t from = welded[corners[(i + 1) % 3]], to = welded[corners[(i + 2) % 3]];
        const EdgeSlot* twin = findEdge(edges, to, from);
        bool found = from != to && twin->from != twin->to;
        record[4 * i + 3] = found ? twin->triangle : VT_NO_TRIANGLE;
        record[12 + i] = packNormal(mesh->normals + 3 * (size_t)corners[i]);
    }
    record[15] = 0;
}

uint32_t* vtCreateTriangleRecords(const vtMesh* mesh)
{
    const uint32_t count = mesh->indexCount / 3;
    size_t capacity = vtTableCapacity(mesh->indexCount);
    EdgeTable edges = {capacity == 0 ? NULL : calloc(capacity, sizeof *edges.slots), capacity - 1};
    uint32_t* welded = calloc(mesh->vertexCount, sizeof *welded);
    uint32_t* records = calloc(count, VT_TRIANGLE_WORDS * sizeof *records);
    bool ready = edges.slots != NULL && welded != NULL && records != NULL && vtWeldPositions(mesh, welded);
    for (uint32_t i = 0; ready && i < mesh->indexCount; ++i) {
        uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        uint32_t from = welded[mesh->indices[i]], to = welded[mesh->indices[next]];
        EdgeSlot* edge = findEdge(&edges, from, to);
        if (edge->from == edge->to && from != to) {
            *edge = (EdgeSlot){from, to, i / 3};
        }
    }
    for (uint32_t triangle = 0; ready && triangle < count; ++triangle) {
        writeRecord(mesh, welded, &edges, triangle, records + VT_TRIANGLE_WORDS * (size_t)triangle);
    }
    free(edges.slots);
    free(welded);
    if (!ready) {
        free(records);
        return NULL;
    }
    return records;
}
