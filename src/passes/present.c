#include "passes/present.h"

#include "shaders.h"

void vtPresentPass_Start(vtPresentPass* pass, const vtGL* gl, vtDisplay display, vtProgramList* programs)
{
    pass->program = vtDisplay_Start(display, "present", &vtChunk_present_frag, gl, programs);
    pass->display = display;
}

void vtPresentPass_Draw(const vtPresentPass* pass, const vtGL* gl, const vtPresentInputs* inputs,
                        GLuint framebuffer, int x, int y, int width, int height)
{
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->Viewport(x, y, width, height);
    gl->UseProgram(pass->program->name);
    const vtBinding bindings[] = {{vt_samplerPaths, inputs->paths},
                                  {vt_samplerRadiance, inputs->radiance},
                                  {vt_samplerLayerDepths, inputs->layerDepths},
                                  {vt_samplerLayerNormals, inputs->layerNormals}};
    vtBindTextures(gl, bindings, sizeof bindings / sizeof bindings[0]);
    vtDisplay_Bind(pass->display, pass->program, &inputs->behind, gl);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}
