// The eye between its keys goes along a cubic through them, whose slope at a key is that from the key before
// to the one behind it: Catmull & Rom, "A Class of Local Interpolating Splines", 1974.
// Departures: the keys' times are their parameters, whatever their distances; at the ends the slope is that
// of the first and the last piece.
#include "cli/camera_path.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/math.h"
#include "cli/files.h"

enum { mostKeys = 100000 };

// --------------------------------------------------------------------------------------------- the keys

/// Reads a line "SECONDS X,Y,Z X,Y,Z [DEGREES]", the eye and what it looks at.
static bool readKey(const char* line, vtCameraKey* key)
{
    vtView* view = &key->view;
    int end = 0;
    *key = (vtCameraKey){0};
    if (sscanf(line, "%lf %f,%f,%f %f,%f,%f %n", &key->time, &view->eye.x, &view->eye.y, &view->eye.z,
               &view->target.x, &view->target.y, &view->target.z, &end) != 7 ||
        end == 0) {
        return false;
    }
    if (line[end] != '\0') {
        int more = 0;
        if (sscanf(line + end, "%f %n", &view->fovY, &more) != 1 || line[end + more] != '\0' ||
            !(view->fovY >= 1.0f && view->fovY <= 170.0f)) {
            return false;
        }
    }
    const float all[6] = {view->eye.x,    view->eye.y,    view->eye.z,
                          view->target.x, view->target.y, view->target.z};
    bool isFinite = isfinite(key->time);
    for (int i = 0; i < 6; ++i) {
        isFinite = isFinite && isfinite(all[i]);
    }
    return isFinite;
}

static vtResult addKey(const char* file, int row, const char* line, vtCameraPath* path, vtError* error)
{
    vtCameraKey* key = &path->keys[path->keyCount];
    if (path->keyCount == mostKeys) {
        return vtFail(error, vt_errorArgument, "--camera-keys '%.200s' has more than %d keys", file,
                      mostKeys);
    }
    if (!readKey(line, key)) {
        return vtFail(error, vt_errorArgument,
                      "--camera-keys '%.200s', line %d is '%.100s'; it must be SECONDS X,Y,Z X,Y,Z, the eye "
                      "and what it looks at, and may end with a field of view of 1 to 170 degrees",
                      file, row, line);
    }
    if (path->keyCount > 0 && key->time <= key[-1].time) {
        return vtFail(error, vt_errorArgument,
                      "--camera-keys '%.200s', line %d: its time, %g s, is not after that of the key before, "
                      "%g s",
                      file, row, key->time, key[-1].time);
    }
    ++path->keyCount;
    return vt_ok;
}

static vtResult readKeys(const char* file, vtCameraPath* path, vtError* error)
{
    char* text;
    vtResult result = vtReadText(file, &text, error);
    if (result != vt_ok) {
        return result;
    }
    size_t lines = 1;
    for (const char* end = strchr(text, '\n'); end != NULL; end = strchr(end + 1, '\n')) {
        ++lines;
    }
    path->keys = calloc(lines < mostKeys ? lines + 1 : mostKeys + 1, sizeof *path->keys);
    if (path->keys == NULL) {
        result = vtFail(error, vt_errorMemory, "--camera-keys '%.200s': out of memory", file);
    }
    char *at = text, *line;
    for (int row = 1; result == vt_ok && (line = vtNextLine(&at)) != NULL; ++row) {
        line[strcspn(line, "#")] = '\0';
        if (line[strspn(line, " \t")] != '\0') {
            result = addKey(file, row, line, path, error);
        }
    }
    free(text);
    if (result == vt_ok && path->keyCount == 0) {
        result = vtFail(error, vt_errorArgument, "--camera-keys '%.200s' has no key", file);
    }
    return result;
}

vtResult vtMakeCameraPath(const vtOptions* options, vtCameraPath* path, vtError* error)
{
    *path = (vtCameraPath){.turntable = options->turntable, .fps = (double)options->fps};
    if (options->cameraKeys == NULL) {
        return vt_ok;
    }
    const char* other = options->turntable > 0          ? "--turntable"
                        : options->hasCamera            ? "--camera"
                        : options->hasTarget            ? "--target"
                        : options->cameraOfFile != NULL ? "--camera-index"
                                                        : NULL;
    if (other != NULL) {
        return vtFail(error, vt_errorArgument,
                      "--camera-keys and %s both say where the eye is; leave one of them out", other);
    }
    const vtResult result = readKeys(options->cameraKeys, path, error);
    if (result != vt_ok) {
        vtDestroyCameraPath(path);
    }
    return result;
}

void vtDestroyCameraPath(vtCameraPath* path)
{
    free(path->keys);
    *path = (vtCameraPath){0};
}

// -------------------------------------------------------------------------------------------- the path

int vtCameraPath_FrameCount(const vtCameraPath* path)
{
    if (path->keyCount > 0) {
        const double last = floor(path->keys[path->keyCount - 1].time * path->fps + 1e-6);
        return last < 1e6 ? (int)fmax(last, 0.0) + 1 : 1000000;
    }
    return path->turntable;
}

/// Slope at a key, a second.
static vtVec3 slopeAt(const vtCameraPath* path, size_t i, size_t offset)
{
    const vtCameraKey* before = &path->keys[i > 0 ? i - 1 : i];
    const vtCameraKey* behind = &path->keys[i + 1 < path->keyCount ? i + 1 : i];
    const vtVec3* from = (const vtVec3*)(const void*)((const char*)before + offset);
    const vtVec3* to = (const vtVec3*)(const void*)((const char*)behind + offset);
    return vtScale(vtSub(*to, *from), (float)(1.0 / (behind->time - before->time)));
}

/// A point of the keys, at `offset` in each, at a share of the piece behind key i.
static vtVec3 pointAt(const vtCameraPath* path, size_t i, double share, size_t offset)
{
    const vtCameraKey* key = &path->keys[i];
    const vtVec3* from = (const vtVec3*)(const void*)((const char*)key + offset);
    const vtVec3* to = (const vtVec3*)(const void*)((const char*)(key + 1) + offset);
    const double length = key[1].time - key->time, s = share, s2 = s * s, s3 = s2 * s;
    const vtVec3 points = vtMix(*from, *to, (float)(3.0 * s2 - 2.0 * s3));
    const vtVec3 first = vtScale(slopeAt(path, i, offset), (float)(length * (s3 - 2.0 * s2 + s)));
    const vtVec3 second = vtScale(slopeAt(path, i + 1, offset), (float)(length * (s3 - s2)));
    return vtAdd(points, vtAdd(first, second));
}

static float fovAt(const vtCameraKey* key, double share, float usual)
{
    const float from = key->view.fovY > 0.0f ? key->view.fovY : usual;
    const float to = key[1].view.fovY > 0.0f ? key[1].view.fovY : usual;
    return from + (float)share * (to - from);
}

static vtView viewOfKeys(const vtCameraPath* path, double time)
{
    const vtCameraKey* keys = path->keys;
    const size_t last = path->keyCount - 1;
    size_t i = 0;
    while (i < last && keys[i + 1].time < time) {
        ++i;
    }
    vtView view;
    if (i == last || time <= keys[i].time) {
        view = keys[i].view;
        view.fovY = view.fovY > 0.0f ? view.fovY : path->view.fovY;
        return view;
    }
    const double share = (time - keys[i].time) / (keys[i + 1].time - keys[i].time);
    view.eye = pointAt(path, i, share, offsetof(vtCameraKey, view.eye));
    view.target = pointAt(path, i, share, offsetof(vtCameraKey, view.target));
    view.fovY = fovAt(&keys[i], share, path->view.fovY);
    return view;
}

void vtCameraPath_SetView(const vtCameraPath* path, double number, vtFrame* frame)
{
    const double turn = 2.0 * 3.14159265358979323846;
    if (path->keyCount > 0) {
        frame->view = viewOfKeys(path, number / path->fps);
    } else if (path->turntable > 0) {
        frame->view = vtView_Orbit(path->view, (float)(turn * number / path->turntable), 0.0f);
    }
}
