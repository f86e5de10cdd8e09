#include "passes/present.h"

#include "shaders.h"

static const vtProgramDef programDef = {
    .name = "present",
    .vertex = {&vtChunk_screen_vert},
    .fragment = {&vtChunk_octahedral, &vtChunk_srgb, &vtChunk_present_frag},
};

void vtPresentPass_Start(vtPresentPass* pass, const vtGL* gl, vtProgramList* programs)
{
    vtProgramList_Start(programs, &pass->program, gl, &programDef);
}

void vtPresentPass_Draw(const vtPresentPass* pass, const vtGL* gl, const vtPresentInputs* inputs,
                        GLuint framebuffer, int x, int y, int width, int height)
{
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->Viewport(x, y, width, height);
    gl->UseProgram(pass->program.name);
    const vtBinding bindings[] = {{vt_samplerPaths, inputs->paths},
                                  {vt_samplerRadiance, inputs->radiance},
                                  {vt_samplerLayerDepths, inputs->layerDepths},
                                  {vt_samplerLayerNormals, inputs->layerNormals}};
    vtBindTextures(gl, bindings, sizeof bindings / sizeof bindings[0]);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

void vtPresentPass_Destroy(vtPresentPass* pass, const vtGL* gl)
{
    vtProgram_Destroy(&pass->program, gl);
    *pass = (vtPresentPass){0};
}
