// From parts to one mesh: transforms applied, strips and fans taken apart.

#include "scene/gltf.h"

#include <cmath>
#include <cstdlib>
#include <cstring>

namespace gltf
{

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

static void readVector(const Stream& stream, size_t i, double v[3])
{
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t bits = readU32(stream.data + i * stream.stride + 4 * k);
        float value;
        memcpy(&value, &bits, sizeof value);
        v[k] = (double)value;
    }
}

/// The matrix for normals and whether the transform mirrors. The cofactors are the inverse transpose times
/// the determinant, so they exist for flat transforms too; the sign is put right where it is mirrored.
static bool normalMatrix(const Matrix& toWorld, double cofactors[9])
{
    const double* m = toWorld.m;
    for (int column = 0; column < 3; ++column) {
        const double* a = m + 4 * ((column + 1) % 3);
        const double* b = m + 4 * ((column + 2) % 3);
        cofactors[3 * column + 0] = a[1] * b[2] - a[2] * b[1];
        cofactors[3 * column + 1] = a[2] * b[0] - a[0] * b[2];
        cofactors[3 * column + 2] = a[0] * b[1] - a[1] * b[0];
    }
    const bool mirrored = m[0] * cofactors[0] + m[1] * cofactors[1] + m[2] * cofactors[2] < 0.0;
    for (int i = 0; i < 9 && mirrored; ++i) {
        cofactors[i] = -cofactors[i];
    }
    return mirrored;
}

static void writePositions(const Part& part, float* positions)
{
    const double* m = part.toWorld.m;
    for (size_t i = 0; i < part.positions.count; ++i) {
        double v[3];
        readVector(part.positions, i, v);
        for (size_t k = 0; k < 3; ++k) {
            positions[3 * i + k] = (float)(m[k] * v[0] + m[4 + k] * v[1] + m[8 + k] * v[2] + m[12 + k]);
        }
    }
}

static void writeNormals(const Part& part, const double cofactors[9], float* normals)
{
    for (size_t i = 0; i < part.normals.count; ++i) {
        double v[3], n[3];
        readVector(part.normals, i, v);
        for (size_t k = 0; k < 3; ++k) {
            n[k] = cofactors[k] * v[0] + cofactors[3 + k] * v[1] + cofactors[6 + k] * v[2];
        }
        const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (size_t k = 0; k < 3; ++k) {
            normals[3 * i + k] = (float)(length > 0.0 ? n[k] / length : n[k]); // NaN passes on to be refused
        }
    }
}

static void writeTriangles(const Part& part, bool mirrored, uint32_t firstVertex, uint32_t* indices)
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
        if (mirrored) {
            std::swap(to[1], to[2]);
        }
    }
}

/// Normals that a part lacks stay zero, and vtCreateMesh computes those; `normals` may be null.
static void writeParts(const std::vector<Part>& parts, float* positions, float* normals, uint32_t* indices)
{
    size_t vertex = 0;
    for (const Part& part : parts) {
        double cofactors[9];
        const bool mirrored = normalMatrix(part.toWorld, cofactors);
        writePositions(part, positions + 3 * vertex);
        if (part.normals.data != nullptr) {
            writeNormals(part, cofactors, normals + 3 * vertex);
        }
        writeTriangles(part, mirrored, (uint32_t)vertex, indices);
        vertex += part.positions.count;
        indices += 3 * part.triangleCount;
    }
}

bool buildMesh(Loader& loader, vtMesh* mesh)
{
    unsigned long long vertexCount = 0, indexCount = 0;
    bool hasNormals = false;
    for (const Part& part : loader.parts) {
        vertexCount += part.positions.count;
        indexCount += 3ull * part.triangleCount;
        hasNormals = hasNormals || part.normals.data != nullptr;
    }
    if (indexCount == 0) {
        return loader.fail(vt_errorGeometry,
                           "its scene has no triangles; export it with its meshes, in a scene");
    }
    if (vertexCount > UINT32_MAX || indexCount > UINT32_MAX || vertexCount > SIZE_MAX / 12 ||
        indexCount > SIZE_MAX / 4) {
        return loader.fail(vt_errorGeometry,
                           "it has %llu vertices and %llu indices, more than 32 bits can count; simplify it",
                           vertexCount, indexCount);
    }
    float* positions = (float*)malloc((size_t)vertexCount * 3 * sizeof(float));
    float* normals = hasNormals ? (float*)calloc((size_t)vertexCount * 3, sizeof(float)) : nullptr;
    uint32_t* indices = (uint32_t*)malloc((size_t)indexCount * sizeof(uint32_t));
    if (positions == nullptr || indices == nullptr || (hasNormals && normals == nullptr)) {
        loader.fail(vt_errorMemory, "no memory for %llu vertices and %llu indices; simplify it", vertexCount,
                    indexCount);
    } else {
        writeParts(loader.parts, positions, normals, indices);
        vtMeshDef def = {};
        def.positions = positions;
        def.normals = normals;
        def.indices = indices;
        def.vertexCount = (uint32_t)vertexCount;
        def.indexCount = (uint32_t)indexCount;
        loader.result = vtCreateMesh(&def, loader.def->name, mesh, loader.error);
    }
    free(positions);
    free(normals);
    free(indices);
    return loader.result == vt_ok;
}

} // namespace gltf
