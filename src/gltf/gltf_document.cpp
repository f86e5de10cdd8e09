// From text to tinygltf's structs, and the buffers and pictures they refer to.

#include <fstream> // tinygltf still names std::ofstream with TINYGLTF_NO_FS
#include <sstream>
#include <string>
#include <vector>

namespace vtTinygltf::std
{
using namespace ::std;

/// What tinygltf writes its messages into: inside its namespace this std is the nearer one. The real
/// stringstream brings all of libc++'s locales, a seventh of the page's compressed wasm.
struct stringstream {
    string text;

    stringstream& operator<<(const string& words)
    {
        text += words;
        return *this;
    }
    stringstream& operator<<(const char* words)
    {
        text += words;
        return *this;
    }
    template <typename Number> stringstream& operator<<(Number number)
    {
        text += to_string(number);
        return *this;
    }
    string str() const
    {
        return text;
    }
};

constexpr char endl[] = "\n"; // the real one is a stream's
} // namespace vtTinygltf::std

#include "gltf/gltf_json.h"

// tinygltf is given a document instead of its text: where it would parse that, it takes the document (see
// parseStructs). And no JSON is written: what it keeps as text only where it is told to, it is not told to.
#define TINYGLTF_IMPLEMENTATION
#define parse(document, ...) value_type(::std::move(*(json*)document))
#define dump(...) type_name()
#include <tiny_gltf.h>
#undef parse
#undef dump

#include <cmath>
#include <cstdlib>
#include <cstring>

namespace vtGltf
{

static bool parseJson(Loader& loader, Bytes text, Json* document)
{
    while (text.size > 0 && text.data[text.size - 1] == 0) {
        --text.size; // some exporters pad with zeros instead of spaces
    }
    if (!checkStructure(loader, text)) {
        return false;
    }
    // As chars, as tinygltf parses them: another type would bring a second parser into the page's wasm.
    const char* begin = (const char*)text.data;
    *document = Json::parse(begin, begin + text.size, nullptr, false);
    if (!document->is_object()) {
        return loader.fail(vt_errorFormat, "its JSON is broken or cut off" GLTF_DAMAGED);
    }
    return true;
}

/// Fills loader.model from the tidied JSON, which is used up; buffers have been taken out of it.
static bool parseStructs(Loader& loader, Json& document)
{
    const unsigned int longEnough = 4; // for the text that it is not
    tinygltf::TinyGLTF parser;
    std::string message, warning;
    const bool parsed =
        parser.LoadASCIIFromString(&loader.model, &message, &warning, (const char*)&document, longEnough, "");
    // tinygltf drops a broken primitive, tells so, and goes on: half a model is not what was asked for.
    if (!parsed || !message.empty()) {
        return loader.fail(vt_errorFormat, "its JSON is not glTF (%s)" GLTF_DAMAGED,
                           message.empty() ? "unknown reason" : withoutStop(message).c_str());
    }
    if (loader.model.asset.version.compare(0, 2, "2.") != 0) {
        return loader.fail(vt_errorFormat,
                           "it is glTF version '%s' but only 2.0 is supported; export it as glTF 2.0",
                           quotable(loader.model.asset.version).c_str());
    }
    const std::string& least = loader.model.asset.minVersion;
    if (std::strtod(least.c_str(), nullptr) > 2.0) {
        return loader.fail(vt_errorFormat,
                           "it needs glTF %s but only 2.0 is supported; export it as glTF 2.0",
                           quotable(least).c_str());
    }
    return true;
}

/// What extensionsRequired or extensionsUsed has.
static std::vector<std::string> listTexts(const Json& document, const char* key)
{
    std::vector<std::string> texts;
    const auto list = document.find(key);
    for (size_t i = 0; list != document.end() && list->is_array() && i < list->size(); ++i) {
        if ((*list)[i].is_string()) {
            texts.push_back((*list)[i].get<std::string>());
        }
    }
    return texts;
}

/// Can this build draw what requires these? An extension may lie where nothing is read, so this comes first.
static bool checkRequired(Loader& loader)
{
    for (const std::string& extension : loader.required) {
        const vtGltfFeature* feature = vtFindGltfExtension(extension.c_str());
        if (feature != nullptr && feature->needs != nullptr) {
            return loader.fail(
                vt_errorFormat,
                "it requires the extension %s, which this build cannot read without %s; export it without",
                extension.c_str(), feature->needs);
        }
        if (feature == nullptr) {
            std::string known;
            for (int i = 0; (feature = vtGltfFeature_At(i)) != nullptr; ++i) {
                if (feature->isExtension && feature->needs == nullptr) {
                    known += (known.empty() ? "" : " ") + std::string(feature->name);
                }
            }
            return loader.fail(
                vt_errorFormat,
                "it requires the extension %s, which is not supported; export it without. Supported: %s",
                quotable(extension).c_str(), known.c_str());
        }
    }
    return true;
}

/// Elements of an array, or none.
static size_t countIn(const Json& in, const char* key)
{
    return in.is_object() && in.contains(key) && in[key].is_array() ? in[key].size() : 0;
}

/// The same of an extension of the whole file.
static size_t countIn(const Json& document, const char* extension, const char* key)
{
    const bool has = document.contains("extensions") && document["extensions"].is_object() &&
                     document["extensions"].contains(extension);
    return has ? countIn(document["extensions"][extension], key) : 0;
}

/// Notes what is dropped unseen.
static void countUnread(Loader& loader, const Json& document)
{
    loader.animationCount = countIn(document, "animations");
    loader.lightCount = countIn(document, "KHR_lights_punctual", "lights");
    for (size_t i = 0; i < countIn(document, "KHR_materials_variants", "variants"); ++i) {
        const Json& variant = document["extensions"]["KHR_materials_variants"]["variants"][i];
        const bool named = variant.is_object() && variant.contains("name") && variant["name"].is_string();
        loader.variants.push_back(named ? variant["name"].get<std::string>() : "");
    }
}

static bool loadBuffer(Loader& loader, const Json& entry, size_t index, Bytes bin)
{
    const auto length = entry.find("byteLength"), uri = entry.find("uri");
    if (length == entry.end()) {
        return loader.fail(vt_errorFormat, "buffer %zu has no byteLength" GLTF_DAMAGED, index);
    }
    const size_t needed = length->get<size_t>();
    std::string name = "buffer " + std::to_string(index);
    Bytes bytes = index == 0 ? bin : Bytes(); // a buffer without data: an error only if something reads it
    if (uri != entry.end()) {
        if (!uri->is_string()) {
            return loader.fail(vt_errorFormat, "the uri of buffer %zu is not a text" GLTF_DAMAGED, index);
        }
        const std::string address = uri->get<std::string>();
        std::vector<uint8_t> contents;
        if (address.compare(0, 5, "data:") != 0) {
            name += " ('" + quotable(address) + "')";
            if (!readExternal(loader, "buffer", address, &contents)) {
                return false;
            }
        } else if (!decodeDataUri(address, &contents)) {
            return loader.fail(vt_errorFormat,
                               "the data URI of buffer %zu cannot be decoded; export it as .glb", index);
        }
        bytes = {contents.data(), contents.size()};
        loader.ownedBuffers.push_back(std::move(contents)); // which leaves the bytes where they are
    }
    if (bytes.data != nullptr && bytes.size < needed) {
        return loader.fail(vt_errorFormat, "%s should have %zu bytes but has %zu" GLTF_DAMAGED, name.c_str(),
                           needed, bytes.size);
    }
    loader.buffers.push_back({bytes.data, bytes.data != nullptr ? needed : 0});
    return true;
}

/// Notes where the pictures are. What is wrong with one matters only if a material uses it.
static void listPictures(Loader& loader, const Json& images)
{
    for (const Json& image : images) {
        Picture picture;
        const auto name = image.find("name"), uri = image.find("uri"), view = image.find("bufferView"),
                   end = image.end();
        picture.name = name != end && name->is_string() ? name->get<std::string>() : "";
        picture.uri = uri != end && uri->is_string() ? uri->get<std::string>() : "";
        picture.bufferView = view != end ? view->get<int>() : -1;
        loader.pictures.push_back(std::move(picture));
    }
}

/// tinygltf asks for matrices that a skin need not have.
static void listSkins(Loader& loader, const Json& skins)
{
    for (const Json& entry : skins) {
        Skin skin;
        const auto joints = entry.find("joints"), inverse = entry.find("inverseBindMatrices");
        for (size_t i = 0; joints != entry.end() && i < joints->size(); ++i) {
            skin.joints.push_back((*joints)[i].get<int>());
        }
        skin.inverseBindMatrices = inverse != entry.end() ? inverse->get<int>() : -1;
        loader.skins.push_back(std::move(skin));
    }
}

/// What is packed of a buffer view, or nothing.
static Compressed readCompressed(const Json& view)
{
    Compressed packed;
    const auto extensions = view.find("extensions");
    if (extensions == view.end() || extensions->empty()) {
        return packed;
    }
    packed.extension = extensions->begin().key();
#if VT_WITH_FILES
    const Json& about = *extensions->begin();
    const auto number = [&](const char* key) { return about.contains(key) ? about[key].get<size_t>() : 0; };
    const auto text = [&](const char* key) {
        return about.contains(key) && about[key].is_string() ? about[key].get<std::string>() : "";
    };
    packed.buffer = (int)number("buffer");
    packed.byteOffset = number("byteOffset");
    packed.byteLength = number("byteLength");
    packed.byteStride = number("byteStride");
    packed.count = number("count");
    packed.mode = text("mode");
    packed.filter = text("filter");
#endif
    return packed;
}

/// tinygltf wants a buffer view for indices, which they need not have: they become the attribute "".
static void moveIndices(Json& document)
{
    if (!document.contains("meshes")) {
        return;
    }
    for (Json& mesh : document["meshes"]) {
        for (size_t i = 0; mesh.contains("primitives") && i < mesh["primitives"].size(); ++i) {
            Json& primitive = mesh["primitives"][i];
            if (primitive.contains("indices") && primitive.contains("attributes")) {
                primitive["attributes"][""] = primitive["indices"];
                primitive.erase("indices");
            }
        }
    }
}

bool parseDocument(Loader& loader, Bytes text, Bytes bin)
{
    Json document;
    if (!parseJson(loader, text, &document)) {
        return false;
    }
    loader.used = listTexts(document, "extensionsUsed");
    loader.required = listTexts(document, "extensionsRequired");
    if (!checkRequired(loader)) {
        return false;
    }
    countUnread(loader, document);
    if (!loader.keeps) {
        document.erase("animations"); // they are not played
    }
    if (!tidyDocument(loader, document)) {
        return false;
    }
    // Read below, so that tinygltf meets no file and no data. Null where there are none.
    const Json buffers = std::move(document["buffers"]);
    const Json images = std::move(document["images"]);
    const Json skins = std::move(document["skins"]);
    const Json animations = std::move(document["animations"]);
    for (const char* key : {"buffers", "images", "skins", "animations"}) {
        document.erase(key);
    }
    if (document.contains("bufferViews")) {
        for (Json& view : document["bufferViews"]) {
            loader.compressed.push_back(readCompressed(view));
            view.erase("extensions");
        }
    }
    moveIndices(document);
    if (!parseStructs(loader, document)) {
        return false;
    }
    for (size_t i = 0; i < buffers.size(); ++i) {
        if (!loadBuffer(loader, buffers[i], i, bin)) {
            return false;
        }
    }
    listPictures(loader, images);
    listSkins(loader, skins);
    return readAnimations(loader, animations);
}

} // namespace vtGltf
