// A number for bytes: it finds changes that happen, not those that somebody hides.
#pragma once

#include <stddef.h>
#include <stdint.h>

/// FNV-1a of 64 bits (Fowler, Noll & Vo); this one is the hash of nothing.
#define VT_NO_HASH 0xCBF29CE484222325u

/// The hash of what was hashed so far and these bytes.
uint64_t vtHash(uint64_t hash, const void* bytes, size_t size);
/// And of a word, with its end.
uint64_t vtHashText(uint64_t hash, const char* text);
