#include "cli/series.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/error.h"
#include "cli/draw.h"
#include "cli/hash.h"
#include "cli/output_name.h"
#include "cli/part.h"
#include "cli/series_plan.h"
#include "cli/stamp.h"
#include "cli/video.h"
#include "lab/metrics/timing.h"

/// What is open while a series is drawn, and how far it is.
typedef struct Run {
    const vtOptions* options;
    const vtPlan* plan;
    vtCameraPath eye; // the plan's, of this model's view
    vtSession session;
    bool isOpen; // the session
    vtDrawing drawing;
    vtPicture picture;
    char path[4096]; // of the picture drawn last
    vtVideo video;
    sigset_t signals;
    double start, told; // milliseconds
    int expected;       // pictures of this part, of the models seen so far and those whose number is known
    int done, kept, failed, stoppedBy;
} Run;

// ----------------------------------------------------------------------------------------------- signals

/// SIGINT and SIGTERM wait until somebody asks for them; every thread made from now on lets them wait, too.
static void holdSignals(Run* run)
{
    sigemptyset(&run->signals);
    sigaddset(&run->signals, SIGINT);
    sigaddset(&run->signals, SIGTERM);
    sigprocmask(SIG_BLOCK, &run->signals, NULL);
}

static bool isStopped(Run* run)
{
    sigset_t waiting;
    sigemptyset(&waiting);
    sigpending(&waiting);
    run->stoppedBy = sigismember(&waiting, SIGINT)    ? SIGINT
                     : sigismember(&waiting, SIGTERM) ? SIGTERM
                                                      : run->stoppedBy;
    return run->stoppedBy != 0;
}

// ---------------------------------------------------------------------------------------------- progress

/// On a terminal a bar; elsewhere a line, at most one in five seconds.
static void tellProgress(Run* run)
{
    const int count = run->expected;
    const double now = vtNow();
    if (isatty(STDERR_FILENO)) {
        vtShowProgress("drawing", (float)run->done / (float)count, run->start);
    } else if (run->options->verbose || now - run->told > 5000.0) {
        run->told = now;
        fprintf(stderr, "vitrine: %d of %d, %s, %.1f s\n", run->done, count, run->path,
                1e-3 * (now - run->start));
    }
}

// ---------------------------------------------------------------------------------------------- pictures

/// Opens the session with its first model, or puts another one in.
static vtResult openModel(Run* run, const vtOptions* options, vtError* error)
{
    vtResult result = run->isOpen ? vtSession_SetModel(&run->session, options, error)
                                  : vtOpenSession(options, &run->session, error);
    run->isOpen = run->isOpen || result == vt_ok;
    return result;
}

static uint64_t stampOf(const Run* run, int frame)
{
    uint64_t stamp = vtHash(run->options->stamp, &run->session.input.contents, sizeof(uint64_t));
    stamp = vtHash(stamp, &run->session.input.surroundings, sizeof(uint64_t));
    stamp = vtHash(stamp, &run->plan->contents, sizeof(uint64_t));
    return vtHash(stamp, &frame, sizeof frame);
}

/// Draws one picture, or finds it drawn.
static vtResult drawOne(Run* run, const char* model, int number, vtFrame* frame, vtError* error)
{
    char comment[64];
    vtResult result = vtNameOutput(run->options->output, model, number, run->path, sizeof run->path, error);
    if (result != vt_ok) {
        return result;
    }
    const bool isVideo = run->plan->isVideo;
    result = vtMakeFolders(run->path, error);
    if (result != vt_ok) {
        return result;
    }
    vtWriteStamp(stampOf(run, number), comment, sizeof comment);
    if (!isVideo && !run->options->redraw && vtIsDrawn(run->path, comment, frame->width, frame->height)) {
        ++run->kept;
        return vt_ok;
    }
    run->drawing.comment = comment;
    run->drawing.number = number < 0 ? 0 : number;
    result = vtDrawPicture(&run->drawing, &run->session, frame, &run->picture, error);
    if (result == vt_ok && isVideo && run->video.process == 0) {
        result = vtBeginVideo(run->options->output, frame->width, frame->height, run->plan->eye.fps,
                              &run->video, error);
    }
    if (result == vt_ok) {
        const size_t size = 4 * (size_t)frame->width * (size_t)frame->height;
        result = isVideo ? vtVideo_Add(&run->video, run->picture.pixels, size, error)
                         : vtWriteFile(run->path, run->picture.bytes, run->picture.size, error);
    }
    return result;
}

/// Does anything move, the eye or the scene?
static bool moves(const Run* run)
{
    return vtCameraPath_FrameCount(&run->eye) > 0 || run->session.input.motion.duration > 0.0;
}

/// The frames of one model that are this part's.
static vtResult drawModel(Run* run, size_t index, vtError* error)
{
    const vtPlan* plan = run->plan;
    vtOptions options = *run->options;
    options.model = plan->models[index];
    const bool isKnown = plan->frameCount > 0;
    if (isKnown && vtPlan_CountOwn(plan, index, plan->frameCount) == 0) {
        return vt_ok;
    }
    vtError reason;
    vtResult result = openModel(run, &options, &reason);
    vtFrame frame;
    if (result == vt_ok) {
        result = vtMakeFrame(&options, &run->session.input, &frame, &reason);
    }
    if (result != vt_ok && plan->modelCount > 1 && result != vt_errorContext) { // the other models may do
        fprintf(stderr, "vitrine: %s\n", reason.message);
        ++run->failed;
        return vt_ok;
    }
    if (result != vt_ok) {
        return vtFail(error, result, "%s", reason.message);
    }
    frame.linear = vtPictureFormat_IsLinear(run->drawing.format);
    run->eye.view = frame.view;
    const int frameCount = vtPlan_CountFrames(plan, run->session.input.motion.duration);
    const char* name = options.model != NULL ? options.model : "the scene";
    if (plan->hasFrames && !moves(run)) {
        return vtFail(error, vt_errorArgument, VT_NOTHING_MOVES, name);
    }
    if (frameCount == 0) {
        return vtFail(error, vt_errorArgument, "'%.200s' has no frame %d: its animation ends before", name,
                      plan->firstFrame);
    }
    run->expected += isKnown ? 0 : vtPlan_CountOwn(plan, index, frameCount);
    for (int i = 0; i < frameCount && result == vt_ok && !isStopped(run); ++i) {
        if (!vtPlan_IsOwn(plan, index, i)) {
            continue;
        }
        const int number = plan->hasFrames ? plan->firstFrame + i : -1;
        result = drawOne(run, options.model != NULL ? options.model : "scene", number, &frame, error);
        run->done += result == vt_ok;
        if (result == vt_ok) {
            tellProgress(run);
        }
    }
    return result;
}

// ------------------------------------------------------------------------------------------------ series

static vtResult finish(Run* run, vtResult result, vtError* error)
{
    if (result == vt_ok && run->plan->isVideo && run->stoppedBy == 0) {
        result = vtEndVideo(&run->video, error);
    }
    const double seconds = 1e-3 * (vtNow() - run->start);
    if (run->done > 0 && !run->plan->isVideo) {
        fprintf(stderr, "vitrine: %d of %d pictures are there: %d drawn, %d kept, in %.1f s\n", run->done,
                run->expected, run->done - run->kept, run->kept, seconds);
    }
    if (result == vt_ok && run->stoppedBy != 0) {
        return vtFail(error, vt_errorFile, "stopped; %s",
                      run->plan->isVideo ? "no film is left, since it cannot be gone on with"
                                         : "the same command goes on with the rest");
    }
    if (result == vt_ok && run->failed > 0) {
        return vtFail(error, vt_errorFile, "%d of %zu models could not be drawn, see above", run->failed,
                      run->plan->modelCount);
    }
    return result;
}

vtResult vtRunSeries(const vtOptions* options, vtError* error)
{
    vtPlan plan;
    vtPictureFormat format;
    vtResult result = vtMakePlan(options, &plan, error);
    if (result == vt_ok) {
        result = vtChoosePictureFormat(options, &format, error);
    }
    if (result != vt_ok) {
        vtDestroyPlan(&plan);
        return result;
    }
    Run run = {.options = options,
               .plan = &plan,
               .eye = plan.eye,
               .drawing = {.options = options, .format = format},
               .video = {.pipe = -1, .file.descriptor = -1},
               .start = vtNow(),
               .told = vtNow()};
    run.drawing.eye = &run.eye;
    for (size_t i = 0; i < plan.modelCount; ++i) {
        run.expected += vtPlan_CountOwn(&plan, i, plan.frameCount);
    }
    holdSignals(&run);
    for (size_t i = 0; i < plan.modelCount && result == vt_ok && !isStopped(&run); ++i) {
        result = drawModel(&run, i, error);
    }
    result = finish(&run, result, error);
    vtDropVideo(&run.video);
    vtDestroyPicture(&run.picture);
    vtCloseSession(&run.session);
    vtDestroyPlan(&plan);
    if (run.stoppedBy != 0) {
        fprintf(stderr, "vitrine: %s\n", error->message);
        sigprocmask(SIG_UNBLOCK, &run.signals, NULL); // ends here, as a program does that was sent it
    }
    return result;
}
