// KHR_materials_variants: other materials for primitives, by the name of a variant.

#include "gltf/gltf.h"

namespace vtGltf
{

static const char* const extensionName = "KHR_materials_variants";

bool findVariant(Loader& loader, int* variant)
{
    const char* wanted = loader.def->variant;
    *variant = -1;
    if (wanted == nullptr || wanted[0] == '\0') {
        return true;
    }
    std::string names;
    for (size_t i = 0; i < loader.variants.size(); ++i) {
        if (loader.variants[i] == wanted) {
            *variant = (int)i;
            return true;
        }
        names += (names.empty() ? "'" : ", '") + quotable(loader.variants[i]) + "'";
    }
    return loader.fail(vt_errorArgument, "it has no variant '%s'; %s%s", quotable(wanted).c_str(),
                       names.empty() ? "it has none at all" : "it has ", names.c_str());
}

int materialOf(const tinygltf::Primitive& primitive, int variant)
{
    const auto at = primitive.extensions.find(extensionName);
    if (variant < 0 || at == primitive.extensions.end() || !at->second.IsObject() ||
        !at->second.Has("mappings") || !at->second.Get("mappings").IsArray()) {
        return primitive.material;
    }
    const tinygltf::Value& mappings = at->second.Get("mappings");
    for (int i = 0; i < (int)mappings.ArrayLen(); ++i) {
        const tinygltf::Value& mapping = mappings.Get(i);
        const bool good = mapping.IsObject() && mapping.Has("material") &&
                          mapping.Get("material").IsNumber() && mapping.Has("variants") &&
                          mapping.Get("variants").IsArray();
        for (int k = 0; good && k < (int)mapping.Get("variants").ArrayLen(); ++k) {
            const tinygltf::Value& number = mapping.Get("variants").Get(k);
            if (number.IsNumber() && number.GetNumberAsDouble() == (double)variant) {
                return mapping.Get("material").GetNumberAsInt();
            }
        }
    }
    return primitive.material;
}

} // namespace vtGltf
