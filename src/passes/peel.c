// This work is based on:
//   Cass Everitt. Interactive Order-Independent Transparency. NVIDIA, 2001.
//   Shi-Hao Wang, Ming-Te Chi. Image Space Real-time Multi-refraction Technology. 2014, section 3.4.
// Departures: the second depth test is a comparison in the shader with the layer before; the layers lie in
// a frustum fitted to the object (or to all glass) rather than the picture's, so that rays do not leave it at
// the picture's edge; stored depth is linear, in 16 bits over the object's own range.
#include "passes/peel.h"

#include "base/error.h"
#include "shaders.h"

static const vtProgramDef programDefs[vt_peelKindCount] = {
    [vt_peelAll] = {.name = "peel",
                    .vertex = {&vtChunk_layer, &vtChunk_mesh_vert},
                    .fragment = {&vtChunk_layer, &vtChunk_octahedral, &vtChunk_surface_attributes,
                                 &vtChunk_peel_frag},
                    .uniforms = VT_OBJECT_UNIFORMS},
    [vt_peelEachObject] = {.name = "peel object",
                           .vertex = {&vtChunk_objects, &vtChunk_layer_of_object, &vtChunk_mesh_vert},
                           .fragment = {&vtChunk_objects, &vtChunk_layer_of_object, &vtChunk_octahedral,
                                        &vtChunk_surface_attributes, &vtChunk_peel_frag},
                           .uniforms = VT_OBJECT_UNIFORMS},
    [vt_peelFarthest] = {.name = "farthest",
                         .vertex = {&vtChunk_layer, &vtChunk_mesh_vert},
                         .fragment = {&vtChunk_layer, &vtChunk_farthest, &vtChunk_octahedral,
                                      &vtChunk_surface_attributes, &vtChunk_peel_frag},
                         .uniforms = VT_OBJECT_UNIFORMS},
};

void vtPeelPass_Start(vtPeelPass* pass, const vtGL* gl, vtPeelKind kind, vtProgramList* programs)
{
    pass->program = vtProgramList_Start(programs, gl, &programDefs[kind]);
}

vtResult vtPeelPass_Resize(vtPeelPass* pass, const vtGL* gl, int width, int height, int layers, int sets,
                           vtError* error)
{
    GLint most = pass->depths.layers;
    if (layers * sets > most) { // not asked every frame
        gl->GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
    }
    if (layers * sets > most) {
        return vtFail(error, vt_errorContext,
                      "scene: %d layers of each of %d objects of glass are more than this GPU has room for "
                      "(%d in all); ask for fewer layers or join some of the objects",
                      layers, sets, most);
    }
    bool changed = false;
    for (int i = 0; i < 2; ++i) {
        changed |= vtTexture_Resize(&pass->depthBuffers[i], gl, GL_DEPTH_COMPONENT32F, width, height, 0);
    }
    pass->layers = layers;
    changed |= vtTexture_Resize(&pass->depths, gl, GL_R16UI, width, height, layers * sets);
    changed |= vtTexture_Resize(&pass->normals, gl, GL_RG32UI, width, height, layers * sets);
    if (!changed) {
        return vtSucceed(error);
    }
    vtResult result =
        vtMakeFramebuffer(gl, "peel start", NULL, 0, &pass->depthBuffers[1], &pass->startFramebuffer, error);
    for (int i = 0; i < 2 && result == vt_ok; ++i) {
        vtAttachment colors[] = {{&pass->normals, 0}, {&pass->depths, 0}};
        result =
            vtMakeFramebuffer(gl, "peel", colors, 2, &pass->depthBuffers[i], &pass->framebuffers[i], error);
    }
    return result;
}

/// Draws objects first to last - 1 into one layer, cleared before.
static void drawLayer(const vtPeelPass* pass, const vtGL* gl, const vtSceneBuffer* scene, vtPeelKind kind,
                      int slice, uint32_t first, uint32_t last)
{
    const GLuint noNormal[4] = {VT_NO_NORMAL, VT_NO_NORMAL, 0, 0};
    const GLuint noDepth[4] = {VT_DEPTH_NONE, 0, 0, 0};
    const float clearDepth = kind == vt_peelFarthest ? 0.0f : 1.0f;
    const int buffer = slice % pass->layers % 2;
    vtBindFramebuffer(gl, pass->framebuffers[buffer], pass->depths.width, pass->depths.height);
    gl->FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, pass->normals.name, 0, slice);
    gl->FramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, pass->depths.name, 0, slice);
    gl->ClearBufferfv(GL_DEPTH, 0, &clearDepth);
    gl->ClearBufferuiv(GL_COLOR, 0, noNormal);
    gl->ClearBufferuiv(GL_COLOR, 1, noDepth);
    vtTexture_Bind(&pass->depthBuffers[1 - buffer], gl, vt_samplerPreviousDepth);
    vtSceneBuffer_Draw(scene, gl, pass->program, first, last);
}

static void peelSet(const vtPeelPass* pass, const vtGL* gl, const vtSceneBuffer* scene, vtPeelKind kind,
                    int set, uint32_t first, uint32_t last)
{
    const float near = 0.0f;
    // Nothing lies before the first layer.
    vtBindFramebuffer(gl, pass->startFramebuffer, pass->depths.width, pass->depths.height);
    gl->ClearBufferfv(GL_DEPTH, 0, &near);
    for (int layer = 0; layer < pass->layers; ++layer) {
        drawLayer(pass, gl, scene, kind, set * pass->layers + layer, first, last);
    }
}

void vtPeelPass_Draw(const vtPeelPass* pass, const vtGL* gl, const vtSceneBuffer* scene, vtPeelKind kind)
{
    const uint32_t glass = scene->glassCount;
    gl->Enable(GL_DEPTH_TEST);
    gl->UseProgram(pass->program->name);
    if (kind == vt_peelFarthest) {
        gl->DepthFunc(GL_GREATER);
        drawLayer(pass, gl, scene, kind, 1, 0, glass);
        gl->DepthFunc(GL_LESS);
    } else if (kind == vt_peelAll) {
        peelSet(pass, gl, scene, kind, 0, 0, glass);
    } else {
        vtTexture_Bind(&scene->table, gl, vt_samplerObjects);
        for (uint32_t object = 0; object < glass; ++object) {
            peelSet(pass, gl, scene, kind, (int)object, object, object + 1);
        }
    }
    gl->Disable(GL_DEPTH_TEST);
}

void vtPeelPass_Destroy(vtPeelPass* pass, const vtGL* gl)
{
    vtDestroyFramebuffers(gl, &pass->startFramebuffer, 1);
    vtDestroyFramebuffers(gl, pass->framebuffers, 2);
    vtTexture_Destroy(&pass->depthBuffers[0], gl);
    vtTexture_Destroy(&pass->depthBuffers[1], gl);
    vtTexture_Destroy(&pass->depths, gl);
    vtTexture_Destroy(&pass->normals, gl);
    *pass = (vtPeelPass){0};
}

size_t vtPeelPass_Bytes(const vtPeelPass* pass)
{
    return vtTexture_Bytes(&pass->depthBuffers[0]) + vtTexture_Bytes(&pass->depthBuffers[1]) +
           vtTexture_Bytes(&pass->depths) + vtTexture_Bytes(&pass->normals);
}
