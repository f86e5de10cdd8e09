#include "passes/merge.h"

#include "base/error.h"
#include "shaders.h"

static const vtProgramDef programDef = {
    .name = "merge",
    .vertex = {&vtChunk_screen_vert},
    .fragment = {&vtChunk_merge_frag},
    .uniforms = {"u_group", "u_firstLayer"},
};

void vtMergePass_Start(vtMergePass* pass, const vtGL* gl, vtProgramList* programs)
{
    pass->program = vtProgramList_Start(programs, gl, &programDef);
}

vtResult vtMergePass_Resize(vtMergePass* pass, const vtGL* gl, int width, int height, int layers, int sets,
                            vtError* error)
{
    const int groups = (layers + 3) / 4;
    pass->layers = layers;
    if (!vtTexture_Resize(&pass->depths, gl, GL_RGBA16UI, width, height, groups * sets)) {
        return vtSucceed(error);
    }
    vtAttachment color = {&pass->depths, 0};
    return vtMakeFramebuffer(gl, "merge", &color, 1, NULL, &pass->framebuffer, error);
}

void vtMergePass_Draw(const vtMergePass* pass, const vtGL* gl, const vtTexture* layerDepths)
{
    const int groups = (pass->layers + 3) / 4;
    gl->UseProgram(pass->program->name);
    vtTexture_Bind(layerDepths, gl, vt_samplerLayerDepths);
    vtBindFramebuffer(gl, pass->framebuffer, pass->depths.width, pass->depths.height);
    for (int slice = 0; slice < pass->depths.layers; ++slice) {
        gl->FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, pass->depths.name, 0, slice);
        gl->Uniform1i(pass->program->uniforms[0], slice % groups);
        gl->Uniform1i(pass->program->uniforms[1], slice / groups * pass->layers);
        gl->DrawArrays(GL_TRIANGLES, 0, 3);
    }
}

void vtMergePass_Destroy(vtMergePass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, &pass->framebuffer, 1);
    vtTexture_Destroy(&pass->depths, gl);
    *pass = (vtMergePass){0};
}
