// Nodes at rest: the scene's, and those that joints hang on.

#include "gltf/gltf.h"

#include <algorithm>
#include <cmath>

namespace vtGltf
{

static const int maxNodeDepth = 1000; // far beyond any skeleton

/// Copies what the file gives and leaves what it does not; false where the number of numbers is wrong.
static bool copyNumbers(const std::vector<double>& from, double* to, size_t count)
{
    std::copy_n(from.begin(), std::min(from.size(), count), to);
    return from.empty() || from.size() == count;
}

/// A node's own transform: its matrix, or translation * rotation * scale.
static bool readTransform(Loader& loader, size_t index)
{
    const tinygltf::Node& given = loader.model.nodes[index];
    Node& node = loader.rig.nodes[index];
    Local& rest = node.rest;
    if (!copyNumbers(given.matrix, node.matrix.m, 16) || !copyNumbers(given.translation, rest.t, 3) ||
        !copyNumbers(given.rotation, rest.r, 4) || !copyNumbers(given.scale, rest.s, 3)) {
        return loader.fail(vt_errorFormat,
                           "node %zu has a transform with too many or too few numbers" GLTF_DAMAGED, index);
    }
    node.hasMatrix = !given.matrix.empty();
    const double* m = node.matrix.m;
    if (std::fabs(m[3]) + std::fabs(m[7]) + std::fabs(m[11]) + std::fabs(m[15] - 1.0) > 1e-4) {
        return loader.fail(
            vt_errorFormat,
            "node %zu has a matrix whose last row is %g, %g, %g, %g, but it must be 0, 0, 0, 1" GLTF_DAMAGED,
            index, m[3], m[7], m[11], m[15]);
    }
    const double* r = rest.r;
    if (!node.hasMatrix && !(std::fabs(r[0]) + std::fabs(r[1]) + std::fabs(r[2]) + std::fabs(r[3]) > 0.0)) {
        return loader.fail(vt_errorFormat, "node %zu has a rotation of zero length" GLTF_DAMAGED, index);
    }
    node.now = rest;
    return true;
}

/// Places a node below another one, which is placed, or in the world (-1).
static bool addToOrder(Loader& loader, size_t index, int parent)
{
    Rig& rig = loader.rig;
    Node& node = rig.nodes[index];
    const unsigned places = 1u << (int)Path::translation | 1u << (int)Path::rotation | 1u << (int)Path::scale;
    if (!readTransform(loader, index)) {
        return false;
    }
    if (node.hasMatrix && (node.animated & places) != 0) {
        return loader.fail(vt_errorFormat,
                           "node %zu has a matrix, so animations cannot move it; export it with translation, "
                           "rotation and scale",
                           index);
    }
    node.parent = parent;
    node.moves = (node.animated & places) != 0 || (parent >= 0 && rig.nodes[(size_t)parent].moves);
    rig.order.push_back(index);
    loader.placed[index] = true;
    placeNode(rig, index);
    return true;
}

/// The nodes a scene starts from: those of the default scene, else of the first, else all without a parent.
static bool findRoots(Loader& loader, const std::vector<int>& parents, std::vector<int>* roots)
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
    for (size_t i = 0; i < parents.size(); ++i) {
        if (parents[i] < 0) {
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

/// KHR_node_visibility: is the node, with all below it, left out?
static bool isHidden(const tinygltf::Node& node)
{
    const auto at = node.extensions.find("KHR_node_visibility");
    return at != node.extensions.end() && at->second.Has("visible") && at->second.Get("visible").IsBool() &&
           !at->second.Get("visible").Get<bool>();
}

bool placeNodes(Loader& loader)
{
    struct Visit {
        int node, parent, depth;
    };
    std::vector<Visit> open; // a stack of our own, in reverse so that nodes come in the file's order
    const auto visitLater = [&open](const std::vector<int>& nodes, int parent, int depth) {
        for (size_t i = nodes.size(); i-- > 0;) {
            open.push_back({nodes[i], parent, depth});
        }
    };
    const std::vector<tinygltf::Node>& nodes = loader.model.nodes;
    std::vector<int> roots;
    loader.parents = findParents(loader.model);
    loader.placed.resize(nodes.size());
    if (!findRoots(loader, loader.parents, &roots)) {
        return false;
    }
    visitLater(roots, -1, 1);
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
        if (!addToOrder(loader, index, visit.parent)) {
            return false;
        }
        if (!isHidden(nodes[index])) {
            loader.reachedNodes.push_back(index);
            visitLater(nodes[index].children, visit.node, visit.depth + 1);
        }
    }
    return true;
}

/// Places a node that may be outside the scene, and those above it that are not placed yet.
static bool placeJoint(Loader& loader, int joint)
{
    std::vector<size_t> chain;
    int above = joint;
    for (; above >= 0 && !loader.placed[(size_t)above]; above = loader.parents[(size_t)above]) {
        if (chain.size() == (size_t)maxNodeDepth) {
            return loader.fail(vt_errorFormat, "joint %d has more than %d nodes above it" GLTF_DAMAGED, joint,
                               maxNodeDepth);
        }
        chain.push_back((size_t)above);
    }
    for (size_t i = chain.size(); i-- > 0;) {
        if (!addToOrder(loader, chain[i], above)) {
            return false;
        }
        above = (int)chain[i];
    }
    return true;
}

bool openSkin(Loader& loader, int index)
{
    if (!loader.has("skin", index, loader.skins.size())) {
        return false;
    }
    loader.rig.skins.resize(loader.skins.size());
    const Skin& skin = loader.skins[(size_t)index];
    Joints& joints = loader.rig.skins[(size_t)index];
    if (!joints.nodes.empty()) {
        return true; // for another mesh
    }
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
        if (!loader.has("node", skin.joints[i], loader.model.nodes.size()) ||
            !placeJoint(loader, skin.joints[i])) {
            return false;
        }
        Matrix bind;
        for (size_t k = 0; inverse.data != nullptr && k < 16; ++k) {
            bind.m[k] = (double)readNumber(inverse, i, k);
        }
        joints.nodes.push_back((size_t)skin.joints[i]);
        joints.binds.push_back(bind);
        joints.moves = joints.moves || loader.rig.nodes[(size_t)skin.joints[i]].moves;
    }
    return true;
}

} // namespace vtGltf
