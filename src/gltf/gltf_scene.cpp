// A scene's nodes: what they place, and where.

#include "gltf/gltf.h"

#include <algorithm>
#include <cmath>

namespace vtGltf
{

static const int maxNodeDepth = 1000; // far beyond any skeleton

// ------------------------------------------------------------------------------------------------- nodes

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
    if (!(std::fabs(r[0]) + std::fabs(r[1]) + std::fabs(r[2]) + std::fabs(r[3]) > 0.0)) {
        return loader.fail(vt_errorFormat, "node %d has a rotation of zero length" GLTF_DAMAGED, index);
    }
    *matrix = composeMatrix(t, r, s);
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
    std::vector<uint8_t> isChild(model.nodes.size(), false);
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

/// The parent of each node, -1 where it has none; the last that names it.
static std::vector<int> findParents(const tinygltf::Model& model)
{
    std::vector<int> parents(model.nodes.size(), -1);
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        for (const int child : model.nodes[i].children) {
            if (child >= 0 && (size_t)child < parents.size()) {
                parents[(size_t)child] = (int)i;
            }
        }
    }
    return parents;
}

/// A node's transform to the world, wherever it is in the file.
static bool findWorld(Loader& loader, const std::vector<int>& parents, int node, Matrix* toWorld)
{
    *toWorld = Matrix();
    for (int depth = 0; node >= 0; node = parents[(size_t)node]) {
        Matrix local;
        if (++depth > maxNodeDepth) {
            return loader.fail(vt_errorFormat, "joint %d has more than %d nodes above it" GLTF_DAMAGED, node,
                               maxNodeDepth);
        }
        if (!readTransform(loader, node, &local)) {
            return false;
        }
        *toWorld = multiply(local, *toWorld);
    }
    return true;
}

/// From the mesh, through its bind pose, to where the joints are.
static bool readSkin(Loader& loader, int index, std::vector<Matrix>* joints)
{
    if (!loader.has("skin", index, loader.skins.size())) {
        return false;
    }
    const Skin& skin = loader.skins[(size_t)index];
    const std::vector<int> parents = findParents(loader.model);
    Stream inverse;
    if (skin.inverseBindMatrices >= 0) {
        if (!openAccessor(loader, skin.inverseBindMatrices, &inverse)) {
            return false;
        }
        if (inverse.components != 16 || inverse.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT ||
            inverse.count < skin.joints.size()) {
            return loader.fail(vt_errorFormat,
                               "skin %d has no matrix of floats for each of its %zu joints" GLTF_DAMAGED,
                               index, skin.joints.size());
        }
    }
    for (size_t i = 0; i < skin.joints.size(); ++i) {
        Matrix toWorld, bind;
        if (!loader.has("node", skin.joints[i], loader.model.nodes.size()) ||
            !findWorld(loader, parents, skin.joints[i], &toWorld)) {
            return false;
        }
        for (size_t k = 0; inverse.data != nullptr && k < 16; ++k) {
            bind.m[k] = (double)readNumber(inverse, i, k);
        }
        joints->push_back(multiply(toWorld, bind));
    }
    return true;
}

/// The source that a node's mesh is, opened where it is new; -1 where that failed.
static int findSource(Loader& loader, const tinygltf::Node& node)
{
    const tinygltf::Mesh& mesh = loader.model.meshes[(size_t)node.mesh];
    const std::vector<double>& weights = node.weights.empty() ? mesh.weights : node.weights;
    std::vector<int>& known = loader.sourcesOf[(size_t)node.mesh];
    for (const int candidate : known) {
        const Source& source = loader.sources[(size_t)candidate];
        if (source.skin == node.skin && source.weights == weights) {
            return candidate;
        }
    }
    Source source = {node.mesh, weights, node.skin};
    if (node.skin >= 0 && !readSkin(loader, node.skin, &source.joints)) {
        return -1;
    }
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        if (!addPrimitive(loader, primitive, &source)) {
            return -1;
        }
    }
    const int index = (int)loader.sources.size();
    known.push_back(index);
    if (!source.parts.empty()) {
        loader.reached.push_back(index);
    }
    loader.sources.push_back(std::move(source));
    return index;
}

/// Scaled to nothing along all axes, which is a way to hide something?
static bool isPoint(const Matrix& place)
{
    double sum = 0.0;
    for (int i = 0; i < 12; ++i) {
        sum += std::fabs(place.m[i]);
    }
    return sum == 0.0;
}

/// Places a node's mesh, once or as often as its instances say.
static bool placeMesh(Loader& loader, int index, const Matrix& toWorld)
{
    const tinygltf::Node& node = loader.model.nodes[(size_t)index];
    if (!loader.has("mesh", node.mesh, loader.model.meshes.size())) {
        return false;
    }
    const int source = findSource(loader, node);
    if (source < 0 || loader.sources[(size_t)source].parts.empty()) {
        return source >= 0;
    }
    std::vector<Matrix> instances;
    bool found;
    if (!readInstances(loader, index, &found, &instances)) {
        return false;
    }
    // Joints place a skinned mesh, its own node does not.
    const Matrix base = node.skin >= 0 ? Matrix() : toWorld;
    if (!found) {
        instances.push_back(Matrix());
    }
    for (const Matrix& instance : instances) {
        const Matrix place = multiply(base, instance);
        if (!isPoint(place)) {
            loader.objects.push_back({index, source, place});
        }
    }
    return loader.objects.size() <= VT_MAX_OBJECTS || !found || failObjects(loader, loader.objects.size());
}

/// Places a node's mesh and its camera.
static bool addNode(Loader& loader, int index, const Matrix& toWorld)
{
    const tinygltf::Node& node = loader.model.nodes[(size_t)index];
    if (node.camera >= 0) {
        if (!loader.has("camera", node.camera, loader.model.cameras.size())) {
            return false;
        }
        loader.cameras.push_back({index, node.camera, toWorld});
    }
    const auto lit = node.extensions.find("KHR_lights_punctual");
    if (lit != node.extensions.end() && lit->second.Has("light") && lit->second.Get("light").IsNumber()) {
        const double light = lit->second.Get("light").GetNumberAsDouble();
        if (!loader.has("light", (int)std::clamp(light, -1.0, (double)INT32_MAX),
                        loader.model.lights.size())) {
            return false;
        }
        loader.lights.push_back({index, (int)light, toWorld});
    }
    return node.mesh < 0 || placeMesh(loader, index, toWorld);
}

/// KHR_node_visibility: is the node, with all below it, left out?
static bool isHidden(const tinygltf::Node& node)
{
    const auto at = node.extensions.find("KHR_node_visibility");
    return at != node.extensions.end() && at->second.Has("visible") && at->second.Get("visible").IsBool() &&
           !at->second.Get("visible").Get<bool>();
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
    loader.sourcesOf.resize(loader.model.meshes.size());
    visitLater(roots, 1, Matrix());
    std::vector<uint8_t> seen(nodes.size(), false);
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
        if (isHidden(nodes[index])) {
            continue;
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
