// Frames into a film through ffmpeg's pipe, where ffmpeg is installed.
#pragma once

#include <sys/types.h>

#include "cli/files.h"

/// Does a name end as a film's: .mp4, .mov, .mkv or .webm?
bool vtIsVideo(const char* path);

/// A film that is being made. Starts as {0}.
typedef struct vtVideo {
    vtUnfinishedFile file;
    int pipe; ///< to ffmpeg; -1: none
    pid_t process;
} vtVideo;

/// Starts ffmpeg. H.264 (in .webm VP9) of 4:2:0; an odd side gets one more row or column, black.
/// Fails with a sentence where ffmpeg is not to be had.
vtResult vtBeginVideo(const char* path, int width, int height, double fps, vtVideo* video, vtError* error);

/// Adds a frame, RGBA of 8 bits, top row first; alpha is dropped.
vtResult vtVideo_Add(vtVideo* video, const uint8_t* pixels, size_t size, vtError* error);

/// Waits for ffmpeg and puts the film into its place. On failure nothing of it is left.
vtResult vtEndVideo(vtVideo* video, vtError* error);

/// Nothing of it is left. Safe on {0} and after vtEndVideo.
void vtDropVideo(vtVideo* video);
