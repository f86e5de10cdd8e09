#include "passes/surface.h"

#include "base/error.h"
#include "shaders.h"

static const vtProgramDef programDef = {
    .name = "surface",
    .vertex = {&vtChunk_picture, &vtChunk_mesh_vert},
    .fragment = {&vtChunk_octahedral, &vtChunk_surface_attributes, &vtChunk_surface_frag},
};

vtResult vtSurfacePass_Create(vtSurfacePass* pass, const vtGL* gl, vtError* error)
{
    *pass = (vtSurfacePass){0};
    return vtCreateProgram(gl, &programDef, &pass->program, error);
}

vtResult vtSurfacePass_Resize(vtSurfacePass* pass, const vtGL* gl, int width, int height, vtError* error)
{
    bool changed = vtTexture_Resize(&pass->depth, gl, GL_DEPTH_COMPONENT32F, width, height, 0);
    changed |= vtTexture_Resize(&pass->normals, gl, GL_RG32UI, width, height, 0);
    if (!changed) {
        return vtSucceed(error);
    }
    vtAttachment color = {&pass->normals, 0};
    return vtMakeFramebuffer(gl, "surface", &color, 1, &pass->depth, &pass->framebuffer, error);
}

void vtSurfacePass_Draw(const vtSurfacePass* pass, const vtGL* gl, const vtMeshBuffer* mesh)
{
    const float far = 1.0f;
    const GLuint none[4] = {0};
    vtBindFramebuffer(gl, pass->framebuffer, pass->depth.width, pass->depth.height);
    gl->Enable(GL_DEPTH_TEST);
    gl->ClearBufferfv(GL_DEPTH, 0, &far);
    gl->ClearBufferuiv(GL_COLOR, 0, none);
    gl->UseProgram(pass->program);
    vtMeshBuffer_Draw(mesh, gl);
    gl->Disable(GL_DEPTH_TEST);
}

void vtSurfacePass_Destroy(vtSurfacePass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, &pass->framebuffer, 1);
    vtTexture_Destroy(&pass->depth, gl);
    vtTexture_Destroy(&pass->normals, gl);
    gl->DeleteProgram(pass->program);
    *pass = (vtSurfacePass){0};
}

size_t vtSurfacePass_Bytes(const vtSurfacePass* pass)
{
    return vtTexture_Bytes(&pass->depth) + vtTexture_Bytes(&pass->normals);
}
