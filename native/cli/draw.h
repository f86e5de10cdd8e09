// One picture, from a frame to the bytes of its file.
#pragma once

#include "cli/camera_path.h"
#include "cli/picture_output.h"
#include "cli/session.h"
#include "lab/reference/reference.h"

/// How a picture is drawn and kept.
typedef struct vtDrawing {
    const vtOptions* options;
    vtPictureFormat format;
    const vtCameraPath* eye; ///< NULL: it is no frame of something that moves
    int number;              ///< of the frame, whose time is so many frames after --time
    const char* comment;     ///< in the file; NULL: none
    bool showsProgress;      ///< on standard error
} vtDrawing;

/// What is drawn. Starts as {0}; vtDestroyPicture frees it.
typedef struct vtPicture {
    uint8_t* pixels; ///< 8 bits, RGBA, top row first
    uint8_t* bytes;  ///< the file's
    size_t size;
    vtReferenceImage traced; ///< of the reference alone
} vtPicture;

/// Draws with the session's renderer, or traces where the session has none. What moves is moved to the
/// frame's time, and the eye of *frame, too. *picture is filled anew.
vtResult vtDrawPicture(const vtDrawing* drawing, vtSession* session, vtFrame* frame, vtPicture* picture,
                       vtError* error);
void vtDestroyPicture(vtPicture* picture);
