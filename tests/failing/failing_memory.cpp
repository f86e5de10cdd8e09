// Put before a program by LD_PRELOAD: the n-th allocation of the program itself and of the libraries that
// read and write its pictures fails. What GL, Embree and the C library take for themselves is not counted.
//   VITRINE_FAILING          number of the allocation that fails, from 0; none where it is not set
//   VITRINE_FAILING_LASTING  and all after it
//   VITRINE_FAILING_COUNT    file for how many there were; it is not written where the program ends by a
//   signal
#include <fcntl.h>
#include <link.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* block, size_t size);
}

namespace
{

struct Range {
    uintptr_t first, end;
};

Range ranges[16];
std::atomic<int> rangeCount; // 0 before `begin`
std::atomic<long> calls;
long failing = -1;
bool lasting;

int addRanges(dl_phdr_info* library, size_t, void*)
{
    static const char* const counted[] = {"/libpng", "/libjpeg", "/libwebp", "/libOpenEXR", "/libz."};
    bool found = library->dlpi_name[0] == '\0'; // the program
    for (const char* name : counted) {
        found = found || strstr(library->dlpi_name, name) != nullptr;
    }
    for (int i = 0; found && i < library->dlpi_phnum && rangeCount < 16; ++i) {
        const auto& part = library->dlpi_phdr[i];
        if (part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0) {
            const uintptr_t first = library->dlpi_addr + part.p_vaddr;
            ranges[rangeCount] = {first, first + part.p_memsz};
            ++rangeCount;
        }
    }
    return 0;
}

__attribute__((constructor)) void begin()
{
    const char* number = getenv("VITRINE_FAILING");
    failing = number != nullptr ? atol(number) : -1;
    lasting = getenv("VITRINE_FAILING_LASTING") != nullptr;
    dl_iterate_phdr(addRanges, nullptr);
}

__attribute__((destructor)) void end()
{
    const char* path = getenv("VITRINE_FAILING_COUNT");
    const int file = path != nullptr ? open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;
    if (file >= 0) {
        dprintf(file, "%ld\n", calls.load());
        close(file);
    }
}

/// Is it the caller's turn to have none?
bool isOut(const void* caller)
{
    const auto place = reinterpret_cast<uintptr_t>(caller);
    for (int i = 0; i < rangeCount; ++i) {
        if (place >= ranges[i].first && place < ranges[i].end) {
            const long call = calls++;
            return failing >= 0 && (lasting ? call >= failing : call == failing);
        }
    }
    return false;
}

void* refuse()
{
    errno = ENOMEM;
    return nullptr;
}

void* take(size_t size, const void* caller)
{
    void* block = isOut(caller) ? nullptr : __libc_malloc(size);
    if (block == nullptr) {
        throw std::bad_alloc();
    }
    return block;
}

} // namespace

#define CALLER __builtin_return_address(0)

extern "C" {

void* malloc(size_t size)
{
    return isOut(CALLER) ? refuse() : __libc_malloc(size);
}

void* calloc(size_t count, size_t size)
{
    return isOut(CALLER) ? refuse() : __libc_calloc(count, size);
}

void* realloc(void* block, size_t size)
{
    return isOut(CALLER) ? refuse() : __libc_realloc(block, size);
}
}

void* operator new(size_t size)
{
    return take(size, CALLER);
}

void* operator new[](size_t size)
{
    return take(size, CALLER);
}

void operator delete(void* block) noexcept
{
    free(block);
}

void operator delete(void* block, size_t) noexcept
{
    free(block);
}

void operator delete[](void* block) noexcept
{
    free(block);
}

void operator delete[](void* block, size_t) noexcept
{
    free(block);
}
