#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/output_name.h"
#include "cli/session.h"
#include "lab/metrics/timing.h"
#include "view/window.h"

/// A step of the arrow keys, how often the title tells the time, and how long it tells a problem, seconds.
static const double keyStep = 1.0 / 30.0, titleEvery = 0.5, problemFor = 5.0;

/// What is shown of the animations.
typedef struct Play {
    double duration; ///< seconds; 0: nothing moves
    double seconds;  ///< of the animation
    double last;     ///< when the last round began, seconds
    bool runs, isNew;
} Play;

/// What the title tells.
typedef struct Title {
    double next;          ///< when it may be written again, seconds
    double frames, spent; ///< frames since it was written, and seconds that these took
} Title;

/// What the window shows.
typedef struct View {
    vtOptions options; ///< of the model that is shown
    char* dropped;     ///< its file; NULL: the one of the command line
    vtWindow* window;
    vtSession* session; ///< without a context of its own: the window has one
    vtFrame frame;      ///< of one sample
    int samples;        ///< until the picture is clean
    int next;           ///< of them
    Play play;
    Title title;
} View;

static double secondsNow(void)
{
    return vtNow() / 1000.0;
}

/// What is shown is new: it begins with its first sample.
static vtResult beginModel(View* view, vtError* error)
{
    const vtOptions* options = &view->options;
    const vtResult result = vtMakeFrame(options, &view->session->input, &view->frame, error);
    const double duration = view->session->input.motion.duration;
    // A view that stands still becomes clean, one sample a frame; only the picture has several.
    view->samples = view->frame.output == vt_outputPicture ? view->frame.samples : 1;
    view->frame.samples = 1;
    view->next = 0;
    view->play = (Play){.duration = duration,
                        .seconds = fmax((double)options->time, 0.0),
                        .last = secondsNow(),
                        .runs = duration > 0.0 && options->time < 0.0f};
    view->title = (Title){0};
    return result;
}

// ------------------------------------------------------------------------------------------- dropped files

/// What was said of the model on the command line holds for that one alone.
static vtOptions optionsOfDropped(const vtOptions* given, const char* path)
{
    vtOptions options = *given;
    options.model = path;
    options.objectCount = options.triangles = 0;
    options.cameraOfFile = options.variant = options.animation = options.root = NULL;
    options.hasCamera = options.hasTarget = false;
    options.time = options.relief = options.slab = options.smooth = -1.0f;
    return options;
}

/// Shows a file that was dropped on the window. Where that cannot be, what was shown stays, and the title and
/// standard error say why.
static vtResult takeDropped(View* view, vtError* error)
{
    char* path = vtWindow_TakeDropped(view->window);
    if (path == NULL) {
        return vt_ok;
    }
    vtOptions options = optionsOfDropped(&view->options, path);
    vtError reason;
    if (view->frame.width > 0 && view->frame.height > 0) {
        options.frame.width = view->frame.width;
        options.frame.height = view->frame.height;
    }
    if (vtSession_SetModel(view->session, &options, &reason) != vt_ok) {
        char title[sizeof reason.message + 16];
        fprintf(stderr, "vitrine: %s\n", reason.message);
        snprintf(title, sizeof title, "Vitrine: %s", reason.message);
        vtWindow_SetTitle(view->window, title);
        view->title = (Title){.next = secondsNow() + problemFor};
        free(path);
        return vt_ok;
    }
    free(view->dropped);
    view->dropped = path;
    view->options = options;
    return beginModel(view, error);
}

// ------------------------------------------------------------------------------------------------ the window

/// Goes on by the time that has passed, or by what keys and pointer say.
static void advance(Play* play, vtWindowKeys keys)
{
    const double now = secondsNow(), before = play->seconds,
                 by = keyStep * keys.steps + play->duration * keys.scrub;
    play->runs ^= keys.pause;
    play->runs &= play->duration > 0.0;
    play->seconds += play->runs ? now - play->last : 0.0;
    play->last = now;
    if (by != 0.0) {
        play->runs = false;
        play->seconds += by;
    }
    if (keys.start) {
        play->seconds = 0.0;
    }
    if (play->duration == 0.0) {
        play->seconds = before; // nothing moves
    } else if (play->seconds > play->duration || play->seconds < 0.0) {
        play->seconds -= play->duration * floor(play->seconds / play->duration); // round and round
    }
    play->isNew = play->seconds != before;
}

static void writeTitle(View* view)
{
    const Play* play = &view->play;
    char name[128], time[64] = "", title[256];
    vtNameModel(view->options.model != NULL ? view->options.model : "scene", name, sizeof name);
    if (play->duration > 0.0) {
        snprintf(time, sizeof time, "%.2f s of %.2f%s, ", play->seconds, play->duration,
                 play->runs ? "" : ", paused");
    }
    snprintf(title, sizeof title, "Vitrine: %s, %s%.1f ms a frame", name, time,
             1000.0 * view->title.spent / view->title.frames);
    vtWindow_SetTitle(view->window, title);
    view->title = (Title){.next = secondsNow() + titleEvery};
}

/// Draws the next sample of what is shown, and tells what it took.
static vtResult drawFrame(View* view, double start, vtError* error)
{
    vtSession* session = view->session;
    view->frame.firstSample = view->next < view->samples ? view->next++ : 0;
    vtResult result =
        view->play.isNew ? vtSession_SetTime(session, &view->options, view->play.seconds, error) : vt_ok;
    if (result == vt_ok) {
        result = vtRenderer_Draw(session->renderer, &view->frame, error);
    }
    if (result == vt_ok) {
        vtWindow_Present(view->window);
        const double now = secondsNow();
        view->title.frames += 1.0;
        view->title.spent += now - start;
        if (now >= view->title.next) {
            writeTitle(view);
        }
    }
    return result;
}

static vtResult runLoop(View* view, vtError* error)
{
    const struct timespec pause = {0, 10000000};
    const int frames = view->options.frames;
    vtFrame* frame = &view->frame;
    for (int drawn = 0; !vtWindow_ShouldClose(view->window) && (frames == 0 || drawn < frames);) {
        const double start = secondsNow();
        const bool changed = vtWindow_Poll(view->window, &frame->view);
        vtResult result = takeDropped(view, error);
        if (result != vt_ok) {
            return result;
        }
        advance(&view->play, vtWindow_TakeKeys(view->window));
        vtWindow_GetSize(view->window, &frame->width, &frame->height);
        const bool isVisible = frame->width > 0 && frame->height > 0;
        view->next = changed || view->play.isNew ? 0 : view->next;
        if (!isVisible || (view->next >= view->samples && frames == 0)) {
            if (view->title.frames > 0.0 && start >= view->title.next) {
                writeTitle(view);
            }
            nanosleep(&pause, NULL); // nothing to show: leave the machine alone
            continue;
        }
        result = drawFrame(view, start, error);
        if (result != vt_ok) {
            return result;
        }
        ++drawn;
    }
    return vtSucceed(error);
}

vtResult vtRunView(const vtOptions* options, vtError* error)
{
    vtSession session = {0};
    View view = {.options = *options, .session = &session};
    vtResult result = vtLoadInput(options, &session.input, error);
    if (result != vt_ok) {
        return result;
    }
    result = beginModel(&view, error);
    if (result == vt_ok) {
        result = vtCreateWindow("Vitrine", view.frame.width, view.frame.height, &view.window, error);
    }
    if (result == vt_ok) {
        result = vtCreateRenderer(&(vtRendererDef){.getProcAddress = vtWindow_GetProcAddress()},
                                  &session.renderer, error);
    }
    if (result == vt_ok) {
        result = vtSession_Fill(&session, options, error);
    }
    if (result == vt_ok) {
        view.play.last = secondsNow();
        result = runLoop(&view, error);
    }
    vtDestroyRenderer(session.renderer);
    vtDestroyWindow(view.window);
    vtDestroyInput(&session.input);
    free(view.dropped);
    return result;
}
