// Pictures and paths read back from the GPU.
#include <stdlib.h>
#include <string.h>

#include "base/about.h"
#include "base/error.h"
#include "base/memory.h"
#include "gl/state.h"
#include "render/renderer.h"
#include "technique/technique.h"

vtResult vtRenderer_DrawImage(vtRenderer* renderer, const vtFrame* frame, uint8_t* rgba, vtError* error)
{
    vtResult result = vtCheckGiven(renderer, frame, VT_ABOUT("the frame"), error);
    result = result == vt_ok ? vtValidateFrame(frame, error) : result;
    if (result != vt_ok) {
        return result;
    }
    const vtGL* gl = &renderer->gl;
    vtTakeState(gl);
    if (vtTexture_Resize(&renderer->image, gl, GL_RGBA8, frame->width, frame->height, 0)) {
        vtAttachment color = {&renderer->image, 0};
        result = vtMakeFramebuffer(gl, "image", &color, 1, NULL, &renderer->imageFramebuffer, error);
        if (result != vt_ok) {
            return result;
        }
    }
    vtFrame offscreen = *frame;
    offscreen.framebuffer = renderer->imageFramebuffer;
    offscreen.x = offscreen.y = 0;
    offscreen.linear = offscreen.overlay = false;
    result = vtRenderer_Draw(renderer, &offscreen, error);
    if (result != vt_ok) {
        return result;
    }

    if (rgba == NULL) {
        gl->Finish();
        gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
        return vtSucceed(error);
    }
    gl->ReadPixels(0, 0, frame->width, frame->height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    // GL's first row is the bottom one.
    size_t rowBytes = 4 * (size_t)frame->width;
    for (int top = 0, bottom = frame->height - 1; top < bottom; ++top, --bottom) {
        uint8_t* a = rgba + rowBytes * (size_t)top;
        uint8_t* b = rgba + rowBytes * (size_t)bottom;
        for (size_t i = 0; i < rowBytes; ++i) {
            uint8_t swapped = a[i];
            a[i] = b[i];
            b[i] = swapped;
        }
    }
    return vtCheckGL(gl, "reading the picture back", error);
}

/// The path target: four words a pixel, bottom row first, from vtAllocate.
static vtResult readPaths(vtRenderer* renderer, uint32_t** paths, vtError* error)
{
    const vtGL* gl = &renderer->gl;
    const int width = vtRenderer_Paths(renderer)->width, height = vtRenderer_Paths(renderer)->height;
    if (width == 0) {
        return vtFail(error, vt_errorArgument, "directions: no frame has been drawn that they could be of");
    }
    vtTakeState(gl);
    *paths = vtAllocate((size_t)width * (size_t)height, 16);
    if (*paths == NULL) {
        return vtFail(error, vt_errorMemory, "directions: out of memory for %d x %d pixels", width, height);
    }
    gl->BindFramebuffer(GL_FRAMEBUFFER, vtTechnique_Row(renderer->frame.technique)->traces
                                            ? renderer->trace.framebuffers[0]
                                            : renderer->refract.framebuffers[0]);
    gl->ReadPixels(0, 0, width, height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, *paths);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    return vt_ok;
}

vtResult vtRenderer_ReadDirections(vtRenderer* renderer, float* directions, vtError* error)
{
    vtResult result = vtCheckGiven(renderer, directions, VT_ABOUT("where directions go"), error);
    if (result != vt_ok) {
        return result;
    }
    const int width = vtRenderer_Paths(renderer)->width, height = vtRenderer_Paths(renderer)->height;
    uint32_t* paths;
    result = readPaths(renderer, &paths, error);
    if (result != vt_ok) {
        return result;
    }
    for (int row = 0; row < height; ++row) {
        const uint32_t* from = paths + 4 * (size_t)width * (size_t)(height - 1 - row);
        float* to = directions + 3 * (size_t)width * (size_t)row;
        for (int column = 0; column < width; ++column, from += 4, to += 3) {
            int state = (int)(from[3] & 255u);
            if (state == VT_PATH_EXITED || (state == VT_PATH_OPAQUE && ((from[3] >> 8) & 255u) > 0)) {
                memcpy(to, from, 3 * sizeof(float));
            } else {
                to[0] = to[1] = to[2] = state == VT_PATH_LOST ? 2.0f : 0.0f;
            }
        }
    }
    vtFree(paths);
    return vtCheckGL(&renderer->gl, "reading directions back", error);
}

vtResult vtRenderer_ReadStates(vtRenderer* renderer, uint32_t* states, vtError* error)
{
    vtResult result = vtCheckGiven(renderer, states, VT_ABOUT("where states go"), error);
    if (result != vt_ok) {
        return result;
    }
    const int width = vtRenderer_Paths(renderer)->width, height = vtRenderer_Paths(renderer)->height;
    uint32_t* paths;
    result = readPaths(renderer, &paths, error);
    if (result != vt_ok) {
        return result;
    }
    for (int row = 0; row < height; ++row) {
        const uint32_t* from = paths + 4 * (size_t)width * (size_t)(height - 1 - row);
        for (int column = 0; column < width; ++column, from += 4) {
            *states++ = from[3];
        }
    }
    vtFree(paths);
    return vtCheckGL(&renderer->gl, "reading states back", error);
}
