// Which pictures a series has, and which of them are this process's part.
#pragma once

#include "cli/motion.h"
#include "cli/part.h"

typedef struct vtPlan {
    const char** models; ///< NULL: what --object gives
    size_t modelCount;
    char* list; ///< the text of --list, which `models` point into
    bool hasFrames;
    int firstFrame, frameCount; ///< of each model; 1 where it has no frames
    bool isVideo;
    vtPart part;
    int ownCount; ///< pictures of this part
    vtMotion motion;
    uint64_t contents; ///< hash of the files that only the plan reads
} vtPlan;

/// Fails with a sentence where options contradict each other or lack something. vtDestroyPlan is safe after
/// that.
vtResult vtMakePlan(const vtOptions* options, vtPlan* plan, vtError* error);
void vtDestroyPlan(vtPlan* plan);

/// Is the picture of that model and frame this part's? Parts take turns, so that each has as much to do.
bool vtPlan_IsOwn(const vtPlan* plan, size_t model, int frame);
/// Has the part a picture of that model?
bool vtPlan_HasOwn(const vtPlan* plan, size_t model);
