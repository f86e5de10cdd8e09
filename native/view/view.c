#include <math.h>
#include <stdio.h>
#include <time.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/session.h"
#include "lab/metrics/timing.h"
#include "view/window.h"

/// A step of the arrow keys, and how often the title tells the time, seconds.
static const double keyStep = 1.0 / 30.0, titleEvery = 0.5;

/// What is shown of the animations.
typedef struct Play {
    double seconds; ///< of the animation
    double last;    ///< when the last round began, seconds
    bool runs, isNew;
    double titled, frames; ///< when the title was written, and frames since
} Play;

static double secondsNow(void)
{
    return vtNow() / 1000.0;
}

/// Goes on by the time that has passed, or by what the keys say.
static void advance(Play* play, double duration, vtWindowKeys keys)
{
    const double now = secondsNow(), before = play->seconds;
    play->runs ^= keys.pause;
    play->runs &= duration > 0.0;
    play->seconds += play->runs ? now - play->last : 0.0;
    play->last = now;
    if (keys.steps != 0) {
        play->runs = false;
        play->seconds += keyStep * keys.steps;
    }
    if (keys.start) {
        play->seconds = 0.0;
    }
    if (duration > 0.0 && (play->seconds > duration || play->seconds < 0.0)) {
        play->seconds -= duration * floor(play->seconds / duration); // round and round
    }
    play->isNew = play->seconds != before;
}

static void writeTitle(vtWindow* window, Play* play)
{
    const double now = secondsNow(), since = now - play->titled;
    char title[96];
    ++play->frames;
    if (since >= titleEvery) {
        snprintf(title, sizeof title, "Vitrine: %.2f s%s, %.1f ms a frame", play->seconds,
                 play->runs ? "" : ", paused", 1000.0 * since / play->frames);
        vtWindow_SetTitle(window, title);
        play->titled = now;
        play->frames = 0.0;
    }
}

static vtResult runLoop(const vtOptions* options, vtWindow* window, vtSession* session, vtFrame frame,
                        vtError* error)
{
    const struct timespec pause = {0, 10000000};
    const double duration = session->input.motion.duration;
    // A view that stands still becomes clean, one sample a frame; only the picture has several.
    const int samples = frame.output == vt_outputPicture ? frame.samples : 1, frames = options->frames;
    Play play = {.seconds = fmax(options->time, 0.0), .last = secondsNow(), .titled = secondsNow()};
    play.runs = duration > 0.0 && options->time < 0.0f;
    int next = 0;
    frame.samples = 1;
    for (int drawn = 0; !vtWindow_ShouldClose(window) && (frames == 0 || drawn < frames);) {
        bool changed = vtWindow_Poll(window, &frame.view);
        advance(&play, duration, vtWindow_TakeKeys(window));
        vtWindow_GetSize(window, &frame.width, &frame.height);
        bool visible = frame.width > 0 && frame.height > 0;
        next = changed || play.isNew ? 0 : next;
        if (!visible || (next >= samples && frames == 0)) {
            nanosleep(&pause, NULL); // nothing to show: leave the machine alone
            continue;
        }
        frame.firstSample = next < samples ? next++ : 0;
        vtResult result = play.isNew ? vtSession_SetTime(session, options, play.seconds, error) : vt_ok;
        if (result == vt_ok) {
            result = vtRenderer_Draw(session->renderer, &frame, error);
        }
        if (result != vt_ok) {
            return result;
        }
        vtWindow_Present(window);
        if (duration > 0.0) {
            writeTitle(window, &play);
        }
        ++drawn;
    }
    return vtSucceed(error);
}

vtResult vtRunView(const vtOptions* options, vtError* error)
{
    vtSession session = {0}; // without a context of its own: the window has one
    vtResult result = vtLoadInput(options, &session.input, error);
    if (result != vt_ok) {
        return result;
    }
    vtFrame frame;
    vtWindow* window = NULL;
    result = vtMakeFrame(options, &session.input, &frame, error);
    if (result == vt_ok) {
        result = vtCreateWindow("Vitrine", frame.width, frame.height, &window, error);
    }
    if (result == vt_ok) {
        result = vtCreateRenderer(&(vtRendererDef){.getProcAddress = vtWindow_GetProcAddress()},
                                  &session.renderer, error);
    }
    if (result == vt_ok) {
        result = vtSession_Fill(&session, options, error);
    }
    if (result == vt_ok) {
        result = runLoop(options, window, &session, frame, error);
    }
    vtDestroyRenderer(session.renderer);
    vtDestroyWindow(window);
    vtDestroyInput(&session.input);
    return result;
}
