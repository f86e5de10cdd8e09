#include "passes/surface.h"

#include "base/error.h"
#include "shaders.h"

static const vtProgramDef programDef = {
    .name = "surface",
    .vertex = {&vtChunk_picture, &vtChunk_mesh_vert},
    .fragment = {&vtChunk_octahedral, &vtChunk_surface_attributes, &vtChunk_surface_frag},
};

static const vtProgramDef distanceProgramDef = {
    .name = "surface with inner distance",
    .vertex = {&vtChunk_inner_distance, &vtChunk_picture, &vtChunk_mesh_vert},
    .fragment = {&vtChunk_inner_distance, &vtChunk_octahedral, &vtChunk_surface_attributes,
                 &vtChunk_surface_frag},
};

vtResult vtSurfacePass_Create(vtSurfacePass* pass, const vtGL* gl, vtError* error)
{
    *pass = (vtSurfacePass){0};
    return vtCreateProgram(gl, &programDef, &pass->program, error);
}

vtResult vtSurfacePass_Resize(vtSurfacePass* pass, const vtGL* gl, int width, int height, bool distances,
                              vtError* error)
{
    bool changed = vtTexture_Resize(&pass->depth, gl, GL_DEPTH_COMPONENT32F, width, height, 0);
    changed |= vtTexture_Resize(&pass->attributes, gl, GL_RGBA32UI, width, height, 0);
    vtResult result = vtSucceed(error);
    vtAttachment colors[] = {{&pass->attributes, 0}, {&pass->distances, 0}};
    if (changed) {
        vtDestroyFramebuffers(gl, &pass->distanceFramebuffer, 1); // it holds the depth that is gone
        result = vtMakeFramebuffer(gl, "surface", colors, 1, &pass->depth, &pass->framebuffer, error);
    }
    if (result != vt_ok || !distances) {
        return result;
    }
    if (pass->distanceProgram == 0) {
        result = vtCreateProgram(gl, &distanceProgramDef, &pass->distanceProgram, error);
    }
    changed = vtTexture_Resize(&pass->distances, gl, GL_R16UI, width, height, 0);
    if (result == vt_ok && (changed || pass->distanceFramebuffer == 0)) {
        result = vtMakeFramebuffer(gl, "surface with inner distance", colors, 2, &pass->depth,
                                   &pass->distanceFramebuffer, error);
    }
    return result;
}

void vtSurfacePass_Draw(const vtSurfacePass* pass, const vtGL* gl, const vtMeshBuffer* mesh, bool distances)
{
    const float far = 1.0f;
    const GLuint none[4] = {0};
    vtBindFramebuffer(gl, distances ? pass->distanceFramebuffer : pass->framebuffer, pass->depth.width,
                      pass->depth.height);
    gl->Enable(GL_DEPTH_TEST);
    gl->ClearBufferfv(GL_DEPTH, 0, &far);
    gl->ClearBufferuiv(GL_COLOR, 0, none);
    if (distances) {
        gl->ClearBufferuiv(GL_COLOR, 1, none);
    }
    gl->UseProgram(distances ? pass->distanceProgram : pass->program);
    vtMeshBuffer_Draw(mesh, gl);
    gl->Disable(GL_DEPTH_TEST);
}

void vtSurfacePass_Destroy(vtSurfacePass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, &pass->framebuffer, 1);
    vtDestroyFramebuffers(gl, &pass->distanceFramebuffer, 1);
    vtTexture_Destroy(&pass->distances, gl);
    vtTexture_Destroy(&pass->depth, gl);
    vtTexture_Destroy(&pass->attributes, gl);
    gl->DeleteProgram(pass->program);
    gl->DeleteProgram(pass->distanceProgram);
    *pass = (vtSurfacePass){0};
}

size_t vtSurfacePass_Bytes(const vtSurfacePass* pass)
{
    return vtTexture_Bytes(&pass->depth) + vtTexture_Bytes(&pass->attributes) +
           vtTexture_Bytes(&pass->distances);
}
