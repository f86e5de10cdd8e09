// Materials of glTF 2.0 and its extensions KHR_materials_transmission, _ior, _volume, _emissive_strength,
// _specular, _iridescence, _dispersion and _unlit.
//
// Glass is what has a share that passes. It is a thin wall unless KHR_materials_volume gives it a thickness.

#include "gltf/gltf.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace vtGltf
{

// -------------------------------------------------------------------------------------------- extensions

/// What an extension of a material gives; null where it does not, or where it says null, as three.js does
/// of infinity.
static const tinygltf::Value* findValue(const tinygltf::Material& material, const char* extension,
                                        const char* key)
{
    const auto at = material.extensions.find(extension);
    return at != material.extensions.end() && at->second.Has(key) ? &at->second.Get(key) : nullptr;
}

/// `what` is the number in words. Leaves *number where the file does not give it.
static bool readExtra(Loader& loader, int index, const char* extension, const char* key, const char* what,
                      double least, double* number)
{
    const tinygltf::Value* value = findValue(loader.model.materials[(size_t)index], extension, key);
    if (value == nullptr) {
        return true;
    }
    if (!value->IsNumber()) {
        return loader.fail(vt_errorFormat, "material %d has %s that is no number; correct %s", index, what,
                           extension);
    }
    *number = value->GetNumberAsDouble();
    return (*number >= least && *number <= (double)FLT_MAX) ||
           loader.fail(vt_errorFormat,
                       "material %d has %s of %g, but it must be a number of %g or more; correct %s", index,
                       what, *number, least, extension);
}

/// Colours are kept to 0 to 1.
static vtVec3 toColor(const std::vector<double>& numbers)
{
    const auto share = [&](size_t i) {
        return (float)std::clamp(i < numbers.size() ? numbers[i] : 1.0, 0.0, 1.0);
    };
    return {share(0), share(1), share(2)};
}

/// Three numbers of 0 and above under a key of an extension. Leaves *color where the file does not give it.
static bool readColor(Loader& loader, int index, const char* extension, const char* key, vtVec3* color)
{
    const tinygltf::Value* value = findValue(loader.model.materials[(size_t)index], extension, key);
    if (value == nullptr) {
        return true;
    }
    double numbers[3] = {NAN, NAN, NAN};
    for (int i = 0; value->IsArray() && value->ArrayLen() == 3 && i < 3; ++i) {
        numbers[i] = value->Get(i).IsNumber() ? value->Get(i).GetNumberAsDouble() : NAN;
    }
    for (double& number : numbers) {
        if (std::isnan(number)) {
            return loader.fail(vt_errorFormat, "material %d has a%s %s that is not three numbers; correct %s",
                               index, key[0] == 'a' || key[0] == 'e' ? "n" : "", key, extension);
        }
        number = std::clamp(number, 0.0, (double)FLT_MAX);
    }
    *color = {(float)numbers[0], (float)numbers[1], (float)numbers[2]};
    return true;
}

/// The same of a number, into a float.
static bool readFloat(Loader& loader, int index, const char* extension, const char* key, const char* what,
                      double least, float* number)
{
    double value = (double)*number;
    if (!readExtra(loader, index, extension, key, what, least, &value)) {
        return false;
    }
    *number = (float)value;
    return true;
}

static bool readAttenuation(Loader& loader, int index, vtMaterial* material)
{
    const char* extension = "KHR_materials_volume";
    double distance = 0.0; // infinite, says the extension; some exporters write it as 0, too
    if (!readExtra(loader, index, extension, "attenuationDistance", "an attenuationDistance", 0.0,
                   &distance) ||
        !readColor(loader, index, extension, "attenuationColor", &material->attenuationColor)) {
        return false;
    }
    material->attenuationDistance = (float)distance;
    material->attenuationColor =
        toColor({(double)material->attenuationColor.x, (double)material->attenuationColor.y,
                 (double)material->attenuationColor.z});
    return true;
}

float emissiveStrengthOf(const tinygltf::Material& material)
{
    const tinygltf::Value* value = findValue(material, "KHR_materials_emissive_strength", "emissiveStrength");
    return value != nullptr && value->IsNumber() ? (float)value->GetNumberAsDouble() : 1.0f;
}

// --------------------------------------------------------------------------------------------- materials

/// What the surface itself is, glass or not.
static bool readSurface(Loader& loader, int index, const tinygltf::Material& given, vtMaterial* material)
{
    const tinygltf::PbrMetallicRoughness& look = given.pbrMetallicRoughness;
    const auto share = [](double number) { return (float)std::clamp(number, 0.0, 1.0); };
    double strength = 1.0;
    if (index >= 0 && !readExtra(loader, index, "KHR_materials_emissive_strength", "emissiveStrength",
                                 "an emissiveStrength", 0.0, &strength)) {
        return false;
    }
    const auto light = [&](size_t i) {
        const double factor = i < given.emissiveFactor.size() ? given.emissiveFactor[i] : 0.0;
        return (float)std::clamp(factor * strength, 0.0, (double)FLT_MAX);
    };
    material->baseColor = material->tint = toColor(look.baseColorFactor);
    material->alpha = look.baseColorFactor.size() == 4 ? share(look.baseColorFactor[3]) : 1.0f;
    material->alphaMode = given.alphaMode == "MASK"    ? vt_alphaMask
                          : given.alphaMode == "BLEND" ? vt_alphaBlend
                                                       : vt_alphaOpaque;
    material->alphaCutoff = (float)std::clamp(given.alphaCutoff, 0.0, 2.0);
    material->metallic = share(look.metallicFactor);
    material->roughness = share(look.roughnessFactor);
    material->emissive = {light(0), light(1), light(2)};
    material->normalScale = (float)given.normalTexture.scale;
    material->occlusionStrength = share(given.occlusionTexture.strength);
    return true;
}

static bool readExtensions(Loader& loader, int index, vtMaterial* material)
{
    const char *specular = "KHR_materials_specular", *film = "KHR_materials_iridescence";
    double ior = 1.5;
    if (!readExtra(loader, index, "KHR_materials_ior", "ior", "an index of refraction", -(double)FLT_MAX,
                   &ior)) {
        return false;
    }
    material->ior = (float)ior;
    material->iridescenceIor = 1.3f;
    return readFloat(loader, index, specular, "specularFactor", "a specularFactor", 0.0,
                     &material->specular) &&
           readColor(loader, index, specular, "specularColorFactor", &material->specularColor) &&
           readFloat(loader, index, film, "iridescenceFactor", "an iridescenceFactor", 0.0,
                     &material->iridescence) &&
           readFloat(loader, index, film, "iridescenceIor", "an iridescenceIor", 1.0,
                     &material->iridescenceIor) &&
           readFloat(loader, index, film, "iridescenceThicknessMinimum", "an iridescenceThicknessMinimum",
                     0.0, &material->iridescenceMin) &&
           readFloat(loader, index, film, "iridescenceThicknessMaximum", "an iridescenceThicknessMaximum",
                     0.0, &material->iridescenceMax) &&
           readFloat(loader, index, "KHR_materials_dispersion", "dispersion", "a dispersion", 0.0,
                     &material->dispersion);
}

/// The file's material as it says; without KHR_materials_transmission it is opaque. -1: glTF's default.
static bool readMaterial(Loader& loader, int index, vtMaterial* material)
{
    const tinygltf::Material standard;
    const tinygltf::Material& given = index >= 0 ? loader.model.materials[(size_t)index] : standard;
    *material = vtDefaultMaterial();
    double transmission = 0.0, thickness = 0.0;
    if (!readSurface(loader, index, given, material)) {
        return false;
    }
    if (index >= 0 && (!readExtensions(loader, index, material) ||
                       !readExtra(loader, index, "KHR_materials_transmission", "transmissionFactor",
                                  "a transmissionFactor", 0.0, &transmission) ||
                       !readExtra(loader, index, "KHR_materials_volume", "thicknessFactor",
                                  "a thicknessFactor", 0.0, &thickness))) {
        return false;
    }
    material->unlit = given.extensions.count("KHR_materials_unlit") > 0;
    material->opaque = !(transmission > 0.0) || material->unlit;
    material->oneSided = material->opaque && !given.doubleSided;
    material->transmission = (float)std::min(transmission, 1.0);
    material->thin = !material->opaque && !(thickness > 0.0);
    return material->opaque || readAttenuation(loader, index, material);
}

// -------------------------------------------------------------------------------------------------- calls

/// Clear glass of each index of refraction that there is. What only differed in colour is one material then,
/// so that a body that was closed by parts of several colours stays closed.
static void makeAllGlass(std::vector<vtMaterial>& materials, std::vector<uint32_t>& materialOf)
{
    std::vector<vtMaterial> glass;
    std::vector<uint32_t> glassOf;
    for (const vtMaterial& opaque : materials) {
        if (glass.size() > VT_MAX_OBJECTS) {
            break; // an error, in which nobody shall search for long
        }
        const auto same = std::find_if(glass.begin(), glass.end(),
                                       [&](const vtMaterial& other) { return other.ior == opaque.ior; });
        glassOf.push_back((uint32_t)(same - glass.begin()));
        if (same == glass.end()) {
            glass.push_back(vtDefaultMaterial());
            glass.back().ior = opaque.ior;
        }
    }
    for (uint32_t& material : materialOf) {
        material = material < glassOf.size() ? glassOf[material] : material;
    }
    materials = glass;
}

/// Glass needs an index that light can bend by. What is opaque only reflects by it, and has the usual one
/// instead.
static bool checkIndex(Loader& loader, int index, bool isGlass, vtMaterial* material)
{
    const double ior = (double)material->ior;
    if (ior == 0.0 || ior >= 1.0) {
        return true;
    }
    if (isGlass) {
        return loader.fail(vt_errorFormat,
                           "material %d has an index of refraction of %g, but it must be 0, or 1 or more; "
                           "correct KHR_materials_ior",
                           index, ior);
    }
    loader.noteIgnored("an index of refraction of %g", ior);
    material->ior = 1.5f;
    return true;
}

bool makeMaterials(Loader& loader, std::vector<uint32_t>* materialOf)
{
    vtScene* scene = loader.scene;
    std::vector<vtMaterial> materials;
    std::vector<int> used; // their numbers in the file
    materialOf->assign(loader.model.materials.size() + 1, UINT32_MAX);
    for (const int source : loader.reached) {
        for (const Part& part : loader.sources[(size_t)source].parts) {
            uint32_t* slot = &(*materialOf)[(size_t)part.material + 1];
            if (*slot == UINT32_MAX) {
                vtMaterial material;
                if (!readMaterial(loader, part.material, &material)) {
                    return false;
                }
                *slot = (uint32_t)materials.size();
                materials.push_back(material);
                used.push_back(part.material);
            }
        }
    }
    scene->allGlass = std::all_of(materials.begin(), materials.end(),
                                  [](const vtMaterial& material) { return material.opaque; });
    for (size_t i = 0; i < materials.size(); ++i) {
        if (!checkIndex(loader, used[i], scene->allGlass || !materials[i].opaque, &materials[i])) {
            return false;
        }
    }
    if (scene->allGlass) {
        makeAllGlass(materials, *materialOf);
    }
    if (materials.size() > VT_MAX_OBJECTS) {
        return loader.fail(vt_errorGeometry,
                           "its scene uses %zu materials but there can be %d; join some and export it again",
                           materials.size(), VT_MAX_OBJECTS);
    }
    if (!loader.allocate(materials.size(), &scene->materials) ||
        !loader.allocate(loader.pictures.size(), &scene->images)) {
        return false;
    }
    scene->materialCount = (uint32_t)materials.size();
    for (size_t i = 0; i < materials.size() && !scene->allGlass; ++i) {
        if (used[i] >= 0 && !checkMaps(loader, loader.model.materials[(size_t)used[i]])) {
            return false;
        }
    }
    for (size_t i = 0; i < materials.size(); ++i) {
        if (!scene->allGlass && used[i] >= 0 &&
            !openMaps(loader, loader.model.materials[(size_t)used[i]], &materials[i])) {
            return false;
        }
        scene->materials[i] = materials[i];
    }
    return true;
}

} // namespace vtGltf
