// The steps of vtLoadScene, one file each. Internal: callers use vtLoadScene.
#pragma once

#include "vitrine.h"

extern "C" {
#include "base/error.h"
#include "base/memory.h"
}

// The same wherever tinygltf's types are seen; gltf_document.cpp alone holds its code.
#define TINYGLTF_NOEXCEPTION
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
// A program that links Vitrine may have another tinygltf and nlohmann-json, or the same with other switches:
// ours get names of their own.
#define tinygltf vtTinygltf
#define nlohmann vtNlohmann
#include <tiny_gltf.h>

#include <memory>

/// How sentences end about what only whoever made the file can mend.
#define GLTF_DAMAGED "; the file is damaged, export it again"

namespace vtGltf
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

/// Gives back what vtAllocate gave.
struct Free {
    void operator()(void* memory) const
    {
        vtFree(memory);
    }
};
template <typename T> using Block = std::unique_ptr<T[], Free>;

/// A checked primitive with triangles.
struct Part {
    Stream positions, normals, texcoords, colors, indices; // a stream without data: the primitive has none
    int mode = TINYGLTF_MODE_TRIANGLES;                    // or a strip or a fan
    size_t triangleCount = 0;
    int material = -1; // of the file; -1: glTF's default
};

/// A mesh of the file.
struct Source {
    bool opened = false;
    std::vector<Part> parts = {};
    std::vector<uint32_t> meshes = {}, materials = {}; // what became of it in the scene, as many of each
};

/// A picture of the file: at an address, or in a buffer view.
struct Picture {
    std::string name = {}, uri = {};
    int bufferView = -1;
    int image = -1; // in the scene
};

/// A mesh or a camera of the file where a node puts it.
struct Placement {
    int node, what;
    Matrix toWorld;
};

/// What one call of vtLoadScene has so far. A function that returns false has called `fail`.
struct Loader {
    const vtModelDef* def;
    vtScene* scene;
    vtError* error;
    vtResult result = vt_ok;
    tinygltf::Model model = {}; // without its buffers and images, which are these:
    std::vector<Bytes> buffers = {};
    std::vector<std::vector<uint8_t>> ownedBuffers = {}; // of those that `def` does not hold
    std::vector<Picture> pictures = {};
    std::vector<Source> sources = {}; // as many as model.meshes
    std::vector<int> reached = {};    // sources with triangles, in the order in which nodes name them
    std::vector<Placement> objects = {}, cameras = {};

    /// Sets result and error; returns false.
    bool fail(vtResult why, const char* format, ...) VT_PRINTF(3, 4);

    /// Is `index` one of `count`? Else fails.
    bool has(const char* what, int index, size_t count);

    /// An array of zeros for the scene, which frees it.
    template <typename T> bool allocate(size_t count, T** array)
    {
        *array = (T*)vtAllocateZeroed(count, sizeof(T));
        return *array != nullptr ||
               fail(vt_errorMemory, "no memory for %zu objects; simplify the scene", count);
    }
};

/// Text out of a file, fit for a sentence: one line, not long.
std::string quotable(std::string text);

/// "3", or "3, cup" of what has a name.
std::string label(int index, const std::string& name);

uint32_t readU32(const uint8_t* p);
uint32_t readIndex(const Stream& indices, size_t i);

/// Component k of element i of floats, or of unsigned 8 or 16-bit numbers that stand for 0 to 1.
float readNumber(const Stream& stream, size_t i, size_t k);

/// Fills model, buffers and pictures. `bin` is the container's BIN chunk, if any.
bool parseDocument(Loader& loader, Bytes text, Bytes bin);

/// Opens the first `length` bytes of a buffer view of the file, or all; `what` reads them.
const uint64_t wholeView = UINT64_MAX;
bool openView(Loader& loader, const std::string& what, int index, uint64_t length, Bytes* bytes);

/// The bytes of a picture's file: its own, or `contents`, which is filled then.
bool openPicture(Loader& loader, int index, std::vector<uint8_t>* contents, Bytes* bytes);

/// Fills sources, reached, objects and cameras from the scene's nodes.
bool collectNodes(Loader& loader);

/// Checks a primitive and adds it to the parts, unless it has no triangles.
bool addPrimitive(Loader& loader, const tinygltf::Primitive& primitive, std::vector<Part>* parts);

/// Fills the scene's materials and images; materialOf[i + 1] is the scene's for the file's material i.
bool makeMaterials(Loader& loader, std::vector<uint32_t>* materialOf);

/// Fills the scene's meshes: one for the parts of a source that have the same material.
bool makeMeshes(Loader& loader, const std::vector<uint32_t>& materialOf);

/// Fill the scene's objects and cameras.
bool makeObjects(Loader& loader);
bool makeCameras(Loader& loader);

} // namespace vtGltf
