#include "gl/target.h"

#include <assert.h>

#include "base/error.h"

bool vtTexture_Resize(vtTexture* texture, const vtGL* gl, GLenum format, int width, int height, int layers)
{
    GLenum target = layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
    if (texture->name != 0 && texture->target == target && texture->format == format &&
        texture->width == width && texture->height == height && texture->layers == layers) {
        return false;
    }
    vtTexture_Destroy(texture, gl);
    *texture = (vtTexture){0, target, format, width, height, layers, false};
    gl->GenTextures(1, &texture->name);
    gl->ActiveTexture(GL_TEXTURE0 + vt_samplerNone);
    gl->BindTexture(target, texture->name);
    if (layers > 0) {
        gl->TexStorage3D(target, 1, format, width, height, layers);
    } else {
        gl->TexStorage2D(target, 1, format, width, height);
    }
    gl->TexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->TexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->TexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->TexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return true;
}

void vtTexture_SizeRecords(vtTexture* texture, const vtGL* gl, uint32_t count)
{
    const uint32_t rows = (count + VT_RECORDS_A_ROW - 1) / VT_RECORDS_A_ROW;
    vtTexture_Resize(texture, gl, GL_RGBA32UI, 4 * VT_RECORDS_A_ROW, rows > 0 ? (int)rows : 1, 0);
}

void vtTexture_SetRecords(const vtTexture* texture, const vtGL* gl, uint32_t first, uint32_t count,
                          const uint32_t* words)
{
    vtTexture_Bind(texture, gl, vt_samplerNone);
    while (count > 0) { // the rest of a row, whole rows, the beginning of one
        const uint32_t column = first % VT_RECORDS_A_ROW, room = VT_RECORDS_A_ROW - column;
        const bool whole = column == 0 && count >= VT_RECORDS_A_ROW;
        const uint32_t rows = whole ? count / VT_RECORDS_A_ROW : 1;
        const uint32_t across = whole ? VT_RECORDS_A_ROW : count < room ? count : room;
        gl->TexSubImage2D(GL_TEXTURE_2D, 0, (GLint)(4 * column), (GLint)(first / VT_RECORDS_A_ROW),
                          (GLsizei)(4 * across), (GLsizei)rows, GL_RGBA_INTEGER, GL_UNSIGNED_INT, words);
        first += rows * across;
        count -= rows * across;
        words += VT_RECORD_WORDS * (size_t)rows * across;
    }
}

void vtTexture_Destroy(vtTexture* texture, const vtGL* gl)
{
    if (texture->name != 0) {
        gl->DeleteTextures(1, &texture->name);
    }
    *texture = (vtTexture){0};
}

static size_t bytesPerTexel(GLenum format)
{
    switch (format) {
    case GL_R16UI:
        return 2;
    case GL_RGBA8:
    case GL_SRGB8_ALPHA8:
    case GL_DEPTH_COMPONENT32F:
    case GL_R32F:
    case GL_R32UI:
        return 4;
    case GL_RGB16F:
        return 6;
    case GL_RG32UI:
    case GL_RGBA16UI:
    case GL_RGBA16F:
    case GL_RG32F:
        return 8;
    case GL_RGBA32UI:
        return 16;
    default:
        assert(!"a format without a size");
        return 0;
    }
}

size_t vtTexture_Bytes(const vtTexture* texture)
{
    if (texture->name == 0) {
        return 0;
    }
    size_t layers = texture->layers > 0 ? (size_t)texture->layers : 1;
    size_t bytes = bytesPerTexel(texture->format) * (size_t)texture->width * (size_t)texture->height * layers;
    return texture->mipmapped ? bytes + bytes / 3 : bytes;
}

void vtTexture_Bind(const vtTexture* texture, const vtGL* gl, vtSampler sampler)
{
    gl->ActiveTexture(GL_TEXTURE0 + (GLenum)sampler);
    gl->BindTexture(texture->target, texture->name);
}

void vtBindTextures(const vtGL* gl, const vtBinding* bindings, size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        const vtTexture* texture = bindings[i].texture;
        if (texture != NULL && texture->name != 0) {
            vtTexture_Bind(texture, gl, bindings[i].sampler);
        }
    }
}

static void attach(const vtGL* gl, GLenum point, vtAttachment attachment)
{
    const vtTexture* texture = attachment.texture;
    if (texture->layers > 0) {
        gl->FramebufferTextureLayer(GL_FRAMEBUFFER, point, texture->name, 0, attachment.layer);
    } else {
        gl->FramebufferTexture2D(GL_FRAMEBUFFER, point, GL_TEXTURE_2D, texture->name, 0);
    }
}

vtResult vtMakeFramebuffer(const vtGL* gl, const char* name, const vtAttachment* colors, int colorCount,
                           const vtTexture* depth, GLuint* framebuffer, vtError* error)
{
    assert(colorCount <= VT_MAX_ATTACHMENTS);
    vtDestroyFramebuffers(gl, framebuffer, 1);
    gl->GenFramebuffers(1, framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, *framebuffer);
    GLenum buffers[VT_MAX_ATTACHMENTS] = {GL_NONE};
    for (int i = 0; i < colorCount; ++i) {
        buffers[i] = GL_COLOR_ATTACHMENT0 + (GLenum)i;
        attach(gl, buffers[i], colors[i]);
    }
    if (depth != NULL) {
        attach(gl, GL_DEPTH_ATTACHMENT, (vtAttachment){depth, 0});
    }
    gl->DrawBuffers(colorCount > 0 ? colorCount : 1, buffers); // GL_NONE for a depth-only one
#ifdef __EMSCRIPTEN__                                          // it would wait, as vtCheckFrame says
    const GLenum status = GL_FRAMEBUFFER_COMPLETE;
    (void)name;
#else
    const GLenum status = gl->CheckFramebufferStatus(GL_FRAMEBUFFER);
#endif
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        return vtFail(error, vt_errorContext,
                      "GL: the framebuffer '%s' is not complete (status 0x%04x); a smaller picture or fewer "
                      "layers may fit",
                      name, (unsigned)status);
    }
    return vtSucceed(error);
}

void vtDestroyFramebuffers(const vtGL* gl, GLuint* framebuffers, int count)
{
    for (int i = 0; i < count; ++i) {
        if (framebuffers[i] != 0) {
            gl->DeleteFramebuffers(1, &framebuffers[i]);
            framebuffers[i] = 0;
        }
    }
}

void vtBindFramebuffer(const vtGL* gl, GLuint framebuffer, int width, int height)
{
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->Viewport(0, 0, width, height);
}
