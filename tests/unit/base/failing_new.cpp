// The memory of C++ containers of a test program, which can be told to be out. Internal to test_memory.c.
#include <cstddef>
#include <new>

extern "C" {
void* testAllocate(size_t size);
void testFree(void* memory);
}

void* operator new(size_t size)
{
    void* memory = testAllocate(size);
    if (memory == nullptr) {
        throw std::bad_alloc();
    }
    return memory;
}

void operator delete(void* memory) noexcept
{
    testFree(memory);
}

void operator delete(void* memory, size_t) noexcept
{
    testFree(memory);
}
