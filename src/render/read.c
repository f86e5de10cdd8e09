// Pictures and paths read back from the GPU.
#include <stdlib.h>
#include <string.h>

#include "base/about.h"
#include "base/error.h"
#include "base/memory.h"
#include "gl/state.h"
#include "render/renderer.h"
#include "technique/technique.h"

/// GL's first row is the bottom one.
static void flipRows(uint8_t* rows, size_t rowBytes, int height)
{
    for (int top = 0, bottom = height - 1; top < bottom; ++top, --bottom) {
        uint8_t *a = rows + rowBytes * (size_t)top, *b = rows + rowBytes * (size_t)bottom;
        for (size_t i = 0; i < rowBytes; ++i) {
            const uint8_t swapped = a[i];
            a[i] = b[i];
            b[i] = swapped;
        }
    }
}

/// Draws one frame into a texture of that format and reads it back.
static vtResult drawOffscreen(vtRenderer* renderer, const vtFrame* frame, GLenum format, GLenum layout,
                              GLenum type, void* rgba, vtError* error)
{
    const vtGL* gl = &renderer->gl;
    const vtResult fits = vtRenderer_CheckSize(renderer, frame, error);
    if (fits != vt_ok) {
        return fits;
    }
    vtTakeState(gl);
    if (vtTexture_Resize(&renderer->image, gl, format, frame->width, frame->height, 0)) {
        vtAttachment color = {&renderer->image, 0};
        const vtResult made =
            vtMakeFramebuffer(gl, "image", &color, 1, NULL, &renderer->imageFramebuffer, error);
        if (made != vt_ok) {
            vtRenderer_DropTargets(renderer);
            return made;
        }
    }
    vtFrame offscreen = *frame;
    offscreen.framebuffer = renderer->imageFramebuffer;
    offscreen.x = offscreen.y = 0;
    offscreen.overlay = false;
    const vtResult result = vtRenderer_Draw(renderer, &offscreen, error);
    if (result != vt_ok) {
        return result;
    }

    if (rgba == NULL) {
        gl->Finish();
        gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
        return vtSucceed(error);
    }
    gl->ReadPixels(0, 0, frame->width, frame->height, layout, type, rgba);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    flipRows(rgba, (type == GL_UNSIGNED_BYTE ? 4 : 16) * (size_t)frame->width, frame->height);
    return vtRenderer_CheckDrawn(renderer, "reading the picture back", error);
}

static vtResult checkFrame(const vtRenderer* renderer, const vtFrame* frame, vtError* error)
{
    const vtResult result = vtCheckGiven(renderer, frame, VT_ABOUT("the frame"), error);
    return result == vt_ok ? vtValidateFrame(frame, error) : result;
}

vtResult vtRenderer_DrawImage(vtRenderer* renderer, const vtFrame* frame, uint8_t* rgba, vtError* error)
{
    const vtResult result = checkFrame(renderer, frame, error);
    if (result != vt_ok) {
        return result;
    }
    vtFrame encoded = *frame;
    encoded.linear = false;
    return drawOffscreen(renderer, &encoded, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, rgba, error);
}

vtResult vtRenderer_DrawFloats(vtRenderer* renderer, const vtFrame* frame, float* rgba, vtError* error)
{
    vtResult result = checkFrame(renderer, frame, error);
    if (result == vt_ok) {
        renderer->drawsFloats = true; // ES 3.0 draws to no floats, but to their bits
        result = drawOffscreen(renderer, frame, GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, rgba, error);
        renderer->drawsFloats = false;
    }
    return result;
}

/// The paths' target: four words a pixel, top row first, from vtAllocate; *count pixels.
static vtResult readPaths(vtRenderer* renderer, uint32_t** paths, size_t* count, vtError* error)
{
    const vtGL* gl = &renderer->gl;
    const int width = vtRenderer_Paths(renderer)->width, height = vtRenderer_Paths(renderer)->height;
    if (width == 0) {
        return vtFail(error, vt_errorArgument, "directions: no frame has been drawn that they could be of");
    }
    *count = (size_t)width * (size_t)height;
    *paths = vtAllocate(*count, 16);
    if (*paths == NULL) {
        return vtFail(error, vt_errorMemory, "directions: out of memory for %d x %d pixels", width, height);
    }
    vtTakeState(gl);
    const GLuint* traced = renderer->trace.framebuffers; // either has the paths
    gl->BindFramebuffer(GL_FRAMEBUFFER, !vtTechnique_Row(renderer->frame.technique)->traces
                                            ? renderer->refract.framebuffers[0]
                                        : traced[0] != 0 ? traced[0]
                                                         : traced[1]);
    gl->ReadPixels(0, 0, width, height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, *paths);
    gl->BindFramebuffer(GL_FRAMEBUFFER, 0);
    flipRows((uint8_t*)*paths, 16 * (size_t)width, height);
    return vt_ok;
}

vtResult vtRenderer_ReadDirections(vtRenderer* renderer, float* directions, vtError* error)
{
    uint32_t* paths;
    size_t count;
    vtResult result = vtCheckGiven(renderer, directions, VT_ABOUT("where directions go"), error);
    result = result == vt_ok ? readPaths(renderer, &paths, &count, error) : result;
    if (result != vt_ok) {
        return result;
    }
    for (size_t i = 0; i < count; ++i) {
        const uint32_t* from = paths + 4 * i;
        float* to = directions + 3 * i;
        const bool lost = (from[3] & 255u) == VT_PATH_LOST;
        if (!lost && ((from[3] >> 8 & 127u) > 0 || (from[3] & VT_PATH_WALL) != 0)) { // not of index 1
            memcpy(to, from, 3 * sizeof(float));
        } else {
            to[0] = to[1] = to[2] = lost ? 2.0f : 0.0f;
        }
    }
    vtFree(paths);
    return vtCheckGL(&renderer->gl, "reading directions back", error);
}

vtResult vtRenderer_ReadStates(vtRenderer* renderer, uint32_t* states, vtError* error)
{
    uint32_t* paths;
    size_t count;
    vtResult result = vtCheckGiven(renderer, states, VT_ABOUT("where states go"), error);
    result = result == vt_ok ? readPaths(renderer, &paths, &count, error) : result;
    if (result != vt_ok) {
        return result;
    }
    for (size_t i = 0; i < count; ++i) {
        states[i] = paths[4 * i + 3];
    }
    vtFree(paths);
    return vtCheckGL(&renderer->gl, "reading states back", error);
}
