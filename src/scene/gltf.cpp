// glTF 2.0 to one mesh, through tinygltf.
//
// tinygltf 2.7 turns JSON into structs but trusts the file in places (a GLB's BIN chunk is read 8 bytes too
// far, an embedded picture is taken from wherever its offset points, an empty buffer aborts without
// exceptions, an index above 2^32 wraps round, deep nesting overflows the stack). So it is given only what
// this file has looked through: the container is split here, the JSON filtered, buffers are loaded here, and
// nothing it returns is used as an index or an offset before it was checked.

#include "vitrine.h"

extern "C" {
#include "base/error.h"
}

#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NOEXCEPTION
#define JSON_NOEXCEPTION
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <fstream> // tinygltf still names std::ofstream with TINYGLTF_NO_FS
#include <tiny_gltf.h>

#include <cassert>
#include <cfloat>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace
{

using Json = nlohmann::json;

const int maxJsonDepth = 32;   // a glTF file needs about 8; tinygltf recurses
const int maxNodeDepth = 1000; // far beyond any skeleton
const size_t glbHeaderSize = 12, chunkHeaderSize = 8;
const uint32_t chunkJson = 0x4E4F534A, chunkBin = 0x004E4942;

struct Bytes {
    const uint8_t* data = nullptr;
    size_t size = 0;
};

/// An accessor whose every element is known to lie inside its buffer.
struct Stream {
    const uint8_t* data = nullptr;
    size_t count = 0, stride = 0;
    int componentType = 0;
};

/// Column-major 4 x 4, as glTF has it.
struct Matrix {
    double m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

/// A checked primitive where a node puts it.
struct Part {
    Stream positions, normals, indices; // a stream without data: the primitive has none
    int mode = TINYGLTF_MODE_TRIANGLES;
    Matrix toWorld;
    size_t triangleCount = 0;
};

struct Reader {
    const vtModelDef* def;
    vtError* error;
    tinygltf::Model model = {};
    std::vector<Bytes> buffers = {};
    std::vector<std::vector<uint8_t>> ownedBuffers = {};
    std::vector<Part> parts = {};
    double ior = 0.0;

    vtResult fail(vtResult result, const char* format, ...) VT_PRINTF(3, 4);
    vtResult damaged(const char* format, ...) VT_PRINTF(2, 3);
    vtResult failWith(vtResult result, const char* remedy, const char* format, va_list arguments);
};

vtResult Reader::failWith(vtResult result, const char* remedy, const char* format, va_list arguments)
{
    char reason[400];
    vsnprintf(reason, sizeof reason, format, arguments);
    const char* name = def->name != nullptr ? def->name : "";
    return vtFail(error, result, "model '%.200s': %s%s", name, reason, remedy);
}

/// A sentence of its own.
vtResult Reader::fail(vtResult result, const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    failWith(result, "", format, arguments);
    va_end(arguments);
    return result;
}

/// For what only whoever made the file can mend.
vtResult Reader::damaged(const char* format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    failWith(vt_errorFormat, "; the file is damaged, export it again", format, arguments);
    va_end(arguments);
    return vt_errorFormat;
}

/// Is `index` one of `count`?
vtResult checkIndex(Reader& reader, const char* what, int index, size_t count)
{
    if (index < 0 || (size_t)index >= count) {
        return reader.damaged("it refers to %s %d but has %zu of them", what, index, count);
    }
    return vt_ok;
}

/// Text out of a file, fit for a sentence: one line, not long.
std::string quotable(std::string text)
{
    for (char& c : text) {
        c = (unsigned char)c < 32 ? ' ' : c;
    }
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) {
        text.pop_back();
    }
    return text.size() > 120 ? text.substr(0, 117) + "..." : text;
}

// --------------------------------------------------------------------------------------------- container

uint32_t readU32(const uint8_t* p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

/// Splits a .glb into its JSON and BIN chunks; BIN may be absent.
vtResult splitGlb(Reader& reader, Bytes file, Bytes* text, Bytes* bin)
{
    if (file.size < glbHeaderSize) {
        return reader.fail(vt_errorFormat,
                           "a .glb of %zu bytes ends within its header; it is truncated, copy it again",
                           file.size);
    }
    const uint32_t version = readU32(file.data + 4), length = readU32(file.data + 8);
    if (version != 2) {
        return reader.fail(vt_errorFormat,
                           "the .glb has version %u but only 2 is supported; export it as glTF 2.0", version);
    }
    if (length > file.size) {
        return reader.fail(vt_errorFormat,
                           "the .glb should have %u bytes but has %zu; it is truncated, copy it again",
                           length, file.size);
    }
    size_t at = glbHeaderSize;
    while (at < length) {
        if (length - at < chunkHeaderSize || readU32(file.data + at) > length - at - chunkHeaderSize) {
            return reader.damaged("the chunk at byte %zu reaches beyond the end of the .glb", at);
        }
        const Bytes chunk = {file.data + at + chunkHeaderSize, readU32(file.data + at)};
        const uint32_t type = readU32(file.data + at + 4);
        if (at == glbHeaderSize && type == chunkJson) {
            *text = chunk;
        } else if (at > glbHeaderSize && type == chunkBin && bin->data == nullptr) {
            *bin = chunk;
        } // other chunks are for others, says the standard
        at += chunkHeaderSize + chunk.size;
    }
    if (text->data == nullptr) {
        return reader.damaged("the .glb does not begin with a JSON chunk");
    }
    return vt_ok;
}

vtResult splitFile(Reader& reader, Bytes* text, Bytes* bin)
{
    const Bytes file = {(const uint8_t*)reader.def->bytes, reader.def->size};
    if (file.size == 0) {
        return reader.fail(vt_errorFormat, "the file is empty; give a .glb or .gltf file");
    }
    if (file.size >= 4 && memcmp(file.data, "glTF", 4) == 0) {
        return splitGlb(reader, file, text, bin);
    }
    size_t first = file.size >= 3 && memcmp(file.data, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0; // byte order mark
    while (first < file.size && strchr(" \t\r\n", file.data[first]) != nullptr && file.data[first] != 0) {
        ++first;
    }
    if (first == file.size || file.data[first] != '{') {
        return reader.fail(
            vt_errorFormat,
            "the file is not glTF (it begins neither with 'glTF' nor with '{'); give a .glb or .gltf file");
    }
    *text = file;
    return vt_ok;
}

// -------------------------------------------------------------------------------------------------- JSON

bool isOneOf(const std::string& word, std::initializer_list<const char*> words)
{
    for (const char* candidate : words) {
        if (word == candidate) {
            return true;
        }
    }
    return false;
}

/// Keeps what the loader needs of the JSON while it is parsed, and notes what tinygltf would misread.
struct JsonFilter {
    std::string key = {};       // of the value that comes next, if it is a plain one
    std::string malformed = {}; // the first key whose number is not one
    bool skipping = false, tooDeep = false;
    int skippedDepth = 0;

    bool operator()(int depth, Json::parse_event_t event, Json& parsed);
};

bool JsonFilter::operator()(int depth, Json::parse_event_t event, Json& parsed)
{
    if (event == Json::parse_event_t::key) {
        if (skipping && depth > skippedDepth) {
            return false;
        }
        key = parsed.get<std::string>();
        const bool wanted =
            depth == 1
                ? isOneOf(key, {"asset", "buffers", "bufferViews", "accessors", "meshes", "nodes", "scenes",
                                "scene", "materials", "extensionsUsed", "extensionsRequired"})
                : !isOneOf(key, {"extras", "min", "max", "targets", "weights"});
        skipping = !wanted;
        skippedDepth = depth;
        return wanted;
    }
    if (skipping && depth >= skippedDepth) {
        return true; // goes with its key
    }
    if (event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start) {
        tooDeep = tooDeep || depth > maxJsonDepth;
        key.clear();
        return !tooDeep;
    }
    if (event == Json::parse_event_t::value && parsed.is_number()) {
        // 12.0 is as good as 12 in JSON, but tinygltf would ignore it. Indices and offsets must fit an int.
        const double number = parsed.get<double>();
        if (parsed.is_number_float() && number == std::floor(number) && std::fabs(number) <= INT32_MAX) {
            parsed = number < 0 ? Json((int64_t)number) : Json((uint64_t)number);
        }
    }
    if (event == Json::parse_event_t::value && malformed.empty() &&
        isOneOf(key, {"bufferView", "buffer", "byteOffset", "byteLength", "byteStride", "componentType",
                      "count", "mesh", "material", "mode", "indices", "scene", "POSITION", "NORMAL"}) &&
        !(parsed.is_number_unsigned() && parsed.get<uint64_t>() <= INT32_MAX)) {
        malformed = key;
    }
    return true;
}

vtResult parseJson(Reader& reader, Bytes text, Json* document)
{
    while (text.size > 0 && text.data[text.size - 1] == 0) {
        --text.size; // some exporters pad with zeros instead of spaces
    }
    JsonFilter filter;
    *document = Json::parse(text.data, text.data + text.size, std::ref(filter), false);
    if (filter.tooDeep) {
        return reader.damaged("its JSON is nested deeper than %d levels", maxJsonDepth);
    }
    if (!document->is_object()) {
        return reader.damaged("its JSON is broken or cut off");
    }
    if (!filter.malformed.empty()) {
        return reader.damaged("its JSON has a '%s' that is not a whole number from 0 to %d",
                              filter.malformed.c_str(), INT32_MAX);
    }
    return vt_ok;
}

/// Fills reader.model from the filtered JSON; buffers have been taken out of it.
vtResult parseStructs(Reader& reader, const Json& document)
{
    const std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
    tinygltf::TinyGLTF parser;
    std::string message, warning;
    const bool parsed = parser.LoadASCIIFromString(&reader.model, &message, &warning, text.data(),
                                                   (unsigned int)text.size(), "");
    // tinygltf drops a broken primitive, tells so, and goes on: half a model is not what was asked for.
    if (!parsed || !message.empty()) {
        return reader.damaged("its JSON is not glTF (%s)",
                              message.empty() ? "unknown reason" : quotable(message).c_str());
    }
    if (reader.model.asset.version.compare(0, 2, "2.") != 0) {
        return reader.fail(vt_errorFormat,
                           "it is glTF version '%s' but only 2.0 is supported; export it as glTF 2.0",
                           quotable(reader.model.asset.version).c_str());
    }
    for (const std::string& extension : reader.model.extensionsRequired) {
        // Looks that the glass replaces anyway; all else may change where the triangles are.
        const bool harmless = extension.rfind("KHR_materials_", 0) == 0 ||
                              extension.rfind("KHR_texture_", 0) == 0 ||
                              extension.rfind("EXT_texture_", 0) == 0 || extension == "KHR_lights_punctual";
        if (!harmless) {
            return reader.fail(vt_errorFormat,
                               "it requires the extension %s, which is not supported; export it without",
                               quotable(extension).c_str());
        }
    }
    return vt_ok;
}

// ----------------------------------------------------------------------------------------------- buffers

std::string decodePercents(const std::string& uri)
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

vtResult readExternal(Reader& reader, const std::string& uri, std::vector<uint8_t>* bytes)
{
    const std::string file = decodePercents(uri);
    if (reader.def->readFile == nullptr) {
        return reader.fail(
            vt_errorFile,
            "its buffer '%s' is a file of its own, which cannot be read here; export it as one .glb",
            quotable(file).c_str());
    }
    const std::string directory = reader.def->directory != nullptr ? reader.def->directory : "";
    const std::string path =
        directory.empty() || directory.back() == '/' ? directory + file : directory + "/" + file;
    uint8_t* contents = nullptr;
    size_t size = 0;
    if (!reader.def->readFile(path.c_str(), &contents, &size, reader.def->userData)) {
        return reader.fail(vt_errorFile, "its buffer '%s' cannot be read; put that file beside the model",
                           quotable(path).c_str());
    }
    if (size > 0) {
        bytes->assign(contents, contents + size);
    }
    free(contents);
    return vt_ok;
}

vtResult loadBuffer(Reader& reader, const Json& entry, size_t index, Bytes bin)
{
    const auto length = entry.find("byteLength"), uri = entry.find("uri");
    if (!entry.is_object() || length == entry.end() || !length->is_number_unsigned()) {
        return reader.damaged("buffer %zu has no byteLength", index);
    }
    const size_t needed = length->get<size_t>();
    Bytes bytes;
    std::string name = "buffer " + std::to_string(index);
    if (uri == entry.end()) {
        if (index == 0) {
            bytes = bin;
        } // elsewhere a buffer without data: an error only if something reads it
    } else if (!uri->is_string()) {
        return reader.damaged("the uri of buffer %zu is not a text", index);
    } else {
        const std::string address = uri->get<std::string>();
        std::vector<uint8_t> contents;
        std::string mimeType;
        if (address.compare(0, 5, "data:") != 0) {
            name += " ('" + quotable(address) + "')";
            const vtResult result = readExternal(reader, address, &contents);
            if (result != vt_ok) {
                return result;
            }
        } else if (needed > 0 && !tinygltf::DecodeDataURI(&contents, mimeType, address, 0, false)) {
            return reader.fail(vt_errorFormat,
                               "the data URI of buffer %zu cannot be decoded; export it as .glb", index);
        }
        reader.ownedBuffers.push_back(std::move(contents));
        bytes = {reader.ownedBuffers.back().data(), reader.ownedBuffers.back().size()};
    }
    if (bytes.data != nullptr && bytes.size < needed) {
        return reader.damaged("%s should have %zu bytes but has %zu", name.c_str(), needed, bytes.size);
    }
    bytes.size = bytes.data != nullptr ? needed : 0;
    reader.buffers.push_back(bytes);
    return vt_ok;
}

vtResult loadBuffers(Reader& reader, const Json& buffers, Bytes bin)
{
    for (size_t i = 0; buffers.is_array() && i < buffers.size(); ++i) {
        const vtResult result = loadBuffer(reader, buffers[i], i, bin);
        if (result != vt_ok) {
            return result;
        }
    }
    return vt_ok;
}

// --------------------------------------------------------------------------------------------- accessors

vtResult openAccessor(Reader& reader, int index, Stream* stream)
{
    const tinygltf::Model& model = reader.model;
    vtResult result = checkIndex(reader, "accessor", index, model.accessors.size());
    if (result != vt_ok) {
        return result;
    }
    const tinygltf::Accessor& accessor = model.accessors[(size_t)index];
    if (accessor.sparse.isSparse) {
        return reader.fail(
            vt_errorFormat,
            "accessor %d is sparse, which is not supported; export it without sparse accessors", index);
    }
    if (accessor.bufferView < 0 || (size_t)accessor.bufferView >= model.bufferViews.size()) {
        return reader.fail(vt_errorFormat,
                           "accessor %d has no data (buffer view %d of %zu); export it uncompressed", index,
                           accessor.bufferView, model.bufferViews.size());
    }
    const tinygltf::BufferView& view = model.bufferViews[(size_t)accessor.bufferView];
    result = checkIndex(reader, "buffer", view.buffer, reader.buffers.size());
    if (result != vt_ok) {
        return result;
    }
    const Bytes buffer = reader.buffers[(size_t)view.buffer];
    if (buffer.data == nullptr) {
        return reader.fail(vt_errorFormat,
                           "accessor %d reads buffer %d, which has no data; export it uncompressed", index,
                           view.buffer);
    }
    const int components = tinygltf::GetNumComponentsInType((uint32_t)accessor.type);
    const int componentSize = tinygltf::GetComponentSizeInBytes((uint32_t)accessor.componentType);
    const uint64_t elementSize =
        components > 0 && componentSize > 0 ? (uint64_t)(components * componentSize) : 0;
    const uint64_t stride = view.byteStride > 0 ? view.byteStride : elementSize;
    if (elementSize == 0) {
        return reader.damaged("accessor %d has the unknown componentType %d", index, accessor.componentType);
    }
    if (stride < elementSize) {
        return reader.damaged("accessor %d has elements of %d bytes every %d bytes", index, (int)elementSize,
                              (int)stride);
    }
    // All numbers below are at most 2^31 (JsonFilter), strides at most 252: no sum overflows 64 bits.
    const uint64_t end = accessor.count > 0
                             ? accessor.byteOffset + (accessor.count - 1) * stride + elementSize
                             : accessor.byteOffset;
    const uint64_t room = view.byteOffset + view.byteLength <= buffer.size ? view.byteLength
                          : view.byteOffset <= buffer.size                 ? buffer.size - view.byteOffset
                                                                           : 0;
    if (end > room || view.byteOffset > buffer.size) {
        return reader.damaged("accessor %d reads %llu bytes beyond the end of its buffer", index,
                              (unsigned long long)(end - room));
    }
    stream->data = buffer.data + view.byteOffset + accessor.byteOffset;
    stream->count = accessor.count;
    stream->stride = (size_t)stride;
    stream->componentType = accessor.componentType;
    return vt_ok;
}

/// Opens an accessor of positions or normals.
vtResult openVectors(Reader& reader, int index, const char* attribute, Stream* stream)
{
    const vtResult result = openAccessor(reader, index, stream);
    if (result != vt_ok) {
        return result;
    }
    const tinygltf::Accessor& accessor = reader.model.accessors[(size_t)index];
    if (accessor.type != TINYGLTF_TYPE_VEC3 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
        return reader.fail(
            vt_errorFormat,
            "accessor %d holds %s as something else than three floats; export it without quantization", index,
            attribute);
    }
    return vt_ok;
}

uint32_t readIndex(const Stream& stream, size_t i)
{
    const uint8_t* p = stream.data + i * stream.stride;
    switch (stream.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return p[0];
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return (uint32_t)p[0] | (uint32_t)p[1] << 8;
    default:
        return readU32(p);
    }
}

/// Opens an accessor of indices and checks that each names one of `vertexCount` vertices.
vtResult openIndices(Reader& reader, int index, size_t vertexCount, Stream* stream)
{
    const vtResult result = openAccessor(reader, index, stream);
    if (result != vt_ok) {
        return result;
    }
    const int component = stream->componentType;
    if (reader.model.accessors[(size_t)index].type != TINYGLTF_TYPE_SCALAR ||
        (component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
         component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
         component != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
        return reader.damaged("accessor %d holds indices that are not 8, 16 or 32-bit unsigned numbers",
                              index);
    }
    for (size_t i = 0; i < stream->count; ++i) {
        if (readIndex(*stream, i) >= vertexCount) {
            return reader.fail(
                vt_errorGeometry,
                "index %u in accessor %d is out of range, there are %zu vertices; export it again",
                readIndex(*stream, i), index, vertexCount);
        }
    }
    return vt_ok;
}

// ------------------------------------------------------------------------------------------------- scene

/// The index of refraction of the first material that gives one.
vtResult readIor(Reader& reader, int materialIndex)
{
    if (materialIndex < 0 || reader.ior > 0.0) {
        return vt_ok;
    }
    const vtResult result = checkIndex(reader, "material", materialIndex, reader.model.materials.size());
    if (result != vt_ok) {
        return result;
    }
    const tinygltf::ExtensionMap& extensions = reader.model.materials[(size_t)materialIndex].extensions;
    const auto extension = extensions.find("KHR_materials_ior");
    if (extension == extensions.end()) {
        return vt_ok;
    }
    const tinygltf::Value& ior = extension->second.Get("ior");
    const double value = extension->second.Has("ior") ? (ior.IsNumber() ? ior.GetNumberAsDouble() : NAN)
                                                      : 1.5; // the extension's default
    if (!(value >= 1.0 && value <= FLT_MAX)) {
        return reader.fail(vt_errorFormat,
                           "material %d has an index of refraction of %g, but it must be a number of 1 or "
                           "more; correct KHR_materials_ior",
                           materialIndex, value);
    }
    reader.ior = value;
    return vt_ok;
}

vtResult addPrimitive(Reader& reader, const tinygltf::Primitive& primitive, const Matrix& toWorld)
{
    const auto position = primitive.attributes.find("POSITION"), normal = primitive.attributes.find("NORMAL");
    const bool triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    const bool drawable = triangles || primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                          primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    if (!drawable || position == primitive.attributes.end()) {
        return vt_ok; // points and lines bound no glass
    }
    Part part;
    part.mode = primitive.mode;
    part.toWorld = toWorld;
    vtResult result = openVectors(reader, position->second, "POSITION", &part.positions);
    if (result == vt_ok && normal != primitive.attributes.end()) {
        result = openVectors(reader, normal->second, "NORMAL", &part.normals);
        if (result == vt_ok && part.normals.count != part.positions.count) {
            result = reader.damaged("accessor %d has %zu normals for %zu positions", normal->second,
                                    part.normals.count, part.positions.count);
        }
    }
    if (result == vt_ok && primitive.indices >= 0) {
        result = openIndices(reader, primitive.indices, part.positions.count, &part.indices);
    }
    if (result == vt_ok) {
        result = readIor(reader, primitive.material);
    }
    if (result != vt_ok) {
        return result;
    }
    const size_t corners = part.indices.data != nullptr ? part.indices.count : part.positions.count;
    if (triangles && corners % 3 != 0) {
        return reader.fail(vt_errorGeometry,
                           "a primitive has %zu corners, not a multiple of 3; export it again", corners);
    }
    part.triangleCount = triangles ? corners / 3 : corners > 2 ? corners - 2 : 0;
    if (part.triangleCount > 0) {
        reader.parts.push_back(part);
    }
    return vt_ok;
}

Matrix multiply(const Matrix& a, const Matrix& b)
{
    Matrix product;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            double sum = 0.0;
            for (int k = 0; k < 4; ++k) {
                sum += a.m[4 * k + row] * b.m[4 * column + k];
            }
            product.m[4 * column + row] = sum;
        }
    }
    return product;
}

/// A node's own transform: its matrix, or translation * rotation * scale.
vtResult readTransform(Reader& reader, int index, Matrix* matrix)
{
    const tinygltf::Node& node = reader.model.nodes[(size_t)index];
    const auto absentOr = [](const std::vector<double>& numbers, size_t count) {
        return numbers.empty() || numbers.size() == count;
    };
    if (!absentOr(node.matrix, 16) || !absentOr(node.translation, 3) || !absentOr(node.rotation, 4) ||
        !absentOr(node.scale, 3)) {
        return reader.damaged("node %d has a transform with too many or too few numbers", index);
    }
    if (!node.matrix.empty()) {
        std::copy(node.matrix.begin(), node.matrix.end(), matrix->m);
        return vt_ok;
    }
    const std::vector<double> t = node.translation.empty() ? std::vector<double>{0, 0, 0} : node.translation;
    const std::vector<double> r = node.rotation.empty() ? std::vector<double>{0, 0, 0, 1} : node.rotation;
    const std::vector<double> s = node.scale.empty() ? std::vector<double>{1, 1, 1} : node.scale;
    const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    if (!(length > 0.0)) {
        return reader.damaged("node %d has a rotation of zero length", index);
    }
    const double x = r[0] / length, y = r[1] / length, z = r[2] / length, w = r[3] / length;
    const double columns[16] = {s[0] * (1 - 2 * (y * y + z * z)),
                                s[0] * 2 * (x * y + z * w),
                                s[0] * 2 * (x * z - y * w),
                                0,
                                s[1] * 2 * (x * y - z * w),
                                s[1] * (1 - 2 * (x * x + z * z)),
                                s[1] * 2 * (y * z + x * w),
                                0,
                                s[2] * 2 * (x * z + y * w),
                                s[2] * 2 * (y * z - x * w),
                                s[2] * (1 - 2 * (x * x + y * y)),
                                0,
                                t[0],
                                t[1],
                                t[2],
                                1};
    std::copy(columns, columns + 16, matrix->m);
    return vt_ok;
}

/// The nodes a scene starts from: those of the default scene, else of the first, else all without a parent.
vtResult findRoots(Reader& reader, std::vector<int>* roots)
{
    const tinygltf::Model& model = reader.model;
    if (model.defaultScene >= 0 || !model.scenes.empty()) {
        const int scene = model.defaultScene >= 0 ? model.defaultScene : 0;
        const vtResult result = checkIndex(reader, "scene", scene, model.scenes.size());
        if (result == vt_ok) {
            *roots = model.scenes[(size_t)scene].nodes;
        }
        return result;
    }
    std::vector<bool> isChild(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes) {
        for (int child : node.children) {
            if (child >= 0 && (size_t)child < isChild.size()) {
                isChild[(size_t)child] = true;
            }
        }
    }
    for (size_t i = 0; i < isChild.size(); ++i) {
        if (!isChild[i]) {
            roots->push_back((int)i);
        }
    }
    return vt_ok;
}

/// Adds the primitives of a node that stands below `parent`. A skin is not applied: the bind pose is drawn.
vtResult addNode(Reader& reader, int index, const Matrix& parent, Matrix* toWorld)
{
    Matrix local;
    vtResult result = readTransform(reader, index, &local);
    *toWorld = multiply(parent, local);
    const int mesh = reader.model.nodes[(size_t)index].mesh;
    if (result == vt_ok && mesh >= 0) {
        result = checkIndex(reader, "mesh", mesh, reader.model.meshes.size());
    }
    if (result != vt_ok || mesh < 0) {
        return result;
    }
    for (const tinygltf::Primitive& primitive : reader.model.meshes[(size_t)mesh].primitives) {
        const vtResult added = addPrimitive(reader, primitive, *toWorld);
        if (added != vt_ok) {
            return added;
        }
    }
    return vt_ok;
}

vtResult collectParts(Reader& reader)
{
    struct Visit {
        int node, depth;
        Matrix parent;
    };
    const std::vector<tinygltf::Node>& nodes = reader.model.nodes;
    std::vector<int> roots;
    vtResult result = findRoots(reader, &roots);
    std::vector<Visit> open; // a stack of our own, in reverse so that nodes come in the file's order
    for (size_t i = roots.size(); i-- > 0;) {
        open.push_back({roots[i], 1, Matrix()});
    }
    std::vector<bool> seen(nodes.size(), false);
    while (result == vt_ok && !open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        result = checkIndex(reader, "node", visit.node, nodes.size());
        if (result != vt_ok) {
            break;
        }
        if (seen[(size_t)visit.node]) {
            return reader.damaged("node %d is reached twice, but nodes must form a tree without cycles",
                                  visit.node);
        }
        if (visit.depth > maxNodeDepth) {
            return reader.fail(vt_errorFormat,
                               "its nodes are nested deeper than %d levels; flatten them and export it again",
                               maxNodeDepth);
        }
        seen[(size_t)visit.node] = true;
        Matrix toWorld;
        result = addNode(reader, visit.node, visit.parent, &toWorld);
        const std::vector<int>& children = nodes[(size_t)visit.node].children;
        for (size_t i = children.size(); i-- > 0;) {
            open.push_back({children[i], visit.depth + 1, toWorld});
        }
    }
    return result;
}

// -------------------------------------------------------------------------------------------------- mesh

/// The matrix for normals and whether the transform mirrors. The cofactors are the inverse transpose times
/// the determinant, so they exist for flat transforms too; the sign is put right where it is mirrored.
bool normalMatrix(const Matrix& toWorld, double cofactors[9])
{
    const double* m = toWorld.m;
    for (int column = 0; column < 3; ++column) {
        const double* a = m + 4 * ((column + 1) % 3);
        const double* b = m + 4 * ((column + 2) % 3);
        cofactors[3 * column + 0] = a[1] * b[2] - a[2] * b[1];
        cofactors[3 * column + 1] = a[2] * b[0] - a[0] * b[2];
        cofactors[3 * column + 2] = a[0] * b[1] - a[1] * b[0];
    }
    const bool mirrored = m[0] * cofactors[0] + m[1] * cofactors[1] + m[2] * cofactors[2] < 0.0;
    for (int i = 0; i < 9 && mirrored; ++i) {
        cofactors[i] = -cofactors[i];
    }
    return mirrored;
}

void readVector(const Stream& stream, size_t i, double v[3])
{
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t bits = readU32(stream.data + i * stream.stride + 4 * k);
        float value;
        memcpy(&value, &bits, sizeof value);
        v[k] = (double)value;
    }
}

/// Writes a part's vertices; normals that are missing stay zero, and vtCreateMesh computes those.
void writeVertices(const Part& part, const double cofactors[9], float* positions, float* normals)
{
    const double* m = part.toWorld.m;
    for (size_t i = 0; i < part.positions.count; ++i) {
        double v[3];
        readVector(part.positions, i, v);
        for (size_t k = 0; k < 3; ++k) {
            positions[3 * i + k] = (float)(m[k] * v[0] + m[4 + k] * v[1] + m[8 + k] * v[2] + m[12 + k]);
        }
        if (part.normals.data == nullptr) {
            continue;
        }
        readVector(part.normals, i, v);
        double n[3];
        for (size_t k = 0; k < 3; ++k) {
            n[k] = cofactors[k] * v[0] + cofactors[3 + k] * v[1] + cofactors[6 + k] * v[2];
        }
        const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (size_t k = 0; k < 3; ++k) {
            normals[3 * i + k] = (float)(length > 0.0 ? n[k] / length : n[k]); // NaN passes on to be refused
        }
    }
}

void writeTriangles(const Part& part, bool mirrored, uint32_t firstVertex, uint32_t* indices)
{
    const auto corner = [&](size_t i) {
        return firstVertex + (part.indices.data != nullptr ? readIndex(part.indices, i) : (uint32_t)i);
    };
    for (size_t t = 0; t < part.triangleCount; ++t) {
        uint32_t* to = indices + 3 * t;
        if (part.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
            to[0] = corner(t), to[1] = corner(t + 1 + t % 2), to[2] = corner(t + 2 - t % 2);
        } else if (part.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            to[0] = corner(t + 1), to[1] = corner(t + 2), to[2] = corner(0);
        } else {
            to[0] = corner(3 * t), to[1] = corner(3 * t + 1), to[2] = corner(3 * t + 2);
        }
        if (mirrored) {
            std::swap(to[1], to[2]);
        }
    }
}

vtResult buildMesh(Reader& reader, vtMesh* mesh)
{
    uint64_t vertexCount = 0, indexCount = 0;
    bool hasNormals = false;
    for (const Part& part : reader.parts) {
        vertexCount += part.positions.count;
        indexCount += 3 * (uint64_t)part.triangleCount;
        hasNormals = hasNormals || part.normals.data != nullptr;
    }
    if (indexCount == 0) {
        return reader.fail(vt_errorGeometry,
                           "its scene has no triangles; export it with its meshes, in a scene");
    }
    if (vertexCount > UINT32_MAX || indexCount > UINT32_MAX || vertexCount > SIZE_MAX / 12 ||
        indexCount > SIZE_MAX / 4) {
        return reader.fail(vt_errorGeometry,
                           "it has %llu vertices and %llu indices, more than 32 bits can count; simplify it",
                           (unsigned long long)vertexCount, (unsigned long long)indexCount);
    }
    float* positions = (float*)malloc((size_t)vertexCount * 3 * sizeof(float));
    float* normals = hasNormals ? (float*)calloc((size_t)vertexCount * 3, sizeof(float)) : nullptr;
    uint32_t* indices = (uint32_t*)malloc((size_t)indexCount * sizeof(uint32_t));
    vtResult result = vt_ok;
    if (positions == nullptr || indices == nullptr || (hasNormals && normals == nullptr)) {
        result = reader.fail(vt_errorMemory, "no memory for %llu vertices and %llu indices; simplify it",
                             (unsigned long long)vertexCount, (unsigned long long)indexCount);
    } else {
        size_t vertex = 0, index = 0;
        for (const Part& part : reader.parts) {
            double cofactors[9];
            const bool mirrored = normalMatrix(part.toWorld, cofactors);
            writeVertices(part, cofactors, positions + 3 * vertex,
                          hasNormals ? normals + 3 * vertex : nullptr);
            writeTriangles(part, mirrored, (uint32_t)vertex, indices + index);
            vertex += part.positions.count;
            index += 3 * part.triangleCount;
        }
        vtMeshDef def = {};
        def.positions = positions;
        def.normals = normals;
        def.indices = indices;
        def.vertexCount = (uint32_t)vertexCount;
        def.indexCount = (uint32_t)indexCount;
        result = vtCreateMesh(&def, reader.def->name, mesh, reader.error);
    }
    free(positions);
    free(normals);
    free(indices);
    return result;
}

vtResult load(Reader& reader, vtModel* model)
{
    Bytes text, bin;
    vtResult result = splitFile(reader, &text, &bin);
    Json document, buffers;
    if (result == vt_ok) {
        result = parseJson(reader, text, &document);
    }
    if (result == vt_ok) {
        buffers = std::move(document["buffers"]); // null where there are none
        document.erase("buffers");                // loaded here, so that tinygltf meets no file and no data
        result = parseStructs(reader, document);
    }
    if (result == vt_ok) {
        result = loadBuffers(reader, buffers, bin);
    }
    if (result == vt_ok) {
        result = collectParts(reader);
    }
    if (result == vt_ok) {
        result = buildMesh(reader, &model->mesh);
    }
    model->ior = result == vt_ok ? (float)reader.ior : 0.0f;
    return result;
}

} // namespace

extern "C" vtResult vtLoadModel(const vtModelDef* def, vtModel* model, vtError* error)
{
    assert(def != nullptr && model != nullptr && (def->bytes != nullptr || def->size == 0));
    *model = vtModel{};
    Reader reader = {def, error};
    const vtResult result = load(reader, model);
    return result == vt_ok ? vtSucceed(error) : result;
}

extern "C" void vtDestroyModel(vtModel* model)
{
    if (model != nullptr) {
        vtDestroyMesh(&model->mesh);
        *model = vtModel{};
    }
}
