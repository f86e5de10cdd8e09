// The GL functions the core calls, loaded once per renderer. A table instead of linked prototypes lets
// one program hold several contexts from several libraries (OSMesa and EGL export the same names).
#pragma once

#if defined(__APPLE__)
#error "Vitrine needs the OpenGL ES 3.0 headers of Khronos (GLES3/gl3.h)"
#endif
#include <GLES3/gl3.h>

#include "base/about.h"
#include "vitrine.h"

// X(loader's pointer type, name without gl)
#define VT_GL_FUNCTIONS(X)                                                                                   \
    X(PFNGLACTIVETEXTUREPROC, ActiveTexture)                                                                 \
    X(PFNGLATTACHSHADERPROC, AttachShader)                                                                   \
    X(PFNGLBINDBUFFERPROC, BindBuffer)                                                                       \
    X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                                                               \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                             \
    X(PFNGLBINDSAMPLERPROC, BindSampler)                                                                     \
    X(PFNGLBINDTEXTUREPROC, BindTexture)                                                                     \
    X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                                                             \
    X(PFNGLBUFFERDATAPROC, BufferData)                                                                       \
    X(PFNGLBUFFERSUBDATAPROC, BufferSubData)                                                                 \
    X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, CheckFramebufferStatus)                                               \
    X(PFNGLCLEARBUFFERFVPROC, ClearBufferfv)                                                                 \
    X(PFNGLCLEARBUFFERUIVPROC, ClearBufferuiv)                                                               \
    X(PFNGLCOLORMASKPROC, ColorMask)                                                                         \
    X(PFNGLCOMPILESHADERPROC, CompileShader)                                                                 \
    X(PFNGLCOPYTEXSUBIMAGE2DPROC, CopyTexSubImage2D)                                                         \
    X(PFNGLCOPYTEXSUBIMAGE3DPROC, CopyTexSubImage3D)                                                         \
    X(PFNGLCREATEPROGRAMPROC, CreateProgram)                                                                 \
    X(PFNGLCREATESHADERPROC, CreateShader)                                                                   \
    X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                                 \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                                       \
    X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                                                                 \
    X(PFNGLDELETESHADERPROC, DeleteShader)                                                                   \
    X(PFNGLDELETETEXTURESPROC, DeleteTextures)                                                               \
    X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                                                       \
    X(PFNGLDEPTHFUNCPROC, DepthFunc)                                                                         \
    X(PFNGLDEPTHMASKPROC, DepthMask)                                                                         \
    X(PFNGLDISABLEPROC, Disable)                                                                             \
    X(PFNGLDRAWARRAYSPROC, DrawArrays)                                                                       \
    X(PFNGLDRAWBUFFERSPROC, DrawBuffers)                                                                     \
    X(PFNGLDRAWELEMENTSPROC, DrawElements)                                                                   \
    X(PFNGLENABLEPROC, Enable)                                                                               \
    X(PFNGLENABLEVERTEXATTRIBARRAYPROC, EnableVertexAttribArray)                                             \
    X(PFNGLCULLFACEPROC, CullFace)                                                                           \
    X(PFNGLFRONTFACEPROC, FrontFace)                                                                         \
    X(PFNGLFINISHPROC, Finish)                                                                               \
    X(PFNGLFRAMEBUFFERTEXTURE2DPROC, FramebufferTexture2D)                                                   \
    X(PFNGLFRAMEBUFFERTEXTURELAYERPROC, FramebufferTextureLayer)                                             \
    X(PFNGLGENBUFFERSPROC, GenBuffers)                                                                       \
    X(PFNGLGENERATEMIPMAPPROC, GenerateMipmap)                                                               \
    X(PFNGLGENFRAMEBUFFERSPROC, GenFramebuffers)                                                             \
    X(PFNGLGENTEXTURESPROC, GenTextures)                                                                     \
    X(PFNGLGENVERTEXARRAYSPROC, GenVertexArrays)                                                             \
    X(PFNGLGETERRORPROC, GetError)                                                                           \
    X(PFNGLGETINTEGERVPROC, GetIntegerv)                                                                     \
    X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                                                         \
    X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                                                   \
    X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                                                           \
    X(PFNGLGETSHADERIVPROC, GetShaderiv)                                                                     \
    X(PFNGLGETSTRINGPROC, GetString)                                                                         \
    X(PFNGLGETSTRINGIPROC, GetStringi)                                                                       \
    X(PFNGLGETUNIFORMBLOCKINDEXPROC, GetUniformBlockIndex)                                                   \
    X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                                                       \
    X(PFNGLLINKPROGRAMPROC, LinkProgram)                                                                     \
    X(PFNGLPIXELSTOREIPROC, PixelStorei)                                                                     \
    X(PFNGLREADBUFFERPROC, ReadBuffer)                                                                       \
    X(PFNGLREADPIXELSPROC, ReadPixels)                                                                       \
    X(PFNGLSHADERSOURCEPROC, ShaderSource)                                                                   \
    X(PFNGLTEXIMAGE2DPROC, TexImage2D)                                                                       \
    X(PFNGLTEXPARAMETERIPROC, TexParameteri)                                                                 \
    X(PFNGLTEXSTORAGE2DPROC, TexStorage2D)                                                                   \
    X(PFNGLTEXSTORAGE3DPROC, TexStorage3D)                                                                   \
    X(PFNGLTEXSUBIMAGE2DPROC, TexSubImage2D)                                                                 \
    X(PFNGLTEXSUBIMAGE3DPROC, TexSubImage3D)                                                                 \
    X(PFNGLUNIFORM1IPROC, Uniform1i)                                                                         \
    X(PFNGLUNIFORM4FVPROC, Uniform4fv)                                                                       \
    X(PFNGLUNIFORMBLOCKBINDINGPROC, UniformBlockBinding)                                                     \
    X(PFNGLUSEPROGRAMPROC, UseProgram)                                                                       \
    X(PFNGLVERTEXATTRIBPOINTERPROC, VertexAttribPointer)                                                     \
    X(PFNGLVIEWPORTPROC, Viewport)

// Those that only a host's picture takes.
#if VT_WITH_HOST
#define VT_GL_HOST_FUNCTIONS(X)                                                                              \
    X(PFNGLBLENDEQUATIONPROC, BlendEquation)                                                                 \
    X(PFNGLBLENDFUNCPROC, BlendFunc)                                                                         \
    X(PFNGLDELETESAMPLERSPROC, DeleteSamplers)                                                               \
    X(PFNGLGENSAMPLERSPROC, GenSamplers)                                                                     \
    X(PFNGLSAMPLERPARAMETERIPROC, SamplerParameteri)
#else
#define VT_GL_HOST_FUNCTIONS(X)
#endif

typedef struct vtGL {
#define VT_GL_MEMBER(type, name) type name;
    VT_GL_FUNCTIONS(VT_GL_MEMBER)
    VT_GL_HOST_FUNCTIONS(VT_GL_MEMBER)
#undef VT_GL_MEMBER
    /// Names and texts of shaders in turn, each ended by 0, after the last an empty name; NULL: there are
    /// none, or they are not loaded yet. The caller's.
    const char* laterShaders;
    struct vtProgramStore* programs; ///< of the renderers that share them; program.h
    bool isDesktop;                  ///< desktop GL, not OpenGL ES or WebGL
    bool parallelCompile; ///< KHR_parallel_shader_compile: the driver tells when a program is ready
} vtGL;

/// Fills the table. Fails with vt_errorContext, naming the first function that is missing or saying that
/// the context is too old.
vtResult vtLoadGL(vtGetProcAddressFcn* getProcAddress, vtGL* gl, vtError* error);

/// As vtCheckGL, but vt_ok unasked in a browser, where a query waits for all that the GPU has still to do,
/// shaders to compile included. For what is done in a frame.
vtResult vtCheckFrame(const vtGL* gl, const char* doing, vtError* error);

/// vt_ok where GL reports no error since the last call; `doing` says what was being done.
vtResult vtCheckGL(const vtGL* gl, const char* doing, vtError* error);
