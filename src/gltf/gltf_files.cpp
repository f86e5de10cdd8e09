// What a model has in files of its own, or in data URIs: buffers and pictures. Nothing is asked for that
// lies, by its name, outside the model's folder or vtModelDef.root; where links lead is for vtReadFileFcn to
// look at.

#include "gltf/gltf.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace vtGltf
{

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

static bool failAlone(Loader& loader, const char* what, const std::string& name)
{
    return loader.fail(vt_errorFile,
                       "its %s '%s' is a file of its own, which cannot be read here; export it as one .glb",
                       what, quotable(name).c_str());
}

#if VT_WITH_FILES
/// Without "." and "..", as far as those can be taken out, and with a slash at the end of each part:
/// "a/../../b" is
/// "../b/".
static std::string normalise(const std::string& path)
{
    std::vector<std::string> parts;
    const bool isAbsolute = !path.empty() && path[0] == '/';
    for (size_t at = 0; at < path.size();) {
        const size_t end = std::min(path.find('/', at), path.size());
        const std::string part = path.substr(at, end - at);
        if (part == ".." && !parts.empty() && parts.back() != "..") {
            parts.pop_back();
        } else if (!part.empty() && part != "." && !(part == ".." && isAbsolute)) {
            parts.push_back(part);
        }
        at = end + 1;
    }
    std::string normal = isAbsolute ? "/" : "";
    for (const std::string& part : parts) {
        normal += part + "/";
    }
    return normal;
}

/// May the path, which is below the folder or absolute, be read?
static bool isAllowed(const vtModelDef& def, const std::string& directory, const std::string& path)
{
    const auto holds = [&](const std::string& folder) {
        const std::string inside = normalise(path), outside = normalise(folder);
        return inside.compare(0, outside.size(), outside) == 0 && inside.compare(0, 3, "../") != 0 &&
               (outside.empty() ? inside[0] != '/' : inside.size() > outside.size());
    };
    return holds(directory) || (def.root != nullptr && holds(def.root));
}

/// Has it a scheme, as "https:"?
static bool isAddress(const std::string& uri)
{
    size_t i = 0;
    while (i < uri.size() &&
           (isalnum((unsigned char)uri[i]) || uri[i] == '+' || uri[i] == '-' || uri[i] == '.')) {
        ++i;
    }
    return i > 0 && i < uri.size() && uri[i] == ':';
}

bool readExternal(Loader& loader, const char* what, const std::string& uri, std::vector<uint8_t>* bytes)
{
    const vtModelDef& def = *loader.def;
    const std::string name = decodePercents(uri);
    const std::string shown = quotable(name);
    if (isAddress(uri) || name.empty() || name.find('\0') != std::string::npos) {
        return loader.fail(vt_errorFile, "its %s '%s' is no file beside it; put one there and name that",
                           what, shown.c_str());
    }
    if (def.readFile == nullptr) {
        return failAlone(loader, what, shown);
    }
    const std::string directory = def.directory != nullptr ? def.directory : "";
    const bool isAbsolute = name[0] == '/' || name[0] == '\\';
    const std::string path =
        isAbsolute ? name : directory + (directory.empty() || directory.back() == '/' ? "" : "/") + name;
    if (!isAllowed(def, directory, path)) {
        return loader.fail(
            vt_errorFile,
            "its %s '%s' lies outside the model's folder; name a folder that holds both with --root "
            "(vtModelDef.root)",
            what, shown.c_str());
    }
    uint8_t* contents = nullptr;
    size_t size = 0;
    vtError error = {};
    const vtResult result =
        def.readFile(path.c_str(), (size_t)std::min<uint64_t>(loader.left.memory, SIZE_MAX), &contents, &size,
                     def.userData, &error);
    const Block<uint8_t> owned(contents);
    if (result != vt_ok) {
        const std::string why = error.message[0] != '\0' ? std::string(" (") + error.message + ")" : "";
        return loader.fail(result, "its %s '%s' cannot be read%s; %s", what, shown.c_str(), why.c_str(),
                           result == vt_errorMemory ? "allow it more memory with --max-memory (vtLimits)"
                                                    : "put that file beside the model");
    }
    if (!loader.spend(size, std::string("its ") + what + " '" + shown + "'")) {
        return false;
    }
    if (size > 0) {
        bytes->assign(contents, contents + size);
    }
    return true;
}
#else
bool readExternal(Loader& loader, const char* what, const std::string& uri, std::vector<uint8_t>*)
{
    return failAlone(loader, what, decodePercents(uri));
}
#endif

/// 0 to 63, or 64 of what is no digit of base 64.
static uint32_t digit(char c)
{
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/-_";
    for (uint32_t i = 0; digits[i] != '\0'; ++i) {
        if (digits[i] == c) {
            return i < 64 ? i : i - 2; // the last two: of addresses
        }
    }
    return 64;
}

bool decodeDataUri(const std::string& uri, std::vector<uint8_t>* bytes)
{
    const size_t comma = uri.find(',');
    if (comma == std::string::npos) {
        return false;
    }
    const std::string ending = ";base64", head = uri.substr(0, comma);
    const std::string text = decodePercents(uri.substr(comma + 1));
    if (head.size() < ending.size() ||
        head.compare(head.size() - ending.size(), ending.size(), ending) != 0) {
        bytes->assign(text.begin(), text.end());
        return true;
    }
    uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const uint32_t value = digit(c);
        if (c == '=' || isspace((unsigned char)c)) {
            continue;
        }
        if (value == 64) {
            return false;
        }
        bits = bits << 6 | value;
        if ((count += 6) >= 8) {
            count -= 8;
            bytes->push_back((uint8_t)(bits >> count));
        }
    }
    return true;
}

bool openPicture(Loader& loader, int index)
{
    Picture& picture = loader.pictures[(size_t)index];
    const std::string name = "image " + label(index, picture.name);
    if (picture.uri.empty()) {
        return picture.bufferView >= 0
                   ? openView(loader, name, picture.bufferView, wholeView, &picture.bytes)
                   : loader.fail(vt_errorFormat, "%s has neither a uri nor a buffer view" GLTF_DAMAGED,
                                 name.c_str());
    }
    if (picture.uri.compare(0, 5, "data:") != 0) {
        if (!readExternal(loader, "picture", picture.uri, &picture.contents)) {
            return false;
        }
    } else if (!decodeDataUri(picture.uri, &picture.contents)) {
        return loader.fail(vt_errorFormat, "the data URI of %s cannot be decoded; export it as .glb",
                           name.c_str());
    }
    picture.bytes = {picture.contents.data(), picture.contents.size()};
    return true;
}

bool findTextureSource(Loader& loader, int index, int* source)
{
    const tinygltf::Texture& texture = loader.model.textures[(size_t)index];
    std::string unread;
    for (const char* name : {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu"}) {
        const auto at = texture.extensions.find(name);
        if (at == texture.extensions.end() || !at->second.Has("source")) {
            continue;
        }
        if (vtFindGltfExtension(name)->support == vt_gltfDrawn) {
            *source = at->second.Get("source").GetNumberAsInt();
            return true;
        }
        unread += (unread.empty() ? " but one of " : " and one of ") + std::string(name);
    }
    *source = texture.source;
    return texture.source >= 0 ||
           loader.fail(
               vt_errorFormat,
               "texture %d has no PNG, JPEG or WebP picture%s; export it with pictures of these formats",
               index, unread.c_str());
}

} // namespace vtGltf
