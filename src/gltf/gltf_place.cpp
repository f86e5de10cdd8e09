// Objects and cameras of the scene, where its nodes put them.

#include "gltf/gltf.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vtGltf
{

static const double pi = 3.14159265358979323846;

/// "3 ('cup')", or "3" where the node has no name.
static std::string nodeLabel(const Loader& loader, int node)
{
    const std::string name = quotable(loader.model.nodes[(size_t)node].name);
    return std::to_string(node) + (name.empty() ? "" : " ('" + name + "')");
}

/// As much of a name as fits, without half a character at the end.
static void copyName(const std::string& from, char* to, size_t capacity)
{
    std::string name = quotable(from);
    if (name.size() >= capacity) {
        size_t length = capacity - 1;
        while (length > 0 && ((unsigned char)name[length] & 0xC0) == 0x80) { // inside one of UTF-8
            --length;
        }
        name.resize(length);
    }
    memcpy(to, name.c_str(), name.size() + 1);
}

static bool isFinite(const Matrix& matrix)
{
    bool finite = true;
    for (double number : matrix.m) {
        finite = finite && std::isfinite((float)number);
    }
    return finite;
}

/// Does the world box of a mesh in its place have finite corners?
static bool fits(const vtTransform& toWorld, const vtMesh& mesh)
{
    const vtVec3 a = mesh.boundsMin, b = mesh.boundsMax;
    const float far[3] = {std::max(-a.x, b.x), std::max(-a.y, b.y), std::max(-a.z, b.z)};
    bool finite = true;
    for (const float* row : toWorld.rows) {
        finite = finite && std::isfinite(std::fabs(row[0] * far[0]) + std::fabs(row[1] * far[1]) +
                                         std::fabs(row[2] * far[2]) + std::fabs(row[3]));
    }
    return finite;
}

bool toTransform(Report& report, const std::string& label, const Matrix& toWorld, const vtMesh& mesh,
                 vtTransform* transform)
{
    const double* m = toWorld.m;
    double columns[3], rows[3];
    for (size_t i = 0; i < 3; ++i) {
        columns[i] = std::hypot(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
        rows[i] = std::hypot(m[i], m[4 + i], m[8 + i]);
        for (size_t k = 0; k < 4; ++k) {
            transform->rows[i][k] = (float)m[4 * k + i];
        }
    }
    const double determinant = m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
                               m[8] * (m[1] * m[6] - m[2] * m[5]);
    if (!isFinite(toWorld) || !fits(*transform, mesh) || std::isinf((float)determinant)) {
        return report.fail(vt_errorGeometry,
                           "node %s is scaled by %g, %g, %g or moved so far that 32-bit numbers do not hold "
                           "it; scale the scene down",
                           label.c_str(), columns[0], columns[1], columns[2]);
    }
    if (!(std::fabs(determinant) > 1e-6 * rows[0] * rows[1] * rows[2]) ||
        !std::isnormal((float)determinant)) {
        return report.fail(vt_errorGeometry,
                           "node %s is scaled by %g, %g, %g along its axes in the world, which makes it "
                           "flat; give it and those above it a scale other than 0 along each axis",
                           label.c_str(), columns[0], columns[1], columns[2]);
    }
    return true;
}

bool failObjects(Loader& loader, size_t count)
{
    return loader.fail(vt_errorGeometry,
                       "its nodes place %zu meshes but there can be %d; join some and export it again", count,
                       VT_MAX_OBJECTS);
}

bool makeObjects(Loader& loader)
{
    vtScene* scene = loader.scene;
    size_t count = 0;
    for (const Placement& at : loader.objects) {
        count += loader.sources[(size_t)at.what].meshes.size();
    }
    if (count > VT_MAX_OBJECTS) {
        return failObjects(loader, count);
    }
    if (!loader.allocate(count, &scene->objects)) {
        return false;
    }
    uint32_t body = 0;
    for (const Placement& at : loader.objects) {
        const Source& source = loader.sources[(size_t)at.what];
        const std::string& own = loader.model.nodes[(size_t)at.node].name;
        const Node& node = loader.rig.nodes[(size_t)at.node];
        ++body;
        for (size_t i = 0; i < source.meshes.size(); ++i) {
            vtObject* object = &scene->objects[scene->objectCount++];
            object->mesh = source.meshes[i];
            object->material = source.materials[i];
            if (!toTransform(loader, nodeLabel(loader, at.node), at.toWorld, scene->meshes[object->mesh],
                             &object->toWorld)) {
                return false;
            }
            object->body = source.bounds[i] ? body : 0;
            copyName(own.empty() ? loader.model.meshes[(size_t)source.mesh].name : own, object->name,
                     sizeof object->name);
            if (loader.keeps && node.moves && !at.isFixed) {
                loader.rig.objects.push_back({scene->objectCount - 1, (size_t)at.node, at.instance});
            }
        }
    }
    return true;
}

/// Its roll is lost, since views are level.
bool placeView(Report& report, const std::string& label, const Matrix& toWorld, const double middle[3],
               vtView* view)
{
    const double* m = toWorld.m;
    const double length = std::hypot(m[8], m[9], m[10]);
    if (!isFinite(toWorld) || !std::isnormal(length)) {
        return report.fail(vt_errorGeometry,
                           "node %s scales its camera by %g along its view; give it a scale of 1",
                           label.c_str(), length);
    }
    double distance = 0.0, target[3];
    for (size_t k = 0; k < 3; ++k) {
        distance -= (middle[k] - m[12 + k]) * m[8 + k] / length;
    }
    distance = distance > 0.0 && std::isfinite((float)distance) ? distance : 1.0;
    for (size_t k = 0; k < 3; ++k) {
        target[k] = m[12 + k] - distance * m[8 + k] / length;
    }
    view->eye = {(float)m[12], (float)m[13], (float)m[14]};
    view->target = {(float)target[0], (float)target[1], (float)target[2]};
    return true;
}

bool makeCameras(Loader& loader)
{
    vtScene* scene = loader.scene;
    vtVec3 low, high;
    vtScene_Bounds(scene, &low, &high);
    double* middle = loader.rig.middle;
    middle[0] = 0.5 * ((double)low.x + (double)high.x);
    middle[1] = 0.5 * ((double)low.y + (double)high.y);
    middle[2] = 0.5 * ((double)low.z + (double)high.z);
    if (!loader.allocate(loader.cameras.size(), &scene->cameras)) {
        return false;
    }
    for (const Placement& at : loader.cameras) {
        const tinygltf::Camera& camera = loader.model.cameras[(size_t)at.what];
        const bool isFlat = camera.type == "orthographic";
        const double yfov = isFlat ? 0.25 * pi : camera.perspective.yfov, ymag = camera.orthographic.ymag;
        if (!(yfov > 0.0 && yfov < pi)) {
            return loader.fail(vt_errorFormat,
                               "camera %s has a yfov of %g, but it must be above 0 and below pi; correct it",
                               label(at.what, camera.name).c_str(), yfov);
        }
        if (isFlat && !(ymag != 0.0 && std::isfinite((float)ymag))) {
            return loader.fail(vt_errorFormat, "camera %s has a ymag of %g, but it must not be 0; correct it",
                               label(at.what, camera.name).c_str(), ymag);
        }
        vtSceneCamera* made = &scene->cameras[scene->cameraCount++];
        vtView* view = &made->view;
        const std::string& own = loader.model.nodes[(size_t)at.node].name;
        copyName(own.empty() ? camera.name : own, made->name, sizeof made->name);
        made->orthographicHeight = isFlat ? (float)(2.0 * std::fabs(ymag)) : 0.0f;
        if (!placeView(loader, nodeLabel(loader, at.node), at.toWorld, middle, view)) {
            return false;
        }
        if (loader.keeps && loader.rig.nodes[(size_t)at.node].moves) {
            loader.rig.cameras.push_back({scene->cameraCount - 1, (size_t)at.node});
        }
        view->fovY = (float)std::clamp(yfov * 180.0 / pi, 1.0, 170.0);
    }
    return true;
}

} // namespace vtGltf
