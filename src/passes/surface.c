#include "passes/surface.h"

#include "base/error.h"
#include "shaders.h"

// By whether inner distances are drawn.
static const vtProgramDef programDefs[2] = {
    {.name = "surface",
     .vertex = {&vtChunk_picture, &vtChunk_mesh_vert},
     .fragment = {&vtChunk_octahedral, &vtChunk_surface_attributes, &vtChunk_surface_frag},
     .uniforms = VT_OBJECT_UNIFORMS},
    {.name = "surface with inner distance",
     .vertex = {&vtChunk_inner_distance, &vtChunk_picture, &vtChunk_mesh_vert},
     .fragment = {&vtChunk_inner_distance, &vtChunk_octahedral, &vtChunk_surface_attributes,
                  &vtChunk_surface_frag},
     .uniforms = VT_OBJECT_UNIFORMS},
};

void vtSurfacePass_Start(vtSurfacePass* pass, const vtGL* gl, bool distances, vtProgramList* programs)
{
    pass->program = vtProgramList_Start(programs, gl, &programDefs[distances]);
}

vtResult vtSurfacePass_Resize(vtSurfacePass* pass, const vtGL* gl, int width, int height, bool distances,
                              vtError* error)
{
    bool changed = vtTexture_Resize(&pass->depth, gl, GL_DEPTH_COMPONENT32F, width, height, 0);
    changed |= vtTexture_Resize(&pass->attributes, gl, GL_RGBA32UI, width, height, 0);
    vtResult result = vtSucceed(error);
    vtAttachment colors[] = {{&pass->attributes, 0}, {&pass->distances, 0}};
    if (changed) {
        vtDestroyFramebuffers(gl, &pass->framebuffers[1], 1); // it holds the depth that is gone
        result = vtMakeFramebuffer(gl, "surface", colors, 1, &pass->depth, &pass->framebuffers[0], error);
    }
    if (result != vt_ok || !distances) {
        return result;
    }
    changed = vtTexture_Resize(&pass->distances, gl, GL_R16UI, width, height, 0);
    if (changed || pass->framebuffers[1] == 0) {
        result = vtMakeFramebuffer(gl, "surface with inner distance", colors, 2, &pass->depth,
                                   &pass->framebuffers[1], error);
    }
    return result;
}

void vtSurfacePass_Draw(const vtSurfacePass* pass, const vtGL* gl, const vtSceneBuffer* scene, uint32_t first,
                        uint32_t last, bool distances)
{
    const float far = 1.0f;
    const GLuint none[4] = {0};
    vtBindFramebuffer(gl, pass->framebuffers[distances], pass->depth.width, pass->depth.height);
    gl->Enable(GL_DEPTH_TEST);
    gl->ClearBufferfv(GL_DEPTH, 0, &far);
    gl->ClearBufferuiv(GL_COLOR, 0, none);
    if (distances) {
        gl->ClearBufferuiv(GL_COLOR, 1, none);
    }
    gl->UseProgram(pass->program->name);
    vtSceneBuffer_Draw(scene, gl, pass->program, first, last);
    vtSceneBuffer_Draw(scene, gl, pass->program, scene->glassCount, scene->objectCount);
    gl->Disable(GL_DEPTH_TEST);
}

void vtSurfacePass_Destroy(vtSurfacePass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, pass->framebuffers, 2);
    vtTexture_Destroy(&pass->distances, gl);
    vtTexture_Destroy(&pass->depth, gl);
    vtTexture_Destroy(&pass->attributes, gl);
    *pass = (vtSurfacePass){0};
}

size_t vtSurfacePass_Bytes(const vtSurfacePass* pass)
{
    return vtTexture_Bytes(&pass->depth) + vtTexture_Bytes(&pass->attributes) +
           vtTexture_Bytes(&pass->distances);
}
