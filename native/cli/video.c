#include "cli/video.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"

static const char* endingOf(const char* path)
{
    const char* dot = strrchr(path, '.');
    return dot != NULL ? dot : "";
}

bool vtIsVideo(const char* path)
{
    static const char* const endings[] = {".mp4", ".mov", ".mkv", ".webm"};
    bool is = false;
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; ++i) {
        is = is || strcasecmp(endingOf(path), endings[i]) == 0;
    }
    return is;
}

/// In the child: becomes ffmpeg, or ends with 127.
static void becomeFfmpeg(const char* path, int frames, int width, int height, double fps)
{
    char size[32], rate[32];
    snprintf(size, sizeof size, "%dx%d", width, height);
    snprintf(rate, sizeof rate, "%g", fps);
    const bool isWebm = strcasecmp(endingOf(path), ".webm") == 0;
    const char* const words[] = {"ffmpeg", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba",
                                 "-s", size, "-r", rate, "-i", "-", "-an",
                                 // even sides, as 4:2:0 needs, and the standard's matrix for them
                                 "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709",
                                 "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
                                 "-pix_fmt", "yuv420p", "-c:v", isWebm ? "libvpx-vp9" : "libx264", "-crf",
                                 isWebm ? "24" : "18", "-b:v", "0", path, NULL};
    sigset_t none;
    sigemptyset(&none);
    setpgid(0, 0); // an interrupt from the terminal is ours to handle
    signal(SIGPIPE, SIG_DFL);
    sigprocmask(SIG_SETMASK, &none, NULL);
    if (dup2(frames, STDIN_FILENO) >= 0) {
        execvp("ffmpeg", (char* const*)(const void*)words);
    }
    _exit(127);
}

vtResult vtBeginVideo(const char* path, int width, int height, double fps, vtVideo* video, vtError* error)
{
    *video = (vtVideo){.pipe = -1, .file.descriptor = -1};
    vtResult result = vtBeginFile(path, endingOf(path), &video->file, error);
    int ends[2];
    if (result == vt_ok && pipe(ends) != 0) {
        result = vtFail(error, vt_errorFile, "film '%s': no pipe to ffmpeg: %s", path, strerror(errno));
    }
    if (result != vt_ok) {
        vtDropVideo(video);
        return result;
    }
    fflush(NULL);
    video->process = fork();
    if (video->process == 0) {
        close(ends[1]);
        becomeFfmpeg(video->file.path, ends[0], width, height, fps);
    }
    close(ends[0]);
    video->pipe = ends[1];
    if (video->process < 0) {
        result =
            vtFail(error, vt_errorFile, "film '%s': ffmpeg cannot be started: %s", path, strerror(errno));
        vtDropVideo(video);
    }
    return result;
}

/// Why ffmpeg ended before its film did.
static vtResult explainEnd(vtVideo* video, vtError* error)
{
    int status = 0;
    if (video->pipe >= 0) {
        close(video->pipe);
        video->pipe = -1;
    }
    while (waitpid(video->process, &status, 0) < 0 && errno == EINTR) {
    }
    video->process = 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        return vt_ok;
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
        return vtFail(error, vt_errorFile,
                      "film '%s': ffmpeg cannot be run; install it (on Debian the package ffmpeg), or write "
                      "pictures, -o NAME-{frame}.png",
                      video->file.place);
    }
    return WIFEXITED(status)
               ? vtFail(error, vt_errorFile, "film '%s': ffmpeg ended with code %d; see what it says above",
                        video->file.place, WEXITSTATUS(status))
               : vtFail(error, vt_errorFile, "film '%s': ffmpeg was ended by signal %d", video->file.place,
                        WTERMSIG(status));
}

vtResult vtVideo_Add(vtVideo* video, const uint8_t* pixels, size_t size, vtError* error)
{
    while (size > 0) {
        const ssize_t count = write(video->pipe, pixels, size);
        if (count < 0 && errno != EINTR) {
            const int reason = errno;
            const vtResult result = explainEnd(video, error);
            return result != vt_ok ? result
                                   : vtFail(error, vt_errorFile, "film '%s': ffmpeg takes no more frames: %s",
                                            video->file.place, strerror(reason));
        }
        pixels += count > 0 ? count : 0;
        size -= count > 0 ? (size_t)count : 0;
    }
    return vt_ok;
}

vtResult vtEndVideo(vtVideo* video, vtError* error)
{
    vtResult result = explainEnd(video, error);
    if (result == vt_ok) {
        return vtFinishFile(&video->file, error);
    }
    vtDropVideo(video);
    return result;
}

void vtDropVideo(vtVideo* video)
{
    if (video->process > 0) {
        kill(video->process, SIGKILL);
        vtError error;
        explainEnd(video, &error);
    }
    if (video->pipe > 0) {
        close(video->pipe);
    }
    if (video->file.path[0] != '\0') {
        vtDropFile(&video->file);
    }
    *video = (vtVideo){.pipe = -1, .file.descriptor = -1};
}
