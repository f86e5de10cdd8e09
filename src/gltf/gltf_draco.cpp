// KHR_draco_mesh_compression: primitives packed by Draco, in version 2.2 of its bitstream
// (https://google.github.io/draco/spec/).

#include "gltf/gltf.h"

#ifdef VT_WITH_DRACO
#include <draco/compression/config/compression_shared.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
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

/// A decoder of Draco's that looks at the numbers that a stream declares before it takes memory for them: a
/// few bytes may declare billions.
template <typename Method> class Decoder : public Method
{
  public:
    /// `most`: of triangles and of vertices, by the accessors.
    Decoder(Loader& owner, uint64_t most) : loader(owner), largest(most)
    {
    }

    /// Has the loader been told why it fails?
    bool isRefused() const
    {
        return refused;
    }

  protected:
    bool DecodeGeometryData() override
    {
        draco::DecoderBuffer ahead = *this->buffer();
        const bool isInOrder = std::is_same<Method, draco::MeshSequentialDecoder>::value;
        // Its way through the triangles stands just before; the standard one has a bit at least for three
        // quarters of them.
        const bool hasBits = !isInOrder && ahead.data_head()[-1] == draco::MESH_EDGEBREAKER_STANDARD_ENCODING;
        uint32_t first = 0, second = 0;
        if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) {
            return false;
        }
        const uint64_t faces = isInOrder ? first : second, vertices = isInOrder ? second : first;
        const uint64_t left = (uint64_t)ahead.remaining_size();
        if (faces > largest || vertices > largest || (hasBits && 3 * faces > 4 * 8 * left)) {
            return allow(
                loader.fail(vt_errorFormat,
                            "a packed primitive declares %u triangles and %u vertices, which neither "
                            "its %zu bytes nor its accessors have" GLTF_DAMAGED,
                            (unsigned)faces, (unsigned)vertices, (size_t)left));
        }
        // As the connectivity has them: a corner's vertex, its neighbour, the face and two lists of faces.
        const uint64_t faceBytes = 3 * (4 + 4 + 4) + 4 + 4, vertexBytes = 4 + 4;
        return allow(loader.canHaveTriangles(faces) &&
                     loader.canSpend(faces * faceBytes + vertices * vertexBytes, "a packed primitive")) &&
               Method::DecodeGeometryData();
    }

    /// Each number is there twice: as it is stored, and as it comes out.
    bool DecodeAllAttributes() override
    {
        const draco::PointCloud& points = *this->point_cloud();
        uint64_t bytes = 0;
        for (int32_t i = 0; i < points.num_attributes(); ++i) {
            const draco::PointAttribute& attribute = *points.attribute(i);
            const uint64_t width = 4 + (uint64_t)draco::DataTypeLength(attribute.data_type());
            bytes += points.num_points() * width * (uint64_t)attribute.num_components();
        }
        return allow(loader.canSpend(bytes, "a packed primitive")) && Method::DecodeAllAttributes();
    }

  private:
    bool allow(bool allowed)
    {
        refused = !allowed;
        return allowed;
    }

    Loader& loader;
    uint64_t largest;
    bool refused = false;
};

/// What the accessors of a primitive let it have of triangles and of vertices. Of a few, more: some programs
/// count them wrongly.
static uint64_t mostOf(const Loader& loader, const tinygltf::Primitive& primitive)
{
    const std::vector<tinygltf::Accessor>& accessors = loader.model.accessors;
    uint64_t most = 1u << 20;
    for (const char* name : {"", "POSITION"}) { // "": indices
        const auto at = primitive.attributes.find(name);
        if (at != primitive.attributes.end() && (size_t)at->second < accessors.size()) {
            most = std::max(most, (uint64_t)accessors[(size_t)at->second].count);
        }
    }
    return most;
}

template <typename Method>
static bool decode(Loader& loader, uint64_t most, draco::DecoderBuffer* buffer, draco::Mesh* mesh)
{
    Decoder<Method> decoder(loader, most);
    const draco::Status status = decoder.Decode(draco::DecoderOptions(), buffer, mesh);
    return status.ok() ||
           (!decoder.isRefused() &&
            loader.fail(vt_errorFormat, "a packed primitive cannot be unpacked (%s)" GLTF_DAMAGED,
                        withoutStop(status.error_msg_string()).c_str()));
}

static bool decodeMesh(Loader& loader, uint64_t most, const Bytes& packed, draco::Mesh* mesh)
{
    draco::DecoderBuffer buffer, ahead;
    draco::DracoHeader header;
    buffer.Init((const char*)packed.data, packed.size);
    ahead = buffer;
    if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok()) {
        return loader.fail(vt_errorFormat, "a packed primitive is not packed by Draco" GLTF_DAMAGED);
    }
    if (header.version_major != 2 || header.version_minor != 2) {
        return loader.fail(
            vt_errorFormat,
            "a packed primitive has version %d.%d of Draco's bitstream, but glTF has 2.2; export "
            "it again",
            header.version_major, header.version_minor);
    }
    switch (header.encoder_method) {
    case draco::MESH_SEQUENTIAL_ENCODING:
        return decode<draco::MeshSequentialDecoder>(loader, most, &buffer, mesh);
    case draco::MESH_EDGEBREAKER_ENCODING:
        return decode<draco::MeshEdgebreakerDecoder>(loader, most, &buffer, mesh);
    default:
        return loader.fail(vt_errorFormat,
                           "a packed primitive has method %d, which Draco has not" GLTF_DAMAGED,
                           header.encoder_method);
    }
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
    draco::Mesh mesh;
    if (!decodeMesh(loader, mostOf(loader, primitive), packed, &mesh)) {
        return false;
    }
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
