// Buffer views and accessors: every offset of theirs is checked here.

#include "gltf/gltf.h"

#include <algorithm>
#include <cstring>

namespace vtGltf
{

// The file's numbers are at most 2^31 (gltf_document.cpp), strides 252: no sum overflows 64 bits.

/// An accessor without any data is all zeros; a small file shall not ask for more of them than this.
static const size_t mostZeros = 1 << 24;

/// `length` bytes of a buffer from `offset` on, of which the view may have `most`.
static bool openBuffer(Loader& loader, const std::string& what, int index, uint64_t offset, uint64_t most,
                       uint64_t length, Bytes* bytes)
{
    if (!loader.has("buffer", index, loader.buffers.size())) {
        return false;
    }
    const Bytes buffer = loader.buffers[(size_t)index];
    if (buffer.data == nullptr) {
        return loader.fail(vt_errorFormat, "%s reads buffer %d, which has no data; export it uncompressed",
                           what.c_str(), index);
    }
    const uint64_t left = buffer.size > offset ? buffer.size - offset : 0;
    const uint64_t room = std::min<uint64_t>(left, most);
    length = length == wholeView ? most : length;
    if (length > room || offset > buffer.size) {
        return loader.fail(vt_errorFormat, "%s reads %llu bytes beyond the end of its buffer" GLTF_DAMAGED,
                           what.c_str(), (unsigned long long)(length - room));
    }
    *bytes = {buffer.data + offset, (size_t)length};
    return true;
}

#if VT_WITH_FILES
/// Unpacks a buffer view, once.
static bool openPacked(Loader& loader, const std::string& what, Compressed& view, uint64_t length,
                       Bytes* bytes)
{
    if (view.decoded.data == nullptr) {
        Bytes packed;
        std::vector<uint8_t> decoded;
        if (!openBuffer(loader, what, view.buffer, view.byteOffset, view.byteLength, wholeView, &packed) ||
            !decodeView(loader, what, view, packed, &decoded)) {
            return false;
        }
        view.decoded = {decoded.data(), decoded.size()};
        loader.ownedBuffers.push_back(std::move(decoded)); // which leaves the bytes where they are
    }
    length = length == wholeView ? view.decoded.size : length;
    if (length > view.decoded.size) {
        return loader.fail(vt_errorFormat, "%s reads %llu bytes beyond the end of its buffer" GLTF_DAMAGED,
                           what.c_str(), (unsigned long long)(length - view.decoded.size));
    }
    *bytes = {view.decoded.data, (size_t)length};
    return true;
}
#endif

bool openView(Loader& loader, const std::string& what, int index, uint64_t length, Bytes* bytes)
{
    const tinygltf::Model& model = loader.model;
    if (!loader.has("buffer view", index, model.bufferViews.size())) {
        return false;
    }
    const tinygltf::BufferView& view = model.bufferViews[(size_t)index];
    Compressed* packed =
        (size_t)index < loader.compressed.size() ? &loader.compressed[(size_t)index] : nullptr;
    if (packed != nullptr && !packed->extension.empty()) {
        const char* lacking = vtFindGltfExtension(packed->extension.c_str())->needs;
#if VT_WITH_FILES
        if (lacking == nullptr) {
            return openPacked(loader, what, *packed, length, bytes);
        }
#endif
        // Its own buffer may hold the same unpacked.
        if (view.buffer < 0 || (size_t)view.buffer >= loader.buffers.size() ||
            loader.buffers[(size_t)view.buffer].data == nullptr) {
            return loader.fail(
                vt_errorFormat,
                "%s is packed by %s, which this build cannot unpack without %s; export it uncompressed",
                what.c_str(), packed->extension.c_str(), lacking);
        }
    }
    return openBuffer(loader, what, view.buffer, view.byteOffset, view.byteLength, length, bytes);
}

/// Elements of `size` bytes each `stride`, as the accessor or its sparse part has them.
static bool openElements(Loader& loader, const std::string& what, int view, uint64_t offset, size_t count,
                         size_t stride, size_t size, const uint8_t** data)
{
    const uint64_t length = count > 0 ? (uint64_t)(count - 1) * stride + size : 0;
    Bytes bytes;
    if (!openView(loader, what, view, offset + length, &bytes)) {
        return false;
    }
    *data = bytes.data + offset;
    return true;
}

/// Copies the elements, or zeros, side by side, and puts the sparse ones in their places.
static bool applySparse(Loader& loader, const std::string& what, const tinygltf::Accessor& accessor,
                        size_t size, Stream* stream)
{
    const auto& sparse = accessor.sparse;
    Stream indices;
    indices.componentType = sparse.indices.componentType;
    indices.count = (size_t)std::max(sparse.count, 0);
    const int width = tinygltf::GetComponentSizeInBytes((uint32_t)indices.componentType);
    if (indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
        indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        indices.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
        return loader.fail(vt_errorFormat,
                           "%s has sparse indices that are not 8, 16 or 32-bit unsigned numbers" GLTF_DAMAGED,
                           what.c_str());
    }
    indices.stride = (size_t)width;
    const uint8_t* values;
    if (!openElements(loader, what, sparse.indices.bufferView, (uint64_t)sparse.indices.byteOffset,
                      indices.count, indices.stride, indices.stride, &indices.data) ||
        !openElements(loader, what, sparse.values.bufferView, (uint64_t)sparse.values.byteOffset,
                      indices.count, size, size, &values) ||
        !loader.spend((uint64_t)stream->count * size, what)) {
        return false;
    }
    std::vector<uint8_t> whole(stream->count * size);
    for (size_t i = 0; stream->data != nullptr && i < stream->count; ++i) {
        memcpy(&whole[i * size], stream->data + i * stream->stride, size);
    }
    for (size_t i = 0; i < indices.count; ++i) {
        const uint32_t at = readIndex(indices, i);
        if (at >= stream->count) {
            return loader.fail(vt_errorFormat, "%s replaces element %u of %zu" GLTF_DAMAGED, what.c_str(), at,
                               stream->count);
        }
        memcpy(&whole[at * size], values + i * size, size);
    }
    stream->data = whole.data();
    stream->stride = size;
    loader.ownedBuffers.push_back(std::move(whole)); // which leaves the bytes where they are
    return true;
}

/// Zeros, one element that stands for all.
static bool openZeros(Loader& loader, const std::string& what, size_t size, Stream* stream)
{
    if (stream->count > mostZeros) {
        return loader.fail(vt_errorMemory,
                           "%s has %zu elements without data, more than the %zu that there can be",
                           what.c_str(), stream->count, mostZeros);
    }
    std::vector<uint8_t> zeros(size, 0);
    stream->data = zeros.data();
    stream->stride = 0;
    loader.ownedBuffers.push_back(std::move(zeros));
    return true;
}

bool openAccessor(Loader& loader, int index, Stream* stream)
{
    const tinygltf::Model& model = loader.model;
    if (!loader.has("accessor", index, model.accessors.size())) {
        return false;
    }
    const tinygltf::Accessor& accessor = model.accessors[(size_t)index];
    const std::string what = "accessor " + std::to_string(index);
    const int components = tinygltf::GetNumComponentsInType((uint32_t)accessor.type);
    const int componentSize = tinygltf::GetComponentSizeInBytes((uint32_t)accessor.componentType);
    if (components <= 0 || componentSize <= 0) {
        return loader.fail(vt_errorFormat, "%s has the unknown componentType %d" GLTF_DAMAGED, what.c_str(),
                           accessor.componentType);
    }
    const size_t elementSize = (size_t)components * (size_t)componentSize;
    *stream = {nullptr, accessor.count, 0, accessor.componentType, components, accessor.normalized};
    if (accessor.bufferView >= 0) {
        if (!loader.has("buffer view", accessor.bufferView, model.bufferViews.size())) {
            return false;
        }
        const size_t given = model.bufferViews[(size_t)accessor.bufferView].byteStride;
        stream->stride = given > 0 ? given : elementSize;
        if (stream->stride < elementSize) {
            return loader.fail(vt_errorFormat, "%s has elements of %zu bytes every %zu bytes" GLTF_DAMAGED,
                               what.c_str(), elementSize, stream->stride);
        }
        if (!openElements(loader, what, accessor.bufferView, accessor.byteOffset, accessor.count,
                          stream->stride, elementSize, &stream->data)) {
            return false;
        }
    } else if (!openZeros(loader, what, elementSize, stream)) {
        return false;
    }
    return !accessor.sparse.isSparse || applySparse(loader, what, accessor, elementSize, stream);
}

} // namespace vtGltf
