// A file that is kept open: its animations, and its scene at any time of theirs.

#include "gltf/gltf.h"

#include <cmath>

struct vtModel {
    vtGltf::Text name;
    vtGltf::Rig rig;
};

namespace vtGltf
{

/// Makes the vtModel of what was loaded.
static bool keep(Loader& loader, void* result)
{
    Text name = quotable(loader.name).c_str();
    void* memory = vtAllocate(1, sizeof(vtModel));
    if (memory == nullptr) {
        return loader.fail(vt_errorMemory, "out of memory; simplify it");
    }
    vtModel* model = new (memory) vtModel{std::move(name), std::move(loader.rig)};
    for (Animation& animation : model->rig.animations) {
        animation.facts.name = animation.name.c_str();
    }
    *(vtModel**)result = model;
    return true;
}

/// What may be shorter than the model needs, of what the caller gives.
static bool fitsScene(const Rig& rig, const vtModelPlace& place, const vtScene& scene)
{
    bool fits = rig.materials.size() + place.material <= scene.materialCount;
    for (const Shape& shape : rig.shapes) {
        fits = fits && place.mesh < scene.meshCount && shape.mesh < scene.meshCount - place.mesh &&
               scene.meshes[place.mesh + shape.mesh].vertexCount == shape.positions.size() / 3;
    }
    const auto within = [](const Kept<Moved>& all, uint32_t first, uint32_t count) {
        bool good = true;
        for (const Moved& moved : all) {
            good = good && first < count && moved.index < count - first;
        }
        return good;
    };
    return fits && within(rig.objects, place.object, scene.objectCount) &&
           within(rig.cameras, place.camera, scene.cameraCount) &&
           within(rig.lights, place.light, scene.lightCount);
}

static vtResult setTimeSafely(vtModel* model, int animation, double seconds, const vtModelPlace& place,
                              vtScene* scene, vtError* error)
{
    Report report = {model->name.c_str(), error};
#ifdef __cpp_exceptions
    try {
#endif
        return setTime(report, model->rig, animation, seconds, place, scene) ? vtSucceed(error)
                                                                             : report.result;
#ifdef __cpp_exceptions
    } catch (const std::bad_alloc&) {
        return vtFail(error, vt_errorMemory, "model '%.200s': out of memory; simplify it", report.name);
    }
#endif
}

} // namespace vtGltf

extern "C" vtResult vtOpenModel(const vtModelDef* def, vtModel** model, vtScene* scene, vtError* error)
{
    if (def == nullptr || model == nullptr || scene == nullptr) {
        return vtFailMissing(error, "vtOpenModel",
                             def == nullptr     ? "def"
                             : model == nullptr ? "model"
                                                : "scene");
    }
    *scene = vtScene{};
    *model = nullptr;
    if (def->bytes == nullptr && def->size > 0) {
        return vtFailMissing(error, "vtOpenModel", "def->bytes");
    }
    return vtGltf::loadSafely(def, scene, true, error, vtGltf::keep, model);
}

extern "C" void vtCloseModel(vtModel* model)
{
    if (model != nullptr) {
        model->~vtModel();
        vtFree(model);
    }
}

extern "C" const vtAnimation* vtModel_Animation(const vtModel* model, int index)
{
    return model != nullptr && index >= 0 && (size_t)index < model->rig.animations.size()
               ? &model->rig.animations[(size_t)index].facts
               : nullptr;
}

extern "C" vtModelPlace vtScene_NextPlace(const vtScene* scene, const vtTransform* transform)
{
    vtModelPlace place = {};
    place.toWorld = transform != nullptr ? *transform : vtIdentityTransform();
    if (scene != nullptr) {
        place.mesh = scene->meshCount;
        place.material = scene->materialCount;
        place.object = scene->objectCount;
        place.camera = scene->cameraCount;
        place.light = scene->lightCount;
    }
    return place;
}

extern "C" vtResult vtModel_SetTime(vtModel* model, int animation, double seconds, const vtModelPlace* place,
                                    vtScene* scene, vtError* error)
{
    if (model == nullptr || scene == nullptr) {
        return vtFailMissing(error, "vtModel_SetTime", model == nullptr ? "model" : "scene");
    }
    const size_t count = model->rig.animations.size();
    if (animation < -1 || (animation >= 0 && (size_t)animation >= count)) {
        return vtFail(error, vt_errorArgument,
                      "model '%.200s': there is no animation %d; it has %zu, and -1 is none of them",
                      model->name.c_str(), animation, count);
    }
    if (!std::isfinite(seconds)) {
        return vtFail(error, vt_errorArgument, "model '%.200s': the time is %g seconds; it must be finite",
                      model->name.c_str(), seconds);
    }
    const vtModelPlace first = place != nullptr ? *place : vtScene_NextPlace(nullptr, nullptr);
    if (!vtGltf::fitsScene(model->rig, first, *scene)) {
        return vtFail(
            error, vt_errorArgument,
            "model '%.200s': the scene does not have there what was loaded with it; give the scene, "
            "and where in it",
            model->name.c_str());
    }
    return vtGltf::setTimeSafely(model, animation, seconds, first, scene, error);
}
