// From parts to meshes, in their own coordinates: strips and fans taken apart, parts of a material joined.

#include "gltf/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vtGltf
{

/// The parts of one mesh to be, and what they have together.
struct Group {
    std::vector<const Part*> parts = {};
    unsigned long long vertexCount = 0, indexCount = 0;
    bool hasNormals = false, hasTexcoords = false, hasColors = false;
};

uint32_t readIndex(const Stream& indices, size_t i)
{
    const uint8_t* p = indices.data + i * indices.stride;
    switch (indices.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return p[0];
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return (uint32_t)p[0] | (uint32_t)p[1] << 8;
    default:
        return readU32(p);
    }
}

float readNumber(const Stream& stream, size_t i, size_t k)
{
    const uint8_t* p = stream.data + i * stream.stride;
    if (stream.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) {
        return (float)p[k] / 255.0f;
    }
    if (stream.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
        return (float)((uint32_t)p[2 * k] | (uint32_t)p[2 * k + 1] << 8) / 65535.0f;
    }
    const uint32_t bits = readU32(p + 4 * k);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/// Copies a stream; what the part lacks stays `missing`.
static void writeNumbers(const Part& part, const Stream& stream, size_t components, float missing, float* to)
{
    for (size_t i = 0; i < part.positions.count; ++i) {
        for (size_t k = 0; k < components; ++k) {
            to[components * i + k] = stream.data != nullptr ? readNumber(stream, i, k) : missing;
        }
    }
}

static void writeTriangles(const Part& part, uint32_t firstVertex, uint32_t* indices)
{
    const auto corner = [&](size_t i) {
        return firstVertex + (part.indices.data != nullptr ? readIndex(part.indices, i) : (uint32_t)i);
    };
    for (size_t t = 0; t < part.triangleCount; ++t) {
        uint32_t* to = indices + 3 * t;
        if (part.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
            to[0] = corner(t), to[1] = corner(t + 1 + t % 2), to[2] = corner(t + 2 - t % 2);
        } else if (part.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            to[0] = corner(t + 1), to[1] = corner(t + 2), to[2] = corner(0);
        } else {
            to[0] = corner(3 * t), to[1] = corner(3 * t + 1), to[2] = corner(3 * t + 2);
        }
    }
}

/// vtCreateMesh checks positions and normals; this the rest, which it takes as it is.
static bool checkShares(Loader& loader, const std::string& name, float* texcoords, float* colors,
                        size_t vertexCount)
{
    for (size_t i = 0; texcoords != nullptr && i < 2 * vertexCount; ++i) {
        if (!std::isfinite(texcoords[i])) {
            return loader.fail(
                vt_errorGeometry,
                "mesh '%s': vertex %zu has a texture coordinate that is not finite; export it again",
                name.c_str(), i / 2);
        }
    }
    for (size_t i = 0; colors != nullptr && i < 3 * vertexCount; ++i) {
        if (!std::isfinite(colors[i])) {
            return loader.fail(vt_errorGeometry,
                               "mesh '%s': vertex %zu has a colour that is not finite; export it again",
                               name.c_str(), i / 3);
        }
        colors[i] = std::clamp(colors[i], 0.0f, 1.0f);
    }
    return true;
}

static bool makeMesh(Loader& loader, const Group& group, const std::string& name, vtMesh* mesh)
{
    if (group.vertexCount > UINT32_MAX || group.indexCount > UINT32_MAX ||
        group.vertexCount > SIZE_MAX / 12 || group.indexCount > SIZE_MAX / 4) {
        return loader.fail(
            vt_errorGeometry,
            "mesh '%s' has %llu vertices and %llu indices, more than 32 bits can count; simplify it",
            name.c_str(), group.vertexCount, group.indexCount);
    }
    const size_t vertexCount = (size_t)group.vertexCount, indexCount = (size_t)group.indexCount;
    const auto floats = [&](bool wanted, size_t components) {
        return Block<float>(wanted ? (float*)vtAllocate(vertexCount, components * sizeof(float)) : nullptr);
    };
    const Block<float> positions = floats(true, 3), normals = floats(group.hasNormals, 3),
                       texcoords = floats(group.hasTexcoords, 2), colors = floats(group.hasColors, 3);
    const Block<uint32_t> indices((uint32_t*)vtAllocate(indexCount, sizeof(uint32_t)));
    if (!positions || !indices || (group.hasNormals && !normals) || (group.hasTexcoords && !texcoords) ||
        (group.hasColors && !colors)) {
        return loader.fail(vt_errorMemory, "no memory for %zu vertices and %zu indices; simplify it",
                           vertexCount, indexCount);
    }
    size_t vertex = 0, index = 0;
    for (const Part* part : group.parts) {
        writeNumbers(*part, part->positions, 3, 0.0f, positions.get() + 3 * vertex);
        if (normals) { // those of zero length are computed by vtCreateMesh
            writeNumbers(*part, part->normals, 3, 0.0f, normals.get() + 3 * vertex);
        }
        if (texcoords) {
            writeNumbers(*part, part->texcoords, 2, 0.0f, texcoords.get() + 2 * vertex);
        }
        if (colors) { // linear already
            writeNumbers(*part, part->colors, 3, 1.0f, colors.get() + 3 * vertex);
        }
        writeTriangles(*part, (uint32_t)vertex, indices.get() + index);
        vertex += part->positions.count;
        index += 3 * part->triangleCount;
    }
    if (!checkShares(loader, name, texcoords.get(), colors.get(), vertexCount)) {
        return false;
    }
    vtMeshDef def = {};
    def.positions = positions.get();
    def.normals = normals.get();
    def.indices = indices.get();
    def.vertexCount = (uint32_t)vertexCount;
    def.indexCount = (uint32_t)indexCount;
    def.texcoords = texcoords.get();
    def.colors = colors.get();
    vtError error = {};
    const vtResult result = vtCreateMesh(&def, name.c_str(), mesh, &error);
    return result == vt_ok || loader.fail(result, "%s", error.message);
}

/// Adds the part to the group of its material, in the order in which the materials come.
static void addPart(const Part& part, uint32_t material, Source& source, std::vector<Group>& groups)
{
    const size_t at = (size_t)(std::find(source.materials.begin(), source.materials.end(), material) -
                               source.materials.begin());
    if (at == groups.size()) {
        source.materials.push_back(material);
        groups.push_back(Group());
    }
    Group& group = groups[at];
    group.parts.push_back(&part);
    group.vertexCount += part.positions.count;
    group.indexCount += 3ull * part.triangleCount;
    group.hasNormals = group.hasNormals || part.normals.data != nullptr;
    group.hasTexcoords = group.hasTexcoords || part.texcoords.data != nullptr;
    group.hasColors = group.hasColors || part.colors.data != nullptr;
}

bool makeMeshes(Loader& loader, const std::vector<uint32_t>& materialOf)
{
    vtScene* scene = loader.scene;
    std::vector<std::vector<Group>> groups(loader.reached.size());
    size_t count = 0;
    for (size_t i = 0; i < groups.size(); ++i) {
        Source& source = loader.sources[(size_t)loader.reached[i]];
        for (const Part& part : source.parts) {
            addPart(part, materialOf[(size_t)(part.material + 1)], source, groups[i]);
        }
        count += groups[i].size();
    }
    if (!loader.allocate(count, &scene->meshes)) {
        return false;
    }
    for (size_t i = 0; i < groups.size(); ++i) {
        const int index = loader.reached[i];
        Source& source = loader.sources[(size_t)index];
        const std::string name = label(index, loader.model.meshes[(size_t)index].name);
        for (const Group& group : groups[i]) {
            if (!makeMesh(loader, group, name, &scene->meshes[scene->meshCount])) {
                return false;
            }
            source.meshes.push_back(scene->meshCount++);
        }
    }
    return true;
}

} // namespace vtGltf
