#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"

/// The one setting of the process; without functions: the C library's. Only vtSetAllocator writes it.
static vtAllocator allocator;

vtResult vtSetAllocator(const vtAllocator* given, vtError* error)
{
    if (given != NULL && (given->allocate == NULL || given->reallocate == NULL || given->free == NULL)) {
        return vtFail(error, vt_errorArgument,
                      "allocator: one of its three functions is NULL; give all, or NULL for malloc");
    }
    allocator = given != NULL ? *given : (vtAllocator){0};
    return vtSucceed(error);
}

/// 0 where size_t cannot express it. Nothing is one byte, so that NULL always means that memory is out.
static size_t bytesOf(size_t count, size_t size)
{
    if (count == 0 || size == 0) {
        return 1;
    }
    return count <= SIZE_MAX / size ? count * size : 0;
}

void* vtAllocate(size_t count, size_t size)
{
    const size_t bytes = bytesOf(count, size);
    if (bytes == 0) {
        return NULL;
    }
    return allocator.allocate != NULL ? allocator.allocate(bytes, allocator.userData) : malloc(bytes);
}

void* vtAllocateZeroed(size_t count, size_t size)
{
    if (allocator.allocate == NULL) { // the C library knows which pages are zero already
        const size_t bytes = bytesOf(count, size);
        return bytes != 0 ? calloc(1, bytes) : NULL;
    }
    void* memory = vtAllocate(count, size);
    return memory != NULL ? memset(memory, 0, bytesOf(count, size)) : NULL;
}

void* vtReallocate(void* memory, size_t count, size_t size)
{
    const size_t bytes = bytesOf(count, size);
    if (memory == NULL || bytes == 0) {
        return bytes == 0 ? NULL : vtAllocate(count, size);
    }
    return allocator.allocate != NULL ? allocator.reallocate(memory, bytes, allocator.userData)
                                      : realloc(memory, bytes);
}

void vtFree(void* memory)
{
    if (memory != NULL && allocator.allocate != NULL) {
        allocator.free(memory, allocator.userData);
    } else {
        free(memory);
    }
}
