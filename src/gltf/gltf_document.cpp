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

#ifdef __cpp_exceptions
namespace vtNlohmann::std
{
using namespace ::std;

template <typename Json> bool hasChildren(const Json& value)
{
    return value.is_structured() && !value.empty();
}

template <typename Json> void eraseLast(Json& value)
{
    auto last = value.end();
    value.erase(--last);
}

/// Destroys all below a value without a call to itself and without memory: it goes down by the last child, in
/// whose place it keeps what it came from.
template <typename Json> void dissolve(Json& value)
{
    Json above, here = ::std::move(value);
    while (hasChildren(here) || !above.is_null()) {
        if (!hasChildren(here)) {
            here = ::std::move(above);
            above = ::std::move(here.back());
            eraseLast(here);
        } else if (hasChildren(here.back())) {
            Json below = ::std::move(here.back());
            here.back() = ::std::move(above);
            above = ::std::move(here);
            here = ::std::move(below);
        } else {
            eraseLast(here);
        }
    }
}

/// What a JSON value's destructor, which must not fail, moves its children into, so that it need not call
/// itself. Where memory is out they are dissolved.
template <typename T> struct Yielding : ::std::vector<T> {
    void reserve(size_t)
    {
    }
    void push_back(T&& value)
    {
        try {
            ::std::vector<T>::push_back(::std::move(value));
        } catch (const bad_alloc&) {
            dissolve(value);
        }
    }
};

/// nlohmann's vectors: only that one is of values of a class and names no allocator.
template <typename T, typename... Allocator> struct VectorOf {
    using type = ::std::vector<T, Allocator...>;
};
template <typename T> struct VectorOf<T> {
    static constexpr bool yields = is_class_v<T> && !is_same_v<T, string>;
    using type = conditional_t<yields, Yielding<T>, ::std::vector<T>>;
};
template <typename T, typename... Allocator> using vector = typename VectorOf<T, Allocator...>::type;
} // namespace vtNlohmann::std
#endif

#define TINYGLTF_IMPLEMENTATION
#include "gltf/gltf.h"

#include <cmath>
#include <cstdlib>

namespace vtGltf
{

using Json = nlohmann::json;

static const int maxJsonDepth = 32; // a glTF file needs about 8; tinygltf recurses

static bool isOneOf(const std::string& word, std::initializer_list<const char*> words)
{
    for (const char* candidate : words) {
        if (word == candidate) {
            return true;
        }
    }
    return false;
}

static bool isWanted(const std::string& key, int depth)
{
    return depth == 0 ? isOneOf(key, {"asset", "buffers", "bufferViews", "accessors", "meshes", "nodes",
                                      "scenes", "scene", "materials", "textures", "images", "cameras",
                                      "extensionsUsed", "extensionsRequired"})
                      : !isOneOf(key, {"extras", "min", "max", "targets", "weights"});
}

static bool isAttribute(const std::string& key)
{
    return isOneOf(key, {"POSITION", "NORMAL"}) || key.compare(0, 9, "TEXCOORD_") == 0 ||
           key.compare(0, 6, "COLOR_") == 0;
}

/// Indices and offsets must fit an int. 12.0 is as good as 12 in JSON, but tinygltf would ignore it; and it
/// would wrap other large whole numbers round.
static bool tidyValue(Loader& loader, const std::string& key, Json& value)
{
    if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number == std::floor(number) && std::fabs(number) <= INT32_MAX) {
            value = number < 0 ? Json((int64_t)number) : Json((uint64_t)number);
        }
    } else if (value.is_number() && std::fabs(value.get<double>()) > INT32_MAX) {
        value = value.get<double>();
    }
    if ((isAttribute(key) || isOneOf(key, {"bufferView", "buffer", "byteOffset", "byteLength", "byteStride",
                                           "componentType", "count", "mesh", "material", "mode", "indices",
                                           "scene", "camera", "index", "texCoord", "source"})) &&
        !(value.is_number_unsigned() && value.get<uint64_t>() <= INT32_MAX)) {
        return loader.fail(vt_errorFormat,
                           "its JSON has a '%s' that is not a whole number from 0 to %d" GLTF_DAMAGED,
                           key.c_str(), INT32_MAX);
    }
    return true;
}

/// Drops what the loader does not need of an object or array; refuses what tinygltf would misread.
static bool tidy(Loader& loader, Json& parent, int depth)
{
    if (depth > maxJsonDepth) {
        return loader.fail(vt_errorFormat, "its JSON is nested deeper than %d levels" GLTF_DAMAGED,
                           maxJsonDepth);
    }
    for (auto at = parent.begin(); at != parent.end();) {
        const std::string key = parent.is_object() ? at.key() : "";
        if (parent.is_object() && !isWanted(key, depth)) {
            at = parent.erase(at);
            continue;
        }
        if (!(at->is_structured() ? tidy(loader, *at, depth + 1) : tidyValue(loader, key, *at))) {
            return false;
        }
        ++at;
    }
    return true;
}

static bool parseJson(Loader& loader, Bytes text, Json* document)
{
    while (text.size > 0 && text.data[text.size - 1] == 0) {
        --text.size; // some exporters pad with zeros instead of spaces
    }
    // As chars, as tinygltf parses them: another type would bring a second parser into the page's wasm.
    const char* begin = (const char*)text.data;
    *document = Json::parse(begin, begin + text.size, nullptr, false);
    if (!document->is_object()) {
        return loader.fail(vt_errorFormat, "its JSON is broken or cut off" GLTF_DAMAGED);
    }
    return tidy(loader, *document, 0);
}

/// Fills loader.model from the tidied JSON; buffers have been taken out of it.
static bool parseStructs(Loader& loader, const Json& document)
{
    const std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
    tinygltf::TinyGLTF parser;
    std::string message, warning;
    const bool parsed = parser.LoadASCIIFromString(&loader.model, &message, &warning, text.data(),
                                                   (unsigned int)text.size(), "");
    // tinygltf drops a broken primitive, tells so, and goes on: half a model is not what was asked for.
    if (!parsed || !message.empty()) {
        return loader.fail(vt_errorFormat, "its JSON is not glTF (%s)" GLTF_DAMAGED,
                           message.empty() ? "unknown reason" : quotable(message).c_str());
    }
    if (loader.model.asset.version.compare(0, 2, "2.") != 0) {
        return loader.fail(vt_errorFormat,
                           "it is glTF version '%s' but only 2.0 is supported; export it as glTF 2.0",
                           quotable(loader.model.asset.version).c_str());
    }
    for (const std::string& extension : loader.model.extensionsRequired) {
        // Looks, of which what is known is drawn; all else may change where the triangles are.
        const bool harmless = extension.rfind("KHR_materials_", 0) == 0 ||
                              extension.rfind("KHR_texture_", 0) == 0 ||
                              extension.rfind("EXT_texture_", 0) == 0 || extension == "KHR_lights_punctual";
        if (!harmless) {
            return loader.fail(vt_errorFormat,
                               "it requires the extension %s, which is not supported; export it without",
                               quotable(extension).c_str());
        }
    }
    return true;
}

static std::string decodePercents(const std::string& uri)
{
    std::string path;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && isxdigit((unsigned char)uri[i + 1]) &&
            isxdigit((unsigned char)uri[i + 2])) {
            path += (char)strtol(uri.substr(i + 1, 2).c_str(), nullptr, 16);
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

/// `what` is a buffer or a picture.
static bool readExternal(Loader& loader, const char* what, const std::string& uri,
                         std::vector<uint8_t>* bytes)
{
    const vtModelDef& def = *loader.def;
    std::string path = decodePercents(uri);
    if (def.readFile == nullptr) {
        return loader.fail(
            vt_errorFile,
            "its %s '%s' is a file of its own, which cannot be read here; export it as one .glb", what,
            quotable(path).c_str());
    }
    const std::string directory = def.directory != nullptr ? def.directory : "";
    path = directory + (directory.empty() || directory.back() == '/' ? "" : "/") + path;
    uint8_t* contents = nullptr;
    size_t size = 0;
    if (!def.readFile(path.c_str(), &contents, &size, def.userData)) {
        return loader.fail(vt_errorFile, "its %s '%s' cannot be read; put that file beside the model", what,
                           quotable(path).c_str());
    }
    const Block<uint8_t> owned(contents);
    if (size > 0) {
        bytes->assign(contents, contents + size);
    }
    return true;
}

static bool loadBuffer(Loader& loader, const Json& entry, size_t index, Bytes bin)
{
    const auto length = entry.find("byteLength"), uri = entry.find("uri");
    if (!entry.is_object() || length == entry.end() || !length->is_number_unsigned()) {
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
        std::string mimeType;
        if (address.compare(0, 5, "data:") != 0) {
            name += " ('" + quotable(address) + "')";
            if (!readExternal(loader, "buffer", address, &contents)) {
                return false;
            }
        } else if (needed > 0 && !tinygltf::DecodeDataURI(&contents, mimeType, address, 0, false)) {
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
    for (size_t i = 0; images.is_array() && i < images.size(); ++i) {
        Picture picture;
        if (images[i].is_object()) {
            const auto name = images[i].find("name"), uri = images[i].find("uri"),
                       view = images[i].find("bufferView"), end = images[i].end();
            picture.name = name != end && name->is_string() ? name->get<std::string>() : "";
            picture.uri = uri != end && uri->is_string() ? uri->get<std::string>() : "";
            picture.bufferView = view != end && view->is_number_unsigned() ? view->get<int>() : -1;
        }
        loader.pictures.push_back(std::move(picture));
    }
}

bool openPicture(Loader& loader, int index, std::vector<uint8_t>* contents, Bytes* bytes)
{
    const Picture& picture = loader.pictures[(size_t)index];
    const std::string name = "image " + label(index, picture.name);
    std::string mimeType;
    if (picture.uri.empty()) {
        return picture.bufferView >= 0
                   ? openView(loader, name, picture.bufferView, wholeView, bytes)
                   : loader.fail(vt_errorFormat, "%s has neither a uri nor a buffer view" GLTF_DAMAGED,
                                 name.c_str());
    }
    if (picture.uri.compare(0, 5, "data:") != 0) {
        if (!readExternal(loader, "picture", picture.uri, contents)) {
            return false;
        }
    } else if (!tinygltf::DecodeDataURI(contents, mimeType, picture.uri, 0, false)) {
        return loader.fail(vt_errorFormat, "the data URI of %s cannot be decoded; export it as .glb",
                           name.c_str());
    }
    *bytes = {contents->data(), contents->size()};
    return true;
}

bool parseDocument(Loader& loader, Bytes text, Bytes bin)
{
    Json document;
    if (!parseJson(loader, text, &document)) {
        return false;
    }
    // Loaded below, so that tinygltf meets no file and no data. Null where there are none.
    const Json buffers = std::move(document["buffers"]);
    const Json images = std::move(document["images"]);
    document.erase("buffers");
    document.erase("images");
    if (!parseStructs(loader, document)) {
        return false;
    }
    for (size_t i = 0; buffers.is_array() && i < buffers.size(); ++i) {
        if (!loadBuffer(loader, buffers[i], i, bin)) {
            return false;
        }
    }
    listPictures(loader, images);
    return true;
}

} // namespace vtGltf
