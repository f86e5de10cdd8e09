// Primitives: what they give for each vertex, and their triangles. Every index of theirs is checked here.

#include "gltf/gltf.h"

#include <algorithm>

namespace vtGltf
{

/// Where the data of a primitive are: in accessors, or unpacked.
struct Opening {
    Loader& loader;
    Streams decoded;
};

static const Stream* find(const Streams& streams, const std::string& name)
{
    for (const auto& entry : streams) {
        if (entry.first == name) {
            return &entry.second;
        }
    }
    return nullptr;
}

/// Opens the accessor, or what was unpacked in its place; `name` "" is the indices.
static bool open(Opening& from, const std::string& name, int accessor, Stream* stream)
{
    const Stream* decoded = find(from.decoded, name);
    if (decoded != nullptr) {
        *stream = *decoded;
        return true;
    }
    return openAccessor(from.loader, accessor, stream);
}

static bool isWhole(const Stream& stream)
{
    const int type = stream.componentType;
    return type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
           type == TINYGLTF_COMPONENT_TYPE_SHORT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
}

/// Opens what is a number or a vector: floats, or 8 or 16-bit numbers (KHR_mesh_quantization). `components`:
/// how many it must have; one more does, too, where `more`.
static bool openNumbers(Opening& from, int accessor, const std::string& name, int components, bool more,
                        Stream* stream)
{
    if (!open(from, name, accessor, stream)) {
        return false;
    }
    const bool fits = stream->components == components || (more && stream->components == components + 1);
    static const char* const counts[] = {"no", "one", "two", "three", "four"};
    // Numbers that stand for themselves would be places, on pictures too, or joints.
    const bool anyRange = name == "POSITION" || name[0] == 'T' || name[0] == 'J';
    if (!fits || (stream->componentType != TINYGLTF_COMPONENT_TYPE_FLOAT &&
                  !(isWhole(*stream) && (anyRange || stream->normalized)))) {
        return from.loader.fail(
            vt_errorFormat,
            "accessor %d holds %s as something else than %s floats or %s8 or 16-bit numbers" GLTF_DAMAGED,
            accessor, name.c_str(), more ? "three or four" : counts[components],
            anyRange ? "" : "normalized ");
    }
    return true;
}

/// Opens an accessor of indices and checks that each names one of `vertexCount` vertices.
static bool openIndices(Opening& from, int index, size_t vertexCount, Stream* stream)
{
    if (!open(from, "", index, stream)) {
        return false;
    }
    Loader& loader = from.loader;
    const int type = stream->componentType;
    if (stream->components != 1 ||
        (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
         type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
        return loader.fail(
            vt_errorFormat,
            "accessor %d holds indices that are not 8, 16 or 32-bit unsigned numbers" GLTF_DAMAGED, index);
    }
    for (size_t i = 0; i < stream->count; ++i) {
        if (readIndex(*stream, i) >= vertexCount) {
            return loader.fail(
                vt_errorGeometry,
                "index %u in accessor %d is out of range, there are %zu vertices; export it again",
                readIndex(*stream, i), index, vertexCount);
        }
    }
    return true;
}

/// The k-th of the sets of texture coordinates that the material's pictures lie by; "": there are fewer.
static std::string texcoordName(const Loader& loader, int material, size_t k)
{
    const std::vector<int> sets =
        material >= 0 ? texcoordSetsOf(loader.model.materials[(size_t)material]) : std::vector<int>();
    return k < sets.size() ? "TEXCOORD_" + std::to_string(sets[k]) : k == 0 ? "TEXCOORD_0" : "";
}

static bool hasNormalMap(const Loader& loader, int material)
{
    return material >= 0 && loader.model.materials[(size_t)material].normalTexture.index >= 0;
}

static int find(const std::map<std::string, int>& attributes, const std::string& name)
{
    const auto at = attributes.find(name);
    return at != attributes.end() ? at->second : -1;
}

/// Is there as much of it as of positions?
static bool hasAll(Loader& loader, const Stream& stream, int index, const std::string& name, const Part& part)
{
    return stream.count == part.positions.count ||
           loader.fail(vt_errorFormat, "accessor %d has %zu of %s for %zu positions" GLTF_DAMAGED, index,
                       stream.count, name.c_str(), part.positions.count);
}

/// Opens an attribute that the primitive may have.
static bool openAttribute(Opening& from, const std::map<std::string, int>& attributes,
                          const std::string& name, int components, bool more, const Part& part,
                          Stream* stream)
{
    const int index = find(attributes, name);
    return name.empty() || index < 0 ||
           (openNumbers(from, index, name, components, more, stream) &&
            hasAll(from.loader, *stream, index, name, part));
}

/// Opens the morph targets whose weights are animated, or not 0.
static bool openTargets(Opening& from, const tinygltf::Primitive& primitive, const Source& source, Part* part)
{
    Opening plain = {from.loader, {}}; // targets are never packed with the primitive
    for (size_t i = 0; i < primitive.targets.size() && i < source.weights.size(); ++i) {
        Target target = {i, {}, {}};
        if (source.weights[i] == 0.0 && source.node < 0) {
            continue;
        }
        if (!openAttribute(plain, primitive.targets[i], "POSITION", 3, false, *part, &target.positions) ||
            !openAttribute(plain, primitive.targets[i], "NORMAL", 3, false, *part, &target.normals)) {
            return false;
        }
        part->targets.push_back(target);
    }
    return true;
}

/// Opens JOINTS_n and WEIGHTS_n, and checks that the skin has each joint that counts.
static bool openInfluences(Opening& from, const tinygltf::Primitive& primitive, const Source& source,
                           Part* part)
{
    const size_t jointCount = source.skin >= 0 ? from.loader.rig.skins[(size_t)source.skin].nodes.size() : 0;
    for (int set = 0; source.skin >= 0; ++set) {
        const std::string joints = "JOINTS_" + std::to_string(set),
                          weights = "WEIGHTS_" + std::to_string(set);
        Influence influence;
        if (find(primitive.attributes, joints) < 0 || find(primitive.attributes, weights) < 0) {
            break;
        }
        if (!openAttribute(from, primitive.attributes, joints, 4, false, *part, &influence.joints) ||
            !openAttribute(from, primitive.attributes, weights, 4, false, *part, &influence.weights)) {
            return false;
        }
        for (size_t i = 0; i < 4 * part->positions.count; ++i) {
            const float joint = readNumber(influence.joints, i / 4, i % 4);
            if (!(joint >= 0.0f && joint < (float)jointCount) &&
                readNumber(influence.weights, i / 4, i % 4) != 0.0f) {
                return from.loader.fail(
                    vt_errorFormat,
                    "vertex %zu of mesh %d hangs on joint %g, but skin %d has %zu" GLTF_DAMAGED, i / 4,
                    source.mesh, (double)joint, source.skin, jointCount);
            }
        }
        part->influences.push_back(influence);
    }
    return true;
}

/// Opens what a primitive gives for each vertex.
static bool openAttributes(Opening& from, const tinygltf::Primitive& primitive, const Source& source,
                           Part* part)
{
    const std::map<std::string, int>& attributes = primitive.attributes;
    return openNumbers(from, find(attributes, "POSITION"), "POSITION", 3, false, &part->positions) &&
           openAttribute(from, attributes, "NORMAL", 3, false, *part, &part->normals) &&
           openAttribute(from, attributes, texcoordName(from.loader, part->material, 0), 2, false, *part,
                         &part->texcoords) &&
           openAttribute(from, attributes, texcoordName(from.loader, part->material, 1), 2, false, *part,
                         &part->texcoords1) &&
           (!hasNormalMap(from.loader, part->material) ||
            openAttribute(from, attributes, "TANGENT", 4, false, *part, &part->tangents)) &&
           openAttribute(from, attributes, "COLOR_0", 3, true, *part, &part->colors) &&
           openTargets(from, primitive, source, part) && openInfluences(from, primitive, source, part);
}

/// Unpacks the primitive where it is packed and this build can.
static bool unpack(Opening& from, const tinygltf::Primitive& primitive)
{
    const char* extension = "KHR_draco_mesh_compression";
    if (primitive.extensions.count(extension) == 0) {
        return true;
    }
    const char* lacking = vtFindGltfExtension(extension)->needs;
#if VT_WITH_FILES
    if (lacking == nullptr) {
        return decodePrimitive(from.loader, primitive, &from.decoded);
    }
#endif
    // Its accessors may hold the same unpacked.
    const int index = find(primitive.attributes, "POSITION");
    const std::vector<tinygltf::Accessor>& accessors = from.loader.model.accessors;
    return index < 0 || (size_t)index >= accessors.size() || accessors[(size_t)index].bufferView >= 0 ||
           from.loader.fail(vt_errorFormat,
                            "a primitive is packed by %s, which this build cannot unpack without %s; export "
                            "it uncompressed",
                            extension, lacking);
}

bool spendPrimitive(Loader& loader, const tinygltf::Primitive& primitive, const Source& source)
{
    const bool isList = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    if (!isList && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
        primitive.mode != TINYGLTF_MODE_TRIANGLE_FAN) {
        return true;
    }
    const auto countOf = [&](const char* name) -> uint64_t {
        const int index = find(primitive.attributes, name);
        const std::vector<tinygltf::Accessor>& accessors = loader.model.accessors;
        return index >= 0 && (size_t)index < accessors.size() ? accessors[(size_t)index].count : 0;
    };
    const uint64_t vertices = countOf("POSITION"), indices = countOf(""),
                   corners = indices > 0 ? indices : vertices;
    size_t moved = source.skin >= 0 ? 4 : 0; // copies of positions and normals
    for (size_t i = 0; i < primitive.targets.size() && i < source.weights.size(); ++i) {
        moved += source.weights[i] != 0.0 || source.node >= 0;
    }
    // As the loader puts them together and as the mesh has them: positions and normals, two sets of texture
    // coordinates, colours with alpha, tangents.
    const uint64_t vertexBytes = 2 * sizeof(float) * (3 + 3 + 4 + 4 + 4) + moved * 6 * sizeof(float);
    return loader.spendTriangles(isList ? corners / 3 : corners) &&
           loader.spend(vertices * vertexBytes + 2 * sizeof(uint32_t) * corners, "a primitive");
}

bool addPrimitive(Loader& loader, const tinygltf::Primitive& primitive, Source* source)
{
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
        primitive.mode != TINYGLTF_MODE_TRIANGLE_FAN) {
        if (primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
            return loader.fail(vt_errorFormat, "a primitive has the unknown mode %d" GLTF_DAMAGED,
                               primitive.mode);
        }
        ++loader.primitivesWithoutTriangles;
        return true;
    }
    if (primitive.attributes.count("POSITION") == 0) {
        return true; // the standard lets it draw nothing
    }
    Part part;
    part.mode = primitive.mode;
    part.material = std::max(materialOf(primitive, loader.variant), -1);
    Opening from = {loader, {}};
    if ((part.material >= 0 && !loader.has("material", part.material, loader.model.materials.size())) ||
        !unpack(from, primitive) || !openAttributes(from, primitive, *source, &part)) {
        return false;
    }
    part.mode = find(from.decoded, "") != nullptr ? TINYGLTF_MODE_TRIANGLES
                                                  : part.mode; // whatever it was before it was packed
    const bool triangles = part.mode == TINYGLTF_MODE_TRIANGLES;
    size_t corners = part.positions.count;
    const int indices = find(primitive.attributes, "");
    if (indices >= 0 || find(from.decoded, "") != nullptr) {
        if (!openIndices(from, indices, part.positions.count, &part.indices)) {
            return false;
        }
        corners = part.indices.count;
    }
    if (triangles && corners % 3 != 0) {
        return loader.fail(vt_errorGeometry,
                           "a primitive has %zu corners, not a multiple of 3; export it again", corners);
    }
    part.triangleCount = triangles ? corners / 3 : corners > 2 ? corners - 2 : 0;
    if (part.triangleCount > 0) {
        source->parts.push_back(part);
    }
    return true;
}

} // namespace vtGltf
