#include "cli/hash.h"

#include <string.h>

uint64_t vtHash(uint64_t hash, const void* bytes, size_t size)
{
    const uint8_t* at = bytes;
    for (size_t i = 0; i < size; ++i) {
        hash = (hash ^ at[i]) * 0x100000001B3u;
    }
    return hash;
}

uint64_t vtHashText(uint64_t hash, const char* text)
{
    return vtHash(hash, text, strlen(text) + 1);
}
