// Vertices as morph targets and skins put them: first what they are moved by, taken from the file's streams,
// then how they are moved.

#include "gltf/gltf.h"

#include <algorithm>
#include <cmath>

namespace vtGltf
{

// --------------------------------------------------------------------------------------------- shapes

/// A stream's numbers, three a vertex, from `first` on.
static void copyVectors(const Stream& stream, size_t first, Kept<float>* to)
{
    for (size_t i = 0; stream.data != nullptr && i < 3 * stream.count; ++i) {
        (*to)[3 * first + i] = readNumber(stream, i / 3, i % 3);
    }
}

static void addMorphs(const Part& part, size_t first, Shape* shape)
{
    for (const Target& target : part.targets) {
        auto at = std::find_if(shape->morphs.begin(), shape->morphs.end(),
                               [&](const Morph& morph) { return morph.index == target.index; });
        if (at == shape->morphs.end()) {
            at = shape->morphs.insert(at, Morph{target.index});
            at->positions.resize(shape->positions.size());
            at->normals.resize(shape->normals.size());
        }
        copyVectors(target.positions, first, &at->positions);
        if (part.normals.data != nullptr) { // else they are computed
            copyVectors(target.normals, first, &at->normals);
        }
    }
}

/// Joints and weights of a part's vertices. Where all weights are 0 it is the first joint alone.
static void addInfluences(const Part& part, size_t first, size_t jointCount, Shape* shape)
{
    for (size_t i = 0; i < part.positions.count && !part.influences.empty(); ++i) {
        uint32_t* joints = &shape->joints[shape->influenceCount * (first + i)];
        float* weights = &shape->weights[shape->influenceCount * (first + i)];
        double sum = 0.0;
        for (size_t k = 0; k < 4 * part.influences.size(); ++k) {
            const Influence& influence = part.influences[k / 4];
            const float joint = readNumber(influence.joints, i, k % 4);
            joints[k] = joint >= 0.0f && joint < (float)jointCount ? (uint32_t)joint : (uint32_t)jointCount;
            weights[k] = readNumber(influence.weights, i, k % 4);
            sum += (double)weights[k];
        }
        for (size_t k = 0; k < 4 * part.influences.size(); ++k) {
            weights[k] = sum != 0.0 ? (float)((double)weights[k] / sum) : k == 0 ? 1.0f : 0.0f;
        }
    }
}

Shape makeShape(const Loader& loader, const Source& source, const Group& group, const float* positions,
                const float* normals)
{
    Shape shape;
    const size_t vertexCount = (size_t)group.vertexCount;
    shape.node = source.node;
    shape.skin = source.skin;
    shape.positions.assign(positions, positions + 3 * vertexCount);
    if (normals != nullptr) {
        shape.normals.assign(normals, normals + 3 * vertexCount);
    }
    for (const Part* part : group.parts) {
        shape.influenceCount = std::max(shape.influenceCount, 4 * part->influences.size());
    }
    const size_t jointCount = source.skin >= 0 ? loader.rig.skins[(size_t)source.skin].nodes.size() : 0;
    shape.joints.resize(shape.influenceCount * vertexCount, (uint32_t)jointCount);
    shape.weights.resize(shape.influenceCount * vertexCount, 0.0f);
    for (size_t i = 0; i < shape.weights.size(); i += shape.influenceCount) {
        shape.weights[i] = 1.0f; // of vertices that no joint moves
    }
    size_t first = 0;
    for (const Part* part : group.parts) {
        addMorphs(*part, first, &shape);
        addInfluences(*part, first, jointCount, &shape);
        first += part->positions.count;
    }
    shape.posedWeights.assign(source.weights.begin(), source.weights.end());
    if (shape.influenceCount > 0) {
        placeJoints(loader.rig, source.skin, &shape.posedJoints);
    }
    return shape;
}

// --------------------------------------------------------------------------------------------- posing

void placeJoints(const Rig& rig, int skin, Kept<Matrix>* joints)
{
    const Joints& from = rig.skins[(size_t)skin];
    joints->assign(from.nodes.size() + 1, Matrix());
    for (size_t i = 0; i < from.nodes.size(); ++i) {
        (*joints)[i] = multiply(rig.nodes[from.nodes[i]].toWorld, from.binds[i]);
    }
}

static void addScaled(const Kept<float>& numbers, double factor, float* to)
{
    for (size_t i = 0; i < numbers.size(); ++i) {
        to[i] += (float)(factor * (double)numbers[i]);
    }
}

/// The first three rows of the mean of the joints that a vertex hangs on, by their weights; column-major.
static void blend(const Shape& shape, size_t vertex, double* mean)
{
    std::fill_n(mean, 12, 0.0);
    for (size_t k = 0; k < shape.influenceCount; ++k) {
        const double weight = (double)shape.weights[shape.influenceCount * vertex + k];
        const double* m = shape.posedJoints[shape.joints[shape.influenceCount * vertex + k]].m;
        for (int i = 0; i < 12 && weight != 0.0; ++i) {
            mean[i] += weight * m[i + i / 3];
        }
    }
}

/// By the inverse transposed of 3 x 3 numbers, but for its length.
static void turnNormal(const double* m, float* n)
{
    // Cofactors, row by row.
    const double c[9] = {m[4] * m[8] - m[7] * m[5], m[7] * m[2] - m[1] * m[8], m[1] * m[5] - m[4] * m[2],
                         m[6] * m[5] - m[3] * m[8], m[0] * m[8] - m[6] * m[2], m[3] * m[2] - m[0] * m[5],
                         m[3] * m[7] - m[6] * m[4], m[6] * m[1] - m[0] * m[7], m[0] * m[4] - m[3] * m[1]};
    const double x = (double)n[0], y = (double)n[1], z = (double)n[2];
    double turned[3];
    for (int row = 0; row < 3; ++row) {
        turned[row] = c[3 * row] * x + c[3 * row + 1] * y + c[3 * row + 2] * z;
    }
    const double determinant = m[0] * c[0] + m[3] * c[1] + m[6] * c[2];
    const double square = turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2];
    const double length = std::sqrt(square) * (determinant < 0.0 ? -1.0 : 1.0);
    for (int row = 0; row < 3; ++row) {
        n[row] = (float)(length != 0.0 ? turned[row] / length : 0.0);
    }
}

void pose(const Shape& shape, float* positions, float* normals)
{
    std::copy(shape.positions.begin(), shape.positions.end(), positions);
    if (normals != nullptr) {
        std::copy(shape.normals.begin(), shape.normals.end(), normals);
    }
    for (const Morph& morph : shape.morphs) {
        const double weight = morph.index < shape.posedWeights.size() ? shape.posedWeights[morph.index] : 0.0;
        if (weight != 0.0) {
            addScaled(morph.positions, weight, positions);
            addScaled(morph.normals, weight, normals);
        }
    }
    for (size_t i = 0; shape.influenceCount > 0 && i < shape.positions.size() / 3; ++i) {
        double m[12];
        blend(shape, i, m);
        float* p = positions + 3 * i;
        const double x = (double)p[0], y = (double)p[1], z = (double)p[2];
        for (int row = 0; row < 3; ++row) {
            p[row] = (float)(m[row] * x + m[3 + row] * y + m[6 + row] * z + m[9 + row]);
        }
        if (normals != nullptr) {
            turnNormal(m, normals + 3 * i);
        }
    }
    for (size_t i = 0; shape.turnsNormals && i < shape.normals.size(); ++i) {
        normals[i] = -normals[i];
    }
}

} // namespace vtGltf
