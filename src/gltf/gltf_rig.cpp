// A file's scene at a time: curves are evaluated, nodes placed, vertices moved.
//
// This work is based on: Khronos. glTF 2.0 Specification, appendix C, Animation Sampler Interpolation Modes.
// Departure: what an animation scales to nothing keeps a ten-thousandth of its largest side, or a millionth
// of a unit, as nothing can be drawn that is flat.

#include "gltf/rig.h"

#include <algorithm>
#include <cmath>

namespace vtGltf
{

// ------------------------------------------------------------------------------------------------ curves

static double dot(const double* a, const double* b, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

/// The shorter way round between two unit quaternions, into `a`.
static void slerp(double* a, const double* b, double share)
{
    const double cosine = dot(a, b, 4), most = std::min(std::fabs(cosine), 1.0);
    const double sine = std::sqrt(1.0 - most * most), angle = std::atan2(sine, most),
                 sign = cosine < 0.0 ? -1.0 : 1.0;
    const bool isNear = sine < 1e-6; // a straight line is as good
    const double first = isNear ? 1.0 - share : std::sin((1.0 - share) * angle) / sine;
    const double second = (isNear ? share : std::sin(share * angle) / sine) * sign;
    for (int i = 0; i < 4; ++i) {
        a[i] = first * a[i] + second * b[i];
    }
}

static void normalize(double* q)
{
    const double length = std::sqrt(dot(q, q, 4));
    for (int i = 0; i < 4; ++i) {
        q[i] = length > 0.0 ? q[i] / length : i == 3 ? 1.0 : 0.0;
    }
}

/// Number i of Hermite's spline between the keys k and k + 1.
static double spline(const Curve& curve, size_t k, size_t i, double share)
{
    const size_t n = curve.components;
    const float *here = &curve.values[3 * n * k + i], *next = &curve.values[3 * n * (k + 1) + i];
    const double width = (double)curve.times[k + 1] - (double)curve.times[k];
    const double s = share, s2 = s * s, s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * (double)here[n] + width * (s3 - 2 * s2 + s) * (double)here[2 * n] +
           (3 * s2 - 2 * s3) * (double)next[n] + width * (s3 - s2) * (double)next[0];
}

void evaluate(const Curve& curve, bool isRotation, double seconds, double* value)
{
    const bool isCubic = curve.kind == Curve::Kind::cubic;
    const size_t n = curve.components, keys = curve.times.size(), stride = isCubic ? 3 * n : n;
    const auto after = std::upper_bound(curve.times.begin(), curve.times.end(), seconds,
                                        [](double a, float b) { return a < (double)b; });
    const size_t next = (size_t)(after - curve.times.begin());
    const size_t key = next > 0 ? next - 1 : 0;
    const float* here = &curve.values[stride * key + (isCubic ? n : 0)];
    std::copy_n(here, n, value);
    if (isRotation) {
        normalize(value);
    }
    if (next == 0 || next == keys || curve.kind == Curve::Kind::step) {
        return;
    }
    const double start = (double)curve.times[key], share = (seconds - start) / ((double)*after - start);
    if (isCubic) {
        for (size_t i = 0; i < n; ++i) {
            value[i] = spline(curve, key, i, share);
        }
        if (isRotation) {
            normalize(value);
        }
    } else if (isRotation) {
        double end[4];
        std::copy_n(here + n, 4, end);
        normalize(end);
        slerp(value, end, share);
    } else {
        for (size_t i = 0; i < n; ++i) {
            value[i] += share * ((double)here[n + i] - value[i]);
        }
    }
}

// ------------------------------------------------------------------------------------------------ nodes

/// Scales that an animation makes, none of them 0.
static void keepVolume(double* scale)
{
    const double most = std::max({std::fabs(scale[0]), std::fabs(scale[1]), std::fabs(scale[2])});
    const double least = std::max(1e-4 * most, 1e-6);
    for (int i = 0; i < 3; ++i) {
        scale[i] = std::fabs(scale[i]) < least ? std::copysign(least, scale[i]) : scale[i];
    }
}

void placeNode(Rig& rig, size_t index)
{
    Node& node = rig.nodes[index];
    Local& now = node.now;
    if ((node.animated & 1u << (int)Path::scale) != 0) {
        keepVolume(now.s);
    }
    const Matrix local = node.hasMatrix ? node.matrix : composeMatrix(now.t, now.r, now.s);
    node.toWorld = node.parent >= 0 ? multiply(rig.nodes[(size_t)node.parent].toWorld, local) : local;
}

static void setFactor(const Channel& channel, const double* value, vtMaterial* material)
{
    const Factor& factor = *channel.factor;
    const size_t count = std::min<size_t>(factor.components, 3); // base colours have an alpha
    float* to = (float*)((char*)material + factor.offset);
    float* also = (float*)((char*)material + (factor.alsoAt != 0 ? factor.alsoAt : factor.offset));
    for (size_t i = 0; i < count; ++i) {
        to[i] =
            (float)std::clamp(value[i] * (double)channel.strength, (double)factor.least, (double)factor.most);
        also[i] = to[i];
    }
    if (factor.components == 4) {
        material->alpha = (float)std::clamp(value[3], 0.0, 1.0);
    }
}

/// The numbers of materials that some animation moves, as at rest: others' stay as they are.
static void restFactors(const Rig& rig, vtMaterial* materials)
{
    for (const Animation& animation : rig.animations) {
        for (const Channel& channel : animation.channels) {
            if (channel.path == Path::factor) {
                const vtMaterial& rest = rig.materials[channel.target];
                const float* from = (const float*)((const char*)&rest + channel.factor->offset);
                double value[4] = {0, 0, 0, (double)rest.alpha};
                std::copy_n(from, std::min<size_t>(channel.factor->components, 3), value);
                Channel plain = channel;
                plain.strength = 1.0f;
                setFactor(plain, value, &materials[channel.target]);
            }
        }
    }
}

static void applyChannel(Rig& rig, const Animation& animation, const Channel& channel, double seconds,
                         vtMaterial* materials)
{
    const Curve& curve = animation.curves[channel.curve];
    double value[4];
    if (channel.path == Path::factor) {
        evaluate(curve, false, seconds, value);
        setFactor(channel, value, &materials[channel.target]);
        return;
    }
    Node& node = rig.nodes[channel.target];
    double* to = channel.path == Path::translation ? node.now.t
                 : channel.path == Path::rotation  ? node.now.r
                 : channel.path == Path::scale     ? node.now.s
                                                   : node.weightsNow.data();
    if (channel.path != Path::weights || node.weightsNow.size() == curve.components) {
        evaluate(curve, channel.path == Path::rotation, seconds, to);
    }
}

/// All nodes at that time.
static void placeAll(Rig& rig, const Animation* animation, double seconds, vtMaterial* materials)
{
    for (Node& node : rig.nodes) {
        node.now = node.rest;
        node.weightsNow = node.weights;
    }
    restFactors(rig, materials);
    for (size_t i = 0; animation != nullptr && i < animation->channels.size(); ++i) {
        applyChannel(rig, *animation, animation->channels[i], seconds, materials);
    }
    for (const size_t node : rig.order) {
        placeNode(rig, node);
    }
}

// ------------------------------------------------------------------------------------------------ scenes

static bool equal(const Kept<Matrix>& a, const Kept<Matrix>& b)
{
    bool same = a.size() == b.size();
    for (size_t i = 0; same && i < a.size(); ++i) {
        same = std::equal(a[i].m, a[i].m + 16, b[i].m);
    }
    return same;
}

/// Moves the vertices of a mesh, where they are not there already.
static bool moveVertices(Report& report, const Rig& rig, Shape& shape, vtMesh* mesh)
{
    Kept<Matrix> joints;
    if (shape.influenceCount > 0) {
        placeJoints(rig, shape.skin, &joints);
    }
    const Kept<double>& weights =
        shape.node >= 0 ? rig.nodes[(size_t)shape.node].weightsNow : shape.posedWeights;
    if (equal(joints, shape.posedJoints) && weights == shape.posedWeights) {
        return true;
    }
    Kept<float> positions(shape.positions.size()), normals(shape.normals.size());
    shape.posedWeights = weights;
    shape.posedJoints = std::move(joints);
    pose(shape, positions.data(), normals.empty() ? nullptr : normals.data());
    vtError error = {};
    vtResult result =
        vtMesh_Update(mesh, positions.data(), normals.empty() ? nullptr : normals.data(), &error);
    if (result == vt_ok && shape.tangents >= 0) {
        vtFree(mesh->tangents);
        mesh->tangents = nullptr;
        result = vtComputeTangents(mesh, shape.tangents, &error);
    }
    if (result != vt_ok) {
        shape.posedWeights.assign(1, NAN); // it is to be tried again
        shape.posedJoints.clear();
        return report.fail(result, "%s", error.message);
    }
    return true;
}

static std::string labelOf(size_t node, const char* name)
{
    return std::to_string(node) + (name[0] != '\0' ? " ('" + std::string(name) + "')" : "");
}

static Matrix toMatrix(const vtTransform& transform)
{
    Matrix matrix;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            matrix.m[4 * column + row] = (double)transform.rows[row][column];
        }
    }
    return matrix;
}

bool setTime(Report& report, Rig& rig, int animation, double seconds, const vtModelPlace& place,
             vtScene* scene)
{
    const Animation* played = animation >= 0 ? &rig.animations[(size_t)animation] : nullptr;
    const Matrix base = toMatrix(place.toWorld);
    placeAll(rig, played, seconds, scene->materials + place.material);
    for (Shape& shape : rig.shapes) {
        if (!moveVertices(report, rig, shape, &scene->meshes[place.mesh + shape.mesh])) {
            return false;
        }
    }
    for (const Moved& moved : rig.objects) {
        vtObject* object = &scene->objects[place.object + moved.index];
        const Matrix toWorld = multiply(base, multiply(rig.nodes[moved.node].toWorld, moved.instance));
        vtTransform transform;
        if (!toTransform(report, labelOf(moved.node, object->name), toWorld, scene->meshes[object->mesh],
                         &transform)) {
            return false;
        }
        object->toWorld = transform;
    }
    for (const Moved& moved : rig.cameras) {
        vtSceneCamera* camera = &scene->cameras[place.camera + moved.index];
        if (!placeView(report, labelOf(moved.node, camera->name), rig.nodes[moved.node].toWorld, rig.middle,
                       &camera->view)) {
            return false;
        }
    }
    for (const Moved& moved : rig.lights) {
        placeLight(multiply(base, rig.nodes[moved.node].toWorld), &scene->lights[place.light + moved.index]);
    }
    return true;
}

} // namespace vtGltf
