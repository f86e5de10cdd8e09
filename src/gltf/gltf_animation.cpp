// A file's animations: samplers, what they move, and what of them can be played.

#include "gltf/gltf_json.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace vtGltf
{

// ------------------------------------------------------------------------------------------------ JSON

static std::string textOf(const Json& in, const char* key)
{
    const auto at = in.find(key);
    return at != in.end() && at->is_string() ? at->get<std::string>() : "";
}

static int indexOf(const Json& in, const char* key)
{
    const auto at = in.find(key);
    return at != in.end() ? at->get<int>() : -1;
}

/// Element of a list under a key; null: it has no such.
static const Json* entryOf(const Json& in, const char* key, int index)
{
    const auto at = in.find(key);
    return at != in.end() && index >= 0 && (size_t)index < at->size() ? &(*at)[(size_t)index] : nullptr;
}

// ------------------------------------------------------------------------------------------------ curves

static bool readTimes(Loader& loader, const std::string& what, const Stream& input, Kept<float>* times)
{
    if (input.components != 1 || input.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || input.count == 0) {
        return loader.fail(vt_errorFormat, "%s has %zu times that are no floats or none" GLTF_DAMAGED,
                           what.c_str(), input.count);
    }
    for (size_t i = 0; i < input.count; ++i) {
        const float time = readNumber(input, i, 0);
        if (!std::isfinite(time) || (i > 0 && time < times->back())) {
            return loader.fail(vt_errorFormat,
                               "%s has the time %g after %g, but times must be finite and rise" GLTF_DAMAGED,
                               what.c_str(), (double)time, i > 0 ? (double)times->back() : 0.0);
        }
        times->push_back(time);
    }
    return true;
}

static bool readValues(Loader& loader, const std::string& what, const Stream& output, Kept<float>* values)
{
    if (output.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !output.normalized) {
        return loader.fail(vt_errorFormat,
                           "%s has values that are neither floats nor normalized numbers" GLTF_DAMAGED,
                           what.c_str());
    }
    values->reserve(output.count * (size_t)output.components);
    for (size_t i = 0; i < output.count; ++i) {
        for (size_t k = 0; k < (size_t)output.components; ++k) {
            const float value = readNumber(output, i, k);
            if (!std::isfinite(value)) {
                return loader.fail(vt_errorFormat, "%s has a value that is not finite" GLTF_DAMAGED,
                                   what.c_str());
            }
            values->push_back(value);
        }
    }
    return true;
}

static bool findKind(Loader& loader, const std::string& what, const std::string& how, Curve::Kind* kind)
{
    *kind = how == "STEP"          ? Curve::Kind::step
            : how == "CUBICSPLINE" ? Curve::Kind::cubic
                                   : Curve::Kind::linear;
    return *kind != Curve::Kind::linear || how == "" || how == "LINEAR" ||
           loader.fail(vt_errorFormat,
                       "%s has the interpolation '%s', which is none of STEP, LINEAR and "
                       "CUBICSPLINE" GLTF_DAMAGED,
                       what.c_str(), quotable(how).c_str());
}

/// Reads a sampler of values of so many numbers, 0: there can be none.
static bool readCurve(Loader& loader, const std::string& what, const Json& sampler, bool isWeights,
                      size_t components, Curve* curve)
{
    Stream input, output;
    if (!findKind(loader, what, textOf(sampler, "interpolation"), &curve->kind) ||
        !openAccessor(loader, indexOf(sampler, "input"), &input) ||
        !openAccessor(loader, indexOf(sampler, "output"), &output)) {
        return false;
    }
    const uint64_t values = (uint64_t)input.count * (curve->kind == Curve::Kind::cubic ? 3 : 1) * components;
    const size_t shape = isWeights ? 1 : components;
    if (components == 0 || (size_t)output.components != shape || output.count * (uint64_t)shape != values) {
        return loader.fail(vt_errorFormat,
                           "%s has %zu values of %d numbers for %zu keys of %zu numbers" GLTF_DAMAGED,
                           what.c_str(), output.count, output.components, input.count, components);
    }
    curve->components = components;
    // Where all of them were not counted before.
    return (VT_WITH_FILES || loader.spend(sizeof(float) * (input.count + values), what)) &&
           readTimes(loader, what, input, &curve->times) && readValues(loader, what, output, &curve->values);
}

// ---------------------------------------------------------------------------------------------- channels

#define FIELD(name) offsetof(vtMaterial, name)
static const Factor factors[] = {
    {"pbrMetallicRoughness/baseColorFactor", 4, FIELD(baseColor), FIELD(tint), 0, 1, false, false},
    {"pbrMetallicRoughness/metallicFactor", 1, FIELD(metallic), 0, 0, 1, false, false},
    {"pbrMetallicRoughness/roughnessFactor", 1, FIELD(roughness), 0, 0, 1, false, false},
    {"emissiveFactor", 3, FIELD(emissive), 0, 0, FLT_MAX, false, true},
    {"alphaCutoff", 1, FIELD(alphaCutoff), 0, 0, 1, false, false},
    {"extensions/KHR_materials_transmission/transmissionFactor", 1, FIELD(transmission), 0, 0, 1, true,
     false},
    {"extensions/KHR_materials_ior/ior", 1, FIELD(ior), 0, 1, 4, false, false},
    {"extensions/KHR_materials_volume/attenuationColor", 3, FIELD(attenuationColor), 0, 0, 1, true, false},
    {"extensions/KHR_materials_volume/attenuationDistance", 1, FIELD(attenuationDistance), 0, 0, FLT_MAX,
     true, false},
    {"extensions/KHR_materials_dispersion/dispersion", 1, FIELD(dispersion), 0, 0, 20, true, false},
};

/// Splits "/nodes/3/scale" into "nodes", 3 and "scale"; false where it has no such form.
static bool splitPointer(const std::string& pointer, std::string* list, size_t* index, std::string* rest)
{
    const size_t first = pointer.find('/', 1), second = pointer.find('/', first + 1);
    if (pointer.empty() || pointer[0] != '/' || first == std::string::npos || second == std::string::npos ||
        second == first + 1 || second > first + 10) {
        return false;
    }
    *index = 0;
    for (size_t i = first + 1; i < second; ++i) {
        if (pointer[i] < '0' || pointer[i] > '9') {
            return false;
        }
        *index = 10 * *index + (size_t)(pointer[i] - '0');
    }
    *list = pointer.substr(1, first - 1);
    *rest = pointer.substr(second + 1);
    return true;
}

static const char* const paths[] = {"translation", "rotation", "scale", "weights"};

static bool findPath(const std::string& name, Path* path)
{
    const auto at = std::find(std::begin(paths), std::end(paths), name);
    *path = (Path)(at - std::begin(paths));
    return at != std::end(paths);
}

/// What a channel moves; *known false: nothing that can be played.
static bool aim(Loader& loader, const Json& given, Channel* channel, bool* known)
{
    const auto target = given.find("target");
    *known = false;
    if (target == given.end()) {
        return true;
    }
    std::string list, path = textOf(*target, "path");
    const int node = indexOf(*target, "node");
    size_t index = (size_t)std::max(node, 0);
    *known = node >= 0;
    if (path == "pointer") {
        const auto extensions = target->find("extensions");
        const bool has = extensions != target->end() && !extensions->empty();
        *known = has && splitPointer(textOf(*extensions->begin(), "pointer"), &list, &index, &path);
        if (*known && list == "materials") {
            const Factor* at = std::find_if(std::begin(factors), std::end(factors),
                                            [&](const Factor& factor) { return path == factor.pointer; });
            channel->path = Path::factor;
            channel->factor = at != std::end(factors) ? at : nullptr;
            channel->target = index;
            *known = channel->factor != nullptr;
            return !*known || loader.has("material", (int)index, loader.model.materials.size());
        }
        *known = *known && list == "nodes";
    }
    *known = *known && findPath(path, &channel->path);
    channel->target = index;
    return !*known || loader.has("node", (int)index, loader.model.nodes.size());
}

size_t targetCountOf(const tinygltf::Mesh& mesh)
{
    return mesh.primitives.empty() ? 0 : mesh.primitives[0].targets.size();
}

/// Numbers of a value of what the channel moves; 0: the node has no morph targets.
static size_t componentsOf(const Loader& loader, const Channel& channel)
{
    if (channel.path == Path::factor) {
        return channel.factor->components;
    }
    if (channel.path != Path::weights) {
        return channel.path == Path::rotation ? 4 : 3;
    }
    const int mesh = loader.model.nodes[channel.target].mesh;
    return mesh >= 0 && (size_t)mesh < loader.model.meshes.size()
               ? targetCountOf(loader.model.meshes[(size_t)mesh])
               : 0;
}

/// Have its rotations some length?
static bool checkRotations(Loader& loader, const std::string& what, const Curve& curve)
{
    const size_t step = curve.kind == Curve::Kind::cubic ? 12 : 4;
    for (size_t i = step == 12 ? 4 : 0; i < curve.values.size(); i += step) {
        const float* q = &curve.values[i];
        if (!(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] > 0.0f)) {
            return loader.fail(vt_errorFormat, "%s has a rotation of zero length" GLTF_DAMAGED, what.c_str());
        }
    }
    return true;
}

static bool addChannel(Loader& loader, const std::string& name, const Json& given, const Json& from,
                       Animation* animation)
{
    Channel channel = {};
    bool known = false;
    const int number = indexOf(from, "sampler");
    const Json* sampler = entryOf(given, "samplers", number);
    if ((sampler == nullptr &&
         !loader.has("sampler", number, given.contains("samplers") ? given["samplers"].size() : 0)) ||
        !aim(loader, from, &channel, &known)) {
        return false;
    }
    if (!known) {
        ++loader.unplayed;
        return true;
    }
    const std::string what = name + ", sampler " + std::to_string(number) + ",";
    Curve curve;
    if (!readCurve(loader, what, *sampler, channel.path == Path::weights, componentsOf(loader, channel),
                   &curve) ||
        (channel.path == Path::rotation && !checkRotations(loader, what, curve))) {
        return false;
    }
    animation->facts.duration = std::fmax(animation->facts.duration, (double)curve.times.back());
    if (channel.path != Path::factor) {
        loader.rig.nodes[channel.target].animated |= 1u << (int)channel.path;
    }
    channel.curve = animation->curves.size();
    animation->curves.push_back(std::move(curve));
    animation->channels.push_back(channel);
    return true;
}

/// Counts what all channels will take, before any is read: a view may be read by many samplers, and zeros
/// take nothing of the file.
static bool spendAnimations(Loader& loader, const Json& animations)
{
    const std::vector<tinygltf::Accessor>& accessors = loader.model.accessors;
    uint64_t numbers = 0;
    for (const Json& given : animations) {
        const Json* channel;
        for (int k = 0; (channel = entryOf(given, "channels", k)) != nullptr; ++k) {
            const Json* sampler = entryOf(given, "samplers", indexOf(*channel, "sampler"));
            for (const char* key : {"input", "output"}) {
                const int index = sampler != nullptr ? indexOf(*sampler, key) : -1;
                const bool isThere = index >= 0 && (size_t)index < accessors.size();
                const tinygltf::Accessor* accessor = isThere ? &accessors[(size_t)index] : nullptr;
                const int each = isThere ? tinygltf::GetNumComponentsInType((uint32_t)accessor->type) : 0;
                numbers += isThere && each > 0 ? accessor->count * (uint64_t)each : 0;
            }
        }
    }
    return loader.spend(sizeof(float) * numbers, "what its animations read");
}

bool readAnimations(Loader& loader, const Json& animations)
{
    loader.rig.nodes.resize(loader.model.nodes.size());
    if (!VT_IS_FULL) {
        return true; // a page loads the larger core for them
    }
    if (VT_WITH_FILES && !spendAnimations(loader, animations)) {
        return false;
    }
    loader.rig.animations.resize(animations.size());
    for (size_t i = 0; i < animations.size(); ++i) {
        const Json& given = animations[i];
        const std::string name = quotable(textOf(given, "name"));
        Animation& animation = loader.rig.animations[i];
        animation.name = name.c_str();
        const Json* channel;
        for (int k = 0; (channel = entryOf(given, "channels", k)) != nullptr; ++k) {
            if (!addChannel(loader, "animation " + label((int)i, name), given, *channel, &animation)) {
                return false;
            }
        }
    }
    return true;
}

bool aimFactors(Loader& loader, const std::vector<uint32_t>& materialOf)
{
    Rig& rig = loader.rig;
    const vtScene* scene = loader.scene;
    for (Animation& animation : rig.animations) {
        Kept<Channel> played;
        for (Channel channel : animation.channels) {
            if (channel.path == Path::factor) {
                const size_t given = channel.target;
                const uint32_t made = materialOf[given + 1];
                const vtMaterial* material = made < scene->materialCount ? &scene->materials[made] : nullptr;
                // What is no glass at rest does not become it, and what was made glass is clear.
                if (material == nullptr || scene->allGlass || (channel.factor->glass && material->opaque)) {
                    loader.unplayed += material != nullptr;
                    continue;
                }
                channel.target = made;
                channel.strength =
                    channel.factor->timesEmissive ? emissiveStrengthOf(loader.model.materials[given]) : 1.0f;
                rig.materials.assign(scene->materials, scene->materials + scene->materialCount);
            }
            played.push_back(channel);
        }
        animation.channels = std::move(played);
    }
    return true;
}

} // namespace vtGltf
