// Animations of the files that a viewer shows. The calls are like those of viewer.c.
#include <emscripten.h>
#include <string.h>

#include "core/viewer.h"

#if VT_IS_FULL

/// By numbers from 0, of all files that are shown; NULL past the end. *own: its number in its file.
static const vtAnimation* find(const vtViewer* viewer, int index, int* own)
{
    const vtAnimation* animation = NULL;
    uint32_t file = 0;
    *own = 0;
    for (int left = index; left >= 0 && file < viewer->motion.count;) {
        animation = vtModel_Animation(viewer->motion.models[file].model, *own);
        if (animation == NULL) {
            ++file;
            *own = 0;
        } else if (left-- > 0) {
            ++*own;
        }
    }
    return animation;
}

/// The name of an animation, maybe empty; NULL past the end.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_AnimationName(const vtViewer* viewer, int index)
{
    int own;
    const vtAnimation* animation = find(viewer, index, &own);
    return animation != NULL ? animation->name : NULL;
}

/// Its seconds.
EMSCRIPTEN_KEEPALIVE double vtViewer_AnimationDuration(const vtViewer* viewer, int index)
{
    int own;
    const vtAnimation* animation = find(viewer, index, &own);
    return animation != NULL ? animation->duration : 0.0;
}

/// Is it the first one of its file?
EMSCRIPTEN_KEEPALIVE bool vtViewer_AnimationIsFirst(const vtViewer* viewer, int index)
{
    int own;
    return find(viewer, index, &own) != NULL && own == 0;
}

/// The model's animation of that name, "": its first; -1: it has none such.
static int choose(const vtModel* model, const char* name)
{
    const vtAnimation* animation;
    int index = 0;
    while ((animation = vtModel_Animation(model, index)) != NULL && *name != '\0' &&
           strcmp(animation->name, name) != 0) {
        ++index;
    }
    return animation != NULL ? index : -1;
}

/// Shows the animation of that name, "": each file's first, at a time. Files without it are at rest.
EMSCRIPTEN_KEEPALIVE const char* vtViewer_SetTime(vtViewer* viewer, const char* name, double seconds)
{
    vtResult result = vt_ok;
    vtDestroyTracer(viewer->tracer); // it points into the scene
    viewer->tracer = NULL;
    for (uint32_t i = 0; i < viewer->motion.count && result == vt_ok; ++i) {
        const vtMovingModel* moving = &viewer->motion.models[i];
        result = vtModel_SetTime(moving->model, choose(moving->model, name), seconds, &moving->place,
                                 &viewer->scene, &viewer->error);
    }
    if (result == vt_ok) {
        result = vtViewer_PrepareScene(viewer, viewer->frame.technique);
    }
    if (result == vt_ok) {
        result = vtRenderer_UpdateScene(viewer->renderer, &viewer->scene, &viewer->error);
    }
    viewer->changed = true;
    return result == vt_ok ? NULL : viewer->error.message;
}

#endif
