// What is read of a file's JSON.

#include "gltf/gltf_json.h"

#include <cmath>
#include <cstring>

namespace vtGltf
{

static const int maxJsonDepth = 32; // of what is kept as it is; tinygltf recurses

/// How what a file says under a key is taken.
enum class Take {
    asIs,       // tinygltf, or the reader, looks at its type
    index,      // a whole number from 0 to 2^31 - 1
    indices,    // an array of them
    map,        // an object of them
    maps,       // an array of such objects
    object,     // an object of the kind `kind`
    list,       // an array of them
    extensions, // an object with an object of the kind `kind` under the name of an extension
};

/// What an object of a file is.
enum class Kind {
    none,
    asset,
    file,
    fileExtension,
    buffer,
    bufferView,
    bufferViewExtension,
    packedView,
    accessor,
    sparse,
    sparsePart,
    mesh,
    primitive,
    primitiveExtension,
    packedPrimitive,
    skin,
    animation,
    curve,
    channel,
    target,
    targetExtension,
    pointer,
    node,
    nodeExtension,
    instances,
    visibility,
    scene,
    camera,
    image,
    sampler,
    texture,
    textureExtension,
    textureSource,
    material,
    look,
    picture,
    known,
};

struct Field {
    Kind in;
    const char* key;
    Take take;
    Kind kind;
};

/// All that is read of a file, as glTF 2.0 and the extensions define it. What else a file has is dropped
/// unseen, whatever its keys are called. "*" is the name of any extension that is known.
static const Field fields[] = {
    {Kind::file, "asset", Take::object, Kind::asset},
    {Kind::asset, "version", Take::asIs, {}},
    {Kind::asset, "minVersion", Take::asIs, {}},
    {Kind::file, "buffers", Take::list, Kind::buffer},
    {Kind::buffer, "byteLength", Take::index, {}},
    {Kind::buffer, "uri", Take::asIs, {}},
    {Kind::file, "bufferViews", Take::list, Kind::bufferView},
    {Kind::bufferView, "buffer", Take::index, {}},
    {Kind::bufferView, "byteOffset", Take::index, {}},
    {Kind::bufferView, "byteLength", Take::index, {}},
    {Kind::bufferView, "byteStride", Take::index, {}},
    {Kind::bufferView, "extensions", Take::extensions, Kind::bufferViewExtension},
    {Kind::bufferViewExtension, "EXT_meshopt_compression", Take::object, Kind::packedView},
    {Kind::bufferViewExtension, "KHR_meshopt_compression", Take::object, Kind::packedView},
    {Kind::packedView, "buffer", Take::index, {}},
    {Kind::packedView, "byteOffset", Take::index, {}},
    {Kind::packedView, "byteLength", Take::index, {}},
    {Kind::packedView, "byteStride", Take::index, {}},
    {Kind::packedView, "count", Take::index, {}},
    {Kind::packedView, "mode", Take::asIs, {}},
    {Kind::packedView, "filter", Take::asIs, {}},
    {Kind::file, "accessors", Take::list, Kind::accessor},
    {Kind::accessor, "bufferView", Take::index, {}},
    {Kind::accessor, "byteOffset", Take::index, {}},
    {Kind::accessor, "componentType", Take::index, {}},
    {Kind::accessor, "count", Take::index, {}},
    {Kind::accessor, "type", Take::asIs, {}},
    {Kind::accessor, "normalized", Take::asIs, {}},
    {Kind::accessor, "sparse", Take::object, Kind::sparse},
    {Kind::sparse, "count", Take::index, {}},
    {Kind::sparse, "indices", Take::object, Kind::sparsePart},
    {Kind::sparse, "values", Take::object, Kind::sparsePart},
    {Kind::sparsePart, "bufferView", Take::index, {}},
    {Kind::sparsePart, "byteOffset", Take::index, {}},
    {Kind::sparsePart, "componentType", Take::index, {}},
    {Kind::file, "meshes", Take::list, Kind::mesh},
    {Kind::mesh, "name", Take::asIs, {}},
    {Kind::mesh, "weights", Take::asIs, {}},
    {Kind::mesh, "primitives", Take::list, Kind::primitive},
    {Kind::primitive, "attributes", Take::map, {}},
    {Kind::primitive, "targets", Take::maps, {}},
    {Kind::primitive, "indices", Take::index, {}},
    {Kind::primitive, "material", Take::index, {}},
    {Kind::primitive, "mode", Take::index, {}},
    {Kind::primitive, "extensions", Take::extensions, Kind::primitiveExtension},
    {Kind::primitiveExtension, "KHR_draco_mesh_compression", Take::object, Kind::packedPrimitive},
    {Kind::packedPrimitive, "bufferView", Take::index, {}},
    {Kind::packedPrimitive, "attributes", Take::map, {}},
    {Kind::file, "skins", Take::list, Kind::skin},
    {Kind::skin, "joints", Take::indices, {}},
    {Kind::skin, "inverseBindMatrices", Take::index, {}},
    {Kind::file, "animations", Take::list, Kind::animation},
    {Kind::animation, "name", Take::asIs, {}},
    {Kind::animation, "samplers", Take::list, Kind::curve},
    {Kind::curve, "input", Take::index, {}},
    {Kind::curve, "output", Take::index, {}},
    {Kind::curve, "interpolation", Take::asIs, {}},
    {Kind::animation, "channels", Take::list, Kind::channel},
    {Kind::channel, "sampler", Take::index, {}},
    {Kind::channel, "target", Take::object, Kind::target},
    {Kind::target, "node", Take::index, {}},
    {Kind::target, "path", Take::asIs, {}},
    {Kind::target, "extensions", Take::extensions, Kind::targetExtension},
    {Kind::targetExtension, "KHR_animation_pointer", Take::object, Kind::pointer},
    {Kind::pointer, "pointer", Take::asIs, {}},
    {Kind::file, "nodes", Take::list, Kind::node},
    {Kind::node, "name", Take::asIs, {}},
    {Kind::node, "children", Take::indices, {}},
    {Kind::node, "mesh", Take::index, {}},
    {Kind::node, "skin", Take::index, {}},
    {Kind::node, "camera", Take::index, {}},
    {Kind::node, "matrix", Take::asIs, {}},
    {Kind::node, "translation", Take::asIs, {}},
    {Kind::node, "rotation", Take::asIs, {}},
    {Kind::node, "scale", Take::asIs, {}},
    {Kind::node, "weights", Take::asIs, {}},
    {Kind::node, "extensions", Take::extensions, Kind::nodeExtension},
    {Kind::nodeExtension, "EXT_mesh_gpu_instancing", Take::object, Kind::instances},
    {Kind::instances, "attributes", Take::map, {}},
    {Kind::nodeExtension, "KHR_node_visibility", Take::object, Kind::visibility},
    {Kind::visibility, "visible", Take::asIs, {}},
    {Kind::file, "scene", Take::index, {}},
    {Kind::file, "scenes", Take::list, Kind::scene},
    {Kind::scene, "nodes", Take::indices, {}},
    {Kind::file, "cameras", Take::list, Kind::camera},
    {Kind::camera, "name", Take::asIs, {}},
    {Kind::camera, "type", Take::asIs, {}},
    {Kind::camera, "perspective", Take::asIs, {}},
    {Kind::camera, "orthographic", Take::asIs, {}},
    {Kind::file, "images", Take::list, Kind::image},
    {Kind::image, "name", Take::asIs, {}},
    {Kind::image, "uri", Take::asIs, {}},
    {Kind::image, "bufferView", Take::index, {}},
    {Kind::file, "samplers", Take::list, Kind::sampler},
    {Kind::sampler, "magFilter", Take::index, {}},
    {Kind::sampler, "minFilter", Take::index, {}},
    {Kind::sampler, "wrapS", Take::index, {}},
    {Kind::sampler, "wrapT", Take::index, {}},
    {Kind::file, "textures", Take::list, Kind::texture},
    {Kind::texture, "source", Take::index, {}},
    {Kind::texture, "sampler", Take::index, {}},
    {Kind::texture, "extensions", Take::extensions, Kind::textureExtension},
    {Kind::textureExtension, "EXT_texture_avif", Take::object, Kind::textureSource},
    {Kind::textureExtension, "EXT_texture_webp", Take::object, Kind::textureSource},
    {Kind::textureExtension, "KHR_texture_basisu", Take::object, Kind::textureSource},
    {Kind::textureSource, "source", Take::index, {}},
    {Kind::file, "materials", Take::list, Kind::material},
    {Kind::material, "name", Take::asIs, {}},
    {Kind::material, "pbrMetallicRoughness", Take::object, Kind::look},
    {Kind::look, "baseColorFactor", Take::asIs, {}},
    {Kind::look, "metallicFactor", Take::asIs, {}},
    {Kind::look, "roughnessFactor", Take::asIs, {}},
    {Kind::look, "baseColorTexture", Take::object, Kind::picture},
    {Kind::look, "metallicRoughnessTexture", Take::object, Kind::picture},
    {Kind::material, "normalTexture", Take::object, Kind::picture},
    {Kind::material, "occlusionTexture", Take::object, Kind::picture},
    {Kind::material, "emissiveTexture", Take::object, Kind::picture},
    {Kind::picture, "index", Take::index, {}},
    {Kind::picture, "texCoord", Take::index, {}},
    {Kind::picture, "scale", Take::asIs, {}},
    {Kind::picture, "strength", Take::asIs, {}},
    {Kind::picture, "extensions", Take::extensions, Kind::known},
    {Kind::material, "emissiveFactor", Take::asIs, {}},
    {Kind::material, "alphaMode", Take::asIs, {}},
    {Kind::material, "alphaCutoff", Take::asIs, {}},
    {Kind::material, "doubleSided", Take::asIs, {}},
    {Kind::material, "extensions", Take::extensions, Kind::known},
    {Kind::known, "*", Take::asIs, {}},
    {Kind::file, "extensions", Take::extensions, Kind::fileExtension},
    {Kind::fileExtension, "KHR_lights_punctual", Take::asIs, {}},
    {Kind::fileExtension, "KHR_materials_variants", Take::asIs, {}},
    {Kind::nodeExtension, "KHR_lights_punctual", Take::asIs, {}},
    {Kind::primitiveExtension, "KHR_materials_variants", Take::asIs, {}},
    {Kind::file, "extensionsUsed", Take::asIs, {}},
    {Kind::file, "extensionsRequired", Take::asIs, {}},
};

/// The field of that key, or null: it is not read.
static const Field* findField(Kind in, const std::string& key)
{
    for (const Field& field : fields) {
        if (field.in == in && (key == field.key || (strcmp(field.key, "*") == 0 &&
                                                    vtFindGltfExtension(key.c_str()) != nullptr))) {
            return &field;
        }
    }
    return nullptr;
}

static bool failKind(Loader& loader, const std::string& key, const char* kind)
{
    return loader.fail(vt_errorFormat, "'%s' in its JSON is no %s" GLTF_DAMAGED, key.c_str(), kind);
}

/// 12.0 is as good as 12 in JSON, but tinygltf would ignore it; and it would wrap other large whole numbers
/// round.
static void tidyNumber(Json& value)
{
    if (value.is_number_float()) {
        const double number = value.get<double>();
        if (number == std::floor(number) && std::fabs(number) <= INT32_MAX) {
            value = number < 0 ? Json((int64_t)number) : Json((uint64_t)number);
        }
    } else if (value.is_number() && std::fabs(value.get<double>()) > INT32_MAX) {
        value = value.get<double>();
    }
}

/// Indices and offsets must fit an int.
static bool tidyIndex(Loader& loader, const std::string& key, Json& value)
{
    tidyNumber(value);
    return (value.is_number_unsigned() && value.get<uint64_t>() <= INT32_MAX) ||
           loader.fail(vt_errorFormat,
                       "its JSON has a '%s' that is not a whole number from 0 to %d" GLTF_DAMAGED,
                       key.c_str(), INT32_MAX);
}

static bool tidyAsIs(Loader& loader, Json& value, int depth)
{
    if (depth > maxJsonDepth) {
        return loader.fail(vt_errorFormat, "its JSON is nested deeper than %d levels" GLTF_DAMAGED,
                           maxJsonDepth);
    }
    tidyNumber(value);
    for (auto at = value.begin(); value.is_structured() && at != value.end(); ++at) {
        if (!tidyAsIs(loader, *at, depth + 1)) {
            return false;
        }
    }
    return true;
}

static bool tidyMap(Loader& loader, const std::string& key, Json& value)
{
    if (!value.is_object()) {
        return failKind(loader, key, "object");
    }
    for (auto at = value.begin(); at != value.end();) {
        if (at.key().empty() || at.key()[0] == '_') { // an application's own, whatever it is
            at = value.erase(at);
            continue;
        }
        if (!tidyIndex(loader, at.key(), *at)) {
            return false;
        }
        ++at;
    }
    return true;
}

static bool tidyObject(Loader& loader, const std::string& key, Kind kind, Json& value);

static bool tidyField(Loader& loader, const Field& field, const std::string& key, Json& value)
{
    switch (field.take) {
    case Take::asIs:
        return tidyAsIs(loader, value, 0);
    case Take::index:
        return tidyIndex(loader, key, value);
    case Take::map:
        return tidyMap(loader, key, value);
    case Take::object:
    case Take::extensions:
        return tidyObject(loader, key, field.kind, value);
    default:
        break;
    }
    if (!value.is_array()) {
        return failKind(loader, key, "array");
    }
    for (Json& entry : value) {
        if (!(field.take == Take::indices ? tidyIndex(loader, key, entry)
              : field.take == Take::maps  ? tidyMap(loader, key, entry)
                                          : tidyObject(loader, key, field.kind, entry))) {
            return false;
        }
    }
    return true;
}

/// Drops what is not read of an object; refuses what tinygltf would misread. Fields form a tree, so this
/// ends.
static bool tidyObject(Loader& loader, const std::string& key, Kind kind, Json& value)
{
    if (!value.is_object()) {
        return failKind(loader, key, "object");
    }
    for (auto at = value.begin(); at != value.end();) {
        const Field* field = findField(kind, at.key());
        if (field == nullptr) {
            at = value.erase(at);
            continue;
        }
        if (!tidyField(loader, *field, at.key(), *at)) {
            return false;
        }
        ++at;
    }
    return true;
}

bool tidyDocument(Loader& loader, Json& document)
{
    return tidyObject(loader, "glTF", Kind::file, document);
}

} // namespace vtGltf
