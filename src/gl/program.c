#include "gl/program.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "gl/uniforms.h"
#include "shaders.h"

// Nothing, not even a comment, may stand before #version. Every default precision is spelled out since
// ES has none for integer and array samplers.
static const vtChunk header = {"header", "#version 300 es\n"
                                         "precision highp float;\n"
                                         "precision highp int;\n"
                                         "precision highp sampler2D;\n"
                                         "precision highp sampler2DArray;\n"
                                         "precision highp usampler2D;\n"
                                         "precision highp usampler2DArray;\n"};

static int countLines(const char* text)
{
    int lines = 0;
    for (; *text != '\0'; ++text) {
        lines += *text == '\n';
    }
    return lines;
}

/// "peel.frag: lines 1-7 header, 8-30 constants, ..." so that a driver's line number can be found.
static void describeChunks(const vtChunk* const* chunks, int count, char* text, size_t size)
{
    int line = 1;
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < count && used < size; ++i) {
        int lines = countLines(chunks[i]->source);
        int n = snprintf(text + used, size - used, "%s%s %d-%d", i > 0 ? ", " : "", chunks[i]->name, line,
                         line + lines - 1);
        used += n > 0 ? (size_t)n : 0;
        line += lines;
    }
}

/// Errors are one sentence: line ends become blanks, those at the end go.
static void makeOneLine(char* text)
{
    size_t length = strlen(text);
    while (length > 0 && (text[length - 1] == '\n' || text[length - 1] == ' ')) {
        text[--length] = '\0';
    }
    for (size_t i = 0; i < length; ++i) {
        text[i] = text[i] == '\n' ? ' ' : text[i];
    }
}

static vtResult compile(const vtGL* gl, GLenum stage, const char* name, const vtChunk* const* chunks,
                        GLuint* shader, vtError* error)
{
    const vtChunk* all[VT_MAX_CHUNKS + 3] = {&header, &vtChunk_constants, &vtChunk_frame};
    int count = 3;
    for (int i = 0; i < VT_MAX_CHUNKS && chunks[i] != NULL; ++i) {
        all[count++] = chunks[i];
    }
    const char* sources[VT_MAX_CHUNKS + 3];
    for (int i = 0; i < count; ++i) {
        sources[i] = all[i]->source;
    }

    *shader = gl->CreateShader(stage);
    gl->ShaderSource(*shader, count, sources, NULL);
    gl->CompileShader(*shader);
    GLint compiled = 0;
    gl->GetShaderiv(*shader, GL_COMPILE_STATUS, &compiled);
    if (compiled) {
        return vt_ok;
    }
    char log[256] = "", where[480];
    gl->GetShaderInfoLog(*shader, sizeof log, NULL, log);
    makeOneLine(log);
    describeChunks(all, count, where, sizeof where);
    gl->DeleteShader(*shader);
    *shader = 0;
    return vtFail(error, vt_errorContext, "GL: the %s shader of '%s' does not compile: %s (lines: %s)",
                  stage == GL_VERTEX_SHADER ? "vertex" : "fragment", name, log, where);
}

vtResult vtCreateProgram(const vtGL* gl, const vtProgramDef* def, GLuint* program, vtError* error)
{
    *program = 0;
    GLuint vertex = 0, fragment = 0;
    vtResult result = compile(gl, GL_VERTEX_SHADER, def->name, def->vertex, &vertex, error);
    if (result != vt_ok) {
        return result;
    }
    result = compile(gl, GL_FRAGMENT_SHADER, def->name, def->fragment, &fragment, error);
    if (result != vt_ok) {
        gl->DeleteShader(vertex);
        return result;
    }

    GLuint linked = gl->CreateProgram();
    gl->AttachShader(linked, vertex);
    gl->AttachShader(linked, fragment);
    gl->LinkProgram(linked);
    gl->DeleteShader(vertex);
    gl->DeleteShader(fragment);
    GLint status = 0;
    gl->GetProgramiv(linked, GL_LINK_STATUS, &status);
    if (!status) {
        char log[256] = "";
        gl->GetProgramInfoLog(linked, sizeof log, NULL, log);
        makeOneLine(log);
        gl->DeleteProgram(linked);
        return vtFail(error, vt_errorContext, "GL: program '%s' does not link: %s", def->name, log);
    }

    GLuint block = gl->GetUniformBlockIndex(linked, "Frame");
    if (block != GL_INVALID_INDEX) {
        gl->UniformBlockBinding(linked, block, VT_FRAME_BINDING);
    }
    gl->UseProgram(linked);
    for (int unit = 0; unit < VT_MAX_SAMPLERS && def->samplers[unit] != NULL; ++unit) {
        gl->Uniform1i(gl->GetUniformLocation(linked, def->samplers[unit]), unit);
    }
    *program = linked;
    return vtSucceed(error);
}
