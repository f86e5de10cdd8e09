#include "passes/accumulate.h"

#include "base/error.h"
#include "shaders.h"

static const vtProgramDef addDef = {
    .name = "add sample",
    .vertex = {&vtChunk_screen_vert},
    .fragment = {&vtChunk_add_sample_frag},
};

void vtAccumulatePass_Start(vtAccumulatePass* pass, const vtGL* gl, vtDisplay display,
                            vtProgramList* programs)
{
    pass->addProgram = vtProgramList_Start(programs, gl, &addDef);
    pass->showProgram = vtDisplay_Start(display, "show samples", &vtChunk_show_samples_frag, gl, programs);
    pass->display = display;
}

vtResult vtAccumulatePass_Resize(vtAccumulatePass* pass, const vtGL* gl, int width, int height,
                                 vtError* error)
{
    vtResult result = vtSucceed(error);
    for (int i = 0; i < 2 && result == vt_ok; ++i) {
        if (vtTexture_Resize(&pass->sums[i], gl, GL_RGBA32UI, width, height, 0)) {
            pass->count = 0;
            vtAttachment color = {&pass->sums[i], 0};
            result = vtMakeFramebuffer(gl, "samples", &color, 1, NULL, &pass->framebuffers[i], error);
        }
    }
    return result;
}

void vtAccumulatePass_Add(vtAccumulatePass* pass, const vtGL* gl, const vtTexture* radiance, int weight)
{
    const vtTexture* before = &pass->sums[pass->latest];
    if (pass->count == 0) {
        const GLuint nothing[4] = {0}; // the bits of 0.0
        vtBindFramebuffer(gl, pass->framebuffers[pass->latest], before->width, before->height);
        gl->ClearBufferuiv(GL_COLOR, 0, nothing);
    }
    pass->latest = 1 - pass->latest;
    pass->weight = pass->count > 0 ? pass->weight + weight : weight;
    ++pass->count;
    vtBindFramebuffer(gl, pass->framebuffers[pass->latest], before->width, before->height);
    gl->UseProgram(pass->addProgram->name);
    vtTexture_Bind(radiance, gl, vt_samplerRadiance);
    vtTexture_Bind(before, gl, vt_samplerSum);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

void vtAccumulatePass_Show(const vtAccumulatePass* pass, const vtGL* gl, const vtBehind* behind,
                           GLuint framebuffer, int x, int y)
{
    const vtTexture* sum = &pass->sums[pass->latest];
    gl->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->Viewport(x, y, sum->width, sum->height);
    gl->UseProgram(pass->showProgram->name);
    vtTexture_Bind(sum, gl, vt_samplerSum);
    vtDisplay_Bind(pass->display, pass->showProgram, behind, gl);
    gl->DrawArrays(GL_TRIANGLES, 0, 3);
}

void vtAccumulatePass_Destroy(vtAccumulatePass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, pass->framebuffers, 2);
    vtTexture_Destroy(&pass->sums[0], gl);
    vtTexture_Destroy(&pass->sums[1], gl);
    *pass = (vtAccumulatePass){0};
}

size_t vtAccumulatePass_Bytes(const vtAccumulatePass* pass)
{
    return vtTexture_Bytes(&pass->sums[0]) + vtTexture_Bytes(&pass->sums[1]);
}
