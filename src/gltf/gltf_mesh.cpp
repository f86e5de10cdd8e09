// From parts to meshes, in their own coordinates: strips and fans taken apart, parts of a material joined.

#include "gltf/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vtGltf
{

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

/// Turns all triangles round.
static void turnTriangles(uint32_t* indices, size_t indexCount)
{
    for (size_t i = 0; i + 2 < indexCount; i += 3) {
        std::swap(indices[i + 1], indices[i + 2]);
    }
}

/// Do the normals, on the whole, point against the triangles?
static bool areNormalsAgainst(const vtMeshDef& def)
{
    double sum = 0.0;
    for (size_t i = 0; i < def.indexCount; i += 3) {
        const float* p[3];
        double mean[3] = {0.0, 0.0, 0.0}, u[3], v[3];
        for (size_t k = 0; k < 3; ++k) {
            p[k] = def.positions + 3 * (size_t)def.indices[i + k];
            for (size_t c = 0; c < 3; ++c) {
                mean[c] += (double)def.normals[3 * (size_t)def.indices[i + k] + c];
            }
        }
        for (size_t c = 0; c < 3; ++c) {
            u[c] = (double)p[1][c] - (double)p[0][c];
            v[c] = (double)p[2][c] - (double)p[0][c];
        }
        for (size_t c = 0; c < 3; ++c) {
            sum += mean[c] * (u[(c + 1) % 3] * v[(c + 2) % 3] - u[(c + 2) % 3] * v[(c + 1) % 3]);
        }
    }
    return sum < 0.0;
}

/// Makes the mesh; closed glass that is inside out, which would have no inside, is turned: *turnsNormals,
/// its normals, too.
static bool createMesh(Loader& loader, vtMeshDef& def, float* normals, uint32_t* indices, bool isGlass,
                       const std::string& name, vtMesh* mesh, bool* turnsNormals)
{
    *turnsNormals = false;
    vtError error = {};
    vtResult result = vtCreateMesh(&def, name.c_str(), mesh, &error);
    if (result == vt_ok && isGlass && mesh->openEdgeCount == 0 && mesh->volume < 0.0) {
        vtDestroyMesh(mesh);
        turnTriangles(indices, def.indexCount);
        *turnsNormals = normals != nullptr && areNormalsAgainst(def);
        if (*turnsNormals) {
            for (size_t i = 0; i < 3 * (size_t)def.vertexCount; ++i) {
                normals[i] = -normals[i];
            }
        }
        ++loader.turnedMeshes;
        result = vtCreateMesh(&def, name.c_str(), mesh, &error);
    }
    return result == vt_ok || loader.fail(result, "%s", error.message);
}

/// Is any of it moved by morph targets or joints? Tangents are not moved along: they are computed then.
static bool isPosed(const Group& group)
{
    return std::any_of(group.parts.begin(), group.parts.end(),
                       [](const Part* part) { return !part->targets.empty() || !part->influences.empty(); });
}

static bool makeMesh(Loader& loader, const Source& source, const Group& group, bool isGlass,
                     const std::string& name, vtMesh* mesh)
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
                       texcoords = floats(group.hasTexcoords, 2), colors = floats(group.hasColors, 3),
                       alphas = floats(group.hasAlphas, 1), texcoords1 = floats(group.hasTexcoords1, 2),
                       tangents = floats(group.hasTangents, 4);
    const Block<uint32_t> indices((uint32_t*)vtAllocate(indexCount, sizeof(uint32_t)));
    if (!positions || !indices || (group.hasNormals && !normals) || (group.hasTexcoords && !texcoords) ||
        (group.hasColors && !colors) || (group.hasAlphas && !alphas) ||
        (group.hasTexcoords1 && !texcoords1) || (group.hasTangents && !tangents)) {
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
        for (size_t i = 0; alphas && i < part->positions.count; ++i) {
            const bool given = part->colors.components == 4;
            alphas[vertex + i] = given ? std::clamp(readNumber(part->colors, i, 3), 0.0f, 1.0f) : 1.0f;
        }
        if (texcoords1) {
            writeNumbers(*part, part->texcoords1, 2, 0.0f, texcoords1.get() + 2 * vertex);
        }
        if (tangents) {
            writeNumbers(*part, part->tangents, 4, 0.0f, tangents.get() + 4 * vertex);
        }
        writeTriangles(*part, (uint32_t)vertex, indices.get() + index);
        vertex += part->positions.count;
        index += 3 * part->triangleCount;
    }
    if (!checkShares(loader, name, texcoords.get(), colors.get(), vertexCount) ||
        !checkShares(loader, name, texcoords1.get(), nullptr, vertexCount) ||
        !checkShares(loader, name, tangents.get(), nullptr, tangents ? 2 * vertexCount : 0)) {
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
    def.alphas = alphas.get();
    def.texcoords1 = texcoords1.get();
    def.tangents = isPosed(group) ? nullptr : tangents.get();
    bool turnsNormals = false, isKept = false;
    if (isPosed(group)) {
        Shape shape = makeShape(loader, source, group, positions.get(), normals.get());
        pose(shape, positions.get(), normals.get());
        isKept = loader.keeps &&
                 (source.node >= 0 || (source.skin >= 0 && loader.rig.skins[(size_t)source.skin].moves));
        if (isKept) {
            shape.mesh = loader.scene->meshCount;
            loader.rig.shapes.push_back(std::move(shape));
        }
    }
    const bool made =
        createMesh(loader, def, normals.get(), indices.get(), isGlass, name, mesh, &turnsNormals);
    if (isKept) {
        loader.rig.shapes.back().turnsNormals = turnsNormals;
    }
    return made;
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
    group.hasTexcoords1 = group.hasTexcoords1 || part.texcoords1.data != nullptr;
    group.hasColors = group.hasColors || part.colors.data != nullptr;
    group.hasAlphas = group.hasAlphas || (part.colors.data != nullptr && part.colors.components == 4);
    group.hasTangents = group.hasTangents && part.tangents.data != nullptr;
}

/// Are these meshes closed together?
static bool areClosed(const vtScene& scene, const std::vector<uint32_t>& meshes)
{
    std::vector<float> positions;
    std::vector<uint32_t> indices;
    for (const uint32_t index : meshes) {
        const vtMesh& mesh = scene.meshes[index];
        const uint32_t first = (uint32_t)(positions.size() / 3);
        positions.insert(positions.end(), mesh.positions, mesh.positions + 3 * (size_t)mesh.vertexCount);
        for (uint32_t i = 0; i < mesh.indexCount; ++i) {
            indices.push_back(first + mesh.indices[i]);
        }
    }
    vtMeshDef def = {};
    def.positions = positions.data();
    def.indices = indices.data();
    def.vertexCount = (uint32_t)(positions.size() / 3);
    def.indexCount = (uint32_t)indices.size();
    vtMesh joined;
    const bool closed = vtCreateMesh(&def, "", &joined, nullptr) == vt_ok && joined.openEdgeCount == 0;
    vtDestroyMesh(&joined);
    return closed;
}

/// Parts of solid glass that differ in their materials and are open each, but closed together, bound one
/// body.
static void findBody(const Loader& loader, Source& source)
{
    const vtScene& scene = *loader.scene;
    std::vector<uint32_t> open;
    source.bounds.assign(source.meshes.size(), false);
    for (size_t i = 0; i < source.meshes.size(); ++i) {
        const vtMaterial& material = scene.materials[source.materials[i]];
        source.bounds[i] =
            !material.opaque && !material.thin && scene.meshes[source.meshes[i]].openEdgeCount > 0;
        if (source.bounds[i]) {
            open.push_back(source.meshes[i]);
        }
    }
    if (open.size() < 2 || !areClosed(scene, open)) {
        source.bounds.assign(source.meshes.size(), false);
    }
}

bool makeMeshes(Loader& loader, const std::vector<uint32_t>& materialOf)
{
    vtScene* scene = loader.scene;
    std::vector<std::vector<Group>> groups(loader.reached.size());
    size_t count = 0;
    for (size_t i = 0; i < groups.size(); ++i) {
        Source& source = loader.sources[(size_t)loader.reached[i]];
        for (const Part& part : source.parts) {
            addPart(part, materialOf[(size_t)part.material + 1], source, groups[i]);
        }
        count += groups[i].size();
    }
    if (!loader.allocate(count, &scene->meshes)) {
        return false;
    }
    for (size_t i = 0; i < groups.size(); ++i) {
        Source& source = loader.sources[(size_t)loader.reached[i]];
        const std::string name = label(source.mesh, loader.model.meshes[(size_t)source.mesh].name);
        for (size_t k = 0; k < groups[i].size(); ++k) {
            const bool isGlass = !scene->materials[source.materials[k]].opaque;
            if (!makeMesh(loader, source, groups[i][k], isGlass, name, &scene->meshes[scene->meshCount])) {
                return false;
            }
            const bool isKept =
                !loader.rig.shapes.empty() && loader.rig.shapes.back().mesh == scene->meshCount;
            const vtMap& bumps = scene->materials[source.materials[k]].maps[vt_mapNormal];
            vtError error = {};
            if (bumps.image >= 0 &&
                vtComputeTangents(&scene->meshes[scene->meshCount], bumps.texcoords, &error) != vt_ok) {
                return loader.fail(error.result, "%s", error.message);
            }
            if (isKept && bumps.image >= 0) {
                loader.rig.shapes.back().tangents = bumps.texcoords;
            }
            source.meshes.push_back(scene->meshCount++);
        }
        findBody(loader, source);
    }
    return true;
}

bool guessSolid(Loader& loader)
{
    vtScene* scene = loader.scene;
    bool guess = !scene->allGlass;
    for (uint32_t i = 0; i < scene->materialCount; ++i) {
        guess = guess && scene->materials[i].thin;
    }
    for (uint32_t i = 0; i < scene->meshCount; ++i) {
        guess = guess && scene->meshes[i].openEdgeCount == 0;
    }
    for (uint32_t i = 0; guess && i < scene->materialCount; ++i) {
        scene->materials[i].thin = false;
    }
    if (guess) {
        loader.note(
            "it is nothing but closed glass without KHR_materials_volume, which is taken to be solid; "
            "--walls thin draws walls, as the standard has it");
    }
    return true;
}

} // namespace vtGltf
