// Buffer views, accessors and primitives: every index and offset of theirs is checked here.

#include "gltf/gltf.h"

#include <algorithm>

namespace vtGltf
{

// The file's numbers are at most 2^31 (gltf_document.cpp), strides 252: no sum overflows 64 bits.

bool openView(Loader& loader, const std::string& what, int index, uint64_t length, Bytes* bytes)
{
    const tinygltf::Model& model = loader.model;
    if (index < 0 || (size_t)index >= model.bufferViews.size()) {
        return loader.fail(vt_errorFormat, "%s has no data (buffer view %d of %zu); export it uncompressed",
                           what.c_str(), index, model.bufferViews.size());
    }
    const tinygltf::BufferView& view = model.bufferViews[(size_t)index];
    if (!loader.has("buffer", view.buffer, loader.buffers.size())) {
        return false;
    }
    const Bytes buffer = loader.buffers[(size_t)view.buffer];
    if (buffer.data == nullptr) {
        return loader.fail(vt_errorFormat, "%s reads buffer %d, which has no data; export it uncompressed",
                           what.c_str(), view.buffer);
    }
    const uint64_t left = buffer.size > view.byteOffset ? buffer.size - view.byteOffset : 0;
    const uint64_t room = std::min<uint64_t>(left, view.byteLength);
    length = length == wholeView ? view.byteLength : length;
    if (length > room || view.byteOffset > buffer.size) {
        return loader.fail(vt_errorFormat, "%s reads %llu bytes beyond the end of its buffer" GLTF_DAMAGED,
                           what.c_str(), (unsigned long long)(length - room));
    }
    *bytes = {buffer.data + view.byteOffset, (size_t)length};
    return true;
}

static bool openAccessor(Loader& loader, int index, Stream* stream)
{
    const tinygltf::Model& model = loader.model;
    if (!loader.has("accessor", index, model.accessors.size())) {
        return false;
    }
    const tinygltf::Accessor& accessor = model.accessors[(size_t)index];
    if (accessor.sparse.isSparse) {
        return loader.fail(
            vt_errorFormat,
            "accessor %d is sparse, which is not supported; export it without sparse accessors", index);
    }
    const int components = tinygltf::GetNumComponentsInType((uint32_t)accessor.type);
    const int componentSize = tinygltf::GetComponentSizeInBytes((uint32_t)accessor.componentType);
    if (components <= 0 || componentSize <= 0) {
        return loader.fail(vt_errorFormat, "accessor %d has the unknown componentType %d" GLTF_DAMAGED, index,
                           accessor.componentType);
    }
    const size_t elementSize = (size_t)(components * componentSize);
    const bool hasView =
        accessor.bufferView >= 0 && (size_t)accessor.bufferView < model.bufferViews.size(); // else it fails
    const size_t given = hasView ? model.bufferViews[(size_t)accessor.bufferView].byteStride : 0;
    const size_t stride = given > 0 ? given : elementSize;
    if (stride < elementSize) {
        return loader.fail(vt_errorFormat,
                           "accessor %d has elements of %zu bytes every %zu bytes" GLTF_DAMAGED, index,
                           elementSize, stride);
    }
    const uint64_t length = accessor.count > 0 ? (uint64_t)(accessor.count - 1) * stride + elementSize : 0;
    Bytes bytes;
    if (!openView(loader, "accessor " + std::to_string(index), accessor.bufferView,
                  accessor.byteOffset + length, &bytes)) {
        return false;
    }
    *stream = {bytes.data + accessor.byteOffset, accessor.count, stride, accessor.componentType};
    return true;
}

/// Opens an accessor of positions or normals.
static bool openVectors(Loader& loader, int index, const char* attribute, Stream* stream)
{
    if (!openAccessor(loader, index, stream)) {
        return false;
    }
    if (loader.model.accessors[(size_t)index].type != TINYGLTF_TYPE_VEC3 ||
        stream->componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
        return loader.fail(
            vt_errorFormat,
            "accessor %d holds %s as something else than three floats; export it without quantization", index,
            attribute);
    }
    return true;
}

/// Opens an accessor of texture coordinates (2 components) or colours (3, or 4 of which the last is dropped).
static bool openShares(Loader& loader, int index, const char* attribute, int components, Stream* stream)
{
    if (!openAccessor(loader, index, stream)) {
        return false;
    }
    const tinygltf::Accessor& accessor = loader.model.accessors[(size_t)index];
    const int given = tinygltf::GetNumComponentsInType((uint32_t)accessor.type);
    const bool isVector = accessor.type == TINYGLTF_TYPE_VEC2 || accessor.type == TINYGLTF_TYPE_VEC3 ||
                          accessor.type == TINYGLTF_TYPE_VEC4;
    const bool isShare =
        accessor.normalized && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    if (!isVector || (given != components && (components == 2 || given != 4)) ||
        (!isShare && accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)) {
        return loader.fail(vt_errorFormat,
                           "accessor %d holds %s as something else than %s floats or normalized unsigned 8 "
                           "or 16-bit numbers; export it without quantization",
                           index, attribute, components == 2 ? "two" : "three or four");
    }
    return true;
}

/// Opens an accessor of indices and checks that each names one of `vertexCount` vertices.
static bool openIndices(Loader& loader, int index, size_t vertexCount, Stream* stream)
{
    if (!openAccessor(loader, index, stream)) {
        return false;
    }
    const int component = stream->componentType;
    if (loader.model.accessors[(size_t)index].type != TINYGLTF_TYPE_SCALAR ||
        (component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
         component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
         component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
        return loader.fail(
            vt_errorFormat,
            "accessor %d holds indices that are not 8, 16 or 32-bit unsigned numbers" GLTF_DAMAGED, index);
    }
    for (size_t i = 0; i < stream->count; ++i) {
        if (readIndex(*stream, i) >= vertexCount) {
            return loader.fail(
                vt_errorGeometry,
                "index %u in accessor %d is out of range, there are %zu vertices; export it again",
                readIndex(*stream, i), index, vertexCount);
        }
    }
    return true;
}

/// The set of texture coordinates that the material's pictures are placed by; a mesh keeps one.
static std::string texcoordName(const Loader& loader, int material)
{
    int set = 0;
    if (material >= 0) {
        const tinygltf::PbrMetallicRoughness& look =
            loader.model.materials[(size_t)material].pbrMetallicRoughness;
        set = look.baseColorTexture.index >= 0           ? look.baseColorTexture.texCoord
              : look.metallicRoughnessTexture.index >= 0 ? look.metallicRoughnessTexture.texCoord
                                                         : 0;
    }
    return "TEXCOORD_" + std::to_string(set);
}

/// Opens what a primitive gives for each vertex.
static bool openAttributes(Loader& loader, const tinygltf::Primitive& primitive, Part* part)
{
    const std::string texcoordKey = texcoordName(loader, part->material);
    const auto find = [&](const std::string& key) {
        const auto at = primitive.attributes.find(key);
        return at != primitive.attributes.end() ? at->second : -1;
    };
    const int position = find("POSITION"), normal = find("NORMAL"), texcoord = find(texcoordKey),
              color = find("COLOR_0");
    if (!openVectors(loader, position, "POSITION", &part->positions) ||
        (normal >= 0 && !openVectors(loader, normal, "NORMAL", &part->normals)) ||
        (texcoord >= 0 && !openShares(loader, texcoord, texcoordKey.c_str(), 2, &part->texcoords)) ||
        (color >= 0 && !openShares(loader, color, "COLOR_0", 3, &part->colors))) {
        return false;
    }
    const struct {
        int index;
        const char* what;
        const Stream& stream;
    } others[] = {{normal, "normals", part->normals},
                  {texcoord, "texture coordinates", part->texcoords},
                  {color, "colours", part->colors}};
    for (const auto& other : others) {
        if (other.index >= 0 && other.stream.count != part->positions.count) {
            return loader.fail(vt_errorFormat, "accessor %d has %zu %s for %zu positions" GLTF_DAMAGED,
                               other.index, other.stream.count, other.what, part->positions.count);
        }
    }
    return true;
}

bool addPrimitive(Loader& loader, const tinygltf::Primitive& primitive, std::vector<Part>* parts)
{
    const bool triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    if (primitive.attributes.count("POSITION") == 0 ||
        (!triangles && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
         primitive.mode != TINYGLTF_MODE_TRIANGLE_FAN)) {
        return true; // points and lines bound nothing
    }
    Part part;
    part.mode = primitive.mode;
    part.material = std::max(primitive.material, -1);
    if ((part.material >= 0 && !loader.has("material", part.material, loader.model.materials.size())) ||
        !openAttributes(loader, primitive, &part)) {
        return false;
    }
    size_t corners = part.positions.count;
    if (primitive.indices >= 0) {
        if (!openIndices(loader, primitive.indices, part.positions.count, &part.indices)) {
            return false;
        }
        corners = part.indices.count;
    }
    if (triangles && corners % 3 != 0) {
        return loader.fail(vt_errorGeometry,
                           "a primitive has %zu corners, not a multiple of 3; export it again", corners);
    }
    part.triangleCount = triangles ? corners / 3 : corners > 2 ? corners - 2 : 0;
    if (part.triangleCount > 0) {
        parts->push_back(part);
    }
    return true;
}

} // namespace vtGltf
