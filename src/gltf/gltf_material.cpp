// Materials of glTF 2.0 and its extensions KHR_materials_transmission, _ior, _volume and _emissive_strength.
//
// Any transmission makes solid glass: there is no share of it. Not drawn: pictures on glass, normal maps,
// emissive pictures (a material that has one gives no light at all, rather than too much), clearcoat and the
// like; KHR_materials_unlit is taken as lit. doubleSided needs nothing: surfaces count from both sides.

#include "gltf/gltf.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

extern "C" {
#include "image/image.h"
}

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
    *number = value->IsNumber() ? value->GetNumberAsDouble() : NAN;
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

static bool readAttenuation(Loader& loader, int index, vtMaterial* material)
{
    const char* extension = "KHR_materials_volume";
    double distance = 0.0; // infinite, says the extension; some exporters write it as 0, too
    if (!readExtra(loader, index, extension, "attenuationDistance", "an attenuationDistance", 0.0,
                   &distance)) {
        return false;
    }
    material->attenuationDistance = (float)distance;
    const tinygltf::Value* color =
        findValue(loader.model.materials[(size_t)index], extension, "attenuationColor");
    if (color == nullptr) {
        return true;
    }
    std::vector<double> numbers;
    for (int i = 0; color->IsArray() && i < (int)color->ArrayLen() && i < 4; ++i) {
        numbers.push_back(color->Get(i).IsNumber() ? color->Get(i).GetNumberAsDouble() : NAN);
    }
    if (numbers.size() != 3 || std::isnan(numbers[0] + numbers[1] + numbers[2])) {
        return loader.fail(
            vt_errorFormat,
            "material %d has an attenuationColor that is not three numbers; correct KHR_materials_volume",
            index);
    }
    material->attenuationColor = toColor(numbers);
    return true;
}

// --------------------------------------------------------------------------------------------- materials

static bool readGlass(Loader& loader, int index, vtMaterial* material)
{
    material->tint = toColor(loader.model.materials[(size_t)index].pbrMetallicRoughness.baseColorFactor);
    return readAttenuation(loader, index, material);
}

/// glTF's default where index is -1. Pictures come later.
static bool readOpaque(Loader& loader, int index, vtMaterial* material)
{
    const tinygltf::Material standard;
    const tinygltf::Material& given = index >= 0 ? loader.model.materials[(size_t)index] : standard;
    const tinygltf::PbrMetallicRoughness& look = given.pbrMetallicRoughness;
    double strength = 1.0;
    if (index >= 0 && !readExtra(loader, index, "KHR_materials_emissive_strength", "emissiveStrength",
                                 "an emissiveStrength", 0.0, &strength)) {
        return false;
    }
    strength = given.emissiveTexture.index >= 0 ? 0.0 : strength;
    const auto light = [&](size_t i) {
        const double factor = i < given.emissiveFactor.size() ? given.emissiveFactor[i] : 0.0;
        return (float)std::clamp(factor * strength, 0.0, (double)FLT_MAX);
    };
    material->opaque = true;
    material->baseColor = toColor(look.baseColorFactor);
    material->metallic = (float)std::clamp(look.metallicFactor, 0.0, 1.0);
    material->roughness = (float)std::clamp(look.roughnessFactor, 0.0, 1.0);
    material->emissive = {light(0), light(1), light(2)};
    return true;
}

/// The file's material as it says; without KHR_materials_transmission it is opaque.
static bool readMaterial(Loader& loader, int index, vtMaterial* material)
{
    *material = vtDefaultMaterial();
    if (index < 0) {
        return readOpaque(loader, index, material);
    }
    double transmission = 0.0, ior = 1.5;
    if (!readExtra(loader, index, "KHR_materials_transmission", "transmissionFactor", "a transmissionFactor",
                   0.0, &transmission) ||
        !readExtra(loader, index, "KHR_materials_ior", "ior", "an index of refraction", 1.0, &ior)) {
        return false;
    }
    material->ior = (float)ior;
    return transmission > 0.0 ? readGlass(loader, index, material) : readOpaque(loader, index, material);
}

// ---------------------------------------------------------------------------------------------- pictures

/// Loads the picture of a texture, unless it is there; *image is its number in the scene.
static bool usePicture(Loader& loader, const tinygltf::TextureInfo& info, int* image)
{
    if (info.index < 0) {
        return true;
    }
    if (!loader.has("texture", info.index, loader.model.textures.size())) {
        return false;
    }
    const int source = loader.model.textures[(size_t)info.index].source;
    if (source < 0) {
        return loader.fail(vt_errorFormat,
                           "texture %d has no PNG or JPEG picture; export it with pictures of these formats",
                           info.index);
    }
    if (!loader.has("image", source, loader.pictures.size())) {
        return false;
    }
    Picture& picture = loader.pictures[(size_t)source];
    if (picture.image < 0) {
        std::vector<uint8_t> contents;
        Bytes bytes;
        if (!openPicture(loader, source, &contents, &bytes)) {
            return false;
        }
        const bool isFile = picture.name.empty() && picture.uri.compare(0, 5, "data:") != 0;
        const std::string name = label(source, isFile ? picture.uri : picture.name);
        vtError error = {};
        const vtResult result = vtDecodeImage(bytes.data, bytes.size, name.c_str(),
                                              &loader.scene->images[loader.scene->imageCount], &error);
        if (result != vt_ok) {
            return loader.fail(result, "%s", error.message);
        }
        picture.image = (int)loader.scene->imageCount++;
    }
    *image = picture.image;
    return true;
}

static bool usePictures(Loader& loader, int index, vtMaterial* material)
{
    if (index < 0 || !material->opaque) {
        return true;
    }
    const tinygltf::PbrMetallicRoughness& look = loader.model.materials[(size_t)index].pbrMetallicRoughness;
    return usePicture(loader, look.baseColorTexture, &material->baseColorImage) &&
           usePicture(loader, look.metallicRoughnessTexture, &material->metallicRoughnessImage);
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

bool makeMaterials(Loader& loader, std::vector<uint32_t>* materialOf)
{
    vtScene* scene = loader.scene;
    std::vector<vtMaterial> materials;
    std::vector<int> used; // their numbers in the file
    materialOf->assign(loader.model.materials.size() + 1, UINT32_MAX);
    for (const int source : loader.reached) {
        for (const Part& part : loader.sources[(size_t)source].parts) {
            uint32_t* slot = &(*materialOf)[(size_t)(part.material + 1)];
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
    for (size_t i = 0; i < materials.size(); ++i) {
        if (!scene->allGlass && !usePictures(loader, used[i], &materials[i])) {
            return false;
        }
        scene->materials[i] = materials[i];
    }
    return true;
}

} // namespace vtGltf
