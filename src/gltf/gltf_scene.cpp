// A scene's nodes: what they place, and where.

#include "gltf/gltf.h"

#include <algorithm>
#include <cmath>

namespace vtGltf
{

static const int maxNodeDepth = 1000; // far beyond any skeleton

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

/// Notes a node's mesh and its camera. A skin is not applied: the bind pose is drawn.
static bool addNode(Loader& loader, int index, const Matrix& toWorld)
{
    const tinygltf::Node& node = loader.model.nodes[(size_t)index];
    if (node.camera >= 0) {
        if (!loader.has("camera", node.camera, loader.model.cameras.size())) {
            return false;
        }
        loader.cameras.push_back({index, node.camera, toWorld});
    }
    if (node.mesh < 0) {
        return true;
    }
    if (!loader.has("mesh", node.mesh, loader.model.meshes.size())) {
        return false;
    }
    Source& source = loader.sources[(size_t)node.mesh];
    if (!source.opened) {
        source.opened = true;
        for (const tinygltf::Primitive& primitive : loader.model.meshes[(size_t)node.mesh].primitives) {
            if (!addPrimitive(loader, primitive, &source.parts)) {
                return false;
            }
        }
        if (!source.parts.empty()) {
            loader.reached.push_back(node.mesh);
        }
    }
    if (!source.parts.empty()) {
        loader.objects.push_back({index, node.mesh, toWorld});
    }
    return true;
}

bool collectNodes(Loader& loader)
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
    loader.sources.resize(loader.model.meshes.size());
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
        if (!addNode(loader, visit.node, toWorld)) {
            return false;
        }
        visitLater(nodes[index].children, visit.depth + 1, toWorld);
    }
    return !loader.objects.empty() ||
           loader.fail(vt_errorGeometry, "its scene has no triangles; export it with its meshes, in a scene");
}

} // namespace vtGltf
