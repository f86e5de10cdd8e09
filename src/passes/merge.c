#include "passes/merge.h"

#include "base/error.h"
#include "shaders.h"

static const vtProgramDef programDef = {
    .name = "merge",
    .vertex = {&vtChunk_screen_vert},
    .fragment = {&vtChunk_merge_frag},
    .samplers = {"u_layerDepths"},
};

vtResult vtMergePass_Create(vtMergePass* pass, const vtGL* gl, vtError* error)
{
    *pass = (vtMergePass){0};
    vtResult result = vtCreateProgram(gl, &programDef, &pass->program, error);
    if (result == vt_ok) {
        pass->groupLocation = gl->GetUniformLocation(pass->program, "u_group");
    }
    return result;
}

vtResult vtMergePass_Resize(vtMergePass* pass, const vtGL* gl, int width, int height, int layers,
                            vtError* error)
{
    int groups = (layers + 3) / 4;
    if (!vtTexture_Resize(&pass->depths, gl, GL_RGBA16UI, width, height, groups)) {
        return vtSucceed(error);
    }
    vtDestroyFramebuffers(gl, pass->framebuffers, VT_MAX_LAYER_GROUPS);
    vtResult result = vt_ok;
    for (int group = 0; group < groups && result == vt_ok; ++group) {
        vtAttachment color = {&pass->depths, group};
        result = vtMakeFramebuffer(gl, "merge", &color, 1, NULL, &pass->framebuffers[group], error);
    }
    return result;
}

void vtMergePass_Draw(const vtMergePass* pass, const vtGL* gl, const vtTexture* layerDepths)
{
    gl->UseProgram(pass->program);
    vtTexture_Bind(layerDepths, gl, 0);
    for (int group = 0; group < pass->depths.layers; ++group) {
        vtBindFramebuffer(gl, pass->framebuffers[group], pass->depths.width, pass->depths.height);
        gl->Uniform1i(pass->groupLocation, group);
        gl->DrawArrays(GL_TRIANGLES, 0, 3);
    }
}

void vtMergePass_Destroy(vtMergePass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, pass->framebuffers, VT_MAX_LAYER_GROUPS);
    vtTexture_Destroy(&pass->depths, gl);
    gl->DeleteProgram(pass->program);
    *pass = (vtMergePass){0};
}
