// Pictures of materials: which there are, how they lie on surfaces (KHR_texture_transform), and their
// decoding.

#include "gltf/gltf.h"

#include <algorithm>
#include <cmath>

extern "C" {
#include "image/image.h"
}

namespace vtGltf
{

static double numberOf(const tinygltf::Value& object, const char* key, double standard)
{
    return object.IsObject() && object.Has(key) && object.Get(key).IsNumber()
               ? object.Get(key).GetNumberAsDouble()
               : standard;
}

static double elementOf(const tinygltf::Value& object, const char* key, int element, double standard)
{
    const bool given = object.IsObject() && object.Has(key) && object.Get(key).IsArray() &&
                       (int)object.Get(key).ArrayLen() > element && object.Get(key).Get(element).IsNumber();
    return given ? object.Get(key).Get(element).GetNumberAsDouble() : standard;
}

/// Where the picture lies: scaled, then turned, then moved.
static void readTransform(const tinygltf::Value& transform, TextureUse* use)
{
    const double turn = numberOf(transform, "rotation", 0.0), c = std::cos(turn), s = std::sin(turn);
    const double x = elementOf(transform, "scale", 0, 1.0), y = elementOf(transform, "scale", 1, 1.0);
    const double rows[2][3] = {{c * x, s * y, elementOf(transform, "offset", 0, 0.0)},
                               {-s * x, c * y, elementOf(transform, "offset", 1, 0.0)}};
    for (size_t i = 0; i < 6; ++i) {
        use->rows[i / 3][i % 3] = (float)rows[i / 3][i % 3];
    }
    const double set = numberOf(transform, "texCoord", -1.0);
    use->texCoord = set >= 0.0 && set <= 1000.0 ? (int)set : use->texCoord;
}

/// Of core glTF.
template <typename Info> static void addCore(std::vector<TextureUse>& uses, vtMapUse use, const Info& info)
{
    if (info.index < 0) {
        return;
    }
    TextureUse made = {use, info.index, info.texCoord};
    const auto transform = info.extensions.find("KHR_texture_transform");
    if (transform != info.extensions.end()) {
        readTransform(transform->second, &made);
    }
    uses.push_back(made);
}

/// Of an extension.
static void addExtra(std::vector<TextureUse>& uses, vtMapUse use, const tinygltf::Material& material,
                     const char* extension, const char* key)
{
    const auto at = material.extensions.find(extension);
    if (at == material.extensions.end() || !at->second.IsObject() || !at->second.Has(key)) {
        return;
    }
    const tinygltf::Value& info = at->second.Get(key);
    const double index = numberOf(info, "index", -1.0), set = numberOf(info, "texCoord", 0.0);
    if (!(index >= 0.0 && index <= 1e9)) {
        return;
    }
    TextureUse made = {use, (int)index, set >= 0.0 && set <= 1000.0 ? (int)set : 0};
    if (info.Has("extensions") && info.Get("extensions").IsObject() &&
        info.Get("extensions").Has("KHR_texture_transform")) {
        readTransform(info.Get("extensions").Get("KHR_texture_transform"), &made);
    }
    uses.push_back(made);
}

std::vector<TextureUse> texturesOf(const tinygltf::Material& material)
{
    const tinygltf::PbrMetallicRoughness& look = material.pbrMetallicRoughness;
    std::vector<TextureUse> uses;
    addCore(uses, vt_mapBaseColor, look.baseColorTexture);
    addCore(uses, vt_mapMetallicRoughness, look.metallicRoughnessTexture);
    addCore(uses, vt_mapNormal, material.normalTexture);
    addCore(uses, vt_mapOcclusion, material.occlusionTexture);
    addCore(uses, vt_mapEmissive, material.emissiveTexture);
    addExtra(uses, vt_mapTransmission, material, "KHR_materials_transmission", "transmissionTexture");
    addExtra(uses, vt_mapSpecular, material, "KHR_materials_specular", "specularTexture");
    addExtra(uses, vt_mapSpecularColor, material, "KHR_materials_specular", "specularColorTexture");
    addExtra(uses, vt_mapIridescence, material, "KHR_materials_iridescence", "iridescenceTexture");
    addExtra(uses, vt_mapIridescenceThickness, material, "KHR_materials_iridescence",
             "iridescenceThicknessTexture");
    return uses;
}

std::vector<int> texcoordSetsOf(const tinygltf::Material& material)
{
    std::vector<int> sets;
    for (const TextureUse& use : texturesOf(material)) {
        if (sets.size() < 2 && std::find(sets.begin(), sets.end(), use.texCoord) == sets.end()) {
            sets.push_back(use.texCoord);
        }
    }
    return sets;
}

/// The picture of a texture of the file.
static bool findPicture(Loader& loader, int texture, int* source)
{
    return loader.has("texture", texture, loader.model.textures.size()) &&
           findTextureSource(loader, texture, source) && loader.has("image", *source, loader.pictures.size());
}

/// For sentences.
static std::string nameOf(const Picture& picture, int source)
{
    const bool isFile = picture.name.empty() && picture.uri.compare(0, 5, "data:") != 0;
    return label(source, isFile ? picture.uri : picture.name);
}

bool checkMaps(Loader& loader, const tinygltf::Material& given)
{
    for (const TextureUse& use : texturesOf(given)) {
        int source;
        if (!findPicture(loader, use.texture, &source)) {
            return false;
        }
        Picture& picture = loader.pictures[(size_t)source];
        if (picture.isChecked) {
            continue;
        }
        picture.isChecked = true;
        uint64_t pixels = 0;
        vtError error = {};
        const std::string name = nameOf(picture, source);
        if (!openPicture(loader, source)) {
            return false;
        }
        if (!VT_WITH_FILES) { // a page's browser decodes the pictures, and has bounds of its own
            continue;
        }
        if (vtCheckPicture(picture.bytes.data, picture.bytes.size, name.c_str(), &loader.limits, 4, &pixels,
                           &error) != vt_ok) {
            return loader.fail(error.result, "%s", error.message);
        }
        if (!loader.spend(4 * pixels, "picture '" + name + "'")) {
            return false;
        }
    }
    return true;
}

/// Decodes the picture of a texture, unless it is there; *image is its number in the scene.
static bool openImage(Loader& loader, int texture, int* image)
{
    int source;
    if (!findPicture(loader, texture, &source)) {
        return false;
    }
    Picture& picture = loader.pictures[(size_t)source];
    if (picture.image < 0) {
        vtError error = {};
        const vtResult result =
            vtDecodeImage(picture.bytes.data, picture.bytes.size, nameOf(picture, source).c_str(),
                          &loader.scene->images[loader.scene->imageCount], &error);
        std::vector<uint8_t>().swap(picture.contents);
        if (result != vt_ok) {
            return loader.fail(result, "%s", error.message);
        }
        picture.image = (int)loader.scene->imageCount++;
    }
    *image = picture.image;
    return true;
}

static vtWrap wrapOf(int wrap)
{
    return wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? vt_wrapClamp
           : wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? vt_wrapMirror
                                                           : vt_wrapRepeat;
}

bool openMaps(Loader& loader, const tinygltf::Material& given, vtMaterial* material)
{
    const std::vector<int> sets = texcoordSetsOf(given);
    for (const TextureUse& use : texturesOf(given)) {
        vtMap* map = &material->maps[use.use];
        const auto set = std::find(sets.begin(), sets.end(), use.texCoord);
        if (set == sets.end()) {
            loader.noteIgnored("a picture by the third set of texture coordinates of a material");
            continue;
        }
        if (!openImage(loader, use.texture, &map->image)) {
            return false;
        }
        map->texcoords = (int)(set - sets.begin());
        for (size_t i = 0; i < 6; ++i) {
            map->rows[i / 3][i % 3] = use.rows[i / 3][i % 3];
        }
        const int sampler = loader.model.textures[(size_t)use.texture].sampler;
        if (sampler >= 0) {
            if (!loader.has("sampler", sampler, loader.model.samplers.size())) {
                return false;
            }
            const tinygltf::Sampler& how = loader.model.samplers[(size_t)sampler];
            map->wrapX = wrapOf(how.wrapS);
            map->wrapY = wrapOf(how.wrapT);
            map->nearest = how.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
        }
    }
    return true;
}

} // namespace vtGltf
