#include "passes/overlay.h"

#include "shaders.h"

#if VT_WITH_HOST

void vtOverlayPass_Start(vtOverlayPass* pass, const vtGL* gl, bool surface, vtToneMapping toneMapping,
                         vtProgramList* programs)
{
    vtProgramDef def = {.name = surface ? "overlay of a surface" : "overlay",
                        .vertex = {&vtChunk_screen_vert}};
    const vtChunk* const chunks[] = {surface ? &vtChunk_with_surface : NULL, &vtChunk_srgb,
                                     vtDisplay_ToneChunk(toneMapping), &vtChunk_host_depth,
                                     &vtChunk_overlay_frag};
    vtProgramDef_SetFragment(&def, chunks, sizeof chunks / sizeof chunks[0]);
    pass->program = vtProgramList_Start(programs, gl, &def);
}

void vtOverlayPass_Draw(const vtOverlayPass* pass, const vtGL* gl, const vtOverlayInputs* inputs,
                        GLuint framebuffer, int x, int y)
{
    const bool surface = inputs->depths->format == GL_RGBA32UI;
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->Viewport(x, y, inputs->light->width, inputs->light->height);
    gl->UseProgram(pass->program->name);
    vtTexture_Bind(inputs->light, gl, vt_samplerRadiance);
    vtTexture_Bind(inputs->depths, gl, surface ? vt_samplerSurface : vt_samplerDepths);
    vtHostPicture_Bind(inputs->host, gl);
    gl->Enable(GL_BLEND);
    gl->BlendEquation(GL_FUNC_ADD);
    gl->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(inputs->nearIsGreater ? GL_GEQUAL : GL_LEQUAL);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
    gl->Disable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_LESS);
    gl->Disable(GL_BLEND);
    vtHostPicture_Unbind(inputs->host, gl);
}

#endif
