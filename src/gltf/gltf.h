// The steps of vtOpenModel, one file each. Internal: callers use vtOpenModel and vtLoadScene.
#pragma once

#include "gltf/rig.h"

extern "C" {
#include "base/limits.h"
#include "base/memory.h"
#include "gltf/features.h"
}

// The same wherever tinygltf's types are seen; gltf_document.cpp alone holds its code.
#define TINYGLTF_NOEXCEPTION
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
// A program that links Vitrine may have another tinygltf and nlohmann-json, or the same with other switches:
// ours get names of their own.
#define tinygltf vtTinygltf
#define nlohmann vtNlohmann
#include <tiny_gltf.h>

#include <memory>

/// How sentences end about what only whoever made the file can mend.
#define GLTF_DAMAGED "; the file is damaged, export it again"

namespace vtGltf
{

struct Bytes {
    const uint8_t* data = nullptr;
    size_t size = 0;
};

/// An accessor whose every element is known to lie inside its bytes.
struct Stream {
    const uint8_t* data = nullptr;
    size_t count = 0, stride = 0;
    int componentType = 0, components = 0;
    bool normalized = false; // whole numbers stand for 0 to 1, or -1 to 1
};

/// Gives back what vtAllocate gave.
struct Free {
    void operator()(void* memory) const
    {
        vtFree(memory);
    }
};
template <typename T> using Block = std::unique_ptr<T[], Free>;

/// Streams of attributes that were unpacked, by their names.
using Streams = std::vector<std::pair<std::string, Stream>>;

/// What a morph target adds to each vertex, times its weight.
struct Target {
    size_t index; // of its weight
    Stream positions, normals;
};

/// Joints of each vertex and their weights, four of each.
struct Influence {
    Stream joints, weights;
};

/// A checked primitive with triangles.
struct Part {
    // A stream without data: the primitive has none.
    Stream positions, normals, texcoords, texcoords1, tangents, colors, indices;
    std::vector<Target> targets = {}; // of weights that are animated, or other than 0
    std::vector<Influence> influences = {};
    int mode = TINYGLTF_MODE_TRIANGLES; // or a strip or a fan
    size_t triangleCount = 0;
    int material = -1; // of the file; -1: glTF's default
};

/// A mesh of the file in one shape: nodes may give it other weights of its morph targets, or a skin.
struct Source {
    int mesh;
    std::vector<double> weights = {};
    int skin = -1;
    int node = -1; // whose animated weights they are, or none
    std::vector<Part> parts = {};
    std::vector<uint32_t> meshes = {}, materials = {}; // what became of it in the scene, as many of each
    std::vector<uint8_t> bounds = {};                  // 1: those that bound one body together
};

/// A picture of a material.
struct TextureUse {
    vtMapUse use;
    int texture, texCoord;
    float rows[2][3] = {{1, 0, 0}, {0, 1, 0}}; // as vtMap's
};

/// A skin of the file.
struct Skin {
    std::vector<int> joints = {};
    int inverseBindMatrices = -1;
};

/// What an extension says of a compressed buffer view.
struct Compressed {
    std::string extension = {}; // empty: it is not compressed
    int buffer = 0;
    size_t byteOffset = 0, byteLength = 0, byteStride = 0, count = 0;
    std::string mode = {}, filter = {};
    Bytes decoded = {}; // once it is needed
};

/// A picture of the file: at an address, or in a buffer view.
struct Picture {
    std::string name = {}, uri = {};
    int bufferView = -1;
    int image = -1;                     // in the scene
    std::vector<uint8_t> contents = {}; // of a file or an address, until it is decoded
    Bytes bytes = {};
    bool isChecked = false; // it was opened and its header looked at
};

/// A source, a camera or a light of the file where a node puts it.
struct Placement {
    int node, what;
    Matrix toWorld;
    Matrix instance = {}; // within the node
    bool isFixed = false; // not by the node, but by joints
};

/// What one call of vtOpenModel has so far.
struct Loader : Report {
    const vtModelDef* def;
    vtScene* scene;
    bool keeps; // what animations move
    Rig rig = {};
    tinygltf::Model model = {}; // without its buffers and images, which are these:
    std::vector<Bytes> buffers = {};
    std::vector<std::vector<uint8_t>> ownedBuffers = {}; // bytes that `def` does not hold
    vtLimits limits = vtResolveLimits(&def->limits);
    vtLimits left = limits;                  // of memory and triangles
    std::vector<Compressed> compressed = {}; // as many as model.bufferViews, or none
    std::vector<Skin> skins = {};
    std::vector<size_t> reachedNodes = {}; // of the scene, in the order in which it names them
    std::vector<Picture> pictures = {};
    std::vector<Source> sources = {};
    std::vector<std::vector<int>> sourcesOf = {}; // each mesh of the file
    std::vector<int> reached = {}; // sources with triangles, in the order in which nodes name them
    std::vector<Placement> objects = {}, cameras = {}, lights = {};
    size_t animationCount = 0, lightCount = 0, unplayed = 0;          // the latter: channels of animations
    std::vector<std::string> variants = {}, used = {}, required = {}; // the latter: extensions
    std::vector<std::string> ignored = {};                            // what noteIgnored was told
    std::string notes = {};                                           // what note was told, a line each
    int variant = -1;                                                 // of `variants`
    int primitivesWithoutTriangles = 0, turnedMeshes = 0;
    std::vector<int> parents = {};    // of each node, -1 where it has none; the last that names it
    std::vector<uint8_t> placed = {}; // is the node in rig.order?

    /// Tells what is left out of the picture: "normal maps of 2 materials". All that a file leaves out makes
    /// one line.
    void noteIgnored(const char* format, ...) VT_PRINTF(2, 3);

    /// Tells what else is worth knowing, a line by itself: "2 meshes were inside out".
    void note(const char* format, ...) VT_PRINTF(2, 3);

    /// Is so much memory left, for what is given back soon? Else fails.
    bool canSpend(uint64_t bytes, const std::string& what);

    /// Takes bytes off what is left of the memory, or fails where it is used up.
    bool spend(uint64_t bytes, const std::string& what);

    /// Is so many triangles what a whole file may have? Else fails.
    bool canHaveTriangles(uint64_t count);

    /// Takes triangles off what is left of them, or fails.
    bool spendTriangles(uint64_t count);

    /// Is `index` one of `count`? Else fails.
    bool has(const char* what, int index, size_t count);

    /// An array of zeros for the scene, which frees it.
    template <typename T> bool allocate(size_t count, T** array)
    {
        *array = (T*)vtAllocateZeroed(count, sizeof(T));
        return *array != nullptr ||
               fail(vt_errorMemory, "no memory for %zu objects; simplify the scene", count);
    }
};

/// Text out of a file, fit for a sentence: one line, not long, without what commands a terminal.
std::string quotable(std::string text);

/// A library's sentence, fit for a part of ours.
std::string withoutStop(std::string sentence);

/// "3", or "3, cup" of what has a name.
std::string label(int index, const std::string& name);

uint32_t readU32(const uint8_t* p);
uint32_t readIndex(const Stream& indices, size_t i);

/// Component k of element i, of any type.
float readNumber(const Stream& stream, size_t i, size_t k);

/// "2 materials", "1 material".
std::string counted(size_t count, const char* what);

/// Fills model, buffers and pictures. `bin` is the container's BIN chunk, if any.
bool parseDocument(Loader& loader, Bytes text, Bytes bin);

/// Fails where the structure of a JSON text would take too much memory once it is parsed.
bool checkStructure(Loader& loader, Bytes text);

/// Reads the file at a uri that is none of data; `what` is a buffer or a picture.
bool readExternal(Loader& loader, const char* what, const std::string& uri, std::vector<uint8_t>* bytes);

/// The bytes of a data URI.
bool decodeDataUri(const std::string& uri, std::vector<uint8_t>* bytes);

/// Opens the first `length` bytes of a buffer view of the file, or all; `what` reads them.
const uint64_t wholeView = UINT64_MAX;
bool openView(Loader& loader, const std::string& what, int index, uint64_t length, Bytes* bytes);

/// Opens an accessor of the file, of any type; `what` is told of in sentences.
bool openAccessor(Loader& loader, int index, Stream* stream);

/// Unpacks a buffer view (EXT_meshopt_compression) into *decoded.
bool decodeView(Loader& loader, const std::string& what, const Compressed& view, Bytes packed,
                std::vector<uint8_t>* decoded);

/// Unpacks a primitive (KHR_draco_mesh_compression): streams for its attributes, and "" for the indices.
bool decodePrimitive(Loader& loader, const tinygltf::Primitive& primitive, Streams* streams);

/// Fills the bytes of a picture, and its contents where they lie in no buffer.
bool openPicture(Loader& loader, int index);

/// The number of a texture's picture: that of an extension which is drawn (features.h), else the texture's
/// own.
bool findTextureSource(Loader& loader, int index, int* source);

/// Once the scene has materials: tells the channels that move them which they are.
bool aimFactors(Loader& loader, const std::vector<uint32_t>& materialOf);

/// Fills the rig's nodes and their order from the scene, all at rest; and skins as they are used.
bool placeNodes(Loader& loader);
bool openSkin(Loader& loader, int index);

/// Morph targets of a mesh: those of its first primitive, says the standard.
size_t targetCountOf(const tinygltf::Mesh& mesh);

/// Fills sources, reached, objects, cameras and lights from the nodes that are placed.
bool collectNodes(Loader& loader);

/// The transforms of an EXT_mesh_gpu_instancing; *found is false where the node has none.
bool readInstances(Loader& loader, int node, bool* found, std::vector<Matrix>* instances);

/// The number of the variant that is asked for; -1: none is. Fails where the file has none of that name.
bool findVariant(Loader& loader, int* variant);

/// The material of a primitive in that variant.
int materialOf(const tinygltf::Primitive& primitive, int variant);

/// Counts what a primitive will take by the numbers of its accessors, before any of them is read.
bool spendPrimitive(Loader& loader, const tinygltf::Primitive& primitive, const Source& source);

/// Checks a primitive and adds it to the parts of the source, unless it has no triangles.
bool addPrimitive(Loader& loader, const tinygltf::Primitive& primitive, Source* source);

/// The parts of one mesh to be, and what they have together.
struct Group {
    std::vector<const Part*> parts = {};
    unsigned long long vertexCount = 0, indexCount = 0;
    bool hasNormals = false, hasTexcoords = false, hasTexcoords1 = false, hasColors = false;
    bool hasAlphas = false, hasTangents = true; // of every part
};

/// What moves a group's vertices, at rest: `positions` and `normals` (or null) are theirs.
Shape makeShape(const Loader& loader, const Source& source, const Group& group, const float* positions,
                const float* normals);

/// The pictures of a material that are drawn.
std::vector<TextureUse> texturesOf(const tinygltf::Material& material);

/// The sets of texture coordinates that they lie by, two at most: a mesh keeps no more.
std::vector<int> texcoordSetsOf(const tinygltf::Material& material);

/// Reads the headers of a material's pictures and counts what they will take.
bool checkMaps(Loader& loader, const tinygltf::Material& given);

/// Fills the material's maps, and the scene's images with their pictures.
bool openMaps(Loader& loader, const tinygltf::Material& given, vtMaterial* material);

/// KHR_materials_emissive_strength, or 1.
float emissiveStrengthOf(const tinygltf::Material& material);

/// Fills the scene's materials and images; materialOf[i + 1] is the scene's for the file's material i.
bool makeMaterials(Loader& loader, std::vector<uint32_t>* materialOf);

/// Fills the scene's meshes: one for the parts of a source that have the same material.
bool makeMeshes(Loader& loader, const std::vector<uint32_t>& materialOf);

/// Fails for that many objects.
bool failObjects(Loader& loader, size_t count);

/// Makes solid what by the standard are thin walls, where the file is nothing but closed bodies of such
/// glass: its author meant glass, and most exporters leave the volume out.
bool guessSolid(Loader& loader);

/// Fill the scene's objects and cameras.
bool makeObjects(Loader& loader);
bool makeCameras(Loader& loader);

/// Fills the scene's lights (KHR_lights_punctual).
bool makeLights(Loader& loader);

/// The materials of the file that the scene uses, each once; -1: glTF's default.
std::vector<int> listMaterials(const Loader& loader);

/// Has the material the extension of that name?
bool usesFeature(const tinygltf::Material& material, const vtGltfFeature& feature);

/// Fills the scene's notes.
bool makeNotes(Loader& loader);

/// Loads as vtOpenModel does, the rig with what it moves where the loader keeps it.
vtResult load(Loader& loader);

/// Calls load, then `done`, which returns false after a failure; null: nothing. Nothing that is thrown leaves
/// it; on failure the scene is empty.
vtResult loadSafely(const vtModelDef* def, vtScene* scene, bool keeps, vtError* error,
                    bool (*done)(Loader& loader, void* result), void* result);

} // namespace vtGltf
