// This work is based on:
//   Cass Everitt. Interactive Order-Independent Transparency. NVIDIA, 2001.
//   Shi-Hao Wang, Ming-Te Chi. Image Space Real-time Multi-refraction Technology. 2014, section 3.4.
// Departures: the second depth test is a comparison in the shader with the layer before; the layers lie in
// a frustum fitted to the object rather than the picture's, so that rays do not leave it at the picture's
// edge; stored depth is linear, in 16 bits over the object's own range.
#include "passes/peel.h"

#include "base/error.h"
#include "shaders.h"

static const vtProgramDef programDef = {
    .name = "peel",
    .vertex = {&vtChunk_layer, &vtChunk_mesh_vert},
    .fragment = {&vtChunk_octahedral, &vtChunk_surface_attributes, &vtChunk_peel_frag},
    .samplers = {"u_previousDepth"},
};

static const vtProgramDef farthestProgramDef = {
    .name = "farthest",
    .vertex = {&vtChunk_layer, &vtChunk_mesh_vert},
    .fragment = {&vtChunk_farthest, &vtChunk_octahedral, &vtChunk_surface_attributes, &vtChunk_peel_frag},
};

vtResult vtPeelPass_Create(vtPeelPass* pass, const vtGL* gl, vtError* error)
{
    *pass = (vtPeelPass){0};
    vtResult result = vtCreateProgram(gl, &programDef, &pass->program, error);
    pass->uniforms = vtFindObjectUniforms(gl, pass->program);
    return result;
}

vtResult vtPeelPass_PrepareFarthest(vtPeelPass* pass, const vtGL* gl, vtError* error)
{
    if (pass->farthestProgram != 0) {
        return vtSucceed(error);
    }
    vtResult result = vtCreateProgram(gl, &farthestProgramDef, &pass->farthestProgram, error);
    pass->farthestUniforms = vtFindObjectUniforms(gl, pass->farthestProgram);
    return result;
}

vtResult vtPeelPass_Resize(vtPeelPass* pass, const vtGL* gl, int width, int height, int layers,
                           vtError* error)
{
    bool changed = false;
    for (int i = 0; i < 2; ++i) {
        changed |= vtTexture_Resize(&pass->depthBuffers[i], gl, GL_DEPTH_COMPONENT32F, width, height, 0);
    }
    changed |= vtTexture_Resize(&pass->depths, gl, GL_R16UI, width, height, layers);
    changed |= vtTexture_Resize(&pass->normals, gl, GL_RG32UI, width, height, layers);
    if (!changed) {
        return vtSucceed(error);
    }
    vtDestroyFramebuffers(gl, pass->framebuffers, VT_MAX_LAYERS);
    vtResult result =
        vtMakeFramebuffer(gl, "peel start", NULL, 0, &pass->depthBuffers[1], &pass->startFramebuffer, error);
    for (int layer = 0; layer < layers && result == vt_ok; ++layer) {
        vtAttachment colors[] = {{&pass->normals, layer}, {&pass->depths, layer}};
        result = vtMakeFramebuffer(gl, "peel", colors, 2, &pass->depthBuffers[layer % 2],
                                   &pass->framebuffers[layer], error);
    }
    return result;
}

/// Draws all glass into one layer, cleared before.
static void drawLayer(const vtPeelPass* pass, const vtGL* gl, const vtSceneBuffer* scene,
                      const vtObjectUniforms* uniforms, int layer, float clearDepth)
{
    const GLuint noNormal[4] = {VT_NO_NORMAL, VT_NO_NORMAL, 0, 0};
    const GLuint noDepth[4] = {VT_DEPTH_NONE, 0, 0, 0};
    vtBindFramebuffer(gl, pass->framebuffers[layer], pass->depths.width, pass->depths.height);
    gl->ClearBufferfv(GL_DEPTH, 0, &clearDepth);
    gl->ClearBufferuiv(GL_COLOR, 0, noNormal);
    gl->ClearBufferuiv(GL_COLOR, 1, noDepth);
    vtSceneBuffer_Draw(scene, gl, uniforms, 0, scene->glassCount);
}

void vtPeelPass_Draw(const vtPeelPass* pass, const vtGL* gl, const vtSceneBuffer* scene)
{
    const float near = 0.0f;
    gl->Enable(GL_DEPTH_TEST);
    gl->UseProgram(pass->program);

    // Nothing lies before the first layer.
    vtBindFramebuffer(gl, pass->startFramebuffer, pass->depths.width, pass->depths.height);
    gl->ClearBufferfv(GL_DEPTH, 0, &near);

    for (int layer = 0; layer < pass->depths.layers; ++layer) {
        vtTexture_Bind(&pass->depthBuffers[(layer + 1) % 2], gl, 0);
        drawLayer(pass, gl, scene, &pass->uniforms, layer, 1.0f);
    }
    gl->Disable(GL_DEPTH_TEST);
}

void vtPeelPass_DrawFarthest(const vtPeelPass* pass, const vtGL* gl, const vtSceneBuffer* scene)
{
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(GL_GREATER);
    gl->UseProgram(pass->farthestProgram);
    drawLayer(pass, gl, scene, &pass->farthestUniforms, 1, 0.0f);
    gl->DepthFunc(GL_LESS);
    gl->Disable(GL_DEPTH_TEST);
}

void vtPeelPass_Destroy(vtPeelPass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, &pass->startFramebuffer, 1);
    vtDestroyFramebuffers(gl, pass->framebuffers, VT_MAX_LAYERS);
    vtTexture_Destroy(&pass->depthBuffers[0], gl);
    vtTexture_Destroy(&pass->depthBuffers[1], gl);
    vtTexture_Destroy(&pass->depths, gl);
    vtTexture_Destroy(&pass->normals, gl);
    gl->DeleteProgram(pass->program);
    gl->DeleteProgram(pass->farthestProgram);
    *pass = (vtPeelPass){0};
}

size_t vtPeelPass_Bytes(const vtPeelPass* pass)
{
    return vtTexture_Bytes(&pass->depthBuffers[0]) + vtTexture_Bytes(&pass->depthBuffers[1]) +
           vtTexture_Bytes(&pass->depths) + vtTexture_Bytes(&pass->normals);
}
