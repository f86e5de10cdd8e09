// EXT_mesh_gpu_instancing: a mesh in many places.

#include "gltf/gltf.h"

namespace vtGltf
{

/// One of the three accessors, of as many elements as the others; one that is not there has none.
static bool openInstances(Loader& loader, int node, const tinygltf::Value& attributes, const char* name,
                          int components, Stream* stream, size_t* count)
{
    if (!attributes.Has(name)) {
        return true;
    }
    if (!openAccessor(loader, attributes.Get(name).GetNumberAsInt(), stream)) {
        return false;
    }
    const bool isFirst = *count == SIZE_MAX;
    if (stream->components != components || (!isFirst && stream->count != *count)) {
        return loader.fail(
            vt_errorFormat,
            "the instances of node %d have %zu of %s with %d numbers, not %zu with %d" GLTF_DAMAGED, node,
            stream->count, name, stream->components, isFirst ? stream->count : *count, components);
    }
    *count = stream->count;
    return true;
}

bool readInstances(Loader& loader, int node, bool* found, std::vector<Matrix>* instances)
{
    const tinygltf::ExtensionMap& extensions = loader.model.nodes[(size_t)node].extensions;
    const auto at = extensions.find("EXT_mesh_gpu_instancing");
    *found = at != extensions.end() && at->second.Has("attributes");
    if (!*found) {
        return true;
    }
    const tinygltf::Value& attributes = at->second.Get("attributes");
    Stream translations, rotations, scales;
    size_t count = SIZE_MAX;
    if (!openInstances(loader, node, attributes, "TRANSLATION", 3, &translations, &count) ||
        !openInstances(loader, node, attributes, "ROTATION", 4, &rotations, &count) ||
        !openInstances(loader, node, attributes, "SCALE", 3, &scales, &count)) {
        return false;
    }
    if (count == SIZE_MAX) {
        *found = false; // it has other attributes only: the mesh is there once
        return true;
    }
    if (count > VT_MAX_OBJECTS) {
        return loader.fail(vt_errorGeometry,
                           "node %d has %zu instances but there can be %d objects; divide the file", node,
                           count, VT_MAX_OBJECTS);
    }
    for (size_t i = 0; i < count; ++i) {
        double t[3] = {0, 0, 0}, r[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
        const auto read = [i](const Stream& stream, size_t components, double* to) {
            for (size_t k = 0; stream.data != nullptr && k < components; ++k) {
                to[k] = (double)readNumber(stream, i, k);
            }
        };
        read(translations, 3, t);
        read(rotations, 4, r);
        read(scales, 3, s);
        if (!(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3] > 0.0)) {
            return loader.fail(vt_errorFormat,
                               "instance %zu of node %d has a rotation of zero length" GLTF_DAMAGED, i, node);
        }
        instances->push_back(composeMatrix(t, r, s));
    }
    return true;
}

} // namespace vtGltf
