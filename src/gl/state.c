#include "gl/state.h"

#include <stddef.h>

// Of desktop GL, which OpenGL ES's header does not have.
#define VT_GL_FRAMEBUFFER_SRGB 0x8DB9u
#define VT_GL_COLOR_LOGIC_OP 0x0BF2u
#define VT_GL_PRIMITIVE_RESTART 0x8F9Du
// Of WebGL: what happens to an array of numbers on its way into a texture.
#define VT_GL_UNPACK_FLIP_Y 0x9240u
#define VT_GL_UNPACK_PREMULTIPLY_ALPHA 0x9241u

static void disableAll(const vtGL* gl)
{
    const GLenum switches[] = {GL_BLEND,
                               GL_CULL_FACE,
                               GL_DEPTH_TEST,
                               GL_DITHER,
                               GL_POLYGON_OFFSET_FILL,
                               GL_PRIMITIVE_RESTART_FIXED_INDEX,
                               GL_RASTERIZER_DISCARD,
                               GL_SAMPLE_ALPHA_TO_COVERAGE,
                               GL_SAMPLE_COVERAGE,
                               GL_SCISSOR_TEST,
                               GL_STENCIL_TEST};
    for (size_t i = 0; i < sizeof switches / sizeof switches[0]; ++i) {
#ifdef __EMSCRIPTEN__ // WebGL has it always on, and no switch
        if (switches[i] == GL_PRIMITIVE_RESTART_FIXED_INDEX) {
            continue;
        }
#else
        if (switches[i] == GL_PRIMITIVE_RESTART_FIXED_INDEX && gl->isDesktop) {
            gl->Disable(VT_GL_PRIMITIVE_RESTART); // the other came with GL 4.3
            continue;
        }
#endif
        gl->Disable(switches[i]);
    }
#ifndef __EMSCRIPTEN__
    if (gl->isDesktop) {
        gl->Disable(VT_GL_FRAMEBUFFER_SRGB);
        gl->Disable(VT_GL_COLOR_LOGIC_OP);
    }
#endif
}

static void resetPixels(const vtGL* gl)
{
    const GLenum zeros[] = {GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_PIXELS,
                            GL_UNPACK_SKIP_ROWS,  GL_UNPACK_SKIP_IMAGES,  GL_PACK_ROW_LENGTH,
                            GL_PACK_SKIP_PIXELS,  GL_PACK_SKIP_ROWS};
    for (size_t i = 0; i < sizeof zeros / sizeof zeros[0]; ++i) {
        gl->PixelStorei(zeros[i], 0);
    }
    gl->PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl->PixelStorei(GL_PACK_ALIGNMENT, 4);
#ifdef __EMSCRIPTEN__
    gl->PixelStorei(VT_GL_UNPACK_FLIP_Y, 0);
    gl->PixelStorei(VT_GL_UNPACK_PREMULTIPLY_ALPHA, 0);
#endif
    gl->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

static void releaseSamplers(const vtGL* gl)
{
    for (GLuint unit = 0; unit < vt_samplerCount; ++unit) {
        gl->BindSampler(unit, 0);
    }
}

void vtTakeState(const vtGL* gl)
{
#ifndef __EMSCRIPTEN__ // there a query would wait, and nobody asks
    // An error that the host left is not ours. A lost context may answer with errors for ever.
    for (int i = 0; i < 8 && gl->GetError() != GL_NO_ERROR; ++i) {
    }
#endif
    gl->BindVertexArray(0);
    disableAll(gl);
    gl->DepthFunc(GL_LESS);
    gl->DepthMask(GL_TRUE);
    gl->FrontFace(GL_CCW);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    resetPixels(gl);
    releaseSamplers(gl);
}

void vtLeaveState(const vtGL* gl)
{
    gl->BindVertexArray(0);
    gl->BindBuffer(GL_ARRAY_BUFFER, 0);
    gl->BindBuffer(GL_UNIFORM_BUFFER, 0);
    gl->UseProgram(0);
    gl->ActiveTexture(GL_TEXTURE0);
}
