// What a scene's nodes place, and where.

#include "gltf/gltf.h"

#include <algorithm>
#include <cmath>

namespace vtGltf
{

/// Weights of morph targets that are animated: one for each target.
static bool ownsWeights(const Loader& loader, int node)
{
    return (loader.rig.nodes[(size_t)node].animated & 1u << (int)Path::weights) != 0;
}

/// The source that a node's mesh is, opened where it is new; -1 where that failed.
static int findSource(Loader& loader, int number)
{
    const tinygltf::Node& node = loader.model.nodes[(size_t)number];
    const tinygltf::Mesh& mesh = loader.model.meshes[(size_t)node.mesh];
    std::vector<double> weights = node.weights.empty() ? mesh.weights : node.weights;
    const int owner = ownsWeights(loader, number) ? number : -1;
    if (owner >= 0) {
        Node& moved = loader.rig.nodes[(size_t)number];
        weights.resize(targetCountOf(mesh));
        moved.weights.assign(weights.begin(), weights.end());
        moved.weightsNow = moved.weights;
    }
    std::vector<int>& known = loader.sourcesOf[(size_t)node.mesh];
    for (const int candidate : known) {
        const Source& source = loader.sources[(size_t)candidate];
        if (source.skin == node.skin && source.weights == weights && source.node == owner) {
            return candidate;
        }
    }
    Source source = {node.mesh, weights, node.skin, owner};
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
        if (!spendPrimitive(loader, primitive, source)) {
            return -1;
        }
    }
    if (node.skin >= 0 && !openSkin(loader, node.skin)) {
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
    if (loader.objects.size() > VT_MAX_OBJECTS) { // that are too many; the sentence counts the others, too
        loader.objects.push_back({index, 0, toWorld});
        return true;
    }
    const int source = findSource(loader, index);
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
            loader.objects.push_back({index, source, place, instance, node.skin >= 0});
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

bool collectNodes(Loader& loader)
{
    loader.sourcesOf.resize(loader.model.meshes.size());
    for (const size_t node : loader.reachedNodes) {
        // By value: what is placed may bring joints, and they more nodes.
        const Matrix toWorld = loader.rig.nodes[node].toWorld;
        if (!addNode(loader, (int)node, toWorld)) {
            return false;
        }
    }
    if (loader.objects.size() > VT_MAX_OBJECTS) {
        return failObjects(loader, loader.objects.size());
    }
    return !loader.objects.empty() ||
           loader.fail(vt_errorGeometry, "its scene has no triangles that are neither hidden nor scaled to "
                                         "nothing; export it with its meshes, in a scene");
}

} // namespace vtGltf
