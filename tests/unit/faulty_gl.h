// A driver that fails where a test says: its calls go to the real one, or fail as GL's specification has it.
// It counts the objects that are alive. One at a time: GL's functions have no place for whose they are.
#pragma once

#include <GLES3/gl3.h>

#include "testing.h"

#define FAULTY_CONTEXT_LOST 0x0507 // GL_CONTEXT_LOST of KHR_robustness

// Those that a fault can be asked of, and what each answers where it fails.
#define FAULTY_CALLS(X)                                                                                      \
    X(BindBuffer)                                                                                            \
    X(BindFramebuffer)                                                                                       \
    X(BindTexture)                                                                                           \
    X(BufferData)                                                                                            \
    X(BufferSubData)                                                                                         \
    X(CheckFramebufferStatus)                                                                                \
    X(CompileShader)                                                                                         \
    X(CopyTexSubImage2D)                                                                                     \
    X(DrawArrays)                                                                                            \
    X(DrawBuffers)                                                                                           \
    X(DrawElements)                                                                                          \
    X(FramebufferTexture2D)                                                                                  \
    X(FramebufferTextureLayer)                                                                               \
    X(GenerateMipmap)                                                                                        \
    X(GetProgramiv)                                                                                          \
    X(GetShaderiv)                                                                                           \
    X(LinkProgram)                                                                                           \
    X(ReadPixels)                                                                                            \
    X(TexStorage2D)                                                                                          \
    X(TexStorage3D)                                                                                          \
    X(TexSubImage2D)                                                                                         \
    X(TexSubImage3D)

typedef enum FaultyCall {
    faultyNone = 0,
#define FAULTY_ENUM(name) faulty##name,
    FAULTY_CALLS(FAULTY_ENUM)
#undef FAULTY_ENUM
        faultyEvery, ///< the context is lost at the call that fails
} FaultyCall;

typedef struct FaultyGL {
    vtGetProcAddressFcn* getReal;
    FaultyCall failing;
    int at;    ///< number of the call that fails, from 1
    int calls; ///< of it since the last setFault
    bool lost;
    GLenum error;             ///< that GetError gives next
    bool isTiny;              ///< no more than what OpenGL ES 3.0 and WebGL 2 promise at least
    bool refused;             ///< a call asked for more than that
    bool failsFirst;          ///< every program's first `failing`
    GLuint64 known[256];      ///< sources of programs that have failed, hashed
    int knownCount;           //
    GLuint64 sources[4096];   ///< of shaders, then of programs, by name
    GLenum formats[1 << 16];  ///< of textures, by name
    GLuint bound, boundArray; ///< textures
    GLuint attached[4];       ///< of the framebuffer bound last
    int textures, buffers, framebuffers, arrays, shaders, programs; ///< alive
} FaultyGL;

static FaultyGL faulty;

static inline int objectsAlive(void)
{
    return faulty.textures + faulty.buffers + faulty.framebuffers + faulty.arrays + faulty.shaders +
           faulty.programs;
}

/// The n-th call of it fails from now on, counted from 1; n = 0: none.
static inline void setFault(FaultyCall call, int n)
{
    faulty.failing = n > 0 ? call : faultyNone;
    faulty.at = n;
    faulty.calls = 0;
    faulty.lost = false;
    faulty.error = GL_NO_ERROR;
}

/// Has the call that should fail been made?
static inline bool hasFailed(void)
{
    return faulty.calls >= faulty.at;
}

static inline bool fails(FaultyCall call, GLenum error)
{
    bool now = faulty.lost;
    if (!now && (faulty.failing == call || faulty.failing == faultyEvery)) {
        now = ++faulty.calls == faulty.at;
        faulty.lost = now && faulty.failing == faultyEvery;
    }
    if (now && faulty.error == GL_NO_ERROR) {
        faulty.error = faulty.lost ? FAULTY_CONTEXT_LOST : error;
    }
    return now;
}

/// More than is promised: GL refuses it.
static inline bool refuses(bool isTooMuch)
{
    if (!faulty.isTiny || !isTooMuch) {
        return false;
    }
    faulty.refused = true;
    faulty.error = faulty.error == GL_NO_ERROR ? GL_INVALID_VALUE : faulty.error;
    return true;
}

#define REAL(type, name) ((type)faulty.getReal("gl" #name))

// ------------------------------------------------------------------------------------------------- calls

static inline GLenum faulty_GetError(void)
{
    const GLenum error = faulty.lost ? FAULTY_CONTEXT_LOST : faulty.error;
    faulty.error = GL_NO_ERROR;
    return error != GL_NO_ERROR ? error : REAL(PFNGLGETERRORPROC, GetError)();
}

static inline void faulty_BindBuffer(GLenum target, GLuint name)
{
    if (!fails(faultyBindBuffer, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLBINDBUFFERPROC, BindBuffer)(target, name);
    }
}

static inline void faulty_BindFramebuffer(GLenum target, GLuint name)
{
    memset(faulty.attached, 0, sizeof faulty.attached);
    if (!fails(faultyBindFramebuffer, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)(target, name);
    }
}

static inline void faulty_ActiveTexture(GLenum unit)
{
    if (!refuses(unit >= GL_TEXTURE0 + 32)) {
        REAL(PFNGLACTIVETEXTUREPROC, ActiveTexture)(unit);
    }
}

static inline void faulty_BindTexture(GLenum target, GLuint name)
{
    *(target == GL_TEXTURE_2D ? &faulty.bound : &faulty.boundArray) = name;
    if (!fails(faultyBindTexture, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLBINDTEXTUREPROC, BindTexture)(target, name);
    }
}

static inline void faulty_BufferData(GLenum target, GLsizeiptr size, const void* data, GLenum usage)
{
    if (!fails(faultyBufferData, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLBUFFERDATAPROC, BufferData)(target, size, data, usage);
    }
}

static inline void faulty_BufferSubData(GLenum target, GLintptr offset, GLsizeiptr size, const void* data)
{
    if (!fails(faultyBufferSubData, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLBUFFERSUBDATAPROC, BufferSubData)(target, offset, size, data);
    }
}

static inline bool isFloat(GLenum format)
{
    const GLenum floats[] = {GL_R16F,  GL_RG16F,  GL_RGB16F,  GL_RGBA16F,       GL_R32F,
                             GL_RG32F, GL_RGB32F, GL_RGBA32F, GL_R11F_G11F_B10F};
    bool found = false;
    for (size_t i = 0; i < sizeof floats / sizeof floats[0]; ++i) {
        found = found || format == floats[i];
    }
    return found;
}

static inline GLenum faulty_CheckFramebufferStatus(GLenum target)
{
    if (fails(faultyCheckFramebufferStatus, GL_NO_ERROR)) {
        return GL_FRAMEBUFFER_UNSUPPORTED;
    }
    for (int i = 0; i < 4 && faulty.isTiny; ++i) { // EXT_color_buffer_float is not there
        if (isFloat(faulty.formats[faulty.attached[i] & 0xffff])) {
            faulty.refused = true;
            return GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT;
        }
    }
    return REAL(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)(target);
}

static inline void faulty_CopyTexSubImage2D(GLenum target, GLint level, GLint toX, GLint toY, GLint x,
                                            GLint y, GLsizei width, GLsizei height)
{
    if (!fails(faultyCopyTexSubImage2D, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLCOPYTEXSUBIMAGE2DPROC, CopyTexSubImage2D)(target, level, toX, toY, x, y, width, height);
    }
}

static inline void faulty_DrawArrays(GLenum mode, GLint first, GLsizei count)
{
    if (!fails(faultyDrawArrays, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLDRAWARRAYSPROC, DrawArrays)(mode, first, count);
    }
}

static inline void faulty_DrawBuffers(GLsizei count, const GLenum* buffers)
{
    if (!fails(faultyDrawBuffers, GL_OUT_OF_MEMORY) && !refuses(count > 4)) {
        REAL(PFNGLDRAWBUFFERSPROC, DrawBuffers)(count, buffers);
    }
}

static inline void faulty_DrawElements(GLenum mode, GLsizei count, GLenum type, const void* indices)
{
    if (!fails(faultyDrawElements, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLDRAWELEMENTSPROC, DrawElements)(mode, count, type, indices);
    }
}

static inline void attachTexture(GLenum point, GLuint texture)
{
    if (point >= GL_COLOR_ATTACHMENT0 && point < GL_COLOR_ATTACHMENT0 + 4) {
        faulty.attached[point - GL_COLOR_ATTACHMENT0] = texture;
    }
}

static inline void faulty_FramebufferTexture2D(GLenum target, GLenum point, GLenum kind, GLuint texture,
                                               GLint level)
{
    attachTexture(point, texture);
    if (!fails(faultyFramebufferTexture2D, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)(target, point, kind, texture, level);
    }
}

static inline void faulty_FramebufferTextureLayer(GLenum target, GLenum point, GLuint texture, GLint level,
                                                  GLint layer)
{
    attachTexture(point, texture);
    if (!fails(faultyFramebufferTextureLayer, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLFRAMEBUFFERTEXTURELAYERPROC, FramebufferTextureLayer)(target, point, texture, level, layer);
    }
}

static inline void faulty_GenerateMipmap(GLenum target)
{
    if (!fails(faultyGenerateMipmap, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLGENERATEMIPMAPPROC, GenerateMipmap)(target);
    }
}

static inline void faulty_ReadPixels(GLint x, GLint y, GLsizei width, GLsizei height, GLenum layout,
                                     GLenum type, void* pixels)
{
    if (!fails(faultyReadPixels, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLREADPIXELSPROC, ReadPixels)(x, y, width, height, layout, type, pixels);
    }
}

static inline void faulty_TexStorage2D(GLenum target, GLsizei levels, GLenum format, GLsizei width,
                                       GLsizei height)
{
    faulty.formats[faulty.bound & 0xffff] = format;
    if (!fails(faultyTexStorage2D, GL_OUT_OF_MEMORY) && !refuses(width > 2048 || height > 2048)) {
        REAL(PFNGLTEXSTORAGE2DPROC, TexStorage2D)(target, levels, format, width, height);
    }
}

static inline void faulty_TexStorage3D(GLenum target, GLsizei levels, GLenum format, GLsizei width,
                                       GLsizei height, GLsizei depth)
{
    faulty.formats[faulty.boundArray & 0xffff] = format;
    if (!fails(faultyTexStorage3D, GL_OUT_OF_MEMORY) &&
        !refuses(width > 2048 || height > 2048 || depth > 256)) {
        REAL(PFNGLTEXSTORAGE3DPROC, TexStorage3D)(target, levels, format, width, height, depth);
    }
}

static inline void faulty_TexSubImage2D(GLenum target, GLint level, GLint x, GLint y, GLsizei width,
                                        GLsizei height, GLenum layout, GLenum type, const void* pixels)
{
    if (!fails(faultyTexSubImage2D, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLTEXSUBIMAGE2DPROC, TexSubImage2D)
        (target, level, x, y, width, height, layout, type, pixels);
    }
}

static inline void faulty_TexSubImage3D(GLenum target, GLint level, GLint x, GLint y, GLint z, GLsizei width,
                                        GLsizei height, GLsizei depth, GLenum layout, GLenum type,
                                        const void* pixels)
{
    if (!fails(faultyTexSubImage3D, GL_OUT_OF_MEMORY)) {
        REAL(PFNGLTEXSUBIMAGE3DPROC, TexSubImage3D)
        (target, level, x, y, z, width, height, depth, layout, type, pixels);
    }
}

static inline void faulty_GetIntegerv(GLenum name, GLint* value)
{
    static const GLint least[][2] = {
        {GL_MAX_TEXTURE_SIZE, 2048},        {GL_MAX_ARRAY_TEXTURE_LAYERS, 256},
        {GL_MAX_DRAW_BUFFERS, 4},           {GL_MAX_COLOR_ATTACHMENTS, 4},
        {GL_MAX_TEXTURE_IMAGE_UNITS, 16},   {GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 32},
        {GL_MAX_UNIFORM_BLOCK_SIZE, 16384}, {GL_NUM_EXTENSIONS, 0}};
    REAL(PFNGLGETINTEGERVPROC, GetIntegerv)(name, value);
    for (size_t i = 0; i < sizeof least / sizeof least[0] && faulty.isTiny; ++i) {
        *value = name == (GLenum)least[i][0] ? least[i][1] : *value;
    }
}

// ---------------------------------------------------------------------------------------------- programs

static inline GLuint64 hashText(GLuint64 hash, const char* text)
{
    for (; *text != '\0'; ++text) {
        hash = (hash ^ (unsigned char)*text) * 1099511628211u;
    }
    return hash;
}

/// Is it the first time that one of this source shall fail?
static inline bool failsForTheFirstTime(FaultyCall call, GLuint64 source)
{
    if (!faulty.failsFirst || faulty.failing != call) {
        return false;
    }
    for (int i = 0; i < faulty.knownCount; ++i) {
        if (faulty.known[i] == source) {
            return false;
        }
    }
    assert_true(faulty.knownCount < 256);
    faulty.known[faulty.knownCount++] = source;
    return true;
}

static inline void faulty_ShaderSource(GLuint shader, GLsizei count, const GLchar* const* texts,
                                       const GLint* lengths)
{
    GLuint64 hash = 14695981039346656037u;
    assert_null(lengths);
    for (GLsizei i = 0; i < count; ++i) {
        hash = hashText(hash, texts[i]);
    }
    faulty.sources[shader & 4095] = hash;
    REAL(PFNGLSHADERSOURCEPROC, ShaderSource)(shader, count, texts, lengths);
}

static inline void faulty_AttachShader(GLuint program, GLuint shader)
{
    faulty.sources[program & 4095] += faulty.sources[shader & 4095];
    REAL(PFNGLATTACHSHADERPROC, AttachShader)(program, shader);
}

static inline void faulty_CompileShader(GLuint shader)
{
    static const char* const broken = "#version 300 es\n#error the driver's own words\n";
    if (failsForTheFirstTime(faultyCompileShader, faulty.sources[shader & 4095]) ||
        (!faulty.failsFirst && fails(faultyCompileShader, GL_NO_ERROR))) {
        REAL(PFNGLSHADERSOURCEPROC, ShaderSource)(shader, 1, &broken, NULL);
    }
    REAL(PFNGLCOMPILESHADERPROC, CompileShader)(shader);
}

/// Samplers that a program reads; a vertex shader's are counted with them.
static inline int countSamplers(GLuint program)
{
    PFNGLGETACTIVEUNIFORMPROC getUniform = REAL(PFNGLGETACTIVEUNIFORMPROC, GetActiveUniform);
    GLint count = 0;
    int samplers = 0;
    REAL(PFNGLGETPROGRAMIVPROC, GetProgramiv)(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; ++i) {
        GLint size;
        GLenum type;
        GLchar name[64];
        getUniform(program, (GLuint)i, sizeof name, NULL, &size, &type, name);
        samplers += type == GL_SAMPLER_2D || type == GL_SAMPLER_2D_ARRAY ||
                    type == GL_UNSIGNED_INT_SAMPLER_2D || type == GL_UNSIGNED_INT_SAMPLER_2D_ARRAY;
    }
    return samplers;
}

static inline void faulty_LinkProgram(GLuint program)
{
    if (failsForTheFirstTime(faultyLinkProgram, faulty.sources[program & 4095]) ||
        (!faulty.failsFirst && fails(faultyLinkProgram, GL_NO_ERROR))) {
        return; // it was never linked
    }
    REAL(PFNGLLINKPROGRAMPROC, LinkProgram)(program);
    refuses(faulty.isTiny && countSamplers(program) > 16);
}

static inline void faulty_GetProgramiv(GLuint program, GLenum name, GLint* value)
{
    *value = 0;
    if (!fails(faultyGetProgramiv, GL_NO_ERROR)) {
        REAL(PFNGLGETPROGRAMIVPROC, GetProgramiv)(program, name, value);
    }
}

static inline void faulty_GetShaderiv(GLuint shader, GLenum name, GLint* value)
{
    *value = 0;
    if (!fails(faultyGetShaderiv, GL_NO_ERROR)) {
        REAL(PFNGLGETSHADERIVPROC, GetShaderiv)(shader, name, value);
    }
}

// ----------------------------------------------------------------------------------------------- objects

#define FAULTY_OBJECTS(type, names, counter)                                                                 \
    static inline void faulty_Gen##names(GLsizei count, GLuint* made)                                        \
    {                                                                                                        \
        faulty.counter += count;                                                                             \
        REAL(PFNGLGEN##type##PROC, Gen##names)(count, made);                                                 \
    }                                                                                                        \
    static inline void faulty_Delete##names(GLsizei count, const GLuint* gone)                               \
    {                                                                                                        \
        for (GLsizei i = 0; i < count; ++i) {                                                                \
            faulty.counter -= gone[i] != 0;                                                                  \
        }                                                                                                    \
        REAL(PFNGLDELETE##type##PROC, Delete##names)(count, gone);                                           \
    }

FAULTY_OBJECTS(TEXTURES, Textures, textures)
FAULTY_OBJECTS(BUFFERS, Buffers, buffers)
FAULTY_OBJECTS(FRAMEBUFFERS, Framebuffers, framebuffers)
FAULTY_OBJECTS(VERTEXARRAYS, VertexArrays, arrays)

static inline GLuint faulty_CreateShader(GLenum stage)
{
    ++faulty.shaders;
    return REAL(PFNGLCREATESHADERPROC, CreateShader)(stage);
}

static inline void faulty_DeleteShader(GLuint shader)
{
    faulty.shaders -= shader != 0;
    REAL(PFNGLDELETESHADERPROC, DeleteShader)(shader);
}

static inline GLuint faulty_CreateProgram(void)
{
    ++faulty.programs;
    const GLuint program = REAL(PFNGLCREATEPROGRAMPROC, CreateProgram)();
    faulty.sources[program & 4095] = 0;
    return program;
}

static inline void faulty_DeleteProgram(GLuint program)
{
    faulty.programs -= program != 0;
    REAL(PFNGLDELETEPROGRAMPROC, DeleteProgram)(program);
}

/// For vtRendererDef: `faulty` stands between it and `faulty.getReal`.
static inline vtProc getFaulty(const char* name)
{
#define FAULTY_ROW(call) {"gl" #call, (vtProc)faulty_##call},
    static const struct {
        const char* name;
        vtProc call;
    } rows[] = {FAULTY_CALLS(FAULTY_ROW) FAULTY_ROW(GetError) FAULTY_ROW(GetIntegerv) FAULTY_ROW(
        ActiveTexture) FAULTY_ROW(ShaderSource) FAULTY_ROW(AttachShader) FAULTY_ROW(GenTextures)
                    FAULTY_ROW(DeleteTextures) FAULTY_ROW(GenBuffers) FAULTY_ROW(DeleteBuffers)
                        FAULTY_ROW(GenFramebuffers) FAULTY_ROW(DeleteFramebuffers) FAULTY_ROW(GenVertexArrays)
                            FAULTY_ROW(DeleteVertexArrays) FAULTY_ROW(CreateShader) FAULTY_ROW(DeleteShader)
                                FAULTY_ROW(CreateProgram) FAULTY_ROW(DeleteProgram)};
#undef FAULTY_ROW
    vtProc found = NULL;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        found = strcmp(rows[i].name, name) == 0 ? rows[i].call : found;
    }
    return found != NULL ? found : faulty.getReal(name);
}
