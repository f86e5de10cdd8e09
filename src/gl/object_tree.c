// This work is based on:
//   Brian Smits. Efficiency Issues for Ray Tracing. Journal of Graphics Tools 3(2), 1998: nodes in
//   depth-first order with skip pointers, so that no stack is needed.
// Departure: halved at the middle object along the longest axis; scenes have at most VT_MAX_OBJECTS.
#include "gl/object_tree.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "base/memory.h"

typedef struct Item {
    float low[3], high[3];
    uint32_t object;
} Item;

static int compareAlong(const Item* a, const Item* b, int axis)
{
    const float x = a->low[axis] + a->high[axis], y = b->low[axis] + b->high[axis];
    return x < y ? -1 : x > y ? 1 : a->object < b->object ? -1 : 1;
}

static int compareX(const void* a, const void* b)
{
    return compareAlong(a, b, 0);
}

static int compareY(const void* a, const void* b)
{
    return compareAlong(a, b, 1);
}

static int compareZ(const void* a, const void* b)
{
    return compareAlong(a, b, 2);
}

/// Writes the subtree from `node` on; gives the node behind it.
static uint32_t writeTree(Item* items, uint32_t count, uint32_t node, uint32_t* words)
{
    float low[3] = {FLT_MAX, FLT_MAX, FLT_MAX}, high[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (uint32_t i = 0; i < count; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = fminf(low[axis], items[i].low[axis]);
            high[axis] = fmaxf(high[axis], items[i].high[axis]);
        }
    }
    uint32_t end = node + 1;
    if (count > 1) {
        int (*const compare[3])(const void*, const void*) = {compareX, compareY, compareZ};
        const float extent[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
        const int axis = extent[0] >= extent[1] && extent[0] >= extent[2] ? 0
                         : extent[1] >= extent[2]                         ? 1
                                                                          : 2;
        qsort(items, count, sizeof *items, compare[axis]);
        end = writeTree(items, count / 2, end, words);
        end = writeTree(items + count / 2, count - count / 2, end, words);
    }
    uint32_t* to = words + 8 * (size_t)node;
    memcpy(to, low, sizeof low);
    memcpy(to + 4, high, sizeof high);
    to[3] = end;
    to[7] = count == 1 ? items[0].object + 1 : 0;
    return end;
}

vtResult vtObjectTree_Upload(vtTexture* texture, const vtGL* gl, const vtObjectBuffer* objects,
                             uint32_t count, vtError* error)
{
    const uint32_t nodes = 2 * count - 1, rows = (nodes + VT_OBJECT_NODES_A_ROW - 1) / VT_OBJECT_NODES_A_ROW;
    GLint largest = 0;
    gl->GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (count > (uint32_t)largest) { // the table of objects has a row for each
        return vtFail(error, vt_errorContext,
                      "scene: %u objects are more than this GPU's textures have rows (%d)", count, largest);
    }
    Item* items = vtAllocate(count, sizeof *items);
    uint32_t* words = vtAllocateZeroed((size_t)rows * VT_OBJECT_NODES_A_ROW, 8 * sizeof *words);
    if (items == NULL || words == NULL) {
        vtFree(items);
        vtFree(words);
        return vtFail(error, vt_errorMemory, "scene: out of memory for a tree of %u objects", count);
    }
    for (uint32_t i = 0; i < count; ++i) {
        // A little more than the box: a ray that starts on its side is within it.
        const float margin = 1e-5f * vtLength(vtSub(objects[i].placed.high, objects[i].placed.low));
        const vtVec3 a = objects[i].placed.low, b = objects[i].placed.high;
        items[i] =
            (Item){{a.x - margin, a.y - margin, a.z - margin}, {b.x + margin, b.y + margin, b.z + margin}, i};
    }
    writeTree(items, count, 0, words);
    vtTexture_Resize(texture, gl, GL_RGBA32UI, 2 * VT_OBJECT_NODES_A_ROW, (int)rows, 0);
    vtTexture_Bind(texture, gl, vt_samplerNone);
    gl->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 2 * VT_OBJECT_NODES_A_ROW, (GLsizei)rows, GL_RGBA_INTEGER,
                      GL_UNSIGNED_INT, words);
    vtFree(items);
    vtFree(words);
    return vtSucceed(error);
}
