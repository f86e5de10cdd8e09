// KHR_lights_punctual: lights where nodes put them.

#include "gltf/gltf.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace vtGltf
{

static float number(double value, double least, double most)
{
    return std::isfinite(value) ? (float)std::clamp(value, least, most) : (float)least;
}

void placeLight(const Matrix& toWorld, vtLight* light)
{
    const double* m = toWorld.m;
    const double length = std::hypot(m[8], m[9], m[10]);
    const bool aims = std::isnormal(length);
    light->position = {(float)m[12], (float)m[13], (float)m[14]};
    light->direction = {aims ? (float)(-m[8] / length) : 0.0f, aims ? (float)(-m[9] / length) : 0.0f,
                        aims ? (float)(-m[10] / length) : -1.0f};
}

bool makeLights(Loader& loader)
{
    vtScene* scene = loader.scene;
    if (loader.lights.empty()) {
        return true;
    }
    if (!loader.allocate(loader.lights.size(), &scene->lights)) {
        return false;
    }
    const double right = 1.57079632679489661923;
    for (const Placement& at : loader.lights) {
        const tinygltf::Light& given = loader.model.lights[(size_t)at.what];
        vtLight light = {};
        light.kind = given.type == "spot"          ? vt_lightSpot
                     : given.type == "directional" ? vt_lightDirectional
                                                   : vt_lightPoint;
        placeLight(at.toWorld, &light);
        const auto color = [&](size_t i) {
            return number((i < given.color.size() ? given.color[i] : 1.0) * given.intensity, 0.0,
                          (double)FLT_MAX);
        };
        light.color = {color(0), color(1), color(2)};
        light.range = number(given.range, 0.0, (double)FLT_MAX);
        light.outerCone = number(given.spot.outerConeAngle, 1e-3, right);
        light.innerCone = number(given.spot.innerConeAngle, 0.0, (double)light.outerCone);
        if (loader.keeps && loader.rig.nodes[(size_t)at.node].moves) {
            loader.rig.lights.push_back({scene->lightCount, (size_t)at.node});
        }
        scene->lights[scene->lightCount++] = light;
    }
    return true;
}

} // namespace vtGltf
