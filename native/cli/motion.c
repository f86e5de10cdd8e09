#include "cli/motion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "scene/camera.h"
#include "scene/objects.h"

void vtMotion_Add(vtMotion* motion, vtModel* model, const vtModelPlace* place)
{
    if (vtModel_Animation(model, 0) == NULL) {
        vtCloseModel(model);
        return;
    }
    motion->models[motion->count++] = (vtMovingModel){model, *place, -1};
}

/// The animation of that name, else of that number; -1: there is none.
static int findAnimation(const vtModel* model, const char* text)
{
    char* end;
    const vtAnimation* animation;
    for (int i = 0; (animation = vtModel_Animation(model, i)) != NULL; ++i) {
        if (strcmp(animation->name, text) == 0) {
            return i;
        }
    }
    const long number = strtol(text, &end, 10);
    const bool isNumber = end != text && *end == '\0' && number >= 0 && number < INT32_MAX;
    return isNumber && vtModel_Animation(model, (int)number) != NULL ? (int)number : -1;
}

static vtResult failAnimation(const vtMotion* motion, const char* text, vtError* error)
{
    char names[512] = "";
    const vtAnimation* animation;
    for (int k = 0; k < motion->count; ++k) {
        for (int i = 0; (animation = vtModel_Animation(motion->models[k].model, i)) != NULL; ++i) {
            const size_t used = strlen(names);
            snprintf(names + used, sizeof names - used, "%s%d%s%s", used > 0 ? ", " : "", i,
                     animation->name[0] != '\0' ? " " : "", animation->name);
        }
    }
    return vtFail(error, vt_errorArgument,
                  "--animation is '%.100s', but the animations in what is drawn are: %s", text, names);
}

vtResult vtMotion_Choose(vtMotion* motion, const vtOptions* options, vtError* error)
{
    bool found = false;
    motion->duration = 0.0;
    if (motion->count == 0 && (options->time >= 0.0f || (options->animation != NULL && options->plays))) {
        return vtFail(error, vt_errorArgument,
                      options->animation != NULL
                          ? "--animation is '%.100s', but nothing that is drawn has animations; leave it out"
                          : "--time is given, but nothing that is drawn has animations; leave it out%.0s",
                      options->animation != NULL ? options->animation : "");
    }
    for (int i = 0; i < motion->count; ++i) {
        vtMovingModel* moving = &motion->models[i];
        moving->animation = options->animation != NULL ? findAnimation(moving->model, options->animation) : 0;
        found |= moving->animation >= 0;
        if (moving->animation >= 0) {
            motion->duration =
                fmax(motion->duration, vtModel_Animation(moving->model, moving->animation)->duration);
        }
    }
    return found || motion->count == 0 ? vt_ok : failAnimation(motion, options->animation, error);
}

vtResult vtMotion_SetTime(vtMotion* motion, double seconds, vtScene* scene, vtError* error)
{
    vtResult result = vtSucceed(error);
    for (int i = 0; i < motion->count && result == vt_ok; ++i) {
        const vtMovingModel* moving = &motion->models[i];
        result = vtModel_SetTime(moving->model, isnan(seconds) ? -1 : moving->animation,
                                 isnan(seconds) ? 0.0 : seconds, &moving->place, scene, error);
    }
    return result;
}

static vtResult findLowest(const vtScene* scene, float* lowest, vtError* error)
{
    vtPlacedObject* placed;
    uint32_t glassCount;
    const vtResult result = vtPlaceObjects(scene, &placed, &glassCount, error);
    for (uint32_t i = 0; result == vt_ok && i < scene->objectCount; ++i) {
        *lowest = fminf(*lowest, placed[i].low.y);
    }
    vtFree(placed);
    return result;
}

vtResult vtMotion_Survey(vtMotion* motion, float fovY, float aspect, vtScene* scene, vtError* error)
{
    enum { timeCount = 16 };
    vtView views[1 + timeCount];
    vtResult result = vt_ok;
    motion->lowest = INFINITY;
    for (int i = timeCount; i >= 0 && result == vt_ok; --i) { // rest, which is the first of them, comes last
        const double seconds = i > 0 ? motion->duration * (i - 1) / (timeCount - 1) : NAN;
        result = vtMotion_SetTime(motion, seconds, scene, error);
        if (result == vt_ok) {
            views[i] = vtViewOfScene(scene, fovY, aspect);
            result = findLowest(scene, &motion->lowest, error);
        }
    }
    if (result == vt_ok) {
        motion->view = vtJoinViews(views, 1 + timeCount, aspect);
    }
    return result;
}

void vtDestroyMotion(vtMotion* motion)
{
    for (int i = 0; i < motion->count; ++i) {
        vtCloseModel(motion->models[i].model);
    }
    *motion = (vtMotion){0};
}
