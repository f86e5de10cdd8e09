// What is kept of a file that moves: its nodes, its animations, and what moves the vertices of its meshes. It
// needs none of the file's bytes. Internal: callers use vtModel.
#pragma once

#include "vitrine.h"

extern "C" {
#include "base/error.h"
}

#include <new>
#include <string>
#include <vector>

namespace vtGltf
{

#ifdef __cpp_exceptions
/// Memory from the library's allocator.
template <typename T> struct Allocator {
    using value_type = T;
    Allocator() = default;
    template <typename Other> Allocator(const Allocator<Other>&)
    {
    }
    T* allocate(size_t count)
    {
        T* memory = static_cast<T*>(vtAllocate(count, sizeof(T)));
        if (memory == nullptr) {
            throw std::bad_alloc();
        }
        return memory;
    }
    void deallocate(T* memory, size_t)
    {
        vtFree(memory);
    }
    template <typename Other> bool operator==(const Allocator<Other>&) const
    {
        return true;
    }
    template <typename Other> bool operator!=(const Allocator<Other>&) const
    {
        return false;
    }
};
template <typename T> using Kept = std::vector<T, Allocator<T>>;
using Text = std::basic_string<char, std::char_traits<char>, Allocator<char>>;
#else // a page has one allocator, and its wasm shall have one kind of vector
template <typename T> using Kept = std::vector<T>;
using Text = std::string;
#endif

/// Whom sentences about a file go to. A function that returns false has called `fail`.
struct Report {
    const char* name; // of the model
    vtError* error;
    vtResult result = vt_ok;

    /// Sets result and error; returns false.
    bool fail(vtResult why, const char* format, ...) VT_PRINTF(3, 4);
};

/// Column-major 4 x 4, as glTF has it.
struct Matrix {
    double m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

/// Column-major product.
Matrix multiply(const Matrix& a, const Matrix& b);

/// From translation, rotation (a quaternion, of any length but 0) and scale.
Matrix composeMatrix(const double translation[3], const double rotation[4], const double scale[3]);

// ------------------------------------------------------------------------------------------- animations

/// What a channel of an animation moves.
enum class Path { translation, rotation, scale, weights, factor };

/// A sampler: numbers over time.
struct Curve {
    enum class Kind { step, linear, cubic } kind = Kind::linear;
    size_t components = 0; // of a value; of cubic ones there are three values a key
    Kept<float> times = {}, values = {};
};

/// A number of materials that can move, as KHR_animation_pointer names it.
struct Factor {
    const char* pointer; // below "/materials/N/"
    size_t components;
    size_t offset, alsoAt;     // in vtMaterial; the latter 0: nowhere
    float least, most;         // what vtMaterial allows
    bool glass, timesEmissive; // of glass alone; times KHR_materials_emissive_strength
};

struct Channel {
    size_t curve;
    Path path;
    size_t target; // a node; of a factor, a material of the scene
    const Factor* factor = nullptr;
    float strength = 1.0f;
};

struct Animation {
    Text name = {};
    Kept<Curve> curves = {};
    Kept<Channel> channels = {};
    vtAnimation facts = {};
};

/// Writes the value at that time: components numbers, a rotation of unit length. Before the first key and
/// after the last one it is that key's.
void evaluate(const Curve& curve, bool isRotation, double seconds, double* value);

// ------------------------------------------------------------------------------------------------ nodes

/// A node's own transform, but for a matrix.
struct Local {
    double t[3] = {0, 0, 0}, r[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
};

struct Node {
    int parent = -1;
    bool hasMatrix = false;
    bool moves = false;    // some animation moves it, or a node above it
    unsigned animated = 0; // 1 << Path, of any animation
    Matrix matrix = {};    // else:
    Local rest = {}, now = {};
    Kept<double> weights = {}, weightsNow = {}; // of morph targets, where they are animated
    Matrix toWorld = {};
};

/// What puts a node's joints where they are.
struct Joints {
    Kept<size_t> nodes = {};
    Kept<Matrix> binds = {}; // from the mesh to the joint
    bool moves = false;
};

// --------------------------------------------------------------------------------------------- vertices

/// What a morph target adds to each vertex, times its weight.
struct Morph {
    size_t index; // of its weight
    Kept<float> positions = {}, normals = {};
};

/// What moves the vertices of a mesh of the scene.
struct Shape {
    uint32_t mesh = 0;
    int node = -1;                            // whose weights it has, where they are animated
    int skin = -1;                            // or none
    Kept<float> positions = {}, normals = {}; // before all that; without normals these are computed
    Kept<Morph> morphs = {};
    size_t influenceCount = 0;      // of each vertex
    Kept<uint32_t> joints = {};     // one past the last: none moves it
    Kept<float> weights = {};       // their sum at each vertex is 1
    bool turnsNormals = false;      // its triangles were inside out, and its normals
    int tangents = -1;              // the set of texture coordinates that they follow, or none
    Kept<double> posedWeights = {}; // as it was posed last
    Kept<Matrix> posedJoints = {};
};

/// Joints of the skin from the mesh to the world, and the unit for what no joint moves.
struct Rig;
void placeJoints(const Rig& rig, int skin, Kept<Matrix>* joints);

/// Moves vertices as posedWeights and posedJoints say; normals may be null.
void pose(const Shape& shape, float* positions, float* normals);

// ------------------------------------------------------------------------------------------------- rigs

/// An object, a camera or a light of the scene that a node moves.
struct Moved {
    uint32_t index;
    size_t node;
    Matrix instance = {};
};

struct Rig {
    Kept<Node> nodes = {};
    Kept<size_t> order = {}; // of nodes that are placed: those above come first
    Kept<Joints> skins = {}; // those that meshes of the scene have
    Kept<Animation> animations = {};
    Kept<Shape> shapes = {};
    Kept<Moved> objects = {}, cameras = {}, lights = {};
    Kept<vtMaterial> materials = {}; // at rest, where they are animated; else none
    double middle[3] = {0, 0, 0};    // of the scene at rest, which cameras look at
};

/// Places a node whose parent is placed.
void placeNode(Rig& rig, size_t node);

/// What the renderer can invert: the limits are those of vtValidateScene. `label`: the node, in sentences.
bool toTransform(Report& report, const std::string& label, const Matrix& toWorld, const vtMesh& mesh,
                 vtTransform* transform);

/// A camera's view from its place; its target lies at the depth of `middle`.
bool placeView(Report& report, const std::string& label, const Matrix& toWorld, const double middle[3],
               vtView* view);

/// A light shines along its own -z.
void placeLight(const Matrix& toWorld, vtLight* light);

/// Moves all that the rig has of the scene, animation -1: as at rest.
bool setTime(Report& report, Rig& rig, int animation, double seconds, const vtModelPlace& place,
             vtScene* scene);

} // namespace vtGltf
