#include "cli/series_plan.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "cli/files.h"
#include "cli/hash.h"
#include "cli/output_name.h"
#include "cli/series.h"
#include "cli/video.h"

enum { mostFrames = 1000000 };

bool vtIsSeries(const vtOptions* options)
{
    return options->modelCount > 1 || options->list != NULL || options->turntable > 0 ||
           options->cameraKeys != NULL || options->asksForFrames ||
           (options->output != NULL && vtPatternHas(options->output, "{name}"));
}

// ----------------------------------------------------------------------------------------------- options

/// What is said of one picture, or of nothing that is there.
static vtResult checkOptions(const vtOptions* options, const vtPlan* plan, vtError* error)
{
    const char* ofOne = options->directions != NULL   ? "--directions"
                        : options->layerSheet != NULL ? "--layer-sheet"
                        : options->events != NULL     ? "--events"
                        : options->reference != NULL  ? "--reference"
                                                      : NULL;
    if (ofOne != NULL) {
        return vtFail(error, vt_errorArgument, "%s is of one picture; several are asked for", ofOne);
    }
    if (options->output == NULL) {
        return vtFail(error, vt_errorArgument, "no output given; add -o 'NAME-{frame}.png' or -o NAME.mp4");
    }
    if (strcmp(options->output, "-") == 0) {
        return vtFail(error, vt_errorArgument,
                      "-o - takes one picture, several are asked for; name files, -o 'NAME-{frame}.png'");
    }
    if (plan->isVideo && options->bits != 0) {
        return vtFail(error, vt_errorArgument, "--bits is of a PNG; '%.200s' is a film, so leave it out",
                      options->output);
    }
    if (options->shutter > 0.0f && vtIsReference(options)) {
        return vtFail(error, vt_errorArgument,
                      "--shutter: technique 'reference' has no moments between frames; leave it out");
    }
    if (options->shutter > 0.0f && options->samples == 1) {
        return vtFail(error, vt_errorArgument,
                      "--shutter is spread over a picture's samples, of which there is 1; add --samples 16");
    }
    return vtCheckPattern(options->output, error);
}

// ------------------------------------------------------------------------------------------------ models

static vtResult readList(const char* path, vtPlan* plan, vtError* error)
{
    const vtResult result = vtReadText(path, &plan->list, error);
    if (result != vt_ok) {
        return result;
    }
    size_t lines = 1;
    for (const char* end = strchr(plan->list, '\n'); end != NULL; end = strchr(end + 1, '\n')) {
        ++lines;
    }
    plan->models = calloc(lines, sizeof *plan->models);
    if (plan->models == NULL) {
        return vtFail(error, vt_errorMemory, "--list '%.200s': out of memory", path);
    }
    char *at = plan->list, *line;
    while ((line = vtNextLine(&at)) != NULL) {
        if (*line != '\0') {
            plan->models[plan->modelCount++] = line;
        }
    }
    return plan->modelCount > 0
               ? vt_ok
               : vtFail(error, vt_errorArgument, "--list '%.200s' names no model; it has one a line", path);
}

static int compareNames(const void* a, const void* b)
{
    char left[1024], right[1024];
    vtNameModel(*(const char* const*)a, left, sizeof left);
    vtNameModel(*(const char* const*)b, right, sizeof right);
    return strcmp(left, right);
}

/// No two models may write the same file.
static vtResult checkNames(const vtOptions* options, const vtPlan* plan, vtError* error)
{
    if (plan->modelCount < 2) {
        return vt_ok;
    }
    if (!vtPatternHas(options->output, "{name}") || plan->isVideo) {
        return vtFail(
            error, vt_errorArgument,
            plan->isVideo
                ? "'%.200s' is a second model, but -o '%.200s' is one film; add it to its scene with "
                  "--object"
                : "'%.200s' is a second model, but -o '%.200s' names one file; let it have {name}, as "
                  "'out/{name}.png', or add the model to the scene with --object",
            plan->models[1], options->output);
    }
    const char** sorted = malloc(plan->modelCount * sizeof *sorted);
    if (sorted == NULL) {
        return vtFail(error, vt_errorMemory, "out of memory for %zu models", plan->modelCount);
    }
    memcpy(sorted, plan->models, plan->modelCount * sizeof *sorted);
    qsort(sorted, plan->modelCount, sizeof *sorted, compareNames);
    vtResult result = vt_ok;
    for (size_t i = 1; i < plan->modelCount && result == vt_ok; ++i) {
        if (compareNames(&sorted[i - 1], &sorted[i]) == 0) {
            result = vtFail(error, vt_errorArgument,
                            "models '%.200s' and '%.200s' have the same {name}, so both would write the same "
                            "file; draw them apart",
                            sorted[i - 1], sorted[i]);
        }
    }
    free(sorted);
    return result;
}

static vtResult findModels(const vtOptions* options, vtPlan* plan, vtError* error)
{
    if (options->list != NULL && options->modelCount > 0) {
        return vtFail(error, vt_errorArgument,
                      "--list names the models; '%.200s' beside it is one too many, add it to the list",
                      options->models[0]);
    }
    if (options->list != NULL) {
        return readList(options->list, plan, error);
    }
    plan->modelCount = options->modelCount > 0 ? (size_t)options->modelCount : 1;
    plan->models = calloc(plan->modelCount, sizeof *plan->models);
    if (plan->models == NULL) {
        return vtFail(error, vt_errorMemory, "out of memory for %zu models", plan->modelCount);
    }
    for (int i = 0; i < options->modelCount; ++i) {
        plan->models[i] = options->models[i];
    }
    return vt_ok;
}

// ------------------------------------------------------------------------------------------------ frames

/// "A:B", both of them drawn, or "A:" to the end that there is.
static bool readRange(const char* text, int end, int* first, int* last)
{
    int read = 0;
    if (sscanf(text, "%7d:%n", first, &read) != 1 || read == 0 || text[0] < '0' || text[0] > '9') {
        return false;
    }
    *last = end - 1;
    if (text[read] != '\0') {
        int more = 0;
        if (sscanf(text + read, "%7d%n", last, &more) != 1 || text[read + more] != '\0' || text[read] < '0' ||
            text[read] > '9') {
            return false;
        }
    }
    return *first <= *last && *last < mostFrames;
}

static vtResult findFrames(const vtOptions* options, vtPlan* plan, vtError* error)
{
    const int count = vtCameraPath_FrameCount(&plan->eye);
    const bool byAnimation = count == 0 && options->plays && options->asksForFrames;
    plan->hasFrames = count > 0 || byAnimation;
    plan->frameCount = byAnimation ? 0 : 1;
    if (!plan->hasFrames) {
        return options->asksForFrames ? vtFail(error, vt_errorArgument, VT_NOTHING_MOVES, "the scene")
                                      : vt_ok;
    }
    int last = count - 1;
    if (options->frameRange != NULL &&
        !readRange(options->frameRange, count > 0 ? count : mostFrames, &plan->firstFrame, &last)) {
        char most[48] = "";
        if (count > 0) {
            snprintf(most, sizeof most, ", which is %d", count - 1);
        }
        return vtFail(
            error, vt_errorArgument,
            "--frames is '%.100s'; it must be A:B, the first and the last, counted from 0, or A: to "
            "the last%s",
            options->frameRange, most);
    }
    if (count > 0 || (options->frameRange != NULL && last < mostFrames - 1)) {
        plan->frameCount = last - plan->firstFrame + 1;
    }
    return vt_ok;
}

int vtPlan_CountFrames(const vtPlan* plan, double seconds)
{
    if (plan->frameCount > 0) {
        return plan->frameCount;
    }
    const double last = fmin(floor(seconds * plan->eye.fps + 1e-6), mostFrames - 1);
    return (int)fmax(last - plan->firstFrame + 1.0, 0.0);
}

// -------------------------------------------------------------------------------------------------- plan

/// The keys count for what is drawn.
static uint64_t hashKeys(const vtCameraPath* eye)
{
    uint64_t hash = VT_NO_HASH;
    for (size_t i = 0; i < eye->keyCount; ++i) {
        hash = vtHash(hash, &eye->keys[i].time, sizeof(double));
        hash = vtHash(hash, &eye->keys[i].view, sizeof(vtView));
    }
    return hash;
}

vtResult vtMakePlan(const vtOptions* options, vtPlan* plan, vtError* error)
{
    *plan = (vtPlan){.isVideo = options->output != NULL && vtIsVideo(options->output)};
    vtResult result = checkOptions(options, plan, error);
    if (result == vt_ok) {
        result = findModels(options, plan, error);
    }
    if (result == vt_ok) {
        result = checkNames(options, plan, error);
    }
    if (result == vt_ok) {
        result = vtMakeCameraPath(options, &plan->eye, error);
    }
    if (result == vt_ok) {
        result = findFrames(options, plan, error);
    }
    if (result == vt_ok) {
        result = vtFindPart(options, &plan->part, error);
    }
    if (result == vt_ok && plan->isVideo && plan->part.count > 1) {
        result =
            vtFail(error, vt_errorArgument,
                   "-o '%.200s' is one film, which cannot be drawn in parts; let the parts write pictures, "
                   "-o 'NAME-{frame}.png', and make the film of them",
                   options->output);
    }
    plan->contents = hashKeys(&plan->eye);
    return result;
}

void vtDestroyPlan(vtPlan* plan)
{
    free(plan->models);
    free(plan->list);
    vtDestroyCameraPath(&plan->eye);
    *plan = (vtPlan){0};
}

bool vtPlan_IsOwn(const vtPlan* plan, size_t model, int frame)
{
    return (model + (size_t)frame) % (size_t)plan->part.count == (size_t)plan->part.number - 1;
}

int vtPlan_CountOwn(const vtPlan* plan, size_t model, int frameCount)
{
    int count = 0;
    for (int i = 0; i < frameCount; ++i) {
        count += vtPlan_IsOwn(plan, model, i);
    }
    return count;
}
