// glTF 2.0 to a scene, through tinygltf.
//
// tinygltf 2.7 turns JSON into structs but trusts the file in places (a GLB's BIN chunk is read 8 bytes too
// far, an embedded picture is taken from wherever its offset points, an empty buffer aborts without
// exceptions, an index above 2^32 wraps round, deep nesting overflows the stack). So it is given only what
// was looked through: the container is split here, JSON, buffers and pictures are gltf_document.cpp's, and
// nothing that tinygltf returns is used as an index or an offset before it was checked.

#include "gltf/gltf.h"

#include <cstring>
#include <new>

namespace vtGltf
{

/// Splits a .glb into its JSON and BIN chunks; BIN may be absent.
static bool splitGlb(Loader& loader, Bytes file, Bytes* text, Bytes* bin)
{
    const size_t fileHeader = 12, chunkHeader = 8;
    if (file.size < fileHeader) {
        return loader.fail(vt_errorFormat,
                           "a .glb of %zu bytes ends within its header; it is truncated, copy it again",
                           file.size);
    }
    const uint32_t version = readU32(file.data + 4), length = readU32(file.data + 8);
    if (version != 2) {
        return loader.fail(vt_errorFormat,
                           "the .glb has version %u but only 2 is supported; export it as glTF 2.0", version);
    }
    if (length > file.size) {
        return loader.fail(vt_errorFormat,
                           "the .glb should have %u bytes but has %zu; it is truncated, copy it again",
                           length, file.size);
    }
    for (size_t at = fileHeader; at < length;) {
        const uint8_t* header = file.data + at;
        if (length - at < chunkHeader || readU32(header) > length - at - chunkHeader) {
            return loader.fail(vt_errorFormat,
                               "the chunk at byte %zu reaches beyond the end of the .glb" GLTF_DAMAGED, at);
        }
        const Bytes chunk = {header + chunkHeader, readU32(header)};
        if (at == fileHeader && memcmp(header + 4, "JSON", 4) == 0) {
            *text = chunk;
        } else if (at > fileHeader && memcmp(header + 4, "BIN\0", 4) == 0 && bin->data == nullptr) {
            *bin = chunk;
        } // other chunks are for others, says the standard
        at += chunkHeader + chunk.size;
    }
    return text->data != nullptr ||
           loader.fail(vt_errorFormat, "the .glb does not begin with a JSON chunk" GLTF_DAMAGED);
}

static bool splitFile(Loader& loader, Bytes* text, Bytes* bin)
{
    const Bytes file = {(const uint8_t*)loader.def->bytes, loader.def->size};
    if (file.size == 0) {
        return loader.fail(vt_errorFormat, "the file is empty; give a .glb or .gltf file");
    }
    if (file.size >= 4 && memcmp(file.data, "glTF", 4) == 0) {
        return splitGlb(loader, file, text, bin);
    }
    size_t first = file.size >= 3 && memcmp(file.data, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0; // byte order mark
    while (first < file.size && memchr(" \t\r\n", file.data[first], 4) != nullptr) {
        ++first;
    }
    if (first == file.size || file.data[first] != '{') {
        return loader.fail(
            vt_errorFormat,
            "the file is not glTF (it begins neither with 'glTF' nor with '{'); give a .glb or .gltf file");
    }
    *text = file;
    return true;
}

vtResult load(Loader& loader)
{
    Bytes text, bin;
    std::vector<uint32_t> materialOf;
    return splitFile(loader, &text, &bin) && parseDocument(loader, text, bin) &&
                   findVariant(loader, &loader.variant) && placeNodes(loader) && collectNodes(loader) &&
                   makeMaterials(loader, &materialOf) && aimFactors(loader, materialOf) &&
                   makeMeshes(loader, materialOf) && guessSolid(loader) && makeObjects(loader) &&
                   makeCameras(loader) && makeLights(loader) && makeNotes(loader)
               ? vtSucceed(loader.error)
               : loader.result;
}

vtResult loadSafely(const vtModelDef* def, vtScene* scene, bool keeps, vtError* error,
                    bool (*done)(Loader& loader, void* result), void* result)
{
    const char* name = def->name != nullptr ? def->name : "";
    vtResult outcome;
    *scene = vtScene{};
#ifdef __cpp_exceptions
    try {
#endif
        Loader loader = {{name, error}, def, scene, keeps};
        outcome = load(loader) == vt_ok && (done == nullptr || done(loader, result)) ? vt_ok : loader.result;
#ifdef __cpp_exceptions
    } catch (const std::bad_alloc&) {
        outcome = vtFail(error, vt_errorMemory, "model '%.200s': out of memory; simplify it", name);
    } catch (...) {
        outcome = vtFail(error, vt_errorFormat, "model '%.200s': it cannot be read" GLTF_DAMAGED, name);
    }
#endif
    if (outcome != vt_ok) {
        vtDestroyScene(scene);
    }
    return outcome;
}

} // namespace vtGltf

extern "C" vtResult vtLoadScene(const vtModelDef* def, vtScene* scene, vtError* error)
{
    if (def == nullptr || scene == nullptr) {
        return vtFailMissing(error, "vtLoadScene", def == nullptr ? "def" : "scene");
    }
    *scene = vtScene{};
    if (def->bytes == nullptr && def->size > 0) {
        return vtFailMissing(error, "vtLoadScene", "def->bytes");
    }
    return vtGltf::loadSafely(def, scene, false, error, nullptr, nullptr);
}
