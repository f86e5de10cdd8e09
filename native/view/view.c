#include <stdio.h>
#include <time.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/load.h"
#include "view/window.h"

static vtResult runLoop(vtWindow* window, vtRenderer* renderer, vtFrame frame, int frames, vtError* error)
{
    const struct timespec pause = {0, 10000000};
    // A view that stands still becomes clean, one sample a frame; only the picture has several.
    const int samples = frame.output == vt_outputPicture ? frame.samples : 1;
    int next = 0;
    frame.samples = 1;
    for (int drawn = 0; !vtWindow_ShouldClose(window) && (frames == 0 || drawn < frames);) {
        bool changed = vtWindow_Poll(window, &frame.view);
        vtWindow_GetSize(window, &frame.width, &frame.height);
        bool visible = frame.width > 0 && frame.height > 0;
        next = changed ? 0 : next;
        if (!visible || (next >= samples && frames == 0)) {
            nanosleep(&pause, NULL); // nothing to show: leave the machine alone
            continue;
        }
        frame.firstSample = next < samples ? next++ : 0;
        vtResult result = vtRenderer_Draw(renderer, &frame, error);
        if (result != vt_ok) {
            return result;
        }
        vtWindow_Present(window);
        ++drawn;
    }
    return vtSucceed(error);
}

vtResult vtRunView(const vtOptions* options, vtError* error)
{
    vtInput input;
    vtResult result = vtLoadInput(options, &input, error);
    if (result != vt_ok) {
        return result;
    }
    vtFrame frame;
    vtWindow* window = NULL;
    vtRenderer* renderer = NULL;
    result = vtMakeFrame(options, &input, &frame, error);
    if (result == vt_ok) {
        result = vtCreateWindow("Vitrine", frame.width, frame.height, &window, error);
    }
    if (result == vt_ok) {
        result =
            vtCreateRenderer(&(vtRendererDef){.getProcAddress = vtWindow_GetProcAddress()}, &renderer, error);
    }
    if (result == vt_ok) {
        result = vtRenderer_SetScene(renderer, &input.scene, error);
    }
    if (result == vt_ok) {
        result = vtRenderer_SetEnvironment(renderer, &input.environment, error);
    }
    if (result == vt_ok && input.background.pixels != NULL) {
        result = vtRenderer_SetBackground(renderer, &input.background, error);
    }
    if (result == vt_ok && options->ground.isThere) {
        result = vtRenderer_SetGround(renderer, &options->ground.ground, error);
    }
    if (result == vt_ok) {
        result = runLoop(window, renderer, frame, options->frames, error);
    }
    vtDestroyRenderer(renderer);
    vtDestroyWindow(window);
    vtDestroyInput(&input);
    return result;
}
