// The steps of vtLoadModel, one file each. Internal: callers use vtLoadModel.
#pragma once

#include "vitrine.h"

extern "C" {
#include "base/error.h"
}

// The same wherever tinygltf's types are seen; gltf_document.cpp alone holds its code.
#define TINYGLTF_NOEXCEPTION
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

/// How sentences end about what only whoever made the file can mend.
#define GLTF_DAMAGED "; the file is damaged, export it again"

namespace gltf
{

struct Bytes {
    const uint8_t* data = nullptr;
    size_t size = 0;
};

/// An accessor whose every element is known to lie inside its buffer.
struct Stream {
    const uint8_t* data = nullptr;
    size_t count = 0, stride = 0;
    int componentType = 0;
};

/// Column-major 4 x 4, as glTF has it.
struct Matrix {
    double m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

/// A checked primitive where a node puts it.
struct Part {
    Stream positions, normals, indices; // a stream without data: the primitive has none
    int mode = TINYGLTF_MODE_TRIANGLES; // or a strip or a fan
    size_t triangleCount = 0;
    Matrix toWorld;
};

/// What one call of vtLoadModel has so far. A function that returns false has called `fail`.
struct Loader {
    const vtModelDef* def;
    vtError* error;
    vtResult result = vt_ok;
    tinygltf::Model model = {}; // without its buffers, which are these:
    std::vector<Bytes> buffers = {};
    std::vector<std::vector<uint8_t>> ownedBuffers = {}; // of those that `def` does not hold
    std::vector<Part> parts = {};
    double ior = 0.0;

    /// Sets result and error; returns false.
    bool fail(vtResult why, const char* format, ...) VT_PRINTF(3, 4);

    /// Is `index` one of `count`? Else fails.
    bool has(const char* what, int index, size_t count);
};

/// Text out of a file, fit for a sentence: one line, not long.
std::string quotable(std::string text);

uint32_t readU32(const uint8_t* p);
uint32_t readIndex(const Stream& indices, size_t i);

/// Fills model and buffers. `bin` is the container's BIN chunk, if any.
bool parseDocument(Loader& loader, Bytes text, Bytes bin);

/// Fills parts and ior from the scene's nodes.
bool collectParts(Loader& loader);

/// Makes one mesh of the parts, in world space.
bool buildMesh(Loader& loader, vtMesh* mesh);

} // namespace gltf
