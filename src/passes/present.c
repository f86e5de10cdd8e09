#include "passes/present.h"

#include "shaders.h"

static const vtProgramDef programDef = {
    .name = "present",
    .vertex = {&vtChunk_screen_vert},
    .fragment = {&vtChunk_octahedral, &vtChunk_srgb, &vtChunk_present_frag},
    .samplers = {"u_paths", "u_radiance", "u_layerDepths", "u_layerNormals"},
};

void vtPresentPass_Start(vtPresentPass* pass, const vtGL* gl, vtProgramList* programs)
{
    vtProgramList_Start(programs, &pass->program, gl, &programDef);
}

void vtPresentPass_Draw(const vtPresentPass* pass, const vtGL* gl, const vtPresentInputs* inputs,
                        GLuint framebuffer, int width, int height)
{
    vtBindFramebuffer(gl, framebuffer, width, height);
    gl->UseProgram(pass->program.name);
    vtTexture_Bind(inputs->paths, gl, 0);
    vtTexture_Bind(inputs->radiance, gl, 1);
    if (inputs->layerDepths->name != 0) {
        vtTexture_Bind(inputs->layerDepths, gl, 2);
        vtTexture_Bind(inputs->layerNormals, gl, 3);
    }
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

void vtPresentPass_Destroy(vtPresentPass* pass, const vtGL* gl)
{
    vtProgram_Destroy(&pass->program, gl);
    *pass = (vtPresentPass){0};
}
