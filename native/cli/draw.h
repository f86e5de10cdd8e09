// One picture, from a frame to the bytes of its file.
#pragma once

#include "cli/motion.h"
#include "cli/picture_output.h"
#include "cli/session.h"
#include "lab/reference/reference.h"

/// How a picture is drawn and kept.
typedef struct vtDrawing {
    const vtOptions* options;
    vtPictureFormat format;
    const vtMotion* motion; ///< while the shutter is open; NULL: nothing moves
    double number;          ///< of the frame in the motion
    const char* comment;    ///< in the file; NULL: none
    bool showsProgress;     ///< on standard error
} vtDrawing;

/// What is drawn. Starts as {0}; vtDestroyPicture frees it.
typedef struct vtPicture {
    uint8_t* pixels; ///< 8 bits, RGBA, top row first
    uint8_t* bytes;  ///< the file's
    size_t size;
    vtReferenceImage traced; ///< of the reference alone
} vtPicture;

/// Draws with the session's renderer, or traces where the session has none. *picture is
/// filled anew.
vtResult vtDrawPicture(const vtDrawing* drawing, const vtSession* session, const vtFrame* frame,
                       vtPicture* picture, vtError* error);
void vtDestroyPicture(vtPicture* picture);
