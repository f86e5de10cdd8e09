// What moves from frame to frame: the eye, on a turntable or along keys.
#pragma once

#include "cli/options.h"

/// A place of the eye, at its time.
typedef struct vtCameraKey {
    double time; ///< seconds
    vtView view; ///< fovY 0: that of the options
} vtCameraKey;

typedef struct vtCameraPath {
    vtView view;       ///< without path; the turntable turns it
    double fps;        ///< frames a second
    int turntable;     ///< frames of a turn; 0: it does not turn
    vtCameraKey* keys; ///< times rising; NULL: there are none
    size_t keyCount;
} vtCameraPath;

/// By the options; reads the file of keys. Fails with a sentence that names option, value and remedy.
vtResult vtMakeCameraPath(const vtOptions* options, vtCameraPath* path, vtError* error);
void vtDestroyCameraPath(vtCameraPath* path);

/// Frames from 0 on until it has come to its end; 0: it has none.
int vtCameraPath_FrameCount(const vtCameraPath* path);

/// Puts the eye where it is at a frame; between two frames, too.
void vtCameraPath_SetView(const vtCameraPath* path, double number, vtFrame* frame);
