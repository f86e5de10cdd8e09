#include "mesh/weld.h"

#include <string.h>

#include "base/memory.h"

uint64_t vtMixBits(uint64_t key)
{
    key = (key ^ (key >> 33)) * 0xff51afd7ed558ccdu;
    key = (key ^ (key >> 33)) * 0xc4ceb9fe1a85ec53u;
    return key ^ (key >> 33);
}

size_t vtTableCapacity(uint32_t count)
{
    size_t capacity = 16;
    while (capacity != 0 && capacity - capacity / 5 < count) {
        capacity *= 2;
    }
    return capacity;
}

static uint64_t hashPosition(const float* position)
{
    uint32_t bits[3];
    for (int axis = 0; axis < 3; ++axis) {
        float value = position[axis] + 0.0f; // -0 becomes +0, its equal
        memcpy(&bits[axis], &value, sizeof value);
    }
    return vtMixBits(vtMixBits(bits[0] | (uint64_t)bits[1] << 32) + bits[2]);
}

bool vtWeldPositions(const vtMesh* mesh, uint32_t* welded)
{
    size_t capacity = vtTableCapacity(mesh->vertexCount);
    uint32_t* slots =
        capacity == 0 ? NULL : vtAllocateZeroed(capacity, sizeof *slots); // vertex + 1; 0: unused
    if (slots == NULL) {
        return false;
    }
    for (uint32_t vertex = 0; vertex < mesh->vertexCount; ++vertex) {
        const float* p = mesh->positions + 3 * (size_t)vertex;
        size_t slot = (size_t)hashPosition(p) & (capacity - 1);
        while (slots[slot] != 0) {
            const float* q = mesh->positions + 3 * (size_t)(slots[slot] - 1);
            if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) {
                break;
            }
            slot = (slot + 1) & (capacity - 1);
        }
        if (slots[slot] == 0) {
            slots[slot] = vertex + 1;
        }
        welded[vertex] = slots[slot] - 1;
    }
    vtFree(slots);
    return true;
}
