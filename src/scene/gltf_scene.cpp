// From a scene's nodes to parts: every index and offset of the file is checked here.

#include "scene/gltf.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace gltf
{

static const int maxNodeDepth = 1000; // far beyond any skeleton

// --------------------------------------------------------------------------------------------- accessors

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
    if (accessor.bufferView < 0 || (size_t)accessor.bufferView >= model.bufferViews.size()) {
        return loader.fail(vt_errorFormat,
                           "accessor %d has no data (buffer view %d of %zu); export it uncompressed", index,
                           accessor.bufferView, model.bufferViews.size());
    }
    const tinygltf::BufferView& view = model.bufferViews[(size_t)accessor.bufferView];
    if (!loader.has("buffer", view.buffer, loader.buffers.size())) {
        return false;
    }
    const Bytes buffer = loader.buffers[(size_t)view.buffer];
    if (buffer.data == nullptr) {
        return loader.fail(vt_errorFormat,
                           "accessor %d reads buffer %d, which has no data; export it uncompressed", index,
                           view.buffer);
    }
    const int components = tinygltf::GetNumComponentsInType((uint32_t)accessor.type);
    const int componentSize = tinygltf::GetComponentSizeInBytes((uint32_t)accessor.componentType);
    if (components <= 0 || componentSize <= 0) {
        return loader.fail(vt_errorFormat, "accessor %d has the unknown componentType %d" GLTF_DAMAGED, index,
                           accessor.componentType);
    }
    const size_t elementSize = (size_t)(components * componentSize);
    const size_t stride = view.byteStride > 0 ? view.byteStride : elementSize;
    if (stride < elementSize) {
        return loader.fail(vt_errorFormat,
                           "accessor %d has elements of %zu bytes every %zu bytes" GLTF_DAMAGED, index,
                           elementSize, stride);
    }
    // The file's numbers are at most 2^31 (gltf_document.cpp), strides 252: no sum overflows 64 bits.
    const uint64_t length = accessor.count > 0 ? (uint64_t)(accessor.count - 1) * stride + elementSize : 0;
    const uint64_t end = accessor.byteOffset + length;
    const uint64_t left = buffer.size > view.byteOffset ? buffer.size - view.byteOffset : 0;
    const uint64_t room = std::min<uint64_t>(left, view.byteLength);
    if (end > room || view.byteOffset > buffer.size) {
        return loader.fail(vt_errorFormat,
                           "accessor %d reads %llu bytes beyond the end of its buffer" GLTF_DAMAGED, index,
                           (unsigned long long)(end - room));
    }
    *stream = {buffer.data + view.byteOffset + accessor.byteOffset, accessor.count, stride,
               accessor.componentType};
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

// -------------------------------------------------------------------------------------------- primitives

/// The index of refraction of the first material that gives one.
static bool readIor(Loader& loader, int index)
{
    if (index < 0 || loader.ior > 0.0) {
        return true;
    }
    if (!loader.has("material", index, loader.model.materials.size())) {
        return false;
    }
    const tinygltf::ExtensionMap& extensions = loader.model.materials[(size_t)index].extensions;
    const auto extension = extensions.find("KHR_materials_ior");
    if (extension == extensions.end()) {
        return true;
    }
    double value = 1.5; // the extension's default
    if (extension->second.Has("ior")) {
        const tinygltf::Value& ior = extension->second.Get("ior");
        value = ior.IsNumber() ? ior.GetNumberAsDouble() : NAN;
    }
    if (!(value >= 1.0 && value <= FLT_MAX)) {
        return loader.fail(vt_errorFormat,
                           "material %d has an index of refraction of %g, but it must be a number of 1 or "
                           "more; correct KHR_materials_ior",
                           index, value);
    }
    loader.ior = value;
    return true;
}

static bool addPrimitive(Loader& loader, const tinygltf::Primitive& primitive, const Matrix& toWorld)
{
    const auto end = primitive.attributes.end();
    const auto position = primitive.attributes.find("POSITION"), normal = primitive.attributes.find("NORMAL");
    const bool triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    if (position == end || (!triangles && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
                            primitive.mode != TINYGLTF_MODE_TRIANGLE_FAN)) {
        return true; // points and lines bound no glass
    }
    Part part;
    if (!openVectors(loader, position->second, "POSITION", &part.positions) ||
        (normal != end && !openVectors(loader, normal->second, "NORMAL", &part.normals))) {
        return false;
    }
    if (normal != end && part.normals.count != part.positions.count) {
        return loader.fail(vt_errorFormat, "accessor %d has %zu normals for %zu positions" GLTF_DAMAGED,
                           normal->second, part.normals.count, part.positions.count);
    }
    size_t corners = part.positions.count;
    if (primitive.indices >= 0) {
        if (!openIndices(loader, primitive.indices, part.positions.count, &part.indices)) {
            return false;
        }
        corners = part.indices.count;
    }
    if (!readIor(loader, primitive.material)) {
        return false;
    }
    if (triangles && corners % 3 != 0) {
        return loader.fail(vt_errorGeometry,
                           "a primitive has %zu corners, not a multiple of 3; export it again", corners);
    }
    part.mode = primitive.mode;
    part.toWorld = toWorld;
    part.triangleCount = triangles ? corners / 3 : corners > 2 ? corners - 2 : 0;
    if (part.triangleCount > 0) {
        loader.parts.push_back(part);
    }
    return true;
}

// ------------------------------------------------------------------------------------------------- nodes

static Matrix multiply(const Matrix& a, const Matrix& b)
{
    Matrix product;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            double sum = 0.0;
            for (int k = 0; k < 4; ++k) {
                sum += a.m[4 * k + row] * b.m[4 * column + k];
            }
            product.m[4 * column + row] = sum;
        }
    }
    return product;
}

/// Copies what the file gives and leaves what it does not; false where the number of numbers is wrong.
static bool copyNumbers(const std::vector<double>& from, double* to, size_t count)
{
    std::copy_n(from.begin(), std::min(from.size(), count), to);
    return from.empty() || from.size() == count;
}

/// A node's own transform: its matrix, or translation * rotation * scale.
static bool readTransform(Loader& loader, int index, Matrix* matrix)
{
    const tinygltf::Node& node = loader.model.nodes[(size_t)index];
    double t[3] = {0, 0, 0}, r[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    if (!copyNumbers(node.matrix, matrix->m, 16) || !copyNumbers(node.translation, t, 3) ||
        !copyNumbers(node.rotation, r, 4) || !copyNumbers(node.scale, s, 3)) {
        return loader.fail(vt_errorFormat,
                           "node %d has a transform with too many or too few numbers" GLTF_DAMAGED, index);
    }
    if (!node.matrix.empty()) {
        return true;
    }
    const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    if (!(length > 0.0)) {
        return loader.fail(vt_errorFormat, "node %d has a rotation of zero length" GLTF_DAMAGED, index);
    }
    const double x = r[0] / length, y = r[1] / length, z = r[2] / length, w = r[3] / length;
    const double rotation[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
        {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
        {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
    };
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            matrix->m[4 * column + row] = s[column] * rotation[column][row];
        }
        matrix->m[12 + row] = t[row];
    }
    return true;
}

/// The nodes a scene starts from: those of the default scene, else of the first, else all without a parent.
static bool findRoots(Loader& loader, std::vector<int>* roots)
{
    const tinygltf::Model& model = loader.model;
    if (model.defaultScene >= 0 || !model.scenes.empty()) {
        const int scene = std::max(model.defaultScene, 0);
        if (!loader.has("scene", scene, model.scenes.size())) {
            return false;
        }
        *roots = model.scenes[(size_t)scene].nodes;
        return true;
    }
    std::vector<bool> isChild(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes) {
        for (int child : node.children) {
            if (child >= 0 && (size_t)child < isChild.size()) {
                isChild[(size_t)child] = true;
            }
        }
    }
    for (size_t i = 0; i < isChild.size(); ++i) {
        if (!isChild[i]) {
            roots->push_back((int)i);
        }
    }
    return true;
}

/// Adds the primitives of a node. A skin is not applied: the bind pose is drawn.
static bool addMesh(Loader& loader, int index, const Matrix& toWorld)
{
    if (index < 0) {
        return true;
    }
    if (!loader.has("mesh", index, loader.model.meshes.size())) {
        return false;
    }
    for (const tinygltf::Primitive& primitive : loader.model.meshes[(size_t)index].primitives) {
        if (!addPrimitive(loader, primitive, toWorld)) {
            return false;
        }
    }
    return true;
}

bool collectParts(Loader& loader)
{
    struct Visit {
        int node, depth;
        Matrix parent;
    };
    std::vector<Visit> open; // a stack of our own, in reverse so that nodes come in the file's order
    const auto visitLater = [&open](const std::vector<int>& nodes, int depth, const Matrix& parent) {
        for (size_t i = nodes.size(); i-- > 0;) {
            open.push_back({nodes[i], depth, parent});
        }
    };
    const std::vector<tinygltf::Node>& nodes = loader.model.nodes;
    std::vector<int> roots;
    if (!findRoots(loader, &roots)) {
        return false;
    }
    visitLater(roots, 1, Matrix());
    std::vector<bool> seen(nodes.size(), false);
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        if (!loader.has("node", visit.node, nodes.size())) {
            return false;
        }
        const size_t index = (size_t)visit.node;
        if (seen[index]) {
            return loader.fail(
                vt_errorFormat,
                "node %d is reached twice, but nodes must form a tree without cycles" GLTF_DAMAGED,
                visit.node);
        }
        seen[index] = true;
        if (visit.depth > maxNodeDepth) {
            return loader.fail(vt_errorFormat,
                               "its nodes are nested deeper than %d levels; flatten them and export it again",
                               maxNodeDepth);
        }
        Matrix local;
        if (!readTransform(loader, visit.node, &local)) {
            return false;
        }
        const Matrix toWorld = multiply(visit.parent, local);
        if (!addMesh(loader, nodes[index].mesh, toWorld)) {
            return false;
        }
        visitLater(nodes[index].children, visit.depth + 1, toWorld);
    }
    return true;
}

} // namespace gltf
