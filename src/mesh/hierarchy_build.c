#include "mesh/hierarchy_build.h"

#include "base/memory.h"

static void* note(vtHierarchyBuild* build, void* memory)
{
    if (memory == NULL && build->failure == vt_ok) {
        build->failure = vt_errorMemory;
    }
    return memory;
}

void* vtHierarchyBuild_Allocate(vtHierarchyBuild* build, size_t count, size_t size)
{
    count = count > 0 ? count : 1;
    return note(build, vtAllocate(count, size));
}

void* vtHierarchyBuild_AllocateZeros(vtHierarchyBuild* build, size_t count, size_t size)
{
    return note(build, vtAllocateZeroed(count, size));
}
