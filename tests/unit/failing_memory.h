// An allocator for vtSetAllocator that counts, and has no memory where a test says.
#pragma once

#include "testing.h"

static struct {
    long calls, live; ///< allocations since failFrom; blocks that are held now
    long failing;     ///< number of the allocation that fails, from 0; -1: none
    bool lasting;     ///< and all after it
} memory = {.failing = -1};

static inline void failFrom(long failing, bool lasting)
{
    memory.calls = 0;
    memory.failing = failing;
    memory.lasting = lasting;
}

static inline void failNone(void)
{
    memory.failing = -1;
}

static inline bool isOut(void)
{
    const long call = memory.calls++;
    return memory.failing >= 0 && (memory.lasting ? call >= memory.failing : call == memory.failing);
}

static inline void* takeBlock(size_t size)
{
    void* block = isOut() ? NULL : malloc(size > 0 ? size : 1);
    memory.live += block != NULL;
    return block;
}

static inline void giveBlock(void* block)
{
    memory.live -= block != NULL;
    free(block);
}

static inline void* allocate(size_t size, void* userData)
{
    assert_ptr_equal(userData, &memory);
    assert_true(size > 0);
    return takeBlock(size);
}

static inline void* reallocate(void* block, size_t size, void* userData)
{
    assert_ptr_equal(userData, &memory);
    assert_true(block != NULL && size > 0);
    return isOut() ? NULL : realloc(block, size);
}

static inline void release(void* block, void* userData)
{
    assert_ptr_equal(userData, &memory);
    assert_non_null(block);
    giveBlock(block);
}

static const vtAllocator counting = {allocate, reallocate, release, &memory};
