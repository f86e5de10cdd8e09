// Which pictures a series has, and which of them are this process's part.
#pragma once

#include "cli/camera_path.h"
#include "cli/part.h"

/// What is wrong with frames of what stands still: of a model's name.
#define VT_NOTHING_MOVES                                                                                     \
    "frames are asked for, but nothing moves in '%.200s'; add --turntable N or --camera-keys FILE"

typedef struct vtPlan {
    const char** models; ///< NULL: what --object gives
    size_t modelCount;
    char* list; ///< the text of --list, which `models` point into
    bool hasFrames;
    int firstFrame, frameCount; ///< of each model; 1 without frames, 0: as long as its animation
    bool isVideo;
    vtPart part;
    vtCameraPath eye;
    uint64_t contents; ///< hash of the files that only the plan reads
} vtPlan;

/// Fails with a sentence where options contradict each other or lack something. vtDestroyPlan is safe after
/// that.
vtResult vtMakePlan(const vtOptions* options, vtPlan* plan, vtError* error);
void vtDestroyPlan(vtPlan* plan);

/// Frames of a model whose animation takes so many seconds.
int vtPlan_CountFrames(const vtPlan* plan, double seconds);
/// Is the picture of that model and frame this part's? Parts take turns, so that each has as much to do.
bool vtPlan_IsOwn(const vtPlan* plan, size_t model, int frame);
/// How many pictures the part has of a model of so many frames.
int vtPlan_CountOwn(const vtPlan* plan, size_t model, int frameCount);
