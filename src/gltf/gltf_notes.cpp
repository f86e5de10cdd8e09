// What of a file is not in the picture, told in its scene's notes.

#include "gltf/gltf.h"

#include <cstring>

namespace vtGltf
{

bool usesFeature(const tinygltf::Material& material, const vtGltfFeature& feature)
{
    bool used = material.extensions.count(feature.name) > 0;
    for (const tinygltf::ExtensionMap* extensions :
         {&material.pbrMetallicRoughness.baseColorTexture.extensions,
          &material.pbrMetallicRoughness.metallicRoughnessTexture.extensions,
          &material.normalTexture.extensions, &material.occlusionTexture.extensions,
          &material.emissiveTexture.extensions}) {
        used = used || extensions->count(feature.name) > 0;
    }
    return used;
}

std::vector<int> listMaterials(const Loader& loader)
{
    std::vector<uint8_t> used(loader.model.materials.size() + 1, false);
    for (const int source : loader.reached) {
        for (const Part& part : loader.sources[(size_t)source].parts) {
            used[(size_t)part.material + 1] = true;
        }
    }
    std::vector<int> materials;
    for (size_t i = 0; i < used.size(); ++i) {
        if (used[i]) {
            materials.push_back((int)i - 1);
        }
    }
    return materials;
}

static void noteMaterials(Loader& loader)
{
    const std::vector<int> materials = listMaterials(loader);
    const vtGltfFeature* feature;
    for (int i = 0; (feature = vtGltfFeature_At(i)) != nullptr; ++i) {
        size_t count = 0;
        for (const int material : materials) {
            count += feature->support == vt_gltfIgnored && material >= 0 &&
                     usesFeature(loader.model.materials[(size_t)material], *feature);
        }
        if (count > 0) {
            loader.noteIgnored("%s of %s", feature->name, counted(count, "material").c_str());
        }
    }
}

/// What was dropped unseen of the whole file.
static void noteUnread(Loader& loader)
{
    if (loader.unplayed > 0) {
        loader.noteIgnored("%s of animations", counted(loader.unplayed, "channel").c_str());
    }
    if (loader.animationCount > 0 && !loader.keeps) {
        loader.noteIgnored("%s", counted(loader.animationCount, "animation").c_str());
    }
    if (loader.variant < 0 && !loader.variants.empty()) {
        loader.noteIgnored("%s", counted(loader.variants.size(), "variant").c_str());
    }
    for (const std::string& extension : loader.used) {
        if (vtFindGltfExtension(extension.c_str()) == nullptr) {
            loader.noteIgnored("extension %s", quotable(extension).c_str());
        }
    }
}

bool makeNotes(Loader& loader)
{
    noteUnread(loader);
    if (!loader.scene->allGlass) { // else nothing of them is asked for
        noteMaterials(loader);
    }
    if (loader.primitivesWithoutTriangles > 0) {
        loader.noteIgnored("points and lines of %s",
                           counted((size_t)loader.primitivesWithoutTriangles, "primitive").c_str());
    }
    if (loader.turnedMeshes > 0) {
        loader.note("%s of glass had their triangles inside out and were turned",
                    counted((size_t)loader.turnedMeshes, "mesh part").c_str());
    }
    std::string ignored;
    for (const std::string& what : loader.ignored) {
        ignored += (ignored.empty() ? "" : ", ") + what;
    }
    if (!ignored.empty()) {
        loader.note("ignored: %s", ignored.c_str());
    }
    if (loader.notes.empty()) {
        return true;
    }
    if (!loader.allocate(loader.notes.size() + 1, &loader.scene->notes)) {
        return false;
    }
    memcpy(loader.scene->notes, loader.notes.c_str(), loader.notes.size());
    return true;
}

} // namespace vtGltf
