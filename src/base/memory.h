// All memory of the library comes from here (C++ containers of src/gltf apart), so from vtSetAllocator's.
#pragma once

#include "vitrine.h"

/// As vtAllocate, all zeros.
void* vtAllocateZeroed(size_t count, size_t size);

/// Makes what vtAllocate gave larger or smaller; of NULL: vtAllocate. NULL where memory is out: then what was
/// there stays.
void* vtReallocate(void* memory, size_t count, size_t size);
