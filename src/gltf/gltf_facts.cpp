// What `vitrine inspect` tells of a file beside its scene.

#include "gltf/gltf.h"

#include <cstdio>
#include <cstring>

extern "C" {
#include "gltf/model_facts.h"
}

#ifdef VT_WITH_ABOUT
namespace vtGltf
{

/// A line each, or null for none; false where memory is out.
static bool join(const std::vector<std::string>& texts, char** lines)
{
    std::string all;
    for (const std::string& text : texts) {
        all += (all.empty() ? "" : "\n") + quotable(text);
    }
    if (!texts.empty()) {
        *lines = (char*)vtAllocate(all.size() + 1, 1);
        if (*lines == nullptr) {
            return false;
        }
        memcpy(*lines, all.c_str(), all.size() + 1);
    }
    return true;
}

static void describeMaterial(const Loader& loader, int index, vtMaterialFacts* facts)
{
    facts->index = index;
    if (index < 0) {
        return;
    }
    const tinygltf::Material& material = loader.model.materials[(size_t)index];
    snprintf(facts->name, sizeof facts->name, "%s", quotable(material.name).c_str());
    const vtGltfFeature* feature;
    for (int i = 0; (feature = vtGltfFeature_At(i)) != nullptr; ++i) {
        if (usesFeature(material, *feature)) {
            const bool drawn = feature->support == vt_gltfDrawn || feature->support == vt_gltfApproximated;
            char* list = drawn ? facts->drawn : facts->ignored;
            const size_t used = strlen(list), size = sizeof facts->drawn;
            snprintf(list + used, size - used, "%s%s", used > 0 ? ", " : "", feature->name);
        }
    }
}

static bool collectFacts(const Loader& loader, vtModelFacts* facts)
{
    const tinygltf::Model& model = loader.model;
    facts->nodeCount = (uint32_t)model.nodes.size();
    facts->meshCount = (uint32_t)model.meshes.size();
    facts->materialCount = (uint32_t)model.materials.size();
    facts->textureCount = (uint32_t)model.textures.size();
    facts->imageCount = (uint32_t)loader.pictures.size();
    facts->skinCount = (uint32_t)loader.skins.size();
    facts->animationCount = (uint32_t)loader.rig.animations.size();
    facts->lightCount = (uint32_t)loader.lightCount;
    const std::vector<int> materials = listMaterials(loader);
    facts->materials = (vtMaterialFacts*)vtAllocateZeroed(materials.size(), sizeof *facts->materials);
    facts->animations = (vtAnimationFacts*)vtAllocateZeroed(facts->animationCount, sizeof *facts->animations);
    if (facts->materials == nullptr || facts->animations == nullptr ||
        !join(loader.variants, &facts->variants) || !join(loader.used, &facts->used) ||
        !join(loader.required, &facts->required)) {
        return false;
    }
    for (uint32_t i = 0; i < facts->animationCount; ++i) {
        const Animation& animation = loader.rig.animations[i];
        snprintf(facts->animations[i].name, sizeof facts->animations[i].name, "%s", animation.name.c_str());
        facts->animations[i].duration = animation.facts.duration;
    }
    for (const int material : materials) {
        describeMaterial(loader, material, &facts->materials[facts->usedMaterialCount++]);
    }
    return true;
}

} // namespace vtGltf

extern "C" vtResult vtInspectModel(const vtModelDef* def, vtScene* scene, vtModelFacts* facts, vtError* error)
{
    *facts = vtModelFacts{};
    const auto collect = [](vtGltf::Loader& loader, void* to) {
        return vtGltf::collectFacts(loader, (vtModelFacts*)to) ||
               loader.fail(vt_errorMemory, "out of memory");
    };
    const vtResult result = vtGltf::loadSafely(def, scene, true, error, collect, facts);
    if (result != vt_ok) {
        vtDestroyModelFacts(facts);
    }
    return result;
}

extern "C" void vtDestroyModelFacts(vtModelFacts* facts)
{
    vtFree(facts->variants);
    vtFree(facts->used);
    vtFree(facts->required);
    vtFree(facts->materials);
    vtFree(facts->animations);
    *facts = vtModelFacts{};
}
#endif
