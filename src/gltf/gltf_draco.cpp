// KHR_draco_mesh_compression: primitives packed by Draco.

#include "gltf/gltf.h"

#ifdef VT_WITH_DRACO
#include <draco/compression/decode.h>
#endif

namespace vtGltf
{

#ifdef VT_WITH_DRACO

/// Bytes of the loader's own, for a stream.
static uint8_t* own(Loader& loader, size_t size)
{
    std::vector<uint8_t> bytes(size + 1); // never empty
    uint8_t* data = bytes.data();
    loader.ownedBuffers.push_back(std::move(bytes)); // which leaves the bytes where they are
    return data;
}

template <typename Number>
static bool convert(const draco::PointAttribute& attribute, size_t count, int components, Number* to)
{
    bool converted = true;
    for (size_t i = 0; i < count && converted; ++i) {
        converted = attribute.ConvertValue<Number>(attribute.mapped_index(draco::PointIndex((uint32_t)i)),
                                                   (int8_t)components, to + (size_t)components * i);
    }
    return converted;
}

/// Has it numbers that glTF has, which Draco converts? A byte of its booleans may be neither true nor false.
static bool hasNumbers(const draco::PointAttribute* attribute)
{
    return attribute != nullptr && attribute->data_type() != draco::DT_BOOL &&
           draco::DataTypeLength(attribute->data_type()) <= 4;
}

/// An attribute as its accessor says that it is.
static bool readAttribute(Loader& loader, const draco::Mesh& mesh, const std::string& name, int id,
                          int accessorIndex, Stream* stream)
{
    if (!loader.has("accessor", accessorIndex, loader.model.accessors.size())) {
        return false;
    }
    const tinygltf::Accessor& accessor = loader.model.accessors[(size_t)accessorIndex];
    const int components = tinygltf::GetNumComponentsInType((uint32_t)accessor.type);
    const int width = tinygltf::GetComponentSizeInBytes((uint32_t)accessor.componentType);
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId((uint32_t)id);
    const size_t count = mesh.num_points();
    bool read = hasNumbers(attribute) && components > 0 && components <= 4 && width > 0;
    if (read) {
        const size_t stride = (size_t)components * (size_t)width;
        if (!loader.spend((uint64_t)count * stride, "a packed primitive")) {
            return false;
        }
        uint8_t* to = own(loader, count * stride);
        *stream = {to, count, stride, accessor.componentType, components, accessor.normalized};
        switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            read = convert(*attribute, count, components, (int8_t*)to);
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            read = convert(*attribute, count, components, to);
            break;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            read = convert(*attribute, count, components, (int16_t*)(void*)to);
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            read = convert(*attribute, count, components, (uint16_t*)(void*)to);
            break;
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            read = convert(*attribute, count, components, (float*)(void*)to);
            break;
        default:
            read = false;
        }
    }
    return read ||
           loader.fail(vt_errorFormat, "a packed primitive has no %s as its accessor %d says" GLTF_DAMAGED,
                       name.c_str(), accessorIndex);
}

static bool readTriangles(Loader& loader, const draco::Mesh& mesh, Stream* indices)
{
    const size_t count = 3 * (size_t)mesh.num_faces();
    if (!loader.spend(4 * (uint64_t)count, "a packed primitive")) {
        return false;
    }
    uint32_t* to = (uint32_t*)(void*)own(loader, 4 * count);
    for (size_t i = 0; i < count; ++i) {
        to[i] = mesh.face(draco::FaceIndex((uint32_t)(i / 3)))[i % 3].value();
    }
    *indices = {(const uint8_t*)to, count, 4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, 1, false};
    return true;
}

bool decodePrimitive(Loader& loader, const tinygltf::Primitive& primitive, Streams* streams)
{
    const tinygltf::Value& about = primitive.extensions.at("KHR_draco_mesh_compression");
    Bytes packed;
    if (!about.Has("bufferView") || !about.Has("attributes")) {
        return loader.fail(vt_errorFormat, "a packed primitive does not say where its data are" GLTF_DAMAGED);
    }
    if (!openView(loader, "a packed primitive", about.Get("bufferView").GetNumberAsInt(), wholeView,
                  &packed)) {
        return false;
    }
    draco::DecoderBuffer buffer;
    buffer.Init((const char*)packed.data, packed.size);
    draco::Decoder decoder;
    draco::StatusOr<std::unique_ptr<draco::Mesh>> decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        return loader.fail(vt_errorFormat, "a packed primitive cannot be unpacked (%s)" GLTF_DAMAGED,
                           withoutStop(decoded.status().error_msg_string()).c_str());
    }
    const draco::Mesh& mesh = *decoded.value();
    const tinygltf::Value& attributes = about.Get("attributes");
    for (const std::string& name : attributes.Keys()) {
        const auto accessor = primitive.attributes.find(name);
        Stream stream;
        if (accessor == primitive.attributes.end()) {
            continue;
        }
        if (!readAttribute(loader, mesh, name, attributes.Get(name).GetNumberAsInt(), accessor->second,
                           &stream)) {
            return false;
        }
        streams->push_back({name, stream});
    }
    Stream indices;
    const bool read = readTriangles(loader, mesh, &indices);
    streams->push_back({"", indices});
    return read;
}

#else

bool decodePrimitive(Loader& loader, const tinygltf::Primitive&, Streams*)
{
    return loader.fail(vt_errorFormat, "a primitive is packed");
}

#endif

} // namespace vtGltf
