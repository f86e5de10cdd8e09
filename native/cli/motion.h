// What moves from frame to frame: the eye, on a turntable or along keys.
#pragma once

#include "cli/options.h"

/// A place of the eye, at its time.
typedef struct vtCameraKey {
    double time; ///< seconds
    vtView view; ///< fovY 0: that of the options
} vtCameraKey;

typedef struct vtMotion {
    vtView view;       ///< without motion; the turntable turns it
    double fps;        ///< frames a second
    int turntable;     ///< frames of a turn; 0: it does not turn
    vtCameraKey* keys; ///< times rising; NULL: there are none
    size_t keyCount;
} vtMotion;

/// By the options; reads the file of keys. Fails with a sentence that names option, value and remedy.
vtResult vtMakeMotion(const vtOptions* options, vtMotion* motion, vtError* error);
void vtDestroyMotion(vtMotion* motion);

/// Frames from 0 on until it has come to its end; 0: it has none.
int vtMotion_FrameCount(const vtMotion* motion);

/// Puts the eye where it is at a frame; between two frames, too.
void vtMotion_SetView(const vtMotion* motion, double number, vtFrame* frame);
